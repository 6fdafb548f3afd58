// SPDX-License-Identifier: Apache-2.0
#include "bundle/checked_json.h"

#include <fmt/format.h>

#include <array>
#include <span>

#include "bundle/checksum.h"
#include "bundle/read_file.h"
#include "bundle/write_file.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

std::string checksum_line(std::string_view rest) {
  return fmt::format("{{\"checksum\": \"{:016x}\",\n", checksum(std::as_bytes(std::span(rest))));
}

}  // namespace

void write_checked_json(const std::filesystem::path& file, const nlohmann::ordered_json& json) {
  const std::string rest = json.dump(1).substr(2) + "\n";  // without "{\n"
  const std::string text = checksum_line(rest) + rest;
  write_file(file, std::array{std::as_bytes(std::span(text))});
}

nlohmann::ordered_json read_checked_json(const std::filesystem::path& file, const char* what) {
  const std::vector<std::byte> bytes = read_file(file);
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::size_t first_line =
      text.find('\n') == std::string_view::npos ? text.size() : text.find('\n') + 1;
  if (text.substr(0, first_line) != checksum_line(text.substr(first_line)))
    throw Error(
        fmt::format("{} is damaged or was edited: its checksum is wrong; partition the scene again", what),
        {file.string()});
  return nlohmann::ordered_json::parse(text);
}

}  // namespace vitrail
