// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/read/film.h"

#include <fmt/format.h>

#include <algorithm>

#include "importers/mitsuba/read/properties.h"
#include "importers/reading/suggestion.h"

namespace vitrail::mitsuba {

namespace {

const std::vector<std::string> film_kinds{"hdrfilm", "specfilm", "ldrfilm", "tiledhdrfilm", "mfilm"};
const std::vector<std::string> filter_kinds{"box", "tent", "gaussian", "mitchell", "catmullrom", "lanczos"};

Filter default_filter() { return GaussianFilter{2, 2, 0.5}; }

int pixels(const Object& film, const char* name, int otherwise, const Report& report) {
  constexpr int most = 1 << 20;
  const int value = film.integer(name, otherwise, report);
  if (value < 1 || value > most)
    report.fail(fmt::format("\"{}\" is {}, which is not between 1 and {}", name, value, most),
                place_of(film, name));
  return value;
}

PixelRect read_crop(const Object& film, int width, int height, const Report& report) {
  const long long x = film.integer("crop_offset_x", 0, report), y = film.integer("crop_offset_y", 0, report);
  const int crop_width = pixels(film, "crop_width", width, report),
            crop_height = pixels(film, "crop_height", height, report);
  if (x < 0 || y < 0 || x + crop_width > width || y + crop_height > height)
    report.fail(fmt::format("the crop of {} × {} pixels at ({}, {}) leaves the film of {} × {}", crop_width,
                            crop_height, x, y, width, height),
                film.origin);
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  return {x0, x0 + crop_width, y0, y0 + crop_height};
}

double positive(const Object& object, const char* name, double otherwise, const Report& report) {
  const double value = object.number(name, otherwise, report);
  if (!(value > 0))
    report.fail(fmt::format("\"{}\" is {}, but has to be above 0", name, value), place_of(object, name));
  return value;
}

Filter filter_of(const Object& object, Report& report) {
  if (object.type == "box") return BoxFilter{};
  if (object.type == "tent") {
    const double radius = positive(object, "radius", 1, report);
    return TriangleFilter{radius, radius};
  }
  if (object.type == "gaussian") {
    const double sigma = positive(object, "stddev", 0.5, report);
    return GaussianFilter{4 * sigma, 4 * sigma, sigma};
  }
  if (object.type == "mitchell")
    return MitchellFilter{2, 2, object.number("B", 1.0 / 3, report), object.number("C", 1.0 / 3, report)};
  if (object.type == "catmullrom") return MitchellFilter{2, 2, 0, 0.5};
  if (object.type == "lanczos") {
    const double lobes = positive(object, "lobes", 3, report);
    return SincFilter{lobes, lobes, lobes};
  }
  report.approximated(fmt::format("filter \"{}\" is not known and becomes a Gaussian of σ 0.5{}", object.type,
                                  suggestion(object.type, filter_kinds)),
                      object.origin);
  return default_filter();
}

Filter read_filter(const Object& film, Report& report) {
  const Object* object = film.child("rfilter");
  if (!object) return default_filter();
  const Filter filter = filter_of(*object, report);
  report_unused(*object, report, {"radius", "stddev", "B", "C", "lobes"});
  return filter;
}

// Of Mitsuba 3 and of 0.6: rgba, luminance_alpha, luminanceAlpha, xyza …
bool has_alpha(std::string_view pixel_format) { return pixel_format.ends_with('a'); }

void read_pixel_format(FilmSettings& settings, const Object& film, Report& report) {
  const std::string format = film.text("pixel_format", "rgb", report);
  if (has_alpha(format)) settings.layers.add(Layer::alpha);
  const bool grey = format.starts_with("luminance");
  if (grey || format.starts_with("xyz"))
    report.approximated(fmt::format("pixels of \"{}\": the film keeps red, green and blue{}", format,
                                    grey ? ", of which they are the luminance" : ""),
                        place_of(film, "pixel_format"));
}

}  // namespace

void read_film(Builder& builder, const Object& sensor) {
  FilmSettings& settings = builder.scene.film;
  settings = {768, 576, {0, 768, 0, 576}, default_filter(), 1, {}, settings.layers};
  builder.scene.film_origin = sensor.origin;
  const Object* film = sensor.child("film");
  if (!film) return;
  Report& report = builder.report;
  builder.scene.film_origin = film->origin;
  report.begin_item({film->origin, RecordKind::film});
  if (std::find(film_kinds.begin(), film_kinds.end(), film->type) == film_kinds.end())
    report.approximated(fmt::format("film \"{}\" is not known and read as \"hdrfilm\"{}", film->type,
                                    suggestion(film->type, film_kinds)),
                        film->origin);
  settings.width = pixels(*film, "width", 768, report);
  settings.height = pixels(*film, "height", 576, report);
  settings.crop = read_crop(*film, settings.width, settings.height, report);
  settings.filter = read_filter(*film, report);
  read_pixel_format(settings, *film, report);
  if (film->type == "specfilm") read_bands(builder, *film);
  film->ignore({"filename", "file_format", "component_format", "sample_border", "compensate", "banner",
                "attach_log", "high_quality_edges", "gamma", "variable", "digits", "channel_names"});
  report_unused_in_one(*film, report,
                       {"width", "height", "crop_offset_x", "crop_offset_y", "crop_width", "crop_height"});
}

}  // namespace vitrail::mitsuba
