// SPDX-License-Identifier: Apache-2.0
// Part of lane_stages.inl: W paths side by side, where they are and how they go on.

// W paths of a list; behind its end the last one again.
struct Group {
  CameraPath* path[W];
  const LaneMaterial* material[W];
  const LaneBsdf* bsdf[W];
  std::uint32_t place[W];
  int valid;
};

// That of lane j.
VITRAIL_LANES void set_code(DirectionCode& direction, const Code<U>& code, int j) {
  const std::uint32_t first = lane(code.first, j), second = lane(code.second, j);
  for (int i = 0; i < 3; ++i) {
    direction.byte[i] = static_cast<std::uint8_t>(first >> 8 * i);
    direction.byte[3 + i] = static_cast<std::uint8_t>(second >> 8 * i);
  }
}

VITRAIL_LANES Group group_of(const LaneWork& work, const LaneList& list, std::size_t first) {
  Group g;
  g.valid = list.count - first < W ? static_cast<int>(list.count - first) : W;
  for (int j = 0; j < W; ++j) {
    g.place[j] = list.places[first + static_cast<std::size_t>(j < g.valid ? j : g.valid - 1)];
    g.path[j] = work.paths + g.place[j];
    g.material[j] = nullptr, g.bsdf[j] = work.bsdfs + g.place[j];
  }
  return g;
}
// At surfaces.
VITRAIL_LANES Group group_at_surfaces(const LaneWork& work, const LaneList& list, std::size_t first) {
  Group g = group_of(work, list, first);
  for (int j = 0; j < W; ++j) {
    g.material[j] = work.scene.materials.data() + work.material[g.place[j]];
    if (!g.material[j]->has_parameters) g.bsdf[j] = &g.material[j]->constants;
  }
  return g;
}

// of(j): the FlatSpectrum of lane j, at the wavelengths of its path.
template <class SpectrumOf>
VITRAIL_LANES Four<F> values_of(const Group& g, const SpectrumOf& of) {
  Four<F> values = flat_values<D>(
      of, [&](int i) __attribute__((always_inline)) {
        return gather<F>(VITRAIL_EACH(g.path[j]->wavelengths.lambda_nm[i]));
      });
  for (int j = 0; j < W; ++j) {
    if (!of(j).other) continue;
    float value[4];
    lane_by_lane::evaluate(of(j), *g.path[j], value);
    for (int i = 0; i < 4; ++i) set_lane(values[i], j, value[i]);
  }
  return values;
}

// What a path carries, and what its random numbers are functions of.
struct Carried {
  Four<F> throughput;
  // 1, or 1/hero_count of a path that has its hero wavelength alone. A path that goes on without roulette, as
  // survival has it, is as good as infinitely bright.
  F brightness;
  U pixel, sample, depth;
  unsigned passed = 0;  // a bit each that has passed something for nothing: its numbers are hashed

  VITRAIL_LANES explicit Carried(const Group& g) {
    for (int i = 0; i < 4; ++i) throughput[i] = gather<F>(VITRAIL_EACH(g.path[j]->throughput.v[i]));
    brightness = gather<F>(VITRAIL_EACH(!g.path[j]->connected  ? std::numeric_limits<float>::infinity()
                                        : g.path[j]->dispersed ? 1.0f / hero_count
                                                               : 1.0f));
    pixel = gather<U>(VITRAIL_EACH(g.path[j]->key.pixel));
    sample = gather<U>(VITRAIL_EACH(g.path[j]->key.sample));
    depth = gather<U>(VITRAIL_EACH(g.path[j]->depth));
    for (int j = 0; j < W; ++j) passed |= static_cast<unsigned>(g.path[j]->passed) << j;
  }
};

// Of an event; `set` as sample_set has it.
VITRAIL_LANES Four<F> numbers_of(const LaneWork& work, const Group& g, const Carried& carried, U set,
                                 RayRandom use) {
  Four<F> u = lanes::sample_4d(work.tracing.scene.seed, carried.pixel, carried.sample, set);
  for (int j = 0; j < W; ++j) {
    if (!(carried.passed >> j & 1)) continue;
    float hashed[4];
    lane_by_lane::hash_numbers(*g.path[j], use, hashed);
    for (int i = 0; i < 4; ++i) set_lane(u[i], j, hashed[i]);
  }
  return u;
}
VITRAIL_LANES Four<F> scatter_numbers(const LaneWork& work, const Group& g, const Carried& carried) {
  return numbers_of(work, g, carried, 1u + 2u * carried.depth, RayRandom::scattering);
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
  at.u = gather<D>(VITRAIL_EACH(of(j).uv.x)), at.v = gather<D>(VITRAIL_EACH(of(j).uv.y));
  at.out = d * (0.5 * dot(d, d) - 1.5);
  at.cosine = dot(at.out, at.geometric);
  at.front = at.cosine > 0;
  return at;
}

VITRAIL_LANES Vector<F> origin_of(const LaneWork& work, const Interaction<D>& at, Vector<D> direction) {
  return offset_origin(at.p, at.geometric, at.rounding, work.rounding_of_doubles, direction);
}

VITRAIL_LANES Point3d point_of(Vector<D> p, int j) { return {lane(p.x, j), lane(p.y, j), lane(p.z, j)}; }

// Those of `on` go on from there; `step_off(path, j)` sets what else is of the place that they leave.
template <class StepOff>
VITRAIL_LANES void go_on_from(LaneWork& work, const Group& g, const Carried& carried, Vector<F> origin,
                              Mask<F> on, Vector<D> direction, const Four<F>& throughput, F pdf,
                              Mask<F> connected, const StepOff& step_off) {
  const L seed = gather<L>(VITRAIL_EACH(g.path[j]->seed));
  const U depth = carried.depth + 1u;
  // As numbered_depth; with direct light alone a path that was lit goes straight on at most.
  const Mask<F> only_straight = work.direct_only ? connected : Mask<F>{};
  const U numbered = select<U>(mask_for<U>(only_straight), depth | Traveller::only_straight_bit, depth);
  const L stream =
      (convert<std::uint64_t>(numbered) << 3 | static_cast<std::uint64_t>(RayRandom::throughput)) *
      stream_factor;
  const Departed<D> ray = depart<D>(seed, stream, origin, direction, throughput);
  for (int j = 0; j < g.valid; ++j) {
    if (!is_set(on, j)) continue;
    CameraPath& path = *g.path[j];
    step_off(path, j);
    path.depth = lane(depth, j);
    path.passed = false;
    path.connected |= is_set(connected, j);
    path.only_straight = is_set(only_straight, j);
    path.pdf = lane(pdf, j);
    path.travelled = 0;
    path.ray.origin.x = lane(ray.origin.x, j);
    path.ray.origin.y = lane(ray.origin.y, j);
    path.ray.origin.z = lane(ray.origin.z, j);
    path.ray.direction.x = lane(ray.direction.x, j);
    path.ray.direction.y = lane(ray.direction.y, j);
    path.ray.direction.z = lane(ray.direction.z, j);
    set_code(path.direction, ray.code, j);
    path.random = lane(ray.random, j);
    for (int i = 0; i < 4; ++i) path.throughput.v[i] = lane(ray.throughput[i], j);
    path.hit.t = __builtin_inf();
    path.hit.triangle = no_triangle;
    path.hit.depth = 0;
    work.next[work.next_count++] = g.place[j];
  }
}

// From a surface.
VITRAIL_LANES void go_on(LaneWork& work, const Group& g, const Carried& carried, const Interaction<D>& at,
                         Mask<F> on, Vector<D> direction, const Four<F>& throughput, F pdf,
                         Mask<F> connected) {
  const Mask<D> front_side = dot(direction, at.geometric) > 0;
  go_on_from(
      work, g, carried, origin_of(work, at, direction), on, direction, throughput, pdf,
      connected, [&](CameraPath & path, int j) __attribute__((always_inline)) {
        if (work.scene.divides_space)
          path.inside =
              lane_by_lane::inside(work, path, {g.place[j], is_set(at.front, j), is_set(front_side, j)});
        path.ray.exclude = path.hit.triangle;
      });
}

// Those of `on` that chance lets live on after an event, brighter; it is asked of `played` alone.
VITRAIL_LANES Mask<F> survivors(const LaneWork& work, const Carried& carried, Mask<F> on, Mask<F> played,
                                F brightest, F u, Four<F>& throughput) {
  const F survival = to_floats(attainable(to_doubles(brightest * carried.brightness / work.roulette_worth)));
  const Mask<F> by_chance = played & (survival < 1);
  const F scale = select<F>(by_chance, 1.0f / survival, fill<F>(1));
  for (int i = 0; i < 4; ++i) throughput[i] = throughput[i] * scale;
  return on & (no(by_chance) | (u < survival));
}
