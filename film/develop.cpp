// SPDX-License-Identifier: Apache-2.0
#include "film/develop.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "film/cryptomatte.h"
#include "film/group_mix.h"
#include "film/picture_extent.h"
#include "film/picture_memory.h"
#include "film/working_gamma.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

void require_unsaturated(const Refused& refused, const std::filesystem::path& file) {
  if (refused.too_large == 0) return;
  throw Error(
      fmt::format("the film is saturated: {} deposits were too bright for its sums, which span a factor "
                  "of 10²⁵ about the scene's lights, and are missing; bring its dimmest and its "
                  "brightest light closer together",
                  refused.too_large),
      {file.string()});
}

void require_samples(std::uint64_t samples, const std::filesystem::path& file) {
  if (samples > 0) return;
  throw Error("the film holds no sample yet: its picture would be black", {file.string()});
}

namespace {

void add_sums(const Film& film, Layer layer, std::vector<PictureChannel>& out) {
  const LayerKind& kind = kind_of(layer);
  const std::size_t first = out.size();
  for (std::size_t i = 0; i < kind.sums; ++i)
    out.push_back({kind.channels[i], false, std::vector<float>(film.pixels()), {}});
  for (std::uint32_t p = 0; p < film.pixels(); ++p) {
    std::array<double, 3> mean{};
    for (std::size_t i = 0; i < kind.sums; ++i) mean[i] = film.mean_of_layer(p, layer, i);
    if (layer == Layer::albedo) {
      const RGB c = xyz_to_srgb({mean[0], mean[1], mean[2]});
      mean = {c.r, c.g, c.b};
    }
    for (std::size_t i = 0; i < kind.sums; ++i) out[first + i].values[p] = static_cast<float>(mean[i]);
  }
}

void add_mattes(const Film& film, Layer layer, std::size_t most, Picture& out) {
  for (PictureChannel& channel : matte_channels(film, layer, most)) out.layers.push_back(std::move(channel));
  out.mattes.push_back({kind_of(layer).channels[0], ""});
}

void add_ids(const Film& film, Layer layer, std::vector<PictureChannel>& out) {
  PictureChannel channel{kind_of(layer).channels[0], true, {}, std::vector<std::uint32_t>(film.pixels())};
  for (std::uint32_t p = 0; p < film.pixels(); ++p) channel.ids[p] = film.id(p, layer);
  out.push_back(std::move(channel));
}

}  // namespace

Picture develop_colors(const Film& film) {
  require_unsaturated(film.refused(), {});
  Picture picture;
  picture.origin.software = to_string(film.key().renderer);
  picture.rgb = black_image(film.width(), film.height(), 3);
  picture.window = film.crop();
  picture.full_width = film.full_width();
  picture.full_height = film.full_height();
  for (std::uint32_t p = 0; p < film.pixels(); ++p) {
    const RGB c = light_of(xyz_to_srgb(film.mean(p)), film.settings().working_gamma);
    float* out = &picture.rgb.values[3 * std::size_t{p}];
    out[0] = static_cast<float>(c.r), out[1] = static_cast<float>(c.g), out[2] = static_cast<float>(c.b);
  }
  if (film.layers().has(Layer::alpha)) add_sums(film, Layer::alpha, picture.layers);
  return picture;
}

namespace {

// As many rows at a time as a few megabytes have.
template <class Visit>
void each_rows(const FilmRows& film, bool with_sums, const Visit& visit) {
  const int rows = rows_at_once(film.settings(), film.key());
  for (int y = 0; y < film.height(); y += rows)
    visit(film.rows(y, std::min(y + rows, film.height()), with_sums));
}

}  // namespace

Picture develop_colors(const FilmRows& film) {
  Picture picture;
  each_rows(film, true, [&](const Film& rows) { append_rows(picture, develop_colors(rows), film.height()); });
  return picture;
}

Picture develop(const FilmRows& film) {
  FilmSurvey whole;
  each_rows(film, film.key().clamp > 0, [&](const Film& rows) { add_rows(whole, rows); });
  whole.hash = hash_of(std::span(&film, 1));
  Picture picture;
  each_rows(film, true, [&](const Film& rows) { append_rows(picture, develop(rows, whole), film.height()); });
  return picture;
}

Picture develop(const Film& film) { return develop(film, survey_of(film)); }

Picture develop(const Film& film, const FilmSurvey& whole) {
  Picture picture = develop_colors(film);
  const bool knows_variance = !film.key().one_sequence;
  if (knows_variance) picture.variance = black_image(film.width(), film.height(), 1);
  picture.bins = film.bins();
  picture.spectrum = black_image(film.width(), film.height(), film.bins().count);
  if (film.bins().count == 0) picture.spectrum = {};
  picture.shared_error = film.shared_error();
  for (std::uint32_t p = 0; p < film.pixels(); ++p) {
    if (knows_variance) {
      const double slope = light_per_sum(film.mean(p).y, film.settings().working_gamma);
      picture.variance.values[p] = static_cast<float>(film.variance_of_mean(p) * slope * slope);
    }
    const auto bins = static_cast<std::size_t>(film.bins().count);
    for (std::size_t b = 0; b < bins; ++b)
      picture.spectrum.values[bins * p + b] = static_cast<float>(film.mean_of_bin(p, b));
  }
  for (std::size_t i = 0; i < layer_count; ++i) {
    const auto layer = static_cast<Layer>(i);
    if (!film.layers().has(layer) || layer == Layer::alpha) continue;
    if (kind_of(layer).is_matte)
      add_mattes(film, layer, whole.mattes[i].most, picture);
    else if (kind_of(layer).is_id())
      add_ids(film, layer, picture.layers);
    else
      add_sums(film, layer, picture.layers);
  }
  for (PictureChannel& channel : group_channels(film)) picture.layers.push_back(std::move(channel));
  constexpr std::uint64_t most_int = 0x7fffffff;
  picture.samples_per_pixel = static_cast<int>(std::min(whole.most_samples, most_int));
  picture.origin = {.software = to_string(film.key().renderer),
                    .scene_hash = fmt::format("{:016x}", film.key().scene_hash),
                    .seeds = fmt::format("{}", film.key().seed),
                    .film_hash = fmt::format("{:016x}", whole.hash),
                    .least_samples = static_cast<int>(std::min(whole.least_samples, most_int))};
  return picture;
}

void expose(Picture& picture, double ev) {
  const auto factor = static_cast<float>(std::exp2(ev));
  for (float& v : picture.rgb.values) v *= factor;
  for (float& v : picture.spectrum.values) v *= factor;
  for (float& v : picture.variance.values) v *= factor * factor;
}

}  // namespace vitrail
