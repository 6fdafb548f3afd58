// SPDX-License-Identifier: Apache-2.0
#include "importers/writing/embedded_images.h"

#include <algorithm>
#include <map>

#include "images/file_part.h"
#include "importers/writing/side_files.h"
#include "scene/system/atomic_file.h"

namespace vitrail {

namespace {

bool is_embedded(const Texture& texture) {
  const auto* image = std::get_if<ImageTexture>(&texture.model);
  return image && file_part(image->filename);
}

}  // namespace

bool has_embedded_images(const Scene& scene) { return std::ranges::any_of(scene.textures, is_embedded); }

void extract_images(Scene& scene, const std::filesystem::path& out) {
  const SideFiles files(out);
  const std::filesystem::path folder = std::filesystem::absolute(out).parent_path();
  std::map<std::string, std::string> written;
  for (Texture& texture : scene.textures) {
    if (!is_embedded(texture)) continue;
    std::string& name = std::get<ImageTexture>(texture.model).filename;
    const auto [known, is_new] = written.try_emplace(name);
    if (is_new) {
      try {
        const std::vector<std::byte> bytes = read_part(*file_part(name));
        std::string suffix = picture_suffix(bytes);
        if (suffix.empty()) throw Error("this is no picture of a kind that is known", {name});
        known->second = (folder / files.name("images", written.size() - 1, suffix.substr(1))).string();
        AtomicFile file(known->second);
        file.write(bytes);
        file.commit_part();
      } catch (const Error& error) {
        throw Error(error.what(), location(scene, texture.origin));
      }
    }
    name = known->second;
  }
}

}  // namespace vitrail
