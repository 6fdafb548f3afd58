// SPDX-License-Identifier: Apache-2.0
#include "film/picture_extent.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace vitrail {

namespace {

// `values` of `width` pixels a row; `window` is relative to them.
template <class T>
std::vector<T> part_of(const std::vector<T>& values, int width, std::size_t channels,
                       const PixelRect& window) {
  std::vector<T> part;
  for (int y = window.y0; y < window.y1; ++y) {
    const auto row = values.begin() + static_cast<std::ptrdiff_t>(channels * static_cast<std::size_t>(y) *
                                                                  static_cast<std::size_t>(width));
    const auto at = [&](int x) { return row + static_cast<std::ptrdiff_t>(channels) * x; };
    part.insert(part.end(), at(window.x0), at(window.x1));
  }
  return part;
}

Image part_of(const Image& image, const PixelRect& window) {
  if (image.pixels() == 0) return image;
  return {window.x1 - window.x0, window.y1 - window.y0, image.channels,
          part_of(image.values, image.width, static_cast<std::size_t>(image.channels), window)};
}

// What a new pixel along an axis is made of: `weights` of the old ones from `first` on.
struct Taps {
  std::size_t first = 0;
  std::vector<double> weights;
};

std::vector<Taps> taps_along(int from, int to) {
  const double step = static_cast<double>(from) / to, radius = std::max(1.0, step);
  std::vector<Taps> taps(static_cast<std::size_t>(to));
  for (std::size_t i = 0; i < taps.size(); ++i) {
    const double centre = (static_cast<double>(i) + 0.5) * step;
    const int first = std::max(0, static_cast<int>(std::ceil(centre - radius - 0.5)));
    double sum = 0;
    taps[i].first = static_cast<std::size_t>(first);
    for (int j = first; j < from && j + 0.5 < centre + radius; ++j) {
      taps[i].weights.push_back(1 - std::abs(j + 0.5 - centre) / radius);
      sum += taps[i].weights.back();
    }
    for (double& weight : taps[i].weights) weight /= sum;
  }
  return taps;
}

// An array lines × positions × values, resampled along its positions.
std::vector<float> resampled(std::span<const float> in, std::size_t values, std::size_t positions,
                             const std::vector<Taps>& taps) {
  const std::size_t lines = in.size() / (positions * values);
  std::vector<float> out(lines * taps.size() * values);
  for (std::size_t line = 0; line < lines; ++line)
    for (std::size_t i = 0; i < taps.size(); ++i)
      for (std::size_t v = 0; v < values; ++v) {
        double sum = 0;
        for (std::size_t k = 0; k < taps[i].weights.size(); ++k)
          sum += taps[i].weights[k] *
                 static_cast<double>(in[(line * positions + taps[i].first + k) * values + v]);
        out[(line * taps.size() + i) * values + v] = static_cast<float>(sum);
      }
  return out;
}

Image resized(const Image& image, const std::vector<Taps>& columns, const std::vector<Taps>& rows) {
  if (image.pixels() == 0) return image;
  const auto channels = static_cast<std::size_t>(image.channels);
  const std::vector<float> wide =
      resampled(image.values, channels, static_cast<std::size_t>(image.width), columns);
  return {static_cast<int>(columns.size()), static_cast<int>(rows.size()), image.channels,
          resampled(wide, channels * columns.size(), static_cast<std::size_t>(image.height), rows)};
}

std::vector<std::uint32_t> nearest(const std::vector<std::uint32_t>& ids, const PixelRect& from, int width,
                                   int height) {
  const int columns = from.x1 - from.x0, rows = from.y1 - from.y0;
  const auto old = [](int i, int count, int of) {
    return static_cast<std::size_t>((2 * std::int64_t{i} + 1) * of / (2 * std::int64_t{count}));
  };
  std::vector<std::uint32_t> out;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      out.push_back(ids[old(y, height, rows) * static_cast<std::size_t>(columns) + old(x, width, columns)]);
  return out;
}

}  // namespace

void cut_to(Picture& picture, const PixelRect& window) {
  const PixelRect& own = picture.window;
  if (window == own) return;
  const PixelRect inside{window.x0 - own.x0, window.x1 - own.x0, window.y0 - own.y0, window.y1 - own.y0};
  for (PictureChannel& layer : picture.layers) {
    if (layer.is_id)
      layer.ids = part_of(layer.ids, picture.rgb.width, 1, inside);
    else
      layer.values = part_of(layer.values, picture.rgb.width, 1, inside);
  }
  for (Image* image : {&picture.rgb, &picture.variance, &picture.spectrum}) *image = part_of(*image, inside);
  picture.window = window;
}

void append_rows(Picture& picture, Picture rows, int height) {
  const auto every_part = [](Picture& of, const auto& visit) {
    for (Image* image : {&of.rgb, &of.variance, &of.spectrum}) visit(image->values);
    for (PictureChannel& layer : of.layers) visit(layer.values), visit(layer.ids);
  };
  if (picture.rgb.pixels() == 0) {
    const auto times = static_cast<std::size_t>(height), one = static_cast<std::size_t>(rows.rgb.height);
    every_part(rows, [&](auto& values) { values.reserve(values.size() / one * times); });
    picture = std::move(rows);
    return;
  }
  // What stands at the same place in both.
  const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  for (const auto image : {&Picture::rgb, &Picture::variance, &Picture::spectrum}) {
    append((picture.*image).values, (rows.*image).values);
    (picture.*image).height += (rows.*image).height;
  }
  for (std::size_t i = 0; i < picture.layers.size(); ++i) {
    append(picture.layers[i].values, rows.layers[i].values);
    append(picture.layers[i].ids, rows.layers[i].ids);
  }
  picture.window.y1 = rows.window.y1;
}

void resize(Picture& picture, int width, int height) {
  for (const PictureMattes& mattes : picture.mattes)
    std::erase_if(picture.layers, [&](const auto& layer) { return layer.name.starts_with(mattes.layer); });
  picture.mattes.clear();
  const std::vector<Taps> columns = taps_along(picture.rgb.width, width),
                          rows = taps_along(picture.rgb.height, height);
  for (PictureChannel& layer : picture.layers) {
    if (layer.is_id) {
      layer.ids = nearest(layer.ids, {0, picture.rgb.width, 0, picture.rgb.height}, width, height);
      continue;
    }
    const Image values{picture.rgb.width, picture.rgb.height, 1, std::move(layer.values)};
    layer.values = resized(values, columns, rows).values;
  }
  picture.rgb = resized(picture.rgb, columns, rows);
  picture.spectrum = resized(picture.spectrum, columns, rows);
  picture.variance = {};
  picture.window = {0, width, 0, height};
  picture.full_width = width, picture.full_height = height;
}

}  // namespace vitrail
