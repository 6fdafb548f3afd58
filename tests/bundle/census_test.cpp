// SPDX-License-Identifier: Apache-2.0
#include "bundle/census.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/bundle/sample_bundle.h"

namespace vitrail::census_test {

namespace {

// The sample domain holds triangles 0 to 10; of triangle 3, (3+eₓ, 3+e_y, 3+e_z), it holds a piece.

CensusResult census_of(const std::vector<DomainContent>& domains, std::uint64_t triangles = 11) {
  Census census(triangles);
  for (std::uint32_t i = 0; i < domains.size(); ++i)
    census.add(i, view_of(domains[i]), domains[i].pieces, domains[i].piece_vertices);
  return census.result();
}

DomainContent whole_sample() {
  DomainContent d = test::sample_domain();
  d.piece_vertices = {{4, 3, 3}, {3, 4, 3}, {3, 3, 4}};
  return d;
}

// A domain of one triangle only, number 3, cut.
DomainContent only_the_cut_one(std::vector<Point3d> polygon) {
  DomainContent d = whole_sample();
  d.clusters.resize(1);
  for (std::uint32_t& id : d.clusters[0].id)
    if (id != 3) id = no_triangle;
  d.piece_vertices = std::move(polygon);
  return d;
}

TEST(Census, CountsAWholeBundle) {
  const CensusResult r = census_of({whole_sample()});
  EXPECT_EQ(r.duplicates, 0u);
  EXPECT_EQ(r.lost, 0u);
  EXPECT_EQ(r.cut_triangles, 1u);
  EXPECT_EQ(r.pieces, 1u);
  EXPECT_LT(r.area_error, 1e-15);
}

TEST(Census, PiecesInTwoDomainsAddUp) {
  DomainContent first = whole_sample();
  first.piece_vertices = {{4, 3, 3}, {3, 4, 3}, {3.5, 3, 3.5}};
  const CensusResult r = census_of({first, only_the_cut_one({{3.5, 3, 3.5}, {3, 4, 3}, {3, 3, 4}})});
  EXPECT_EQ(r.duplicates, 0u);
  EXPECT_EQ(r.cut_triangles, 1u);
  EXPECT_EQ(r.pieces, 2u);
  EXPECT_LT(r.area_error, 1e-15);
}

// A needle without area at a great distance: a vertex is off by a rounding of its coordinates, not of its
// edges.
TEST(Census, CoordinatesRoundAtTheirOwnSize) {
  DomainContent d = only_the_cut_one({{1e7, 0, 0}, {1e7 + 1, 1, 0}, {1e7 + 0.5 + 1e-9, 0.5, 0}});
  const auto lane = static_cast<std::size_t>(std::ranges::find(d.clusters[0].id, 3u) - d.clusters[0].id);
  const float x[] = {1e7f, 1e7f + 1, 1e7f + 0.0f}, y[] = {0, 1, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    d.clusters[0].vertex[k][0][lane] = x[k];
    d.clusters[0].vertex[k][1][lane] = y[k];
    d.clusters[0].vertex[k][2][lane] = 0;
  }
  EXPECT_LT(census_of({d}).area_error, 1e-6);
  d.piece_vertices[2].x += 1e-3;
  EXPECT_GT(census_of({d}).area_error, 1e-6);
}

TEST(Census, FindsWhatIsMissing) {
  EXPECT_EQ(census_of({whole_sample()}, 13).lost, 2u);
  DomainContent half = whole_sample();
  half.piece_vertices[0] = {3.5, 3, 3.5};
  EXPECT_NEAR(census_of({half}).area_error, 0.5, 1e-12);
}

TEST(Census, FindsWhatIsDoubled) {
  EXPECT_EQ(census_of({whole_sample(), whole_sample()}).duplicates, 10u);  // the eleventh is cut
  EXPECT_NEAR(census_of({whole_sample(), whole_sample()}).area_error, 1, 1e-12);
  DomainContent piece_twice = whole_sample();
  piece_twice.pieces.push_back(piece_twice.pieces[0]);
  EXPECT_EQ(census_of({piece_twice}).strays, 1u);
  DomainContent triangle_twice = whole_sample();
  triangle_twice.clusters[0].id[5] = 3;
  EXPECT_EQ(census_of({triangle_twice}).duplicates, 1u);
  triangle_twice.pieces.push_back(triangle_twice.pieces[0]);
  EXPECT_EQ(census_of({triangle_twice}).duplicates, 1u);
  DomainContent whole_as_well = whole_sample();
  whole_as_well.pieces.clear();
  EXPECT_EQ(census_of({whole_as_well, only_the_cut_one(whole_sample().piece_vertices)}).duplicates, 1u);
}

}  // namespace

}  // namespace vitrail::census_test
