// SPDX-License-Identifier: Apache-2.0
// Fog as media that absorb and shine: over a distance d, σ = 1/distance leaves e^(−σ·d) of what is behind,
// and a radiance L within adds (1 − e^(−σ·d))·L. Ground fog is layers of such media, with nothing between
// them.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "importers/povray/read/reader.h"
#include "importers/povray/read/scene_maker.h"
#include "scene/geometry/frame.h"
#include "scene/spectra/rgb_to_spectrum.h"

namespace vitrail::pov {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
// Tops of layers over the offset, in units of `alt`. What lies above the last is an eightieth of the column.
constexpr std::array tops{0.0, 0.15, 0.3, 0.45, 0.6, 0.75, 0.9, 1.1,  1.3,  1.55, 1.85,
                          2.2, 2.7,  3.3, 4.0,  5.0, 6.5,  9.0, 13.0, 20.0, 50.0};

void note_approximations(Reader& reader, const Fog& fog) {
  const SourceLocation place = reader.location(fog.place);
  if (fog.ground) reader.notes.approximated("ground fog: layers, each of one density", place);
  if (fog.turbulent) reader.notes.approximated("turbulence of fog: its mean density, without swirls", place);
  if (fog.color.v[3] > 0) reader.notes.dropped("filter of a fog's color", place);
  if (fog.color.v[4] > 0) reader.notes.dropped("transmit of a fog's color: far away nothing is seen", place);
}

}  // namespace

std::optional<Id<Medium>> SceneMaker::fog_between(double low, double high) {
  double sigma = 0;
  RGB shines{0, 0, 0};
  for (const Shared<Fog>& fog : fogs_) {
    const double part = turbulent_share(*fog) * mean_density(*fog, low, high) / fog->distance;
    sigma += part;
    shines.r += part * reader_.linear(fog->color.v[0]);
    shines.g += part * reader_.linear(fog->color.v[1]);
    shines.b += part * reader_.linear(fog->color.v[2]);
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

// A large disc just below a height along `up`, with a medium on each side: a floor often lies at the height.
void SceneMaker::add_fog_face(const Fog& fog, double height, std::optional<Id<Medium>> below,
                              std::optional<Id<Medium>> above) {
  const Point3d eye = world_.camera ? Point3d{} + world_.camera->location : Point3d{};
  constexpr double beneath = 1.7e-4;
  const double up = height - beneath * fog.alt - dot(eye - Point3d{}, fog.up);
  Shape shape;
  shape.mesh = quadric_mesh({QuadricKind::disk, QuadricUv::pbrt, 0, 1});
  shape.object_to_world = translate(eye + fog.up * up - Point3d{}) * transform_of(Frame(fog.up)) *
                          scale({2 * reach_, 2 * reach_, 1});
  Material nothing;
  nothing.model = InterfaceMaterial{};
  nothing.origin = origin(fog.place);
  scene_.materials.push_back(std::move(nothing));
  shape.material = {static_cast<std::uint32_t>(scene_.materials.size() - 1)};
  shape.interior = below, shape.exterior = above;
  shape.origin = origin(fog.place);
  scene_.shapes.push_back(std::move(shape));
}

void SceneMaker::add_fog() {
  for (const Shared<Fog>& fog : world_.fogs)
    if (fog->distance > 0) {
      fogs_.push_back(fog);
      note_approximations(reader_, *fog);
    }
  if (fogs_.empty()) return;
  const auto layered = std::ranges::find_if(fogs_, [](const Shared<Fog>& fog) { return fog->ground; });
  if (layered == fogs_.end()) {
    if (fogs_.size() > 1)
      reader_.notes.approximated("several fogs: one of their sum", reader_.location(fogs_.front()->place));
    atmosphere_ = fog_between(0, 0);
    return;
  }
  const Fog& fog = **layered;
  const Vector3d eye = world_.camera ? world_.camera->location : Vector3d{};
  const double height = dot(eye, fog.up);
  double low = fog.offset;
  std::optional<Id<Medium>> below = fog_between(-infinity, low), around = below;
  const std::size_t count = fog.alt > 0 ? tops.size() : 1;
  for (std::size_t i = 0; i < count; ++i) {
    // Above the last one the rest of the column is left out, where it is alone.
    const double high = i + 1 < count ? fog.offset + fog.alt * tops[i + 1] : infinity;
    const std::optional<Id<Medium>> above = i + 1 < count || fogs_.size() > 1
                                                ? fog_between(low, std::isinf(high) ? 1e3 * reach_ : high)
                                                : std::nullopt;
    add_fog_face(fog, low, below, above);
    if (height > low) around = above;
    below = above;
    low = high;
  }
  atmosphere_ = around;
}

}  // namespace vitrail::pov
