// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/measured.h"

#include <cmath>

#include "tracer/bsdf/between.h"
#include "tracer/bsdf/local.h"

namespace vitrail {

namespace {

double interpolate(std::span<const float> values, std::size_t row_length, Between row, Between column) {
  const auto in_row = [&](std::size_t i) {
    const float* at = values.data() + i * row_length + column.first;
    const auto a = static_cast<double>(at[0]);
    return column.part > 0 ? a + (static_cast<double>(at[1]) - a) * column.part : a;
  };
  const double a = in_row(row.first);
  return row.part > 0 ? a + (in_row(row.first + 1) - a) * row.part : a;
}

}  // namespace

SheetFractions sheet_fractions(const MeasuredSheet& table, const SampledWavelengths& wavelengths,
                               double cosine) {
  const Between column = locate(table.cosines, cosine);
  SheetFractions f;
  for (int i = 0; i < hero_count; ++i) {
    const Between row =
        locate(table.wavelengths_nm, static_cast<double>(wavelengths.lambda_nm[static_cast<std::size_t>(i)]));
    f.reflected[i] = static_cast<float>(interpolate(table.reflectance, table.cosines.size(), row, column));
    f.transmitted[i] =
        static_cast<float>(interpolate(table.transmittance, table.cosines.size(), row, column));
  }
  return f;
}

BsdfValue eval(const MeasuredSheetBsdf&, Vector3d, Vector3d) { return {}; }
double pdf(const MeasuredSheetBsdf&, Vector3d, Vector3d) { return 0; }

std::optional<BsdfSample> sample(const MeasuredSheetBsdf& b, Vector3d out, float u_lobe, Point2f) {
  const SheetFractions f = sheet_fractions(*b.table, b.wavelengths, std::abs(out.z));
  const double reflected = carried(b.throughput, f.reflected),
               all = reflected + carried(b.throughput, f.transmitted);
  if (!(all > 0)) return std::nullopt;
  const auto chance = static_cast<float>(attainable(reflected / all));
  if (u_lobe < chance)
    return BsdfSample{.in = {-out.x, -out.y, out.z}, .weight = f.reflected * (1 / chance), .specular = true};
  if (!(chance < 1)) return std::nullopt;
  return BsdfSample{.in = -out, .weight = f.transmitted * (1 / (1 - chance)), .specular = true};
}

}  // namespace vitrail
