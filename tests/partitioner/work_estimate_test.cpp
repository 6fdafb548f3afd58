// SPDX-License-Identifier: Apache-2.0
#include "partitioner/cutting/work_estimate.h"

#include <gtest/gtest.h>

#include <fstream>

#include "scene/system/diagnostics.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::work_estimate_test {
namespace {

// Below x = 0 in the profile's coordinates 100 items and 100 rays, above it 300 and 3900.
RayProfile profile() {
  RayProfile p;
  p.offset = {10, 0, 0};
  p.kd_nodes = {{0, 0, KdNode::leaf_bit, KdNode::leaf_bit | 1}};
  p.domains = {{100, 100, .125}, {3900, 300, 2.25}};
  p.ways = {{0, 0, 5}, {0, 1, 70}, {RayProfile::Way::camera, 1, 1000}};
  p.cost = {1500, 2.5, .25, .125, 2};
  return p;
}

Bounds3f box_at(float x) { return {{x - 1, 0, 0}, {x + 1, 1, 1}}; }

TEST(WorkEstimate, WithoutAProfileAllItemsAreAlike) {
  const std::vector<Item> items = WorkEstimate().items({box_at(-5), box_at(5)});
  EXPECT_EQ(items[0].work, 1);
  EXPECT_EQ(items[1].work, 1);
  EXPECT_EQ(items[1].bounds, box_at(5));
}

TEST(WorkEstimate, HalfOfTheWorkIsTheRays) {
  // The scene to be cut lies elsewhere: its x = 12 is the profile's 2.
  const std::vector<Item> items = WorkEstimate(profile(), {0, 0, 0}).items({box_at(8), box_at(12)});
  EXPECT_FLOAT_EQ(items[0].work, 0.5f + 0.5f * 1 / 10);
  EXPECT_FLOAT_EQ(items[1].work, 0.5f + 0.5f * 13 / 10);
  EXPECT_FLOAT_EQ(items[0].work * 100 + items[1].work * 300, 400);
}

TEST(WorkEstimate, NoRaysAtAll) {
  RayProfile p = profile();
  p.domains = {{0, 100, 0}, {0, 0, 0}};
  EXPECT_FLOAT_EQ(WorkEstimate(p, p.offset).items({box_at(-5)})[0].work, 1);
}

TEST(RayProfile, IsReadAsWritten) {
  const test::TemporaryDirectory directory;
  const auto file = directory.path() / "profile.json";
  write_ray_profile(file, profile());
  const RayProfile p = read_ray_profile(file);
  EXPECT_EQ(p.offset, profile().offset);
  EXPECT_EQ(p.kd_nodes, profile().kd_nodes);
  EXPECT_EQ(p.domains, profile().domains);
  EXPECT_EQ(p.ways, profile().ways);
  EXPECT_EQ(p.cost, profile().cost);
}

TEST(RayProfile, WhatIsNoneIsAnError) {
  const test::TemporaryDirectory directory;
  const auto file = directory.path() / "profile.json";
  for (
      const char* text :
      {"", "[]", "{}", R"({"format": "vitrail ray profile", "version": 4})",
       R"({"format": "vitrail ray profile", "version": 3, "offset": [0, 0, 0], "kd_nodes": [], "domains": [[1, 1, 1]]})",
       R"({"format": "vitrail ray profile", "version": 4, "offset": [0, 0, 0], "kd_nodes": [], "domains": []})",
       R"({"format": "vitrail ray profile", "version": 4, "offset": [0, 0, 0], "kd_nodes": [[0, 0, 0, 0]], "domains": [[1, 1, 1], [1, 1, 1]]})",
       R"({"format": "vitrail ray profile", "version": 4, "offset": [0, 0, 0], "kd_nodes": [[3, 0, 2147483648, 2147483649]], "domains": [[1, 1, 1], [1, 1, 1]]})"}) {
    std::ofstream(file) << text;
    EXPECT_THROW(read_ray_profile(file), Error) << text;
  }
  EXPECT_THROW(read_ray_profile(directory.path() / "none"), Error);
}

TEST(RayProfile, NothingTakesLessThanNoTime) {
  const test::TemporaryDirectory directory;
  const auto file = directory.path() / "profile.json";
  RayProfile of_a_domain = profile(), of_all = profile();
  of_a_domain.domains[0].seconds = -1;
  of_all.cost.trace_s = -1;
  for (const RayProfile& p : {of_a_domain, of_all}) {
    write_ray_profile(file, p);
    EXPECT_THROW(read_ray_profile(file), Error);
  }
}

}  // namespace
}  // namespace vitrail::work_estimate_test
