// SPDX-License-Identifier: Apache-2.0
// These functions read accessors as plain arrays.
#pragma once

#include <cstdint>
#include <vector>

#include "importers/gltf/read/document.h"

namespace vitrail::gltf {

// Returns `components` numbers an element: integers as they are, or, where the accessor is normalized, in
// [0,1] and [−1,1]; sparse ones are filled in. An accessor without a bufferView is 0. Throws Error with the
// accessor's place where it lies beyond its buffer, has another type, or an index of its own that is out of
// range.
std::vector<float> read_floats(const Document& document, int accessor, int components);

// Returns the number of elements of the accessor.
std::size_t count_of(const Document& document, int accessor);
// Returns the number of components of an element: 3 of a VEC3.
int components_of(const Document& document, int accessor);

// Reads as read_floats, but scalars that are unsigned integers.
std::vector<std::uint32_t> read_indices(const Document& document, int accessor);
// Reads unsigned integers, `components` an element (JOINTS_0).
std::vector<std::uint32_t> read_integers(const Document& document, int accessor, int components);

}  // namespace vitrail::gltf
