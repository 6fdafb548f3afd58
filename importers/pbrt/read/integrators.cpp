// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "importers/pbrt/read/camera_film.h"

namespace vitrail::pbrt {

namespace {

using IntegratorKind = AskedIntegrator::Kind;

// Of all versions. What is not here is another picture ("ambientocclusion").
constexpr std::array<NamedIntegrator, 14> integrator_kinds{{{"path", IntegratorKind::paths},
                                                            {"volpath", IntegratorKind::paths},
                                                            {"simplepath", IntegratorKind::paths},
                                                            {"simplevolpath", IntegratorKind::paths},
                                                            {"bdpt", IntegratorKind::both_ends},
                                                            {"mlt", IntegratorKind::both_ends},
                                                            {"metropolis", IntegratorKind::both_ends},
                                                            {"lightpath", IntegratorKind::from_lamps},
                                                            {"randomwalk", IntegratorKind::by_chance},
                                                            {"sppm", IntegratorKind::photons},
                                                            {"photonmap", IntegratorKind::photon_map},
                                                            {"exphotonmap", IntegratorKind::photon_map},
                                                            {"directlighting", IntegratorKind::direct},
                                                            {"whitted", IntegratorKind::direct}}};

// Its radius shrinks by the same share, γ = ⅔. v4 has an iteration for each of the sampler's samples.
PhotonSettings read_photons(ParameterSet& parameters, Context& context, ViewSettings& view) {
  PhotonSettings photons;
  if (const int count = parameters.integer("photonsperiteration", -1); count > 0)
    photons.photons = static_cast<std::uint64_t>(count);
  if (const double radius = parameters.number("radius", -1); radius > 0) photons.first_radius = radius;
  const int given = parameters.integer("iterations", parameters.integer("numiterations", -1));
  if (given == 0 || given < -1) fail("\"iterations\" has to be above 0", parameters.place());
  if (given > 0)
    view.iterations = given;
  else if (context.version == Version::v3)
    view.iterations = 64;
  return photons;
}

}  // namespace

bool passes_media_by(const std::string& integrator) {
  constexpr std::array<std::string_view, 7> names{
      "path", "simplepath", "directlighting", "whitted", "lightpath", "randomwalk", "sppm"};
  return std::ranges::count(names, integrator) > 0;
}

bool has_subsurface(const Scene& scene) {
  return std::ranges::any_of(
      scene.materials, [](const Material& m) { return std::holds_alternative<SubsurfaceMaterial>(m.model); });
}

void read_integrator(const std::string& kind, ParameterSet& parameters, Context& context,
                     ViewSettings& view) {
  const int depth = parameters.integer("maxdepth", 5);
  if (depth < 0) fail("\"maxdepth\" is negative", parameters.place());
  view.integrator = asked_for(kind, integrator_kinds);
  view.render.max_depth = depth;
  view.render.direct_only = view.integrator.kind == IntegratorKind::direct;
  view.render.photons.reset();
  view.iterations.reset();
  if (view.integrator.kind == IntegratorKind::photons)
    view.render.photons = read_photons(parameters, context, view);
  else if (view.integrator.kind == IntegratorKind::photon_map)
    view.render.photons.emplace();
  if (parameters.boolean("regularize", false))
    context.report.dropped("rough paths are not regularised", parameters.place());
  parameters.ignore({"rrthreshold", "lightsampler", "lightsamplestrategy", "samplelights", "samplebsdf",
                     "strategy", "visualizestrategies", "visualizeweights", "bootstrapsamples", "chains",
                     "mutationsperpixel", "largestepprobability", "sigma", "photonsperiteration", "radius",
                     "seed", "iterations", "numiterations", "imagewritefrequency"});
  parameters.report_unused(context.report);
}

}  // namespace vitrail::pbrt
