// SPDX-License-Identifier: Apache-2.0
// Read-only NumPy arrays view Vitrail's memory, and keep the Python object that owns it alive.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <cstdint>
#include <initializer_list>
#include <vector>

namespace vitrail::python {

template <class T>
using Array = nanobind::ndarray<nanobind::numpy, const T>;

// `strides` counts values; empty means row by row.
template <class T>
Array<T> view(const T* values, std::initializer_list<std::size_t> shape, nanobind::handle owner,
              std::initializer_list<std::int64_t> strides = {}) {
  return Array<T>(values, shape, owner, strides);
}

// Returns an array that owns what was computed for it.
Array<double> owned(std::vector<double> values);

}  // namespace vitrail::python
