// SPDX-License-Identifier: Apache-2.0
// Functions in lanes give the bits of the scalar ones, at every width and with every instruction set that the
// machine has.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>

#include "tests/support/long_tests.h"
#include "tests/tracer/lanes/fixtures.h"
#include "tests/tracer/lanes/scalar_functions.h"

namespace vitrail::lane_tests::lanes_test {

namespace {

std::vector<LaneFunctions> all_that_run() {
  std::vector<LaneFunctions> sets(std::begin(portable_functions), std::end(portable_functions));
#if defined(__x86_64__)
  const auto add = [&](const LaneFunctions(&more)[4]) {
    sets.insert(sets.end(), std::begin(more), std::end(more));
  };
  if (__builtin_cpu_supports("avx2")) add(avx2_functions);
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw"))
    add(avx512_functions);
#endif
  return sets;
}

const LaneFunction* find(const LaneFunctions& set, const std::string& name) {
  for (int i = 0; i < set.count; ++i)
    if (set.functions[i].name == name) return &set.functions[i];
  return nullptr;
}

std::string numbers(const double* x, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    char number[40];
    std::snprintf(number, sizeof number, " %a", x[i]);
    text += number;
  }
  return text;
}

void compare(const ScalarFunction& scalar, const std::vector<LaneFunctions>& sets) {
  const LaneFunction* first = find(sets.front(), scalar.name);
  ASSERT_NE(first, nullptr);
  int ins = 0;
  for (const Argument& a : scalar.arguments) ins += a.size;
  ASSERT_EQ(ins, first->ins);
  const int outs = first->outs;
  const std::vector<double> in = cases_of(scalar.arguments, test::of_all(100'000, 20'000), 1);
  const int count = static_cast<int>(in.size()) / ins;
  std::vector<double> expected(static_cast<std::size_t>(count * outs));
  const Context& context = fixtures().context;
  for (int i = 0; i < count; ++i) {
    scalar.run(context, &in[static_cast<std::size_t>(i * ins)],
               &expected[static_cast<std::size_t>(i * outs)]);
    for (int k = 0; k < outs; ++k)
      ASSERT_FALSE(std::isnan(expected[static_cast<std::size_t>(i * outs + k)]))
          << "result " << k << " of" << numbers(&in[static_cast<std::size_t>(i * ins)], ins);
  }
  for (const LaneFunctions& set : sets) {
    std::vector<double> got(expected.size());
    find(set, scalar.name)->run(context, in.data(), got.data(), count);
    if (std::memcmp(got.data(), expected.data(), got.size() * sizeof(double)) == 0) continue;
    for (int i = 0; i < count; ++i) {
      const auto at = static_cast<std::size_t>(i * outs);
      ASSERT_EQ(numbers(&got[at], outs), numbers(&expected[at], outs))
          << set.set << ", " << set.width << " lanes, case " << i << ":"
          << numbers(&in[static_cast<std::size_t>(i * ins)], ins);
    }
  }
}

class Lanes : public testing::TestWithParam<ScalarFunction> {};

TEST_P(Lanes, GiveTheBitsOfTheScalarFunction) { compare(GetParam(), all_that_run()); }

std::string name_of(const testing::TestParamInfo<ScalarFunction>& info) { return info.param.name; }
INSTANTIATE_TEST_SUITE_P(Sampling, Lanes, testing::ValuesIn(sampling_functions()), name_of);
INSTANTIATE_TEST_SUITE_P(Geometry, Lanes, testing::ValuesIn(geometry_functions()), name_of);
INSTANTIATE_TEST_SUITE_P(Stages, Lanes, testing::ValuesIn(stage_functions()), name_of);
INSTANTIATE_TEST_SUITE_P(Spheres, Lanes, testing::ValuesIn(sphere_functions()), name_of);
INSTANTIATE_TEST_SUITE_P(Glossy, Lanes, testing::ValuesIn(glossy_functions()), name_of);
INSTANTIATE_TEST_SUITE_P(Environments, Lanes, testing::ValuesIn(environment_functions()), name_of);
INSTANTIATE_TEST_SUITE_P(Scattering, Lanes, testing::ValuesIn(scattering_functions()), name_of);

TEST(LanesOfAll, AreComparedWithSomething) {
  std::size_t compared = 0;
  for (const auto& list :
       {sampling_functions(), geometry_functions(), scattering_functions(), stage_functions(),
        sphere_functions(), glossy_functions(), environment_functions()})
    compared += list.size();
  for (const LaneFunctions& set : all_that_run()) EXPECT_EQ(static_cast<std::size_t>(set.count), compared);
}

}  // namespace
}  // namespace vitrail::lane_tests::lanes_test
