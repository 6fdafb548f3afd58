// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/write/rgb_variants.h"

#include <algorithm>
#include <cmath>

#include "scene/spectra/color.h"

namespace vitrail::mitsuba_writer {

namespace {

// Linear between samples in order, 0 beyond them.
double at(const std::vector<SpectrumSample>& samples, double lambda_nm) {
  const auto above = std::ranges::lower_bound(samples, lambda_nm, {}, [](const auto& s) { return s[0]; });
  if (above == samples.end()) return 0;
  if (above == samples.begin()) return (*above)[0] == lambda_nm ? (*above)[1] : 0;
  const SpectrumSample &a = *(above - 1), &b = *above;
  return a[1] + (b[1] - a[1]) * (lambda_nm - a[0]) / (b[0] - a[0]);
}

// x̄, ȳ or z̄.
double observer(std::size_t component, double lambda_nm) {
  const double place = lambda_nm - lambda_min_nm;
  const auto lower = std::min(static_cast<std::size_t>(place), std::size_t{table_size - 2});
  const double share = place - static_cast<double>(lower);
  return (1 - share) * static_cast<double>(cie_1931()[lower][component]) +
         share * static_cast<double>(cie_1931()[lower + 1][component]);
}

}  // namespace

double luminance_in_rgb_variants(const Spectrum& emission) {
  const auto* table = std::get_if<TabulatedSpectrum>(&emission);
  const double own = to_xyz(emission).y;
  if (!table || !(own > 0)) return 1;
  const std::vector<SpectrumSample> samples = samples_of(*table);
  constexpr int places = 1000;
  const double step = static_cast<double>(table_size - 1) / (places - 1);
  std::array<double, 3> sum{};
  for (int i = 0; i < places; ++i) {
    const double lambda_nm = lambda_min_nm + i * step, value = at(samples, lambda_nm);
    if (value == 0) continue;
    for (std::size_t c = 0; c < 3; ++c) sum[c] += value * observer(c, lambda_nm) * step / cie_y_integral_nm;
  }
  const RGB rgb = xyz_to_srgb({sum[0], sum[1], sum[2]});
  return srgb_to_xyz({std::max(rgb.r, 0.0), std::max(rgb.g, 0.0), std::max(rgb.b, 0.0)}).y / own;
}

void report_rgb_variants(Context& context, const Spectrum& emission) {
  const double times = luminance_in_rgb_variants(emission);
  if (std::abs(times - 1) <= 0.01) return;
  context.approximated(
      fmt::format("Mitsuba's rgb variants look at a spectrum every .47 nm and cut colours outside of sRGB: "
                  "there this light is {:.2g} times as bright",
                  times));
}

bool is_mitsuba_file(const Scene& scene, const Origin& origin) {
  return origin.file < scene.files.size() &&
         std::filesystem::path(scene.files[origin.file]).extension() == ".xml";
}

}  // namespace vitrail::mitsuba_writer
