// SPDX-License-Identifier: Apache-2.0
#include "importers/obj/read/open_glass.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "scene/shapes/mesh_parts.h"

namespace vitrail::obj {

namespace {

enum class Fate : std::uint8_t { gone, solid, thin };

// Of the parts of one material.
struct Tally {
  std::size_t thin = 0, solid = 0, rimless = 0, doubles = 0;
  double largest = 0;
  Point3d place;  // of the largest thin one
};

bool is_sheet(const MeshPart& part) {
  return part.kind == MeshPart::Kind::open || part.kind == MeshPart::Kind::folded;
}

Vector3d normal_of(const TriangleMesh& mesh, std::uint32_t triangle) {
  const auto [a, b, c] = mesh.triangles[triangle];
  const auto p = [&](std::uint32_t i) { return cast<double>(mesh.positions[i]); };
  return normalize(cross(p(b) - p(a), p(c) - p(a)));
}

class Parting {
 public:
  explicit Parting(ImportedScene& imported) : scene_(imported.scene), diagnostics_(imported.diagnostics) {
    for (std::uint32_t i = 0; i < scene_.shapes.size(); ++i) {
      if (!std::holds_alternative<DielectricMaterial>(material_of(i).model)) continue;
      glass_.push_back(i);
      placed_.push_back({&mesh_of(i), {}});
      fates_.emplace_back(mesh_of(i).triangles.size(), Fate::gone);
    }
  }

  void run() {
    bool whole = true;
    for (const MeshPart& part : parts_of(placed_)) {
      decide(part);
      whole = whole && !is_sheet(part) && part.doubles.empty();
    }
    report();
    if (whole) return;
    for (std::size_t k = 0; k < glass_.size(); ++k) part_shape(k);
  }

 private:
  TriangleMesh& mesh_of(std::uint32_t shape) { return scene_.meshes[scene_.shapes[shape].mesh.value]; }
  Material& material_of(std::uint32_t shape) { return scene_.materials[scene_.shapes[shape].material.value]; }

  void decide(const MeshPart& part) {
    Tally& tally = tallies_[scene_.shapes[glass_[part.triangles.front().mesh]].material.value];
    const bool thin = is_sheet(part);
    const std::size_t again = part.kind == MeshPart::Kind::folded ? mark_one_side(part) : mark(part, thin);
    tally.doubles += part.doubles.size() + again;
    ++(thin ? tally.thin : tally.solid);
    tally.rimless += part.kind == MeshPart::Kind::rimless ? 1 : 0;
    if (thin && part.area > tally.largest) tally.largest = part.area, tally.place = part.centre;
  }

  std::size_t mark(const MeshPart& part, bool thin) {
    for (const auto [mesh, t] : part.triangles) fates_[mesh][t] = thin ? Fate::thin : Fate::solid;
    return 0;
  }

  // Of a flat sheet with another one on its back, what faces as its first triangle does. Returns how many do
  // not.
  std::size_t mark_one_side(const MeshPart& part) {
    mark(part, true);
    const Vector3d front = normal_of(*placed_[part.triangles[0].mesh].mesh, part.triangles[0].triangle);
    std::vector<MeshTriangle> back;
    for (const MeshTriangle& at : part.triangles) {
      const double cosine = dot(front, normal_of(*placed_[at.mesh].mesh, at.triangle));
      if (std::abs(cosine) < 1 - 1e-6) return 0;  // it is not flat
      if (cosine < 0) back.push_back(at);
    }
    for (const auto [mesh, t] : back) fates_[mesh][t] = Fate::gone;
    return back.size();
  }

  void report() {
    for (const auto& [material, tally] : tallies_) {
      const SourceLocation where = location(scene_, scene_.materials[material].origin);
      const auto note = [&](Fidelity fidelity, std::string message) {
        diagnostics_.push_back({fidelity, std::move(message), where, where, RecordKind::material});
      };
      const std::string& name = scene_.materials[material].name;
      if (tally.thin > 0)
        note(Fidelity::approximated,
             fmt::format(
                 "glass '{}': {} of its {} parts enclose nothing and are thin sheets, the largest of area "
                 "{:.4g} at {:.4g} {:.4g} {:.4g}; a part is solid where its surface is closed",
                 name, tally.thin, tally.thin + tally.solid, tally.largest, tally.place.x, tally.place.y,
                 tally.place.z));
      if (tally.rimless > 0)
        note(Fidelity::approximated,
             fmt::format(
                 "glass '{}': {} of its parts are opposite faces of panes without a rim, which are solid",
                 name, tally.rimless));
      if (tally.doubles > 0)
        note(Fidelity::approximated,
             fmt::format("glass '{}': {} of its triangles stand where others do and are left out", name,
                         tally.doubles));
    }
  }

  // What is thin goes to a shape of its own where something solid is left of it.
  void part_shape(std::size_t k) {
    std::vector<std::uint32_t> solid, thin;
    for (std::uint32_t t = 0; t < fates_[k].size(); ++t) {
      if (fates_[k][t] == Fate::solid) solid.push_back(t);
      if (fates_[k][t] == Fate::thin) thin.push_back(t);
    }
    const std::size_t all = fates_[k].size();
    if (thin.empty() && (solid.size() == all || solid.empty())) return;
    const std::uint32_t index = glass_[k];
    if (!thin.empty() && !solid.empty()) {
      Shape sheet = scene_.shapes[index];
      sheet.mesh = {static_cast<std::uint32_t>(scene_.meshes.size())};
      sheet.material = thin_of(sheet.material);
      scene_.meshes.push_back(only_triangles(mesh_of(index), thin));
      scene_.shapes.push_back(sheet);
    } else if (!thin.empty()) {
      scene_.shapes[index].material = thin_of(scene_.shapes[index].material);
    }
    const std::vector<std::uint32_t>& kept = solid.empty() ? thin : solid;
    if (kept.size() < all) mesh_of(index) = only_triangles(mesh_of(index), kept);
  }

  // The sheet of a solid glass; in its place where none of it is solid.
  Id<Material> thin_of(Id<Material> solid) {
    const auto [known, is_new] = thin_.try_emplace(solid.value, solid);
    if (!is_new) return known->second;
    Material material = scene_.materials[solid.value];
    const auto& glass = std::get<DielectricMaterial>(material.model);
    if (glass.roughness != Roughness{}) {
      const SourceLocation where = location(scene_, material.origin);
      diagnostics_.push_back({Fidelity::dropped,
                              fmt::format("roughness of the thin sheets of glass '{}'", material.name), where,
                              where, RecordKind::material});
    }
    material.model = ThinDielectricMaterial{glass.eta, glass.exterior_eta, glass.reflectance_factor,
                                            glass.transmittance_factor};
    if (tallies_[solid.value].solid == 0) {
      scene_.materials[solid.value] = std::move(material);
      return solid;
    }
    material.name += ", thin";
    scene_.materials.push_back(std::move(material));
    return known->second = {static_cast<std::uint32_t>(scene_.materials.size() - 1)};
  }

  Scene& scene_;
  Diagnostics& diagnostics_;
  std::vector<std::uint32_t> glass_;  // shapes
  std::vector<PlacedMesh> placed_;    // of these
  std::vector<std::vector<Fate>> fates_;
  std::map<std::uint32_t, Tally> tallies_;  // by material
  std::map<std::uint32_t, Id<Material>> thin_;
};

}  // namespace

void make_open_glass_thin(ImportedScene& imported) { Parting(imported).run(); }

}  // namespace vitrail::obj
