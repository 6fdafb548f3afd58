// SPDX-License-Identifier: Apache-2.0
#include "tracer/photons/photon_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace vitrail::test::photon_map_test {
namespace {

constexpr double radius = 0.02;
constexpr std::uint32_t max_depth = 20;

// On a square, many of them in the same place with other numbers and depths.
std::vector<Photon> photons_on_a_square(int count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> along(0, 1);
  std::vector<Photon> photons;
  for (int i = 0; i < count; ++i) {
    Photon p{};
    p.p[0] = along(random), p.p[1] = along(random);
    if (i % 5 == 0) p.p[0] = p.p[1] = 0.5f;
    p.direction = encode_direction(normalize(Vector3d{0.3, i % 2 == 0 ? 0.2 : -0.4, -1}));
    for (float& power : p.power) power = along(random);
    p.number = static_cast<std::uint32_t>(i / 3);
    p.depth = static_cast<std::uint16_t>(i % 3);
    photons.push_back(p);
  }
  std::ranges::shuffle(photons, random);
  return photons;
}

Gather question_at(float x, float y) {
  Gather at{};
  at.p[0] = x, at.p[1] = y;
  at.out = at.geometric = at.shading = encode_direction(Vector3d{0, 0, 1});
  std::ranges::fill(at.weight, 1.0f);
  return at;
}

void fill_map(PhotonMap& map, const std::vector<Photon>& photons) {
  map.begin(radius, {{0, 0, 0}, {1, 1, 0}});
  for (const Photon& p : photons) map.add(p);
  map.build();
}

// Expects the same light at points all over the square, and at one where a tenth of a thousand photons
// landed.
void expect_same_light(const PhotonMap& map, const PhotonMap& reference) {
  std::uint64_t found = 0, found_there = 0;
  const auto compare = [&](float x, float y) {
    const Gather at = question_at(x, y);
    EXPECT_EQ(map.gather(at, max_depth, found).v, reference.gather(at, max_depth, found_there).v)
        << x << ", " << y;
  };
  for (int i = 0; i < 400; ++i) compare(static_cast<float>(i % 20) / 19, static_cast<float>(i / 20) / 19);
  compare(0.5f, 0.5f);
  EXPECT_EQ(found, found_there);
  EXPECT_GT(found, 1000u);
}

TEST(PhotonMap, IsTheSameWhereMemoryHasNoRoomForAll) {
  const std::vector<Photon> photons = photons_on_a_square(6000);
  PhotonMap reference;
  fill_map(reference, photons);
  EXPECT_EQ(reference.written_bytes(), 0u);
  // As many as there are; one less; many runs of which each has a few photons of the buffer.
  for (const std::size_t most : {6000u, 5999u, 1000u, 90u}) {
    PhotonMap map(most);
    fill_map(map, photons);
    EXPECT_LE(map.in_memory(), most);
    EXPECT_EQ(map.written_bytes() > 0, most < 6000) << most;
    expect_same_light(map, reference);
  }
}

TEST(PhotonMap, BeginsAnewWhateverWasInFiles) {
  PhotonMap map(500), reference;
  fill_map(map, photons_on_a_square(6000));
  for (const int count : {3000, 400, 5000}) {
    fill_map(map, photons_on_a_square(count));
    fill_map(reference, photons_on_a_square(count));
    std::uint64_t found = 0, found_there = 0;
    const Gather at = question_at(0.5f, 0.5f);
    EXPECT_EQ(map.gather(at, max_depth, found).v, reference.gather(at, max_depth, found_there).v) << count;
    EXPECT_EQ(found, found_there) << count;
    EXPECT_GT(found, 0u) << count;
  }
}

TEST(PhotonMap, SensorsFindTheirPhotonsInFiles) {
  const std::vector<Photon> photons = photons_on_a_square(6000);
  PhotonMap map(300), reference;
  fill_map(map, photons);
  fill_map(reference, photons);
  for (std::size_t i = 0; i < photons.size(); i += 97) {
    Gather at{};
    std::ranges::copy(photons[i].p, at.p);
    at.out = photons[i].direction;
    std::ranges::fill(at.weight, 1.0f);
    std::uint64_t found = 0, found_there = 0;
    const auto all = [](std::uint32_t) { return true; };
    EXPECT_EQ(map.at_sensor(at, max_depth, found, all).v,
              reference.at_sensor(at, max_depth, found_there, all).v);
    EXPECT_EQ(found, found_there);
    EXPECT_GE(found, 1u);
  }
}

}  // namespace
}  // namespace vitrail::test::photon_map_test
