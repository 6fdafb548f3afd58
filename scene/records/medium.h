// SPDX-License-Identifier: Apache-2.0
// A medium fills space between surfaces.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scene/geometry/bounds.h"
#include "scene/geometry/transform.h"
#include "scene/records/origin.h"
#include "scene/spectra/spectrum.h"

namespace vitrail {

// It says which values a grid has outside of its cells: those of the other end, those of the edge (Mitsuba),
// or 0 (pbrt). With the last, values fall to half from the centres of the outermost cells to the edge.
enum class GridEdge : std::uint8_t { repeated, held, zero };

// It holds values on a regular grid over a box, linear in between, given here or in a file (Mitsuba's .vol,
// NanoVDB). Three channels are linear sRGB. Between cells Mitsuba averages hues and brightnesses, pbrt
// spectra; so do grids of its edges.
struct Grid {
  std::string filename;  // "" where `values` holds them
  std::string field;     // of a NanoVDB file: "density"
  int nx = 0, ny = 0, nz = 0, channels = 1;
  std::vector<float> values;  // x fastest, channels interleaved
  Bounds3d bounds{{0, 0, 0}, {1, 1, 1}};
  GridEdge edge = GridEdge::held;
  bool operator==(const Grid&) const = default;
};

using VolumeParameter = std::variant<Spectrum, Grid>;

// It holds coefficients per unit of length, in the form that the file gives.
struct AbsorptionScattering {
  VolumeParameter sigma_a = ConstantSpectrum{1}, sigma_s = ConstantSpectrum{1};
  bool operator==(const AbsorptionScattering&) const = default;
};
// It holds σ_t and the share of it that scatters.
struct ExtinctionAlbedo {
  VolumeParameter sigma_t = ConstantSpectrum{1}, albedo = ConstantSpectrum{0.75f};
  bool operator==(const ExtinctionAlbedo&) const = default;
};
// It is a name of pbrt's list of measured media: "Skin1".
struct NamedMedium {
  std::string name;
  bool operator==(const NamedMedium&) const = default;
};

// It is pbrt's procedural cloud.
struct CloudDensity {
  Bounds3d bounds{{0, 0, 0}, {1, 1, 1}};
  float density = 1, wispiness = 1, frequency = 5;
  bool operator==(const CloudDensity&) const = default;
};

// It holds POV-Ray's fade_distance, fade_power and fade_color. When light ends a distance d in the medium
// where the medium does, it leaves color + (1 − color)/(1 + (d/distance)^power), and from a power of 1000 on
// e^(−(1 − color)·d/distance). Where something within is met first, nothing is lost.
struct InteriorFade {
  float distance = 1, power = 2;
  Spectrum color = ConstantSpectrum{0};
  bool operator==(const InteriorFade&) const = default;
};

// It fills a space: it absorbs, scatters and shines.
struct Medium {
  std::string name;
  std::variant<AbsorptionScattering, ExtinctionAlbedo, NamedMedium> coefficients;
  float scale = 1;                                           // multiplies the coefficients
  std::variant<std::monostate, Grid, CloudDensity> density;  // multiplies them too, from place to place
  std::optional<Spectrum> emission;                          // radiance per unit of length
  std::optional<Grid> emission_scale;                        // multiplies it, from place to place
  std::optional<Grid> temperature;                           // emission as a blackbody, K
  float emission_factor = 1;
  float temperature_scale = 1, temperature_offset = 0;
  float g = 0;  // Henyey and Greenstein; 0 is isotropic
  // It is POV-Ray's atmosphere: it weakens light that is seen, and not light that lamps with a Fading send
  // straight to a point.
  bool veils = false;
  std::optional<InteriorFade>
      fade;  // in place of all above; the coefficients are its nearest, for other formats
  Transform medium_to_world;
  Origin origin;
  bool operator==(const Medium&) const = default;
};

}  // namespace vitrail
