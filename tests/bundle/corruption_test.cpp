// SPDX-License-Identifier: Apache-2.0
// Whatever happens to a file of a bundle is found, and named.
#include <gtest/gtest.h>

#include <random>

#include "bundle/loaded_domain.h"
#include "scene/diagnostics.h"
#include "tests/bundle/sample_bundle.h"
#include "tests/support/temporary_directory.h"

namespace vitrail {

namespace {

void read_everything(const std::filesystem::path& bundle) {
  const Manifest m = read_manifest(bundle);
  for (std::uint32_t i = 0; i < m.domains.size(); ++i) {
    const MappedDomain mapped(domain_path(bundle, i));
    check_domain(m, i, mapped, domain_path(bundle, i));
    mapped.pieces();
    mapped.piece_vertices();
  }
  for (std::uint32_t i = 0; i < m.objects.size(); ++i) map_object(m, bundle, i);
}

class Corruption : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    test::write_instanced_bundle(bundle);
    original = test::read_text(file);
  }

  // True where reading throws an Error that names the file.
  bool found(const std::string& text) {
    test::write_text(file, text);
    try {
      read_everything(bundle);
    } catch (const Error& e) {
      return e.location.file.find(bundle.string()) == 0;
    }
    return false;
  }

  test::TemporaryDirectory directory;
  std::filesystem::path bundle = directory.path() / "sample.vit";
  std::filesystem::path file = bundle / GetParam();
  std::string original;
};

TEST_P(Corruption, SampleIsWhole) { EXPECT_NO_THROW(read_everything(bundle)); }

TEST_P(Corruption, OneBitInTheHeader) {
  for (std::size_t i = 0; i < std::min<std::size_t>(320, original.size()); ++i)
    for (int bit = 0; bit < 8; ++bit) {
      std::string text = original;
      text[i] = static_cast<char>(text[i] ^ (1 << bit));
      ASSERT_TRUE(found(text)) << "bit " << bit << " of byte " << i;
    }
}

TEST_P(Corruption, OneByteAnywhere) {
  std::mt19937 bits(1);
  for (int k = 0; k < 1000; ++k) {
    std::string text = original;
    const std::size_t i = bits() % text.size();
    text[i] = static_cast<char>(text[i] ^ static_cast<char>(1 + bits() % 255));
    ASSERT_TRUE(found(text)) << "byte " << i;
  }
}

TEST_P(Corruption, CutShortOrGrown) {
  for (std::size_t size = 0; size < original.size(); size += 1 + size / 8)
    ASSERT_TRUE(found(original.substr(0, size))) << size << " bytes left";
  ASSERT_TRUE(found(original.substr(0, original.size() - 1)));
  ASSERT_TRUE(found(original + std::string(1, '\0')));
  ASSERT_TRUE(found(original + std::string(64, '\0')));
}

INSTANTIATE_TEST_SUITE_P(Files, Corruption,
                         ::testing::Values("manifest.json", "materials.bin", "lights.bin",
                                           "domains/000001.dom", "objects/000001.dom"));

// A whole file, but of another bundle.
TEST(CorruptionOfBundle, ExchangedFilesAreFound) {
  const test::TemporaryDirectory directory;
  const auto bundle = directory.path() / "a.vit";
  test::write_sample_bundle(bundle);
  DomainContent other = test::sample_domain();
  other.clusters[0].vertex[0][0][0] = 17;
  write_domain_file(domain_path(bundle, 1), other);
  EXPECT_THROW(read_everything(bundle), Error);

  test::write_sample_bundle(bundle);
  Manifest changed = test::sample_manifest();
  changed.materials[0] = Material{DiffuseMaterial{ConstantSpectrum{0.1f}}};
  std::filesystem::create_directories(directory.path() / "b.vit");
  write_manifest(directory.path() / "b.vit", changed);
  std::filesystem::copy_file(directory.path() / "b.vit/materials.bin", bundle / "materials.bin",
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_THROW(read_everything(bundle), Error);
}

TEST(CorruptionOfBundle, TriangleThatTheSceneDoesNotHave) {
  const test::TemporaryDirectory directory;
  test::write_sample_bundle(directory.path());
  Manifest m = read_manifest(directory.path());
  const auto file = domain_path(directory.path(), 0);
  DomainContent content = test::sample_domain();
  content.clusters[1].id[2] = 11;
  m.domains[0].bytes = write_domain_file(file, content);
  const MappedDomain mapped(file);
  m.domains[0].hash = mapped.hash();
  EXPECT_THROW(check_domain(m, 0, mapped, file), Error);
}

// Files that are whole, but do not fit the manifest.
TEST(CorruptionOfBundle, InstancesThatTheSceneDoesNotHave) {
  const test::TemporaryDirectory directory;
  test::write_instanced_bundle(directory.path());
  const auto rejects = [&](DomainContent content) {
    Manifest m = read_manifest(directory.path());
    const auto file = domain_path(directory.path(), 0);
    m.domains[0].bytes = write_domain_file(file, content, &m.domains[0].hash);
    EXPECT_THROW(map_domain(m, directory.path(), 0), Error);
  };
  DomainContent content = test::sample_domain();
  content.instances = {test::sample_instance(1, 11)};
  content.instance_nodes = test::sample_object(1).instance_nodes;
  DomainContent other = content;
  other.instances[0].first_triangle = 12;
  rejects(other);  // beyond the scene's triangles
  other.instances[0] = test::sample_instance(2, 0);
  rejects(other);  // no such object
}

TEST(CorruptionOfBundle, LoadedDomainsHaveTheirObjects) {
  const test::TemporaryDirectory directory;
  test::write_instanced_bundle(directory.path());
  const Manifest m = read_manifest(directory.path());
  const auto domain = load_domain(m, directory.path(), 2);
  ASSERT_EQ(domain->view().objects.size(), 2u);
  EXPECT_EQ(domain->view().objects[1]->instances[0].object, 0u);
  EXPECT_EQ(domain->view().padding, static_cast<float>(padding(m)));
}

}  // namespace

}  // namespace vitrail
