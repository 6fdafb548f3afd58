// SPDX-License-Identifier: Apache-2.0
#include "importers/pbrt/read/shapes.h"
#include "importers/reading/missing_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "importers/pbrt/read/ply_meshes.h"
#include "importers/shapes/shapes.h"
#include "scene/geometry/bounds.h"
#include "scene/shapes/mesh_uv.h"

namespace vitrail::pbrt {

namespace {

void require_groups(const Parameter& parameter, std::size_t size) {
  if (number_count(parameter) % size == 0) return;
  fail(fmt::format("parameter \"{}\" has {} numbers, which is not a multiple of {}", parameter.name,
                   number_count(parameter), size),
       parameter.place);
}

// Floats of a parameter in groups of `size`, less the offset; values too large for a float throw Error.
template <class T, std::size_t size>
std::vector<T> tuples(Parameter& parameter, Vector3d offset = {}) {
  require_groups(parameter, size);
  std::vector<T> result;
  result.reserve(number_count(parameter) / size);
  prefer_huge_pages(result.data(), result.capacity());
  consume_numbers(parameter, size, [&](auto values) {
    for (std::size_t i = 0; i < values.size(); i += size) {
      std::array<float, size> v;
      for (std::size_t k = 0; k < size; ++k) {
        v[k] = static_cast<float>(static_cast<double>(values[i + k]) - offset[static_cast<int>(k)]);
        if (!std::isfinite(v[k]))
          fail(fmt::format("value {} of parameter \"{}\" is too large", size * result.size() + k,
                           parameter.name),
               parameter.place);
      }
      if constexpr (size == 3)
        result.push_back({v[0], v[1], v[2]});
      else
        result.push_back({v[0], v[1]});
    }
  });
  return result;
}

template <std::size_t size>
std::vector<std::array<std::uint32_t, size>> index_groups(Parameter& parameter, std::size_t vertex_count) {
  require_groups(parameter, size);
  std::vector<std::array<std::uint32_t, size>> groups;
  groups.reserve(number_count(parameter) / size);
  prefer_huge_pages(groups.data(), groups.capacity());
  consume_numbers(parameter, size, [&](auto values) {
    for (std::size_t i = 0; i < values.size(); i += size) {
      std::array<std::uint32_t, size> group;
      for (std::size_t k = 0; k < size; ++k) {
        const auto index = static_cast<double>(values[i + k]);
        if (index < 0 || index >= static_cast<double>(vertex_count))
          fail(fmt::format("value {} of parameter \"{}\" is {}, but there are {} vertices (counted from 0)",
                           size * groups.size() + k, parameter.name, index, vertex_count),
               parameter.place);
        group[k] = static_cast<std::uint32_t>(index);
      }
      groups.push_back(group);
    }
  });
  return groups;
}

// Values a vertex; empty where the parameter is absent.
template <class T, std::size_t size>
std::vector<T> vertex_values(Parameter* parameter, std::size_t vertex_count) {
  if (!parameter) return {};
  std::vector<T> values = tuples<T, size>(*parameter);
  if (values.size() != vertex_count)
    fail(fmt::format("parameter \"{}\" has values for {} vertices, but there are {}", parameter->name,
                     values.size(), vertex_count),
         parameter->place);
  return values;
}

Parameter& required_list(ParameterSet& parameters, std::string_view name) {
  Parameter* parameter = parameters.find_list(name);
  if (!parameter || number_count(*parameter) == 0)
    fail(fmt::format("{} needs a parameter \"{}\"", parameters.owner(), name), parameters.place());
  return *parameter;
}

Parameter* texture_coordinates(ParameterSet& parameters) {
  Parameter* uv = parameters.find_list("uv");
  return uv ? uv : parameters.find_list("st");
}

// The corners of one triangle or patch where no indices are given.
template <std::size_t size>
std::vector<std::array<std::uint32_t, size>> groups_of(ParameterSet& parameters, std::size_t vertex_count) {
  if (Parameter* indices = parameters.find_list("indices")) return index_groups<size>(*indices, vertex_count);
  if (vertex_count != size)
    fail(fmt::format("{} needs a parameter \"indices\" unless it has exactly {} points", parameters.owner(),
                     size),
         parameters.place());
  std::array<std::uint32_t, size> all{};
  for (std::size_t i = 0; i < size; ++i) all[i] = static_cast<std::uint32_t>(i);
  return {all};
}

Vector3d corner_normal_sum(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  Vector3d sum;
  for (const std::uint32_t corner : triangle)
    sum = sum + normalize(to_vector(cast<double>(mesh.normals[corner])));
  return sum;
}

Vector3d winding_normal(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  const Point3d a = cast<double>(mesh.positions[triangle[0]]), b = cast<double>(mesh.positions[triangle[1]]),
                c = cast<double>(mesh.positions[triangle[2]]);
  return cross(b - a, c - a);
}

// Lengths of normals do not matter where all three agree, as they do nearly everywhere.
bool faces_away(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  const Vector3d winding = winding_normal(mesh, triangle);
  const bool all_agree = std::ranges::all_of(triangle, [&](std::uint32_t corner) {
    return dot(winding, to_vector(cast<double>(mesh.normals[corner]))) > 0;
  });
  return !all_agree && dot(winding, corner_normal_sum(mesh, triangle)) < 0;
}

}  // namespace

bool orient_by_normals(TriangleMesh& mesh, bool uvs_show) {
  if (mesh.normals.empty()) return false;
  const auto is_away = [&](const auto& triangle) { return faces_away(mesh, triangle); };
  const auto away = static_cast<std::size_t>(std::ranges::count_if(mesh.triangles, is_away));
  if (away == 0) return false;
  const bool differs = mesh.uvs.empty();
  if (away == mesh.triangles.size()) {
    turn_round(mesh, uvs_show);
    return differs;
  }
  if (uvs_show) mesh = with_uvs(std::move(mesh));
  for (auto& triangle : mesh.triangles)
    if (is_away(triangle)) std::swap(triangle[1], triangle[2]);
  return differs;
}

bool fronts_follow_normals(const TriangleMesh& mesh) {
  return mesh.normals.empty() ||
         std::none_of(mesh.triangles.begin(), mesh.triangles.end(),
                      [&](const auto& triangle) { return faces_away(mesh, triangle); });
}

TriangleMesh with_normals_in_front(TriangleMesh mesh) {
  std::vector<char> turned(mesh.positions.size(), 0);
  for (const auto& triangle : mesh.triangles)
    if (faces_away(mesh, triangle))
      for (const std::uint32_t corner : triangle) turned[corner] = 1;
  for (std::size_t i = 0; i < turned.size(); ++i)
    if (turned[i]) mesh.normals[i] = -mesh.normals[i];
  if (!fronts_follow_normals(mesh)) mesh.normals.clear();
  return mesh;
}

namespace {

// Floats keep 24 bits: of a mesh that lies so far from the origin that more than ten are lost, positions are
// moved to it while they are still doubles. Nearer ones stay, so that meshes which touch still share their
// vertices exactly.
Vector3d offset_of(const Parameter& parameter) {
  constexpr double far = 1024;  // distance over half extent
  Bounds3d bounds;
  const auto extend_by = [&](const auto& p) {
    for (std::size_t i = 0; i + 2 < p.size(); i += 3)
      extend(bounds, Point3d{static_cast<double>(p[i]), static_cast<double>(p[i + 1]),
                             static_cast<double>(p[i + 2])});
  };
  if (parameter.long_list)
    std::visit(extend_by, *parameter.long_list);
  else
    extend_by(parameter.numbers);
  const double half = length(extent(bounds)) / 2;
  const Vector3d away = cast<double>(cast<float>(center(bounds) - Point3d{}));
  return !bounds.empty() && half > 0 && length(away) > far * half ? away : Vector3d{};
}

}  // namespace

namespace {

constexpr std::uint64_t most_bytes_ahead = 256ull << 20;

void report_patches(Report& report, const Place& place) {
  report.approximated(
      "bilinear patches that are no parallelograms become triangles, at most 2e-4 of their size or 2e-5 of "
      "half the mesh's off",
      place);
}

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

void ShapeMaker::read_ahead() {
  constexpr std::size_t text_bytes = 1 << 18;
  constexpr std::string_view suffix = ".ply\"";
  if (!context_.upcoming || !ply_reader_.has_room()) return;
  std::string_view text = context_.upcoming(text_bytes);
  const char* const end = text.data() + text.size();
  if (std::less_equal<>()(text.data(), looked_ahead_to_) && std::less_equal<>()(looked_ahead_to_, end))
    text = {looked_ahead_to_, end};
  while (true) {
    looked_ahead_to_ = text.data();
    const std::size_t at = text.find(suffix);
    if (at == text.npos) return;
    const std::size_t quote = text.rfind('"', at), behind = at + suffix.size();
    if (quote != text.npos) {
      const std::filesystem::path path =
          context_.resolve(std::string(text.substr(quote + 1, behind - quote - 2)));
      if (!ply_files_.contains(path.string()) && !ply_reader_.expect(path)) return;
    }
    text.remove_prefix(behind);
  }
}

Id<TriangleMesh> ShapeMaker::add(TriangleMesh mesh) {
  meshes_.push_back(context_.mesh_memory.keep(std::move(mesh), {}));
  return {static_cast<std::uint32_t>(meshes_.size() - 1)};
}

// pbrt leaves out numbers that are not as many as the faces.
std::vector<float> ShapeMaker::face_numbers(ParameterSet& parameters, std::size_t faces, bool show) {
  Parameter* numbers = parameters.find_list("faceIndices");
  if (!numbers || !show) return {};
  if (number_count(*numbers) != faces) {
    context_.report.dropped(
        fmt::format("\"faceIndices\" are {}, but there are {} faces", number_count(*numbers), faces),
        numbers->place);
    return {};
  }
  std::vector<float> values;
  consume_numbers(*numbers, 1, [&](auto chunk) {
    for (const auto value : chunk) values.push_back(static_cast<float>(value));
  });
  return values;
}

ShapeGeometry ShapeMaker::triangle_mesh(ParameterSet& parameters, bool uvs_show, bool faces_show) {
  TriangleMesh mesh;
  Parameter& positions = required_list(parameters, "P");
  require_groups(positions, 3);
  const Vector3d offset = offset_of(positions);
  mesh.positions = tuples<Point3f, 3>(positions, offset);
  mesh.triangles = groups_of<3>(parameters, mesh.positions.size());
  mesh.normals = vertex_values<Normal3f, 3>(parameters.find_list("N"), mesh.positions.size());
  mesh.uvs = vertex_values<Point2f, 2>(texture_coordinates(parameters), mesh.positions.size());
  orient_by_normals(mesh, uvs_show);
  const std::size_t parts = mesh.triangles.size();
  add_face_indices(mesh, face_numbers(parameters, parts, faces_show));
  return {add(std::move(mesh)), false, translate(offset), parts};
}

std::vector<ShapeGeometry> ShapeMaker::ply_mesh(ParameterSet& parameters, bool uvs_show, bool faces_show) {
  const Parameter* filename = parameters.find("filename", {ParameterType::text});
  if (!filename || filename->strings.size() != 1)
    fail("Shape \"plymesh\" needs a parameter \"string filename\"", parameters.place());
  const std::filesystem::path path = context_.resolve(filename->strings.front());
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) {
    const std::string what = fmt::format("cannot find the file \"{}\"", path.string());
    if (!context_.replace_missing) fail(what + how_to_replace_missing, filename->place);
    context_.report.dropped(what + ": the shape is left out", filename->place);
    return {};
  }
  const auto [known, is_new] = ply_files_.try_emplace(path.string());
  PlyFile& file = known->second;
  const std::size_t kind = (uvs_show ? 1u : 0u) + (faces_show ? 2u : 0u);
  std::vector<ShapeGeometry>& shapes = file.shapes[file.differs ? kind : 0];
  if (!is_new && !shapes.empty()) return shapes;
  read_ahead();
  auto [ply, diagnostics] = ply_reader_.take(path);
  if (is_new)
    for (Diagnostic& diagnostic : diagnostics) context_.report.add(std::move(diagnostic));
  std::vector<PlyMesh> parts = meshes_of(std::move(ply), uvs_show, faces_show, &file.differs);
  std::vector<ShapeGeometry>& made = file.shapes[file.differs ? kind : 0];
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].tessellated) report_patches(context_.report, parameters.place());
    const auto load = [path, quads = quads_of(context_.version), uvs_show, faces_show, i] {
      return std::move(meshes_of(read_pbrt_ply(path, quads), uvs_show, faces_show)[i].mesh);
    };
    meshes_.push_back(context_.mesh_memory.keep(std::move(parts[i].mesh), load));
    made.push_back({{static_cast<std::uint32_t>(meshes_.size() - 1)}, false, {}, parts[i].parts});
  }
  return made;
}

ShapeGeometry ShapeMaker::bilinear_mesh(ParameterSet& parameters, bool uvs_show, bool faces_show) {
  const std::vector<Point3f> positions = tuples<Point3f, 3>(required_list(parameters, "P"));
  const auto patches = groups_of<4>(parameters, positions.size());
  const auto normals = vertex_values<Normal3f, 3>(parameters.find_list("N"), positions.size());
  const auto uvs = vertex_values<Point2f, 2>(texture_coordinates(parameters), positions.size());
  TriangleMesh mesh = tessellate_bilinear(positions, patches, normals, uvs, uvs_show);
  if (mesh.triangles.size() > 2 * patches.size()) report_patches(context_.report, parameters.place());
  orient_by_normals(mesh, uvs_show);
  add_face_indices(mesh, face_numbers(parameters, patches.size(), faces_show));
  return {add(std::move(mesh)), false, {}, patches.size()};
}

// pbrt's normals of a subdivided mesh point against its winding (the ring of a vertex is walked clockwise),
// and its front follows them.
ShapeGeometry ShapeMaker::loop_subdivision(ParameterSet& parameters, bool uvs_show) {
  constexpr int most_levels = 10;
  TriangleMesh cage;
  cage.positions = tuples<Point3f, 3>(required_list(parameters, "P"));
  cage.triangles = index_groups<3>(required_list(parameters, "indices"), cage.positions.size());
  const int levels = parameters.integer("levels", parameters.integer("nlevels", 3));
  if (levels < 0 || levels > most_levels)
    fail(fmt::format("subdivision levels are {}, which is not between 0 and {}", levels, most_levels),
         parameters.place());
  parameters.ignore({"scheme"});
  TriangleMesh mesh;
  try {
    mesh = loop_subdivide(cage, levels);
  } catch (const Error& error) {
    fail(error.what(), parameters.place());
  }
  for (Normal3f& normal : mesh.normals) normal = -normal;
  turn_round(mesh, uvs_show);
  const std::size_t parts = mesh.triangles.size();
  return {add(std::move(mesh)), false, {}, parts};
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
  std::vector<ShapeGeometry> made;
  const auto take = [&](std::optional<ShapeGeometry> geometry) {
    if (geometry) made.push_back(*geometry);
  };
  if (kind == "curve")
    take(curve(parameters));
  else if (kind == "trianglemesh")
    take(triangle_mesh(parameters, uvs_show, faces_show));
  else if (kind == "plymesh")
    made = ply_mesh(parameters, uvs_show, faces_show);
  else if (kind == "bilinearmesh")
    take(bilinear_mesh(parameters, uvs_show, faces_show));
  else if (kind == "loopsubdiv")
    take(loop_subdivision(parameters, uvs_show));
  else if (kind == "sphere" || kind == "disk" || kind == "cylinder" || kind == "cone" || kind == "paraboloid")
    take(quadric(kind, parameters));
  else if (kind == "heightfield")
    take(heightfield(parameters));
  else if (kind == "hyperboloid")
    take(hyperboloid(parameters));
  else if (kind == "nurbs")
    take(nurbs(parameters));
  if (!made.empty() || kind == "curve" || kind == "plymesh") {
    parameters.report_unused(context_.report);
    return made;
  }
  const std::string closest =
      closest_word(kind, {"trianglemesh", "plymesh", "bilinearmesh", "loopsubdiv", "curve", "sphere", "disk",
                          "cylinder", "cone", "paraboloid", "heightfield", "hyperboloid", "nurbs"});
  context_.report.dropped(fmt::format("shape \"{}\" is not supported{}", kind,
                                      closest.empty() ? "" : fmt::format("; did you mean \"{}\"?", closest)),
                          parameters.place());
  return {};
}

}  // namespace vitrail::pbrt
