// SPDX-License-Identifier: Apache-2.0
// These functions report panes that scatter light: frits, etched and opal glass.
#pragma once

#include <string>
#include <vector>

#include "glazing/system.h"

namespace vitrail {

// One pane alone, as it stands in its system, lets through and reflects so much in all, and scatters this
// part of it in all directions. Values are at normal incidence, by NFRC 300-2003.
struct PaneScattering {
  std::size_t pane = 0;  // from outside, from 0
  PaneValues visible, solar, visible_scattered, solar_scattered;
};

// Returns the panes that scatter; none where no pane does.
std::vector<PaneScattering> scattering_of(const GlazingSystem& system);

// Returns the same in words, and the assumptions about scattering (streams.h).
std::vector<std::string> scattering_notes(const GlazingSystem& system);

}  // namespace vitrail
