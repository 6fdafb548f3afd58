// SPDX-License-Identifier: Apache-2.0
// Connections to lights: rays that deposit what they carry where nothing is in their way. Where the scene has
// something that light passes straight through, they are paths of their own that go on behind it.
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "scene/geometry/portable_math.h"
#include "tracer/bsdf/local.h"
#include "tracer/media/phase.h"
#include "tracer/paths/path_state.h"
#include "tracer/paths/path_tracer.h"
#include "tracer/quadrics/quadric_hits.h"
#include "tracer/quadrics/quadric_surface.h"
#include "tracer/rays/connection_code.h"
#include "tracer/rays/rounding.h"

namespace vitrail {

namespace {

// A connection's ray: coded, and as far as it goes, in lengths of its direction; ∞ where its light is.
struct Aimed {
  DirectionCode direction;
  Vector3f rounded = decode_direction(direction);
  double end = std::numeric_limits<double>::infinity();
  double cosine = 1;  // of its direction to the surface's normal there; of StraightAim's slope
};

double slope_of(double cosine) { return std::sqrt(std::max(0.0, 1 - cosine * cosine)) / std::abs(cosine); }

// Where the ray meets the quadric, nearest to where it ended. Near its limb it may pass by.
void end_on_quadric(const Ray& ray, const EmissiveQuadric& q, Aimed& aimed) {
  const QuadricHits hits =
      quadric_hits(prepare(ray), q.to_bundle, q.quadric.quadric, ray.exclude == q.triangle);
  if (hits.count == 0) return;
  const auto off = [&](int i) { return std::abs(hits.at[i].t - aimed.end); };
  const auto& [t, local] = hits.at[hits.count == 2 && off(1) < off(0) ? 1 : 0];
  const Vector3d direction = cast<double>(ray.direction);
  aimed.end = t * (1 - 1e-12);
  aimed.cosine = dot(direction, placed_quadric_normal(q.quadric, q.to_bundle, local));
}

// From where it departs, beside the point that the light was sampled for. It ends at the light, where it
// meets the surface that was sampled, of triangles its plane: by its rounded direction, not quite where that
// was. There an error of the direction counts by the inverse cosine.
Aimed aim(const Departure& from, const LightSample& light) {
  if (std::isinf(light.distance)) return {encode_direction(light.to_light)};
  const Vector3d way = from.p + light.to_light * light.distance - cast<double>(from.origin);
  Aimed aimed{encode_direction(dot(way, way) > 0 ? way : light.to_light)};
  const Vector3d direction = cast<double>(aimed.rounded);
  const double distance = length(way), there = dot(way, direction) / dot(direction, direction);
  aimed.end = there;
  if (light.quadric) {
    end_on_quadric({from.origin, aimed.rounded, from.exclude}, *light.quadric, aimed);
    return aimed;
  }
  const double height = dot(way, light.normal), cosine = dot(direction, light.normal);
  if (!(height * cosine > 0)) return aimed;
  // So much aside, a neighbour may stand out of the plane by its tilt.
  const double aside = direction_rounding * distance / std::abs(cosine);
  const double plane = (height / cosine) * (1 - 1e-12) - aside * light.tilt_rad / std::abs(cosine);
  aimed.end = std::clamp(plane, 0.5 * there, 2 * there);
  aimed.cosine = cosine;
  return aimed;
}

float float_below(double x) {  // x ≥ 0
  const auto nearest = static_cast<float>(x);
  if (!(static_cast<double>(nearest) > x)) return nearest;
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(nearest) - 1);
}

}  // namespace

namespace {

double sum_of(const SampledSpectrum& s) {
  double sum = 0;
  for (const float x : s.v) sum += static_cast<double>(x);
  return sum;
}

// Of the numbers of a set, those of its candidate `k`: digits are flipped as in the first points of Sobol's
// sequence, so that four candidates lie in different quarters of each dimension, 16 in different 16ths, and
// each alone keeps the strata of the set.
std::array<float, 4> numbers_of_candidate(std::array<float, 4> u, std::uint32_t k) {
  constexpr std::array<std::uint32_t, most_light_candidates> straight{0, 8, 4, 12, 2, 10, 6, 14,
                                                                      1, 9, 5, 13, 3, 11, 7, 15},
      turned{0, 8, 12, 4, 10, 2, 6, 14, 15, 7, 3, 11, 5, 13, 9, 1};
  const auto flipped = [](float x, std::uint32_t digits) {
    return static_cast<float>(static_cast<std::uint32_t>(x * 0x1p24f) ^ digits << 20) * 0x1p-24f;
  };
  return {flipped(u[0], straight[k]), flipped(u[1], turned[k]), flipped(u[2], straight[k]),
          flipped(u[3], turned[k])};
}

}  // namespace

// How many candidates for a light a path has at a point: several where the camera sees it, directly or
// through mirrors and glass, and where they differ.
std::uint32_t PathTracer::light_candidates(const Path& path, Point3d p, bool diffuse) const {
  if (path.pdf > 0) return 1;
  switch (variety(scene_.lights, p)) {
    case Variety::none:
      return 1;
    case Variety::little:
      return diffuse ? 1 : scene_.sampling.light_candidates;
    default:
      return scene_.sampling.light_candidates;
  }
}

// Of `count` candidates for a light one is connected to, chosen by what each would bring if nothing was in
// its way, and brings their mean (resampling: Talbot, Cline & Egbert 2005). Their weights of multiple
// importance sampling are of `count` samples of the lights and one of the BSDF. `scatter(direction)` gives
// the value and the density of scattering to there, `depart(direction)` where the ray starts.
template <class Scatter, class Depart>
void PathTracer::connect(const Path& path, Point3d p, std::uint32_t count, const Scatter& scatter,
                         const Depart& depart) {
  const std::array<float, 4> numbers = numbers_for_light(path);
  const std::array<float, 2> far = numbers_for_far_lights(path);
  double choice = static_cast<double>(path.camera[3]);
  std::optional<LightSample> light;
  SampledSpectrum radiance;
  double all = 0, chosen = 0;
  for (std::uint32_t k = 0; k < count; ++k) {
    const auto candidate = sample_light(scene_.lights, p, k > 0 ? numbers_of_candidate(numbers, k) : numbers,
                                        far, path.wavelengths, path.lamp);
    if (!candidate) continue;
    const BsdfValue scattered = scatter(candidate->to_light);
    const double beside = candidate->is_delta ? 0 : static_cast<double>(density_beside(scattered.pdf, count));
    const double weight = 1 / (candidate->pdf + beside);
    const SampledSpectrum brought =
        path.throughput * scattered.value * candidate->radiance * static_cast<float>(weight);
    const double target = sum_of(brought);
    if (target <= 0) continue;
    all += target;
    if (chosen > 0) {
      // One number for all choices: what is left of it after one is as random as it was.
      const double share = target / all;
      if (choice >= share) {
        choice = (choice - share) / (1 - share);
        continue;
      }
      choice /= share;
    }
    light = candidate;
    radiance = brought;
    chosen = target;
  }
  if (all == 0) return;
  if (count > 1) radiance = radiance * static_cast<float>(all / (count * chosen));
  ++counters_.rays_shadow;
  const Departure from = depart(light->to_light);
  const bool distant = std::isinf(light->distance);
  const Requirements& r = manifest_.requirements;
  const bool straight = manifest_.settings.direct_only;
  const bool walks = distant && light->is_delta && scene_.materials.have_panes() && !straight;
  if (r.see_through || r.media || walks || (r.refraction && straight))
    send_connection(path, from, *light, radiance, walks);
  else
    send_shadow_ray(path, from, *light, radiance);
}

void PathTracer::connect_surface(const Path& path, const Interaction& at, const Surface& surface,
                                 const Scattering& scattering, Vector3d out, std::uint32_t candidates) {
  const auto scatter = [&](Vector3d direction) -> BsdfValue {
    const Vector3d in = scattering.frame.to_local(direction);
    // As for the samples of the BSDF: shading normals let no light leak.
    if (!scattering.transmits &&
        (dot(direction, at.geometric) > 0) != (dot(at.out, at.geometric) * out.z * in.z > 0))
      return {};
    BsdfValue scattered = eval(scattering.bsdf, out, in);
    scattered.value =
        scattered.value * static_cast<float>(scattering.bump_shadowing(dot(direction, at.shading)));
    return scattered;
  };
  connect(path, at.p, candidates, scatter,
          [&](Vector3d direction) { return departure(path, at, surface, direction); });
}

void PathTracer::connect_medium(const Path& path, const Departure& from, double g, Vector3d out,
                                std::uint32_t candidates) {
  const auto scatter = [&](Vector3d in) -> BsdfValue {
    const double value = phase(g, out, in);
    return {filled(static_cast<float>(value)), value};
  };
  connect(path, from.p, candidates, scatter, [&](Vector3d) { return from; });
}

void PathTracer::connect_sensor(const Path& path, const Departure& from, Vector3d normal,
                                std::uint32_t candidates) {
  const auto scatter = [&](Vector3d in) -> BsdfValue {
    const double value = std::max(0.0, dot(normal, in)) / pi;
    return {filled(static_cast<float>(value)), value};
  };
  connect(path, from.p, candidates, scatter, [&](Vector3d) { return from; });
}

void PathTracer::send_connection(const Path& path, const Departure& from, const LightSample& light,
                                 const SampledSpectrum& radiance, bool walks) {
  Path sent = path;
  sent.clear(path_in_pane);
  sent.clear(path_passed);
  sent.cone = 0;
  sent.set(path_connection);
  sent.throughput = radiance;
  const Aimed aimed = aim(from, light);
  depart(sent, from, light.to_light);
  turn(sent, aimed.direction);
  if (walks) {
    sent.set(path_in_pane);
    sent.aim = RefractedAim{scene_.lights.distant[light.light.index].light}.bits();
    sent.walk = 0;
  } else {
    sent.aim = StraightAim{slope_of(aimed.cosine)}.bits();
    sent.travelled = end_value(end_code(aimed.end));
    sent.hit.t = aimed.end;
  }
  sent.depth = walks ? 0 : path.depth + 1;
  sent.pdf = 0;
  const std::size_t waiting = outbox_.paths.size();
  const std::uint64_t died = counters_.died, indirect = counters_.rays_indirect;
  const RayTraffic::Place here = traffic_ ? traffic_->place() : RayTraffic::Place{};
  run(sent, std::nullopt);
  if (traffic_) traffic_->set(here);
  // A connection that ended here was never counted as alive; its segments behind surfaces are shadow rays.
  if (outbox_.paths.size() > waiting) ++counters_.born;
  counters_.died = died;
  counters_.rays_shadow += counters_.rays_indirect - indirect;
  counters_.rays_indirect = indirect;
}

void PathTracer::pack_connection(const Path& path, PathRecord& record) {
  std::uint32_t code = path.aim;
  std::uint64_t travels = std::uint64_t{path.walk} << 16;
  if (!path.is(path_in_pane)) {
    travels = end_code(path.travelled);
    code |= static_cast<std::uint32_t>(travels & 0xffff);
  }
  for (int i = 0; i < 3; ++i) record.travelled[i] = static_cast<std::uint8_t>(travels >> (16 + 8 * i));
  record.pdf = static_cast<std::uint16_t>(code);
  record.flags = static_cast<std::uint8_t>((record.flags & 0xf) | code >> 16 << 4);
}

void PathTracer::unpack_connection(const PathRecord& record, Path& path) {
  path.aim = static_cast<std::uint32_t>(record.flags >> 4) << 16;
  path.pdf = 0;
  path.travelled = 0;
  std::uint64_t travels = record.pdf;
  for (int i = 0; i < 3; ++i) travels |= std::uint64_t{record.travelled[i]} << (16 + 8 * i);
  if (path.is(path_in_pane)) {
    path.aim |= record.pdf;
    path.walk = static_cast<std::uint32_t>(travels >> 16);
  } else {
    path.travelled = end_value(travels);
  }
}

void PathTracer::send_shadow_ray(const Path& path, const Departure& from, const LightSample& light,
                                 const SampledSpectrum& radiance) {
  const Aimed aimed = aim(from, light);
  Shadow shadow{{from.origin, aimed.rounded, from.exclude}, aimed.direction};
  shadow.time_s = path.time_s;
  shadow.tmax = std::isinf(light.distance) ? std::numeric_limits<float>::max() : float_below(aimed.end);
  for (std::size_t i = 0; i < hero_count; ++i)
    shadow.radiance.v[i] = rounded_radiance(std::max(0.0f, radiance.v[i]));
  shadow.pixel = path.pixel;
  shadow.sample = path.sample;
  trace_shadow(shadow, &path.sensor, std::nullopt);
}

// A connection goes straight on through whatever lets it. One to a distant light walks through panes: smooth
// interfaces refract it by the hero's index, and what parallel faces reflect to and fro is a part of it. All
// wavelengths leave a pane with parallel faces in the direction they came, so all four stay unless it is
// thick.
bool PathTracer::connect_onwards(Path& path) {
  if (const PreparedMedium* medium = medium_of(path)) {
    RandomStream random(stream_of(path, RayRandom::flight));
    fade(path, transmittance(*medium, flight_of(path), path.wavelengths, random));
    if (is_black(path.throughput)) return false;
  }
  if (path.met() == Met::surface) return connect_at_surface(path);
  reach_light(path);
  return false;
}

// One that has walked through panes has come to its light if that is where it goes now.
void PathTracer::reach_light(const Path& path) {
  const auto is_direction = [&](Vector3d to_light) { return encode_direction(to_light) == path.direction; };
  if (!path.is(path_in_pane) || any_distant_light(scene_.lights, RefractedAim::of(path.aim).light,
                                                  numbers_for_far_lights(path), is_direction))
    deposit(path.pixel, path.sample, path.sensor, path.throughput);
}

bool PathTracer::connect_at_surface(Path& path) {
  const bool walks = path.is(path_in_pane);
  Interaction at = interaction_at(path);
  const Surface& surface = surface_at(path);
  const MaterialKind& kind = scene_.materials.kind(surface.material);
  const Presence presence = !is_there(path, surface, at) ? Presence::gone
                            : kind.is_nothing(at)        ? Presence::open
                                                         : Presence::whole;
  const bool bends = walks && kind.smooth_dielectric && presence == Presence::whole;
  if (!bends && !(walks && kind.sheet)) return connect_past(path, at, surface, presence);
  if (presence != Presence::gone && connects_through_hole(path, at, surface, false))
    return connect_straight(path, at, nullptr);
  if (!(bends ? walk_interface(path, at, surface) : walk_sheet(path, at, surface))) return false;
  return presence != Presence::whole || walks_on(path);
}

// What a surface lets straight through goes on.
bool PathTracer::connect_past(Path& path, const Interaction& at, const Surface& surface, Presence presence) {
  const bool walks = path.is(path_in_pane), passes = presence != Presence::whole;
  const SampledSpectrum straight = passes ? filled(1) : straight_through(path, at, surface);
  if (presence != Presence::gone && connects_through_hole(path, at, surface, is_black(straight)))
    return connect_straight(path, at, nullptr);
  fade(path, straight);
  if (is_black(path.throughput)) return false;
  if (!passes) path.depth += manifest_.settings.straight_counts || walks;
  if (!connect_straight(path, at, &surface)) return false;
  if (passes) return true;
  return walks ? walks_on(path) : path.depth <= static_cast<std::uint32_t>(manifest_.settings.max_depth);
}

// Whether a connection goes on where nothing of the surface is. Where the rest of it lets no light through it
// all goes there, and is less; else chance decides, as passing a sheet may count and passing a hole does not.
bool PathTracer::connects_through_hole(Path& path, const Interaction& at, const Surface& surface,
                                       bool opaque) const {
  const double opacity = opacity_at(surface, at);
  if (opacity >= 1) return false;
  if (!opaque) return misses(path, opacity);
  path.throughput = path.throughput * static_cast<float>(1 - std::max(opacity, 0.0));
  return true;
}

// Beyond a surface; false where the light is nearer to it than can be told.
bool PathTracer::connect_straight(Path& path, const Interaction& at, const Surface* surface) {
  const Point3f before = path.ray.origin;
  continue_straight(path, at, surface);
  if (path.is(path_in_pane)) return true;
  // The new origin is not on the ray.
  const Vector3d direction = cast<double>(path.ray.direction);
  const Vector3d moved = cast<double>(path.ray.origin) - cast<double>(before);
  const double along = dot(moved, direction) / dot(direction, direction);
  const double aside = length(moved - direction * along);
  path.travelled = end_value(end_code(path.travelled - along - aside * StraightAim::of(path.aim).slope));
  path.hit.t = path.travelled;
  if (path.travelled > 0) return true;
  deposit(path.pixel, path.sample, path.sensor, path.throughput);
  return false;
}

}  // namespace vitrail
