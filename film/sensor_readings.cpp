// SPDX-License-Identifier: Apache-2.0
#include "film/sensor_readings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "film/develop.h"
#include "scene/daylight/photometry.h"
#include "scene/records/pixel_place.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

// Of rows with samples, all with equal weight: they have equal numbers of them in a finished film.
Measured over_rows(const std::vector<double>& rows) {
  Measured result;
  if (rows.empty()) return result;
  const double count = static_cast<double>(rows.size());
  for (const double x : rows) result.mean += x / count;
  double squares = 0;
  for (const double x : rows) squares += (x - result.mean) * (x - result.mean);
  if (rows.size() > 1) result.standard_error = std::sqrt(squares / (count * (count - 1)));
  return result;
}

// Of one value in the sum of the squared differences from the mean.
double share_of_greatest(const std::vector<double>& values) {
  double mean = 0, squares = 0, greatest = 0;
  for (const double x : values) mean += x / static_cast<double>(values.size());
  for (const double x : values) {
    const double square = (x - mean) * (x - mean);
    squares += square, greatest = std::max(greatest, square);
  }
  return squares > 0 ? greatest / squares : 0;
}

}  // namespace

std::vector<SensorReading> sensor_readings(const Film& film) {
  require_unsaturated(film.refused(), {});
  const SpectralBins& bins = film.bins();
  if (bins.count == 0) throw Error("the film keeps no spectrum, which sensors need", {});
  if (film.key().clamp > 0)
    throw Error(fmt::format("the film was rendered with --clamp, which took {:.3g} % of the light that its "
                            "sensors measure: render again without",
                            100 * film.clamped_share()),
                {});
  std::vector<double> melanopic_of_bin;
  for (int b = 0; b < bins.count; ++b) {
    const double low = bins.min_nm + b * bins.width_nm();
    melanopic_of_bin.push_back(melanopic_edi_of_bin(low, low + bins.width_nm()));
  }
  std::vector<SensorReading> readings;
  for (int x = 0; x < film.width(); ++x) {
    SensorReading reading;
    std::vector<double> illuminance, melanopic, irradiance, halves;
    for (int y = 0; y < film.height(); ++y) {
      const auto pixel = static_cast<std::uint32_t>(pixel_place(x, y, film.width()));
      if (film.samples(pixel) == 0) continue;
      reading.samples += film.samples(pixel);
      const double light = film.mean(pixel).y, apart = std::sqrt(film.variance_of_mean(pixel));
      halves.insert(halves.end(), {light - apart, light + apart});  // of two groups of samples
      illuminance.push_back(photometric(film.mean(pixel).y));
      double edi = 0, watts = 0;
      for (std::size_t b = 0; b < melanopic_of_bin.size(); ++b) {
        const double mean = film.mean_of_bin(pixel, b);
        edi += mean * melanopic_of_bin[b];
        watts += mean * bins.width_nm();
      }
      melanopic.push_back(edi);
      irradiance.push_back(watts);
    }
    reading.greatest_share = share_of_greatest(halves);
    reading.illuminance_lx = over_rows(illuminance);
    reading.melanopic_edi_lx = over_rows(melanopic);
    reading.irradiance_w_m2 = over_rows(irradiance);
    readings.push_back(reading);
  }
  return readings;
}

}  // namespace vitrail
