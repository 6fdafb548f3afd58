// SPDX-License-Identifier: Apache-2.0
#include "importers/assimp/read/asset_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>

#include "images/file_part.h"
#include "importers/bytes/input_bytes.h"
#include "importers/bytes/text_cursor.h"
#include "importers/reading/named_file.h"

namespace vitrail::assimp {

namespace {

std::optional<RGB> rgb(const std::optional<std::array<double, 3>>& c) {
  if (!c) return {};
  return RGB{std::max((*c)[0], 0.0), std::max((*c)[1], 0.0), std::max((*c)[2], 0.0)};
}

// Materials as those of an MTL library, whose words are the same.
class MaterialReader {
 public:
  MaterialReader(const std::string& file, ImportedScene& imported) : file_(file), imported_(imported) {}

  MtlSurface add(const AssetMaterial& in) {
    MtlMaterial mtl;
    mtl.name = printable(in.name);
    mtl.location = {file_};
    mtl.kd = rgb(in.diffuse);
    mtl.ks = rgb(in.specular);
    mtl.ke = rgb(in.emission);
    mtl.illum = in.is_shiny && in.shininess.value_or(0) > 0 ? 2 : 1;
    if (in.shininess) mtl.ns = *in.shininess;
    if (in.index && *in.index > 1) mtl.ni = *in.index;
    // Whoever means "not seen at all" does not export it; there are two ways to say it, and files mix them
    // up.
    if (in.opacity && *in.opacity <= 0 && !mtl.ni)
      note(Fidelity::approximated, fmt::format("material '{}': opacity 0 is taken as opaque", mtl.name));
    else if (in.opacity)
      mtl.d = std::min(*in.opacity, 1.0);
    const auto map = [&](const char* keyword, const std::optional<AssetImage>& image) {
      if (image) add_map(mtl, keyword, *image);
    };
    map("map_Kd", in.diffuse_image);
    map("map_Ks", in.specular_image);
    map("map_Ke", in.emission_image);
    map("map_d", in.opacity_image);
    map("bump", in.height_image);
    map("norm", in.normal_image);
    return add_mtl_material(mtl, textures_, imported_.scene, imported_.diagnostics);
  }

 private:
  void note(Fidelity fidelity, std::string what) {
    imported_.diagnostics.push_back({fidelity, std::move(what), {file_}, {}, RecordKind::material});
  }

  void add_map(MtlMaterial& mtl, const char* keyword, const AssetImage& image) {
    MtlMap map;
    map.filename = image.is_inside ? part_with(image.bytes)
                                   : named_file(image.name, std::filesystem::absolute(file_).parent_path());
    map.wrap = image.clamps ? Wrap::clamp : image.mirrors ? Wrap::mirror : Wrap::repeat;
    if (map.filename.empty())
      note(Fidelity::dropped,
           fmt::format("material '{}': {}, an image in the file that is neither PNG, JPEG nor WebP", mtl.name,
                       keyword));
    else
      mtl.maps.emplace(keyword, std::move(map));
  }

  // The part of this file that has these bytes.
  std::string part_with(const std::string& bytes) const {
    const auto* const first = reinterpret_cast<const std::byte*>(bytes.data());
    constexpr std::array read_within{".png", ".jpg", ".webp"};  // as image_files.cpp has them
    const std::string suffix = picture_suffix({first, first + std::min<std::size_t>(bytes.size(), 64)});
    if (std::ranges::find(read_within, suffix) == read_within.end()) return {};
    const InputBytes all(file_);
    const char* at =
        std::search(all.begin(), all.end(), std::boyer_moore_horspool_searcher(bytes.begin(), bytes.end()));
    if (at == all.end()) return {};
    return name_of({std::filesystem::absolute(file_).lexically_normal(),
                    static_cast<std::uint64_t>(at - all.begin()), bytes.size()});
  }

  const std::string& file_;
  ImportedScene& imported_;
  MtlTextures textures_;
};

}  // namespace

std::vector<MtlSurface> add_materials(const Asset& asset, const std::string& file, ImportedScene& imported) {
  MaterialReader reader(file, imported);
  std::vector<MtlSurface> surfaces;
  for (const AssetMaterial& material : asset.materials) surfaces.push_back(reader.add(material));
  return surfaces;
}

}  // namespace vitrail::assimp
