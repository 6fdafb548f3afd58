// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <set>

#include "farm/rays/parcel.h"
#include "farm/rays/queues.h"
#include "scene/system/diagnostics.h"

namespace vitrail::rays_test {
namespace {

TEST(Queues, KeepEveryRayOfBothKinds) {
  constexpr std::uint64_t plenty = 1 << 30;
  using Case = std::pair<std::uint64_t, std::optional<std::uint64_t>>;
  for (const auto& [most_bytes, seed] :
       {Case(plenty, {}), Case(plenty, 9), Case(200'000, {}), Case(200'000, 9), Case(0, 9)}) {
    RayQueues queues(3, most_bytes, seed);
    for (std::uint32_t i = 0; i < 5000; ++i) {
      RayRecord path{};
      path.path.sample.pixel = i;
      queues.push(1, path);
      ShadowRecord shadow{};
      shadow.pixel = i;
      queues.push(1, shadow);
      EXPECT_LE(queues.held_bytes(), most_bytes);
    }
    EXPECT_EQ(queues.written_bytes() > 0, most_bytes < plenty);
    std::multiset<std::uint32_t> paths, shadows;
    while (!queues.empty(1)) {
      RayBatch batch = queues.pop(1);
      EXPECT_LE(batch.bytes().size(), RayBatch::full_bytes);
      EXPECT_EQ(batch.domain(), 1u);
      if (batch.kind() == RayKind::path)
        for (const RayRecord& r : batch.records<RayRecord>()) paths.insert(r.path.sample.pixel);
      else
        for (const ShadowRecord& r : batch.records<ShadowRecord>()) shadows.insert(r.pixel);
    }
    EXPECT_EQ(paths.size(), 5000u);
    EXPECT_EQ(std::set(paths.begin(), paths.end()).size(), 5000u);
    EXPECT_EQ(shadows, paths);
  }
}

// Records of 64 and 48 bytes at most, and 8 bytes for a batch of 64 KiB.
TEST(WireSizes, FramingIncluded) {
  RayBatch paths(0, RayKind::path), shadows(0, RayKind::shadow);
  while (!paths.full()) paths.append(RayRecord{});
  while (!shadows.full()) shadows.append(ShadowRecord{});
  EXPECT_LE(static_cast<double>(paths.bytes().size()) / static_cast<double>(paths.count()), 64.01);
  EXPECT_LE(static_cast<double>(shadows.bytes().size()) / static_cast<double>(shadows.count()), 48);
}

TEST(Wire, WhatIsNoBatchIsSeen) {
  RayBatch batch(2, RayKind::path);
  EXPECT_FALSE(batch.is_whole(3)) << "without rays";
  batch.append(RayRecord{});
  EXPECT_TRUE(batch.is_whole(3));
  EXPECT_FALSE(batch.is_whole(2)) << "a domain that is none";
  std::vector<std::byte> bytes = batch.bytes();
  bytes.pop_back();
  EXPECT_FALSE(RayBatch(bytes).is_whole(3)) << "a part of a ray";
  bytes = batch.bytes();
  bytes[4] = std::byte{7};
  EXPECT_FALSE(RayBatch(bytes).is_whole(3)) << "a kind that is none";
  EXPECT_FALSE(RayBatch(std::vector<std::byte>(3)).is_whole(3));
}

RayRecord ray_of(std::uint32_t pixel) {
  RayRecord record{};
  record.path.sample.pixel = pixel;
  return record;
}

TEST(Wire, AParcelHoldsItsBatches) {
  Parcel parcel;
  EXPECT_TRUE(parcel.empty());
  for (std::uint32_t domain = 0; domain < 3; ++domain) {
    RayBatch batch(domain, domain == 1 ? RayKind::shadow : RayKind::path);
    for (std::uint32_t i = 0; i <= domain; ++i)
      domain == 1 ? batch.append(ShadowRecord{.pixel = i}) : batch.append(ray_of(i));
    parcel.add(batch);
  }
  const std::vector<std::byte> message = parcel.take();
  EXPECT_TRUE(parcel.empty());
  const std::vector<RayBatch> batches = unpack(message, 3);
  ASSERT_EQ(batches.size(), 3u);
  for (std::uint32_t domain = 0; domain < 3; ++domain) {
    EXPECT_EQ(batches[domain].domain(), domain);
    EXPECT_EQ(batches[domain].count(), domain + 1);
  }
  EXPECT_THROW(unpack(message, 2), MachineError) << "a domain that is none";
  for (std::size_t bytes = 1; bytes < message.size(); ++bytes) {
    const std::vector<std::byte> part(message.begin(), message.begin() + static_cast<std::ptrdiff_t>(bytes));
    try {
      EXPECT_LT(unpack(part, 3).size(), 3u) << bytes;  // it ends between two batches
    } catch (const MachineError&) {
    }
  }
}

}  // namespace
}  // namespace vitrail::rays_test
