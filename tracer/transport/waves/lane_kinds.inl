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

// Reflectances of those whose surface has an image; other lanes keep what they have. Not inlined into what
// has no images.
[[gnu::noinline]] void look_up_images(const Group& g, D u, D v, Four<F>& reflectance) {
  unsigned left = bits(gather_mask<D>(VITRAIL_EACH(g.material[j]->texture.image != nullptr)));
  while (left != 0) {
    const LaneTexture& of = g.material[__builtin_ctz(left)]->texture;
    const Mask<D> those = gather_mask<D>(
        VITRAIL_EACH(g.material[j]->texture.image != nullptr && g.material[j]->texture.id == of.id));
    const auto d = [](float x) __attribute__((always_inline)) { return static_cast<double>(x); };
    const UvMapping& m = of.mapping;
    const Four<F> found = bilinear<D>(
        *of.image, u * d(m.a) + v * d(m.b) + d(m.c), u * d(m.d) + v * d(m.e) + d(m.f), of.wrap, 0,
        bits(those), [&](int j) __attribute__((always_inline))->const SampledWavelengths& {
          return g.path[j]->wavelengths;
        });
    for (int i = 0; i < 4; ++i)
      reflectance[i] = select<F>(mask_for<F>(those), lanes::max(found[i], fill<F>(0)), reflectance[i]);
    left &= ~bits(those);
  }
}

struct ReadLambert {
  static constexpr bool is_specular = false;
  static constexpr bool takes_any_normal = true;
  VITRAIL_LANES static Lambert<D> read(const LaneWork& work, const Group& g, const Interaction<D>& at) {
    Lambert<D> bsdf;
    const D c0 = to_doubles(gather<F>(VITRAIL_EACH(g.material[j]->sigmoid.c0))),
            c1 = to_doubles(gather<F>(VITRAIL_EACH(g.material[j]->sigmoid.c1))),
            c2 = to_doubles(gather<F>(VITRAIL_EACH(g.material[j]->sigmoid.c2)));
    for (int i = 0; i < 4; ++i)
      bsdf.reflectance[i] = sigmoid(c0, c1, c2, gather<F>(VITRAIL_EACH(g.path[j]->wavelengths.lambda_nm[i])));
    const F constant = gather<F>(VITRAIL_EACH(g.material[j]->constant));
    for (int i = 0; i < 4; ++i) bsdf.reflectance[i] = select<F>(constant >= 0, constant, bsdf.reflectance[i]);
    for (int j = 0; j < W; ++j)
      if (g.material[j]->has_parameters)
        for (int i = 0; i < 4; ++i) set_lane(bsdf.reflectance[i], j, work.bsdfs[g.place[j]].a.v[i]);
    if (work.scene.has_textures) look_up_images(g, at.u, at.v, bsdf.reflectance);
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
  static constexpr bool takes_any_normal = false;
  VITRAIL_LANES static Conductor<D> read(const LaneWork& work, const Group& g, const Interaction<D>&) {
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
  static constexpr bool takes_any_normal = false;
  VITRAIL_LANES static SmoothConductor read(const LaneWork& work, const Group& g, const Interaction<D>&) {
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
  static constexpr bool takes_any_normal = false;
  VITRAIL_LANES static Plastic<D> read(const LaneWork& work, const Group& g, const Interaction<D>&) {
    return plastic_of(work, g);
  }
};
struct ReadRoughPlastic {
  static constexpr bool is_specular = false;
  static constexpr bool takes_any_normal = false;
  VITRAIL_LANES static auto read(const LaneWork& work, const Group& g, const Interaction<D>&) {
    const auto table = [&](int j) __attribute__((always_inline)) {
      return work.bsdfs[g.place[j]].external_transmittance;
    };
    return RoughPlastic<D, decltype(table)>{plastic_of(work, g), microfacets_of(work, g), table};
  }
};

struct ReadPrincipled {
  static constexpr bool is_specular = false;
  static constexpr bool takes_any_normal = false;
  VITRAIL_LANES static Principled<D> read(const LaneWork& work, const Group& g, const Interaction<D>&) {
    const auto number = [&](double PrincipledBsdf::*of) __attribute__((always_inline)) {
      return gather<D>(VITRAIL_EACH(work.bsdfs[g.place[j]].principled.*of));
    };
    using B = PrincipledBsdf;
    return {.base_color = spectrum_of(work, g, &LaneBsdf::a),
            .luminance = number(&B::luminance),
            .eta = number(&B::eta),
            .roughness = number(&B::roughness),
            .metallic = number(&B::metallic),
            .spec_trans = fill<D>(0),
            .spec_tint = number(&B::spec_tint),
            .sheen = number(&B::sheen),
            .sheen_tint = number(&B::sheen_tint),
            .flatness = number(&B::flatness),
            .clearcoat = number(&B::clearcoat),
            .clearcoat_gloss = number(&B::clearcoat_gloss),
            .microfacets = microfacets_of(work, g)};
  }
};

struct ReadFinish {
  static constexpr bool is_specular = false;
  static constexpr bool takes_any_normal = true;
  VITRAIL_LANES static Finish<D> read(const LaneWork& work, const Group& g, const Interaction<D>&) {
    const auto number = [&](double FinishBsdf::*of) __attribute__((always_inline)) {
      return gather<D>(VITRAIL_EACH(work.bsdfs[g.place[j]].finish.*of));
    };
    using B = FinishBsdf;
    return {spectrum_of(work, g, &LaneBsdf::a),
            spectrum_of(work, g, &LaneBsdf::b),
            number(&B::brilliance),
            number(&B::phong),
            number(&B::phong_size),
            number(&B::specular),
            number(&B::roughness)};
  }
};
