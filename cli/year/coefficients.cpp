// SPDX-License-Identifier: Apache-2.0
#include "cli/year/coefficients.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <string>
#include <utility>

#include "film/develop.h"
#include "scene/daylight/photometry.h"
#include "scene/system/atomic_file.h"

namespace vitrail {

namespace {

// Melanopic EDI of what a film of daylight rows has as Z, ∫ S s_mel dλ / ∫ ȳ dλ: that of D65 is its lux.
double melanopic_edi_of(double z) {
  static const double of_d65 = [] {
    double sum = 0;
    for (std::size_t i = 0; i < table_size; ++i)
      sum += static_cast<double>(cie_d65()[i]) * static_cast<double>(melanopic()[i]);
    return sum / cie_y_integral_nm;
  }();
  return photometric(z / of_d65);
}

}  // namespace

Coefficients coefficients_of(const Film& film, bool patches) {
  require_unsaturated(film.refused(), {});
  Coefficients c{static_cast<std::size_t>(film.width()), static_cast<std::size_t>(film.height()), {}, {}, {}};
  for (std::vector<float>* values : {&c.mean, &c.error, &c.melanopic}) values->resize(c.sensors * c.lights);
  // The paths of all rows are a patch's.
  const double share = patches ? 1 / static_cast<double>(c.lights) : 1;
  for (std::size_t light = 0; light < c.lights; ++light)
    for (std::size_t sensor = 0; sensor < c.sensors; ++sensor) {
      const auto pixel = static_cast<std::uint32_t>(light * c.sensors + sensor);
      const std::size_t place = sensor * c.lights + light;
      const XYZ mean = film.mean(pixel);
      c.mean[place] = static_cast<float>(photometric(mean.y) * share);
      c.melanopic[place] = static_cast<float>(melanopic_edi_of(mean.z) * share);
      c.error[place] = static_cast<float>(photometric(std::sqrt(film.variance_of_mean(pixel))) * share);
    }
  return c;
}

void write_npy(const std::filesystem::path& file, const Coefficients& of, const std::vector<float>& values) {
  static_assert(std::endian::native == std::endian::little);
  std::string head =
      fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}, {}), }}", of.sensors, of.lights);
  constexpr std::size_t magic = 10, unit = 64;
  head.append(unit - (magic + head.size() + 1) % unit, ' ');
  head += '\n';
  std::string begin("\x93NUMPY\x01\x00", 8);
  begin += static_cast<char>(head.size() & 0xff);
  begin += static_cast<char>(head.size() >> 8);
  begin += head;
  AtomicFile out(file);
  out.write(std::as_bytes(std::span(std::as_const(begin))));
  out.write(std::as_bytes(std::span(values)));
  out.commit();
}

}  // namespace vitrail
