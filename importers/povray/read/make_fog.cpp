// SPDX-License-Identifier: Apache-2.0
// Fog as media that absorb and shine: over a distance d, σ = 1/distance leaves e^(−σ·d) of what is behind,
// and a radiance L within adds (1 − e^(−σ·d))·L. Ground fog is layers of such media, with nothing between
// them. Fog that transmits ends around the eye, where no more of it is seen.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "importers/povray/read/reader.h"
#include "importers/povray/read/scene_maker.h"
#include "importers/solids/revolution.h"
#include "scene/geometry/frame.h"
#include "scene/spectra/rgb_to_spectrum.h"

namespace vitrail::pov {

namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();
// Tops of layers over the offset, in units of `alt`. What lies above the last is an eightieth of the column.
constexpr std::array tops{0.0, 0.15, 0.3, 0.45, 0.6, 0.75, 0.9, 1.1,  1.3,  1.55, 1.85,
                          2.2, 2.7,  3.3, 4.0,  5.0, 6.5,  9.0, 13.0, 20.0, 50.0};

void note_approximations(Reader& reader, const Fog& fog) {
  const SourceLocation place = reader.location(fog.place);
  if (fog.ground) reader.notes.approximated("ground fog: layers, each of one density", place);
  if (fog.turbulent) reader.notes.approximated("turbulence of fog: its mean density, without swirls", place);
  if (fog.color.v[3] > 0)
    reader.notes.approximated("filter of a fog's color: a sheet before the eye, and none before mirrors",
                              place);
  if (fog.color.v[4] > 0)
    reader.notes.approximated("transmit of a fog's color: of the fog around the eye, in mirrors too", place);
}

}  // namespace

std::optional<Id<Medium>> SceneMaker::fog_between(double low, double high) {
  double sigma = 0;
  RGB shines{0, 0, 0};
  for (const Shared<Fog>& fog : fogs_) {
    const double part = turbulent_share(*fog) * mean_density(*fog, low, high) / fog->distance;
    const std::array<double, 3> filter = filter_of(*fog);
    const auto shown = [&](std::size_t i) {  // through the sheet before the eye
      return part * reader_.linear(fog->color.v[i]) / std::max(filter[i], 1e-3);
    };
    sigma += part;
    shines.r += shown(0);
    shines.g += shown(1);
    shines.b += shown(2);
  }
  if (!(sigma > 0)) return std::nullopt;
  Medium medium;
  medium.name = "fog";
  medium.veils = true;
  AbsorptionScattering coefficients;
  coefficients.sigma_a = Spectrum{ConstantSpectrum{static_cast<float>(sigma)}};
  coefficients.sigma_s = Spectrum{ConstantSpectrum{0}};
  medium.coefficients = coefficients;
  medium.emission = emission_from_rgb({shines.r / sigma, shines.g / sigma, shines.b / sigma});
  medium.origin = origin(fogs_.front()->place);
  scene_.media.push_back(std::move(medium));
  return Id<Medium>{static_cast<std::uint32_t>(scene_.media.size() - 1)};
}

void SceneMaker::add_fog_shape(const Fog& fog, Id<TriangleMesh> mesh, const Transform& to_world,
                               std::optional<Id<Medium>> interior, std::optional<Id<Medium>> exterior) {
  Material nothing;
  nothing.model = InterfaceMaterial{};
  nothing.origin = origin(fog.place);
  scene_.materials.push_back(std::move(nothing));
  Shape shape;
  shape.mesh = mesh;
  shape.object_to_world = to_world;
  shape.material = {static_cast<std::uint32_t>(scene_.materials.size() - 1)};
  shape.interior = interior, shape.exterior = exterior;
  shape.origin = origin(fog.place);
  scene_.shapes.push_back(std::move(shape));
}

// A disc just below a height along `up`, with a medium on each side: a floor often lies at the height.
void SceneMaker::add_fog_face(const FogEdge& edge, double height, std::optional<Id<Medium>> below,
                              std::optional<Id<Medium>> above) {
  const double radius = std::min(edge.radius(height), 2 * reach_);
  if (!(radius > 0)) return;
  constexpr double beneath = 1.7e-4;
  const double rise = height - beneath * edge.fog.alt - edge.eye;
  const Transform to_world = translate(eye() + edge.fog.up * rise - Point3d{}) *
                             transform_of(Frame(edge.fog.up)) * scale({radius, radius, 1});
  add_fog_shape(edge.fog, quadric_mesh({QuadricKind::disk, QuadricUv::pbrt, 0, 1}), to_world, below, above);
}

// The end of a layer that transmits: beyond it there is no fog.
void SceneMaker::add_fog_side(const FogEdge& edge, double low, double high, Id<Medium> medium) {
  if (!(edge.fog.color.v[4] > 0)) return;
  low = std::max({low, edge.low, edge.eye - 2 * reach_});
  high = std::min({high, edge.high, edge.eye + 2 * reach_});
  if (!(low < high)) return;
  constexpr int rings = 32, segments = 96;
  std::vector<solids::MeridianChord> chords;
  const auto at = [&](int k) {
    const double height = low + (high - low) * (1 - std::cos(k * std::numbers::pi / rings)) / 2;
    return Point2d{std::min(edge.radius(height), 2 * reach_), height - edge.eye};
  };
  for (int k = 0; k < rings; ++k) solids::append_line(chords, at(k), at(k + 1));
  Transform y_to_z;
  y_to_z.m[1] = {0, 0, -1, 0};
  y_to_z.m[2] = {0, 1, 0, 0};
  add_fog_shape(edge.fog, add_mesh(solids::mesh_of(solids::revolve(chords, segments))),
                translate(eye() - Point3d{}) * transform_of(Frame(edge.fog.up)) * y_to_z, medium,
                std::nullopt);
}

// What fog filters, as a colored sheet around the eye: a ball that is small for the scene.
void SceneMaker::add_fog_filter(const Fog& fog) {
  const std::array<double, 3> filter = filter_of(fog);
  const double radius = std::max(1e-7 * reach_, world_.camera ? world_.camera->aperture : 0);
  ThinDielectricMaterial sheet;
  sheet.eta = ConstantSpectrum{1};
  sheet.transmittance_factor = Spectrum{
      unbounded_from_rgb({reader_.linear(filter[0]), reader_.linear(filter[1]), reader_.linear(filter[2])})};
  sheet.reflectance_factor = Spectrum{ConstantSpectrum{0}};
  add_fog_shape(fog, quadric_mesh({QuadricKind::sphere}),
                translate(eye() - Point3d{}) * scale({radius, radius, radius}), atmosphere_, atmosphere_);
  scene_.materials.back().model = sheet;
  scene_.materials.back().casts_shadow = false;
}

void SceneMaker::add_fog() {
  for (const Shared<Fog>& fog : world_.fogs)
    if (fog->distance > 0 && fog->color.v[4] < 1) fogs_.push_back(fog);
  if (fogs_.empty()) return;
  const SourceLocation place = reader_.location(fogs_.front()->place);
  if (fogs_.size() > 1)
    for (Shared<Fog>& fog : fogs_) {
      if (fog->color.v[3] > 0 || fog->color.v[4] > 0)
        reader_.notes.dropped("filter and transmit of one of several fogs", place);
      auto opaque = std::make_shared<Fog>(*fog);
      opaque->color.v[3] = opaque->color.v[4] = 0;
      fog = opaque;
    }
  for (const Shared<Fog>& fog : fogs_) note_approximations(reader_, *fog);
  const auto layered = std::ranges::find_if(fogs_, [](const Shared<Fog>& fog) { return fog->ground; });
  if (layered == fogs_.end()) {
    if (fogs_.size() > 1) reader_.notes.approximated("several fogs: one of their sum", place);
    atmosphere_ = fog_between(0, 0);
  } else {
    add_layers(**layered);
  }
  const Fog& fog = **(layered == fogs_.end() ? fogs_.begin() : layered);
  if (layered == fogs_.end() && atmosphere_)
    add_fog_side(edge_of(fog, dot(eye() - Point3d{}, fog.up)), -unbounded, unbounded, *atmosphere_);
  if (fog.color.v[3] > 0) add_fog_filter(fog);
}

void SceneMaker::add_layers(const Fog& fog) {
  const FogEdge edge = edge_of(fog, dot(eye() - Point3d{}, fog.up));
  double low = -unbounded, high = fog.offset;
  std::optional<Id<Medium>> layer = fog_between(low, high), around = layer;
  const std::size_t count = fog.alt > 0 ? tops.size() : 1;
  for (std::size_t i = 0; i < count; ++i) {
    if (layer) add_fog_side(edge, low, high, *layer);
    const std::optional<Id<Medium>> below = layer;
    low = high;
    // Above the last one the rest of the column is left out, where it is alone.
    high = i + 1 < count ? fog.offset + fog.alt * tops[i + 1] : unbounded;
    layer = i + 1 < count || fogs_.size() > 1 ? fog_between(low, std::isinf(high) ? 1e3 * reach_ : high)
                                              : std::nullopt;
    add_fog_face(edge, low, below, layer);
    if (edge.eye > low) around = layer;
  }
  atmosphere_ = around;
}

}  // namespace vitrail::pov
