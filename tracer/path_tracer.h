// SPDX-License-Identifier: Apache-2.0
// Spectral path tracing through whatever sub-domains are resident: next-event estimation with multiple
// importance sampling (Veach 1997), Russian roulette, dispersion by the hero wavelength. A ray that needs an
// absent domain is put into the outbox; nothing about the picture depends on which ones were absent.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "film/film.h"
#include "tracer/intersect/intersector.h"
#include "tracer/records.h"
#include "tracer/render_scene.h"
#include "tracer/sampler.h"

namespace vitrail {

// Rays that have to go on in a domain that is not resident.
struct Outbox {
  struct Path {
    std::uint32_t domain;
    PathRecord record;
  };
  struct Shadow {
    std::uint32_t domain;
    ShadowRecord record;
  };
  std::vector<Path> paths;
  std::vector<Shadow> shadows;
};

struct TraceCounters {
  std::uint64_t rays_camera = 0, rays_indirect = 0, rays_shadow = 0;
  std::uint64_t crossings = 0;          // domains entered after the first one of a ray
  std::uint64_t nonfinite_samples = 0;  // deposits that were refused
  // Rays alive: paths begun, and connections and shadow rays put into an outbox; the same when they end.
  std::uint64_t born = 0, died = 0;
};
TraceCounters& operator+=(TraceCounters& a, const TraceCounters& b);

// Indexed by domain; null: not resident.
using ResidentViews = std::span<const DomainView* const>;

class PathTracer {
 public:
  // All references outlive the tracer. One tracer a thread; the film is shared.
  PathTracer(const RenderScene& scene, ResidentViews resident, Film& film, Outbox& outbox,
             TraceCounters& counters, const KernelFunctions& kernel = best_kernel());

  // Sample `sample` of the pixel (x, y) of the whole film, which lies in the crop.
  void trace_camera(int x, int y, std::uint32_t sample);
  // Goes on with a ray in `domain`, which is resident.
  void resume(const PathRecord& record, std::uint32_t domain);
  void resume(const ShadowRecord& record, std::uint32_t domain);

 private:
  struct Path;
  struct Interaction;

  void run(Path& path, std::optional<std::uint32_t> at);
  bool find_hit(Path& path, std::optional<std::uint32_t> at);
  void intersect(Path& path, std::uint32_t domain);
  bool forward(const Path& path, std::uint32_t domain, bool resolved);
  Interaction interaction_at(const Path& path) const;
  bool shade(Path& path);
  bool connect_onwards(Path& path, const Interaction& at);
  void add_emission(const Path& path, const Interaction& at, const bundle::AreaLight& light,
                    std::int32_t index);
  bool scatter_diffuse(Path& path, const Interaction& at, const bundle::DiffuseMaterial& material);
  void connect_to_light(const Path& path, const Interaction& at, const SampledSpectrum& reflectance);
  bool scatter_dielectric(Path& path, const Interaction& at, const bundle::DielectricMaterial& material);
  void continue_from(Path& path, const Interaction& at, Vector3d direction) const;
  Point3f offset_origin(const Interaction& at, Vector3d direction) const;
  void trace_shadow(const ShadowRecord& record, const SensorWeights* weights,
                    std::optional<std::uint32_t> at);
  void deposit(std::uint32_t pixel, std::uint32_t sample, const SensorWeights& weights,
               const SampledSpectrum& radiance);
  SensorWeights sensor_of(const std::array<float, 4>& camera, const SampledWavelengths& wavelengths) const;
  SampleKey key_of(std::uint32_t pixel, std::uint32_t sample) const;

  const RenderScene& scene_;
  const Manifest& manifest_;
  ResidentViews resident_;
  const KernelFunctions& kernel_;
  Film& film_;
  Outbox& outbox_;
  TraceCounters& counters_;
};

}  // namespace vitrail
