// SPDX-License-Identifier: Apache-2.0
#include "importers/spectra/spectrum_text.h"

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <cmath>

#include "scene/system/diagnostics.h"

namespace vitrail {

bool parse_padded_number(std::string_view text, double& number) {
  constexpr const char* blanks = " \t\r\n\v\f";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == text.npos) return false;
  text = text.substr(first, text.find_last_not_of(blanks) - first + 1);
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  const char* end = text.data() + text.size();
  const auto result = fast_float::from_chars(text.data(), end, number);
  return result.ec == std::errc() && result.ptr == end && std::isfinite(number);
}

SpectrumFile parse_spectrum_text(std::string_view text, const std::string& name) {
  constexpr const char* separators = " \t\r\v\f,;";
  SpectrumFile file;
  bool waits = false;  // for the value of a wavelength
  double wavelength = 0;
  int line = 0;
  while (!text.empty()) {
    ++line;
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view rest = text.substr(0, end);
    const char* const line_begin = rest.data();
    text.remove_prefix(std::min(end + 1, text.size()));
    rest = rest.substr(0, rest.find('#'));
    for (std::size_t at; (at = rest.find_first_not_of(separators)) != rest.npos;) {
      rest.remove_prefix(at);
      const std::string_view word = rest.substr(0, rest.find_first_of(separators));
      const auto column = static_cast<int>(word.data() - line_begin) + 1;
      double number = 0;
      if (!parse_padded_number(word, number))
        throw Error("expected a number in a spectrum file", {name, line, column},
                    std::string(word.substr(0, 80)));
      if (waits) file.rows.push_back({wavelength, {number}});
      wavelength = number;
      waits = !waits;
      rest.remove_prefix(word.size());
    }
  }
  if (waits) file.repairs.emplace_back("its last wavelength has no value and is left out");
  return file;
}

}  // namespace vitrail
