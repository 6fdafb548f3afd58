// SPDX-License-Identifier: Apache-2.0
#include "tests/tracer/lanes/fixtures.h"
#include "tests/tracer/lanes/results.h"
#include "tests/tracer/lanes/scalar_functions.h"
#include "tracer/quadrics/quadric_hits.h"
#include "tracer/transport/aim.h"

namespace vitrail::lane_tests {

namespace {

const EmissiveQuadric& sphere(const double* in) {
  return fixtures().spheres[static_cast<std::size_t>(in[0])];
}

// One of the spheres, and a point: about it, in it, in its middle.
Argument sphere_and_point() {
  return {4, {{0, 0, 0, 0}, {7, 1, 1, 1}}, [point = position()](Random& random, double* out) {
            const std::uint64_t number = random() % fixture_spheres;
            const Affine& stands = fixtures().spheres[number].to_bundle;
            out[0] = static_cast<double>(number);
            point.random(random, out + 1);
            const double share[] = {0, 1e-3, 0.5, 2};
            const double near = share[random() % 4];
            if (random() % 2 == 0)
              for (int i = 0; i < 3; ++i)
                out[1 + i] = stands.m[i][3] + near * (stands.m[i][0] + stands.m[i][1] * 0.5);
          }};
}

}  // namespace

std::vector<ScalarFunction> sphere_functions() {
  return {
      {"sample_sphere",
       {sphere_and_point(), unit_number(), unit_number()},
       [](const Context&, const double* in, double* out) {
         const EmissiveQuadric& light = sphere(in);
         const auto s = QuadricLight(light, true)
                            .sample(point_of(in + 1), static_cast<float>(in[4]), static_cast<float>(in[5]));
         Results results{out};
         const QuadricLight::Sample of = s.value_or(QuadricLight::Sample{});
         results << s.has_value() << (s && of.front != light.quadric.inside_out) << of.local << of.to_light
                 << of.normal << of.distance << of.pdf;
       }},
      {"sphere_crossings",
       {sphere_and_point(), float_direction(), number(-1, 1, {0})},
       [](const Context&, const double* in, double* out) {
         const Ray ray{cast<float>(point_of(in + 1)), cast<float>(vector_of(in + 4))};
         const QuadricHits hits =
             quadric_hits(prepare(ray), sphere(in).to_bundle, sphere(in).quadric.quadric, in[7] > 0);
         Results{out} << (hits.count > 0) << (hits.count > 1) << (hits.count > 0 ? hits.at[0].t : 0)
                      << (hits.count > 1 ? hits.at[1].t : 0);
       }},
      {"aim_at_sphere",
       {sphere_and_point(), direction(), number(-1, 1, {0}), magnitude(-10, 10, {0, 1})},
       [](const Context&, const double* in, double* out) {
         LightSample light;
         light.to_light = vector_of(in + 4), light.distance = in[8];
         light.quadric = &sphere(in);
         const std::uint32_t exclude = in[7] > 0 ? light.quadric->triangle : no_triangle;
         Results{out} << aim({point_of(in + 1), cast<float>(point_of(in + 1)), exclude}, light).end;
       }},
  };
}

}  // namespace vitrail::lane_tests
