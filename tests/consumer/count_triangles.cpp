// SPDX-License-Identifier: Apache-2.0
// count_triangles SCENE: how many meshes, triangles and materials a scene has.
#include <cstdio>

#include "importers/import.h"
#include "scene/shapes/deferred_mesh.h"
#include "scene/system/diagnostics.h"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  try {
    const vitrail::ImportedScene imported = vitrail::import_scene(argv[1]);
    std::uint64_t triangles = 0;
    for (const vitrail::TriangleMesh& mesh : imported.scene.meshes) triangles += vitrail::triangles_of(mesh);
    std::printf("%zu meshes, %llu triangles, %zu materials\n", imported.scene.meshes.size(),
                static_cast<unsigned long long>(triangles), imported.scene.materials.size());
  } catch (const vitrail::Error& e) {
    std::fprintf(stderr, "%s: %s\n", to_string(e.location).c_str(), e.what());
    return 3;
  }
}
