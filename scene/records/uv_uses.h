// SPDX-License-Identifier: Apache-2.0
// These functions find where (u,v) show: in textures that look them up, and in surfaces that have a direction
// along them.
#pragma once

#include <vector>

#include "scene/records/scene.h"

namespace vitrail {

// It answers for textures that may become more.
class UvUses {
 public:
  // `of_curves` says that the surfaces are curves: there hair knows where it runs.
  explicit UvUses(const std::vector<Texture>& textures, bool of_curves = false)
      : on_curves(of_curves), textures_(textures) {}

  const bool on_curves;

  bool of(Id<Texture> texture);
  bool of(const FloatParameter& parameter);
  bool of(const SpectrumParameter& parameter);
  // Returns whether (u,v) show in the material itself, without its parts.
  bool of(const Material& material);

 private:
  const std::vector<Texture>& textures_;
  std::vector<bool> known_;  // of the first textures
};

// Returns for each material whether it or a part of it is hair. Hair along v counts only if `also_along_v`.
std::vector<bool> with_hair(const std::vector<Material>& materials, bool also_along_v);

// It answers for the shapes of a scene that stays as it is.
class ShapeUvUses {
 public:
  explicit ShapeUvUses(const Scene& scene, bool on_curves = false);

  bool of(const Shape& shape);

 private:
  bool of(std::uint32_t material);

  enum class Shows : char { unknown, no, yes };
  const Scene& scene_;
  UvUses uses_;
  std::vector<Shows> materials_;
};

// Returns for each mesh whether the (u,v) of a shape that has it show.
std::vector<bool> meshes_whose_uvs_show(const Scene& scene);

}  // namespace vitrail
