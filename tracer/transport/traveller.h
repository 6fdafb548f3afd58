// SPDX-License-Identifier: Apache-2.0
// A Traveller is a ray on its way from event to event. It is what camera paths, connections to lights,
// photons and probes have in common, with what can be done with any of them.
#pragma once

#include <cmath>
#include <cstdint>

#include "tracer/rays/departing.h"
#include "tracer/surfaces/interaction.h"
#include "tracer/transport/aim.h"
#include "tracer/transport/tracing.h"

namespace vitrail {

struct Traveller {
  SampleKey key;
  std::uint64_t seed = 0;      // sample_seed of it
  std::uint64_t random = 0;    // a hash of the ray
  double time_s = 0;           // when its sample sees the scene, where anything moves
  std::uint32_t depth = 0;     // events so far that count
  bool only_straight = false;  // it scatters no more, and goes straight on at most
  bool dispersed = false;      // only the hero wavelength is left
  std::uint8_t inside = 0;     // state of Interiors
  DirectionCode direction;
  Ray ray;
  SampledSpectrum throughput;
  SampledWavelengths wavelengths;
  Hit hit;  // of a connection to a light not infinitely far, until it meets a surface: its end
  std::uint32_t hit_domain = 0;

  bool meets_surface() const { return hit.triangle != no_triangle; }
  bool has_no_end() const { return std::isinf(hit.t); }
  std::size_t active_wavelengths() const { return dispersed ? 1 : hero_count; }
  // Ends the secondary wavelengths: their ways part from the hero's here.
  void disperse() {
    if (dispersed) return;
    dispersed = true;
    throughput = {{throughput[0] * hero_count, 0, 0, 0}};
  }
  // Its random numbers are a function of this, beside the ray. It travels in 17 bits.
  static constexpr std::uint32_t only_straight_bit = 1u << 16;
  std::uint32_t numbered_depth() const { return depth | (only_straight ? only_straight_bit : 0); }
  void set_numbered_depth(std::uint32_t n) {
    depth = n & (only_straight_bit - 1), only_straight = (n & only_straight_bit) != 0;
  }
};

// Returns a function of the ray and its depth.
inline std::uint64_t stream_of(const Traveller& t, RayRandom use) {
  return t.random + stream_offset(t.numbered_depth(), use);
}

// Returns a hash of its ray, the same wherever it is traced.
std::uint64_t hash_of_ray(const Traveller& t);

// Gives the traveller of a sample of the film its key, numbers and time.
void begin(const Tracing& tracing, Traveller& t, FilmSample& film);
void find_wavelengths(const Tracing& tracing, Traveller& t, FilmSample& film);

// Returns the origin, beside a hit, of rays that leave it (rays/departing.h).
Point3f offset_origin(const Tracing& tracing, const Interaction& at, Vector3d direction);
Departure departure(const Tracing& tracing, const Traveller& t, const Interaction& at, const Surface& surface,
                    Vector3d direction);
// Rounds the throughput by chance to what a record holds, so that a ray that stays is the one that is sent.
// `random` has 64 bits.
void round_throughput(Traveller& t, std::uint64_t random);
// Starts the next ray. The triangle that it leaves is excluded by id. Throughput is rounded as it travels.
void depart(Traveller& t, const Departure& from, Vector3d direction);
// Gives the ray this direction, to the bit.
void turn(Traveller& t, DirectionCode direction);
void continue_from(const Tracing& tracing, Traveller& t, const Interaction& at, const Surface& surface,
                   Vector3d direction);
// Goes straight on. It keeps the direction to the bit: encoding it once more might turn it. A null surface is
// a hole, which bounds nothing.
void continue_straight(const Tracing& tracing, Traveller& t, const Interaction& at, const Surface* surface);

// It is the cone that filters a ray's images: its width where it starts, and the angle by which it widens.
struct RayCone {
  double width = 0, angle_rad = 0;
  double at(double distance) const { return width + angle_rad * distance; }
};
// Returns the angle between the rays of a pixel's samples, in rad: it is the smaller the more samples there
// are. A sample does not know how many will follow, as a render may be resumed to have more. Each thus counts
// those before it. The angle is not less than an eighth of a pixel.
double angle_between_rays(const Tracing& tracing, std::uint32_t sample);
// Returns the cone of connections and probes, which start as wide as a point.
inline RayCone narrow_cone(const Tracing& tracing, std::uint32_t sample) {
  if (!tracing.requirements().filtering) return {};
  return {0, std::min(angle_between_rays(tracing, sample), 1.0)};
}

// They return the interaction and the surface of a traveller that meets one.
Interaction interaction_at(const Tracing& tracing, const Traveller& t, const RayCone& cone);
const Surface& surface_at(const Tracing& tracing, const Traveller& t);
// Returns false for the face of an interior that lies in one of higher priority.
bool is_there(const Tracing& tracing, const Traveller& t, const Surface& surface, Interaction& at);
// Returns how much of the surface there is at a point.
double opacity_at(const Tracing& tracing, const Surface& surface, const Interaction& at);
// Returns whether the traveller misses a surface of which so much is there.
bool misses(const Traveller& t, double opacity);
// Returns how far a smooth face may be off, in rad. `normal` is the normal that shades it.
double face_doubt(const Tracing& tracing, const Traveller& t, const Interaction& at, const Surface& surface,
                  Vector3d normal);

// Returns the medium around; null: in vacuum.
const PreparedMedium* medium_of(const Tracing& tracing, const Traveller& t);
// Returns whether what it has met bounds the medium that it is in.
bool ends_medium(const Tracing& tracing, const Traveller& t);
// Returns the flight to what it has met. A medium without end would let no light from infinitely far through.
// A flight to such a light thus ends after the scene's diagonal, or after the diameter of the sphere around
// its centre through the point, whichever is greater. (Mitsuba does so where it chooses such a light.)
Flight flight_of(const Tracing& tracing, const Traveller& t, bool to_far_light);

// Returns the transform as the camera stands when the traveller sees the scene.
Transform bundle_to_camera(const Tracing& tracing, const Traveller& t);

}  // namespace vitrail
