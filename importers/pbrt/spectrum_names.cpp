// SPDX-License-Identifier: Apache-2.0
#include "importers/pbrt/spectrum_names.h"

#include <fmt/format.h>

#include <array>

#include "scene/named_spectra.h"

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

struct Metal {
  std::string_view name;
  RGB reflectance;
};

constexpr std::array<Metal, 7> metals{{{"Ag", {0.972, 0.960, 0.915}},
                                       {"Al", {0.913, 0.922, 0.924}},
                                       {"Au", {1.000, 0.766, 0.336}},
                                       {"Cu", {0.955, 0.638, 0.538}},
                                       {"CuZn", {0.910, 0.778, 0.423}},
                                       {"MgO", {0.072, 0.073, 0.075}},
                                       {"TiO2", {0.170, 0.180, 0.200}}}};

}  // namespace

std::optional<NamedSpectrum> find_named_spectrum(const std::string& name) {
  if (const auto known = named_spectrum(name)) return NamedSpectrum{*known, {}};
  for (const Illuminant& illuminant : illuminants)
    if (name == illuminant.name)
      return NamedSpectrum{blackbody(illuminant.kelvin),
                           fmt::format("a blackbody of {} K", illuminant.kelvin)};
  return std::nullopt;
}

std::optional<RGB> metal_reflectance(std::string_view name) {
  constexpr std::string_view prefix = "metal-";
  if (!name.starts_with(prefix)) return std::nullopt;
  name.remove_prefix(prefix.size());
  const std::string_view metal = name.substr(0, name.rfind('-'));
  for (const Metal& known : metals)
    if (metal == known.name) return known.reflectance;
  return std::nullopt;
}

}  // namespace vitrail::pbrt
