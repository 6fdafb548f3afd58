// SPDX-License-Identifier: Apache-2.0
// Where rays start and what they take along.
#include <bit>

#include "tracer/paths/path_state.h"
#include "tracer/paths/path_tracer.h"
#include "tracer/rays/rounding.h"

namespace vitrail {

// To what it has met. A medium without end would let nothing through of the light from infinitely far: that
// comes through as much of it as the scene is wide, or as a sphere around its centre on which the point lies
// (Mitsuba, where it chooses such a light).
Flight PathTracer::flight_of(const Path& path) const {
  const Vector3d d = cast<double>(path.ray.direction);
  const double scale = length(d);
  const Point3d p = cast<double>(path.ray.origin);
  double t_max = path.hit.t * scale;
  if (path.met() == Met::nothing && (path.is(path_connection) || scene_.lights.has_background())) {
    const Bounds3f& box = manifest_.bounds;
    t_max = std::max(length(cast<double>(extent(box))), 2 * length(p - cast<double>(center(box))));
  }
  return {p, d * (1 / scale), t_max};
}

const PreparedMedium* PathTracer::medium_of(const Path& path) const {
  const std::int32_t medium = scene_.interiors.medium(path.inside);
  return medium < 0 ? nullptr : &scene_.media[static_cast<std::size_t>(medium)];
}

// The same wherever the ray is traced.
std::uint64_t PathTracer::hash_of_ray(const Path& path) {
  const auto bits = [](float x) { return std::uint64_t{std::bit_cast<std::uint32_t>(x)}; };
  const Point3f o = path.ray.origin;
  return stream_seed(path.seed, bits(o.x) << 32 | bits(o.y),
                     bits(o.z) << 32 ^ std::uint64_t{path.direction.first()} << 24 ^ path.direction.second());
}

// A function of the ray and its depth.
std::uint64_t PathTracer::stream_of(const Path& path, RayRandom use) {
  return path.random +
         (std::uint64_t{path.depth} << 3 | static_cast<std::uint64_t>(use)) * 0xd1342543de82ef95u;
}

// On the other side of a surface, as if it was not there. Connections go through it too, so the path keeps
// the density of the scattering that it comes from.
void PathTracer::pass_straight(Path& path, const Interaction& at, const Surface* surface) const {
  const double travelled = path.travelled + path.hit.t * length(cast<double>(path.ray.direction));
  path.travelled = 0;
  if (path.pdf > 0) {
    RandomStream random(stream_of(path, RayRandom::distance));
    path.travelled = static_cast<double>(rounded_distance(static_cast<float>(travelled), has_cone(path),
                                                          static_cast<std::uint32_t>(random.bits())));
  }
  continue_straight(path, at, surface);
}

void PathTracer::continue_from(Path& path, const Interaction& at, const Surface& surface,
                               Vector3d direction) const {
  depart(path, departure(path, at, surface, direction), direction);
}

// Keeps the direction to the bit: encoding it once more might turn it.
void PathTracer::continue_straight(Path& path, const Interaction& at, const Surface* surface) const {
  const DirectionCode kept = path.direction;
  const auto direction = cast<double>(path.ray.direction);
  depart(path,
         surface ? departure(path, at, *surface, direction)
                 : Departure{at.p, offset_origin(at, direction), at.triangle, path.inside},
         direction);
  turn(path, kept);
}

void PathTracer::turn(Path& path, DirectionCode direction) const {
  path.direction = direction;
  path.ray.direction = decode_direction(direction);
  path.random = hash_of_ray(path);
}

Departure PathTracer::departure(const Path& path, const Interaction& at, const Surface& surface,
                                Vector3d direction) const {
  const bool front_side = dot(direction, at.geometric) > 0;
  return {at.p, offset_origin(at, direction), at.triangle,
          scene_.interiors.beside(path.inside, surface, front_side, front_side != at.front)};
}

// Starts the next ray. The triangle it leaves is excluded by id.
void PathTracer::depart(Path& path, const Departure& from, Vector3d direction) const {
  path.direction = encode_direction(direction);
  path.ray = {from.origin, decode_direction(path.direction), from.exclude};
  path.hit = {};
  path.inside = from.inside;
  path.random = hash_of_ray(path);
  std::uint64_t random = RandomStream(stream_of(path, RayRandom::throughput)).bits();
  for (float& x : path.throughput.v) {
    x = rounded_by_chance(x, static_cast<std::uint32_t>(random));
    random >>= 16;
  }
}

// Moves the hit along the normal, to the side of `direction`, by more than rounding to float can move it
// back, and than it can part the surface from a copy of it: so it keeps from the neighbours of the triangle
// that it leaves. Rounding moves it aside, too, which
// brings it behind neighbours that are not quite in one plane; and the largest triangles, if there are any
// about, lie where doubles place them.
Point3f PathTracer::offset_origin(const Interaction& at, Vector3d direction) const {
  const double aside = 1e-9 * std::max({std::abs(at.p.x), std::abs(at.p.y), std::abs(at.p.z)});
  const double doubles = 0x1p-46 * static_cast<double>(manifest_.scale);
  const double distance = 3 * at.rounding + aside + doubles;
  const double side = dot(direction, at.geometric) >= 0 ? 1 : -1;
  return cast<float>(at.p + at.geometric * (side * distance));
}

Interaction PathTracer::interaction_at(const Path& path) const {
  const double width = manifest_.requirements.filtering ? cone_width(path, path.hit.t) : 0;
  return make_interaction(*resident_[path.hit_domain], path.hit, path.ray.direction, width,
                          manifest_.attributes, path.time_s);
}

const Surface& PathTracer::surface_at(const Path& path) const {
  return surface_of(manifest_, *resident_[path.hit_domain], path.hit);
}

double PathTracer::cone_unit() const {
  const Bounds3f core = core_of(manifest_);
  double greatest = 1e-30;
  for (int axis = 0; axis < 3 && !core.empty(); ++axis)
    greatest =
        std::max({greatest, -static_cast<double>(core.lower[axis]), static_cast<double>(core.upper[axis])});
  return greatest;
}

// Between the rays of a pixel's samples, in rad: they lie the closer the more of them there are. A sample
// does not know how many will follow, as a render may be resumed to have more, so each counts those before
// it. Not less than an eighth of a pixel. Photons are taken as those of a first sample.
double PathTracer::ray_angle(const Path& path) const {
  return scene_.pixel_angle * (flies() ? 1 : std::max(0.125, 1 / std::sqrt(1.0 + path.sample)));
}

// At a distance (Akenine-Möller et al., "Texture Level of Detail Strategies for Real-Time Ray
// Tracing", 2019): it widens by the angle between rays, and after a scattering by a tenth of the width of a
// lobe, whose density is up to four times the path's.
double PathTracer::cone_width(const Path& path, double distance) const {
  double angle = ray_angle(path);
  if (path.pdf > 0) angle = std::max(angle, 0.05 / std::sqrt(static_cast<double>(path.pdf)));
  return cone_value(path.cone) * cone_unit() + std::min(angle, 1.0) * distance;
}

// To where it starts next.
void PathTracer::widen_cone(Path& path, double distance) const {
  if (manifest_.requirements.filtering) path.cone = cone_code(cone_width(path, distance) / cone_unit());
}

}  // namespace vitrail
