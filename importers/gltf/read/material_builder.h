// SPDX-License-Identifier: Apache-2.0
// A MaterialBuilder makes one material of a glTF file (materials.h).
#pragma once

#include <string>

#include "importers/gltf/read/materials.h"
#include "scene/spectra/color.h"

namespace vitrail::gltf {

class MaterialBuilder {
 public:
  MaterialBuilder(const Document& document, int index, int color_channels, Scene& scene,
                  Diagnostics& diagnostics, Textures& textures);
  Surface build();

 private:
  void note(Fidelity fidelity, const std::string& what) const;
  void approximated(const std::string& what) const { note(Fidelity::approximated, what); }
  // Returns the number within [low, high], and reports it where it is not.
  double held(const char* name, double value, double low, double high) const;
  int uv_set() const;

  // Returns `map` times `factor`, or the factor.
  FloatParameter number(const tinygltf::TextureInfo* map, double factor, ImageNumber channel) const;
  SpectrumParameter tinted(const tinygltf::TextureInfo& map, Encoding encoding, RGB factor) const;
  SpectrumParameter base_color() const;
  FloatParameter alpha() const;
  FloatParameter opacity() const;
  float eta() const;
  Spectrum dispersed_eta() const;

  MaterialModel model();
  MaterialModel principled();
  MaterialModel glass(bool solid);
  void coat(PrincipledMaterial& material) const;
  void sheen(PrincipledMaterial& material) const;
  void anisotropy(PrincipledMaterial& material) const;
  void specular(PrincipledMaterial& material) const;
  void light(Surface& surface) const;
  std::optional<Id<Medium>> interior() const;
  const tinygltf::Value* extension(const char* name) const;

  const Document& document_;
  const tinygltf::Material& m_;
  const int index_, color_channels_;
  Scene& scene_;
  Diagnostics& diagnostics_;
  Textures& textures_;
  int uv_set_ = 0;
};

}  // namespace vitrail::gltf
