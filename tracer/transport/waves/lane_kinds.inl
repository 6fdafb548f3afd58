// SPDX-License-Identifier: Apache-2.0
// Part of lane_stages.inl: how each kind reads its parameters. `eval` and `sample` are those of
// tracer/bsdf/*_lanes.h.

VITRAIL_LANES Four<F> spectrum_of(const LaneWork& work, const Group& g,
                                  SampledSpectrum LaneBsdf::*parameter) {
  Four<F> s;
  for (int i = 0; i < 4; ++i) s[i] = gather<F>(VITRAIL_EACH((work.bsdfs[g.place[j]].*parameter).v[i]));
  return s;
}

VITRAIL_LANES BsdfSample<D> sample(const Lambert<D>& bsdf, Vector<D> out, F, F u_x, F u_y) {
  return sample(bsdf, out, u_x, u_y);
}
VITRAIL_LANES BsdfSample<D> sample(const Conductor<D>& bsdf, Vector<D> out, F, F u_x, F u_y) {
  return sample(bsdf, out, u_x, u_y);
}

struct ReadLambert {
  static constexpr bool is_specular = false;
  VITRAIL_LANES static Lambert<D> read(const LaneWork& work, const Group& g) {
    Lambert<D> bsdf;
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
