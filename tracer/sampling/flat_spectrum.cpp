// SPDX-License-Identifier: Apache-2.0
#include "tracer/sampling/flat_spectrum.h"

#include "scene/spectra/color.h"

namespace vitrail {

namespace {

void set_shape(FlatSpectrum& flat, const SigmoidSpectrum& shape) {
  flat.c0 = shape.c0, flat.c1 = shape.c1, flat.c2 = shape.c2;
}
void set_table(FlatSpectrum& flat, const float* table) { flat.has_table = true, flat.table = table; }

}  // namespace

const float* table_of_ones() {
  static const std::vector<float> ones(table_size, 1.0f);
  return ones.data();
}

FlatSpectrum flat_spectrum(const Spectrum& spectrum, float factor) {
  FlatSpectrum flat;
  flat.factor = factor;
  if (const auto* constant = std::get_if<ConstantSpectrum>(&spectrum)) {
    flat.scale = constant->value;
  } else if (const auto* sigmoid = std::get_if<SigmoidSpectrum>(&spectrum)) {
    set_shape(flat, *sigmoid);
  } else if (const auto* rgb = std::get_if<RgbUnboundedSpectrum>(&spectrum)) {
    set_shape(flat, rgb->shape);
    flat.scale = rgb->scale;
  } else if (const auto* light = std::get_if<RgbIlluminantSpectrum>(&spectrum)) {
    set_shape(flat, light->shape);
    set_table(flat, cie_d65().data());
    flat.scale = light->scale;
  } else if (const auto* tabulated = std::get_if<TabulatedSpectrum>(&spectrum)) {
    set_table(flat, tabulated->values.data());
  } else {
    flat.other = &spectrum;
  }
  return flat;
}

}  // namespace vitrail
