// SPDX-License-Identifier: Apache-2.0
// A Tracing is what one thread traces with: the scene, the domains that are at hand, and where light and rays
// go. The functions of this folder need it beside the ray itself.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "film/film.h"
#include "film/pixel_sums.h"
#include "tracer/intersect/intersector.h"
#include "tracer/photons/photon_pass.h"
#include "tracer/photons/photon_records.h"
#include "tracer/prepared/render_scene.h"
#include "tracer/rays/ray_records.h"
#include "tracer/rays/ray_traffic.h"
#include "tracer/sampling/sampler.h"
#include "tracer/sampling/wavelengths.h"

namespace vitrail {

// These rays have to go on in a domain that is not resident.
struct Outbox {
  struct Ray {
    std::uint32_t domain;
    RayRecord record;
  };
  struct Shadow {
    std::uint32_t domain;
    ShadowRecord record;
  };
  struct Question {
    std::uint32_t domain;  // in whose cell the point lies
    Gather record;
  };
  std::vector<Ray> rays;
  std::vector<Shadow> shadows;
  std::vector<Photon> photons;      // that landed
  std::vector<Question> questions;  // to the maps of other ranks

  std::size_t size() const { return rays.size() + shadows.size() + photons.size() + questions.size(); }
};

struct TraceCounters {
  // They count rays from the camera, further ones of paths and photons, and rays to lights. Each segment of a
  // ray to a light behind a surface is one more.
  std::uint64_t rays_camera = 0, rays_indirect = 0, rays_shadow = 0;
  // It counts domains entered after the first one of a ray, for one ray in DomainWalk::sampled_one_in.
  std::uint64_t crossings = 0;
  // They count rays alive: paths begun, and connections and shadow rays put into an outbox; the same when
  // they end.
  std::uint64_t born = 0, died = 0;
  // They belong to photon mapping: photons sent from lights, questions answered, and photons found for them.
  std::uint64_t photons_emitted = 0, gathers = 0, photons_gathered = 0;
  // They count connections to distant lights at faces where they leave glass, and those that end there as the
  // faces are not parallel. The widest wedge of the latter is in 10⁻⁹ rad: of panes that taper, of prisms, of
  // lenses.
  std::uint64_t connections_in_glass = 0, connections_in_wedges = 0, widest_wedge_nrad = 0;

  // `wedge` is that of wedge_of; > 1: no light of that direction comes in there.
  void count_leaving(bool leaves, double wedge) {
    ++connections_in_glass;
    if (leaves || wedge > 1) return;
    ++connections_in_wedges;
    widest_wedge_nrad = std::max(widest_wedge_nrad, static_cast<std::uint64_t>(1e9 * wedge));
  }
};
TraceCounters& operator+=(TraceCounters& a, const TraceCounters& b);

// They are indexed by domain; null: not resident.
using ResidentViews = std::span<const DomainView* const>;

struct LaneStages;
// Returns the stages of the fastest kernel that runs here (lane_stages.h).
const LaneStages& best_lane_stages();

// All that it refers to outlives it; the film is shared.
struct Tracing {
  const RenderScene& scene;
  ResidentViews resident;
  Film& film;
  Outbox& outbox;
  TraceCounters& counters;
  RayTraffic* traffic = nullptr;        // told where the rays go, if any
  const PhotonPass* photons = nullptr;  // of photon mapping
  const KernelFunctions& kernel = best_kernel();
  const LaneStages* stages = &best_lane_stages();  // null: every path by itself; the same picture
  PixelSums* sums = nullptr;  // what goes to the film goes through them, where there are any
  // It is the footprint of the sample that was added last to a film that splats: its pixels.
  struct {
    std::uint64_t of = ~std::uint64_t{0};  // pixel and sample
    Footprint footprint;
  } landed{};

  const Manifest& manifest() const { return scene.manifest; }
  const RenderSettings& settings() const { return scene.manifest.settings; }
  const Requirements& requirements() const { return scene.manifest.requirements; }
  void count_visit(std::uint32_t domain) {
    if (traffic) traffic->visit(domain);
  }
};

// It is a sample of a pixel, numbered in the crop, and how it sees.
struct FilmSample {
  std::uint32_t pixel = 0, sample = 0;
  std::array<float, 4> camera{};  // its numbers for the camera; wavelengths follow from them
  bool has_wavelengths = false;   // only what sees anything needs them and the sensor
  SensorWeights sensor;
};

SampleKey key_of(const Tracing& tracing, std::uint32_t pixel, std::uint32_t sample);
// Returns a sample's numbers for the camera. With photons all paths of an iteration's part have the part's
// wavelengths.
std::array<float, 4> camera_numbers(const Tracing& tracing, const SampleKey& key);
// Returns when a sample sees the scene, in s. With photons all paths of an iteration's part see it at once.
double time_of(const Tracing& tracing, const SampleKey& key);
// Returns the time after this part, in [0,1), of the time that the shutter is open.
double time_at(const Tracing& tracing, float number);
// Returns the weights of a sample whose numbers for the camera are `camera`.
SensorWeights sensor_of(const Tracing& tracing, const std::array<float, 4>& camera,
                        const SampledWavelengths& wavelengths);
// Returns the pixels of a sample where the film splats, else null.
const Footprint* footprint_of(Tracing& tracing, std::uint32_t pixel, std::uint32_t sample);

// It says whose light a deposit is, for films that keep groups of lights.
struct LitBy {
  std::uint8_t group = 0;  // or GroupedLights::by_direction
  Vector3f direction{};    // to the light, any length; of what is by direction
};

void deposit(Tracing& tracing, std::uint32_t pixel, std::uint32_t sample, const SensorWeights& sensor,
             const SampledSpectrum& radiance, const LitBy& by);
inline void deposit(Tracing& tracing, const FilmSample& film, const SampledSpectrum& radiance,
                    const LitBy& by) {
  deposit(tracing, film.pixel, film.sample, film.sensor, radiance, by);
}

}  // namespace vitrail
