// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/write/write_film.h"

#include <cmath>

namespace vitrail::mitsuba_writer {

namespace {

// The filter's one radius in Mitsuba.
double radius(Context& context, double x, double y) {
  if (x != y)
    context.approximated(fmt::format("Mitsuba's filters have one radius: {} of {} × {} pixels", x, x, y));
  return x;
}

void write(Context& context, Element film, const BoxFilter& filter) {
  if (filter.radius_x != 0.5 || filter.radius_y != 0.5)
    context.approximated("Mitsuba's box filter is one pixel wide");
  add(film, "rfilter", "box");
}

void write(Context& context, Element film, const TriangleFilter& filter) {
  const double r = radius(context, filter.radius_x, filter.radius_y);
  add_float(add(film, "rfilter", "tent"), "radius", r);
}

void write(Context& context, Element film, const GaussianFilter& filter) {
  const double r = radius(context, filter.radius_x, filter.radius_y);
  if (r != 4 * filter.sigma)
    context.approximated(
        fmt::format("Mitsuba's Gaussian ends at 4σ = {} pixels, not at {}", 4 * filter.sigma, r));
  add_float(add(film, "rfilter", "gaussian"), "stddev", filter.sigma);
}

void write(Context& context, Element film, const MitchellFilter& filter) {
  const double r = radius(context, filter.radius_x, filter.radius_y);
  if (r != 2) context.approximated("Mitsuba's Mitchell filter has a radius of 2 pixels");
  Element element = add(film, "rfilter", "mitchell");
  add_float(element, "B", filter.b);
  add_float(element, "C", filter.c);
}

void write(Context& context, Element film, const SincFilter& filter) {
  const double r = radius(context, filter.radius_x, filter.radius_y);
  const int lobes = std::max(1, static_cast<int>(std::lround(std::min(filter.tau, 64.0))));
  if (lobes != filter.tau || r != filter.tau)
    context.approximated(
        fmt::format("Mitsuba's Lanczos filter ends with its lobes: {} pixels, not {}", lobes, r));
  add_integer(add(film, "rfilter", "lanczos"), "lobes", lobes);
}

// A band's value is ∫ L·response dλ: the mean radiance of the interval, as here.
void add_bands(Context& context, Element film, const SpectralBins& bins) {
  context.approximated(
      "spectral bins become the bands of a specfilm: it has no colours, and Mitsuba's rgb variants refuse "
      "it");
  const double height = 1 / bins.width_nm();
  const auto edge = [&](int i) { return i == bins.count ? bins.max_nm : bins.min_nm + i * bins.width_nm(); };
  for (int i = 0; i < bins.count; ++i)
    add_value(film, "spectrum", fmt::format("band_{:04}", i),
              fmt::format("{}:{}, {}:{}", edge(i), height, edge(i + 1), height));
}

}  // namespace

void write_film(Context& context, Element sensor) {
  const FilmSettings& settings = context.scene.film;
  context.begin(RecordKind::film, context.scene.film_origin);
  const bool spectral = settings.spectrum.count > 0;
  Element film = add(sensor, "film", spectral ? "specfilm" : "hdrfilm");
  add_integer(film, "width", settings.width);
  add_integer(film, "height", settings.height);
  const PixelRect& crop = settings.crop;
  if (crop != PixelRect{0, settings.width, 0, settings.height}) {
    add_integer(film, "crop_offset_x", crop.x0);
    add_integer(film, "crop_offset_y", crop.y0);
    add_integer(film, "crop_width", crop.x1 - crop.x0);
    add_integer(film, "crop_height", crop.y1 - crop.y0);
  }
  if (!spectral) add_string(film, "file_format", "openexr");
  if (!spectral) add_string(film, "pixel_format", settings.layers.has(Layer::alpha) ? "rgba" : "rgb");
  add_string(film, "component_format", "float32");
  add_boolean(film, "sample_border", false);
  if (spectral) add_bands(context, film, settings.spectrum);
  if (spectral && settings.layers.has(Layer::alpha)) context.dropped("alpha: a specfilm of Mitsuba has none");
  std::visit([&](const auto& filter) { write(context, film, filter); }, settings.filter);
}

}  // namespace vitrail::mitsuba_writer
