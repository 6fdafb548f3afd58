// SPDX-License-Identifier: Apache-2.0
// A file of measured spectra is read by what it looks like, whatever its name:
//   - Text (.spd) has pairs of a wavelength in nm and a value, separated by blanks, commas or semicolons;
//     # begins a comment. The spectrum is 0 outside of the samples.
//   - XML has a root element with <entry wavelength="nm" …/> elements. The spectrum is linear in between,
//     and its ends are held. Attributes tell the kind: `value` (a reflectance or an illuminant), `x y z` (an
//     observer), `n` with `kappa` (k = n·κ) or `k` (an index of refraction), `k s` (a pigment's absorption
//     and scattering).
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

// Reads rows in any order; those of one wavelength become their mean. Throws Error with the line.
SpectrumFile read_spectrum_file(const std::filesystem::path& file);

// It says which part of an index of refraction is asked for; it means nothing for other kinds.
enum class SpectrumPart { n, k };

// Returns the file as one spectrum. A pigment is the reflectance of an opaque layer, 1 + K/S − √((K/S)² +
// 2K/S) (Kubelka and Munk 1931), with K and S linear in between. Throws Error for an observer.
Spectrum spectrum_of(const SpectrumFile& file, SpectrumPart part, bool hold_ends);

}  // namespace vitrail
