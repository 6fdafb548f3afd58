// SPDX-License-Identifier: Apache-2.0
#include "tracer/prepared/matte_ids.h"

#include <string>

#include "bundle/matte_names.h"
#include "film/cryptomatte.h"

namespace vitrail {

namespace {

std::vector<std::uint32_t> ids_of(const std::vector<std::string>& names) {
  std::vector<std::uint32_t> ids;
  for (const std::string& name : names) ids.push_back(matte_id(name));
  return ids;
}

}  // namespace

MatteIds matte_ids(const Manifest& m, const std::filesystem::path& bundle) {
  MatteIds ids;
  if (m.film.layers.has(Layer::crypto_object)) ids.surfaces = ids_of(read_shape_names(bundle, m));
  if (m.film.layers.has(Layer::crypto_material)) ids.materials = ids_of(material_names(m));
  return ids;
}

}  // namespace vitrail
