// SPDX-License-Identifier: Apache-2.0
#include "importers/assimp/read/asset_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "scene/system/diagnostics.h"
#include "scene/system/input_files.h"
#include "scene/system/memory_guard.h"
#include "scene/system/module.h"

namespace vitrail::assimp {

namespace {

// What assimp takes when it is loaded, and for each byte of a file: measured.
constexpr std::uint64_t library_bytes = 16 << 20, bytes_a_byte = 16;

// assimp does not check all that its readers hand on.
void require_references(const Asset& asset, const std::filesystem::path& file) {
  const auto require = [&](bool holds, const char* what) {
    if (!holds) throw Error(fmt::format("it refers to {} that is not there", what), {file.string()});
  };
  for (const AssetMesh& mesh : asset.meshes) {
    require(mesh.material < asset.materials.size(), "a material");
    for (const auto& triangle : mesh.triangles)
      require(std::ranges::all_of(triangle, [&](std::uint32_t i) { return i < mesh.positions.size(); }),
              "a vertex");
  }
  for (const AssetNode& node : asset.nodes)
    require(std::ranges::all_of(node.meshes, [&](std::size_t i) { return i < asset.meshes.size(); }),
            "a mesh");
}

}  // namespace

Asset read_asset(const std::filesystem::path& file) {
  open_regular(file);       // says best what is wrong with the name
  std::error_code unknown;  // the reader says what is wrong with the file
  const std::uint64_t bytes = std::filesystem::file_size(file, unknown);
  const GrantedMemory reading(library_bytes + (unknown ? 0 : bytes_a_byte * bytes));
  static const auto read =
      reinterpret_cast<ReadAsset>(module_symbol(asset_module, asset_symbol, "reads .fbx, .dae and .3ds"));
  Asset asset;
  if (const std::string problem = read(file.string(), asset); !problem.empty())
    throw Error(fmt::format("cannot read it: {}", problem), {file.string()});
  require_references(asset, file);
  return asset;
}

}  // namespace vitrail::assimp
