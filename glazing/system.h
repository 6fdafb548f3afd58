// SPDX-License-Identifier: Apache-2.0
// A system is panes one behind another, and what all of them together let through and reflect.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "glazing/gas.h"
#include "glazing/pane.h"
#include "glazing/pane_heat.h"
#include "glazing/states.h"
#include "glazing/streams.h"

namespace vitrail {

// A GlazingLayer is a pane and the gap behind it.
struct GlazingLayer {
  std::string name;
  Pane pane;
  bool flipped = false;      // its front looks inside
  double gap_behind_mm = 0;  // says nothing about light: gaps absorb none
  // They are the states of glass that switches; `pane` is what it is `at`, one of them or between them. If
  // by_temperature, `at` is a temperature.
  std::vector<StateRows> states{};
  bool by_temperature = false;
  std::optional<double> at{};  // none: as the product says, which is no one of its states
  std::optional<PhotochromicLight> light{};
  double thickness_mm = 0;  // 0 where it is unknown; light does not need it, nor the others below
  PaneHeat heat{};
  GasMixture gas_behind{};
};

// A GlazingSystem has panes and gaps, one behind the other.
struct GlazingSystem {
  std::string name;
  std::vector<GlazingLayer> layers;  // from outside; at least one
};

// Returns whether a pane of it switches.
bool switches(const GlazingSystem& system);

// A Quantity is what panes that switch can be set to. All but thermochromic panes take the state, in [0, 1];
// thermochromic and photochromic ones the temperature in °C. Photochromic ones take the ultraviolet light on
// them in W/m², and for how long, in seconds, from their first state on.
enum class Quantity { state, temperature, uv, seconds };

// Brings all panes that know the quantity to the value. Returns false where there are none.
bool set(GlazingSystem& system, Quantity quantity, double value);

// Returns the first value that a pane has of it, or none. Infinite seconds are the equilibrium.
std::optional<double> value_of(const GlazingSystem& system, Quantity quantity);

// Polarisation is how light between panes is treated. WINDOW takes the mean of both at each pane; the exact
// series keeps them apart, which matters beyond 45° or so (docs/why/glazing.md has the difference).
enum class Polarisation { mixed_at_panes, apart };

// Returns whether a pane of it scatters light.
bool scatters_light(const GlazingSystem& system);
// Lets all that its panes scatter go straight on.
void forget_scattering(GlazingSystem& system);

// Returns what all panes do together with light from one direction, with
// all reflections between them. A pane scatters the same part of it at
// all angles; diffuse light meets each pane as it is over the hemisphere.
Streams system_streams(const GlazingSystem& system, double nm, double cosine, Polarisation polarisation);

// Returns T, front and back reflectance of the whole, direct and scattered together. T is that from the
// front; where nothing scatters it is the same from both sides.
PaneValues system_values(const GlazingSystem& system, double nm, double cosine, Polarisation polarisation);

// Returns which shares of light from outside the panes absorb: with T and Rf of the whole they sum to 1.
std::vector<double> absorbed_shares(const GlazingSystem& system, double nm, double cosine,
                                    Polarisation polarisation);

// Returns the wavelengths of all panes together, where all of them have some; nm, ascending.
// Throws Error where there are none.
std::vector<double> common_wavelengths(const GlazingSystem& system);

// Returns a note where not all panes, in all of their states, have data from `first_nm`
// to `last_nm`; empty where they have.
std::string held_note(const GlazingSystem& system, double first_nm, double last_nm);

// A SystemSpectrum has values of the whole system by wavelength.
struct SystemSpectrum {
  std::vector<double> nm;  // ascending
  std::vector<PaneValues> values;
};

// Returns system_values at each of these wavelengths, in nm.
SystemSpectrum spectrum_at(const GlazingSystem& system, std::vector<double> nm, double cosine,
                           Polarisation polarisation);

// The rules sum light from all of the hemisphere alike: 2 ∫ f(θ) cos θ sin θ dθ.
enum class HemisphereRule {
  gauss,        // Gauss and Legendre's of 16 points in the cosine: exact to 1e-5 and better
  each_10_deg,  // the trapezoidal of WinCalc, which loses up to 0.008 of a reflectance
};
SystemSpectrum hemispherical_spectrum(const GlazingSystem& system, std::vector<double> nm,
                                      Polarisation polarisation, HemisphereRule rule);

// Returns absorbed_shares at each of these wavelengths, in place of T: one spectrum for each pane. Without
// a cosine they are of the hemisphere.
std::vector<SystemSpectrum> absorbed_spectra(const GlazingSystem& system, const std::vector<double>& nm,
                                             std::optional<double> cosine, Polarisation polarisation);

}  // namespace vitrail
