// SPDX-License-Identifier: Apache-2.0
#include "bundle/domain_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>

#include "bundle/domain_layout.h"
#include "bundle/manifest.h"
#include "scene/system/diagnostics.h"
#include "tests/bundle/sample_bundle.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::domain_file_test {

namespace {

using test::sample_domain;

template <class T>
bool same_bytes(std::span<const T> a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

class DomainFile : public ::testing::Test {
 protected:
  test::TemporaryDirectory directory;
  std::filesystem::path file = directory.path() / "000000.dom";
};

TEST_F(DomainFile, ComesBackAsItWas) {
  const DomainContent content = sample_domain();
  const std::uint64_t bytes = write_domain_file(file, content);
  EXPECT_EQ(bytes, std::filesystem::file_size(file));
  const MappedDomain mapped(file);
  EXPECT_TRUE(same_bytes(mapped.view().nodes, content.nodes));
  EXPECT_TRUE(same_bytes(mapped.view().clusters, content.clusters));
  EXPECT_TRUE(same_bytes(mapped.view().normals, content.normals));
  const PieceList list = mapped.pieces();
  EXPECT_TRUE(same_bytes(std::span(list.pieces), content.pieces));
  EXPECT_TRUE(same_bytes(std::span(list.vertices), content.piece_vertices));
}

TEST_F(DomainFile, SectionsAreAlignedAndPadded) {
  write_domain_file(file, sample_domain());
  const MappedDomain mapped(file);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(mapped.view().nodes.data()) % 64, 0u);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(mapped.view().clusters.data()) % 64, 0u);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(mapped.view().normals.data()) % 64, 0u);
  const auto* end = reinterpret_cast<const std::byte*>(mapped.view().clusters.data() + 2);
  EXPECT_GE(reinterpret_cast<const std::byte*>(mapped.view().normals.data()) - end, 16);
}

TEST_F(DomainFile, MayBeEmpty) {
  write_domain_file(file, {});
  const MappedDomain mapped(file);
  EXPECT_TRUE(mapped.view().nodes.empty() && mapped.view().clusters.empty());
  EXPECT_TRUE(mapped.pieces().pieces.empty());
}

TEST_F(DomainFile, EqualContentEqualHash) {
  DomainContent content = sample_domain();
  write_domain_file(file, content);
  const std::uint64_t hash = MappedDomain(file).hash();
  write_domain_file(file, content);
  EXPECT_EQ(MappedDomain(file).hash(), hash);
  content.piece_vertices[0].x = 1e-300;
  write_domain_file(file, content);
  EXPECT_NE(MappedDomain(file).hash(), hash);
}

TEST(DomainHeaders, AreCheckedWithTheirTable) {
  const layout::DomainHeader header{};
  layout::DomainHeader other{};
  other.version = header.version + 1;
  const std::array<std::byte, 8> table{};
  EXPECT_EQ(layout::checksum_of(header, table), layout::checksum_of(header, table));
  EXPECT_NE(layout::checksum_of(header, table), layout::checksum_of(other, table));
  EXPECT_NE(layout::checksum_of(header, table), layout::checksum_of(header, std::span(table).first(4)));
}

TEST_F(DomainFile, MissingFileIsTheMachine) { EXPECT_THROW(MappedDomain{file}, MachineError); }

// Files whose checksums are right and whose references are not.
TEST_F(DomainFile, WrongReferencesAreFound) {
  constexpr std::uint32_t cluster = BvhNode::cluster_bit;
  const std::vector<std::function<void(DomainContent&)>> harms{
      [](DomainContent& d) { d.nodes[0].child[0] = 0; },                 // a loop
      [](DomainContent& d) { d.nodes[1].child[1] = 1; },                 // a loop
      [](DomainContent& d) { d.nodes[0].child[0] = 2; },                 // beyond the nodes
      [](DomainContent& d) { d.nodes[0].child[1] = cluster | 2; },       // beyond the clusters
      [](DomainContent& d) { d.nodes[0].child[1] = cluster | 0; },       // one cluster twice, one never
      [](DomainContent& d) { d.nodes[0].child[2] = 1; },                 // one node twice
      [](DomainContent& d) { d.nodes[1].lower[1][3] = std::nanf(""); },  // a ray may enter what is no child
      [](DomainContent& d) {
        for (int axis = 0; axis < 3; ++axis) d.nodes[0].lower[axis][7] = -10, d.nodes[0].upper[axis][7] = 10;
      },
      [](DomainContent& d) { d.nodes.clear(); },  // clusters without a tree
      [](DomainContent& d) { d.clusters.pop_back(); },
      [](DomainContent& d) { d.normals.pop_back(); },
      [](DomainContent& d) { d.pieces[0].vertex_count = 2; },
      [](DomainContent& d) { d.pieces[0].triangle = 20; },
      [](DomainContent& d) { d.instances.clear(); },                              // a tree over nothing
      [](DomainContent& d) { d.instance_nodes.clear(); },                         // instances without a tree
      [](DomainContent& d) { d.instance_nodes[0].child[1] = cluster | 1; },       // beyond the instances
      [](DomainContent& d) { d.instance_nodes[0].child[1] = 0; },                 // a loop
      [](DomainContent& d) { d.instances[0].to_parent.m[1][2] = std::nan(""); },  // stands nowhere
      [](DomainContent& d) { d.instances[0].lower[1] = 11; },                     // has no box
  };
  for (std::size_t i = 0; i < harms.size(); ++i) {
    DomainContent content = sample_domain();
    content.instances = {test::sample_instance(0, 11)};
    content.instance_nodes = test::sample_object(1).instance_nodes;
    ASSERT_NO_THROW((write_domain_file(file, content), MappedDomain(file)));
    harms[i](content);
    write_domain_file(file, content);
    EXPECT_THROW(MappedDomain(file).pieces(), Error) << "harm " << i;
  }
}

TEST_F(DomainFile, ItsBoundsAreThoseOfBothRoots) {
  DomainContent content = sample_domain();
  content.instances = {test::sample_instance(0, 11)};
  content.instance_nodes = test::sample_object(1).instance_nodes;
  for (int axis = 0; axis < 3; ++axis) {
    content.nodes[0].lower[axis][0] = -20;
    content.instance_nodes[0].upper[axis][0] = 30;
  }
  const Bounds3f box = content_bounds(view_of(content));
  EXPECT_EQ(box.lower, (Point3f{-20, -20, -20}));
  EXPECT_EQ(box.upper, (Point3f{30, 30, 30}));
  EXPECT_EQ(reach_of(view_of(content)), 30);
  content.nodes[0].lower[1][0] = -40;
  EXPECT_EQ(reach_of(view_of(content)), 40);
}

TEST_F(DomainFile, TreeMayNotBeTooDeep) {
  const auto chain = [&](int levels) {
    DomainContent content = sample_domain();
    const BvhNode last = content.nodes[1];
    content.nodes.resize(1);
    for (int i = 1; i + 1 < levels; ++i) {
      content.nodes.push_back(last);
      content.nodes.back().child[0] = static_cast<std::uint32_t>(i + 1);
    }
    content.nodes.push_back(last);
    write_domain_file(file, content);
  };
  chain(max_bvh_depth);
  EXPECT_NO_THROW(MappedDomain{file});
  chain(max_bvh_depth + 1);
  EXPECT_THROW(MappedDomain{file}, Error);
}

}  // namespace

}  // namespace vitrail::domain_file_test
