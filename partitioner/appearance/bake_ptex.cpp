// SPDX-License-Identifier: Apache-2.0
#include "partitioner/appearance/bake_ptex.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "images/ptex_file.h"
#include "images/ptex_means.h"

namespace vitrail {

namespace {

constexpr std::uint32_t margin = 1, widest = 2048;
constexpr std::uint64_t most_texels = 1u << 28;

// Halvings that bring all faces together below the most texels, and each below the widest.
int halvings_of(const std::vector<PtexFile::Face>& faces) {
  for (int halvings = 0;; ++halvings) {
    std::uint64_t texels = 0;
    std::uint32_t side = 0;
    for (const auto& f : faces) {
      const std::uint32_t w = std::max(1u, f.width >> halvings), h = std::max(1u, f.height >> halvings);
      texels += std::uint64_t{w + 2 * margin} * (h + 2 * margin);
      side = std::max({side, w, h});
    }
    if ((texels <= most_texels && side <= widest) || side == 1) return halvings;
  }
}

// How much finer than the file the image is, along u and v: pbrt decodes what its filter makes of the texels,
// and between those of the image values are blended after they were decoded.
std::uint32_t refinement_of(const PtexFile& file, const PtexTexture& texture, int halvings) {
  constexpr std::uint64_t enough_texels = 1u << 22;
  if (texture.encoding == Encoding::linear || file.is_of_triangles() || halvings > 0) return 1;
  for (std::uint32_t fine = 8; fine > 1; fine /= 2) {
    std::uint64_t texels = 0;
    std::uint32_t side = 0;
    for (const auto& f : file.faces()) {
      if (f.constant) continue;
      texels += std::uint64_t{f.width} * f.height * fine * fine;
      side = std::max({side, f.width, f.height});
    }
    if (texels <= enough_texels && side * fine <= widest) return fine;
  }
  return 1;
}

// Shelves, the highest tiles first.
struct Layout {
  PtexTiles tiles;
  std::vector<std::vector<std::uint32_t>> shelves;  // their tiles
};

Layout layout_of(const PtexFile& file, int halvings, std::uint32_t refinement) {
  Layout layout;
  PtexTiles& t = layout.tiles;
  std::uint64_t texels = 0;
  for (const auto& f : file.faces()) {
    const bool one = file.is_of_triangles() || f.constant;
    const auto size = [&](std::uint32_t side) {
      return one ? 1 : std::max(1u, side >> halvings) * refinement;
    };
    t.tiles.push_back({0, 0, size(f.width), size(f.height)});
  }
  t.tiles.push_back({});
  for (const auto& tile : t.tiles) {
    texels += std::uint64_t{tile.width + 2 * margin} * (tile.height + 2 * margin);
    t.width = std::max(t.width, tile.width + 2 * margin);
  }
  const auto square = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(texels)));
  t.width = std::max(t.width, std::min(square, widest));
  std::vector<std::uint32_t> order(t.tiles.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, std::greater<>(), [&](std::uint32_t i) { return t.tiles[i].height; });
  std::uint32_t x = t.width;
  for (const std::uint32_t i : order) {
    if (x + t.tiles[i].width + 2 * margin > t.width) {
      t.height += layout.shelves.empty() ? 0 : t.tiles[layout.shelves.back().front()].height + 2 * margin;
      layout.shelves.emplace_back();
      x = 0;
    }
    layout.shelves.back().push_back(i);
    t.tiles[i].x = x + margin, t.tiles[i].y = t.height + margin;
    x += t.tiles[i].width + 2 * margin;
  }
  t.height += t.tiles[layout.shelves.back().front()].height + 2 * margin;
  return layout;
}

// [row][column][channel]
struct Values {
  std::size_t width = 1, height = 1, channels = 3;
  std::vector<double> v;
};

// As the file has them.
Values stored(const std::vector<float>& texels, const PtexFile& file, const PtexFile::Face& face) {
  Values values{face.width, face.height, 3, {}};
  const std::size_t from = file.channels();
  for (std::size_t i = 0; i < texels.size(); i += from)
    for (std::size_t k = 0; k < 3; ++k) {  // one or two channels are grey, and alpha
      const auto value = static_cast<double>(texels[i + (from < 3 ? 0 : k)]);
      values.v.push_back(std::isfinite(value) ? value : 0);
    }
  return values;
}

Values decoded(const Values& of, const PtexTexture& texture, bool numbers) {
  Values values{of.width, of.height, numbers ? 1u : 3u, {}};
  for (std::size_t i = 0; i < of.v.size(); i += 3) {
    std::array<double, 3> c{};
    for (std::size_t k = 0; k < 3; ++k) c[k] = ptex_value(of.v[i + k], texture);
    if (numbers)
      values.v.push_back((c[0] + c[1] + c[2]) / 3);
    else
      values.v.insert(values.v.end(), c.begin(), c.end());
  }
  return values;
}

Values halved(const Values& of, std::size_t width, std::size_t height) {
  Values less{width, height, of.channels, std::vector<double>(width * height * of.channels)};
  const std::size_t across = of.width / width, down = of.height / height;
  for (std::size_t y = 0; y < of.height; ++y)
    for (std::size_t x = 0; x < of.width; ++x)
      for (std::size_t c = 0; c < of.channels; ++c)
        less.v[(y / down * width + x / across) * of.channels + c] +=
            of.v[(y * of.width + x) * of.channels + c] / static_cast<double>(across * down);
  return less;
}

// The cubic B-spline around `x` texels from the first one's centre: of the texels from floor(x) − 1 on.
std::array<double, 4> spline_weights(double x) {
  const double f = x - std::floor(x), g = 1 - f;
  return {g * g * g / 6, (4 - 6 * f * f + 3 * f * f * f) / 6, (4 - 6 * g * g + 3 * g * g * g) / 6,
          f * f * f / 6};
}

// Of one row or column of `count` numbers, `stride` apart, to `to`, `fine` times as many.
void smooth(const double* from, std::size_t count, std::size_t stride, std::size_t fine, double* to) {
  const auto last = static_cast<std::ptrdiff_t>(count) - 1;
  for (std::size_t i = 0; i < count * fine; ++i) {
    const double x = (static_cast<double>(i) + 0.5) / static_cast<double>(fine) - 0.5;
    const std::array<double, 4> weights = spline_weights(x);
    const auto first = static_cast<std::ptrdiff_t>(std::floor(x)) - 1;
    double sum = 0;
    for (std::ptrdiff_t k = 0; k < 4; ++k)
      sum += weights[static_cast<std::size_t>(k)] *
             from[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(first + k, 0, last)) * stride];
    to[i * stride] = sum;
  }
}

Values smoothed(const Values& of, std::size_t width, std::size_t height) {
  const std::size_t channels = of.channels, row = of.width * channels, wide = width * channels;
  Values across{width, of.height, channels, std::vector<double>(wide * of.height)};
  for (std::size_t y = 0; y < of.height; ++y)
    for (std::size_t c = 0; c < channels; ++c)
      smooth(&of.v[y * row + c], of.width, channels, width / of.width, &across.v[y * wide + c]);
  Values both{width, height, channels, std::vector<double>(wide * height)};
  for (std::size_t i = 0; i < wide; ++i)
    smooth(&across.v[i], of.height, wide, height / of.height, &both.v[i]);
  return both;
}

// With its margin, into the image of its shelf.
void put(const Values& values, const PtexTiles::Tile& tile, Image& shelf) {
  for (std::size_t y = 0; y < tile.height + 2 * margin; ++y)
    for (std::size_t x = 0; x < tile.width + 2 * margin; ++x) {
      const std::size_t column = std::clamp<std::size_t>(x, margin, tile.width) - margin,
                        row = std::clamp<std::size_t>(y, margin, tile.height) - margin,
                        to = y * static_cast<std::size_t>(shelf.width) + tile.x - margin + x;
      for (std::size_t c = 0; c < values.channels; ++c)
        shelf.values[to * values.channels + c] =
            static_cast<float>(values.v[(row * values.width + column) * values.channels + c]);
    }
}

Values values_of(std::size_t face, const PtexTiles::Tile& tile, PtexFile& file, const PtexTexture& texture,
                 bool numbers) {
  const PtexFile::Face mean;
  if (face == file.faces().size()) {
    const std::size_t channels = numbers ? 1 : 3;
    return {1, 1, channels, std::vector<double>(channels)};
  }
  const bool one = file.is_of_triangles() || file.faces()[face].constant;
  const auto first = file.means().begin() + static_cast<std::ptrdiff_t>(face * file.channels());
  if (one)
    return decoded(stored({first, first + static_cast<std::ptrdiff_t>(file.channels())}, file, mean), texture,
                   numbers);
  const PtexFile::Face& whole = file.faces()[face];
  Values values = stored(file.texels(face), file, whole);
  if (tile.width < whole.width || tile.height < whole.height)
    values = halved(values, tile.width, tile.height);
  return decoded(smoothed(values, tile.width, tile.height), texture, numbers);
}

std::string in_words(const PtexFile& file, int halvings) {
  const std::size_t faces = file.faces().size();
  if (file.is_of_triangles()) return fmt::format("the mean of each of its {} triangles", faces);
  return fmt::format(
      "the texels of its {} faces{}, smoothed as pbrt does from near by; only within a texel of an edge they "
      "leave out the next face",
      faces, halvings == 0 ? "" : fmt::format(", {} times halved", halvings));
}

}  // namespace

Point2f PtexTiles::at(float face, Point2f uv) const {
  const bool known = face >= 0 && face < static_cast<float>(tiles.size() - 1);
  const Tile& tile = known ? tiles[static_cast<std::size_t>(face)] : tiles.back();
  const double u = std::clamp(static_cast<double>(uv.x), 0.0, 1.0),
               v = std::clamp(static_cast<double>(uv.y), 0.0, 1.0);
  return {static_cast<float>((tile.x + u * tile.width) / width),
          static_cast<float>(1 - (tile.y + v * tile.height) / height)};
}

PtexImage ptex_image(const PtexTexture& texture, bool numbers) {
  const auto file = std::make_shared<PtexFile>(texture.filename);
  const int halvings = halvings_of(file->faces());
  const auto layout =
      std::make_shared<const Layout>(layout_of(*file, halvings, refinement_of(*file, texture, halvings)));
  const PtexTiles& tiles = layout->tiles;
  const auto read = [=](const std::function<void(Image)>& visit) {
    for (const auto& shelf : layout->shelves) {
      const PtexTiles& t = layout->tiles;
      Image image =
          black_image(static_cast<int>(t.width), static_cast<int>(t.tiles[shelf.front()].height + 2 * margin),
                      numbers ? 1 : 3);
      for (const std::uint32_t i : shelf)
        put(values_of(i, t.tiles[i], *file, texture, numbers), t.tiles[i], image);
      visit(std::move(image));
    }
  };
  return {{static_cast<int>(tiles.width), static_cast<int>(tiles.height), read},
          {layout, &tiles},
          in_words(*file, halvings)};
}

}  // namespace vitrail
