// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/measured.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "tracer/bsdf/local.h"

namespace vitrail {

namespace {

// Of a position between the nodes `first` and `first + 1`, or at `first` where part = 0.
struct Between {
  std::size_t first;
  double part;
};

Between locate(std::span<const float> nodes, double x) {
  const auto above = std::upper_bound(nodes.begin(), nodes.end(), x, [](double value, float node) {
    return value < static_cast<double>(node);
  });
  if (above == nodes.begin()) return {0, 0};
  const auto first = static_cast<std::size_t>(above - nodes.begin()) - 1;
  if (above == nodes.end()) return {first, 0};
  const auto low = static_cast<double>(nodes[first]), high = static_cast<double>(nodes[first + 1]);
  return {first, (x - low) / (high - low)};  // low ≤ x < high
}

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
