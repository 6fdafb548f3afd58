// SPDX-License-Identifier: Apache-2.0
#include "importers/pbrt/read/shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "importers/pbrt/read/ply_meshes.h"
#include "importers/reading/suggestion.h"
#include "importers/shapes/shapes.h"

namespace vitrail::pbrt {

namespace {

constexpr std::uint64_t most_bytes_ahead = 256ull << 20;

}  // namespace

ShapeMaker::ShapeMaker(Context& context, std::vector<TriangleMesh>& meshes)
    : context_(context),
      meshes_(meshes),
      ply_reader_(
          [quads = quads_of(context.version)](const std::filesystem::path& path) {
            MeshReadAhead::Result result;
            result.ply = read_pbrt_ply(path, quads, &result.diagnostics);
            return result;
          },
          std::min(most_bytes_ahead, context.mesh_memory.limit_bytes() / 4)) {}

Id<TriangleMesh> ShapeMaker::add(TriangleMesh mesh) {
  meshes_.push_back(context_.mesh_memory.keep(std::move(mesh), {}));
  return {static_cast<std::uint32_t>(meshes_.size() - 1)};
}

SizedQuadric ShapeMaker::sized_quadric(const std::string& kind, ParameterSet& parameters) {
  const double radius = parameters.number("radius", 1);
  const double phimax_rad = parameters.number("phimax", 360) * std::numbers::pi / 180;
  if (kind == "disk")
    return disk(parameters.number("height", 0), radius, parameters.number("innerradius", 0), phimax_rad);
  if (kind == "cone") return cone(radius, parameters.number("height", 1), phimax_rad);
  const double extent = kind == "sphere" ? radius : 1, bottom = kind == "paraboloid" ? 0 : -extent;
  const double zmin = parameters.number("zmin", bottom), zmax = parameters.number("zmax", extent);
  return (kind == "sphere"       ? sphere
          : kind == "paraboloid" ? paraboloid
                                 : cylinder)(radius, zmin, zmax, phimax_rad);
}

ShapeGeometry ShapeMaker::quadric(const std::string& kind, ParameterSet& parameters) {
  try {
    const auto [q, to_object] = sized_quadric(kind, parameters);
    const auto [known, is_new] = quadrics_.try_emplace({q.kind, q.low, q.high, q.phi_max_rad});
    if (is_new) known->second = add(mesh_of(q));
    return {known->second, true, to_object, 1};
  } catch (const Error& error) {
    if (error.location.file.empty()) fail(error.what(), parameters.place());
    throw;
  }
}

// In v3 what lets a shadow ray pass is where either of the two is 0.
void ShapeMaker::report_shadow_alpha(ParameterSet& parameters) {
  const auto find = [&](const char* name) {
    return parameters.find(name, {ParameterType::number, ParameterType::texture});
  };
  const Parameter *shadow = find("shadowalpha"), *alpha = find("alpha");
  if (!shadow) return;
  const bool is_whole = shadow->numbers.size() == 1 && shadow->numbers.front() != 0;
  const bool same = alpha && alpha->strings == shadow->strings && alpha->numbers == shadow->numbers;
  if (!is_whole && !same)
    context_.report.dropped("\"shadowalpha\" of shapes: shadows follow \"alpha\"", shadow->place);
}

void ShapeMaker::report_patches(const Place& place) {
  context_.report.approximated(
      "bilinear patches that are no parallelograms become triangles, at most 2e-4 of their size or 2e-5 of "
      "half the mesh's off",
      place);
}

namespace {

std::vector<ShapeGeometry> listed(std::optional<ShapeGeometry> geometry) {
  return geometry ? std::vector{*geometry} : std::vector<ShapeGeometry>();
}

}  // namespace

const std::array<ShapeMaker::Kind, 13>& ShapeMaker::kinds() {
  constexpr auto quadrics = [](ShapeMaker& m, const Asked& a) {
    return listed(m.quadric(a.kind, a.parameters));
  };
  static constexpr std::array<Kind, 13> table{{
      {"trianglemesh",
       [](ShapeMaker& m, const Asked& a) {
         return listed(m.triangle_mesh(a.parameters, a.uvs_show, a.faces_show));
       }},
      {"plymesh",
       [](ShapeMaker& m, const Asked& a) { return m.ply_mesh(a.parameters, a.uvs_show, a.faces_show); }},
      {"bilinearmesh",
       [](ShapeMaker& m, const Asked& a) {
         return listed(m.bilinear_mesh(a.parameters, a.uvs_show, a.faces_show));
       }},
      {"loopsubdiv",
       [](ShapeMaker& m, const Asked& a) { return listed(m.loop_subdivision(a.parameters, a.uvs_show)); }},
      {"curve", [](ShapeMaker& m, const Asked& a) { return listed(m.curve(a.parameters)); }},
      {"sphere", quadrics},
      {"disk", quadrics},
      {"cylinder", quadrics},
      {"cone", quadrics},
      {"paraboloid", quadrics},
      {"heightfield", [](ShapeMaker& m, const Asked& a) { return listed(m.heightfield(a.parameters)); }},
      {"hyperboloid", [](ShapeMaker& m, const Asked& a) { return listed(m.hyperboloid(a.parameters)); }},
      {"nurbs", [](ShapeMaker& m, const Asked& a) { return listed(m.nurbs(a.parameters)); }},
  }};
  return table;
}

std::vector<ShapeGeometry> ShapeMaker::make(const std::string& kind, ParameterSet& parameters, bool uvs_show,
                                            bool faces_show) {
  if (const Parameter* tangents = parameters.find_list("S"))
    context_.report.approximated("the tangents \"S\" of vertices: brushed materials follow (u,v)",
                                 tangents->place);
  report_shadow_alpha(parameters);
  if (const Parameter* points = parameters.find_list("P"); points && number_count(*points) == 0) {
    context_.report.dropped(fmt::format("shape \"{}\" has no points", kind), points->place);
    return {};
  }
  const auto known = std::ranges::find(kinds(), kind, &Kind::name);
  if (known == kinds().end()) {
    std::vector<std::string> names;
    for (const Kind& other : kinds()) names.emplace_back(other.name);
    context_.report.dropped(fmt::format("shape \"{}\" is not supported{}", kind, suggestion(kind, names)),
                            parameters.place());
    return {};
  }
  std::vector<ShapeGeometry> made = known->make(*this, {kind, parameters, uvs_show, faces_show});
  parameters.report_unused(context_.report);
  return made;
}

}  // namespace vitrail::pbrt
