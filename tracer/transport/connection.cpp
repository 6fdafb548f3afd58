// SPDX-License-Identifier: Apache-2.0
#include "tracer/transport/connection.h"

#include <algorithm>
#include <cmath>

#include "tracer/bsdf/local.h"
#include "tracer/media/fade.h"
#include "tracer/transport/find_hit.h"

namespace vitrail {

namespace {

// Of connections, which have no other use for the flag.
constexpr std::uint8_t ray_passes_veils = ray_passed;

// One that has walked through panes has come to its light if that is where it goes now.
void reach_light(Tracing& tracing, const Connection& c) {
  const auto is_direction = [&](Vector3d to_light) { return encode_direction(to_light) == c.direction; };
  if (!c.walks || any_distant_light(tracing.scene.lights, c.refracted.light, RefractedAim::light_mask,
                                    numbers_for_far_lights(tracing, c.key), is_direction))
    deposit(tracing, c.film, c.throughput, {c.light_group, c.ray.direction});
}

// Beyond a surface; false where the light is nearer to it than can be told.
bool connect_straight(Tracing& tracing, Connection& c, const Interaction& at, const Surface* surface) {
  const Point3f before = c.ray.origin;
  continue_straight(tracing, c, at, surface);
  if (c.walks) return true;
  // The new origin is not on the ray.
  const Vector3d direction = cast<double>(c.ray.direction);
  const Vector3d moved = cast<double>(c.ray.origin) - cast<double>(before);
  const double along = dot(moved, direction) / dot(direction, direction);
  const double aside = length(moved - direction * along);
  c.left = end_value(end_code(c.left - along - aside * c.straight.slope));
  c.hit.t = c.left;
  if (c.left > 0) return true;
  deposit(tracing, c.film, c.throughput, {c.light_group, c.ray.direction});
  return false;
}

// Whether it goes on where nothing of the surface is. Where the rest of it lets no light through it all goes
// there, and is less; else chance decides, as passing a sheet may count and passing a hole does not.
bool goes_through_hole(const Tracing& tracing, Connection& c, const Interaction& at, const Surface& surface,
                       bool opaque) {
  const double opacity = opacity_at(tracing, surface, at);
  if (opacity >= 1) return false;
  if (!opaque) return misses(c, opacity);
  c.throughput = c.throughput * static_cast<float>(1 - std::max(opacity, 0.0));
  return true;
}

// Of a surface: `gone` in an interior of higher priority, `open` as nothing scatters at it or it has no
// shadow.
enum class Presence : std::uint8_t { gone, open, whole };

// What a surface lets straight through goes on.
bool connect_past(Tracing& tracing, Connection& c, const Interaction& at, const Surface& surface,
                  Presence presence) {
  const bool passes = presence != Presence::whole;
  const SampledSpectrum straight = passes ? filled(1) : straight_through(tracing, c, at, surface);
  if (presence != Presence::gone && goes_through_hole(tracing, c, at, surface, is_black(straight)))
    return connect_straight(tracing, c, at, nullptr);
  fade(c, straight);
  if (is_black(c.throughput)) return false;
  const RenderSettings& settings = tracing.settings();
  if (!passes) c.depth += settings.straight_counts || c.walks;
  if (!connect_straight(tracing, c, at, &surface)) return false;
  if (passes) return true;
  return c.walks ? walks_on(c) : c.depth <= static_cast<std::uint32_t>(settings.max_depth);
}

bool connect_at_surface(Tracing& tracing, Connection& c) {
  Interaction at = interaction_at(tracing, c, narrow_cone(tracing, c.film.sample));
  const Surface& surface = surface_at(tracing, c);
  const MaterialKind& kind = tracing.scene.materials.kind(surface.material);
  const bool open = kind.is_nothing(at) || !tracing.manifest().materials[surface.material].casts_shadow;
  const Presence presence = !is_there(tracing, c, surface, at) ? Presence::gone
                            : open                             ? Presence::open
                                                               : Presence::whole;
  const bool bends = c.walks && kind.smooth_dielectric && presence == Presence::whole;
  if (!bends && !(c.walks && kind.sheet)) return connect_past(tracing, c, at, surface, presence);
  if (presence != Presence::gone && goes_through_hole(tracing, c, at, surface, false))
    return connect_straight(tracing, c, at, nullptr);
  if (!(bends ? walk_interface(tracing, c, at, surface) : walk_sheet(tracing, c, at, surface))) return false;
  return presence != Presence::whole || walks_on(c);
}

bool is_blocked(const Tracing& tracing, const Connection& c) {
  if (!c.meets_surface()) return false;
  const Surface* const met = &surface_at(tracing, c);
  return tracing.scene.lanes.surfaces[static_cast<std::size_t>(met - tracing.manifest().surfaces.data())]
      .blocks;
}

// False where it ends.
bool connect_onwards(Tracing& tracing, Connection& c) {
  if (is_blocked(tracing, c)) return false;
  find_wavelengths(tracing, c, c.film);
  const PreparedMedium* const medium = medium_of(tracing, c);
  if (medium && !(c.passes_veils && medium->medium->veils)) {
    const Flight flight = flight_of(tracing, c, true);
    RandomStream random(stream_of(c, RayRandom::flight));
    if (!medium->medium->fade)
      fade(c, transmittance(*medium, flight, c.wavelengths, random));
    else if (ends_medium(tracing, c))
      fade(c, left_by(*medium->medium->fade, flight.t_max, c.wavelengths));
    if (is_black(c.throughput)) return false;
  }
  if (c.meets_surface()) return connect_at_surface(tracing, c);
  reach_light(tracing, c);
  return false;
}

// Whether it ended here. Each segment behind a surface is one more ray.
bool follow(Tracing& tracing, Connection& c, std::optional<Arrival> at) {
  for (;; at.reset()) {
    if (const auto elsewhere = find_hit(tracing, c, at)) {
      send(tracing, c, *elsewhere);
      return false;
    }
    if (!connect_onwards(tracing, c)) return true;
    ++tracing.counters.rays_shadow;
  }
}

// The scene's only domain is resident.
void trace_in_one(Tracing& tracing, Connections& waiting) {
  for (Connection& c : waiting.begun) waiting.live.push_back(&c);
  while (!waiting.live.empty()) {
    HitsInOne hits(tracing);
    for (Connection* c : waiting.live) hits.add(*c);
    hits.finish();
    std::erase_if(waiting.live, [&](Connection* c) { return !connect_onwards(tracing, *c); });
    tracing.counters.rays_shadow += waiting.live.size();
  }
}

}  // namespace

Connection& add_connection(const CameraPath& path, Connections& waiting) {
  Connection& c = waiting.begun.emplace_back();
  c.key = path.key;
  c.seed = path.seed;
  c.time_s = path.time_s;
  c.depth = path.depth + 1;
  c.dispersed = path.dispersed;
  c.wavelengths = path.wavelengths;
  c.film = path.film;
  return c;
}

void end_at(Connection& c, double end, double slope) {
  c.straight = StraightAim::of(StraightAim{slope}.bits());
  c.left = end_value(end_code(end));
  c.hit.t = end;
}

void trace(Tracing& tracing, Connections& waiting) {
  if (DomainWalk::has_one(tracing.manifest(), tracing.resident) && !tracing.traffic) {
    trace_in_one(tracing, waiting);
  } else {
    for (Connection& c : waiting.begun) {
      const RayTraffic::Place here = tracing.traffic ? tracing.traffic->place() : RayTraffic::Place{};
      if (!follow(tracing, c, std::nullopt)) ++tracing.counters.born;
      if (tracing.traffic) tracing.traffic->set(here);
    }
  }
  waiting.begun.clear();
}

void resume(Tracing& tracing, const ConnectionRecord& record, const Arrival& at) {
  Connection c;
  c.film.pixel = record.sample.pixel;
  c.film.sample = record.sample.sample();
  begin(tracing, c, c.film);
  c.set_numbered_depth(record.sample.all_depth());
  unpack_head(record, c);
  c.walks = record.is(ray_in_pane);
  c.passes_veils = record.is(ray_passes_veils);
  c.light_group = record.light_group;
  if (c.walks) {
    const ConnectionRecord::Walking& w = record.walking;
    c.refracted = RefractedAim::of(w.light_and_doubt);
    c.walk = w.walk[0] | std::uint32_t{w.walk[1]} << 8 | std::uint32_t{w.walk[2]} << 16;
  } else {
    std::uint64_t code = 0;
    for (int i = 0; i < 5; ++i) code |= std::uint64_t{record.straight.left_and_slope[i]} << 8 * i;
    c.straight = StraightAim::of(static_cast<std::uint32_t>(code >> end_code_length));
    c.left = end_value(code & end_code_mask);
  }
  if (tracing.traffic) tracing.traffic->begin({at.domain, true});
  if (follow(tracing, c, at)) ++tracing.counters.died;
}

void pack(const Tracing&, const Connection& c, bool resolved, RayRecord& record) {
  ConnectionRecord& r = record.connection;
  static_cast<RayRecordHead&>(r) = head_of(c, RayRecordKind::connection, resolved);
  r.sample = SampleRecord::of(c.film.pixel, c.film.sample, c.numbered_depth());
  r.light_group = c.light_group;
  if (c.passes_veils) r.kind_and_flags |= ray_passes_veils;
  if (c.walks) {
    r.kind_and_flags |= ray_in_pane;
    r.walking.light_and_doubt = c.refracted.bits();
    for (int i = 0; i < 3; ++i) r.walking.walk[i] = static_cast<std::uint8_t>(c.walk >> 8 * i);
  } else {
    const std::uint64_t code = end_code(c.left) | std::uint64_t{c.straight.bits()} << end_code_length;
    for (int i = 0; i < 5; ++i) r.straight.left_and_slope[i] = static_cast<std::uint8_t>(code >> 8 * i);
  }
}

std::array<float, 2> numbers_for_far_lights(const Tracing& tracing, const SampleKey& key) {
  const std::size_t rows = tracing.scene.daylight.suns.size();
  if (!tracing.scene.lights.has_discs() && rows == 0) return {};
  const std::array<float, 4> u = sample_4d(key, sample_set::lens);
  if (rows > 0) {
    const std::uint32_t row = key.pixel / static_cast<std::uint32_t>(tracing.film.full_width());
    return {LightSampler::number_of_row(row, rows, u[2]), u[3]};
  }
  return {u[2], u[3]};
}

// For direct light a smooth dielectric is a sheet of it, in the direction that light has outside: both faces
// let 1 − F of it through.
SampledSpectrum straight_through(const Tracing& tracing, const Traveller& t, const Interaction& at,
                                 const Surface& surface) {
  const Materials& materials = tracing.scene.materials;
  if (!tracing.settings().direct_only || !materials.kind(surface.material).smooth_dielectric)
    return materials.passes_straight(surface.material, at, t.wavelengths);
  const Material& record = tracing.manifest().materials[surface.material];
  const auto& material = std::get<DielectricMaterial>(record.model);
  const double cosine = std::abs(dot(at.out, materials.shading_normal(record, at)));
  const SampledSpectrum eta = relative_index(material, at, t.wavelengths);
  SampledSpectrum passes =
      tracing.scene.textures.spectrum(material.transmittance_factor, at.texture_point(), t.wavelengths);
  for (std::size_t i = 0; i < hero_count; ++i) {
    const double inside = static_cast<double>(eta.v[i]);
    passes.v[i] *= static_cast<float>(1 - fresnel_dielectric(cosine, at.front ? inside : 1 / inside));
  }
  return passes;
}

}  // namespace vitrail
