// SPDX-License-Identifier: Apache-2.0
// Memory of ours as NumPy arrays that cannot be written to. They keep alive the Python object that owns it.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <cstdint>
#include <initializer_list>
#include <vector>

namespace vitrail::python {

template <class T>
using Array = nanobind::ndarray<nanobind::numpy, const T>;

// `strides` counts values; empty: row by row.
template <class T>
Array<T> view(const T* values, std::initializer_list<std::size_t> shape, nanobind::handle owner,
              std::initializer_list<std::int64_t> strides = {}) {
  return Array<T>(values, shape, owner, strides);
}

// An array that owns what was computed for it.
Array<double> owned(std::vector<double> values);

}  // namespace vitrail::python
