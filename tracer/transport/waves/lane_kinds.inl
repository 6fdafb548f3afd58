// SPDX-License-Identifier: Apache-2.0
// Part of lane_stages.inl: how each kind reads its parameters. `eval` and `sample` are those of
// tracer/bsdf/*_lanes.h.

// The spectrum `k` of a LaneBsdf.
VITRAIL_LANES Four<F> spectrum_of(const Group& g, int k) {
  const Mask<D> constant = gather_mask<D>(VITRAIL_EACH(!g.material[j]->has_parameters));
  Four<F> s{};
  if (!all(constant))
    for (int i = 0; i < 4; ++i) s[i] = gather<F>(VITRAIL_EACH(g.bsdf[j]->spectra[k].v[i]));
  if (!any(constant)) return s;
  const Four<F> values = values_of(
      g, [&](int j) __attribute__((always_inline))->const FlatSpectrum& {
        return g.material[j]->spectra[k];
      });
  for (int i = 0; i < 4; ++i) s[i] = select<F>(mask_for<F>(constant), values[i], s[i]);
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
  static constexpr bool may_transmit = false;
  static constexpr bool takes_any_normal = true;
  VITRAIL_LANES static Lambert<D> read(const LaneWork& work, const Group& g, const Interaction<D>& at) {
    Lambert<D> bsdf{spectrum_of(g, 0)};
    if (work.scene.has_textures) look_up_images(g, at.u, at.v, bsdf.reflectance);
    return bsdf;
  }
};

VITRAIL_LANES Microfacets<D> microfacets_of(const Group& g) {
  return gather_microfacets<D>([&](int j) __attribute__((always_inline))->const vitrail::Microfacets& {
    return g.bsdf[j]->microfacets;
  });
}

VITRAIL_LANES Conductor<D> conductor_of(const Group& g) {
  return {microfacets_of(g), spectrum_of(g, 0), spectrum_of(g, 1), spectrum_of(g, 2),
          gather_mask<D>(VITRAIL_EACH(g.bsdf[j]->is_perfect))};
}
struct ReadMetal {
  static constexpr bool is_specular = false;
  static constexpr bool may_transmit = false;
  static constexpr bool takes_any_normal = false;
  VITRAIL_LANES static Conductor<D> read(const LaneWork&, const Group& g, const Interaction<D>&) {
    return conductor_of(g);
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
  static constexpr bool may_transmit = false;
  static constexpr bool takes_any_normal = false;
  VITRAIL_LANES static SmoothConductor read(const LaneWork&, const Group& g, const Interaction<D>&) {
    return {conductor_of(g)};
  }
};

VITRAIL_LANES Plastic<D> plastic_of(const Group& g) {
  return {spectrum_of(g, 0), spectrum_of(g, 1), gather<D>(VITRAIL_EACH(g.bsdf[j]->eta)),
          gather<D>(VITRAIL_EACH(g.bsdf[j]->internal_reflectance)),
          gather_mask<D>(VITRAIL_EACH(g.bsdf[j]->is_nonlinear))};
}
struct ReadPlastic {
  static constexpr bool is_specular = false;
  static constexpr bool may_transmit = false;
  static constexpr bool takes_any_normal = false;
  VITRAIL_LANES static Plastic<D> read(const LaneWork&, const Group& g, const Interaction<D>&) {
    return plastic_of(g);
  }
};
struct ReadRoughPlastic {
  static constexpr bool is_specular = false;
  static constexpr bool may_transmit = false;
  static constexpr bool takes_any_normal = false;
  VITRAIL_LANES static auto read(const LaneWork&, const Group& g, const Interaction<D>&) {
    const auto table = [&](int j) __attribute__((always_inline)) {
      return g.bsdf[j]->external_transmittance;
    };
    return RoughPlastic<D, decltype(table)>{plastic_of(g), microfacets_of(g), table};
  }
};

struct ReadPrincipled {
  static constexpr bool is_specular = false;
  static constexpr bool may_transmit = true;
  static constexpr bool takes_any_normal = false;
  VITRAIL_LANES static Principled<D> read(const LaneWork&, const Group& g, const Interaction<D>&) {
    const auto number = [&](double PrincipledBsdf::*of) __attribute__((always_inline)) {
      return gather<D>(VITRAIL_EACH(g.bsdf[j]->principled.*of));
    };
    using B = PrincipledBsdf;
    return {.base_color = spectrum_of(g, 0),
            .luminance = number(&B::luminance),
            .eta = number(&B::eta),
            .roughness = number(&B::roughness),
            .metallic = number(&B::metallic),
            .spec_trans = number(&B::spec_trans),
            .spec_tint = number(&B::spec_tint),
            .sheen = number(&B::sheen),
            .sheen_tint = number(&B::sheen_tint),
            .flatness = number(&B::flatness),
            .clearcoat = number(&B::clearcoat),
            .clearcoat_gloss = number(&B::clearcoat_gloss),
            .below = gather_mask<D>(VITRAIL_EACH(g.bsdf[j]->principled.below)),
            .microfacets = microfacets_of(g)};
  }
};

struct ReadFinish {
  static constexpr bool is_specular = false;
  static constexpr bool may_transmit = false;
  static constexpr bool takes_any_normal = true;
  VITRAIL_LANES static Finish<D> read(const LaneWork&, const Group& g, const Interaction<D>&) {
    const auto number = [&](double FinishBsdf::*of) __attribute__((always_inline)) {
      return gather<D>(VITRAIL_EACH(g.bsdf[j]->finish.*of));
    };
    using B = FinishBsdf;
    return {spectrum_of(g, 0),      spectrum_of(g, 1),    number(&B::brilliance), number(&B::phong),
            number(&B::phong_size), number(&B::specular), number(&B::roughness)};
  }
};

// Widths of 1 for those that are smooth, whose facets nobody asks for: no loop waits for a 0.
VITRAIL_LANES Microfacets<D> rough_alone(Microfacets<D> mf, Mask<D> smooth) {
  mf.alpha_u = select<D>(smooth, fill<D>(1), mf.alpha_u);
  mf.alpha_v = select<D>(smooth, fill<D>(1), mf.alpha_v);
  return mf;
}
template <class Base>
VITRAIL_LANES Layer<D, Base> layer_over(const Base& base, const LaneWork& work, const Group& g) {
  const auto of = [&](int j) __attribute__((always_inline))->const LaneCoating& {
    return work.coatings[g.place[j]];
  };
  Layer<D, Base> layer{base};
  layer.coating.eta = gather<D>(VITRAIL_EACH(of(j).eta));
  const Microfacets<D> facets =
      gather_microfacets<D>([&](int j) __attribute__((always_inline))->const vitrail::Microfacets& {
        return of(j).interface;
      });
  layer.coating.smooth = (facets.alpha_u == 0) & (facets.alpha_v == 0);
  layer.coating.smooth = layer.coating.smooth | (layer.coating.eta == 1);
  layer.coating.facets = rough_alone(facets, layer.coating.smooth);
  layer.volume.thickness = gather<D>(VITRAIL_EACH(of(j).volume.thickness));
  layer.volume.g = gather<D>(VITRAIL_EACH(of(j).volume.g));
  for (int i = 0; i < 4; ++i)
    layer.volume.albedo[i] = gather<F>(VITRAIL_EACH(of(j).volume.albedo.v.data()[i]));
  layer.volume.max_depth = gather<D>(VITRAIL_EACH(of(j).volume.max_depth));
  layer.volume.samples = gather<D>(VITRAIL_EACH(of(j).volume.samples));
  layer.volume.balanced = gather_mask<D>(VITRAIL_EACH(of(j).volume.balanced));
  layer.event = gather<L>(VITRAIL_EACH(of(j).event));
  return layer;
}
struct ReadCoatedDiffuse {
  static constexpr bool is_specular = false;
  static constexpr bool may_transmit = false;
  static constexpr bool takes_any_normal = false;
  VITRAIL_LANES static CoatedDiffuse<D> read(const LaneWork& work, const Group& g, const Interaction<D>&) {
    return layer_over(LambertBase<D>{spectrum_of(g, 0)}, work, g);
  }
};
struct ReadCoatedConductor {
  static constexpr bool is_specular = false;
  static constexpr bool may_transmit = false;
  static constexpr bool takes_any_normal = false;
  VITRAIL_LANES static CoatedConductor<D> read(const LaneWork& work, const Group& g, const Interaction<D>&) {
    const Microfacets<D> facets = microfacets_of(g);
    const Mask<D> smooth = (facets.alpha_u == 0) & (facets.alpha_v == 0);
    CoatedConductor<D> layer = layer_over(ConductorBase<D>{}, work, g);
    layer.base = {spectrum_of(g, 0), spectrum_of(g, 1), layer.coating.eta, rough_alone(facets, smooth),
                  smooth};
    return layer;
  }
};

struct ReadRoughGlass {
  static constexpr bool is_specular = false;
  static constexpr bool may_transmit = true;
  static constexpr bool takes_any_normal = false;
  VITRAIL_LANES static RoughDielectric<D> read(const LaneWork&, const Group& g, const Interaction<D>&) {
    return {gather<D>(VITRAIL_EACH(g.bsdf[j]->eta)), microfacets_of(g), spectrum_of(g, 0), spectrum_of(g, 1)};
  }
};
