// SPDX-License-Identifier: Apache-2.0
// Meshes that are left on disk: what is known of them meanwhile.
#include "scene/shapes/deferred_mesh.h"

#include <gtest/gtest.h>

namespace vitrail::deferred_mesh_test {
namespace {

TEST(DeferredMeshes, AreKnownByTheirRecords) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 2, 3}, {9, 9, 9}};
  mesh.normals.resize(4, {0, 0, 1});
  mesh.triangles = {{0, 1, 2}, {2, 1, 0}};
  MeshMemory memory(bytes_of(mesh));
  const TriangleMesh kept = memory.keep(mesh, {}), stub = memory.keep(mesh, {});
  EXPECT_FALSE(kept.deferred);
  ASSERT_TRUE(stub.deferred);
  EXPECT_EQ(stub.deferred->bytes, bytes_of(mesh));
  EXPECT_EQ(triangles_of(stub), 2u);
  EXPECT_TRUE(has_normals(stub));
  EXPECT_EQ(bounds_of(stub), (Bounds3f{{0, 0, 0}, {1, 2, 3}})) << "of what triangles use";
  TriangleMesh storage;
  EXPECT_EQ(loaded(stub, storage).positions, mesh.positions);
  EXPECT_EQ(storage.normals, mesh.normals);
  EXPECT_EQ(storage.triangles, mesh.triangles);
}

// The first number of SplitMix64 from seed 0, as published.
TEST(Mixed, IsSplitMix64) { EXPECT_EQ(mixed(1, 0), 0xe220a8397b1dcdafu); }

}  // namespace
}  // namespace vitrail::deferred_mesh_test
