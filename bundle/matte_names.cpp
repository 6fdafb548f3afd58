// SPDX-License-Identifier: Apache-2.0
#include "bundle/matte_names.h"

#include <fmt/format.h>

#include "bundle/checked_json.h"
#include "bundle/manifest_json.h"

namespace vitrail {

std::filesystem::path shape_names_path(const std::filesystem::path& bundle) { return bundle / "shapes.json"; }

void write_shape_names(const std::filesystem::path& bundle, std::span<const std::string> names) {
  write_checked_json(shape_names_path(bundle),
                     {{"format", "vitrail shapes"}, {"names", std::vector(names.begin(), names.end())}});
}

std::vector<std::string> read_shape_names(const std::filesystem::path& bundle, const Manifest& m) {
  const std::filesystem::path file = shape_names_path(bundle);
  std::vector<std::string> names;
  try {
    names = read_checked_json(file, "the list of shapes").at("names").get<std::vector<std::string>>();
  } catch (const Json::exception& e) {
    throw Error(fmt::format("the list of shapes is not as it should be: {}", e.what()), {file.string()});
  }
  if (names.size() != m.surfaces.size())
    throw Error(fmt::format("it has {} names, but there are {} surfaces", names.size(), m.surfaces.size()),
                {file.string()});
  return names;
}

std::vector<std::string> material_names(const Manifest& m) {
  std::vector<std::string> names;
  for (const Material& material : m.materials)
    names.push_back(material.name.empty() ? fmt::format("material-{}", names.size() + 1) : material.name);
  return names;
}

}  // namespace vitrail
