// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/read/shape_geometry.h"

#include <fmt/format.h>

#include <cctype>

#include "importers/reading/missing_files.h"

namespace vitrail::mitsuba {

std::string kind_of(const Object& shape) {
  std::string kind = shape.type;
  if (!kind.empty()) kind[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(kind[0])));
  return kind;
}

Id<TriangleMesh> shared_mesh(Builder& builder, const Object& shape, const MeshKey& key,
                             const std::function<TriangleMesh()>& make, MeshLoader again) {
  const auto known = builder.mesh_files.find(key);
  if (known != builder.mesh_files.end()) return known->second;
  TriangleMesh mesh;
  try {
    mesh = make();
  } catch (const Error& error) {
    if (!error.location.file.empty()) throw;
    builder.report.fail(error.what(), shape.origin);
  }
  const Id<TriangleMesh> id{static_cast<std::uint32_t>(builder.scene.meshes.size())};
  builder.scene.meshes.push_back(builder.mesh_memory.keep(std::move(mesh), std::move(again)));
  builder.mesh_files.emplace(key, id);
  return id;
}

bool lacks_its_file(const Object& shape) {
  const auto* name =
      shape.has("filename") ? std::get_if<std::string>(&shape.find("filename")->value) : nullptr;
  std::error_code ignored;
  return name && !std::filesystem::exists(*name, ignored);
}

std::filesystem::path shape_file(Builder& builder, const Object& shape) {
  const Property* property = shape.find("filename");
  const std::string name = shape.text("filename", "", builder.report);
  if (!property || name.empty())
    builder.report.fail(fmt::format("shape \"{}\" needs a string \"filename\"", shape.type), shape.origin);
  std::filesystem::path path = name;
  if (path.is_relative())
    path = std::filesystem::path(builder.report.location(property->origin).file).parent_path() / path;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored))
    builder.report.fail(fmt::format("cannot find the file \"{}\"{}", path.string(), how_to_replace_missing),
                        property->origin);
  return path.lexically_normal();
}

}  // namespace vitrail::mitsuba
