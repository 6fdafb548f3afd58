// SPDX-License-Identifier: Apache-2.0
#include "partitioner/meshes/edit_meshes.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>

#include "partitioner/meshes/decimate.h"
#include "partitioner/meshes/orient.h"
#include "partitioner/meshes/repair.h"
#include "scene/records/uv_uses.h"
#include "scene/shapes/deferred_mesh.h"
#include "scene/shapes/mesh_uv.h"
#include "scene/system/machine_limits.h"

namespace vitrail {

namespace {

struct Use {  // of a mesh by the scene's shapes
  bool used = false, shines = false, uvs_show = false;
  bool front_inside = false;  // counter-clockwise in the mesh is clockwise in the world
  bool fronts_differ = false;
  Origin origin;
};

void note_uses(const std::vector<Shape>& shapes, std::vector<Use>& uses) {
  for (const Shape& shape : shapes) {
    Use& use = uses[shape.mesh.value];
    const bool inside = shape.flip_orientation != swaps_handedness(shape.object_to_world);
    if (!use.used) use = {true, false, false, inside, false, shape.origin};
    use.shines |= shape.area_light.has_value();
    use.fronts_differ |= use.front_inside != inside;
  }
}

std::vector<Use> uses_of(const Scene& scene) {
  std::vector<Use> uses(scene.meshes.size());
  note_uses(scene.shapes, uses);
  for (const Prototype& prototype : scene.prototypes) note_uses(prototype.shapes, uses);
  const std::vector<bool> uvs_show = meshes_whose_uvs_show(scene);
  for (std::size_t i = 0; i < uses.size(); ++i) {
    uses[i].uvs_show = uvs_show[i];
    if (scene.meshes[i].quadric) uses[i].used = false;  // it stays what it is
  }
  return uses;
}

using Notes = std::vector<Diagnostic>;

void note(Notes& notes, Fidelity fidelity, std::string message) {
  notes.push_back({fidelity, std::move(message), {}, {}});
}

TriangleMesh repaired(const TriangleMesh& mesh, const Use& use, Notes& notes) {
  RepairedMesh result = repair(mesh, use.shines);
  std::string what;
  const auto add = [&](std::uint64_t count, const char* of) {
    if (count > 0) what += fmt::format("{}{} {}", what.empty() ? "" : ", ", count, of);
  };
  add(result.degenerate_triangles, "triangles of zero area removed");
  add(result.duplicate_triangles, "duplicate triangles removed");
  add(result.merged_vertices, "equal vertices merged");
  add(result.unused_vertices, "unused vertices removed");
  if (!what.empty()) note(notes, Fidelity::approximated, "mesh repaired: " + what);
  return std::move(result.mesh);
}

TriangleMesh oriented(const TriangleMesh& mesh, const Use& use, Notes& notes) {
  OrientedMesh result = orient(mesh, use.shines         ? Facing::consistent
                                     : use.front_inside ? Facing::inward
                                                        : Facing::outward);
  if (result.turned_triangles > 0)
    note(notes, Fidelity::approximated,
         fmt::format("mesh oriented: {} of {} triangles turned in {} components, {} closed, {} hollows",
                     result.turned_triangles, mesh.triangles.size(), result.components,
                     result.closed_components, result.inner_components));
  if (use.fronts_differ)
    note(notes, Fidelity::approximated,
         "mesh oriented for the first of its shapes; others show its other side");
  return std::move(result.mesh);
}

constexpr const char* not_manifold = "; it is no manifold, and stays as it is where it is not";

TriangleMesh subdivided(const TriangleMesh& mesh, const MeshEdits& edits, Notes& notes) {
  SubdividedMesh result = subdivide(mesh, edits.subdivide, edits.scheme);
  note(notes, Fidelity::approximated,
       fmt::format(
           "mesh subdivided: {} triangles from {}{}{}", result.mesh.triangles.size(), mesh.triangles.size(),
           result.degenerate > 0 ? fmt::format(", {} degenerate ones left out", result.degenerate) : "",
           result.manifold ? "" : "; it is no manifold, and has gaps where it is not"));
  return std::move(result.mesh);
}

TriangleMesh decimated(const TriangleMesh& mesh, double fraction, Notes& notes) {
  DecimatedMesh result = decimate(mesh, fraction);
  const std::size_t left = result.mesh.triangles.size();
  const bool more = static_cast<double>(left) > 1.02 * static_cast<double>(result.asked) + 2;
  if (left < mesh.triangles.size() || more)
    note(notes, Fidelity::approximated,
         fmt::format("mesh decimated: {} of {} triangles kept{}{}", left, mesh.triangles.size(),
                     more ? fmt::format(" where {} were asked for: its shape, seams and borders need them",
                                        result.asked)
                          : "",
                     result.manifold ? "" : not_manifold));
  return std::move(result.mesh);
}

// What (u,v) a triangle without its own has depends on the triangle: where they show, they are written out.
TriangleMesh edited(TriangleMesh mesh, const MeshEdits& edits, const Use& use, Notes& notes) {
  const MissingUv missing_uv = mesh.missing_uv;
  if (use.uvs_show) mesh = with_uvs(std::move(mesh));
  if (edits.repair) mesh = repaired(mesh, use, notes);
  if (edits.orient) mesh = oriented(mesh, use, notes);
  if (edits.subdivide > 0) mesh = subdivided(mesh, edits, notes);
  if (edits.decimate < 1) mesh = decimated(mesh, edits.decimate, notes);
  mesh.missing_uv = missing_uv;
  return mesh;
}

std::uint64_t resident_bytes() {
  std::uint64_t pages = 0, resident_pages = 0;
  std::ifstream("/proc/self/statm") >> pages >> resident_pages;
  return resident_pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

// While one mesh is edited, measured: most with CGAL's maps of edges.
double bytes_needed(std::uint64_t triangles, const MeshEdits& edits) {
  const double bytes_a_triangle = edits.orient ? 700 : 400;
  return bytes_a_triangle * static_cast<double>(triangles) * std::pow(4.0, edits.subdivide);
}

// Throws where the largest mesh does not fit; says how many like it do at once.
int meshes_at_once(const Scene& scene, const MeshEdits& edits, const MeshResources& resources,
                   const std::vector<Use>& uses) {
  const int threads = threads_for(resources.threads);
  if (resources.resident_bytes == MeshResources::unlimited) return threads;
  const double left = static_cast<double>(resources.resident_bytes) - static_cast<double>(resident_bytes());
  double most = 1;
  for (std::size_t i = 0; i < uses.size(); ++i) {
    if (!uses[i].used) continue;
    const double bytes = bytes_needed(triangles_of(scene.meshes[i]), edits);
    if (bytes > left)
      throw MachineError(fmt::format(
          "{}: to edit this mesh of {} triangles takes {:.0f} MB of memory, and {:.0f} MB are left",
          to_string(location(scene, uses[i].origin)), triangles_of(scene.meshes[i]), bytes * 1e-6,
          std::max(0.0, left) * 1e-6));
    most = std::max(most, bytes);
  }
  return std::clamp(static_cast<int>(std::min(left / most, 1e6)), 1, threads);
}

// What `resources` leave for meshes that are in their files yet.
std::uint64_t left_to_keep(const Scene& scene, const MeshResources& resources) {
  std::uint64_t in_memory = 0;
  for (const TriangleMesh& mesh : scene.meshes) in_memory += bytes_of(mesh);
  if (in_memory > resources.resident_bytes)
    throw MachineError(fmt::format("the edited meshes take {:.0f} MB, and {:.0f} MB of memory are allowed",
                                   static_cast<double>(in_memory) * 1e-6,
                                   static_cast<double>(resources.resident_bytes) * 1e-6));
  return resources.kept_bytes - std::min(resources.kept_bytes, in_memory);
}

}  // namespace

EditedMeshes edit_meshes(Scene& scene, const MeshEdits& edits, const MeshResources& resources) {
  const std::vector<Use> uses = uses_of(scene);
  std::vector<Notes> notes(scene.meshes.size());
  EditedMeshes result;
  for (std::size_t i = 0; i < uses.size(); ++i)
    if (uses[i].used) result.triangles_before += triangles_of(scene.meshes[i]);
  tbb::task_arena arena(meshes_at_once(scene, edits, resources, uses));
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, uses.size(), [&](std::size_t i) {
      TriangleMesh& mesh = scene.meshes[i];
      if (uses[i].used && !mesh.deferred) mesh = edited(std::move(mesh), edits, uses[i], notes[i]);
    });
  });
  MeshMemory memory(left_to_keep(scene, resources));
  for (std::size_t i = 0; i < uses.size(); ++i) {
    if (!uses[i].used || !scene.meshes[i].deferred) continue;
    const auto load = [source = scene.meshes[i].deferred, edits, use = uses[i]](Notes& said) {
      return edited(source->load(), edits, use, said);
    };
    scene.meshes[i] = memory.keep(load(notes[i]), [load] {
      Notes ignored;
      return load(ignored);
    });
  }
  for (std::size_t i = 0; i < uses.size(); ++i) {
    if (uses[i].used) result.triangles_after += triangles_of(scene.meshes[i]);
    for (Diagnostic& d : notes[i]) {
      d.location = d.item = location(scene, uses[i].origin);
      result.notes.push_back(std::move(d));
    }
  }
  return result;
}

}  // namespace vitrail
