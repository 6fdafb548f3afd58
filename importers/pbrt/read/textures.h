// SPDX-License-Identifier: Apache-2.0
// These functions read Texture directives, and parameters that may be textures.
#pragma once

#include <initializer_list>
#include <string>
#include <unordered_map>
#include <vector>

#include "importers/pbrt/read/spectra.h"
#include "scene/records/scene.h"

namespace vitrail::pbrt {

// It has textures by name. A constant one is its value.
struct TextureTable {
  std::unordered_map<std::string, SpectrumParameter> spectra;
  std::unordered_map<std::string, FloatParameter> numbers;
};

struct Scope : SpectrumScope {
  const TextureTable& textures;
  std::vector<Texture>& made;  // the scene's
  Origin origin;               // of what is being read
};

// `unbounded` is a factor or coefficient, whose colour may exceed 1.
enum class Quantity { reflectance, unbounded, refraction };

// They return the first of `names` that the parameters have, as a value or a texture; else `otherwise`. A
// texture that is not defined throws Error.
SpectrumParameter spectrum_parameter(ParameterSet& parameters, std::initializer_list<std::string_view> names,
                                     Quantity quantity, const Spectrum& otherwise, const Scope& scope);
FloatParameter float_parameter(ParameterSet& parameters, std::initializer_list<std::string_view> names,
                               double otherwise, const Scope& scope);
// Returns a value where a texture cannot be: a texture throws Error.
Spectrum spectrum_value(ParameterSet& parameters, std::initializer_list<std::string_view> names,
                        Quantity quantity, const Spectrum& otherwise, const Scope& scope);

// Returns whether every texture that the parameters refer to is in the table.
bool textures_are_known(const ParameterSet& parameters, const TextureTable& textures);

// They make the texture of a Texture directive: `kind` is its third word, `name` its first; `ctm` takes
// texture space to the world.
SpectrumParameter make_spectrum_texture(const std::string& kind, const std::string& name,
                                        ParameterSet& parameters, const Transform& ctm, const Scope& scope);
FloatParameter make_float_texture(const std::string& kind, const std::string& name, ParameterSet& parameters,
                                  const Transform& ctm, const Scope& scope);

// Adds an image that a material or light names by its file alone, as a new texture without a name.
Id<Texture> add_image(const Parameter& filename, Encoding encoding, const Scope& scope);

}  // namespace vitrail::pbrt
