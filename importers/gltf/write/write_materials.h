// SPDX-License-Identifier: Apache-2.0
// The Scene's materials are written as glTF's: metallic-roughness and KHR extensions. Other materials become
// the nearest of these, with a note.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <tuple>

#include "importers/gltf/write/pictures.h"
#include "importers/images/baked_textures.h"
#include "importers/writing/opacity_key.h"
#include "scene/spectra/color.h"
#include "scene/system/temporary_folder.h"

namespace vitrail::gltf {

class MaterialWriter {
 public:
  // `area_lights` are as the film exposes them (exposed_lights.h).
  MaterialWriter(tinygltf::Model& model, Binary& binary, ConversionNotes& notes,
                 const std::vector<AreaLight>& area_lights)
      : model_(model),
        notes_(notes),
        scene_(notes.scene),
        area_lights_(area_lights),
        pictures_(model, binary, notes) {}

  // Writes the material of a surface with its light, opacity and interior. color_attribute names the mesh's
  // colours that a material shows as COLOR_0; "" for none.
  int write(const Shape& shape);
  const std::string& color_attribute(int material) const { return attributes_.at(material); }

 private:
  using Key = std::tuple<std::uint32_t, std::uint32_t, OpacityKey, std::uint32_t>;
  std::uint32_t known_light(const Shape& shape) const;

  // ---- Values
  struct Color {
    RGB factor{1, 1, 1};
    const ImageTexture* image = nullptr;
  };
  Color color(const SpectrumParameter& parameter, const char* what);
  double number(const FloatParameter& parameter, const char* what);
  const ImageTexture* image_of(const FloatParameter& parameter) const;
  // Returns the same, also of a texture that an image can stand for.
  const ImageTexture* image_of_numbers(const FloatParameter& parameter);
  void base(const SpectrumParameter& parameter);
  void roughness(const Roughness& roughness);
  void roughness_and_metal(const FloatParameter& roughness, const FloatParameter& metallic);
  void index(double eta);
  void transmit(double amount, bool solid);
  void opacity(const FloatParameter& parameter);
  void light(const AreaLight& light);
  tinygltf::Value::Object& extension(const char* name);

  // ---- Models
  void put(Id<Material> id);
  void put(const DiffuseMaterial& m);
  void put(const DielectricMaterial& m);
  void put(const ThinDielectricMaterial& m);
  void put(const ConductorMaterial& m);
  void put(const PlasticMaterial& m);
  void put(const CoatedDiffuseMaterial& m);
  void put(const CoatedConductorMaterial& m);
  void put(const DiffuseTransmissionMaterial& m);
  void put(const PrincipledMaterial& m);
  void put(const SubsurfaceMaterial& m);
  void put(const HairMaterial& m);
  void put(const MeasuredMaterial&) { grey("measured material", 0.5); }
  void put(const TabulatedMaterial&) { grey("tabulated material", 0.5); }
  void put(const SlabMaterial&) { grey("slab of a medium", 0.5); }
  void put(const FinishMaterial& m) { put(DiffuseMaterial{m.reflectance}); }
  void put(const GlazedMaterial& m) { put(m.finish); }
  void put(const InterfaceMaterial&);
  void put(const BlendMaterial& m);
  void put(const MaskMaterial& m);
  void put(const TwoSidedMaterial& m);
  void lambert();
  void metal(const Metal& metal, const Roughness& roughness);
  void glass(const Spectrum& eta, const Spectrum& outside, const SpectrumParameter& tint);
  void grey(const char* what, double value);

  tinygltf::Model& model_;
  ConversionNotes& notes_;
  const Scene& scene_;
  const std::vector<AreaLight>& area_lights_;
  Pictures pictures_;
  std::optional<TemporaryFolder> folder_;  // of images that textures are baked to: the file embeds them
  std::size_t images_ = 0;
  BakedTextures baked_{scene_, [this] {
                         if (!folder_) folder_.emplace();
                         return std::filesystem::path(folder_->file(std::to_string(images_++) + ".png"));
                       }};
  std::map<Key, int> known_;
  std::map<int, std::string> attributes_;

  // They are of the material that is being written.
  tinygltf::Material out_;
  std::map<std::string, tinygltf::Value::Object> extensions_;
  std::string attribute_;
  Color base_;
  FloatParameter opacity_ = 1.0f;
  std::optional<Id<Medium>> interior_;
};

}  // namespace vitrail::gltf
