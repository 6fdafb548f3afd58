// SPDX-License-Identifier: Apache-2.0
// These limits say how deep the things of a scene may lie within each other. Readers refuse more with its
// place, so that code that walks what was read may do so by recursion.
#pragma once

#include <cstdint>

#include "scene/records/scene.h"

namespace vitrail {

// It limits textures in textures, materials in materials, objects in objects, elements of XML in elements.
inline constexpr int most_nested = 128;
// It limits files that include files.
inline constexpr std::size_t most_included = 64;
// It limits blocks of pbrt, which nobody walks by recursion.
inline constexpr std::size_t most_open_blocks = 100'000;
// It limits textures that one lookup leads to, and materials that one is made of: a shared one counts on
// every way.
inline constexpr std::uint64_t most_lookups = 1 << 15;
// They are for a bundle's textures: baking a light adds D65 at the end of a chain.
inline constexpr int most_nested_baked = 2 * most_nested;
inline constexpr std::uint64_t most_lookups_baked = 2 * most_lookups;

// It counts what lies in one texture or material; `levels` and `lookups` count itself.
struct Nesting {
  int levels = 1;
  std::uint64_t lookups = 1;  // 2⁶³ stands for more, too
  void add(const Nesting& part);
};

// Returns the nesting of each, in the order of the scene. Each record is looked at once.
std::vector<Nesting> nesting_of(const std::vector<Texture>& textures);
std::vector<Nesting> nesting_of(const std::vector<Material>& materials);

// Throws Error with the place of the first texture, material or object above the limits.
void require_shallow(const Scene& scene);

}  // namespace vitrail
