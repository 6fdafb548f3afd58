// SPDX-License-Identifier: Apache-2.0
#include "tracer/transport/traveller.h"

#include <algorithm>
#include <cmath>

#include "tracer/panes/parallel_faces.h"
#include "tracer/rays/rounding.h"

namespace vitrail {

std::uint64_t hash_of_ray(const Traveller& t) { return hash_of_ray(t.seed, t.ray.origin, t.direction); }

void begin(const Tracing& tracing, Traveller& t, FilmSample& film) {
  t.key = key_of(tracing, film.pixel, film.sample);
  t.seed = sample_seed(t.key);
  film.camera = camera_numbers(tracing, t.key);
  t.time_s = time_of(tracing, t.key);
}

void find_wavelengths(const Tracing& tracing, Traveller& t, FilmSample& film) {
  if (film.has_wavelengths) return;
  film.has_wavelengths = true;
  t.wavelengths = sample_wavelengths(film.camera[2]);
  film.sensor = sensor_of(tracing, film.camera, t.wavelengths);
}

Point3f offset_origin(const Tracing& tracing, const Interaction& at, Vector3d direction) {
  return offset_origin(at.p, at.geometric, at.rounding, rounding_of_doubles(tracing.manifest().scale),
                       direction);
}

Departure departure(const Tracing& tracing, const Traveller& t, const Interaction& at, const Surface& surface,
                    Vector3d direction) {
  const bool front_side = dot(direction, at.geometric) > 0;
  return {at.p, offset_origin(tracing, at, direction), at.triangle,
          tracing.scene.interiors.beside(t.inside, surface, front_side, front_side != at.front)};
}

void round_throughput(Traveller& t, std::uint64_t random) {
  for (float& x : t.throughput.v) {
    x = rounded_by_chance(x, static_cast<std::uint32_t>(random));
    random >>= 16;
  }
}

void depart(Traveller& t, const Departure& from, Vector3d direction) {
  t.direction = encode_direction(direction);
  t.ray = {from.origin, decode_direction(t.direction), from.exclude};
  t.hit = {};
  t.inside = from.inside;
  t.random = hash_of_ray(t);
  round_throughput(t, RandomStream(stream_of(t, RayRandom::throughput)).bits());
}

void turn(Traveller& t, DirectionCode direction) {
  t.direction = direction;
  t.ray.direction = decode_direction(direction);
  t.random = hash_of_ray(t);
}

void continue_from(const Tracing& tracing, Traveller& t, const Interaction& at, const Surface& surface,
                   Vector3d direction) {
  depart(t, departure(tracing, t, at, surface, direction), direction);
}

void continue_straight(const Tracing& tracing, Traveller& t, const Interaction& at, const Surface* surface) {
  const DirectionCode kept = t.direction;
  const auto direction = cast<double>(t.ray.direction);
  depart(t,
         surface ? departure(tracing, t, at, *surface, direction)
                 : Departure{at.p, offset_origin(tracing, at, direction), at.triangle, t.inside},
         direction);
  turn(t, kept);
}

double angle_between_rays(const Tracing& tracing, std::uint32_t sample) {
  return tracing.scene.pixel_angle * std::max(0.125, 1 / std::sqrt(1.0 + sample));
}

Interaction interaction_at(const Tracing& tracing, const Traveller& t, const RayCone& cone) {
  return make_interaction(*tracing.resident[t.hit_domain], t.hit, t.ray.direction, cone.at(t.hit.t),
                          tracing.manifest().attributes, t.time_s, tracing.scene.uvs_show);
}

const Surface& surface_at(const Tracing& tracing, const Traveller& t) {
  return surface_of(tracing.manifest(), *tracing.resident[t.hit_domain], t.hit);
}

bool is_there(const Tracing& tracing, const Traveller& t, const Surface& surface, Interaction& at) {
  const Interiors& interiors = tracing.scene.interiors;
  if (!interiors.has_priority(surface)) return true;
  const auto face = interiors.face(t.inside, surface, at.front);
  if (face) at.exterior_eta = face->exterior_eta;
  return face.has_value();
}

double opacity_at(const Tracing& tracing, const Surface& surface, const Interaction& at) {
  if (!tracing.requirements().see_through) return 1;
  if (const auto* constant = std::get_if<float>(&surface.opacity)) return static_cast<double>(*constant);
  return tracing.scene.textures.number(surface.opacity, at.texture_point());
}

bool misses(const Traveller& t, double opacity) {
  return opacity < 1 && RandomStream(stream_of(t, RayRandom::coverage)).next() >= opacity;
}

double face_doubt(const Tracing& tracing, const Traveller& t, const Interaction& at, const Surface& surface,
                  Vector3d normal) {
  const bool shading = !(normal == at.geometric * at.side());
  return std::max(float_glass_rad, normal_doubt(*tracing.resident[t.hit_domain], t.hit, shading,
                                                static_cast<double>(surface.vertex_doubt), t.time_s));
}

const PreparedMedium* medium_of(const Tracing& tracing, const Traveller& t) {
  const std::int32_t medium = tracing.scene.interiors.medium(t.inside);
  return medium < 0 ? nullptr : &tracing.scene.media[static_cast<std::size_t>(medium)];
}

bool ends_medium(const Tracing& tracing, const Traveller& t) {
  return t.meets_surface() && surface_at(tracing, t).interior == tracing.scene.interiors.medium(t.inside);
}

Flight flight_of(const Tracing& tracing, const Traveller& t, bool to_far_light) {
  const Vector3d d = cast<double>(t.ray.direction);
  const double scale = length(d);
  const Point3d p = cast<double>(t.ray.origin);
  double t_max = t.hit.t * scale;
  if (t.has_no_end() && to_far_light) {
    const Bounds3f& box = tracing.manifest().bounds;
    t_max = std::max(length(cast<double>(extent(box))), 2 * length(p - cast<double>(center(box))));
  }
  return {p, d * (1 / scale), t_max};
}

Transform bundle_to_camera(const Tracing& tracing, const Traveller& t) {
  const Motion& motion = tracing.manifest().camera_motion;
  return motion.moves() ? inverse(motion.at(t.time_s)) : tracing.scene.bundle_to_camera;
}

}  // namespace vitrail
