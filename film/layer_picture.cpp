// SPDX-License-Identifier: Apache-2.0
#include "film/layer_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "scene/records/film_layers.h"
#include "scene/spectra/color.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

const PictureChannel* channel_of(const Picture& picture, const std::string& name) {
  const auto found = std::ranges::find(picture.layers, name, &PictureChannel::name);
  return found == picture.layers.end() ? nullptr : &*found;
}

std::string first_channel(const LayerKind& kind) {
  return kind.is_matte ? fmt::format("{}00.R", kind.channels[0]) : kind.channels[0];
}

std::string layers_of(const Picture& picture) {
  std::string names;
  for (const LayerKind& kind : layer_kinds)
    if (channel_of(picture, first_channel(kind)))
      names += (names.empty() ? "" : ", ") + std::string(kind.name);
  return names.empty() ? "none: render with --aov" : names;
}

// Far apart for ids that follow on each other; black for none.
std::array<float, 3> color_of_id(std::uint32_t id) {
  std::array<float, 3> color{};
  if (id == 0) return color;
  std::uint32_t bits = id * 0x9e3779b9u;
  bits ^= bits >> 15, bits *= 0x85ebca6bu, bits ^= bits >> 13;
  for (float& c : color) {
    c = static_cast<float>(0.05 + 0.9 * (bits & 0xff) / 255.0);
    bits >>= 8;
  }
  return color;
}

float normal_as_color(float component) {
  return static_cast<float>(srgb_decode(std::clamp(0.5 + 0.5 * static_cast<double>(component), 0.0, 1.0)));
}

void show_values(Image& rgb, const Picture& picture, const LayerKind& kind, bool shown) {
  float greatest = 0;
  for (std::size_t c = 0; c < kind.sums; ++c)
    for (const float v : channel_of(picture, kind.channels[c])->values)
      if (std::isfinite(v)) greatest = std::max(greatest, std::abs(v));
  const bool is_normal = kind.has_frame && !kind.is_length;
  for (std::size_t c = 0; c < (kind.sums == 1 ? 3 : kind.sums); ++c) {
    const PictureChannel& channel = *channel_of(picture, kind.channels[kind.sums == 1 ? 0 : c]);
    for (std::size_t p = 0; p < rgb.pixels(); ++p) {
      const float v = channel.values[p];
      rgb.values[3 * p + c] = !shown                           ? v
                              : is_normal                      ? normal_as_color(v)
                              : kind.is_length && greatest > 0 ? v / greatest
                                                               : v;
    }
  }
}

void show_ids(Image& rgb, const PictureChannel& channel, bool shown) {
  for (std::size_t p = 0; p < rgb.pixels(); ++p) {
    const auto number = static_cast<float>(channel.ids[p]);
    const std::array<float, 3> color =
        shown ? color_of_id(channel.ids[p]) : std::array{number, number, number};
    std::ranges::copy(color, &rgb.values[3 * p]);
  }
}

// The colours of what covers a pixel, each as much as it covers.
void show_mattes(Image& rgb, const Picture& picture, const LayerKind& kind) {
  for (int i = 0;; ++i) {
    const std::string level = fmt::format("{}{:02}.", kind.channels[0], i / 2);
    const auto* const ids = channel_of(picture, level + "RB"[i % 2]);
    const auto* const covered = channel_of(picture, level + "GA"[i % 2]);
    if (!ids || !covered) return;
    for (std::size_t p = 0; p < rgb.pixels(); ++p) {
      const std::array<float, 3> color = color_of_id(std::bit_cast<std::uint32_t>(ids->values[p]));
      for (std::size_t c = 0; c < 3; ++c) rgb.values[3 * p + c] += covered->values[p] * color[c];
    }
  }
}

}  // namespace

void show_layer(Picture& picture, const std::string& name, bool shown) {
  FilmLayers asked;
  if (!add_named(asked, name))
    throw Error(fmt::format("--layer: \"{}\" is none of {}, normal", name, names_of({all_layers})));
  const auto kind = std::ranges::find_if(layer_kinds, [&](const LayerKind& k) {
    return asked.has(static_cast<Layer>(&k - layer_kinds.data()));
  });
  for (std::size_t c = 0; c < std::max<std::size_t>(kind->sums, 1); ++c)
    if (!channel_of(picture, c == 0 ? first_channel(*kind) : kind->channels[c]))
      throw Error(fmt::format("there is no layer {}; there is {}", kind->name, layers_of(picture)));
  Image rgb = black_image(picture.rgb.width, picture.rgb.height, 3);
  if (kind->is_matte)
    show_mattes(rgb, picture, *kind);
  else if (kind->is_id())
    show_ids(rgb, *channel_of(picture, kind->channels[0]), shown);
  else
    show_values(rgb, picture, *kind, shown);
  picture.rgb = std::move(rgb);
  picture.layers.clear(), picture.mattes.clear();
  picture.variance = picture.spectrum = {};
}

}  // namespace vitrail
