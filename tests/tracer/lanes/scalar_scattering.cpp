// SPDX-License-Identifier: Apache-2.0
#include "tests/tracer/lanes/scalar_functions.h"
#include "tracer/bsdf/fresnel.h"
#include "tracer/bsdf/local.h"

namespace vitrail::lane_tests {

namespace {

Argument cosine() { return number(0, 1, {0, 1e-9, 0.5, 1 - 0x1p-53, 1}); }
Argument index() { return number(0.3, 3, {1, 1.5, 1 / 1.5, 1 + 1e-9}); }

}  // namespace

std::vector<ScalarFunction> scattering_functions() {
  return {
      {"sample_cosine_hemisphere",
       {unit_number(), unit_number()},
       [](const Context&, const double* in, double* out) {
         put(sample_cosine_hemisphere(static_cast<float>(in[0]), static_cast<float>(in[1])), out);
       }},
      {"attainable",
       {number(-0.1, 1.1,
               {-0.0, 0, 0x1p-60, 0x1p-24, 0x1.8p-24, 1 - 0x1p-25, 1 - 0x1p-53, 1, 2, 1e30, -1e30})},
       [](const Context&, const double* in, double* out) { out[0] = attainable(in[0]); }},
      {"fresnel_dielectric",
       {cosine(), index()},
       [](const Context&, const double* in, double* out) { out[0] = fresnel_dielectric(in[0], in[1]); }},
      {"refract",
       {direction(), direction(), index()},
       [](const Context&, const double* in, double* out) {
         Vector3d refracted;
         out[0] = refract(vector_of(in), vector_of(in + 3), in[6], refracted);
         put(refracted, out + 1);
       }},
      {"fresnel_conductor",
       {cosine(), number(0, 5, {0, 0.2, 1}), number(0, 8, {0, 1, 3})},
       [](const Context&, const double* in, double* out) {
         out[0] = fresnel_conductor(in[0], in[1], in[2]);
       }},
  };
}

}  // namespace vitrail::lane_tests
