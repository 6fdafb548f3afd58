// SPDX-License-Identifier: Apache-2.0
// Whatever happens to a file of a bundle is found, and named.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "bundle/loaded_domain.h"
#include "bundle/texture_file.h"
#include "bundle/triangle_number.h"
#include "bundle/verify.h"
#include "scene/system/diagnostics.h"
#include "tests/bundle/sample_bundle.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::corruption_test {

namespace {

void read_everything(const std::filesystem::path& bundle) {
  const Manifest m = read_manifest(bundle);
  for (std::uint32_t i = 0; i < m.domains.size(); ++i) {
    const SharedDomain mapped = map_domain(m, bundle, i);
    mapped->pieces();
  }
  for (std::uint32_t i = 0; i < m.objects.size(); ++i) map_object(m, bundle, i);
  for (const TextureFileEntry& t : m.texture_files) {
    const TextureFile texture(bundle / t.name);
    check_texture(t, texture, bundle / t.name);
    texture.check_tiles();
  }
}

// By a reader, with an Error, and by verify_bundle, in this file.
bool found(const std::filesystem::path& bundle, const std::string& file) {
  const VerifyResult verified = verify_bundle(bundle, {1});
  const bool named = std::ranges::any_of(verified.problems, [&](const auto& p) { return p.file == file; });
  EXPECT_TRUE(named) << "verify_bundle finds " << verified.problems.size() << " problems elsewhere";
  try {
    read_everything(bundle);
  } catch (const Error& e) {
    return named && e.location.file.find(bundle.string()) == 0;
  }
  return false;
}

class Corruption : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    test::SampleBundle sample = test::whole_bundle();
    test::write(sample, bundle);
    original = test::read_text(file);
  }

  bool found_as(const std::string& text) {
    test::write_text(file, text);
    return found(bundle, GetParam());
  }

  test::TemporaryDirectory directory;
  std::filesystem::path bundle = directory.path() / "sample.vit";
  std::filesystem::path file = bundle / GetParam();
  std::string original;
};

TEST_P(Corruption, SampleIsWhole) {
  EXPECT_NO_THROW(read_everything(bundle));
  EXPECT_TRUE(verify_bundle(bundle).problems.empty());
}

// Headers with their tables are not longer; every bit of them in a row of eight bytes.
TEST_P(Corruption, EveryByteOfTheHeader) {
  for (std::size_t i = 0; i < std::min<std::size_t>(512, original.size()); ++i)
    for (const int flip : {1 << (i % 8), 0xff}) {
      std::string text = original;
      text[i] = static_cast<char>(text[i] ^ flip);
      ASSERT_TRUE(found_as(text)) << "byte " << i;
    }
}

TEST_P(Corruption, OneByteAnywhere) {
  std::mt19937 bits(1);
  for (int k = 0; k < 2000; ++k) {
    std::string text = original;
    const std::size_t i = bits() % text.size();
    text[i] = static_cast<char>(text[i] ^ static_cast<char>(1 + bits() % 255));
    ASSERT_TRUE(found_as(text)) << "byte " << i;
  }
}

TEST_P(Corruption, CutShortOrGrown) {
  for (std::size_t size = 0; size < original.size(); size += 1 + size / 8)
    ASSERT_TRUE(found_as(original.substr(0, size))) << size << " bytes left";
  ASSERT_TRUE(found_as(original.substr(0, original.size() - 1)));
  ASSERT_TRUE(found_as(original + std::string(1, '\0')));
  ASSERT_TRUE(found_as(original + std::string(64, '\0')));
}

INSTANTIATE_TEST_SUITE_P(Files, Corruption,
                         ::testing::Values("manifest.json", "materials.bin", "lights.bin", "domains.bin",
                                           "domains/000000.dom", "domains/000002.dom", "objects/000001.dom",
                                           "textures/000000.tex"));

// A whole file, but of another bundle.
TEST(CorruptionOfBundle, ExchangedFilesAreFound) {
  const test::TemporaryDirectory directory;
  const auto bundle = directory.path() / "a.vit", other = directory.path() / "b.vit";
  test::SampleBundle sample = test::whole_bundle(), changed = sample;
  changed.manifest.materials[0] = Material{DiffuseMaterial{ConstantSpectrum{0.1f}}};
  changed.manifest.lights.pop_back();
  changed.domains[1].clusters[0].vertex[0][0][3] = 17;
  changed.objects[0].clusters[0].vertex[0][0][0] = 17;
  test::write(changed, other);
  write_texture_file(other / "textures/000000.tex", {TexelFormat::number, 3, 3, 1},
                     [](auto...) { return TexelWords{}; });
  for (const char* file : {"materials.bin", "lights.bin", "domains.bin", "domains/000001.dom",
                           "objects/000000.dom", "textures/000000.tex"}) {
    test::write(sample, bundle);
    std::filesystem::copy_file(other / file, bundle / file,
                               std::filesystem::copy_options::overwrite_existing);
    EXPECT_TRUE(found(bundle, file)) << file;
  }
}

TEST(CorruptionOfBundle, SwappedFilesAreFound) {
  const test::TemporaryDirectory directory;
  for (const std::string folder : {"domains/", "objects/"}) {
    test::SampleBundle sample = test::whole_bundle();
    test::write(sample, directory.path());
    const std::string first = folder + "000000.dom", second = folder + "000001.dom";
    const std::string text = test::read_text(directory / first);
    test::write_text(directory / first, test::read_text(directory / second));
    test::write_text(directory / second, text);
    EXPECT_TRUE(found(directory.path(), first));
    EXPECT_TRUE(found(directory.path(), second));
  }
}

TEST(CorruptionOfBundle, TriangleThatTheSceneDoesNotHave) {
  const test::TemporaryDirectory directory;
  test::write_sample_bundle(directory.path());
  Manifest m = read_manifest(directory.path());
  const auto file = domain_path(directory.path(), 0);
  DomainContent content = test::sample_domain();
  content.clusters[1].id[2] = 11;
  const auto check = [&] {
    m.domains[0].bytes = write_domain_file(file, content);
    const MappedDomain mapped(file);
    m.domains[0].hash = mapped.hash();
    check_domain(m, 0, mapped, file);
  };
  EXPECT_THROW(check(), Error);
  // However many there are, there are only so many numbers.
  m.triangles = 1ull << 40;
  EXPECT_NO_THROW(check());
  content.clusters[1].id[2] = triangle_numbers;
  EXPECT_THROW(check(), Error);
}

// Files that are whole, but do not fit the manifest.
TEST(CorruptionOfBundle, InstancesThatTheSceneDoesNotHave) {
  const test::TemporaryDirectory directory;
  test::SampleBundle sample = test::whole_bundle();
  test::write(sample, directory.path());
  const auto rejects = [&](const DomainContent& content) {
    Manifest m = sample.manifest;
    const auto file = domain_path(directory.path(), 0);
    m.domains[0].bytes = write_domain_file(file, content, &m.domains[0].hash);
    EXPECT_THROW(map_domain(m, directory.path(), 0), Error);
  };
  DomainContent other = sample.domains[0];
  other.instances[0].first_triangle = 12;
  rejects(other);  // beyond the scene's triangles
  other.instances[0] = test::sample_instance(2, 0);
  rejects(other);  // no such object
}

// Its references are not looked at again, its bytes are.
TEST(CorruptionOfBundle, WhatWasLoadedBeforeIsComparedAgain) {
  const test::TemporaryDirectory directory;
  test::SampleBundle sample = test::whole_bundle();
  test::write(sample, directory.path());
  const Manifest m = sample.manifest;
  const auto domain = domain_path(directory.path(), 1), object = object_path(directory.path(), 0);
  const auto load = [&] {
    map_domain(m, directory.path(), 1, nullptr, true);
    map_object(m, directory.path(), 0, true);
  };
  EXPECT_NO_THROW(load());
  for (const auto& file : {domain, object}) {
    const std::string whole = test::read_text(file);
    std::string changed = whole;
    changed[whole.size() / 2] ^= 1;
    test::write_text(file, changed);
    EXPECT_THROW(load(), Error);
    DomainContent other = file == domain ? sample.domains[1] : sample.objects[0];
    other.clusters[0].id[0] = 1u << 30;  // which the scene does not have
    write_domain_file(file, other);
    EXPECT_THROW(load(), Error);
    test::write_text(file, whole);
  }
  Manifest of_other = m;
  DomainContent other = sample.domains[1];
  other.clusters[0].id[0] = 1u << 30;
  of_other.domains[1].bytes = write_domain_file(domain, other, &of_other.domains[1].hash);
  EXPECT_THROW(map_domain(of_other, directory.path(), 1), Error);
  EXPECT_NO_THROW(map_domain(of_other, directory.path(), 1, nullptr, true));
}

TEST(CorruptionOfBundle, LoadedDomainsHaveTheirObjects) {
  const test::TemporaryDirectory directory;
  test::SampleBundle sample = test::whole_bundle();
  test::write(sample, directory.path());
  const Manifest m = read_manifest(directory.path());
  const auto domain = load_domain(m, directory.path(), 2);
  ASSERT_EQ(domain->view().objects.size(), 2u);
  EXPECT_EQ(domain->view().objects[1]->instances[0].object, 0u);
  EXPECT_EQ(domain->view().objects[1]->reach, reach_of(*domain->view().objects[1]));
  EXPECT_GT(domain->view().objects[1]->reach, 0);
}

}  // namespace

}  // namespace vitrail::corruption_test
