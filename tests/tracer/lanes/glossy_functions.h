// SPDX-License-Identifier: Apache-2.0
// Functions in lanes of microfacets and what is made of them.
#pragma once

#include "tests/tracer/lanes/context.h"
#include "tests/tracer/lanes/lane_table.h"
#include "tracer/bsdf/coating_lanes.h"
#include "tracer/bsdf/conductor_lanes.h"
#include "tracer/bsdf/dielectric_lanes.h"
#include "tracer/bsdf/finish_lanes.h"
#include "tracer/bsdf/layer_random_lanes.h"
#include "tracer/bsdf/plastic_lanes.h"
#include "tracer/bsdf/principled_lanes.h"
#include "tracer/bsdf/principled_lobes.h"
#include "tracer/media/phase_lanes.h"

namespace vitrail::lane_tests {
namespace {

// in[k …]: both widths, Beckmann's or not, separable or not.
template <int W>
VITRAIL_LANES lanes::Microfacets<lanes::Doubles<W>> microfacets_of(const In<W>& in, int k) {
  return {in.d(k), in.d(k + 1), in.d(k + 2) > 0, in.d(k + 3) > 0};
}
template <int W>
VITRAIL_LANES lanes::Four<lanes::Floats<W>> four_of(const In<W>& in, int k) {
  return {{in.f(k), in.f(k + 1), in.f(k + 2), in.f(k + 3)}};
}
template <int W, class D>
VITRAIL_LANES void put_sample(const lanes::BsdfSample<D>& s, Out<W>& out) {
  const lanes::Mask<lanes::Floats<W>> narrow = lanes::mask_for<lanes::Floats<W>>(s.scatters);
  const auto kept = [&](D x) { return lanes::select<D>(s.scatters, x, lanes::fill<D>(0)); };
  out.mask(s.scatters), out.mask(s.scatters & s.specular);
  out.number(kept(s.in.x)), out.number(kept(s.in.y)), out.number(kept(s.in.z)), out.number(kept(s.pdf));
  for (int i = 0; i < 4; ++i)
    out.number(lanes::select<lanes::Floats<W>>(narrow, s.weight[i], lanes::fill<lanes::Floats<W>>(0)));
}

LANE_FUNCTION(quick_math, 3, 6) {
  out.number(lanes::quick_exp(in.d(0))), out.number(lanes::quick_log(in.d(1)));
  out.number(lanes::quick_erf(in.d(1), in.d(2)));
  const auto circle = lanes::quick_circle(in.d(2));
  out.number(circle.cosine), out.number(circle.sine);
  out.number(lanes::inverse_erf<lanes::Doubles<W>>(2.0 * in.d(2) - 1.0));
}
LANE_FUNCTION(microfacets, 12, 8) {
  const auto mf = microfacets_of(in, 0);
  const auto a = in.vector(4), b = in.vector(7);
  const auto area = lanes::visible_area(mf, a);
  out.number(lanes::normal_density(mf, b)), out.number(area), out.number(lanes::visible_area(mf, b));
  out.number(lanes::shadowing_over_cosines(mf, a, area, b));
  const auto m = lanes::sample_visible_normal(mf, a, in.f(10), in.f(11));
  out.vector(m), out.number(lanes::normal_density(mf, m));
}
// The asymmetry of a medium, two directions.
LANE_FUNCTION(phase, 7, 1) { out.number(lanes::phase(in.d(0), in.vector(1), in.vector(4))); }
// Widths and kinds, four of eta, of k, of the factor, perfect or not, two directions, two numbers.
LANE_FUNCTION(conductor, 25, 25) {
  const lanes::Conductor<lanes::Doubles<W>> bsdf{microfacets_of(in, 0), four_of(in, 4), four_of(in, 8),
                                                 four_of(in, 12), in.d(16) > 0};
  const auto f = lanes::eval(bsdf, in.vector(17), in.vector(20));
  out.four(f.value), out.number(f.pdf);
  put_sample(lanes::sample(bsdf, in.vector(17), in.f(23), in.f(24)), out);
  put_sample(lanes::sample_mirror(bsdf, in.vector(17)), out);
}
// Two words of an event, a number that it is about, whether it is asked, asymmetry, a direction, depth, two
// numbers.
LANE_FUNCTION(layer_random, 11, 12) {
  using D = lanes::Doubles<W>;
  lanes::WalkRandom<D> random(in.l(0), 3);
  random << in.d(2);
  const lanes::Mask<D> on = in.d(3) > 0;
  const auto pair = random.uniform_pair(on);
  out.number(pair.x), out.number(pair.y);
  out.number(random.uniform(on)), out.number(random.uniform(on | lanes::no(on)));
  const auto next = lanes::sample_henyey_greenstein<D>(in.d(4), in.vector(5), in.f(9), in.f(10));
  out.vector(next), out.number(lanes::henyey_greenstein<D>(in.d(4), lanes::dot(in.vector(5), next)));
  out.number(lanes::slab_transmittance<D>(in.d(8), in.vector(5)));
  out.number(lanes::sin_pi<D>(in.d(8))), out.number(lanes::sin_pi<D>(in.d(8) + 0.5));
  out.number(lanes::portable_log<D>(1.0 - in.d(9)));
}
// Widths and kinds, index, smooth or not, two directions, three numbers.
LANE_FUNCTION(coating, 15, 22) {
  using D = lanes::Doubles<W>;
  const lanes::Coating<D> coating{in.d(4), microfacets_of(in, 0), in.d(5) > 0};
  const auto from = in.vector(6), to = in.vector(9);
  out.number(lanes::coating_reflection(coating, from, to));
  out.number(lanes::coating_transmission(coating, from, to));
  out.number(lanes::coating_reflected_pdf(coating, from, to));
  out.number(lanes::coating_transmitted_pdf(coating, from, to));
  const auto put = [&](const lanes::CoatingSample<D>& s) {
    const auto kept = [&](D x) { return lanes::select<D>(s.found, x, lanes::fill<D>(0)); };
    out.mask(s.found), out.vector(lanes::Vector<D>{kept(s.in.x), kept(s.in.y), kept(s.in.z)});
    out.number(kept(s.weight)), out.number(kept(s.pdf));
  };
  put(lanes::sample_coating_reflection(coating, from, in.f(13), in.f(14)));
  put(lanes::sample_coating_transmission(coating, from, in.f(13), in.f(14)));
  put(lanes::sample_coating(coating, from, in.d(12), in.f(13), in.f(14)));
}
// A cosine, an index.
LANE_FUNCTION(sheet, 3, 1) { out.number(lanes::sheet_reflectance(in.d(0), in.d(1), in.d(2))); }
// Widths and kinds, four of each factor, index, two directions, three numbers.
LANE_FUNCTION(rough_dielectric, 22, 15) {
  const lanes::RoughDielectric<lanes::Doubles<W>> bsdf{in.d(12), microfacets_of(in, 0), four_of(in, 4),
                                                       four_of(in, 8)};
  const auto f = lanes::eval(bsdf, in.vector(13), in.vector(16));
  out.four(f.value), out.number(f.pdf);
  put_sample(lanes::sample(bsdf, in.vector(13), in.f(19), in.f(20), in.f(21)), out);
}
// Widths and kinds, diffuse and specular reflectances, index, inside reflectance, nonlinear or not, a table,
// two directions, three numbers.
LANE_FUNCTION(plastic, 25, 30) {
  using D = lanes::Doubles<W>;
  const lanes::Plastic<D> smooth{four_of(in, 4), four_of(in, 8), in.d(12), in.d(13), in.d(14) > 0};
  const auto table = [&](int j) { return context.tables[static_cast<int>(lanes::lane(in.d(15), j))]; };
  const lanes::RoughPlastic<D, decltype(table)> rough{smooth, microfacets_of(in, 0), table};
  const auto put = [&](const auto& bsdf) {
    const auto f = lanes::eval(bsdf, in.vector(16), in.vector(19));
    out.four(f.value), out.number(f.pdf);
    put_sample(lanes::sample(bsdf, in.vector(16), in.f(22), in.f(23), in.f(24)), out);
  };
  put(smooth), put(rough);
}
// The base colour, its luminance, eta, the other numbers, two directions, three numbers, whether it is below.
LANE_FUNCTION(principled, 26, 15) {
  using D = lanes::Doubles<W>;
  const D roughness = in.d(6), anisotropic = in.d(15);
  const lanes::Principled<D> bsdf{.base_color = four_of(in, 0),
                                  .luminance = in.d(4),
                                  .eta = in.d(5),
                                  .roughness = roughness,
                                  .metallic = in.d(7),
                                  .spec_trans = in.d(8),
                                  .spec_tint = in.d(9),
                                  .sheen = in.d(10),
                                  .sheen_tint = in.d(11),
                                  .flatness = in.d(12),
                                  .clearcoat = in.d(13),
                                  .clearcoat_gloss = in.d(14),
                                  .below = in.d(25) != 0,
                                  .microfacets = lanes::gather_microfacets<D>([&](int j) {
                                    return vitrail::principled::microfacets(lanes::lane(roughness, j),
                                                                            lanes::lane(anisotropic, j));
                                  })};
  const auto f = lanes::eval(bsdf, in.vector(16), in.vector(19));
  out.four(f.value), out.number(f.pdf);
  put_sample(lanes::sample(bsdf, in.vector(16), in.f(22), in.f(23), in.f(24)), out);
}
// Reflectance, highlight, five numbers, two directions, three numbers.
LANE_FUNCTION(finish, 22, 15) {
  const lanes::Finish<lanes::Doubles<W>> bsdf{four_of(in, 0), four_of(in, 4), in.d(8), in.d(9),
                                              in.d(10),       in.d(11),       in.d(12)};
  const auto f = lanes::eval(bsdf, in.vector(13), in.vector(16));
  out.four(f.value), out.number(f.pdf);
  put_sample(lanes::sample(bsdf, in.vector(13), in.f(19), in.f(20), in.f(21)), out);
}

}  // namespace
}  // namespace vitrail::lane_tests
