// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "importers/povray/read/reader.h"
#include "importers/reading/missing_files.h"
#include "importers/reading/suggestion.h"
#include "scene/records/film_settings.h"

namespace vitrail::pov {

SourceLocation Reader::location(const Place& place) const {
  if (place.line == 0) return {files_.front()};
  return {files_.at(place.file), static_cast<int>(place.line), place.column};
}

// The line of a place, at most `width` characters around the column.
std::string Reader::excerpt(const Place& place) const {
  constexpr std::ptrdiff_t width = 100;
  if (place.line == 0) return {};
  try {
    const auto written = written_files_.find(files_.at(place.file));
    std::optional<InputBytes> bytes;
    if (written == written_files_.end()) bytes.emplace(files_.at(place.file));
    const char* line = bytes ? bytes->begin() : written->second.data();
    const char* const end = bytes ? bytes->end() : line + written->second.size();
    for (std::uint32_t n = 1; n < place.line && line != end; ++line)
      if (*line == '\n') ++n;
    const char* const stop = std::find_if(line, end, [](char c) { return c == '\n' || c == '\r'; });
    const std::ptrdiff_t length = stop - line, at = std::min<std::ptrdiff_t>(place.column - 1, length);
    return {line + std::max<std::ptrdiff_t>(0, at - width / 2), line + std::min(length, at + width / 2)};
  } catch (const Error&) {
    return {};  // the file has gone meanwhile: the message goes without its excerpt
  }
}

void Reader::fail(const std::string& message, const Place& place) {
  constexpr int most_shown = 8;
  std::string text = message;
  int shown = 0;
  for (auto frame = frames_.rbegin(); frame != frames_.rend() && shown < most_shown; ++frame) {
    if (frame->call.line == 0) continue;
    const std::string where = to_string(location(frame->call));
    if (frame->kind == FrameKind::macro)
      text += fmt::format("; in macro {}, called at {}", frame->name, where), ++shown;
    else if (frame->kind == FrameKind::file)
      text += fmt::format("; in a file that is included at {}", where), ++shown;
  }
  throw Error(text, location(place), excerpt(place));
}

void Reader::too_deep(const Place& place) {
  fail(fmt::format("too deep: more than {} objects, textures and brackets lie within each other; "
                   "--nesting-limit raises that",
                   limits_.nested),
       place);
}

void Reader::too_many_levels(int most) {
  fail(fmt::format("too deep: more than {} objects, textures, functions or arrays are declared of each other",
                   most),
       last_);
}

void Reader::unexpected(const Token& token, const std::string& wanted) {
  if (token.kind == TokenKind::word && token.symbol->word == Word::none && token.symbol->bindings.empty())
    fail(fmt::format("{} is not declared{}", describe(token),
                     suggestion(token.symbol->name, symbols_.defined())),
         token.place);
  fail(fmt::format("{} is expected, not {}", wanted, describe(token)), token.place);
}

std::filesystem::path Reader::find_file(const std::string& name, const Place& place, const char* hint) {
  if (const auto path = find(search_, name)) return *path;
  if (const auto path = find(search_, name + ".ttf")) return *path;  // fonts without their extension
  std::string folders;
  for (const auto& folder : search_.folders)
    if (std::filesystem::is_directory(folder)) folders += (folders.empty() ? "" : ", ") + folder.string();
  fail(fmt::format(
           "there is no file \"{}\" in {}; POV-Ray's own are in the package povray-includes, others are "
           "found in the folders of --include and $POV_INC{}",
           name, folders.empty() ? "the working directory" : folders, hint),
       place);
}

std::string Reader::find_image(const std::string& name, const Place& place) {
  if (!replace_missing || find(search_, name)) return find_file(name, place, how_to_replace_missing).string();
  notes.dropped(fmt::format("cannot find the file \"{}\": grey 0.5 stands for it", name), location(place));
  return "";
}

// Scenes of version 3.7 without assumed_gamma have 1. Before, colours went to the screen as they were.
std::optional<double> Reader::gamma() const {
  if (assumed_gamma) return *assumed_gamma == srgb_gamma ? std::nullopt : assumed_gamma;
  return version >= 3.7 ? std::optional(1.0) : std::nullopt;
}

double Reader::linear(double value) const {
  if (!(value > 0)) return 0;
  if (!for_export) return value;
  const std::optional<double> exponent = gamma();
  if (exponent) return *exponent == 1 ? value : std::pow(value, *exponent);
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

}  // namespace vitrail::pov
