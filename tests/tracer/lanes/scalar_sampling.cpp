// SPDX-License-Identifier: Apache-2.0
#include "tests/tracer/lanes/scalar_functions.h"
#include "tracer/rays/ray_records.h"
#include "tracer/sampling/candidate_numbers.h"
#include "tracer/sampling/sampler.h"

namespace vitrail::lane_tests {

namespace {

std::uint32_t word_of(double x) { return static_cast<std::uint32_t>(x); }
std::uint64_t long_of(const double* in) { return word_of(in[0]) | std::uint64_t{word_of(in[1])} << 32; }
void put(std::uint64_t x, double* out) {
  out[0] = static_cast<double>(x & 0xffffffff), out[1] = static_cast<double>(x >> 32);
}
template <class Numbers>
double* put_all(const Numbers& numbers, double* out, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) *out++ = static_cast<double>(numbers[i]);
  return out;
}

const std::vector<double> float_corners{0,          0x1p-149,       0x1p-126,    1,
                                        1 + 0x1p-8, 1 + 3 * 0x1p-9, 0x1p-17 + 1, 0x1p127};

}  // namespace

std::vector<ScalarFunction> sampling_functions() {
  return {
      {"stream_seed",
       {long_word(), long_word(), long_word()},
       [](const Context&, const double* in, double* out) {
         put(stream_seed(long_of(in), long_of(in + 2), long_of(in + 4)), out);
       }},
      {"sample_seed",
       {word(), word(), word()},
       [](const Context&, const double* in, double* out) {
         put(sample_seed(SampleKey{7, word_of(in[0]), word_of(in[1])}), out);
       }},
      {"random_bits",
       {long_word()},
       [](const Context&, const double* in, double* out) { put(RandomStream(long_of(in)).bits(), out); }},
      {"sample_4d",
       {word(), word(max_samples), word(std::uint64_t{1} << 32, {5, 6, 7})},
       [](const Context&, const double* in, double* out) {
         const SampleKey key{7, word_of(in[0]), word_of(in[1])};
         out = put_all(sample_4d(key, word_of(in[2])), out, 4);
         out = put_all(sample_4d(key, word_of(in[2]), Wanted::three), out, 3);
         put_all(sample_4d(key, word_of(in[2]), Wanted::two), out, 2);
       }},
      {"numbers_of_candidate",
       {unit_number(), unit_number(), unit_number(), unit_number()},
       [](const Context&, const double* in, double* out) {
         const std::array<float, 4> u{static_cast<float>(in[0]), static_cast<float>(in[1]),
                                      static_cast<float>(in[2]), static_cast<float>(in[3])};
         for (std::uint32_t k = 0; k < most_candidates; ++k)
           out = put_all(numbers_of_candidate(u, k), out, 4);
       }},
      {"density_beside",
       {magnitude(-160, 120, {0, 0x1p-160, 1, 1 + 0x1p-8, 1 + 0x1p-7, 1 + 3 * 0x1p-8})},
       [](const Context&, const double* in, double* out) {
         out[0] = static_cast<double>(density_beside(in[0], 1));
         out[1] = static_cast<double>(density_beside(in[0], 6));
       }},
      {"rounded_radiance",
       {float_magnitude(-148, 127, float_corners)},
       [](const Context&, const double* in, double* out) {
         out[0] = static_cast<double>(rounded_radiance(static_cast<float>(in[0])));
       }},
      {"rounded_by_chance",
       {float_magnitude(-148, 127, float_corners), word(std::uint64_t{1} << 32, {1023, 1024})},
       [](const Context&, const double* in, double* out) {
         out[0] = static_cast<double>(rounded_by_chance(static_cast<float>(in[0]), word_of(in[1])));
       }},
  };
}

}  // namespace vitrail::lane_tests
