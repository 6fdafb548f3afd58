// SPDX-License-Identifier: Apache-2.0
// Writers put together small parts of a tinygltf model by these functions.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <string>

#include "importers/gltf/tinygltf.h"
#include "scene/spectra/color.h"

namespace vitrail::gltf {

inline tinygltf::Value list(std::initializer_list<double> numbers) {
  tinygltf::Value::Array array;
  for (const double v : numbers) array.emplace_back(v);
  return tinygltf::Value(array);
}
inline tinygltf::Value list(RGB c) { return list({c.r, c.g, c.b}); }

// Notes an extension as used.
inline void use(tinygltf::Model& model, const std::string& extension) {
  if (std::ranges::count(model.extensionsUsed, extension) == 0) model.extensionsUsed.push_back(extension);
}

// Returns a float by the fewest decimals that give it back, so that files are short.
inline double short_number(float value) { return std::stod(fmt::format("{}", value)); }

}  // namespace vitrail::gltf
