// SPDX-License-Identifier: Apache-2.0
#include "importers/pbrt/spectrum_names.h"

#include <array>

namespace vitrail::pbrt {

namespace {

struct Illuminant {
  std::string_view name;
  double kelvin;  // correlated colour temperature
};

constexpr std::array<Illuminant, 14> illuminants{{{"stdillum-D50", 5003},
                                                  {"illum-acesD60", 6000},
                                                  {"stdillum-F1", 6430},
                                                  {"stdillum-F2", 4230},
                                                  {"stdillum-F3", 3450},
                                                  {"stdillum-F4", 2940},
                                                  {"stdillum-F5", 6350},
                                                  {"stdillum-F6", 4150},
                                                  {"stdillum-F7", 6500},
                                                  {"stdillum-F8", 5000},
                                                  {"stdillum-F9", 4150},
                                                  {"stdillum-F10", 5000},
                                                  {"stdillum-F11", 4000},
                                                  {"stdillum-F12", 3000}}};

}  // namespace

std::optional<double> illuminant_temperature(std::string_view name) {
  for (const Illuminant& illuminant : illuminants)
    if (name == illuminant.name) return illuminant.kelvin;
  return std::nullopt;
}

std::optional<RGB> metal_reflectance(std::string_view name) {
  if (name == "metal-CuZn-eta" || name == "metal-CuZn-k") return RGB{0.910, 0.778, 0.423};
  return std::nullopt;
}

}  // namespace vitrail::pbrt
