// SPDX-License-Identifier: Apache-2.0
#include "importers/obj/read/mtl_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace vitrail::obj {

namespace {

bool is_same_name(const std::string& a, const std::string& b) {
  return std::ranges::equal(a, b, [](char x, char y) { return lower_case(x) == lower_case(y); });
}

class MapReader {
 public:
  MapReader(TextCursor& cursor, const std::string& keyword, const Drop& drop)
      : cursor_(cursor), keyword_(keyword), drop_(drop) {}

  MtlMap read_options() {
    while (true) {
      TextCursor ahead = cursor_;
      std::string option(ahead.word());
      std::ranges::transform(option, option.begin(), lower_case);
      if (!option.starts_with('-') || !is_option(option)) return map_;
      cursor_ = ahead;
      read_option(option);
    }
  }

 private:
  static bool is_option(const std::string& word) {
    static constexpr std::array<std::string_view, 14> options{
        "-s",      "-o",     "-t",      "-bm",      "-mm",   "-clamp", "-blendu",
        "-blendv", "-boost", "-texres", "-imfchan", "-type", "-cc",    "-colorspace"};
    return std::ranges::count(options, word) > 0;
  }

  void read_option(const std::string& option) {
    if (option == "-s") {
      const auto [u, v] = read_pair(1);
      map_.mapping.a = u;
      map_.mapping.e = v;
    } else if (option == "-o") {
      const auto [u, v] = read_pair(0);
      map_.mapping.c = u;
      map_.mapping.f = v;
    } else if (option == "-t") {
      if (read_pair(0) != std::pair{0.0f, 0.0f}) lost(option);
    } else if (option == "-bm") {
      map_.bump_multiplier = number();
    } else if (option == "-mm") {
      const float base = number();
      map_.gain = number();
      if (base != 0) lost(option);
    } else if (option == "-clamp") {
      if (is_same_name(std::string(cursor_.word()), "on")) map_.wrap = Wrap::clamp;
    } else if (option == "-boost" || option == "-texres") {
      number();  // of filtering
    } else if (option == "-imfchan") {
      read_channel();
    } else {
      const std::string value(cursor_.word());
      const bool is_plain = option.starts_with("-blend") || (option == "-cc" && value == "off") ||
                            (option == "-colorspace" && is_same_name(value, is_color() ? "sRGB" : "linear"));
      if (!is_plain) lost(option + " " + value);
    }
  }

  bool is_color() const { return keyword_ == "map_Kd" || keyword_ == "map_Ks" || keyword_ == "map_Ke"; }

  void read_channel() {
    static constexpr std::string_view letters = "rgbml";
    static constexpr std::array numbers{ImageNumber::red, ImageNumber::green, ImageNumber::blue,
                                        ImageNumber::alpha, ImageNumber::luminance};
    const std::string letter(cursor_.word());
    const std::size_t channel = letters.find(letter);
    if (letter.size() != 1 || channel == letters.npos || is_color() || keyword_ == "norm")
      return lost("-imfchan " + letter);
    map_.number = numbers.at(channel);
  }

  void lost(const std::string& what) { drop_(fmt::format("{} of {}", printable(what), keyword_)); }

  float number() {
    const double value = cursor_.number("an option's value");
    const auto rounded = static_cast<float>(value);
    if (!std::isfinite(rounded)) cursor_.fail("an option's value is not finite");
    return rounded;
  }

  bool number_follows() {
    TextCursor ahead = cursor_;
    const std::string_view word = ahead.word();
    const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
    return !word.empty() && std::ranges::any_of(word, is_digit) &&
           word.find_first_not_of("0123456789+-.eE") == std::string_view::npos;
  }

  // "u", "u v" or "u v w": the second is `unset` where it is not there.
  std::pair<float, float> read_pair(float unset) {
    const float u = number();
    float v = unset;
    if (number_follows()) v = number();
    if (number_follows()) number();  // of solid textures
    return {u, v};
  }

  TextCursor& cursor_;
  const std::string& keyword_;
  const Drop& drop_;
  MtlMap map_;
};

}  // namespace

MtlMap read_map(TextCursor& cursor, const std::string& keyword, const std::filesystem::path& folder,
                const Drop& drop) {
  MtlMap map = MapReader(cursor, keyword, drop).read_options();
  std::string name(cursor.rest_of_line());
  if (name.size() >= 2 && name.front() == '"' && name.back() == '"') name = name.substr(1, name.size() - 2);
  if (name.empty()) cursor.fail(fmt::format("{} without a file name", keyword));
  map.filename = named_file(name, folder);
  return map;
}

}  // namespace vitrail::obj
