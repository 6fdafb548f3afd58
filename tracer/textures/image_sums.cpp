// SPDX-License-Identifier: Apache-2.0
#include "tracer/textures/image_sums.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "tracer/textures/baked_image.h"
#include "tracer/textures/texel_places_lanes.h"

namespace vitrail {

namespace {

// Of an image whose levels are there, that which has at most so many texels: its texels are means.
constexpr std::int64_t most_texels = 1 << 22;
constexpr int most_shares = 8;  // cells along a side that a box may reach at the level where it is looked up

int level_to_read(const BakedImage& image) {
  int level = 0;
  while (level + 1 < image.levels() && std::int64_t{image.width(level)} * image.height(level) > most_texels)
    ++level;
  return level;
}

int cells_for(int texels, int most) {
  return static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::min(texels, most))));
}

// The cells of a row that interval [low, high) of it reaches, and how much of the interval is in each.
struct Shares {
  static constexpr int most = 2 * most_shares;
  std::array<int, most> cell{};
  std::array<double, most> share{};
  int count = 0;
  double black = 1;  // of the interval: what is in no cell

  Shares(Interval at, int cells, Wrap wrap) {
    const double low = at.low * cells, high = at.high * cells;
    const int first = static_cast<int>(std::floor(low)), last = static_cast<int>(std::ceil(high)) - 1;
    for (int i = first; i <= last && count < most; ++i) {
      const double part = (std::min(i + 1.0, high) - std::max<double>(i, low)) / (high - low);
      const int wanted = wrap == Wrap::repeat ? ((i % cells) + cells) % cells : mirrored(i, cells, wrap);
      const int k = lanes::wrapped(wanted, cells, wrap);
      if (!(part > 0) || k < 0) continue;
      cell[static_cast<std::size_t>(count)] = k;
      share[static_cast<std::size_t>(count++)] = part;
      black -= part;
    }
  }

 private:
  static int mirrored(int i, int cells, Wrap wrap) {
    return wrap == Wrap::mirror ? ((i % (2 * cells)) + 2 * cells) % (2 * cells) : i;
  }
};

// The same values as where the image repeats, within a few times of its length.
Interval folded(Interval at, Wrap wrap) {
  const bool finite = std::isfinite(at.low) && std::isfinite(at.high);
  if (wrap == Wrap::clamp || wrap == Wrap::black)
    return finite ? Interval{std::clamp(at.low, -1.0, 2.0), std::clamp(at.high, -1.0, 2.0)} : Interval{0, 1};
  const double period = wrap == Wrap::mirror ? 2 : 1;
  if (!finite || !(at.high - at.low < period)) return {0, period};
  const double by = period * std::floor(at.low / period);
  return {at.low - by, at.high - by};
}

}  // namespace

ImageSums::ImageSums(const BakedImage& image, int most_cells)
    : width_(image.width()), height_(image.height()) {
  Level& all = levels_.emplace_back();
  all.width = cells_for(width_, most_cells);
  all.height = cells_for(height_, most_cells);
  add_texels(image);
  while (levels_.back().means.size() > 1) {
    const Level& fine = levels_.back();
    Level half{std::max(1, fine.width / 2), std::max(1, fine.height / 2), {}};
    const int dx = fine.width / half.width, dy = fine.height / half.height;
    for (int i = 0; i < half.width * half.height; ++i) {
      double sum = 0;
      for (int k = 0; k < dx * dy; ++k)
        sum += fine.means[static_cast<std::size_t>((i / half.width * dy + k / dx) * fine.width +
                                                   i % half.width * dx + k % dx)];
      half.means.push_back(sum / (dx * dy));
    }
    levels_.push_back(std::move(half));
  }
}

void ImageSums::add_texels(const BakedImage& image) {
  Level& cells = levels_.front();
  cells.means.assign(static_cast<std::size_t>(cells.width) * static_cast<std::size_t>(cells.height), 0);
  const int level = level_to_read(image), width = image.width(level), height = image.height(level);
  const bool numbers = image.format() == TexelFormat::number;
  const auto first_cell = [](int texel, int texels, int count) {
    return static_cast<int>(std::int64_t{texel} * count / texels);
  };
  const auto overlap = [](int texel, int texels, int cell, int count) {
    const double ratio = static_cast<double>(count) / texels;
    return std::max(0.0, std::min((texel + 1) * ratio, cell + 1.0) - std::max<double>(texel * ratio, cell));
  };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double value = numbers ? image.number(x, y, level) : image.luminance(x, y, level);
      if (!std::isfinite(value)) continue;
      least_ = x + y == 0 ? value : std::min(least_, value);
      most_ = x + y == 0 ? value : std::max(most_, value);
      if (value == 0) continue;
      for (int j = first_cell(y, height, cells.height); j * height < (y + 1) * cells.height; ++j)
        for (int i = first_cell(x, width, cells.width); i * width < (x + 1) * cells.width; ++i)
          cells.means[static_cast<std::size_t>(j * cells.width + i)] +=
              value * overlap(x, width, i, cells.width) * overlap(y, height, j, cells.height);
    }
  // Means of a coarser level: one texel may have had the light of all of them.
  if (level > 0 && most_ > 0)
    most_ *= static_cast<double>(width_) / width * (static_cast<double>(height_) / height);
  if (level > 0) least_ = std::min(least_, 0.0);
}

ValueRange ImageSums::over(Interval s, Interval t, Wrap wrap, bool interpolated) const {
  constexpr double rounding = 1e-3;  // of a texel
  const double reach = rounding + (interpolated ? 0.5 : 0);
  const auto around = [&](Interval at, int texels) {
    const Interval f = folded(at, wrap);
    return Interval{f.low - reach / texels, f.high + reach / texels};
  };
  const Interval h = around(s, width_), v = around(t, height_);
  std::size_t level = 0;
  while (level + 1 < levels_.size() && ((h.high - h.low) * levels_[level].width > most_shares ||
                                        (v.high - v.low) * levels_[level].height > most_shares))
    ++level;
  const Level& cells = levels_[level];
  const Shares across(h, cells.width, wrap), up(v, cells.height, wrap);
  double mean = 0;
  for (int j = 0; j < up.count; ++j)
    for (int i = 0; i < across.count; ++i) {
      const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
      mean += up.share[b] * across.share[a] *
              cells.means[static_cast<std::size_t>(up.cell[b] * cells.width + across.cell[a])];
    }
  const bool black = wrap == Wrap::black && (across.black > 0 || up.black > 0);
  if (mean == 0 && least_ >= 0) return {};
  return {black ? std::min(least_, 0.0) : least_, mean, black ? std::max(most_, 0.0) : most_};
}

}  // namespace vitrail
