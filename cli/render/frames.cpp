// SPDX-License-Identifier: Apache-2.0
#include "cli/render/frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <fstream>

#include "scene/system/diagnostics.h"
#include "scene/system/input_files.h"

namespace vitrail {

namespace {

// What changes the picture, and neither the film's kind nor the job.
constexpr const char* of_frames[] = {"--camera", "--look-at", "--fov",  "--sky",
                                     "--lamps",  "--set",     "--seed", "--spp"};

bool may_have(const std::string& word) {
  return std::ranges::find(of_frames, word.substr(0, word.find('='))) != std::end(of_frames);
}

std::vector<ListedFrame::Word> words_of(const std::string& line) {
  constexpr const char* blanks = " \t\r\v\f";
  const std::string text = line.substr(0, line.find('#'));
  std::vector<ListedFrame::Word> words;
  for (std::size_t end = 0, begin; (begin = text.find_first_not_of(blanks, end)) != text.npos;) {
    end = std::min(text.find_first_of(blanks, begin), text.size());
    words.push_back({text.substr(begin, end - begin), static_cast<int>(begin) + 1});
  }
  return words;
}

// What stands around "%04d".
struct NumberedName {
  std::string before, after;
  std::size_t digits = 0;
};

NumberedName parts_of(const std::filesystem::path& name) {
  const std::string text = name.string();
  const std::size_t begin = text.find('%');
  std::size_t end = begin == text.npos ? begin : begin + 1;
  while (end < text.size() && std::isdigit(static_cast<unsigned char>(text[end])) != 0) ++end;
  if (end == text.npos || end >= text.size() || text[end] != 'd' || text.find('%', end) != text.npos ||
      end - begin > 3)
    throw UsageError("--frames numbers its pictures: --output needs one %04d, as in day%04d.png: " + text);
  NumberedName parts{text.substr(0, begin), text.substr(end + 1)};
  std::from_chars(text.data() + begin + 1, text.data() + end, parts.digits);
  return parts;
}

}  // namespace

bool is_option(const std::string& word) {
  return word.size() > 1 && word[0] == '-' &&
         (word[1] == '-' || std::isalpha(static_cast<unsigned char>(word[1])) != 0);
}

std::vector<ListedFrame> read_frames(const std::filesystem::path& file) {
  note_input(file);
  std::ifstream in = open_regular(file);
  if (!in) throw Error("cannot read the frames", {file.string()});
  std::vector<ListedFrame> frames;
  int line = 0;
  for (std::string text; std::getline(in, text);) {
    ListedFrame frame{frames.size() + 1, ++line, words_of(text), text};
    if (!frame.words.empty()) frames.push_back(std::move(frame));
  }
  if (frames.empty()) throw Error("there is no frame: a line of options is one", {file.string()});
  return frames;
}

void require_options_of_frames(const ListedFrame& frame, const std::filesystem::path& file) {
  for (const ListedFrame::Word& word : frame.words)
    if (is_option(word.text) && !may_have(word.text))
      throw Error(fmt::format("a frame has {}, but not {}", fmt::join(of_frames, ", "), word.text),
                  {file.string(), frame.line, word.column}, frame.text);
}

std::filesystem::path numbered(const std::filesystem::path& name, std::size_t number) {
  const NumberedName parts = parts_of(name);
  return parts.before + fmt::format("{:0{}}", number, parts.digits) + parts.after;
}

std::filesystem::path record_path(const std::filesystem::path& name) {
  const NumberedName parts = parts_of(name);
  return parts.before + "frames" + parts.after + ".json";
}

}  // namespace vitrail
