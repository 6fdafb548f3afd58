// SPDX-License-Identifier: Apache-2.0
#include "bundle/interiors.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

constexpr int states = 256;

const DielectricMaterial* with_priority(const Material& material) {
  const auto* dielectric = std::get_if<DielectricMaterial>(&material.model);
  return dielectric && dielectric->priority != 0 ? dielectric : nullptr;
}

}  // namespace

Interiors::Interiors(const Manifest& manifest)
    : manifest_(manifest), bases_(static_cast<int>(manifest.media.size()) + 1) {
  for (const Surface& surface : manifest.surfaces) {
    divide_space_ = divide_space_ || surface.interior != surface.exterior;
    const DielectricMaterial* dielectric = with_priority(manifest.materials[surface.material]);
    if (!dielectric) continue;
    const Volume volume{surface.material, surface.interior, surface.exterior, dielectric};
    if (std::find(volumes_.begin(), volumes_.end(), volume) == volumes_.end()) volumes_.push_back(volume);
  }
  divide_space_ = divide_space_ || !volumes_.empty();
  // An order that does not depend on where surfaces stand in their list.
  const auto key = [](const Volume& v) {
    return std::tuple(-v.dielectric->priority, v.material, v.interior, v.exterior);
  };
  std::ranges::sort(volumes_, {}, key);

  const auto needed = [&] {
    double product = bases_;
    for (std::size_t i = 0; i < volumes_.size(); ++i) product *= most_ + 1;
    return product;
  };
  while (most_ > 1 && needed() > states) --most_;
  if (needed() > states)
    throw Error(fmt::format("{} media and {} dielectrics with priorities are more than a path can tell apart",
                            manifest.media.size(), volumes_.size()));
  int stride = bases_;
  for (std::size_t i = 0; i < volumes_.size(); ++i, stride *= most_ + 1) stride_.push_back(stride);

  if (!volumes_.empty())
    for (const Surface& surface : manifest.surfaces) {
      const Volume volume{surface.material, surface.interior, surface.exterior,
                          with_priority(manifest.materials[surface.material])};
      const auto at = std::find(volumes_.begin(), volumes_.end(), volume);
      volume_of_surface_.push_back(at == volumes_.end() ? std::int8_t{-1}
                                                        : static_cast<std::int8_t>(at - volumes_.begin()));
    }
  for (int state = 0; state < states; ++state) {
    const int there = first_volume(state);
    const bool says = there >= 0 && volumes_[static_cast<std::size_t>(there)].interior !=
                                        volumes_[static_cast<std::size_t>(there)].exterior;
    media_[static_cast<std::size_t>(state)] = static_cast<std::int16_t>(
        says ? volumes_[static_cast<std::size_t>(there)].interior : state % bases_ - 1);
  }
}

int Interiors::count(int state, int volume) const {
  return state / stride_[static_cast<std::size_t>(volume)] % (most_ + 1);
}

int Interiors::entered(int state, int volume) const {
  return count(state, volume) < most_ ? state + stride_[static_cast<std::size_t>(volume)] : state;
}

int Interiors::left(int state, int volume) const {
  return count(state, volume) > 0 ? state - stride_[static_cast<std::size_t>(volume)] : state;
}

int Interiors::first_volume(int state) const {
  for (int i = 0; i < static_cast<int>(volumes_.size()); ++i)
    if (count(state, i) > 0) return i;
  return -1;
}

std::optional<DielectricFace> Interiors::face(std::uint8_t state, const Surface& surface,
                                              bool from_front) const {
  const int volume = volume_of(surface);
  const int outside = first_volume(from_front ? state : left(state, volume));
  if (outside >= 0 && outside <= volume) return std::nullopt;
  return DielectricFace{outside < 0 ? &volumes_[static_cast<std::size_t>(volume)].dielectric->exterior_eta
                                    : &volumes_[static_cast<std::size_t>(outside)].dielectric->eta};
}

std::uint8_t Interiors::beside(std::uint8_t state, const Surface& surface, bool front_side,
                               bool crossed) const {
  const int volume = volume_of(surface);
  if (volume >= 0) {
    if (!crossed) return state;
    return static_cast<std::uint8_t>(front_side ? left(state, volume) : entered(state, volume));
  }
  if (surface.interior == surface.exterior) return state;
  return static_cast<std::uint8_t>(state - state % bases_ +
                                   (front_side ? surface.exterior : surface.interior) + 1);
}

// Counts may fall below none on the way, where the ray enters before it leaves: they go round.
Interiors::Told Interiors::told_by(Told told, const Surface& surface, bool from_front) const {
  if (const int volume = volume_of(surface); volume >= 0) {
    const int before = count(told.state, volume), step = from_front ? most_ : 1;
    const int change = (before + step) % (most_ + 1) - before;
    told.state = static_cast<std::uint8_t>(told.state + change * stride_[static_cast<std::size_t>(volume)]);
  } else if (!told.medium && surface.interior != surface.exterior) {
    told.state = beside(told.state, surface, from_front, false);
    told.medium = true;
  }
  return told;
}

}  // namespace vitrail
