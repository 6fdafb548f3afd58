// SPDX-License-Identifier: Apache-2.0
// Where (u,v) show: in textures that look them up, and in what has a direction along the surface.
#pragma once

#include <vector>

#include "scene/records/scene.h"

namespace vitrail {

// Of textures that may become more.
class UvUses {
 public:
  // `of_curves`: there hair knows where it runs.
  explicit UvUses(const std::vector<Texture>& textures, bool of_curves = false)
      : on_curves(of_curves), textures_(textures) {}

  const bool on_curves;

  bool of(Id<Texture> texture);
  bool of(const FloatParameter& parameter);
  bool of(const SpectrumParameter& parameter);
  // Of the material itself, without its parts.
  bool of(const Material& material);

 private:
  const std::vector<Texture>& textures_;
  std::vector<bool> known_;  // of the first textures
};

// Of each material, whether it or a part of it is hair, which also may run along v.
std::vector<bool> with_hair(const std::vector<Material>& materials, bool also_along_v);

// Of the shapes of a scene that stays as it is.
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

// For each mesh, whether the (u,v) of a shape that has it show.
std::vector<bool> meshes_whose_uvs_show(const Scene& scene);

}  // namespace vitrail
