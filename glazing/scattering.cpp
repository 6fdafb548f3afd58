// SPDX-License-Identifier: Apache-2.0
#include "glazing/scattering.h"

#include <fmt/format.h>

#include <utility>

#include "glazing/evaluation.h"

namespace vitrail {

namespace {

PaneValues weighted(const OpticalRows& rows, const char* method, bool flipped) {
  SystemSpectrum spectrum;
  for (const OpticalRow& row : rows) {
    spectrum.nm.push_back(row.nm);
    spectrum.values.push_back(row.at);
  }
  PaneValues values = average(spectrum, *find_method(nfrc_2003(), method));
  if (flipped) std::swap(values.rf, values.rb);
  return values;
}

}  // namespace

std::vector<PaneScattering> scattering_of(const GlazingSystem& system) {
  std::vector<PaneScattering> panes;
  for (std::size_t i = 0; i < system.layers.size(); ++i) {
    const GlazingLayer& layer = system.layers[i];
    const auto* pane = std::get_if<MeasuredPane>(&layer.pane);
    if (!pane || pane->scattered.empty()) continue;
    panes.push_back({i, weighted(pane->rows, "PHOTOPIC", layer.flipped),
                     weighted(pane->rows, "SOLAR", layer.flipped),
                     weighted(pane->scattered, "PHOTOPIC", layer.flipped),
                     weighted(pane->scattered, "SOLAR", layer.flipped)});
  }
  return panes;
}

std::vector<std::string> scattering_notes(const GlazingSystem& system) {
  std::vector<std::string> notes;
  for (const PaneScattering& of : scattering_of(system)) {
    const PaneValues &all = of.visible, &part = of.visible_scattered;
    notes.push_back(fmt::format(
        "pane {} scatters {:.3f} of its T {:.3f}, {:.3f} of its R outside {:.3f} and {:.3f} of its R inside "
        "{:.3f} (light, at the normal); it is taken to scatter the same parts at other angles, in all "
        "directions alike",
        of.pane + 1, part.t, all.t, part.rf, all.rf, part.rb, all.rb));
  }
  return notes;
}

}  // namespace vitrail
