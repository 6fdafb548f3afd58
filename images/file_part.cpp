// SPDX-License-Identifier: Apache-2.0
#include "images/file_part.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>
#include <utility>

#include "scene/system/diagnostics.h"
#include "scene/system/input_files.h"

namespace vitrail {

namespace {

constexpr std::string_view plain_mark = "#bytes=", base64_mark = "#base64=";

bool take_number(std::string_view& text, std::uint64_t& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{}) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return true;
}

bool take(std::string_view& text, char letter) {
  if (!text.starts_with(letter)) return false;
  text.remove_prefix(1);
  return true;
}

// −1 where it is none.
int value_of_base64(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

}  // namespace

std::string name_of(const FilePart& part) {
  std::string name = fmt::format("{}{}{}+{}", part.file.string(), part.base64 ? base64_mark : plain_mark,
                                 part.offset, part.bytes);
  if (part.skip > 0) name += fmt::format("-{}", part.skip);
  return name;
}

std::optional<FilePart> file_part(const std::string& name) {
  for (const std::string_view mark : {plain_mark, base64_mark}) {
    const std::size_t at = name.rfind(mark);
    if (at == std::string::npos) continue;
    FilePart part;
    part.file = name.substr(0, at);
    part.base64 = mark == base64_mark;
    std::string_view rest = std::string_view(name).substr(at + mark.size());
    std::uint64_t skip = 0;
    if (!take_number(rest, part.offset) || !take(rest, '+') || !take_number(rest, part.bytes)) continue;
    if (take(rest, '-') && (!part.base64 || !take_number(rest, skip) || skip > 2)) continue;
    if (!rest.empty()) continue;
    part.skip = static_cast<unsigned>(skip);
    return part;
  }
  return {};
}

std::filesystem::path whole_file(const std::string& name) {
  const std::optional<FilePart> part = file_part(name);
  return part ? part->file : std::filesystem::path(name);
}

std::vector<std::byte> read_part(const FilePart& part) {
  check_input(part.file);
  const RegularFile file(part.file);
  const auto fail = [&](const char* what) -> Error {
    return Error(fmt::format("the picture at byte {} {}", part.offset, what), {part.file.string()});
  };
  const std::uint64_t decoded = part.bytes + part.skip;
  const std::uint64_t stored =
      part.base64 ? decoded / 3 * 4 + (decoded % 3 > 0 ? decoded % 3 + 1 : 0) : part.bytes;
  if (!file.is_open() || part.bytes > file.size() || stored > file.size() ||
      part.offset > file.size() - stored)
    throw fail("is not within the file");
  std::vector<std::byte> bytes(stored);
  if (!file.read(bytes, part.offset)) throw fail("cannot be read");
  if (!part.base64) return bytes;
  std::vector<std::byte> picture;
  picture.reserve(decoded);
  unsigned buffer = 0;
  int bits = 0;
  for (const std::byte letter : bytes) {
    const int value = value_of_base64(static_cast<char>(letter));
    if (value < 0) throw fail("is not base64");
    buffer = buffer << 6 | static_cast<unsigned>(value), bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    picture.push_back(static_cast<std::byte>(buffer >> bits & 0xff));
  }
  picture.erase(picture.begin(), picture.begin() + static_cast<std::ptrdiff_t>(part.skip));
  return picture;
}

std::string picture_suffix(const std::vector<std::byte>& bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()),
                              std::min<std::size_t>(bytes.size(), 16));
  constexpr std::array<std::pair<std::string_view, const char*>, 6> kinds{{{"\x89PNG", ".png"},
                                                                           {"\xff\xd8\xff", ".jpg"},
                                                                           {"\xabKTX", ".ktx2"},
                                                                           {"\x76\x2f\x31\x01", ".exr"},
                                                                           {"BM", ".bmp"},
                                                                           {"GIF8", ".gif"}}};
  for (const auto& [magic, suffix] : kinds)
    if (text.starts_with(magic)) return suffix;
  return text.starts_with("RIFF") && text.substr(8, 4) == "WEBP" ? ".webp" : "";
}

}  // namespace vitrail
