// SPDX-License-Identifier: Apache-2.0
// Part of lane_stages.inl: connections to lights.
#include "tracer/transport/waves/lane_lights.inl"

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

// Where W connections leave.
struct Leaving {
  Vector<D> p;
  Vector<F> origin;  // beside it
  std::uint32_t exclude[W];
  std::uint8_t inside[W];
};

VITRAIL_LANES lane_by_lane::Leaving leaving_of(const Leaving& from, int j) {
  return {point_of(from.p, j),
          {lane(from.origin.x, j), lane(from.origin.y, j), lane(from.origin.z, j)},
          from.exclude[j],
          from.inside[j]};
}

// Of `on`, those that are sent alone, by whatever ray it takes: through panes, without a shadow, to quadrics.
VITRAIL_LANES Mask<D> send_alone(LaneWork& work, const Group& g, const Leaving& from, Mask<D> on,
                                 const Candidate& chosen, const Four<F>& radiance) {
  const PointEmitter* const emitters = work.tracing.scene.lights.emitters.data();
  Mask<D> alone{};
  for (int j = 0; j < W; ++j) {
    const LightRef light = chosen.ref[j];
    bool is_alone = work.scene.passes_light && chosen.quadric[j];
    if (light.kind == LightKind::emitter)
      is_alone |= !emitters[light.index].casts_shadows || emitters[light.index].fading;
    if (light.kind == LightKind::distant) is_alone |= work.scene.has_walks;
    if (!is_alone || !is_set(on, j)) continue;
    set_mask(alone, j, true);
    if (j >= g.valid) continue;
    ++work.rays_shadow;
    lane_by_lane::send(work, *g.path[j], leaving_of(from, j), light_of(chosen, j), lane(radiance, j));
  }
  return alone;
}

// Where light passes something, straight to lights but quadrics.
VITRAIL_LANES void send_connections(LaneWork& work, const Group& g, const Carried& carried,
                                    const Leaving& from, Mask<D> on, const Candidate& chosen,
                                    const Four<F>& radiance) {
  const L seed = gather<L>(VITRAIL_EACH(g.path[j]->seed));
  const L stream =
      (convert<std::uint64_t>(carried.depth) << 3 | static_cast<std::uint64_t>(RayRandom::throughput)) *
      stream_factor;
  const Departed<D> ray = depart<D>(seed, stream, from.origin, chosen.light.to_light, radiance);
  const Aimed<D> aimed = aim(from.p, from.origin, chosen.light);
  const L random = hash_of_ray<L>(seed, from.origin, aimed.code);
  const D slope = lanes::sqrt(lanes::max(fill<D>(0), 1.0 - aimed.cosine * aimed.cosine)) / abs(aimed.cosine);
  for (int j = 0; j < g.valid; ++j) {
    if (!is_set(on, j)) continue;
    ++work.rays_shadow;
    const std::uint32_t first = lane(aimed.code.first, j), second = lane(aimed.code.second, j);
    lane_by_lane::StraightConnection way{leaving_of(from, j), lane(aimed.direction, j), {},
                                         lane(random, j),     lane(aimed.end, j),       lane(slope, j),
                                         chosen.ref[j]};
    for (int i = 0; i < 3; ++i) {
      way.code.byte[i] = static_cast<std::uint8_t>(first >> 8 * i);
      way.code.byte[3 + i] = static_cast<std::uint8_t>(second >> 8 * i);
    }
    lane_by_lane::begin_connection(work, *g.path[j], way, lane(ray.throughput, j));
  }
}

// But at quadrics that are no whole spheres.
VITRAIL_LANES Aimed<D> aim_at(const Group& g, const Interaction<D>& at, Vector<F> origin, Mask<D> on,
                              const Candidate& chosen, const PlacedQuadric& no_sphere) {
  const Mask<D> sphere = on & gather_mask<D>(VITRAIL_EACH(chosen.sphere[j] != nullptr));
  if (!any(sphere)) return aim(at.p, origin, chosen.light);
  Connected<D> light = chosen.light;
  light.normal = select<D>(sphere, fill<D>(Vector3d{}), light.normal);
  Aimed<D> aimed = aim(at.p, origin, light, sphere);
  aimed.end =
      select<D>(sphere,
                end_on_sphere(
                    origin, aimed,
                    [&](int j) __attribute__((always_inline))->const PlacedQuadric& {
                      return is_set(sphere, j) ? *chosen.sphere[j] : no_sphere;
                    },
                    gather_mask<D>(VITRAIL_EACH(is_set(sphere, j) &&
                                                g.path[j]->hit.triangle == chosen.quadric[j]->triangle))),
                aimed.end);
  return aimed;
}

VITRAIL_LANES void send_shadow_rays(LaneWork& work, const Group& g, const Interaction<D>& at, Mask<D> on,
                                    const Candidate& chosen, Four<F> radiance) {
  const Vector<F> origin = origin_of(work, at, chosen.light.to_light);
  const Aimed<D> aimed = aim_at(g, at, origin, on, chosen, work.scene.no_sphere);
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
    if (work.groups_lights) shadow.light_group = lane_by_lane::group_of(work, chosen.ref[j]);
    shadow.time_s = path.time_s;
    shadow.sensor = &path.film.sensor;
    if (!chosen.quadric[j] || chosen.sphere[j]) continue;
    lane_by_lane::aim(path, point_of(at.p, j), shadow.ray.origin, light_of(chosen, j), shadow);
  }
}

template <class Bsdf>
VITRAIL_LANES BsdfValue<D> eval_towards(const LaneWork&, const Candidate&, const Bsdf& bsdf, Vector<D> out,
                                        Vector<D> in) {
  return eval(bsdf, out, in);
}
// Lamps without shadows make no highlights.
VITRAIL_LANES BsdfValue<D> eval_towards(const LaneWork& work, const Candidate& c, Finish<D> bsdf,
                                        Vector<D> out, Vector<D> in) {
  const PointEmitter* const emitters = work.tracing.scene.lights.emitters.data();
  const Mask<D> shadowless =
      gather_mask<D>(VITRAIL_EACH(is_set(c.arrives, j) && c.ref[j].kind == LightKind::emitter &&
                                  !emitters[c.ref[j].index].casts_shadows));
  bsdf.phong = select<D>(shadowless, fill<D>(0), bsdf.phong);
  bsdf.specular = select<D>(shadowless, fill<D>(0), bsdf.specular);
  return eval(bsdf, out, in);
}

// As connect.cpp has it: of `count` candidates for a light one, with what it brings. scatter(candidate,
// is_way) gives what is scattered from there, and where that is a way of light. Those that bring something.
template <class Scatter>
VITRAIL_LANES Mask<D> choose_light(const LaneWork& work, const Group& g, const Carried& carried, Vector<D> p,
                                   const Scatter& scatter, Mask<D> on, std::uint32_t count, Candidate& best,
                                   Four<F>& radiance) {
  const Four<F> u = numbers_of(work, g, carried, 2u + 2u * carried.depth, RayRandom::light);
  D choice = to_doubles(gather<F>(VITRAIL_EACH(g.path[j]->film.camera.data()[3])));
  D all = fill<D>(0), chosen = fill<D>(0);
  TreeRoot root;
  for (std::uint32_t k = 0; k < count; ++k) {
    const Candidate c = candidate_of(work, g, p, k > 0 ? numbers_of_candidate(u, k) : u, on, root);
    Mask<D> is_way;
    const BsdfValue<D> scattered = scatter(c, is_way);
    const D beside =
        select<D>(c.is_delta, fill<D>(0), to_doubles(lanes::density_beside(scattered.pdf, count)));
    const F weight = to_floats(lanes::power_heuristic(c.pdf, beside) / c.pdf);
    Four<F> brought;
    D target = fill<D>(0);
    for (int i = 0; i < 4; ++i) {
      brought[i] = carried.throughput[i] * scattered.value[i] * c.radiance[i] * weight;
      target = target + to_doubles(brought[i]);
    }
    const Mask<D> brings = on & c.arrives & is_way & (target > 0);
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
      if (is_set(takes, j))
        best.quadric[j] = c.quadric[j], best.sphere[j] = c.sphere[j], best.ref[j] = c.ref[j];
  }
  if (count > 1) {
    const F mean = to_floats(all / (static_cast<double>(count) * chosen));
    for (int i = 0; i < 4; ++i) radiance[i] = radiance[i] * mean;
  }
  return all != 0;
}

template <class Bsdf>
VITRAIL_LANES void connect(LaneWork& work, const Group& g, const Carried& carried, const Interaction<D>& at,
                           const Bsdf& bsdf, const Frame<D>& frame, Vector<D> out, Mask<D> on,
                           Mask<D> transmits, std::uint32_t count) {
  Candidate best{};
  Four<F> radiance{};
  const auto scatter = [&](const Candidate& c, Mask<D>& is_way) __attribute__((always_inline)) {
    const Vector<D> in = frame.to_local(c.light.to_light);
    // Shading normals let no light leak.
    is_way = transmits | ((dot(c.light.to_light, at.geometric) > 0) == (at.cosine * out.z * in.z > 0));
    return eval_towards(work, c, bsdf, out, in);
  };
  const Mask<D> chosen = choose_light(work, g, carried, at.p, scatter, on, count, best, radiance);
  if (!any(chosen)) return;
  if (!work.scene.has_connections) return send_shadow_rays(work, g, at, chosen, best, radiance);
  Leaving from{at.p, origin_of(work, at, best.light.to_light)};
  const Mask<D> front_side = dot(best.light.to_light, at.geometric) > 0;
  for (int j = 0; j < W; ++j) {
    from.exclude[j] = g.path[j]->hit.triangle;
    from.inside[j] =
        lane_by_lane::inside(work, *g.path[j], {g.place[j], is_set(at.front, j), is_set(front_side, j)});
  }
  const Mask<D> rest = chosen & no(send_alone(work, g, from, chosen, best, radiance));
  if (work.scene.passes_light)
    send_connections(work, g, carried, from, rest, best, radiance);
  else
    send_shadow_rays(work, g, at, rest, best, radiance);
}

// From points of media, whose phase functions are those of g.
VITRAIL_LANES void connect_in_media(LaneWork& work, const Group& group, const Carried& carried, Vector<D> p,
                                    D g, Vector<D> out, std::uint32_t count) {
  Candidate best{};
  Four<F> radiance{};
  const auto scatter = [&](const Candidate& c, Mask<D>& is_way) __attribute__((always_inline)) {
    is_way = c.arrives;
    BsdfValue<D> f;
    f.pdf = phase(g, out, c.light.to_light);
    for (int i = 0; i < 4; ++i) f.value[i] = to_floats(f.pdf);
    return f;
  };
  const Mask<D> every = p.x == p.x;
  const Mask<D> chosen = choose_light(work, group, carried, p, scatter, every, count, best, radiance);
  Leaving from{p, to_floats(p)};
  for (int j = 0; j < W; ++j) from.exclude[j] = no_triangle, from.inside[j] = group.path[j]->inside;
  const Mask<D> rest = chosen & no(send_alone(work, group, from, chosen, best, radiance));
  send_connections(work, group, carried, from, rest, best, radiance);
}
