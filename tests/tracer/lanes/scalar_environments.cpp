// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "scene/geometry/portable_math.h"
#include "tests/tracer/lanes/fixtures.h"
#include "tests/tracer/lanes/results.h"
#include "tests/tracer/lanes/scalar_functions.h"

namespace vitrail::lane_tests {

namespace {

// Zero, ends of the range, and where two multiples of ln 2 are as near.
std::vector<double> exponents() {
  std::vector<double> all{0, -0.0, 1, -746, 710};
  for (const double steps : {-2.5, -1.5, -0.5, 0.5, 1.5, 2.5}) {
    double x = steps * 0.6931471805599453;
    for (int i = 0; i < 2; ++i) x = std::nextafter(x, -1e9);
    for (int i = 0; i < 5; ++i) all.push_back(x), x = std::nextafter(x, 1e9);
  }
  return all;
}

}  // namespace

std::vector<ScalarFunction> environment_functions() {
  return {
      {"portable_math",
       {number(-7, 7,
               {-1, -0.0, 0, 1, 1e-300, 3, 1e-16, 1.5e-16, 3e-16, -1e-16, pi / 2, pi, 1.5 * pi, 2 * pi}),
        number(-2, 2, {-1, -0.0, 0, 1}), number(-720, 720, exponents()), magnitude(-1022, 100, {1, 0.75, 2})},
       [](const Context&, const double* in, double* out) {
         Results{out} << portable_sin(in[0]) << portable_cos(in[0]) << portable_acos(in[0])
                      << portable_atan2(in[0], in[1]) << portable_exp(in[2]) << portable_log(in[3])
                      << portable_pow(in[3], in[2]);
       }},
      {"sphere_map",
       {direction(), unit_number(), unit_number()},
       [](const Context&, const double* in, double* out) {
         Results results{out};
         for (const auto projection : {SphereProjection::equal_area, SphereProjection::latitude_longitude}) {
           const Point2d point = sphere_point(projection, vector_of(in));
           results << point.x << point.y;
         }
         results << sphere_direction(SphereProjection::equal_area, {in[3], in[4]});
       }},
      {"look_up_image",
       {number(-3, 3, {-1, -0.0, 0, 0.5, 1, 2, 1e9, -1e300, 1e300, INFINITY}),
        number(-3, 3, {-1, -0.0, 0, 0.5, 1, 2, 1e9, -1e300, INFINITY, NAN}), float_number(360, 830, {360}),
        float_number(360, 830, {830}), float_number(360, 830, {500}), float_number(360, 830, {500})},
       [](const Context& context, const double* in, double* out) {
         Results results{out};
         SampledWavelengths wavelengths;
         for (std::size_t i = 0; i < hero_count; ++i)
           wavelengths.lambda_nm[i] = static_cast<float>(in[2 + i]);
         for (const BakedImage* image : context.images) {
           for (const Wrap wrap : {Wrap::repeat, Wrap::mirror, Wrap::clamp, Wrap::black})
             results << image->bilinear(in[0], in[1], wrap, 0, wavelengths).v;
           results << image->nearest(in[0], in[1], Wrap::clamp, 0, wavelengths).v;
         }
       }},
      {"sample_environment",
       {unit_number(), unit_number()},
       [](const Context& context, const double* in, double* out) {
         Results results{out};
         for (std::uint32_t i = 0; i < fixture_environments; ++i)
           results << sample_direction(context.environments[i], in[0], in[1]);
       }},
      {"see_environment",
       {direction()},
       [](const Context& context, const double* in, double* out) {
         Results results{out};
         for (std::uint32_t i = 0; i < fixture_environments; ++i) {
           const EnvironmentValue value =
               value_towards(context.environments[i], vector_of(in), *context.some_wavelengths);
           results << value.radiance.v << value.pdf;
         }
       }},
  };
}

}  // namespace vitrail::lane_tests
