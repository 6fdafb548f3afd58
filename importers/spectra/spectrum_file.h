// SPDX-License-Identifier: Apache-2.0
// Files of measured spectra, by what they look like, whatever their name:
//   - text (.spd): pairs of a wavelength in nm and a value, separated by blanks, commas or semicolons; #
//   begins
//     a comment; 0 outside of the samples;
//   - XML: a root element with <entry wavelength="nm" …/> elements, linear in between, the ends held. By
//   their
//     attributes: `value` (a reflectance or an illuminant), `x y z` (an observer), `n` with `kappa` (k = n·κ)
//     or `k` (an index of refraction), `k s` (a pigment's absorption and scattering).
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "scene/spectra/spectrum.h"

namespace vitrail {

struct SpectrumFile {
  enum class Kind { value, observer, index, pigment };
  struct Row {
    double lambda_nm = 0;
    std::array<double, 3> v{};  // value; x, y, z; n, k; k, s: the rest is 0
  };
  Kind kind = Kind::value;
  std::vector<Row> rows;  // ascending, each wavelength once; at least one
  bool holds_ends = false;
  std::vector<std::string> repairs;  // what was wrong and how it is read: for diagnostics
};

// Rows may come in any order; those of one wavelength become their mean. Throws Error with the line.
SpectrumFile read_spectrum_file(const std::filesystem::path& file);

// Which of an index of refraction is asked for; means nothing for other kinds.
enum class SpectrumPart { n, k };

// As one spectrum. A pigment is the reflectance of an opaque layer, 1 + K/S − √((K/S)² + 2K/S) (Kubelka and
// Munk 1931), with K and S linear in between. Throws Error for an observer.
Spectrum spectrum_of(const SpectrumFile& file, SpectrumPart part, bool hold_ends);

}  // namespace vitrail
