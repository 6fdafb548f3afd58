// SPDX-License-Identifier: Apache-2.0
// Pictures that lie within other files, as glTF has them: a record names one by a part of that file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vitrail {

// So many bytes of a file from an offset on. Of base64: `bytes` of what the text that begins at `offset`
// comes to, behind the first `skip` (0 to 2) of it.
struct FilePart {
  std::filesystem::path file;
  std::uint64_t offset = 0, bytes = 0;
  bool base64 = false;
  unsigned skip = 0;
  bool operator==(const FilePart&) const = default;
};

// "/a/scene.glb#bytes=120+4096", "/a/scene.gltf#base64=120+4096", "…#base64=120+4096-2" with skip.
std::string name_of(const FilePart& part);
// The part that such a name means; nothing for names of whole files.
std::optional<FilePart> file_part(const std::string& name);
// The file that is opened for it: itself where it is no part.
std::filesystem::path whole_file(const std::string& name);

// Throws Error where the file has not so much, or no base64 there; with the file's name.
std::vector<std::byte> read_part(const FilePart& part);

// ".png", ".jpg", ".webp", ".ktx2" … by the first bytes; "" where they tell nothing.
std::string picture_suffix(const std::vector<std::byte>& bytes);

}  // namespace vitrail
