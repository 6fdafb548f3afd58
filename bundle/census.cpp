// SPDX-License-Identifier: Apache-2.0
#include "bundle/census.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace vitrail {

namespace {

constexpr std::uint32_t seen_whole = 1, seen_as_piece = 2;

// That nine roundings of a vertex, across the longest edge, change by a millionth.
double least_area(const std::array<Point3d, 3>& v) {
  const double edge = std::max({length(v[1] - v[0]), length(v[2] - v[1]), length(v[0] - v[2])});
  double greatest = edge;
  for (const Point3d& p : v) greatest = std::max({greatest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return 1e-9 * edge * greatest;
}

}  // namespace

double polygon_area(std::span<const Point3d> polygon) {
  Vector3d sum;
  for (std::size_t i = 2; i < polygon.size(); ++i)
    sum = sum + cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return length(sum) / 2;
}

Census::Census(std::uint64_t triangles, std::vector<IdRange> absent)
    : absent_(std::move(absent)), ids_(triangles), triangles_(triangles) {
  for (const IdRange& range : absent_) {
    absent_before_.push_back(ids_ - triangles_);
    triangles_ -= range.count;
  }
  seen_ = std::make_unique<std::atomic<std::uint32_t>[]>((triangles_ + 15) / 16);
}

std::optional<std::uint64_t> Census::place_of(std::uint32_t id) const {
  if (id >= ids_) return std::nullopt;
  const auto after = std::ranges::upper_bound(absent_, std::uint64_t{id}, {}, &IdRange::first);
  if (after == absent_.begin()) return id;
  const IdRange& range = after[-1];
  if (id < range.first + range.count) return std::nullopt;
  return id - absent_before_[static_cast<std::size_t>(after - absent_.begin()) - 1] - range.count;
}

std::uint32_t Census::mark(std::uint64_t place, std::uint32_t bits) {
  const auto shift = static_cast<std::uint32_t>(2 * (place % 16));
  return (seen_[place / 16].fetch_or(bits << shift, std::memory_order_relaxed) >> shift) & 3;
}

void Census::add(std::uint32_t domain, const DomainView& view, std::span<const Piece> pieces,
                 std::span<const Point3d> piece_vertices) {
  std::vector<CutPart> parts;
  std::uint64_t duplicates = 0, strays = 0;
  auto piece = pieces.begin();
  for (const Cluster& cluster : view.clusters)
    for (std::size_t lane = 0; lane < cluster_width; ++lane) {
      const std::uint32_t id = cluster.id[lane];
      const auto place = place_of(id);
      if (!place) {
        strays += id != no_triangle;
        continue;
      }
      const bool cut = piece != pieces.end() && piece->triangle == id;
      const std::uint32_t before = mark(*place, cut ? seen_as_piece : seen_whole);
      if (cut ? (before & seen_whole) != 0 : before != 0) ++duplicates;
      if (!cut) continue;
      const std::array<Point3d, 3> v = triangle_in(cluster, lane);
      parts.push_back({id, domain, polygon_area(v), least_area(v),
                       polygon_area(piece_vertices.subspan(piece->first_vertex, piece->vertex_count))});
      ++piece;
    }
  strays += static_cast<std::uint64_t>(pieces.end() - piece);
  std::sort(parts.begin(), parts.end(),
            [](const CutPart& a, const CutPart& b) { return a.triangle < b.triangle; });
  for (std::size_t i = 1; i < parts.size(); ++i) duplicates += parts[i].triangle == parts[i - 1].triangle;
  duplicates_ += duplicates;
  strays_ += strays;
  const std::lock_guard lock(mutex_);
  parts_.insert(parts_.end(), parts.begin(), parts.end());
}

bool Census::in_order(const CutPart& a, const CutPart& b) {
  return std::tie(a.triangle, a.domain) < std::tie(b.triangle, b.domain);
}

void Census::sum_up(std::vector<CutPart> parts, CensusResult& r) {
  r.pieces += parts.size();
  std::ranges::sort(parts, in_order);
  for (std::size_t i = 0; i < parts.size(); ++r.cut_triangles) {
    const CutPart& first = parts[i];
    double sum = 0;
    for (; i < parts.size() && parts[i].triangle == first.triangle; ++i) sum += parts[i].area;
    const double scale = std::max(first.triangle_area, first.least_area);
    if (scale > 0) r.area_error = std::max(r.area_error, std::abs(first.triangle_area - sum) / scale);
  }
}

void Census::settle(std::span<const std::uint32_t> open) {
  const std::lock_guard lock(mutex_);
  const auto from = parts_.begin() + static_cast<std::ptrdiff_t>(open_);
  const auto first_settled = std::partition(from, parts_.end(), [&](const CutPart& part) {
    return std::binary_search(open.begin(), open.end(), part.triangle);
  });
  sum_up({first_settled, parts_.end()}, settled_);
  parts_.erase(first_settled, parts_.end());
  std::ranges::sort(parts_, in_order);
  // Domains come in their order: a sum of the first parts is the beginning of the sum of all.
  std::size_t last = 0;
  for (std::size_t i = 1; i < parts_.size(); ++i) {
    if (parts_[i].triangle == parts_[last].triangle) {
      parts_[last].area += parts_[i].area;
      parts_[last].domain = parts_[i].domain;
      ++settled_.pieces;
    } else {
      parts_[++last] = parts_[i];
    }
  }
  parts_.resize(std::min(parts_.size(), last + 1));
  open_ = parts_.size();
}

CensusResult Census::result() const {
  CensusResult r = settled_;
  r.duplicates = duplicates_;
  r.strays = strays_;
  for (std::uint64_t i = 0; i < triangles_; ++i)
    r.lost += ((seen_[i / 16].load(std::memory_order_relaxed) >> (2 * (i % 16))) & 3) == 0;
  sum_up(parts_, r);
  return r;
}

}  // namespace vitrail
