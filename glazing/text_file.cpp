// SPDX-License-Identifier: Apache-2.0
#include "glazing/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>

#include "scene/system/diagnostics.h"
#include "scene/system/input_files.h"
#include "scene/system/say.h"

namespace vitrail {

namespace {

constexpr std::string_view separators = " \t\r\v\f,;";

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = utf8_size(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

std::string from_latin_1(std::string_view text) {
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) {
      result.push_back(c);
    } else {
      result.push_back(static_cast<char>(0xC0 | (byte >> 6)));
      result.push_back(static_cast<char>(0x80 | (byte & 0x3F)));
    }
  }
  return result;
}

}  // namespace

std::string read_text(const std::filesystem::path& file) {
  constexpr std::uintmax_t most_bytes = 64 << 20;
  check_input(file);
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) throw Error("is a directory, not a file", {file.string()});
  if (!std::filesystem::exists(file, error)) throw Error("there is no such file", {file.string()});
  if (std::filesystem::file_size(file, error) > most_bytes && !error)
    throw Error("is larger than 64 MiB", {file.string()});
  std::ifstream in(file, std::ios::binary);
  if (!in) throw MachineError(fmt::format("cannot read {}", file.string()));
  std::string text(std::istreambuf_iterator<char>(in), {});
  if (in.bad()) throw MachineError(fmt::format("cannot read {}", file.string()));
  if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
  return is_utf8(text) ? text : from_latin_1(text);
}

bool Lines::next(std::string_view& line) {
  if (rest_.empty()) return false;
  const std::size_t end = std::min(rest_.find('\n'), rest_.size());
  line = rest_.substr(0, end);
  rest_.remove_prefix(std::min(end + 1, rest_.size()));
  ++number_;
  return true;
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n\v\f";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

bool same_word(std::string_view a, std::string_view b) { return lower(a) == lower(b); }

std::string_view next_word(std::string_view& rest) {
  const std::size_t first = std::min(rest.find_first_not_of(separators), rest.size());
  rest.remove_prefix(first);
  const std::string_view word = rest.substr(0, rest.find_first_of(separators));
  rest.remove_prefix(word.size());
  return word;
}

double nanometres_in(std::string_view unit) {
  const std::string name = lower(trimmed(unit));
  for (const char* known : {"nm", "nanometer", "nanometers", "nanometre", "nanometres"})
    if (name == known) return 1;
  for (const char* known : {"um", "\u00b5m", "\u03bcm", "micron", "microns", "micrometer", "micrometers",
                            "micrometre", "micrometres"})
    if (name == known) return 1000;
  return 0;
}

bool parse_number(std::string_view word, double& value) {
  if (word.size() > 1 && word.front() == '+' && word[1] != '-') word.remove_prefix(1);
  const char* end = word.data() + word.size();
  const auto result = std::from_chars(word.data(), end, value);
  return result.ec == std::errc() && result.ptr == end && std::isfinite(value);
}

}  // namespace vitrail
