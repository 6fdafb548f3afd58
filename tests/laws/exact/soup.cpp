// SPDX-License-Identifier: Apache-2.0
#include "tests/laws/exact/soup.h"

#include <bit>
#include <limits>
#include <numeric>

#include "partitioner/cutting/kd_plan.h"
#include "partitioner/cutting/work_estimate.h"

namespace vitrail::test {

std::uint64_t SoupRandom::bits() {
  std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
  z = (z ^ z >> 27) * 0x94d049bb133111ebu;
  return z ^ z >> 31;
}

Vector3d SoupRandom::vector(double size) {
  const double x = uniform(-size, size), y = uniform(-size, size);
  return {x, y, uniform(-size, size)};
}

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

float beside(SoupRandom& random, float x) {
  const std::size_t way = random.below(4);
  return way == 0 ? std::nextafter(x, infinity) : way == 1 ? std::nextafter(x, -infinity) : x;
}

class Cook {
 public:
  explicit Cook(std::uint64_t seed) : random_(seed) { soup_.seed = seed; }

  Soup cook() {
    choose_size();
    const std::size_t count = choose_count();
    std::vector<Recipe> recipes;
    for (const Recipe recipe : all_recipes)
      if (random_.chance(0.35)) recipes.push_back(recipe);
    if (recipes.empty()) recipes.push_back(&Cook::plain);
    while (triangles().size() < count) (this->*recipes[random_.below(recipes.size())])();
    triangles().resize(count);
    soup_.domains = random_.chance(0.1) ? 1 : static_cast<std::uint32_t>(random_.log_uniform(2, 65));
    soup_.any_planes = count > 0 && random_.chance(0.3);
    if (random_.chance(0.3)) move_to_planes();
    if (random_.chance(0.05)) make_subnormal();
    return std::move(soup_);
  }

 private:
  using Recipe = void (Cook::*)();
  static const std::array<Recipe, 12> all_recipes;

  Triangles& triangles() { return soup_.triangles; }

  void choose_size() {
    const double kind = random_.unit();
    double& reach = soup_.reach;
    if (kind < 0.65) {
      reach = random_.log_uniform(1e-6, 1e7);
    } else if (kind < 0.97) {
      reach = std::exp2(static_cast<double>(random_.below(41)) - 20);
    } else {
      reach = random_.chance(0.5) ? random_.log_uniform(1e-44, 1e-6) : random_.log_uniform(1e7, 1e15);
    }
    if (random_.chance(0.35)) step_ = reach / static_cast<double>(1u << random_.below(6));
    if (random_.chance(0.25)) offset_ = random_.vector(reach * random_.log_uniform(1, 1e7));
    if (step_ > 0 && random_.chance(0.7)) offset_ = {};
  }

  std::size_t choose_count() {
    if (random_.chance(0.005)) return 0;
    if (random_.chance(0.02)) return 1;
    return static_cast<std::size_t>(random_.log_uniform(2, random_.chance(0.1) ? 400 : 80));
  }

  Point3d anywhere() { return Point3d{} + random_.vector(soup_.reach); }
  double any_size() { return soup_.reach * random_.log_uniform(1e-6, 1); }

  float rounded(double x, double offset) const {
    if (step_ > 0) x = std::round(x / step_) * step_;
    return static_cast<float>(std::clamp(x + offset, -1e15, 1e15)) + 0.0f;
  }
  Point3f rounded(Point3d p) const {
    return {rounded(p.x, offset_.x), rounded(p.y, offset_.y), rounded(p.z, offset_.z)};
  }
  void add(Point3d a, Point3d b, Point3d c) { triangles().push_back({rounded(a), rounded(b), rounded(c)}); }

  const Triangle* any_triangle() {
    if (triangles().empty()) plain();
    return &triangles()[random_.below(triangles().size())];
  }
  // Where it was before it was rounded, or near.
  Point3d unrounded(Point3f p) const { return cast<double>(p) - offset_; }
  Point3d any_vertex() { return unrounded((*any_triangle())[random_.below(3)]); }

  void plain() {
    const Point3d p = anywhere();
    const double size = any_size();
    add(p + random_.vector(size), p + random_.vector(size), p + random_.vector(size));
  }
  // The sizes of 10⁻⁶ and 10⁷ in one scene.
  void of_any_size() {
    const double size = random_.log_uniform(1e-6, 1e7);
    const Point3d p = Point3d{} + random_.vector(random_.chance(0.5) ? size : soup_.reach);
    add(p + random_.vector(size), p + random_.vector(size), p + random_.vector(size));
  }
  void giant() {
    const double size = soup_.reach * random_.log_uniform(2, 1000);
    add(Point3d{} + random_.vector(size), Point3d{} + random_.vector(size), Point3d{} + random_.vector(size));
  }
  void needle() {
    const Point3d p = random_.chance(0.3) ? any_vertex() : anywhere();
    const double size = random_.chance(0.3) ? soup_.reach : any_size();
    const Vector3d along = random_.vector(size);
    add(p, p + along, p + along * random_.unit() + random_.vector(size * random_.log_uniform(1e-10, 1e-3)));
  }
  void without_area() {
    const Point3d p = any_vertex(), q = anywhere();
    const std::size_t kind = random_.below(4);
    if (kind == 0) add(p, p, p);
    if (kind == 1) add(p, q, p);
    if (kind == 2) add(p, q, p + (q - p) * 0.5);
    if (kind == 3) add(p, p + (q - p) * 3.0, q);
  }
  void same_again() {
    Triangle t = *any_triangle();
    std::rotate(t.begin(), t.begin() + static_cast<std::ptrdiff_t>(random_.below(3)), t.end());
    if (random_.chance(0.5)) std::swap(t[0], t[1]);
    triangles().push_back(t);
  }
  void coplanar() {
    const Triangle& t = *any_triangle();
    const Point3d p = unrounded(t[0]);
    const Vector3d a = unrounded(t[1]) - p, b = unrounded(t[2]) - p;
    const auto half = [&] { return static_cast<double>(random_.below(7)) / 2 - 1; };
    add(p + a * half(), p + a + b * half(), p + b + a * half());
  }
  void fan() {
    const Point3d p = any_vertex();
    const double size = any_size();
    const Point3d first = p + random_.vector(size);
    Point3d last = first;
    for (std::size_t i = random_.below(12); i > 0; --i) {
      const Point3d next = i == 1 ? first : p + random_.vector(size);
      add(p, last, next);
      last = next;
    }
  }
  void junction() {
    const Triangle& t = *any_triangle();
    const Point3d p = unrounded(t[0]), q = unrounded(t[1]), middle = p + (q - p) * 0.5;
    const Point3d beyond = middle + random_.vector(length(q - p));
    add(p, middle, beyond);
    add(middle, q, beyond);
  }
  void sheet() {
    const auto axis = static_cast<int>(random_.below(3));
    const std::size_t n = 1 + random_.below(4);
    const double size = step_ > 0 ? step_ : any_size();
    const Point3d corner = random_.chance(0.5) ? any_vertex() : anywhere();
    const Vector3d tilt = random_.chance(0.7) ? Vector3d{} : random_.vector(0.1);
    const auto at = [&](std::size_t i, std::size_t j) {
      const double u = size * static_cast<double>(i), v = size * static_cast<double>(j);
      Vector3d d = tilt * (u + 2 * v);
      d[(axis + 1) % 3] += u;
      d[(axis + 2) % 3] += v;
      return corner + d;
    };
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) {
        add(at(i, j), at(i + 1, j), at(i + 1, j + 1));
        add(at(i, j), at(i + 1, j + 1), at(i, j + 1));
      }
  }
  void tetrahedron() {
    const Point3d p = anywhere();
    const double size = random_.chance(0.5) ? soup_.reach : any_size();
    std::array<Point3d, 4> v;
    for (Point3d& q : v) q = p + random_.vector(size);
    add(v[0], v[1], v[2]);
    add(v[0], v[3], v[1]);
    add(v[1], v[3], v[2]);
    add(v[2], v[3], v[0]);
  }
  // In the plane of an axis through a vertex.
  void upright() {
    const auto axis = static_cast<int>(random_.below(3));
    std::array<Point3d, 3> v{anywhere(), anywhere(), any_vertex()};
    v[0][axis] = v[1][axis] = v[2][axis];
    add(v[0], v[1], v[2]);
  }

  // Vertices into the planes at which the soup would be cut.
  void move_to_planes() {
    if (soup_.domains == 1) return;
    std::vector<Bounds3f> boxes;
    Bounds3f bounds;
    for (const Triangle& t : triangles()) {
      Bounds3f& box = boxes.emplace_back();
      for (const Point3f& v : t) extend(box, v);
      extend(bounds, box);
    }
    std::vector<KdNode> nodes(soup_.domains - 1);
    const double share = static_cast<double>(boxes.size()) / soup_.domains;
    if (soup_.any_planes)
      nodes = any_planes(soup_, bounds);
    else
      plan_kd_tree(WorkEstimate().items(boxes), {bounds, 0, 0, soup_.domains}, {share}, nodes);
    for (const KdNode& node : nodes)
      for (std::size_t k = random_.below(3); k > 0 && !triangles().empty(); --k) {
        const Point3f from = (*any_triangle())[random_.below(3)];
        Point3f to = from;
        to[static_cast<int>(node.axis)] = beside(random_, node.split) + 0.0f;
        for (Triangle& t : triangles()) std::replace(t.begin(), t.end(), from, to);
      }
  }

  void make_subnormal() {
    for (Triangle& t : triangles())
      for (Point3f& p : t)
        for (int axis = 0; axis < 3; ++axis)
          if (random_.chance(0.2))
            p[axis] = static_cast<float>(random_.sign() * random_.log_uniform(1e-45, 1e-37)) + 0.0f;
  }

  SoupRandom random_;
  Soup soup_;
  double step_ = 0;  // of the lattice that vertices lie on, 0: none
  Vector3d offset_;
};

const std::array<Cook::Recipe, 12> Cook::all_recipes{&Cook::plain,    &Cook::of_any_size,  &Cook::giant,
                                                     &Cook::needle,   &Cook::without_area, &Cook::same_again,
                                                     &Cook::coplanar, &Cook::fan,          &Cook::junction,
                                                     &Cook::sheet,    &Cook::tetrahedron,  &Cook::upright};

class PlaneMaker {
 public:
  PlaneMaker(const Soup& soup, std::vector<KdNode>& nodes)
      : soup_(soup), nodes_(nodes), random_(soup.seed ^ 0x5eed) {}

  std::uint32_t divide(std::uint32_t node, std::uint32_t first, std::uint32_t domains, const Bounds3f& cell) {
    if (domains == 1) return KdNode::leaf_bit | first;
    const std::uint32_t half = domains / 2;
    const auto axis = static_cast<int>(random_.below(3));
    const float split = plane(cell, axis);
    Bounds3f low = cell, high = cell;
    low.upper[axis] = high.lower[axis] = split;
    const std::uint32_t below = divide(node + 1, first, half, low);
    const std::uint32_t above = divide(node + half, first + half, domains - half, high);
    nodes_[node] = {split, static_cast<std::uint32_t>(axis), below, above};
    return node;
  }

 private:
  float plane(const Bounds3f& cell, int axis) {
    const float lower = cell.lower[axis], upper = cell.upper[axis];
    float split = random_.chance(0.2)
                      ? std::midpoint(lower, upper)
                      : static_cast<float>(double{lower} + (double{upper} - lower) * random_.unit());
    if (random_.chance(0.6))
      split = beside(random_, soup_.triangles[random_.below(soup_.triangles.size())][random_.below(3)][axis]);
    return std::clamp(split, lower, upper) + 0.0f;
  }

  const Soup& soup_;
  std::vector<KdNode>& nodes_;
  SoupRandom random_;
};

}  // namespace

Soup soup_of(std::uint64_t seed) { return Cook(seed).cook(); }

std::vector<KdNode> any_planes(const Soup& soup, const Bounds3f& bounds) {
  std::vector<KdNode> nodes(soup.domains - 1);
  if (!soup.triangles.empty()) PlaneMaker(soup, nodes).divide(0, 0, soup.domains, bounds);
  return nodes;
}

}  // namespace vitrail::test
