// STUB
#pragma once
#include <filesystem>
#include "bundle/manifest.h"
#include "partitioner/texture_mean.h"
#include "scene/color.h"
#include "scene/scene.h"
namespace vitrail {
enum class TextureUse { reflectance, unbounded, illuminant, number, vector };
struct AttributeSlot {
  std::string name;
  TextureUse use;
};
inline std::array<float, 3> attribute_value(RGB c, TextureUse) {
  return {(float)c.r, (float)c.g, (float)c.b};
}
inline void move(std::vector<Texture>&, Vector3d) {}
class TextureBaker {
 public:
  TextureBaker(const Scene& s, std::filesystem::path, Diagnostics&) : means_(s.textures) {}
  SpectrumParameter bake(const SpectrumParameter& p, TextureUse) { return means_.of(p).value; }
  FloatParameter bake(const FloatParameter& p) { return (float)means_.of(p).value; }
  Id<Texture> bake_vector(Id<Texture>) { return {0}; }
  std::string bake_image(std::string, Encoding, float, TextureUse) { return ""; }
  std::vector<Texture> take_textures() { return {}; }
  std::vector<AttributeSlot> attributes() { return {}; }
  std::vector<TextureFileEntry> files() { return {}; }
  TextureMeans means_;
};
}  // namespace vitrail
