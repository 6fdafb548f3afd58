// SPDX-License-Identifier: Apache-2.0
// A picture may lie within another file, as in glTF: a record then names a part of that file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vitrail {

// A FilePart is `bytes` bytes of a file, from `offset` on. With base64, it is `bytes` bytes of what the text
// that begins at `offset` decodes to, behind its first `skip` (0 to 2).
struct FilePart {
  std::filesystem::path file;
  std::uint64_t offset = 0, bytes = 0;
  bool base64 = false;
  unsigned skip = 0;
  bool operator==(const FilePart&) const = default;
};

// Returns names such as "/a/scene.glb#bytes=120+4096", "/a/scene.gltf#base64=120+4096", and with skip
// "…#base64=120+4096-2".
std::string name_of(const FilePart& part);
// Returns the part that such a name means, and nothing for the name of a whole file.
std::optional<FilePart> file_part(const std::string& name);
// Returns the file that is opened for a name: the name itself where it is of no part.
std::filesystem::path whole_file(const std::string& name);

// Throws Error with the file's name where the file ends before, or has no base64 there.
std::vector<std::byte> read_part(const FilePart& part);

// Returns ".png", ".jpg", ".webp", ".ktx2" … by the first bytes; "" where they tell nothing.
std::string picture_suffix(const std::vector<std::byte>& bytes);

}  // namespace vitrail
