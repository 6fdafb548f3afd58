// SPDX-License-Identifier: Apache-2.0
#include "tests/tracer/lanes/fixtures.h"
#include "tests/tracer/lanes/results.h"
#include "tests/tracer/lanes/scalar_functions.h"
#include "tracer/bsdf/coating_lanes.h"
#include "tracer/bsdf/conductor.h"
#include "tracer/bsdf/dielectric.h"
#include "tracer/bsdf/finish.h"
#include "tracer/bsdf/layer_random_lanes.h"
#include "tracer/bsdf/plastic.h"
#include "tracer/bsdf/principled.h"
#include "tracer/media/phase.h"
#include "tracer/simd/quick_math.h"

namespace vitrail::lane_tests {

namespace {

SampledSpectrum four_of(const double* in) {
  return {{static_cast<float>(in[0]), static_cast<float>(in[1]), static_cast<float>(in[2]),
           static_cast<float>(in[3])}};
}
Point2f numbers_of(const double* in) { return {static_cast<float>(in[0]), static_cast<float>(in[1])}; }

Microfacets microfacets_of(const double* in) {
  return {in[0], in[1], in[2] > 0 ? Roughness::Distribution::beckmann : Roughness::Distribution::ggx,
          in[3] > 0 ? Masking::separable : Masking::correlated};
}

void add(std::vector<Argument>& all, const std::vector<Argument>& more) {
  all.insert(all.end(), more.begin(), more.end());
}
std::vector<Argument> facets() {
  const Argument width = magnitude(-13, 3, {1e-4, 1e-3, 0.1, 0.5, 1});
  return {width, width, word(2), word(2)};
}
// Above the surface, but for some corners.
Argument upper_direction() {
  Argument up = direction();
  up.random = [any = up.random](Random& random, double* out) {
    any(random, out);
    out[2] = std::abs(out[2]);
  };
  return up;
}
Argument direction_above() {
  Argument above = upper_direction();
  std::erase_if(above.corners, [](const std::vector<double>& corner) { return !(corner[2] > 0); });
  return above;
}
std::vector<Argument> reflectances() { return std::vector<Argument>(4, float_number(0, 1, {0, 1, 0.5})); }

void put(const std::optional<BsdfSample>& s, Results& results) {
  const BsdfSample none{}, &x = s ? *s : none;
  results << s.has_value() << x.specular << x.in << x.pdf << x.weight.v;
}
void put(const BsdfValue& f, Results& results) { results << f.value.v << f.pdf; }

}  // namespace

std::vector<ScalarFunction> glossy_functions() {
  std::vector<Argument> microfacets = facets(), conductor = facets(), plastic = facets(),
                        principled = reflectances(), finish = reflectances(), dielectric = facets();
  add(microfacets, {direction_above(), direction(), unit_number(), unit_number()});
  std::vector<Argument> coating = facets();
  add(coating, {number(0.4, 2.5, {1, 1.5, 1 / 1.5}), word(2), direction(), direction(), unit_number(),
                unit_number(), unit_number()});
  add(conductor, std::vector<Argument>(4, float_number(0.05, 4, {0.2, 1})));
  add(conductor, std::vector<Argument>(4, float_number(0, 8, {0.5, 3})));
  add(conductor, reflectances());
  add(conductor, {word(2), upper_direction(), upper_direction(), unit_number(), unit_number()});
  add(plastic, reflectances());
  add(plastic, reflectances());
  add(plastic, {number(1.1, 2.5, {1.5, 1.0}), number(0, 0.9, {0, 0.6}), word(2), word(2), upper_direction(),
                upper_direction(), unit_number(), unit_number(), unit_number()});
  add(dielectric, reflectances());
  add(dielectric, reflectances());
  add(dielectric, {number(0.4, 2.5, {1.5, 1 / 1.5}), direction(), direction(), unit_number(), unit_number(),
                   unit_number()});
  const Argument amount = number(0, 1, {0, 1, 0.5});
  add(principled, {amount, number(0.4, 2.5, {1, 1.5})});
  add(principled, std::vector<Argument>(10, amount));
  add(principled, {direction(), direction(), unit_number(), unit_number(), unit_number(), word(2)});
  add(finish, reflectances());
  add(finish, {number(0.1, 3, {1, 2}), amount, number(1, 200, {40}), amount, magnitude(-10, 0, {0.05}),
               direction(), direction(), unit_number(), unit_number(), unit_number()});
  return {
      {"quick_math",
       {number(-720, 700, {-700, 0, -0.0, 1}), magnitude(-100, 100, {1, 0.5, 2, 0x1p-1022}), unit_number()},
       [](const Context&, const double* in, double* out) {
         const auto [cosine, sine] = lanes::quick_circle(in[2]);
         Results{out} << lanes::quick_exp(in[0]) << lanes::quick_log(in[1]) << lanes::quick_erf(in[1], in[2])
                      << cosine << sine << lanes::inverse_erf(2 * in[2] - 1);
       }},
      {"microfacets", microfacets,
       [](const Context&, const double* in, double* out) {
         const Microfacets mf = microfacets_of(in);
         const Vector3d a = vector_of(in + 4), b = vector_of(in + 7);
         const double area = visible_area(mf, a);
         const Vector3d m = sample_visible_normal(mf, a, numbers_of(in + 10));
         Results{out} << normal_density(mf, b) << area << visible_area(mf, b)
                      << shadowing_over_cosines(mf, a, area, b) << m << normal_density(mf, m);
       }},
      {"phase",
       {number(-0.9, 0.9, {0, 0.999, -0.999}), direction(), direction()},
       [](const Context&, const double* in, double* out) {
         Results{out} << phase(in[0], vector_of(in + 1), vector_of(in + 4));
       }},
      {"conductor", conductor,
       [](const Context&, const double* in, double* out) {
         ConductorBsdf bsdf{microfacets_of(in), four_of(in + 4), four_of(in + 8), four_of(in + 12),
                            in[16] > 0};
         const Vector3d from = vector_of(in + 17);
         Results results{out};
         put(eval(bsdf, from, vector_of(in + 20)), results);
         put(sample(bsdf, from, 0, numbers_of(in + 23)), results);
         bsdf.microfacets = {};
         put(sample(bsdf, from, 0, {}), results);
       }},
      {"layer_random",
       {long_word(), number(-1, 1, {0, -0.0, 1}), word(2), number(-0.99, 0.99, {0, 1e-3, -1e-3, 0.5}),
        direction(), number(0, 3, {0, 0.5, 1, 1.25, 2}), unit_number(), unit_number()},
       [](const Context&, const double* in, double* out) {
         lanes::WalkRandom<double> random(
             static_cast<std::uint64_t>(in[0]) | static_cast<std::uint64_t>(in[1]) << 32, 3);
         random << in[2];
         const auto [x, y] = random.uniform_pair(in[3] > 0);
         const double masked = random.uniform(in[3] > 0), all = random.uniform(true);
         const Vector3d w = vector_of(in + 5);
         const Point2f u = numbers_of(in + 9);
         const Vector3d next =
             lanes::lane(lanes::sample_henyey_greenstein<double>(in[4], lanes::fill<double>(w), u.x, u.y), 0);
         Results{out} << static_cast<double>(x) << static_cast<double>(y) << masked << all << next
                      << lanes::henyey_greenstein<double>(in[4], dot(w, next))
                      << lanes::slab_transmittance<double>(in[8], lanes::fill<double>(w)) << sin_pi(in[8])
                      << sin_pi(in[8] + 0.5) << portable_log(1 - in[9]);
       }},
      {"coating", coating,
       [](const Context&, const double* in, double* out) {
         const lanes::Coating<double> coated{in[4], lanes::fill(microfacets_of(in)), in[5] > 0};
         const auto from = lanes::fill<double>(vector_of(in + 6)),
                    to = lanes::fill<double>(vector_of(in + 9));
         Results results{out};
         results << lanes::coating_reflection(coated, from, to)
                 << lanes::coating_transmission(coated, from, to)
                 << lanes::coating_reflected_pdf(coated, from, to)
                 << lanes::coating_transmitted_pdf(coated, from, to);
         const auto put = [&](const lanes::CoatingSample<double>& s) {
           const double kept = s.found ? 1 : 0;
           results << kept;
           if (s.found)
             results << s.in << s.weight << s.pdf;
           else
             results << Vector3d{} << 0 << 0;
         };
         const Point2f u = numbers_of(in + 13);
         put(lanes::sample_coating_reflection(coated, from, u.x, u.y));
         put(lanes::sample_coating_transmission(coated, from, u.x, u.y));
         put(lanes::sample_coating(coated, from, in[12], u.x, u.y));
       }},
      {"rough_dielectric", dielectric,
       [](const Context&, const double* in, double* out) {
         const DielectricBsdf bsdf{in[12], microfacets_of(in), four_of(in + 4), four_of(in + 8)};
         const Vector3d from = vector_of(in + 13);
         Results results{out};
         put(eval(bsdf, from, vector_of(in + 16)), results);
         put(sample(bsdf, from, static_cast<float>(in[19]), numbers_of(in + 20)), results);
       }},
      {"sheet",
       {number(0, 1, {0, 1}), float_number(0.4, 2.5, {1, 1.5}), number(-1, 1, {-1, 0, 1})},
       [](const Context&, const double* in, double* out) {
         ThinDielectricBsdf bsdf;
         bsdf.eta = filled(static_cast<float>(in[1]));
         Results{out} << static_cast<double>(mirrored_share(bsdf, in[0], in[2])[0]);
       }},
      {"plastic", plastic,
       [](const Context&, const double* in, double* out) {
         const PlasticBsdf smooth{four_of(in + 4), four_of(in + 8), in[12], in[13], in[14] > 0};
         RoughPlasticTables tables;
         tables.internal_reflectance = in[13];
         std::copy_n(fixtures().tables[static_cast<std::size_t>(in[15])].begin(), RoughPlasticTables::count,
                     tables.external_transmittance.begin());
         const RoughPlasticBsdf rough{smooth.diffuse_reflectance,
                                      smooth.specular_reflectance,
                                      smooth.eta,
                                      microfacets_of(in),
                                      &tables,
                                      smooth.nonlinear};
         Results results{out};
         const auto both = [&](const auto& bsdf) {
           put(eval(bsdf, vector_of(in + 16), vector_of(in + 19)), results);
           put(sample(bsdf, vector_of(in + 16), static_cast<float>(in[22]), numbers_of(in + 23)), results);
         };
         both(smooth), both(rough);
       }},
      {"principled", principled,
       [](const Context&, const double* in, double* out) {
         const PrincipledBsdf bsdf{.base_color = four_of(in),
                                   .luminance = in[4],
                                   .eta = in[5],
                                   .roughness = in[6],
                                   .anisotropic = in[15],
                                   .metallic = in[7],
                                   .spec_trans = in[8],
                                   .spec_tint = in[9],
                                   .sheen = in[10],
                                   .sheen_tint = in[11],
                                   .flatness = in[12],
                                   .clearcoat = in[13],
                                   .clearcoat_gloss = in[14],
                                   .below = in[25] != 0};
         Results results{out};
         put(eval(bsdf, vector_of(in + 16), vector_of(in + 19)), results);
         put(sample(bsdf, vector_of(in + 16), static_cast<float>(in[22]), numbers_of(in + 23)), results);
       }},
      {"finish", finish,
       [](const Context&, const double* in, double* out) {
         const FinishBsdf bsdf{four_of(in), four_of(in + 4), in[8], in[9], in[10], in[11], in[12]};
         Results results{out};
         put(eval(bsdf, vector_of(in + 13), vector_of(in + 16)), results);
         put(sample(bsdf, vector_of(in + 13), static_cast<float>(in[19]), numbers_of(in + 20)), results);
       }},
  };
}

}  // namespace vitrail::lane_tests
