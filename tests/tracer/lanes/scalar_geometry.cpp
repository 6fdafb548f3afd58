// SPDX-License-Identifier: Apache-2.0
#include "bundle/domain_file.h"
#include "scene/geometry/frame.h"
#include "scene/geometry/portable_math.h"
#include "tests/tracer/lanes/scalar_functions.h"
#include "tracer/rays/direction.h"
#include "tracer/surfaces/scattering.h"

namespace vitrail::lane_tests {

std::vector<ScalarFunction> geometry_functions() {
  return {
      {"encode_direction",
       {direction()},
       [](const Context&, const double* in, double* out) {
         const DirectionCode code = encode_direction(vector_of(in));
         out[0] = code.first(), out[1] = code.second();
       }},
      {"decode_direction",
       {word(16777215, {8388607, 8388606, 8388608, 4194303}),
        word(16777215, {8388607, 8388606, 8388608, 4194303})},
       [](const Context&, const double* in, double* out) {
         put(decode_direction(
                 DirectionCode::of(static_cast<std::uint32_t>(in[0]), static_cast<std::uint32_t>(in[1]))),
             out);
       }},
      {"decode_normal",
       {word(std::uint64_t{1} << 32, {32767, 32768, 32769, 65535, 65536, 0x80008000u, 0x7fff0000u})},
       [](const Context&, const double* in, double* out) {
         put(decode_normal(static_cast<std::uint32_t>(in[0])), out);
       }},
      {"normalize",
       {vector()},
       [](const Context&, const double* in, double* out) { put(normalize(vector_of(in)), out); }},
      {"frame_of",
       {direction()},
       [](const Context&, const double* in, double* out) {
         const Frame frame(vector_of(in));
         put(frame.bitangent, put(frame.tangent, out));
       }},
      {"frame_around",
       {direction(), vector(), number(-1, 1, {-1, 1})},
       [](const Context&, const double* in, double* out) {
         const Vector3d along = vector_of(in + 3);
         const ShadingFrame frame = frame_around(vector_of(in), along, in[6]);
         out = put(frame.normal, put(frame.bitangent, put(frame.tangent, out)));
         put(frame.to_world(along), put(frame.to_local(along), out));
       }},
      {"order_of_min_and_max",
       {number(-2, 2, {-0.0, 0, 1, -1}), number(-2, 2, {-0.0, 0, 1, -1})},
       [](const Context&, const double* in, double* out) {
         out[0] = std::min(in[0], in[1]), out[1] = std::max(in[0], in[1]);
         out[2] = std::clamp(in[0], 0.0, 1.0), out[3] = safe_sqrt(in[0]);
         out[4] = -0.0;
       }},
      {"rounding_to_float",
       {number(-2, 2, {-0.0, 0, 1}), number(-1, 1, {0, 1})},
       [](const Context&, const double* in, double* out) {
         const volatile auto rounded = static_cast<float>(in[0]);
         out[0] = in[1] > 0 ? static_cast<double>(rounded) : 0;
       }},
  };
}

}  // namespace vitrail::lane_tests
