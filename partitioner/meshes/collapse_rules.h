// SPDX-License-Identifier: Apache-2.0
// CollapseRules say which edges may be collapsed, and at what cost.
#pragma once

#include <OpenMesh/Core/Utils/vector_traits.hh>
// QuadricT.hh needs these traits and does not include them.
#include <OpenMesh/Core/Geometry/QuadricT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/CollapseInfoT.hh>
#include <optional>

#include "partitioner/meshes/surface.h"

namespace vitrail {

struct DoublePoints : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
};
using HalfEdges = OpenMesh::TriMesh_ArrayKernelT<DoublePoints>;

// Features are borders of the surface and seams, where wedges or attributes of the faces differ across an
// edge. A vertex on two of the same kind slides along them; one with none moves freely; all others stay. No
// collapse changes what its neighbours are.
class CollapseRules {
 public:
  using Collapse = OpenMesh::Decimater::CollapseInfoT<HalfEdges>;  // of v0 into v1

  // Faces and vertices of the half-edge mesh have the numbers of the surface's; its diagonal is 1.
  CollapseRules(HalfEdges& mesh, const TriangleMesh& source, const MeshSurface& surface);

  // Returns the quadric error, area × distance²; none where v0 must not move to v1. Cheap.
  std::optional<double> cost(const Collapse& collapse);
  // Returns whether the surface stays one and its triangles sound. It is asked where there is a cost.
  bool is_sound(const Collapse& collapse);
  void apply(const Collapse& collapse);

  const std::vector<Triangle>& wedges() const { return wedges_; }  // of the faces, as they are now

 private:
  using Point = HalfEdges::Point;
  using Vertex = OpenMesh::VertexHandle;
  using Edge = OpenMesh::HalfedgeHandle;
  using Face = OpenMesh::FaceHandle;
  enum class Kind : std::uint8_t { smooth, seam, border, fixed };
  struct Error {  // of a vertex
    OpenMesh::Geometry::QuadricT<double> quadric;
    double weight = 0;  // area
    void add(const OpenMesh::Geometry::QuadricT<double>& plane, double area);
  };

  Kind kind_of_edge(Edge h);
  Kind kind_of_vertex(Vertex v);
  void add_planes();
  void find_limits();
  std::size_t corner(Face f, Vertex v) const;
  std::uint32_t wedge(Face f, Vertex v) const { return wedges_[index(f)][corner(f, v)]; }
  void find_changes(const Collapse& collapse);
  struct Change {  // of a face that stays around v0
    Face face;
    std::size_t corner;
    std::uint32_t wedge;
  };
  bool stays_sound(const Change& change, const Point& position);
  Edge other_feature(const Collapse& collapse, Kind kind);
  double border_shift(const Collapse& collapse, Vertex other);
  template <class Handle_>
  static std::size_t index(Handle_ h) {
    return static_cast<std::size_t>(h.idx());
  }

  HalfEdges& mesh_;
  const TriangleMesh& source_;
  std::vector<Triangle> vertices_, wedges_;
  std::vector<std::uint32_t> face_class_;
  std::vector<Kind> kinds_;
  std::vector<Error> errors_;
  struct Limits {  // of a connected component
    double error = 0, border_shift = 0;
  };
  std::vector<Limits> limits_;
  std::vector<std::uint32_t> component_;  // of a vertex
  std::vector<float> shifts_;             // that borders at a vertex may have made already
  std::vector<Change> changes_;
};

}  // namespace vitrail
