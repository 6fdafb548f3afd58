// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <sstream>

#include "importers/mitsuba/aovs.h"
#include "importers/mitsuba/read/builder.h"
#include "importers/mitsuba/read/properties.h"

namespace vitrail::mitsuba {

namespace {

using IntegratorKind = AskedIntegrator::Kind;

// Of all versions. Those that show another quantity ("depth", "ao") are not here.
constexpr std::array<NamedIntegrator, 20> integrator_kinds{{{"path", IntegratorKind::paths},
                                                            {"volpath", IntegratorKind::paths},
                                                            {"volpathmis", IntegratorKind::paths},
                                                            {"volpath_simple", IntegratorKind::paths},
                                                            {"prb", IntegratorKind::paths},
                                                            {"prb_projective", IntegratorKind::paths},
                                                            {"prbvolpath", IntegratorKind::paths},
                                                            {"vpl", IntegratorKind::paths},
                                                            {"prb_basic", IntegratorKind::by_chance},
                                                            {"bdpt", IntegratorKind::both_ends},
                                                            {"mlt", IntegratorKind::both_ends},
                                                            {"pssmlt", IntegratorKind::both_ends},
                                                            {"erpt", IntegratorKind::both_ends},
                                                            {"ptracer", IntegratorKind::from_lamps},
                                                            {"sppm", IntegratorKind::photons},
                                                            {"ppm", IntegratorKind::photons},
                                                            {"photonmapper", IntegratorKind::photon_map},
                                                            {"direct", IntegratorKind::first_hit},
                                                            {"direct_projective", IntegratorKind::first_hit},
                                                            {"emission", IntegratorKind::first_hit}}};
const std::vector<std::string> volumetric{"volpath", "volpathmis", "volpath_simple", "prbvolpath"};
// These take what is between surfaces for vacuum.
const std::vector<std::string> without_media{"path",      "prb",    "prb_projective",
                                             "prb_basic", "direct", "direct_projective"};
// Around another integrator whose picture is the first of what they write, or is found with fewer samples.
const std::vector<std::string> wrappers{"moment", "aov", "stokes", "multichannel", "adaptive", "irrcache"};

bool is_one_of(const std::string& word, const std::vector<std::string>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

// Of 0.6's, which has its radii as shares of the scene for the one, and in its units for the others.
PhotonSettings read_photons(Builder& b, const Object& integrator) {
  Report& report = b.report;
  PhotonSettings photons;
  const char* const count = integrator.type == "photonmapper" ? "global_photons" : "photon_count";
  if (const int given = integrator.integer(count, -1, report); given > 0)
    photons.photons = static_cast<std::uint64_t>(given);
  if (integrator.type == "photonmapper") return photons;
  if (const double radius = integrator.number("initial_radius", 0, report); radius > 0)
    photons.first_radius = radius;
  photons.alpha = integrator.number("alpha", 0.7, report);
  if (!(*photons.alpha > 0 && *photons.alpha < 1))
    report.fail("\"alpha\" has to be between 0 and 1", place_of(integrator, "alpha"));
  if (const int passes = integrator.integer("max_passes", -1, report); passes > 0) b.passes = passes;
  return photons;
}

// Mitsuba counts the eye's ray, and −1 is without end.
int read_depth(const Object& integrator, Report& report) {
  const int depth = integrator.integer("max_depth", -1, report);
  const Origin place = place_of(integrator, "max_depth");
  if (depth < -1)
    report.fail(fmt::format("\"max_depth\" is {}, but has to be -1 (without end) or at least 0", depth),
                place);
  if (depth == 0) report.approximated("\"max_depth\" is 0: emitters are shown all the same", place);
  if (depth < 0 || depth > unlimited_depth) return unlimited_depth;
  return std::max(depth - 1, 0);
}

void read_aovs(Builder& builder, const Object& integrator) {
  Report& report = builder.report;
  FilmLayers layers;
  std::istringstream list(integrator.text("aovs", "", report));
  for (std::string item; std::getline(list, item, ',');) {
    const std::size_t first = item.find_first_not_of(" \t\n\r"), last = item.find_last_not_of(" \t\n\r");
    if (first == std::string::npos) continue;
    const std::string name = item.substr(first, last - first + 1);
    if (!add_named(layers, name))
      report.dropped(fmt::format("\"{}\" of the integrator \"aov\"", name), place_of(integrator, "aovs"));
  }
  if (const std::string what = difference_from_mitsuba(layers); !what.empty())
    report.approximated("layers of the first surfaces: " + what, place_of(integrator, "aovs"));
  builder.scene.film.layers.bits |= layers.bits;
}

// How light is found, by the integrators of versions 0.5 to 3 and those of papers that were built on them:
// the picture that they converge to is the same.
void ignore_sampling(const Object& integrator) {
  integrator.ignore({"rr_depth", "emitter_samples", "bsdf_samples", "shading_samples", "samples_per_pass",
                     "block_size", "timeout", "strict_normals", "use_mis", "aovs"});
  integrator.ignore({"direct_samples", "glossy_samples", "indirect_samples", "luminance_samples",
                     "light_image", "sample_direct", "brute_force", "max_error", "p_value",
                     "max_sample_factor", "sample_count", "dual_buffer", "step_snapshot"});
  integrator.ignore({"photon_count", "global_photons", "caustic_photons", "volume_photons", "max_passes",
                     "initial_radius", "global_lookup_radius", "caustic_lookup_radius", "lookup_size",
                     "granularity", "auto_cancel_gathering", "k_nn", "alpha"});
  integrator.ignore({"two_stage", "bidirectional", "p_large", "bidirectional_mutation", "lens_perturbation",
                     "multi_chain_perturbation", "caustic_perturbation", "manifold_perturbation", "lambda",
                     "num_chains", "max_chains", "chain_length", "shadow_map_resolution", "clamping"});
}

}  // namespace

void read_integrator(Builder& builder, const Object& integrator) {
  Report& report = builder.report;
  report.begin_item({integrator.origin, RecordKind::integrator});
  const Object* nested = is_one_of(integrator.type, wrappers) ? integrator.child("integrator") : nullptr;
  if (nested) {
    if (integrator.type == "aov") read_aovs(builder, integrator);
    report_unused(integrator, report, {"aovs"});
    return read_integrator(builder, *nested);
  }
  builder.scene.integrator_origin = integrator.origin;
  builder.integrator = asked_for(integrator.type, integrator_kinds, wrappers);
  if (is_one_of(integrator.type, wrappers)) builder.integrator.suggestion = ": it has none inside";
  if (integrator.type == "aov") read_aovs(builder, integrator);
  RenderSettings& settings = builder.scene.settings;
  const IntegratorKind kind = builder.integrator.kind;
  settings.direct_only = kind == IntegratorKind::first_hit;
  settings.photons.reset();
  if (kind == IntegratorKind::photons || kind == IntegratorKind::photon_map)
    settings.photons = read_photons(builder, integrator);
  // Mitsuba's direct light ends at the first surface, specular or not.
  settings.max_depth = settings.direct_only ? 1 : read_depth(integrator, report);
  if (integrator.type == "emission") settings.max_depth = 0;
  settings.straight_counts = !is_one_of(integrator.type, volumetric);
  settings.hides_emitters = integrator.boolean("hide_emitters", false, report);
  ignore_sampling(integrator);
  report_unused_in_one(integrator, report, {"max_depth", "hide_emitters"});
}

void finish_integrator(Builder& builder, bool all_media) {
  if (builder.passes) builder.scene.settings.samples_per_pixel = *builder.passes;
  const Origin& place = builder.scene.integrator_origin;
  builder.report.begin_item({place, RecordKind::integrator});
  const std::string& given = builder.integrator.name;
  const std::string name = given.empty() ? "path" : given;
  if (!all_media && is_one_of(name, without_media) && leave_out_media(builder.scene))
    builder.report.dropped(fmt::format("media: {}integrator \"{}\" ignores them, in Mitsuba as here; "
                                       "\"volpath\" or --all-media shows them",
                                       given.empty() ? "the default " : "", name),
                           place);
  for (const std::string& difference : settle_integrator(builder.integrator, builder.scene))
    builder.report.approximated(difference, place);
}

}  // namespace vitrail::mitsuba
