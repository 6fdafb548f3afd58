// SPDX-License-Identifier: Apache-2.0
#include "bundle/piece_code.h"

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <limits>
#include <numeric>
#include <random>

#include "scene/system/diagnostics.h"

namespace vitrail::piece_code_test {

namespace {

struct Content {
  std::vector<Cluster> clusters;
  PieceList list;

  void add(std::uint32_t triangle, const std::vector<Point3d>& polygon) {
    list.pieces.push_back({triangle, static_cast<std::uint32_t>(list.vertices.size()),
                           static_cast<std::uint32_t>(polygon.size())});
    list.vertices.insert(list.vertices.end(), polygon.begin(), polygon.end());
  }
  PieceCode encoded() const { return encode_pieces(clusters, list.pieces, list.vertices); }
  PieceList decoded(const PieceCode& code) const {
    return decode_pieces(clusters, code.triangles, code.corners, code.cut_vertices, "a.dom");
  }
};

template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

bool comes_back(const Content& c) {
  const PieceList list = c.decoded(c.encoded());
  return same_bytes(list.pieces, c.list.pieces) && same_bytes(list.vertices, c.list.vertices);
}

Cluster no_triangles() {
  Cluster c;
  std::fill_n(&c.vertex[0][0][0], 9 * cluster_width, std::numeric_limits<float>::quiet_NaN());
  std::fill_n(c.id, cluster_width, no_triangle);
  return c;
}

void put(Cluster& c, std::size_t lane, std::uint32_t id, const std::array<Point3f, 3>& triangle) {
  c.id[lane] = id;
  for (std::size_t k = 0; k < 3; ++k)
    for (int axis = 0; axis < 3; ++axis) c.vertex[k][axis][lane] = triangle[k][axis];
}

// Triangles 7 and 2, in this order, with two equal vertices and a −0.
Content two_pieces() {
  Content c{{no_triangles(), no_triangles()}, {}};
  put(c.clusters[0], 3, 7, {{{0, 0, 0}, {1, 0, 0.1f}, {0, 1, 0}}});
  put(c.clusters[0], 5, 1, {{{0, 0, 0}, {5, 0, 0}, {0, 6, 0}}});
  put(c.clusters[1], 0, 2, {{{-0.0f, 2, 0}, {3, 3, 3}, {3, 3, 3}}});
  c.add(7, {{0, 0, 0}, {1, 0, double{0.1f}}, {0.5, 0.5, 0.05}, {0, 0.25, 0}});
  c.add(2, {{-0.0, 2, 0}, {3, 3, 3}, {3, 3, 3}});
  return c;
}

TEST(PieceCode, CornersOfTheTriangleTakeAByte) {
  const Content c = two_pieces();
  const PieceCode code = c.encoded();
  EXPECT_EQ(code.triangles, (std::vector<std::uint32_t>{7, 2}));
  EXPECT_EQ(code.corners, (std::vector<PieceCorner>{0, 1, 3, 7, 0, 1, 5}));
  EXPECT_EQ(code.cut_vertices, (std::vector<Point3d>{{0.5, 0.5, 0.05}, {0, 0.25, 0}}));
  EXPECT_TRUE(comes_back(c));
}

TEST(PieceCode, OnlyEqualBitsAreACorner) {
  Content c = two_pieces();
  c.list.vertices[0].x = -0.0;                   // 0 in the cluster
  c.list.vertices[1].z = 0.1;                    // not a float
  c.list.vertices[4].x = 0;                      // −0 in the cluster
  c.list.vertices[5].y = std::nextafter(3., 4);  // rounds to the cluster's
  EXPECT_EQ(c.encoded().corners, (std::vector<PieceCorner>{3, 3, 3, 7, 3, 3, 5}));
  EXPECT_TRUE(comes_back(c));
}

TEST(PieceCode, NoPieces) {
  EXPECT_TRUE(comes_back({}));
  Content c = two_pieces();
  c.list = {};
  EXPECT_TRUE(comes_back(c));
}

TEST(PieceCode, PolygonsMayHaveManyVertices) {
  Content c = two_pieces();
  c.list = {};
  c.add(7, std::vector<Point3d>(100'000, {0, 1, 0}));
  std::vector<Point3d> other(70'000);
  for (std::size_t i = 0; i < other.size(); ++i) other[i] = {static_cast<double>(i) + 0.1, 3, 3};
  c.add(2, other);
  EXPECT_TRUE(comes_back(c));
  EXPECT_EQ(c.encoded().cut_vertices.size(), other.size());
}

// Coordinates of few values, so that vertices are equal, differ in a sign of zero or in one axis.
TEST(PieceCode, SoupsComeBack) {
  std::mt19937 bits(1);
  const std::array values{0.0f, -0.0f, 1.0f, -1.0f, 0.1f, 1e-45f, std::numeric_limits<float>::max()};
  const auto value = [&] { return values[bits() % values.size()]; };
  std::size_t corners = 0, cut = 0;
  for (int soup = 0; soup < 200; ++soup) {
    Content c;
    std::vector<std::uint32_t> ids(1 + bits() % 100);
    std::iota(ids.begin(), ids.end(), 0u);
    std::shuffle(ids.begin(), ids.end(), bits);
    while (!ids.empty()) {
      Cluster& cluster = c.clusters.emplace_back(no_triangles());
      for (std::size_t lane = 0; lane < cluster_width && !ids.empty(); ++lane) {
        if (bits() % 4 == 0) continue;
        const auto vertex = [&] { return Point3f{value(), value(), value()}; };
        put(cluster, lane, ids.back(), {vertex(), vertex(), vertex()});
        if (bits() % 2 == 0) {
          const std::array<Point3d, 3> uncut = triangle_in(cluster, lane);
          std::vector<Point3d> polygon(3 + bits() % 9);
          for (Point3d& p : polygon)
            p = bits() % 2 ? uncut[bits() % 3] : Point3d{value(), value() / 3.0, value()};
          c.add(ids.back(), polygon);
        }
        ids.pop_back();
      }
    }
    ASSERT_TRUE(comes_back(c)) << "soup " << soup;
    const PieceCode code = c.encoded();
    corners += code.corners.size();
    cut += code.cut_vertices.size();
  }
  EXPECT_LT(cut, corners * 5 / 8);
}

TEST(PieceCode, DamageIsRefused) {
  const std::vector<std::function<void(PieceCode&)>> harms{
      [](PieceCode& p) { p.triangles[0] = 20; },           // is not there
      [](PieceCode& p) { p.triangles[0] = no_triangle; },  // an empty lane
      [](PieceCode& p) { std::swap(p.triangles[0], p.triangles[1]); },
      [](PieceCode& p) { p.triangles[1] = 7; },      // twice
      [](PieceCode& p) { p.triangles.pop_back(); },  // corners of no piece
      [](PieceCode& p) {
        p.triangles = {7, 1, 2};
      },  // a piece without corners
      [](PieceCode& p) { p.triangles.clear(); },
      [](PieceCode& p) { p.corners[1] = 8; },  // no such corner
      [](PieceCode& p) { p.corners[1] = 0xff; },
      [](PieceCode& p) { p.corners[1] = next_cut_vertex; },  // more cut vertices than there are
      [](PieceCode& p) { p.corners[2] = 0; },                // fewer
      [](PieceCode& p) { p.corners[1] |= last_corner; },     // of two vertices, and one piece too many
      [](PieceCode& p) { p.corners.erase(p.corners.begin() + 4); },  // of two vertices
      [](PieceCode& p) { p.corners[3] = next_cut_vertex; },          // one piece too few
      [](PieceCode& p) { p.corners.back() &= 3; },                   // the last has no end
      [](PieceCode& p) { p.corners.push_back(0); },
      [](PieceCode& p) { p.corners.clear(); },
      [](PieceCode& p) { p.cut_vertices.pop_back(); },
      [](PieceCode& p) { p.cut_vertices.push_back({}); },
  };
  const Content c = two_pieces();
  for (std::size_t i = 0; i < harms.size(); ++i) {
    PieceCode code = c.encoded();
    harms[i](code);
    EXPECT_THROW(c.decoded(code), Error) << "harm " << i;
  }
}

}  // namespace

}  // namespace vitrail::piece_code_test
