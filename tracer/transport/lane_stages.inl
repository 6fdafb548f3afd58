// SPDX-License-Identifier: Apache-2.0
// The stages of lane_stages.h for W paths at a time. Included by one file an instruction set, within
// vitrail::lanes' unnamed namespace, with W defined. Nothing that is called here may be an inline function of
// another header, unless it is in an unnamed namespace: the linker would take one of all files' copies.

using D = Doubles<W>;
using F = Floats<W>;
using I = Ints<W>;
using U = Words<W>;
using L = Longs<W>;

#define VITRAIL_EACH(value) ([&](int j) __attribute__((always_inline)) { return value; })

// W paths of a list; behind its end the last one again.
struct Group {
  CameraPath* path[W];
  const LaneSurface* surface[W];
  std::uint32_t place[W];
  int valid;
};

VITRAIL_LANES Group group_of(const LaneWork& work, const LaneList& list, std::size_t first) {
  Group g;
  g.valid = list.count - first < W ? static_cast<int>(list.count - first) : W;
  for (int j = 0; j < W; ++j) {
    g.place[j] = list.places[first + static_cast<std::size_t>(j < g.valid ? j : g.valid - 1)];
    g.path[j] = work.paths + g.place[j];
    g.surface[j] = work.scene.surfaces.data() + work.surface[g.place[j]];
  }
  return g;
}

// What a path carries, and what its random numbers are functions of.
struct Carried {
  Four<F> throughput;
  F brightness;  // 1, or 1/hero_count of a path that has its hero wavelength alone
  U pixel, sample, depth;

  VITRAIL_LANES explicit Carried(const Group& g) {
    for (int i = 0; i < 4; ++i) throughput[i] = gather<F>(VITRAIL_EACH(g.path[j]->throughput.v[i]));
    brightness = gather<F>(VITRAIL_EACH(g.path[j]->dispersed ? 1.0f / hero_count : 1.0f));
    pixel = gather<U>(VITRAIL_EACH(g.path[j]->key.pixel));
    sample = gather<U>(VITRAIL_EACH(g.path[j]->key.sample));
    depth = gather<U>(VITRAIL_EACH(g.path[j]->depth));
  }
};

VITRAIL_LANES Four<F> scatter_numbers(const LaneWork& work, const Carried& carried) {
  return lanes::sample_4d(work.tracing.scene.seed, carried.pixel, carried.sample, 1u + 2u * carried.depth);
}

VITRAIL_LANES Interaction<D> interaction_of(const LaneWork& work, const Group& g, bool is_placed) {
  const Vector<F> direction = gather_vector<F>([&](int j) __attribute__((always_inline))->const Vector3f& {
    return g.path[j]->ray.direction;
  });
  if (!is_placed)
    return triangle_interaction<D>(
        [&](int j) __attribute__((always_inline))->const DomainTables& {
          return work.domains[g.path[j]->hit_domain];
        },
        [&](int j) __attribute__((always_inline))->const Hit& { return g.path[j]->hit; }, direction);
  const auto of = [&](int j) __attribute__((always_inline))->const PlacedHit& {
    return work.placed[g.place[j]];
  };
  const Vector<D> d = to_doubles(direction);
  Interaction<D> at;
  at.p = gather_vector<D>([&](int j) __attribute__((always_inline))->const Point3d& { return of(j).p; });
  at.geometric = gather_vector<D>([&](int j) __attribute__((always_inline))->const Vector3d& {
    return of(j).geometric;
  });
  at.shading =
      gather_vector<D>([&](int j) __attribute__((always_inline))->const Vector3d& { return of(j).shading; });
  at.dpdu =
      gather_vector<D>([&](int j) __attribute__((always_inline))->const Vector3d& { return of(j).dpdu; });
  at.rounding = gather<D>(VITRAIL_EACH(of(j).rounding));
  at.out = d * (0.5 * dot(d, d) - 1.5);
  at.cosine = dot(at.out, at.geometric);
  at.front = at.cosine > 0;
  return at;
}

VITRAIL_LANES Vector<F> origin_of(const LaneWork& work, const Interaction<D>& at, Vector<D> direction) {
  return offset_origin(at.p, at.geometric, at.rounding, work.rounding_of_doubles, direction);
}

VITRAIL_LANES Point3d point_of(Vector<D> p, int j) { return {lane(p.x, j), lane(p.y, j), lane(p.z, j)}; }

VITRAIL_LANES F greatest(const Four<F>& s) {
  return lanes::max(lanes::max(lanes::max(s[0], s[1]), s[2]), s[3]);
}

// Those of `on` go on from the surface.
VITRAIL_LANES void go_on(LaneWork& work, const Group& g, const Carried& carried, const Interaction<D>& at,
                         Mask<F> on, Vector<D> direction, const Four<F>& throughput, F pdf,
                         Mask<F> connected) {
  const L seed = gather<L>(VITRAIL_EACH(g.path[j]->seed));
  const U depth = carried.depth + 1u;
  const L stream = (convert<std::uint64_t>(depth) << 3 | static_cast<std::uint64_t>(RayRandom::throughput)) *
                   stream_factor;
  const Departed<D> ray = depart<D>(seed, stream, origin_of(work, at, direction), direction, throughput);
  const Mask<D> front_side = dot(direction, at.geometric) > 0;
  for (int j = 0; j < g.valid; ++j) {
    if (!is_set(on, j)) continue;
    CameraPath& path = *g.path[j];
    if (work.scene.divides_space)
      path.inside =
          lane_by_lane::inside(work, path, {g.place[j], is_set(at.front, j), is_set(front_side, j)});
    path.depth = lane(depth, j);
    path.passed = false;
    path.connected |= is_set(connected, j);
    path.pdf = lane(pdf, j);
    path.travelled = 0;
    path.ray.exclude = path.hit.triangle;
    path.ray.origin.x = lane(ray.origin.x, j);
    path.ray.origin.y = lane(ray.origin.y, j);
    path.ray.origin.z = lane(ray.origin.z, j);
    path.ray.direction.x = lane(ray.direction.x, j);
    path.ray.direction.y = lane(ray.direction.y, j);
    path.ray.direction.z = lane(ray.direction.z, j);
    const std::uint32_t first = lane(ray.code.first, j), second = lane(ray.code.second, j);
    for (int i = 0; i < 3; ++i) {
      path.direction.byte[i] = static_cast<std::uint8_t>(first >> 8 * i);
      path.direction.byte[3 + i] = static_cast<std::uint8_t>(second >> 8 * i);
    }
    path.random = lane(ray.random, j);
    for (int i = 0; i < 4; ++i) path.throughput.v[i] = lane(ray.throughput[i], j);
    path.hit.t = __builtin_inf();
    path.hit.triangle = no_triangle;
    path.hit.depth = 0;
    work.next[work.next_count++] = g.place[j];
  }
}

// ---- kinds: how each reads its parameters. `eval` and `sample` are those of lanes/glossy.h.

VITRAIL_LANES Four<F> spectrum_of(const LaneWork& work, const Group& g,
                                  SampledSpectrum LaneBsdf::*parameter) {
  Four<F> s;
  for (int i = 0; i < 4; ++i) s[i] = gather<F>(VITRAIL_EACH((work.bsdfs[g.place[j]].*parameter).v[i]));
  return s;
}

struct Lambert {
  Four<F> reflectance;
};
VITRAIL_LANES BsdfValue<D> eval(const Lambert& bsdf, Vector<D> out, Vector<D> in) {
  const D density = in.z / pi;
  const F scale = to_floats(density);
  BsdfValue<D> f{bsdf.reflectance, density};
  for (int i = 0; i < 4; ++i) f.value[i] = f.value[i] * scale;
  return detail::where<D>((out.z > 0) & (in.z > 0), f);
}
VITRAIL_LANES BsdfSample<D> sample(const Lambert& bsdf, Vector<D> out, F, F u_x, F u_y) {
  const Vector<D> in = sample_cosine_hemisphere(u_x, u_y);
  const Mask<D> scatters = (out.z > 0) & (in.z > 0);
  return {scatters, in, bsdf.reflectance, in.z / pi, Mask<D>{}};
}
VITRAIL_LANES BsdfSample<D> sample(const Conductor<D>& bsdf, Vector<D> out, F, F u_x, F u_y) {
  return sample(bsdf, out, u_x, u_y);
}

struct ReadLambert {
  static constexpr bool is_specular = false;
  VITRAIL_LANES static Lambert read(const LaneWork& work, const Group& g) {
    Lambert bsdf;
    const D c0 = to_doubles(gather<F>(VITRAIL_EACH(g.surface[j]->sigmoid.c0))),
            c1 = to_doubles(gather<F>(VITRAIL_EACH(g.surface[j]->sigmoid.c1))),
            c2 = to_doubles(gather<F>(VITRAIL_EACH(g.surface[j]->sigmoid.c2)));
    for (int i = 0; i < 4; ++i)
      bsdf.reflectance[i] = sigmoid(c0, c1, c2, gather<F>(VITRAIL_EACH(g.path[j]->wavelengths.lambda_nm[i])));
    const F constant = gather<F>(VITRAIL_EACH(g.surface[j]->constant));
    for (int i = 0; i < 4; ++i) bsdf.reflectance[i] = select<F>(constant >= 0, constant, bsdf.reflectance[i]);
    for (int j = 0; j < W; ++j)
      if (g.surface[j]->has_parameters)
        for (int i = 0; i < 4; ++i) set_lane(bsdf.reflectance[i], j, work.bsdfs[g.place[j]].a.v[i]);
    return bsdf;
  }
};

VITRAIL_LANES Microfacets<D> microfacets_of(const LaneWork& work, const Group& g) {
  return gather_microfacets<D>([&](int j) __attribute__((always_inline))->const vitrail::Microfacets& {
    return work.bsdfs[g.place[j]].microfacets;
  });
}

VITRAIL_LANES Conductor<D> conductor_of(const LaneWork& work, const Group& g) {
  return {microfacets_of(work, g), spectrum_of(work, g, &LaneBsdf::a), spectrum_of(work, g, &LaneBsdf::b),
          spectrum_of(work, g, &LaneBsdf::c),
          gather_mask<D>(VITRAIL_EACH(work.bsdfs[g.place[j]].is_perfect))};
}
struct ReadMetal {
  static constexpr bool is_specular = false;
  VITRAIL_LANES static Conductor<D> read(const LaneWork& work, const Group& g) {
    return conductor_of(work, g);
  }
};

struct SmoothConductor {
  Conductor<D> conductor;
};
VITRAIL_LANES BsdfSample<D> sample(const SmoothConductor& bsdf, Vector<D> out, F, F, F) {
  return sample_mirror(bsdf.conductor, out);
}
struct ReadMirror {
  static constexpr bool is_specular = true;
  VITRAIL_LANES static SmoothConductor read(const LaneWork& work, const Group& g) {
    return {conductor_of(work, g)};
  }
};

VITRAIL_LANES Plastic<D> plastic_of(const LaneWork& work, const Group& g) {
  return {spectrum_of(work, g, &LaneBsdf::a), spectrum_of(work, g, &LaneBsdf::b),
          gather<D>(VITRAIL_EACH(work.bsdfs[g.place[j]].eta)),
          gather<D>(VITRAIL_EACH(work.bsdfs[g.place[j]].internal_reflectance)),
          gather_mask<D>(VITRAIL_EACH(work.bsdfs[g.place[j]].is_nonlinear))};
}
struct ReadPlastic {
  static constexpr bool is_specular = false;
  VITRAIL_LANES static Plastic<D> read(const LaneWork& work, const Group& g) { return plastic_of(work, g); }
};
struct ReadRoughPlastic {
  static constexpr bool is_specular = false;
  VITRAIL_LANES static auto read(const LaneWork& work, const Group& g) {
    const auto table = [&](int j) __attribute__((always_inline)) {
      return work.bsdfs[g.place[j]].external_transmittance;
    };
    return RoughPlastic<D, decltype(table)>{plastic_of(work, g), microfacets_of(work, g), table};
  }
};

// ---- connections to lights

// A candidate for a light, of each lane.
struct Candidate {
  Mask<D> arrives, is_delta;
  Connected<D> light;
  D pdf;
  Four<F> radiance;
  const EmissiveQuadric* quadric[W];
  LightRef ref[W];
};

// Which of the lights of the tree, and where on it. `root`: what choose_lights keeps.
struct TreeRoot {
  NodeWeights weights[W];
  bool is_known = false;
};

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
  const LightSampler::Face* face[W];
  bool in_lanes[W], alone[W], some_alone = false;
  for (int j = 0; j < W; ++j) {
    const bool from_tree = is_set(of_tree, j);
    const bool plain = chosen.any[j] && work.scene.is_plain_lamp.data()[chosen.slot[j]];
    slot[j] = plain ? lights.slots.data() + chosen.slot[j] : &work.scene.no_slot;
    face[j] = plain ? lights.faces.data() + slot[j]->light.index : &work.scene.no_face;
    in_lanes[j] = from_tree && plain;
    alone[j] = is_set(on, j) && (!from_tree || (chosen.any[j] && !plain));
    some_alone |= alone[j];
  }

  Candidate c;
  const AreaLight* const area_lights = work.tracing.scene.manifest.area_lights.data();
  const LampSample<D> lamp = draw_triangle<D>(
      p, u[0],
      u[1], [&](int j) __attribute__((always_inline))->const LightSampler::Slot& { return *slot[j]; },
      [&](int j) __attribute__((always_inline))->const LightSampler::Face& { return *face[j]; },
      VITRAIL_EACH(in_lanes[j] && area_lights[slot[j]->area_light].two_sided));
  c.arrives = lamp.arrives & gather_mask<D>(VITRAIL_EACH(in_lanes[j]));
  c.is_delta = gather_mask<D>([](int) __attribute__((always_inline)) { return false; });
  c.light = {lamp.to_light, lamp.distance, lamp.normal, lamp.tilt_rad};
  c.pdf = lamp.pdf * (gather<D>(VITRAIL_EACH(chosen.probability[j])) * share);
  for (int j = 0; j < W; ++j) {
    c.quadric[j] = nullptr;
    if (!is_set(c.arrives, j)) continue;
    if (g.path[j]->lamp.area_light != slot[j]->area_light)
      lane_by_lane::find_radiance(work, *g.path[j], slot[j]->area_light);
  }
  for (int i = 0; i < 4; ++i) c.radiance[i] = gather<F>(VITRAIL_EACH(g.path[j]->lamp.radiance.v[i]));
  if (!some_alone) return c;

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
    c.ref[j] = s.light;
  }
  return c;
}

VITRAIL_LANES LightSample light_of(const Candidate& chosen, int j) {
  LightSample light;
  light.to_light = lane(chosen.light.to_light, j);
  light.normal = lane(chosen.light.normal, j);
  light.distance = lane(chosen.light.distance, j);
  light.tilt_rad = lane(chosen.light.tilt_rad, j);
  light.is_delta = is_set(chosen.is_delta, j);
  light.quadric = chosen.quadric[j];
  light.light = chosen.ref[j];
  return light;
}

// One by one, by whatever ray it takes.
VITRAIL_LANES void send_connections(LaneWork& work, const Group& g, const Interaction<D>& at, Mask<D> on,
                                    const Candidate& chosen, const Four<F>& radiance) {
  const Vector<F> origin = origin_of(work, at, chosen.light.to_light);
  const Mask<D> front_side = dot(chosen.light.to_light, at.geometric) > 0;
  for (int j = 0; j < g.valid; ++j) {
    if (!is_set(on, j)) continue;
    ++work.rays_shadow;
    const float brings[4] = {lane(radiance[0], j), lane(radiance[1], j), lane(radiance[2], j),
                             lane(radiance[3], j)};
    lane_by_lane::send(work, *g.path[j], {g.place[j], is_set(at.front, j), is_set(front_side, j)},
                       point_of(at.p, j), {lane(origin.x, j), lane(origin.y, j), lane(origin.z, j)},
                       light_of(chosen, j), brings);
  }
}

VITRAIL_LANES void send_shadow_rays(LaneWork& work, const Group& g, const Interaction<D>& at, Mask<D> on,
                                    const Candidate& chosen, Four<F> radiance) {
  const Vector<F> origin = origin_of(work, at, chosen.light.to_light);
  const Aimed<D> aimed = aim(at.p, origin, chosen.light);
  const F end = shadow_end(aimed.end);
  radiance = shadow_radiance(radiance);
  for (int j = 0; j < g.valid; ++j) {
    if (!is_set(on, j)) continue;
    const CameraPath& path = *g.path[j];
    ShadowRay& shadow = work.shadows.rays[work.shadows.count++];
    ++work.rays_shadow;
    shadow.ray.origin.x = lane(origin.x, j);
    shadow.ray.origin.y = lane(origin.y, j);
    shadow.ray.origin.z = lane(origin.z, j);
    shadow.ray.direction.x = lane(aimed.direction.x, j);
    shadow.ray.direction.y = lane(aimed.direction.y, j);
    shadow.ray.direction.z = lane(aimed.direction.z, j);
    shadow.ray.exclude = path.hit.triangle;
    const std::uint32_t first = lane(aimed.code.first, j), second = lane(aimed.code.second, j);
    for (int i = 0; i < 3; ++i) {
      shadow.direction.byte[i] = static_cast<std::uint8_t>(first >> 8 * i);
      shadow.direction.byte[3 + i] = static_cast<std::uint8_t>(second >> 8 * i);
    }
    shadow.tmax = lane(end, j);
    for (int i = 0; i < 4; ++i) shadow.radiance.v[i] = lane(radiance[i], j);
    shadow.pixel = path.film.pixel;
    shadow.sample = path.film.sample;
    shadow.time_s = path.time_s;
    shadow.sensor = &path.film.sensor;
    if (!chosen.quadric[j]) continue;
    lane_by_lane::aim(path, point_of(at.p, j), shadow.ray.origin, light_of(chosen, j), shadow);
  }
}

// As connect.cpp has it.
template <class Bsdf>
VITRAIL_LANES void connect(LaneWork& work, const Group& g, const Carried& carried, const Interaction<D>& at,
                           const Bsdf& bsdf, const Frame<D>& frame, Vector<D> out, Mask<D> on,
                           std::uint32_t count) {
  const Four<F> u =
      lanes::sample_4d(work.tracing.scene.seed, carried.pixel, carried.sample, 2u + 2u * carried.depth);
  D choice = to_doubles(gather<F>(VITRAIL_EACH(g.path[j]->film.camera.data()[3])));
  D all = fill<D>(0), chosen = fill<D>(0);
  Candidate best{};
  Four<F> radiance{};
  TreeRoot root;
  for (std::uint32_t k = 0; k < count; ++k) {
    const Candidate c = candidate_of(work, g, at.p, k > 0 ? numbers_of_candidate(u, k) : u, on, root);
    const Vector<D> in = frame.to_local(c.light.to_light);
    // Shading normals let no light leak.
    const Mask<D> same_side = (dot(c.light.to_light, at.geometric) > 0) == (at.cosine * out.z * in.z > 0);
    const BsdfValue<D> scattered = eval(bsdf, out, in);
    const D beside =
        select<D>(c.is_delta, fill<D>(0), to_doubles(lanes::density_beside(scattered.pdf, count)));
    const F weight = to_floats(1.0 / (c.pdf + beside));
    Four<F> brought;
    D target = fill<D>(0);
    for (int i = 0; i < 4; ++i) {
      brought[i] = carried.throughput[i] * scattered.value[i] * c.radiance[i] * weight;
      target = target + to_doubles(brought[i]);
    }
    const Mask<D> brings = on & c.arrives & same_side & (target > 0);
    all = select<D>(brings, all + target, all);
    // One number for all choices: what is left of it after one is as random as it was.
    const Mask<D> had = chosen > 0;
    const D share = target / all;
    const Mask<D> stays = brings & had & (choice >= share), takes = brings & no(stays);
    choice =
        select<D>(stays, (choice - share) / (1.0 - share), select<D>(brings & had, choice / share, choice));
    chosen = select<D>(takes, target, chosen);
    for (int i = 0; i < 4; ++i) radiance[i] = select<F>(mask_for<F>(takes), brought[i], radiance[i]);
    if (k == 0) {
      best = c;
      continue;
    }
    best.light.to_light = select<D>(takes, c.light.to_light, best.light.to_light);
    best.light.normal = select<D>(takes, c.light.normal, best.light.normal);
    best.light.distance = select<D>(takes, c.light.distance, best.light.distance);
    best.light.tilt_rad = select<D>(takes, c.light.tilt_rad, best.light.tilt_rad);
    best.is_delta = (takes & c.is_delta) | (no(takes) & best.is_delta);
    for (int j = 0; j < W; ++j)
      if (is_set(takes, j)) best.quadric[j] = c.quadric[j], best.ref[j] = c.ref[j];
  }
  if (count > 1) {
    const F mean = to_floats(all / (static_cast<double>(count) * chosen));
    for (int i = 0; i < 4; ++i) radiance[i] = radiance[i] * mean;
  }
  if (work.scene.has_connections)
    send_connections(work, g, at, all != 0, best, radiance);
  else
    send_shadow_rays(work, g, at, all != 0, best, radiance);
}

// ---- stages

// As scatter_path has it, of a BSDF that does not transmit.
template <class Read>
void scatter(LaneWork& work, const LaneList& list) {
  const bool can_sample = !work.tracing.scene.lights.share.empty();
  for (std::size_t first = 0; first < list.count; first += W) {
    const Group g = group_of(work, list, first);
    const Interaction<D> at = interaction_of(work, g, list.is_placed);
    const Carried carried(g);
    const Mask<D> on = at.front | gather_mask<D>(VITRAIL_EACH(g.surface[j]->two_sided));
    const Frame<D> frame = frame_around(at.shading, at.dpdu, at.side());
    const Vector<D> out = frame.to_local(at.out);
    const auto bsdf = Read::read(work, g);
    if constexpr (!Read::is_specular)
      if (can_sample) connect(work, g, carried, at, bsdf, frame, out, on, list.candidates);

    const Four<F> u = scatter_numbers(work, carried);
    const BsdfSample<D> s = sample(bsdf, out, u[2], u[0], u[1]);
    Four<F> throughput;
    for (int i = 0; i < 4; ++i) throughput[i] = carried.throughput[i] * s.weight[i];
    const F brightest = greatest(throughput);
    // A mirror goes by the surface's own normal where the shading normal would have it leave its side.
    const Vector<D> sampled = frame.to_world(s.in);
    const D sides = out.z * s.in.z;
    const Mask<D> leaves = (dot(sampled, at.geometric) > 0) != (at.cosine * out.z * s.in.z > 0);
    const Mask<D> by_surface = leaves & s.specular & (sides > 0);
    const Vector<D> direction = select<D>(by_surface, at.geometric * (2.0 * at.cosine) - at.out, sampled);
    const Mask<F> specular = mask_for<F>(s.specular);
    const F pdf = select<F>(specular, fill<F>(0), lanes::density_beside(s.pdf, list.candidates));
    Mask<F> lives =
        mask_for<F>(on & s.scatters & (no(leaves) | by_surface)) & (brightest > 0) & (specular | (pdf > 0));
    if (!Read::is_specular && work.roulette_worth > 0) {
      const F survival =
          to_floats(attainable(to_doubles(brightest * carried.brightness / work.roulette_worth)));
      const Mask<F> by_chance = no(specular) & (survival < 1);
      lives = lives & (no(by_chance) | (u[3] < survival));
      const F scale = select<F>(by_chance, 1.0f / survival, fill<F>(1));
      for (int i = 0; i < 4; ++i) throughput[i] = throughput[i] * scale;
    }
    go_on(work, g, carried, at, lives, direction, throughput, pdf, no(specular));
  }
}

// As glass.cpp has it, of a path that does not end there, in a pane whose wavelengths do not part.
void scatter_glass(LaneWork& work, const LaneList& list) {
  for (std::size_t first = 0; first < list.count; first += W) {
    const Group g = group_of(work, list, first);
    const Interaction<D> at = interaction_of(work, g, list.is_placed);
    const Carried carried(g);
    const Vector<D> normal = at.shading * at.side();
    const F behind = gather<F>(VITRAIL_EACH(g.surface[j]->eta_behind)),
            before = gather<F>(VITRAIL_EACH(g.surface[j]->eta_before));
    const D eta = to_doubles(select<F>(mask_for<F>(at.front), behind / before, before / behind));
    const D cosine = dot(at.out, normal);
    const F reflectance = to_floats(fresnel_dielectric(cosine, eta));
    D reflected = fill<D>(0), all = fill<D>(0);
    for (int i = 0; i < 4; ++i) {
      const D carries = to_doubles(carried.throughput[i]);
      reflected = reflected + carries * to_doubles(reflectance);
      all = all + carries;
    }
    const D reflects = attainable(reflected / all);
    const Four<F> u = scatter_numbers(work, carried);
    const Mask<D> goes_back = to_doubles(u[2]) < reflects;
    Vector<D> refracted;
    const Mask<D> passes = refract(at.out, normal, eta, refracted);
    const Vector<D> direction = select<D>(goes_back, normal * (2.0 * cosine) - at.out, refracted);
    const F back = to_floats(1.0 / reflects);
    const F through = to_floats((1.0 - to_doubles(reflectance)) / (1.0 - reflects) / (eta * eta));
    Four<F> throughput;
    for (int i = 0; i < 4; ++i)
      throughput[i] = select<F>(mask_for<F>(goes_back), carried.throughput[i] * reflectance * back,
                                carried.throughput[i] * through);
    const Mask<F> lives = mask_for<F>(goes_back | passes) & (greatest(throughput) > 0);
    for (int j = 0; j < g.valid; ++j)
      if (is_set(lives, j))
        lane_by_lane::cross_face(*g.path[j], lane(normal, j), is_set(at.front, j), is_set(goes_back, j));
    go_on(work, g, carried, at, lives, direction, throughput, fill<F>(0), Mask<F>{});
  }
}

void begin(const Tracing& tracing, CameraPath* paths, const std::uint32_t* places, std::size_t count) {
  const WavelengthTables tables = wavelength_tables();
  const float* const observer = cie_1931()[0].data();
  for (std::size_t first = 0; first < count; first += W) {
    CameraPath* path[W];
    for (std::size_t j = 0; j < W; ++j) path[j] = paths + places[first + j < count ? first + j : count - 1];
    const U pixel = gather<U>(VITRAIL_EACH(path[j]->key.pixel)),
            sample = gather<U>(VITRAIL_EACH(path[j]->key.sample));
    const L seed = sample_seed(tracing.scene.seed.value, pixel, sample);
    const Four<F> u = lanes::sample_4d(tracing.scene.seed, pixel, sample, pixel * 0u + sample_set::camera);
    const Wavelengths<F> wavelengths = lanes::sample_wavelengths(tables, u[2]);
    const D weight =
        gather<D>(VITRAIL_EACH(lane_by_lane::filter_weight(tracing, lane(u[0], j), lane(u[1], j))));
    const SensorXyz<F> sensor = lanes::sensor_weights(observer, wavelengths, weight);
    for (int j = 0; j < W; ++j) {
      CameraPath& p = *path[j];
      p.seed = lane(seed, j);
      p.film.has_wavelengths = true;
      for (int i = 0; i < 4; ++i) {
        p.film.camera.data()[i] = lane(u[i], j);
        p.wavelengths.lambda_nm.data()[i] = lane(wavelengths.lambda_nm[i], j);
        p.film.sensor.x.data()[i] = lane(sensor.x[i], j);
        p.film.sensor.y.data()[i] = lane(sensor.y[i], j);
        p.film.sensor.z.data()[i] = lane(sensor.z[i], j);
      }
    }
  }
}

constexpr LaneStages stages{W,
                            begin,
                            {nullptr, scatter<ReadLambert>, scatter<ReadMirror>, scatter<ReadMetal>,
                             scatter<ReadPlastic>, scatter<ReadRoughPlastic>, scatter_glass}};
