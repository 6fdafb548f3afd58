// SPDX-License-Identifier: Apache-2.0
// Part of lane_stages.inl: candidates for a light, and points on them.
#include "tracer/transport/waves/lane_environments.inl"

// A candidate for a light, of each lane.
struct Candidate {
  Mask<D> arrives, is_delta;
  Connected<D> light;
  D pdf;
  Four<F> radiance;
  const EmissiveQuadric* quadric[W];
  const PlacedQuadric* sphere[W];  // where that is one; else null
  LightRef ref[W];
};

// Which of the lights of the tree, and where on it. `root`: what choose_lights keeps.
struct TreeRoot {
  LightWeights weights[W];
  bool is_known = false;
};

// Those that are not for lanes.
VITRAIL_LANES void sample_alone(const LaneWork& work, const Group& g, Vector<D> p, const Four<F>& u,
                                const bool (&alone)[W], Mask<D> of_tree, const ChosenLights<W>& chosen,
                                Candidate& c) {
  for (int j = 0; j < W; ++j) {
    if (!alone[j]) continue;
    const float numbers[4] = {lane(u[0], j), lane(u[1], j), lane(u[2], j), lane(u[3], j)};
    LightSample s;
    const bool arrives = is_set(of_tree, j)
                             ? lane_by_lane::draw(work, *g.path[j], point_of(p, j), numbers,
                                                  {chosen.slot[j], chosen.rest[j], chosen.probability[j]}, s)
                             : lane_by_lane::sample(work, *g.path[j], point_of(p, j), numbers, s);
    set_mask(c.arrives, j, arrives);
    if (!arrives) continue;
    set_mask(c.is_delta, j, s.is_delta);
    set_lane(c.light.to_light, j, s.to_light);
    set_lane(c.light.normal, j, s.normal);
    set_lane(c.light.distance, j, s.distance);
    set_lane(c.light.tilt_rad, j, s.tilt_rad);
    set_lane(c.pdf, j, s.pdf);
    for (int i = 0; i < 4; ++i) set_lane(c.radiance[i], j, s.radiance.v[i]);
    c.quadric[j] = s.quadric;
    c.sphere[j] = nullptr;
    c.ref[j] = s.light;
  }
}

// Those of `on`, whose lamps are triangles. The pdf is given the light.
VITRAIL_LANES void sample_triangles(const LaneWork& work, Vector<D> p, const Four<F>& u,
                                    const LightSampler::Slot* const (&slot)[W], const bool (&on)[W],
                                    Candidate& c) {
  const AreaLight* const area_lights = work.tracing.scene.manifest.area_lights.data();
  const LightSampler::Slot* of[W];
  const LightSampler::Face* face[W];
  LightSampler::Face made[W];
  const auto& faces = work.tracing.scene.lights.faces;
  for (int j = 0; j < W; ++j) {
    of[j] = on[j] ? slot[j] : &work.scene.no_slot;
    face[j] = on[j] ? faces.data() + slot[j]->light.index : &work.scene.no_face;
    if (on[j] && faces.empty()) face[j] = &(made[j] = lane_by_lane::face_of(*slot[j]));
  }
  const LampSample<D> lamp = draw_triangle<D>(
      p, u[0], u[1], [&](int j) __attribute__((always_inline))->const LightSampler::Slot& { return *of[j]; },
      [&](int j) __attribute__((always_inline))->const LightSampler::Face& { return *face[j]; },
      VITRAIL_EACH(on[j] && area_lights[of[j]->area_light].two_sided));
  c.arrives = lamp.arrives & gather_mask<D>(VITRAIL_EACH(on[j]));
  c.light = {lamp.to_light, lamp.distance, lamp.normal, lamp.tilt_rad};
  c.pdf = lamp.pdf;
}

// The same whose lamps are spheres; other lanes keep what they have.
VITRAIL_LANES void sample_spheres(const LaneWork& work, Vector<D> p, const Four<F>& u,
                                  const LightSampler::Slot* const (&slot)[W], const bool (&on)[W],
                                  Candidate& c) {
  const AreaLight* const area_lights = work.tracing.scene.manifest.area_lights.data();
  const QuadricLight* const quadrics = work.tracing.scene.lights.quadrics.data();
  for (int j = 0; j < W; ++j) {
    if (!on[j]) continue;
    const QuadricLight& light = quadrics[slot[j]->light.index];
    c.quadric[j] = &light.record();
    c.sphere[j] = &light.stands();
  }
  const SphereSample<D> s = sample_sphere<D>(
      p, u[0], u[1], [&](int j) __attribute__((always_inline))->const PlacedQuadric& {
        return on[j] ? *c.sphere[j] : work.scene.no_sphere;
      });
  const Mask<D> those = gather_mask<D>(VITRAIL_EACH(on[j]));
  const Mask<D> turned = gather_mask<D>(VITRAIL_EACH(on[j] && c.quadric[j]->quadric.inside_out)),
                two_sided = gather_mask<D>(VITRAIL_EACH(on[j] && area_lights[slot[j]->area_light].two_sided));
  c.arrives = (those & s.arrives & ((s.outside != turned) | two_sided)) | (no(those) & c.arrives);
  c.light.to_light = select<D>(those, s.to_light, c.light.to_light);
  c.light.normal = select<D>(those, s.normal, c.light.normal);
  c.light.distance = select<D>(those, s.distance, c.light.distance);
  c.light.tilt_rad = select<D>(those, fill<D>(0), c.light.tilt_rad);
  c.pdf = select<D>(those, s.pdf, c.pdf);
}

// Those of which[j] that the number for it chooses beside the tree: an environment, a distant light, or none
// that lanes know.
struct SingleLight {
  std::uint32_t environment = no_light, distant = no_light;
};
VITRAIL_LANES SingleLight single_light(const LaneWork& work, double u) {
  const LightSampler& lights = work.tracing.scene.lights;
  const std::size_t first = lights.first_environment(), choice = lane_by_lane::choice_of(lights, u);
  SingleLight light;
  if (!(lights.share.data()[choice] > 0) || choice == 0) return light;
  if (choice >= first)
    light.environment = static_cast<std::uint32_t>(choice - first);
  else if (work.scene.distant.data()[choice - 1].is_plain)
    light.distant = static_cast<std::uint32_t>(choice - 1);
  return light;
}

// Lights from one point, of `on`; other lanes keep what they have. The pdf is that of their choice.
[[gnu::noinline]] void sample_emitters(const LaneWork& work, const Group& g, Vector<D> p, const bool (&on)[W],
                                       D choice, Candidate& c) {
  const auto emitter = [&](int j) __attribute__((always_inline))->const PointEmitter& {
    return on[j] ? work.tracing.scene.lights.emitters.data()[c.ref[j].index] : work.scene.no_emitter;
  };
  const EmitterSample<D> s = draw_emitter<D>(p, emitter);
  FlatSpectrum intensity[W];
  for (int j = 0; j < W; ++j)
    if (on[j]) intensity[j] = flat_spectrum(*emitter(j).intensity);
  const Four<F> spectrum = values_of(
      g, [&](int j) __attribute__((always_inline))->const FlatSpectrum& { return intensity[j]; });
  const Mask<D> those = gather_mask<D>(VITRAIL_EACH(on[j]));
  c.arrives = c.arrives | (those & s.arrives);
  c.is_delta = c.is_delta | those;
  c.light.to_light = select<D>(those, s.to_light, c.light.to_light);
  c.light.normal = select<D>(those, fill<D>(Vector3d{}), c.light.normal);
  c.light.distance = select<D>(those, s.distance, c.light.distance);
  c.light.tilt_rad = select<D>(those, fill<D>(0), c.light.tilt_rad);
  c.pdf = select<D>(those, choice, c.pdf);
  for (int i = 0; i < 4; ++i)
    c.radiance[i] = select<F>(mask_for<F>(those), s.part * spectrum[i] * s.weakening, c.radiance[i]);
}

// The same of distant lights: which[j].
[[gnu::noinline]] void sample_distant(const LaneWork& work, const Group& g, const std::uint32_t (&which)[W],
                                      Candidate& c) {
  const LightSampler& lights = work.tracing.scene.lights;
  const auto number = [&](int j) __attribute__((always_inline)) {
    return which[j] == no_light ? 0 : which[j];
  };
  const Four<F> irradiance = values_of(
      g, [&](int j) __attribute__((always_inline))->const FlatSpectrum& {
        return work.scene.distant.data()[number(j)].irradiance;
      });
  const Mask<D> those = gather_mask<D>(VITRAIL_EACH(which[j] != no_light));
  const Vector<D> direction = gather_vector<D>([&](int j) __attribute__((always_inline))->const Vector3d& {
    return lights.distant.data()[number(j)].direction;
  });
  c.arrives = c.arrives | those;
  c.is_delta = c.is_delta | those;
  c.light.to_light = select<D>(those, -direction, c.light.to_light);
  c.light.normal = select<D>(those, fill<D>(Vector3d{}), c.light.normal);
  c.light.distance = select<D>(those, fill<D>(std::numeric_limits<double>::infinity()), c.light.distance);
  c.light.tilt_rad = select<D>(those, fill<D>(0), c.light.tilt_rad);
  c.pdf = select<D>(those, gather<D>(VITRAIL_EACH(lights.share.data()[1 + number(j)])), c.pdf);
  for (int i = 0; i < 4; ++i) c.radiance[i] = select<F>(mask_for<F>(those), irradiance[i], c.radiance[i]);
  for (int j = 0; j < W; ++j)
    if (which[j] != no_light) c.ref[j] = {LightKind::distant, which[j]};
}

// Of plain lamps, kept in the path. Not inlined into the stage of each kind.
[[gnu::noinline]] void find_radiances(const LaneWork& work, const Group& g,
                                      const LightSampler::Slot* const (&slot)[W], const bool (&on)[W]) {
  const Four<F> radiance = values_of(
      g, [&](int j) __attribute__((always_inline))->const FlatSpectrum& {
        return work.scene.radiances.data()[on[j] ? slot[j]->area_light : 0];
      });
  for (int j = 0; j < W; ++j) {
    if (!on[j]) continue;
    LastLamp& lamp = g.path[j]->lamp;
    lamp.area_light = slot[j]->area_light;
    for (int i = 0; i < 4; ++i) lamp.radiance.v[i] = lane(radiance[i], j);
  }
}

VITRAIL_LANES Candidate candidate_of(const LaneWork& work, const Group& g, Vector<D> p, const Four<F>& u,
                                     Mask<D> on, TreeRoot& root) {
  const LightSampler& lights = work.tracing.scene.lights;
  constexpr double below_one = 0x1.fffffffffffffp-1;
  const double share = lights.share.data()[0];
  D in_tree = to_doubles(u[2]);
  Mask<D> of_tree = on;
  if (!lights.three_numbers) {
    const D rest = to_doubles(u[3]);
    const D fine = lanes::clamp<D>(rest / share, 0.0, 0x1.fffffp-1);
    in_tree = lanes::min(in_tree + fine * 0x1p-24, fill<D>(below_one));
    if (lights.share.size() > 1) of_tree = on & (rest < share);
    if (!(share > 0)) of_tree = on & (rest < rest);
  }
  ChosenLights<W> chosen;
  choose_lights(lights.tree, p, in_tree, of_tree, root.weights, root.is_known, chosen);
  root.is_known |= any(of_tree);

  const LightSampler::Slot* slot[W];
  std::uint32_t environment[W], distant[W];
  bool triangle[W], sphere[W], emitter[W], alone[W], some_triangle = false, some_sphere = false,
                                                     some_emitter = false, some_distant = false,
                                                     some_alone = false, some_environment = false;
  for (int j = 0; j < W; ++j) {
    const bool from_tree = is_set(of_tree, j) && chosen.any[j];
    const LaneLamp lamp = from_tree ? work.scene.lamps.data()[chosen.slot[j]] : LaneLamp::other;
    const bool is_surface = lamp == LaneLamp::triangle || lamp == LaneLamp::sphere;
    slot[j] = is_surface ? lights.slots.data() + chosen.slot[j] : &work.scene.no_slot;
    some_triangle |= triangle[j] = lamp == LaneLamp::triangle;
    some_sphere |= sphere[j] = lamp == LaneLamp::sphere;
    some_emitter |= emitter[j] = lamp == LaneLamp::emitter;
    const bool is_single = is_set(on, j) && !is_set(of_tree, j);
    const SingleLight single =
        is_single ? single_light(work, static_cast<double>(lane(u[3], j))) : SingleLight{};
    some_environment |= (environment[j] = single.environment) != no_light;
    some_distant |= (distant[j] = single.distant) != no_light;
    some_alone |= alone[j] = from_tree ? lamp == LaneLamp::other
                                       : is_single && environment[j] == no_light && distant[j] == no_light;
  }

  Candidate c{};
  for (int j = 0; j < W; ++j)
    c.ref[j] = emitter[j] ? lane_by_lane::light_of(lights, chosen.slot[j]) : slot[j]->light;
  if (some_triangle) sample_triangles(work, p, u, slot, triangle, c);
  if (some_sphere) sample_spheres(work, p, u, slot, sphere, c);
  const D choice = gather<D>(VITRAIL_EACH(chosen.probability[j])) * share;
  c.pdf = c.pdf * choice;
  bool is_new[W], some_new = false;
  for (int j = 0; j < W; ++j)
    some_new |= is_new[j] = is_set(c.arrives, j) && g.path[j]->lamp.area_light != slot[j]->area_light;
  if (some_new) find_radiances(work, g, slot, is_new);
  for (int i = 0; i < 4; ++i) c.radiance[i] = gather<F>(VITRAIL_EACH(g.path[j]->lamp.radiance.v[i]));
  if (some_emitter) sample_emitters(work, g, p, emitter, choice, c);
  if (some_distant) sample_distant(work, g, distant, c);
  if (some_environment) {
    EnvironmentSample s;
    sample_environments(work, g, u, environment, s);
    c.arrives = c.arrives | s.arrives;
    c.light.to_light = select<D>(s.chosen, s.to_light, c.light.to_light);
    c.light.distance =
        select<D>(s.chosen, fill<D>(std::numeric_limits<double>::infinity()), c.light.distance);
    c.pdf = select<D>(s.chosen, s.seen.pdf, c.pdf);
    for (int i = 0; i < 4; ++i)
      c.radiance[i] = select<F>(mask_for<F>(s.chosen), s.seen.radiance[i], c.radiance[i]);
    for (int j = 0; j < W; ++j)
      if (environment[j] != no_light) c.ref[j] = {LightKind::environment, environment[j]};
  }
  if (some_alone) sample_alone(work, g, p, u, alone, of_tree, chosen, c);
  return c;
}
