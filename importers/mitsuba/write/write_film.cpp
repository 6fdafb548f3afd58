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

}  // namespace

void write_film(Context& context, Element sensor) {
  const FilmSettings& settings = context.scene.film;
  context.begin(RecordKind::film, context.scene.film_origin);
  Element film = add(sensor, "film", "hdrfilm");
  add_integer(film, "width", settings.width);
  add_integer(film, "height", settings.height);
  const PixelRect& crop = settings.crop;
  if (crop != PixelRect{0, settings.width, 0, settings.height}) {
    add_integer(film, "crop_offset_x", crop.x0);
    add_integer(film, "crop_offset_y", crop.y0);
    add_integer(film, "crop_width", crop.x1 - crop.x0);
    add_integer(film, "crop_height", crop.y1 - crop.y0);
  }
  add_string(film, "file_format", "openexr");
  add_string(film, "pixel_format", settings.layers.has(Layer::alpha) ? "rgba" : "rgb");
  add_string(film, "component_format", "float32");
  add_boolean(film, "sample_border", false);
  if (settings.spectrum.count > 0)
    context.dropped("the film's spectral bins: a film of Mitsuba's \"rgb\" stands for it");
  std::visit([&](const auto& filter) { write(context, film, filter); }, settings.filter);
}

}  // namespace vitrail::mitsuba_writer
