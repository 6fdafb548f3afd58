// SPDX-License-Identifier: Apache-2.0
// Domains in packs: they read as from files of their own, and whatever is wrong with a pack is found.
#include "bundle/packs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "bundle/loaded_domain.h"
#include "bundle/verify.h"
#include "scene/system/diagnostics.h"
#include "tests/bundle/sample_bundle.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::packs_test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class Packs : public ::testing::Test {
 protected:
  void SetUp() override { test::write(sample, bundle); }

  void pack(std::uint64_t most_bytes) {
    write_packs(bundle, sample.manifest, most_bytes);
    write_manifest(bundle, sample.manifest);
  }
  // What a reader says of the manifest after a change of it.
  std::string said_of(const std::function<void(Manifest&)>& change) const {
    Manifest m = sample.manifest;
    change(m);
    try {
      write_manifest(bundle, m);
      read_manifest(bundle);
    } catch (const Error& e) {
      return e.what();
    }
    return "";
  }
  // Whether mapping domain `i` and verify_bundle find something.
  void expect_found(std::uint32_t i) const {
    OpenPacks packs;
    EXPECT_THROW(map_domain(sample.manifest, bundle, i, &packs), Error);
    EXPECT_FALSE(verify_bundle(bundle).problems.empty());
  }

  test::TemporaryDirectory directory;
  fs::path bundle = directory.path() / "sample.vit";
  test::SampleBundle sample = test::whole_bundle();
};

TEST_F(Packs, HoldTheBytesOfTheFiles) {
  std::vector<std::string> files;
  for (std::uint32_t i = 0; i < 3; ++i) files.push_back(test::read_text(domain_path(bundle, i)));
  pack(1 << 20);
  const std::string all = test::read_text(pack_path(bundle, 0));
  const Manifest m = read_manifest(bundle);
  EXPECT_EQ(m.domains, sample.manifest.domains);
  OpenPacks packs;
  for (std::uint32_t i = 0; i < 3; ++i) {
    const Stored stored = stored_domain(m, bundle, i);
    EXPECT_EQ(stored.offset % pack_page, 0u);
    EXPECT_EQ(all.substr(stored.offset, *stored.bytes), files[i]);
    EXPECT_FALSE(fs::exists(domain_path(bundle, i)));
    EXPECT_EQ(map_domain(m, bundle, i, &packs)->hash(), m.domains[i].hash);
  }
  const VerifyResult whole = verify_bundle(bundle);
  EXPECT_TRUE(whole.problems.empty());
  EXPECT_TRUE(whole.warnings.empty());
  EXPECT_EQ(domains_of_pack(pack_path(bundle, 0)).size(), 3u);
}

TEST_F(Packs, AreOfTheSizeThatIsAskedFor) {
  pack(1);
  for (std::uint32_t i = 0; i < 3; ++i) EXPECT_EQ(sample.manifest.domains[i].pack, (PackPlace{i, 0}));
  EXPECT_TRUE(verify_bundle(bundle).problems.empty());
}

TEST_F(Packs, StayOpen) {
  pack(1 << 20);
  OpenPacks packs;
  const auto first = packs.open(pack_path(bundle, 0));
  EXPECT_EQ(packs.open(pack_path(bundle, 0)), first);
}

TEST_F(Packs, WrongPlacesAreNamed) {
  pack(1 << 20);
  const auto place = [](Manifest& m, std::uint32_t i) -> PackPlace& { return *m.domains[i].pack; };
  EXPECT_THAT(said_of([&](Manifest& m) { place(m, 1).offset += 64; }), HasSubstr("at a page of its pack"));
  EXPECT_THAT(said_of([&](Manifest& m) { place(m, 1) = place(m, 0); }), HasSubstr("overlap in their pack"));
  EXPECT_THAT(said_of([&](Manifest& m) { place(m, 2).offset = std::uint64_t{1} << 47; }),
              HasSubstr("larger than files can be"));
  EXPECT_EQ(said_of([](Manifest&) {}), "");
}

TEST_F(Packs, OneThatWasCutIsFound) {
  pack(1 << 20);
  const PackPlace last = *sample.manifest.domains[2].pack;
  fs::resize_file(pack_path(bundle, 0), last.offset + 1);
  expect_found(2);
  fs::resize_file(pack_path(bundle, 0), last.offset);
  expect_found(2);
}

TEST_F(Packs, AnOffsetBeyondItsEndIsFound) {
  pack(1 << 20);
  sample.manifest.domains[2].pack->offset += 1 << 20;
  write_manifest(bundle, sample.manifest);
  expect_found(2);
}

TEST_F(Packs, BytesOfNoDomainAreFound) {
  pack(1 << 20);
  const fs::path file = pack_path(bundle, 0);
  const std::string whole = test::read_text(file);
  std::string changed = whole;
  changed[sample.manifest.domains[0].bytes] = 1;
  for (const std::string& text : {changed, whole + '\0', whole + std::string(8192, '\0')}) {
    test::write_text(file, text);
    const VerifyResult found = verify_bundle(bundle);
    ASSERT_EQ(found.problems.size(), 1u);
    EXPECT_THAT(found.problems[0].what, HasSubstr("belong to no domain"));
  }
}

TEST_F(Packs, AreVerifiedWithoutAManifest) {
  pack(1 << 20);
  test::write_text(bundle / "manifest.json", "{");
  EXPECT_EQ(verify_bundle(bundle).problems.size(), 1u);
  const fs::path file = pack_path(bundle, 0);
  std::string text = test::read_text(file);
  text[sample.manifest.domains[1].pack->offset + 200] ^= 1;
  test::write_text(file, text);
  const VerifyResult found = verify_bundle(bundle);
  ASSERT_EQ(found.problems.size(), 2u);
  EXPECT_THAT(found.problems[0].file, HasSubstr("domains/pack-0000 at byte"));
}

}  // namespace
}  // namespace vitrail::packs_test
