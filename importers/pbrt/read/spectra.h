// SPDX-License-Identifier: Apache-2.0
// These parameters are spectra: numbers, rgb, xyz, blackbody, samples, files, names.
#pragma once

#include <string>

#include "importers/pbrt/read/context.h"
#include "importers/pbrt/read/parameters.h"
#include "scene/spectra/spectrum.h"

namespace vitrail::pbrt {

struct SpectrumScope {
  Context& context;
  const std::string& color_space;  // of rgb values
};

// Reads a reflectance, which is in [0,1] where it is given as a colour.
Spectrum read_reflectance(const Parameter& parameter, SpectrumScope scope);

// Reads a factor or coefficient as read_reflectance does, but colours may exceed 1.
Spectrum read_unbounded(const Parameter& parameter, SpectrumScope scope);

// Reads emission times `factor`, in the units of the version. v4 divides every light by its own luminance, so
// that only `scale` and the like set it: spectra and blackbodies get luminance 1, rgb keeps its magnitude. v3
// keeps spectra as they are and normalises blackbodies to a maximum of 1, times their second value.
Spectrum read_emission(const Parameter& parameter, double factor, SpectrumScope scope);

// Reads an index of refraction; it is held constant outside of its samples.
Spectrum read_refraction(const Parameter& parameter, SpectrumScope scope);

// Returns where the file that a parameter names has to be (missing_files.h asks whether it is there).
std::string find_file(const Parameter& parameter, Context& context);

}  // namespace vitrail::pbrt
