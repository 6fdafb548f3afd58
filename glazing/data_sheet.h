// SPDX-License-Identifier: Apache-2.0
// A data sheet has all figures of a glazing, for each of its states.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "glazing/color_fidelity.h"
#include "glazing/evaluation.h"
#include "glazing/heat_balance.h"
#include "glazing/scattering.h"

namespace vitrail {

// StandardValues are those at normal incidence by one standard's weights.
struct StandardValues {
  std::string standard;
  PaneValues visible, solar;
  double ultraviolet_t = 0;
};

// AngleValues are for light from one direction, by NFRC 300-2003. `absorbed` is each pane's part of the sun.
struct AngleValues {
  std::optional<double> theta_deg;  // none: the hemisphere
  PaneValues visible, solar;
  std::vector<double> absorbed;
  std::optional<double> shgc;  // where the panes say what heat needs
};

// They are U in W/(m²K) and g in parts of 1 (glazing/heat_balance.h, glazing/en_673.h), and the temperatures
// at night in winter and in the sun of summer.
struct HeatValues {
  double u_nfrc = 0;
  std::optional<double> u_en_673,
      g_en_410;  // where no pane lets infrared through, as these standards have it
  HeatBalance winter, summer;
};

// A DataSheetState has all figures of one state.
struct DataSheetState {
  std::string name;  // "state 0.5", "40 °C"; empty where nothing switches
  std::vector<StandardValues> standards;
  std::vector<AngleValues> angles;  // each 10° from 0° to 90°, then the hemisphere
  std::optional<double> color_rendering;
  std::optional<ColorFidelity> color_fidelity;
  std::optional<HeatValues> heat;
  SystemSpectrum normal;  // 300 to 2500 nm
};

// A DataSheet is a glazing in each of its states.
struct DataSheet {
  GlazingSystem system;
  Polarisation polarisation = Polarisation::apart;
  std::string why_no_heat;  // empty where there is
  std::vector<DataSheetState> states;
  std::vector<PaneScattering> scattering;
};

// A NamedState is a system in one of its states; the name is as above.
struct NamedState {
  std::string name;
  GlazingSystem system;
};
std::vector<NamedState> states_of(const GlazingSystem& system);

// Evaluates the system; one that switches, in each measured state and in the one that it is in. Throws
// Error.
DataSheet data_sheet(const GlazingSystem& system, Polarisation polarisation);

}  // namespace vitrail
