// SPDX-License-Identifier: Apache-2.0
// These meshes stay in their files when not all fit into memory.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "scene/geometry/bounds.h"
#include "scene/shapes/mesh.h"

namespace vitrail {

using MeshLoader = std::function<TriangleMesh()>;

// Triangles count as together with the middle ones where they are nearer than this many radii of the
// MeshFocus.
inline constexpr double near_radii = 256;

// It says where a mesh's triangles are, whatever few of them are elsewhere: the middle one's place, the
// distance on the greatest axis within which half of them lie, and the box of those together with them.
struct MeshFocus {
  Point3d centre;
  double radius = 0;
  Bounds3d box;
};

// It is known of a mesh without loading it.
struct DeferredMesh {
  MeshLoader load;  // from any thread; throws Error as its first reading would have
  std::uint64_t triangles = 0, bytes = 0;
  bool has_normals = false;
  Bounds3f bounds;  // of the vertices that triangles use
  MeshFocus focus;
  // It is one of the triangles chosen at random, each with probability 2^-sample_shift.
  struct Sample {
    std::uint32_t triangle;
    std::array<Point3f, 3> vertices;
  };
  int sample_shift = 0;
  std::vector<Sample> sample;
};

// Returns the bytes that the mesh takes in memory.
std::uint64_t bytes_of(const TriangleMesh& mesh);

// They answer for a mesh that may be deferred, or for a quadric, which counts as 1 a place, without shading
// normals of its own.
std::uint64_t triangles_of(const TriangleMesh& mesh);
bool has_normals(const TriangleMesh& mesh);
Bounds3f bounds_of(const TriangleMesh& mesh);
// Returns the focus, by about a thousand of its triangles.
MeshFocus focus_of(const TriangleMesh& mesh);

// Returns the mesh, loaded into `storage` if it is deferred, tessellated if it is a quadric. Throws Error
// where the file has changed since.
const TriangleMesh& loaded(const TriangleMesh& mesh, TriangleMesh& storage);

// Returns a hash of two numbers, for choices that are to look random.
std::uint64_t mixed(std::uint64_t a, std::uint64_t b);

// It keeps meshes in memory up to a limit.
class MeshMemory {
 public:
  explicit MeshMemory(std::uint64_t limit_bytes = ~std::uint64_t{0})
      : limit_(limit_bytes), left_(limit_bytes) {}

  std::uint64_t limit_bytes() const { return limit_; }
  bool is_limited() const { return limit_ != ~std::uint64_t{0}; }

  // Returns the mesh itself while it fits, else a stub that stands for it. Without `load` the mesh goes to a
  // file without a name in the folder for temporary files; MachineError is thrown where that is full.
  TriangleMesh keep(TriangleMesh mesh, MeshLoader load);

 private:
  std::uint64_t limit_, left_, triangles_ = 0;
  std::vector<std::shared_ptr<DeferredMesh>> deferred_;
  int shift_ = 0;
};

}  // namespace vitrail
