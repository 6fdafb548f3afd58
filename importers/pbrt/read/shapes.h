// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "importers/pbrt/read/context.h"
#include "importers/pbrt/read/parameters.h"
#include "importers/ply/read/mesh_read_ahead.h"
#include "importers/shapes/quadrics.h"
#include "scene/records/scene.h"
#include "scene/shapes/curve.h"

namespace vitrail::pbrt {

// It is the surface of a Shape directive.
struct ShapeGeometry {
  Id<TriangleMesh> mesh;
  // It holds for analytic shapes: their front under a mirroring transform is on the other side than that of
  // meshes.
  bool quadric = false;
  // It has the sizes of a quadric; for a mesh that is far from the origin, it says where that is.
  Transform mesh_to_object;
  // It counts the shapes that pbrt makes of it, each with the whole `power` of an area light: triangles,
  // patches, or 1.
  std::size_t parts = 1;
  bool curve = false;
};

// It makes meshes and keeps those that come again (the same file, any sphere).
class ShapeMaker {
 public:
  ShapeMaker(Context& context, std::vector<TriangleMesh>& meshes);

  // Makes the surfaces of a Shape directive. Returns none where the kind cannot be represented and is dropped
  // with a diagnostic, or where nothing of it shows; two of a PLY file of triangles and quadrilaterals. The
  // triangles' own orientation is pbrt's front side before ReverseOrientation and the transform. `uvs_show`
  // says whether (u,v) matter, `faces_show` whether the numbers of faces do.
  std::vector<ShapeGeometry> make(const std::string& kind, ParameterSet& parameters, bool uvs_show,
                                  bool faces_show);

 private:
  // It holds what a Shape directive asks for.
  struct Asked {
    const std::string& kind;
    ParameterSet& parameters;
    bool uvs_show, faces_show;
  };
  struct Kind {
    std::string_view name;
    std::vector<ShapeGeometry> (*make)(ShapeMaker& maker, const Asked& asked);
  };
  static const std::array<Kind, 13>& kinds();

  ShapeGeometry triangle_mesh(ParameterSet& parameters, bool uvs_show, bool faces_show);
  std::vector<ShapeGeometry> ply_mesh(ParameterSet& parameters, bool uvs_show, bool faces_show);
  ShapeGeometry bilinear_mesh(ParameterSet& parameters, bool uvs_show, bool faces_show);
  ShapeGeometry loop_subdivision(ParameterSet& parameters, bool uvs_show);
  std::optional<ShapeGeometry> curve(ParameterSet& parameters);
  std::optional<ShapeGeometry> ribbon(ParameterSet& parameters, const std::vector<CurveSegment>& segments,
                                      double width);
  ShapeGeometry heightfield(ParameterSet& parameters);
  ShapeGeometry hyperboloid(ParameterSet& parameters);
  ShapeGeometry nurbs(ParameterSet& parameters);
  ShapeGeometry quadric(const std::string& kind, ParameterSet& parameters);
  static SizedQuadric sized_quadric(const std::string& kind, ParameterSet& parameters);
  Id<TriangleMesh> add(TriangleMesh mesh);
  std::optional<ShapeGeometry> skimmed_mesh(ParameterSet& parameters);
  ShapeGeometry add_skimmed(std::uint64_t triangles, std::uint64_t bytes, bool has_normals);
  std::vector<float> face_numbers(ParameterSet& parameters, std::size_t faces, bool show);
  void report_shadow_alpha(ParameterSet& parameters);
  void report_patches(const Place& place);
  // Has those meshes read that the text to come names.
  void read_ahead();

  using QuadricKey = std::tuple<QuadricKind, double, double, double>;  // low, high, phi_max_rad
  Context& context_;
  std::vector<TriangleMesh>& meshes_;
  // It holds the shapes of a file where (u,v) do not show and where they do, and likewise the numbers of
  // faces. They are the same but for patches, for triangles of which some are turned, and for those numbers.
  struct PlyFile {
    bool differs = false;
    std::array<std::vector<ShapeGeometry>, 4> shapes;
  };
  std::map<std::string, PlyFile> ply_files_;
  MeshReadAhead ply_reader_;
  const char* looked_ahead_to_ = nullptr;  // in the text to come, or another file's
  std::map<QuadricKey, Id<TriangleMesh>> quadrics_;
};

}  // namespace vitrail::pbrt
