// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "bundle/domain_file.h"

namespace vitrail::normal_code_test {

namespace {

double angle_rad(Normal3d n, Normal3f decoded) {
  const Vector3d a = normalize(to_vector(n)), b = to_vector(cast<double>(decoded));
  return std::atan2(length(cross(a, b)), dot(a, b));
}

TEST(NormalCode, AnglesAreKept) {
  std::mt19937 bits(3);
  std::normal_distribution<double> gauss;
  for (int i = 0; i < 100'000; ++i) {
    const Normal3d n{gauss(bits), gauss(bits), gauss(bits)};
    const std::uint32_t code = encode_normal(n);
    ASSERT_NE(code, no_normal);
    ASSERT_LT(angle_rad(n, decode_normal(code)), 7e-5);
    ASSERT_NEAR(length(to_vector(decode_normal(code))), 1, 1e-6);
  }
}

TEST(NormalCode, AxesAndFoldsAreExact) {
  for (const double s : {-1.0, 1.0}) {
    EXPECT_EQ(decode_normal(encode_normal({s, 0, 0})), (Normal3f{static_cast<float>(s), 0, 0}));
    EXPECT_EQ(decode_normal(encode_normal({0, s, 0})), (Normal3f{0, static_cast<float>(s), 0}));
    EXPECT_EQ(decode_normal(encode_normal({0, 0, s})), (Normal3f{0, 0, static_cast<float>(s)}));
    EXPECT_LT(angle_rad({s, s, -1e-9}, decode_normal(encode_normal({s, s, -1e-9}))), 7e-5);
  }
}

TEST(NormalCode, WhatHasNoDirectionHasNoCode) {
  EXPECT_EQ(encode_normal({0, 0, 0}), no_normal);
  EXPECT_EQ(encode_normal({std::numeric_limits<double>::quiet_NaN(), 0, 1}), no_normal);
  EXPECT_EQ(encode_normal({std::numeric_limits<double>::infinity(), 0, 1}), no_normal);
}

}  // namespace

}  // namespace vitrail::normal_code_test
