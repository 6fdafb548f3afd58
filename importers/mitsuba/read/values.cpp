// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/read/values.h"

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "scene/spectra/color.h"

namespace vitrail::mitsuba {

namespace {

bool is_separator(char c) { return c == ' ' || c == ',' || c == '\t' || c == '\n' || c == '\r' || c == ';'; }

std::string trimmed(const std::string& text) {
  const auto begin = text.find_first_not_of(" \t\r\n"), end = text.find_last_not_of(" \t\r\n");
  return begin == std::string::npos ? "" : text.substr(begin, end - begin + 1);
}

std::string shortened(const std::string& text) {
  return text.size() <= 40 ? text : text.substr(0, 37) + "...";
}

std::vector<std::string> words(const std::string& text) {
  std::vector<std::string> found;
  for (std::size_t i = 0; i < text.size();) {
    if (is_separator(text[i])) {
      ++i;
      continue;
    }
    std::size_t end = i;
    while (end < text.size() && !is_separator(text[end])) ++end;
    found.push_back(text.substr(i, end - i));
    i = end;
  }
  return found;
}

}  // namespace

double parse_number(const std::string& text, const Fail& fail) {
  const std::string word = trimmed(text);
  const char* begin = word.data() + (word.starts_with('+') ? 1 : 0);
  const char* end = word.data() + word.size();
  double value = 0;
  const auto result = fast_float::from_chars(begin, end, value);
  const char* rest = result.ptr;
  if (rest != end && (*rest == 'f' || *rest == 'F')) ++rest;
  if (result.ec != std::errc() || rest != end || !std::isfinite(value))
    fail(fmt::format("expected a finite number, found \"{}\"", shortened(text)));
  return value;
}

long long parse_integer(const std::string& text, const Fail& fail) {
  const std::string word = trimmed(text);
  long long value = 0;
  const auto result = std::from_chars(word.data(), word.data() + word.size(), value);
  if (result.ec != std::errc() || result.ptr != word.data() + word.size())
    fail(fmt::format("expected an integer, found \"{}\"", shortened(text)));
  return value;
}

bool parse_boolean(const std::string& text, const Fail& fail) {
  std::string word = trimmed(text);
  for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (word != "true" && word != "false")
    fail(fmt::format("expected true or false, found \"{}\"", shortened(text)));
  return word == "true";
}

std::vector<double> parse_numbers(const std::string& text, const Fail& fail) {
  std::vector<double> numbers;
  for (const std::string& word : words(text)) numbers.push_back(parse_number(word, fail));
  return numbers;
}

RGB parse_rgb(const std::string& text, const Fail& fail) {
  const std::string word = trimmed(text);
  if (word.starts_with('#')) {
    unsigned value = 0;
    const auto result = std::from_chars(word.data() + 1, word.data() + word.size(), value, 16);
    if (word.size() != 7 || result.ec != std::errc() || result.ptr != word.data() + word.size())
      fail(fmt::format("expected a colour as #rrggbb, found \"{}\"", shortened(text)));
    const auto channel = [&](int shift) { return srgb_decode(((value >> shift) & 255u) / 255.0); };
    return {channel(16), channel(8), channel(0)};
  }
  const std::vector<double> numbers = parse_numbers(text, fail);
  if (numbers.size() == 1) return {numbers[0], numbers[0], numbers[0]};
  if (numbers.size() != 3) fail(fmt::format("a colour needs 3 numbers, has {}", numbers.size()));
  return {numbers[0], numbers[1], numbers[2]};
}

SpectrumValue parse_spectrum(const std::string& text, const Fail& fail) {
  SpectrumValue spectrum;
  if (text.find(':') == std::string::npos) {
    spectrum.constant = parse_number(text, fail);
    return spectrum;
  }
  for (const std::string& word : words(text)) {
    const auto colon = word.find(':');
    if (colon == std::string::npos)
      fail(fmt::format("expected wavelength:value, found \"{}\"", shortened(word)));
    spectrum.samples.push_back(
        {parse_number(word.substr(0, colon), fail), parse_number(word.substr(colon + 1), fail)});
  }
  return spectrum;
}

}  // namespace vitrail::mitsuba
