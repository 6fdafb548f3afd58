// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <string_view>

namespace vitrail {

// It holds samples of the index of refraction eta + i·k: (wavelength in nm, value), ascending.
struct MetalTable {
  std::string_view name;  // "Au"; a crystal axis or a second source is part of it: "TiO2-e", "Cu_palik"
  std::span<const std::array<float, 2>> eta, k;
};

std::span<const MetalTable> metal_tables();

}  // namespace vitrail
