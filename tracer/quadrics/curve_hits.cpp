// SPDX-License-Identifier: Apache-2.0
#include "tracer/quadrics/curve_hits.h"

#include <cmath>
#include <utility>

#include "scene/geometry/frame.h"
#include "scene/geometry/portable_math.h"
#include "tracer/quadrics/curve_parts.h"

namespace vitrail {

namespace {

// What a line has of a part. Not every beginning is a surface: some are planes that cut ends off.
struct Interval {
  double begin, end;
  bool at_surface;
};

// All below is about the line x = y = 0: z is a distance along it.
struct Hull {
  double begin = INFINITY, end = -INFINITY;

  void add_ball(const CurveBall& ball) {
    const double square = ball.radius * ball.radius - (ball.at.x * ball.at.x + ball.at.y * ball.at.y);
    if (!(square >= 0)) return;
    const double half = std::sqrt(square);
    begin = std::min(begin, ball.at.z - half);
    end = std::max(end, ball.at.z + half);
  }

  // The cone that touches both balls, between the circles where it does. With b from a's middle to c's, ρ =
  // the difference of the radii, D = b² − ρ² and (x,y) alone in a·b, a×b: its points at z from a's middle are
  //   k z² − 2 b_z g z + D (a² − r²) − g² = 0,   k = b_x² + b_y² − ρ²,   g = −(a·b) − ρ r,
  // whose discriminant is D (|r b + ρ a|² − (a×b)²); of b they are g + z b_z, which is in (0, D). It begins
  // at the root with −√: there the normal is against the line, whatever the sign of k.
  void add_cone(const CurveBall& a, const CurveBall& c) {
    const Vector3d b = c.at - a.at;
    const double rho = a.radius - c.radius, across = b.x * b.x + b.y * b.y;
    const double d = across + b.z * b.z - rho * rho;
    if (!(d > 0)) return;  // one ball holds the other
    const double side = a.at.x * b.y - a.at.y * b.x;
    const double vx = a.radius * b.x + rho * a.at.x, vy = a.radius * b.y + rho * a.at.y;
    const double square = vx * vx + vy * vy - side * side;
    if (!(square >= 0)) return;
    const double root = std::sqrt(d * square), k = across - rho * rho;
    const double g = -(a.at.x * b.x + a.at.y * b.y) - rho * a.radius, middle = b.z * g;
    const double product = d * (a.at.x * a.at.x + a.at.y * a.at.y - a.radius * a.radius) - g * g;
    // The root that does not cancel first; one is not finite where the line is a line of the cone.
    const double q = middle > 0 ? middle + root : middle - root;
    const double far = q / k, near = product / q;
    const double first = middle > 0 ? near : far, last = middle > 0 ? far : near;
    const auto on_cone = [&](double z) { return g + z * b.z > 0 && g + z * b.z < d; };
    if (on_cone(first)) begin = std::min(begin, a.at.z + first), end = std::max(end, a.at.z + first);
    if (on_cone(last)) begin = std::min(begin, a.at.z + last), end = std::max(end, a.at.z + last);
  }
};

class Line {
 public:
  // `slack`: more than rounding moves what is found of a part.
  Line(const CubicPart& whole, int levels, double widest, double slack, Vector3d first, Vector3d last)
      : widest_(widest), slack_(slack), first_(first), last_(last) {
    find(whole, levels, true, true);
  }

  // The overlapping as one, ascending.
  int merge() {
    int merged = 0;
    for (int i = 0; i < count_; ++i) {
      if (merged > 0 && found_[i].begin <= found_[merged - 1].end) {
        found_[merged - 1].end = std::max(found_[merged - 1].end, found_[i].end);
      } else {
        found_[merged++] = found_[i];
      }
    }
    return merged;
  }
  const Interval& operator[](int i) const { return found_[i]; }

 private:
  bool may_meet(const CubicPart& p) const {
    double least[2] = {INFINITY, INFINITY}, most[2] = {-INFINITY, -INFINITY};
    for (const CurveBall& b : p) {
      least[0] = std::min(least[0], b.at.x), most[0] = std::max(most[0], b.at.x);
      least[1] = std::min(least[1], b.at.y), most[1] = std::max(most[1], b.at.y);
    }
    return least[0] <= widest_ && most[0] >= -widest_ && least[1] <= widest_ && most[1] >= -widest_;
  }

  // Whether all of the part is on one side of its chord's direction as the line sees it.
  bool passes(const CubicPart& p) const {
    const double nx = p[0].at.y - p[3].at.y, ny = p[3].at.x - p[0].at.x;
    double least = INFINITY, most = -INFINITY, radius = 0;
    for (const CurveBall& b : p) {
      const double side = nx * b.at.x + ny * b.at.y;
      least = std::min(least, side), most = std::max(most, side);
      radius = std::max(radius, b.radius);
    }
    const double away = std::max(least, -most), reach = radius + slack_;
    return away > 0 && away * away > (nx * nx + ny * ny) * (reach * reach);
  }

  void find(const CubicPart& part, int level, bool has_first, bool has_last) {
    if (!may_meet(part) || passes(part)) return;
    if (level == 0) return add(part[0], part[3], has_first, has_last);
    CubicPart a, b;
    halve(part, a, b);
    find(a, level - 1, has_first, false);
    find(b, level - 1, false, has_last);
  }

  void add(const CurveBall& a, const CurveBall& b, bool has_first, bool has_last) {
    Hull hull;
    hull.add_ball(a);
    hull.add_ball(b);
    hull.add_cone(a, b);
    Interval found{hull.begin, hull.end, true};
    if (has_first) cut(first_, dot(a.at, first_), found);
    if (has_last) cut(last_ * -1.0, -dot(b.at, last_), found);
    if (!(found.begin <= found.end)) return;
    int i = count_++;
    for (; i > 0 && found_[i - 1].begin > found.begin; --i) found_[i] = found_[i - 1];
    found_[i] = found;
  }

  // Leaves what lies where x·normal ≥ least.
  static void cut(Vector3d normal, double least, Interval& found) {
    if (normal.x == 0 && normal.y == 0 && normal.z == 0) return;
    const double z = least / normal.z;
    if (normal.z > 0 && z > found.begin) found = {z, found.end, false};
    if (normal.z < 0) found.end = std::min(found.end, z);
    if (normal.z == 0 && least > 0) found.end = -INFINITY;
  }

  double widest_, slack_;
  Vector3d first_, last_;
  int count_ = 0;
  Interval found_[1 << most_halvings];
};

double sum_of(Vector3d v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

// A length that the curve and the line's part near it do not exceed.
double size_of(const PlacedCurve& c, double widest) {
  double size = widest;
  for (const Vector3f& to : c.to) size += sum_of(cast<double>(to));
  return size;
}

// Chords of a cubic between so many equal steps of its parameter; lanes are filled up.
constexpr int chords = 16, lanes = 20;
struct Bernstein {
  float of[4][lanes];
};
constexpr Bernstein bernstein_at_steps() {
  Bernstein w{};
  for (int i = 0; i <= chords; ++i) {
    const double t = static_cast<double>(i) / chords, u = 1 - t;
    const double values[4] = {u * u * u, 3 * u * u * t, 3 * u * t * t, t * t * t};
    for (int k = 0; k < 4; ++k) w.of[k][i] = static_cast<float>(values[k]);
  }
  return w;
}
constexpr Bernstein weights = bernstein_at_steps();

// Whether the line is further than `reach` from all chords, in floats: that has to exceed what they round.
bool passes_chords(const CubicPart& whole, double reach_of_all) {
  float px[4], py[4], x[lanes], y[lanes];
  for (std::size_t k = 0; k < 4; ++k)
    px[k] = static_cast<float>(whole[k].at.x), py[k] = static_cast<float>(whole[k].at.y);
  for (int i = 0; i < lanes; ++i) {
    x[i] = weights.of[0][i] * px[0] + weights.of[1][i] * px[1] + weights.of[2][i] * px[2] +
           weights.of[3][i] * px[3];
    y[i] = weights.of[0][i] * py[0] + weights.of[1][i] * py[1] + weights.of[2][i] * py[2] +
           weights.of[3][i] * py[3];
  }
  const auto reach = static_cast<float>(reach_of_all);
  int near = 0;
  for (int i = 0; i < chords; ++i) {
    const float ex = x[i + 1] - x[i], ey = y[i + 1] - y[i];
    const float square = ex * ex + ey * ey, size = std::sqrt(square), wide = reach * size;
    const float beside = std::abs(x[i] * ey - y[i] * ex), along = -(x[i] * ex + y[i] * ey);
    near |= static_cast<int>(beside <= wide) & static_cast<int>(along >= -wide) &
            static_cast<int>(along <= square + wide);
  }
  return near == 0;
}

}  // namespace

QuadricHits curve_hits(Vector3d origin, Vector3d direction, const PlacedCurve& c, bool starts_there) {
  QuadricHits hits;
  const double widest = greatest_radius(c), speed = length(direction);
  if (!(widest > 0)) return hits;
  const Frame axes(direction * (1 / speed));
  const Vector3d z = axes.normal;
  // From the point of the line that is nearest to the middle of the curve nothing is large.
  const Vector3d end = cast<double>(c.to[2]);
  const double nearest = dot(end * 0.5 - origin, z);
  const Vector3d base = origin + z * nearest;
  const auto seen = [&](Vector3d p) {
    return Vector3d{dot(p, axes.tangent), dot(p, axes.bitangent), dot(p, z)};
  };
  CubicPart whole;
  whole[0] = {seen(base * -1.0), double{c.radius[0]}};
  for (std::size_t i = 0; i < 3; ++i)
    whole[i + 1] = {seen(cast<double>(c.to[i]) - base), double{c.radius[i + 1]}};
  if (c.straight) whole[1] = whole[0], whole[2] = whole[3];
  // What is decided below is off by rounding, of squares too, of which the roots are within 10⁻⁷ of the size.
  const double size = size_of(c, widest), slack = 1e-6 * size;
  double last = -INFINITY;
  for (const CurveBall& b : whole) last = std::max(last, b.at.z);
  if (nearest + last + widest + slack < 0) return hits;
  const int levels = halvings(c, widest);
  if (levels >= 2) {
    const double off = std::sqrt(squared_chord_error(c));
    if (passes_chords(whole, widest + off / (chords * chords) + off / (1 << 2 * levels) + 10 * slack))
      return hits;
  }
  Line line(whole, levels, widest, slack, seen(first_plane(c)), seen(last_plane(c)));
  const int count = line.merge();
  int next = 0;
  if (starts_there && count > 0) {
    double least = INFINITY;
    for (int i = 0; i < count; ++i) {
      const double to_start = std::min(std::abs(line[i].begin + nearest), std::abs(line[i].end + nearest));
      if (to_start < least) least = to_start, next = i + 1;
    }
    // Where it grazes the curve so that the line does not meet that there, it starts nowhere.
    if (least > 2 * widest) next = 0;
  }
  for (int i = next; i < count; ++i) {
    const double t = (nearest + line[i].begin) / speed;
    if (!line[i].at_surface || !(t > 0) || !std::isfinite(t)) continue;
    hits.at[hits.count++] = {t, Point3d{} + base + z * line[i].begin};
    break;
  }
  return hits;
}

namespace {

struct Foot {
  CurveBall ball;
  double s;  // of the segment, from 0 to 1
};

// The ball of a part's that touches its surface nearest to p, and how far p is off.
double off(Vector3d p, const CurveBall& a, const CurveBall& b, double& along, CurveBall& ball) {
  const Vector3d chord = b.at - a.at, from = p - a.at;
  const double size = length(chord), rho = a.radius - b.radius;
  if (!(size > std::abs(rho))) {
    along = rho > 0 ? 0 : 1;
  } else {
    const double y = dot(from, chord) / size, sine = rho / size;
    const double radial = std::sqrt(std::max(0.0, dot(from, from) - y * y));
    along = std::clamp((y - radial * sine / std::sqrt(1 - sine * sine)) / size, 0.0, 1.0);
  }
  ball = {a.at + chord * along, a.radius - rho * along};
  return std::abs(length(p - ball.at) - ball.radius);
}

CurveBall at(const CubicPart& c, double s, CurveBall& derivative) {
  const auto mix = [s](const CurveBall& a, const CurveBall& b) {
    return CurveBall{a.at * (1 - s) + b.at * s, a.radius * (1 - s) + b.radius * s};
  };
  const CurveBall bc = mix(c[1], c[2]);
  const CurveBall first = mix(mix(c[0], c[1]), bc), second = mix(bc, mix(c[2], c[3]));
  derivative = {(second.at - first.at) * 3.0, (second.radius - first.radius) * 3};
  return mix(first, second);
}

CubicPart own_space(const PlacedCurve& c) {
  const CurveSegment segment = segment_of(c);
  CubicPart part;
  for (std::size_t i = 0; i < 4; ++i) part[i] = {segment[i].position - c.origin, segment[i].radius};
  return part;
}

class NearestFoot {
 public:
  // Of parts that are further than `within` off, none.
  NearestFoot(const CubicPart& cubic, Vector3d p, int levels, double within)
      : cubic_(cubic), p_(p), within_(within), parts_(1 << levels) {
    find(cubic, levels, 0);
  }

  Foot best{};
  double least = INFINITY;  // how far it is off

 private:
  bool may_be_near(const CubicPart& part) const {
    double radius = 0;
    for (const CurveBall& b : part) radius = std::max(radius, b.radius);
    for (int axis = 0; axis < 3; ++axis) {
      double low = INFINITY, high = -INFINITY;
      for (const CurveBall& b : part) low = std::min(low, b.at[axis]), high = std::max(high, b.at[axis]);
      if (low - p_[axis] > radius + within_ || p_[axis] - high > radius + within_) return false;
    }
    return true;
  }

  void find(const CubicPart& part, int level, int first) {
    if (!may_be_near(part)) return;
    if (level == 0) return look_at(first);
    CubicPart a, b;
    halve(part, a, b);
    find(a, level - 1, first);
    find(b, level - 1, first + (1 << (level - 1)));
  }

  void look_at(int i) {
    CurveBall derivative;
    const CurveBall a = i == 0 ? cubic_[0] : at(cubic_, static_cast<double>(i) / parts_, derivative),
                    b = at(cubic_, (i + 1.0) / parts_, derivative);
    double along;
    CurveBall ball;
    const double distance = off(p_, a, b, along, ball);
    if (distance < least) least = distance, best = {ball, (i + along) / parts_};
  }

  const CubicPart& cubic_;
  Vector3d p_;
  double within_;
  int parts_;
};

Foot foot_of(const PlacedCurve& c, const CubicPart& cubic, Vector3d p) {
  const double widest = greatest_radius(c), near = 0.01 * widest;
  const int levels = halvings(c, widest);
  const NearestFoot found(cubic, p, levels, near);
  if (found.least < 0.5 * near) return found.best;  // the others are further off, whatever rounding does
  return NearestFoot(cubic, p, levels, INFINITY).best;
}

}  // namespace

QuadricPoint curve_point(const PlacedCurve& c, Point3d local, bool along_v, bool inside_out) {
  const CubicPart cubic = own_space(c);
  const Foot foot = foot_of(c, cubic, local - Point3d{});
  CurveBall derivative;
  at(cubic, foot.s, derivative);
  if (!(length(derivative.at) > 0)) derivative.at = cubic[3].at;
  const double speed = length(derivative.at);
  const Vector3d tangent = speed > 0 ? derivative.at * (1 / speed) : Vector3d{0, 0, 1};
  const Vector3d out = normalize(local - Point3d{} - foot.ball.at);
  // Around the curve itself, not around its parts.
  const Vector3d across = out - tangent * dot(out, tangent);
  const double width = length(across);
  Vector3d smooth = out;
  if (!c.straight && width > 0.1)
    smooth = normalize(across * (1 / width) - tangent * (speed > 0 ? derivative.radius / speed : 0));
  const Frame axes(tangent);
  const double angle = portable_atan2(dot(out, axes.tangent), dot(out, axes.bitangent));
  const double turn = (angle < 0 ? angle + 2 * pi : angle) / (2 * pi);
  const double range = double{c.along_last} - double{c.along_first};
  QuadricPoint point;
  point.p = c.origin + foot.ball.at + out * foot.ball.radius;
  const bool flipped = c.mirrored != inside_out;
  point.normal = flipped ? -out : out;
  point.shading = flipped ? -smooth : smooth;
  point.uv = {double{c.along_first} + range * foot.s, turn};
  point.dpdu = range != 0 ? derivative.at * (1 / range) : derivative.at;
  point.dpdv = cross(tangent, smooth) * (2 * pi * foot.ball.radius);
  if (along_v) {
    std::swap(point.uv.x, point.uv.y);
    std::swap(point.dpdu, point.dpdv);
  }
  return point;
}

}  // namespace vitrail
