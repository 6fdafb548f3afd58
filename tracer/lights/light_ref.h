// SPDX-License-Identifier: Apache-2.0
// A LightRef names a light by its kind, and by its place among those of its kind.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>

namespace vitrail {

// The kinds are surfaces, lights that shine from one point, and infinitely far lights. The last kind shines
// alike from everywhere.
enum class LightKind : std::uint8_t { triangle, quadric, emitter, distant, environment, infinite };
inline constexpr std::size_t light_kinds = static_cast<std::size_t>(LightKind::infinite) + 1;

struct LightRef {
  LightKind kind = LightKind::triangle;
  std::uint32_t index = 0;  // into LightScene's triangles, or LightSampler's vector of the kind

  friend bool operator==(const LightRef&, const LightRef&) = default;
};

// The lights of a scene are numbered from 0, kind by kind in the order of LightKind. LightTree, whose lights
// are the first three kinds, and Emission, whose lights are all, use these numbers.
class LightNumbers {
 public:
  LightNumbers() = default;
  // `counts` says how many lights there are of each kind.
  explicit LightNumbers(const std::array<std::size_t, light_kinds>& counts) {
    for (std::size_t kind = 0; kind < light_kinds; ++kind) first_[kind + 1] = first_[kind] + counts[kind];
  }

  std::size_t size() const { return first_[light_kinds]; }
  // number < size().
  LightRef light(std::size_t number) const {
    assert(number < size());
    std::size_t kind = 0;
    while (kind + 1 < light_kinds && number >= first_[kind + 1]) ++kind;
    return {static_cast<LightKind>(kind), static_cast<std::uint32_t>(number - first_[kind])};
  }
  std::size_t number(LightRef light) const { return first_[place(light.kind)] + light.index; }

  // They are the choices of LightSampler. The first is of all lights of the tree together, each further one
  // of a single distant light or environment.
  static constexpr std::size_t choice_of_tree = 0;
  std::size_t choice(LightRef light) const {
    if (light.kind < LightKind::distant) return choice_of_tree;
    return 1 + number(light) - first_[place(LightKind::distant)];
  }
  // choice > 0.
  LightRef single_light(std::size_t choice) const {
    return light(first_[place(LightKind::distant)] + choice - 1);
  }

 private:
  static constexpr std::size_t place(LightKind kind) { return static_cast<std::size_t>(kind); }
  std::array<std::size_t, light_kinds + 1> first_{};  // number of each kind; and all
};

}  // namespace vitrail
