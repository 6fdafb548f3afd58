// SPDX-License-Identifier: Apache-2.0
// Glass whose transmission has a colour. pbrt's dielectrics have none, so the body of the glass absorbs.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "importers/pbrt/write/writer.h"
#include "importers/writing/export_colors.h"
#include "scene/geometry/pi.h"
#include "scene/shapes/deferred_mesh.h"
#include "scene/shapes/mesh_parts.h"

namespace vitrail::pbrt {

namespace {

const DielectricMaterial* glass_of(const Scene& scene, const Shape& shape) {
  return std::get_if<DielectricMaterial>(&scene.materials[shape.material.value].model);
}

double index_of(const DielectricMaterial& glass) {
  return index_of_refraction(glass.eta) / std::max(1e-3, index_of_refraction(glass.exterior_eta));
}

// What each face lets through of the light, where that is one spectrum and not 1.
const Spectrum* tint_of(const Scene& scene, const Shape& shape) {
  const auto* glass = glass_of(scene, shape);
  const auto* tint = glass ? std::get_if<Spectrum>(&glass->transmittance_factor) : nullptr;
  if (!tint || (is_constant(*tint) && evaluate(*tint, 550) == 1)) return nullptr;
  return shape.interior || shape.area_light || shape.opacity != FloatParameter{1.0f} ? nullptr : tint;
}

bool is_closed(const TriangleMesh& mesh, const Transform& to_world) {
  const PlacedMesh placed{&mesh, to_world};
  return std::ranges::all_of(parts_of({&placed, 1}),
                             [](const MeshPart& part) { return part.kind == MeshPart::Kind::closed; });
}

// The mean way of diffuse light through glass, ÷ the mean chord of its body: 4 · volume ÷ surface (Cauchy).
// Of a ball, 2r · E[√(1 − sin²θ ÷ n²)]; of a plate of thickness d, d · E[1 ÷ √(1 − sin²θ ÷ n²)]. sin²θ is
// uniform in 0 to 1.
double refracted(double n, bool is_plate) {
  if (!(n > 1)) return 1;
  const double least = std::sqrt(1 - 1 / (n * n));
  return is_plate ? n * n * (1 - least) : n * n * (1 - least * least * least);
}

// The mean way through a closed body in the world, as through a ball, or as through a plate where its
// 36π · volume² ÷ surface³ is below 0.2 (a ball's is 1, a cube's 0.52). Nothing where it is open, or where
// its fronts face inwards.
std::optional<double> mean_way(const TriangleMesh& given, const Shape& shape, double n) {
  TriangleMesh storage;
  const TriangleMesh& mesh = loaded(given, storage);
  if (!is_closed(mesh, shape.object_to_world)) return std::nullopt;
  double volume = 0, surface = 0;
  for (const auto& t : mesh.triangles) {
    std::array<Vector3d, 3> p;
    for (std::size_t k = 0; k < 3; ++k)
      p[k] = transform_point(shape.object_to_world, cast<double>(mesh.positions[t[k]])) - Point3d{};
    volume += dot(p[0], cross(p[1], p[2])) / 6;
    surface += length(cross(p[1] - p[0], p[2] - p[0])) / 2;
  }
  if (shape.flip_orientation) volume = -volume;
  if (!(surface > 0) || !(volume > 0)) return std::nullopt;
  const bool is_plate = 36 * pi * volume * volume < 0.2 * surface * surface * surface;
  return 4 * volume / surface * refracted(n, is_plate);
}

// σa, so that the mean way leaves what two faces leave.
Spectrum absorption(const Spectrum& face, double way) {
  constexpr double least = 1e-4;  // of what a face leaves: that is black enough
  const Spectrum faces = resolved(face);
  TabulatedSpectrum sigma_a;
  for (double l = lambda_min_nm; l <= lambda_max_nm; ++l)
    sigma_a.values.push_back(
        static_cast<float>(-2 * std::log(std::clamp(evaluate(faces, l), least, 1.0)) / way));
  return sigma_a;
}

}  // namespace

void write_tints(Writer& w) {
  if (w.scene.settings.photons) return;  // pbrt's photons ignore media
  std::map<std::uint32_t, bool> whole;   // by material: whether all its shapes absorb
  const auto lose = [&](const Shape& shape) {
    if (tint_of(w.scene, shape)) whole[shape.material.value] = false;
  };
  for (const Prototype& prototype : w.scene.prototypes) std::ranges::for_each(prototype.shapes, lose);
  for (const Shape& shape : w.scene.shapes) {
    const Spectrum* tint = tint_of(w.scene, shape);
    const auto way =
        tint ? mean_way(w.scene.meshes[shape.mesh.value], shape, index_of(*glass_of(w.scene, shape)))
             : std::nullopt;
    if (!way) {
      lose(shape);
      continue;
    }
    whole.try_emplace(shape.material.value, true);
    const std::string name = Writer::add_name(w.media, "tint");
    Parameters p(w, "shape", shape.origin, RecordKind::shape);
    p.approximated(
        fmt::format("the colour of its glass becomes absorption: exact where light goes {:.3g} "
                    "through it, the mean way",
                    *way));
    p.spectrum("sigma_a", absorption(*tint, *way)).spectrum("sigma_s", Spectrum{ConstantSpectrum{0}});
    w.line(fmt::format("MakeNamedMedium {} \"string type\" \"homogeneous\"{}", in_quotes(name), p.list()));
    w.tints.emplace(&shape, name);
  }
  for (const auto& [material, all] : whole)
    if (all) w.tinted.insert(material);
}

}  // namespace vitrail::pbrt
