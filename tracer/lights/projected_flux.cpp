// SPDX-License-Identifier: Apache-2.0
#include "tracer/lights/projected_flux.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "scene/geometry/portable_math.h"
#include "tracer/textures/baked_image.h"
#include "tracer/textures/texel_places_lanes.h"
#include "tracer/textures/texture_ranges.h"

namespace vitrail {

namespace {

// Of the frame's [0,1]², per its area: dω = cos³θ dA of the rectangle at z = 1.
struct FrameWeight {
  Point2d half;
  bool irradiance;

  double operator()(double s, double t) const {
    if (irradiance) return pi;
    const double x = (2 * s - 1) * half.x, y = (2 * t - 1) * half.y;
    const double cosine = 1 / std::sqrt(1 + x * x + y * y);
    return cosine * cosine * cosine;
  }
};

// The texels of a row that the frame shows, each with the places of the frame where it counts and by how
// much.
class FrameAxis {
 public:
  struct Place {
    double at = 0, weight = 0;
  };

  // Looked up at a·s + c, s from 0 to 1 in steps of at most half a texel.
  FrameAxis(double a, double c, int texels, const ImageTexture& image)
      : places_(static_cast<std::size_t>(texels)) {
    constexpr double fewest = 128, most = 1 << 17;
    const auto count = static_cast<int>(std::clamp(std::ceil(2 * texels * std::abs(a)), fewest, most));
    for (int i = 0; i < count; ++i) {
      const double s = (i + 0.5) / count, weight = 1.0 / count;
      const auto add = [&](std::size_t texel, double share) {
        if (share > 0) places_[texel].push_back({s, share * weight});
      };
      if (image.filter == TextureFilter::nearest) {
        if (const int texel = lanes::single_at(a * s + c, texels, image.wrap); texel >= 0)
          add(static_cast<std::size_t>(texel), 1);
        continue;
      }
      const lanes::TexelPair<double> pair = lanes::pair_at(a * s + c, texels, image.wrap);
      for (int k = 0; k < 2; ++k)
        add(static_cast<std::size_t>(pair.texel[k]), static_cast<double>(pair.weight[k]));
    }
  }
  const std::vector<Place>& operator[](int texel) const { return places_[static_cast<std::size_t>(texel)]; }

 private:
  std::vector<std::vector<Place>> places_;
};

// The flux per area of the rectangle: Σ over texels, each as often as the frame shows it.
double mean_of_image(const ImageTexture& image, const UvMapping& m, const BakedImage& texels, bool flipped,
                     const FrameWeight& weight) {
  const auto d = [](float x) { return static_cast<double>(x); };
  // Mitsuba's textures count v from the top.
  const double e = flipped ? -d(m.e) : d(m.e), f = flipped ? d(m.e) + d(m.f) : d(m.f);
  const FrameAxis across(d(m.a), d(m.c), texels.width(), image), up(e, f, texels.height(), image);
  double sum = 0;
  for (int y = 0; y < texels.height(); ++y)
    for (int x = 0; x < texels.width() && !up[y].empty(); ++x) {
      if (across[x].empty()) continue;
      const double luminance = texels.luminance(x, y, 0);
      if (!(luminance > 0)) continue;
      double shown = 0;
      for (const FrameAxis::Place& t : up[y])
        for (const FrameAxis::Place& s : across[x]) shown += t.weight * s.weight * weight(s.at, t.at);
      sum += luminance * shown;
    }
  return sum;
}

// Over parts of the frame, of what may be anything.
std::vector<FrameFlux> parts_of(const SpectrumParameter& image, const Textures* textures,
                                std::span<const Texture> records, int side, bool flipped,
                                const std::function<double(double, double)>& weight) {
  TextureRanges ranges(textures, records);
  std::vector<FrameFlux> parts;
  for (int i = 0; i < side * side; ++i) {
    const auto at = [&](double dx, double dy) {
      const double s = (i % side + dx) / side, t = (i / side + dy) / side;
      return Point2d{s, flipped ? 1 - t : t};
    };
    TextureRegion region;
    region.middle.uv = at(0.5, 0.5);
    region.extend(at(0, 0), {});
    region.extend(at(1, 1), {});
    const ValueRange values = ranges.luminances(image, region);
    const double w = weight((i % side + 0.5) / side, (i / side + 0.5) / side);
    parts.push_back({values.mean * w, values.most * w});
  }
  return parts;
}

double mean_of(const std::vector<FrameFlux>& parts) {
  constexpr double guess = 1e-3;  // where light is found at no place that is looked at
  double sum = 0, most = 0;
  for (const FrameFlux& part : parts) sum += part.mean, most = std::max(most, part.most);
  return sum > 0 ? sum / static_cast<double>(parts.size()) : guess * most;
}

constexpr int guessing_side = 128;

}  // namespace

std::vector<FrameFlux> parts_of_frame(const SpectrumParameter& image, Point2d half, bool irradiance, int side,
                                      const Textures* textures, std::span<const Texture> records) {
  return parts_of(image, textures, records, side, irradiance, FrameWeight{half, irradiance});
}

double projected_flux(const ProjectionLight& light, Point2d half, const Textures* textures,
                      std::span<const Texture> records) {
  const FrameWeight weight{half, light.irradiance};
  const double area = 4 * half.x * half.y;
  const auto* id = std::get_if<Id<Texture>>(&*light.image);
  const auto* image = id && textures ? std::get_if<ImageTexture>(&records[id->value].model) : nullptr;
  const auto* mapping = image ? std::get_if<UvMapping>(&image->mapping) : nullptr;
  if (mapping && mapping->b == 0 && mapping->d == 0)
    return area * mean_of_image(*image, *mapping, textures->image(*id), light.irradiance, weight);
  return area *
         mean_of(parts_of_frame(light.image, half, light.irradiance, guessing_side, textures, records));
}

double mean_over_frame(const SpectrumParameter& texture, const Textures* textures,
                       std::span<const Texture> records) {
  return mean_of(
      parts_of(texture, textures, records, guessing_side, false, [](double, double) { return 1.0; }));
}

}  // namespace vitrail
