// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "importers/mitsuba/write/write_context.h"
#include "scene/spectra/color.h"

namespace vitrail::mitsuba_writer {

// It says what Mitsuba takes a colour for, which differs by the place where it stands.
enum class Meaning { reflectance, unbounded, emission };

void add_spectrum(Element parent, const std::string& name, const Spectrum& spectrum, Meaning meaning);

// Returns the linear sRGB colour of a reflectance or factor under D65.
RGB color_of(const Spectrum& spectrum);
// Returns one number for a spectrum where Mitsuba takes no more: the value itself, or the luminance.
double number_of(Context& context, const Spectrum& spectrum, const char* what);
// Returns the index of refraction at the sodium D line, 589.3 nm, by which glasses are named.
double index_of_refraction(Context& context, const Spectrum& spectrum);

// Returns f at every wavelength of the tables.
template <class F>
Spectrum tabulated(F&& f) {
  TabulatedSpectrum table;
  for (int i = 0; i < table_size; ++i) table.values.push_back(static_cast<float>(f(lambda_min_nm + i)));
  return table;
}

}  // namespace vitrail::mitsuba_writer
