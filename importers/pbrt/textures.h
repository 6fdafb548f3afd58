// SPDX-License-Identifier: Apache-2.0
// Textures are read in full, but only constants can be shaded: each texture is represented by one value.
#pragma once

#include <initializer_list>
#include <string>
#include <unordered_map>

#include "importers/pbrt/spectra.h"

namespace vitrail::pbrt {

struct Texture {
  Spectrum value;
  std::string approximation;  // what stands for it, or "" where the texture is constant
};

struct TextureTable {
  std::unordered_map<std::string, Texture> spectra, numbers;
};

struct Scope : SpectrumScope {
  const TextureTable& textures;
};

enum class Quantity { reflectance, refraction };

// The first of `names` that the parameters have, as a value or a texture; else `otherwise`. The use of a
// texture that is not constant is reported; one that is not defined throws Error.
Spectrum spectrum_value(ParameterSet& parameters, std::initializer_list<std::string_view> names,
                        Quantity quantity, const Spectrum& otherwise, const Scope& scope);
double number_value(ParameterSet& parameters, std::string_view name, double otherwise, const Scope& scope);

// True if every texture that the parameters refer to is in the table.
bool textures_are_known(const ParameterSet& parameters, const TextureTable& textures);

// The texture of a Texture directive: `kind` is its third word, `spectral` whether its second is spectrum.
Texture make_texture(const std::string& kind, bool spectral, ParameterSet& parameters, const Scope& scope);

}  // namespace vitrail::pbrt
