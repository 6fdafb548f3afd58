// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/write/write_curves.h"

#include <cmath>

#include "importers/writing/text_sink.h"
#include "scene/records/curve_uses.h"
#include "scene/shapes/curve_strands.h"

namespace vitrail::mitsuba_writer {

namespace {

CurvePoint combined(const CurveSegment& s, const std::array<double, 4>& weights) {
  CurvePoint sum;
  Vector3d at{};
  for (std::size_t k = 0; k < 4; ++k) {
    at = at + (s[k].position - s[0].position) * weights[k];
    sum.radius += s[k].radius * weights[k];
  }
  sum.position = s[0].position + at;
  return sum;
}

// The uniform cubic B-spline that is this Bézier curve: the inverse of bspline_segments(). Radii may get
// negative there, as Mitsuba allows.
CurveSegment bspline_points(const CurveSegment& s) {
  return {combined(s, {6, -7, 2, 0}), combined(s, {0, 2, -1, 0}), combined(s, {0, -1, 2, 0}),
          combined(s, {0, 2, -7, 6})};
}

// A file of curves of one kind.
class CurveFileWriter {
 public:
  CurveFileWriter(const std::filesystem::path& path, double segments)
      : file_(path), out_(&file_), segments_(segments) {}

  void write(std::span<const PlacedCurve> strand, const Transform& to_world) {
    begin_curve();
    for (const PlacedCurve& c : strand) {
      if (std::abs(double{c.along_first} * segments_ - done) > 1e-4 * (done + 1)) v_differs = true;
      if (std::abs(double{c.along_last} * segments_ - (done + 1)) > 1e-4 * (done + 1)) v_differs = true;
      ++done;
      const PlacedCurve placed = transformed(to_world, c);
      placed.straight ? add_straight(placed) : add_cubic(placed);
    }
  }
  void commit() {
    out_.flush();
    file_.commit();
  }

  bool v_differs = false;
  double done = 0;  // segments

 private:
  void begin_curve() {
    if (count_ > 0) out_.put(FMT_COMPILE("\n"));
    count_ = 0;
  }

  void put(const CurvePoint& p) {
    out_.put(FMT_COMPILE("{:.12g} {:.12g} {:.12g} {:.9g}\n"), p.position.x, p.position.y, p.position.z,
             p.radius);
    for (std::size_t k = 0; k < 2; ++k) last_[k] = last_[k + 1];
    last_[2] = p;
    ++count_;
  }

  void add_straight(const PlacedCurve& c) {
    const CurveSegment s = segment_of(c);
    if (count_ == 0) put(s[0]);
    put(s[3]);
  }

  // Where it goes on as smoothly as a B-spline does, by one point.
  void add_cubic(const PlacedCurve& c) {
    const CurveSegment points = bspline_points(segment_of(c));
    double size = 0, widest = 0;
    for (const Vector3f& to : c.to) size = std::max(size, length(cast<double>(to)));
    for (const float r : c.radius) widest = std::max(widest, double{r});
    bool goes_on = count_ >= 4;
    for (std::size_t k = 0; k < 3; ++k)
      goes_on = goes_on && length(last_[k].position - points[k].position) <= smooth * size &&
                std::abs(last_[k].radius - points[k].radius) <= smooth * widest;
    if (goes_on) return put(points[3]);
    begin_curve();
    for (const CurvePoint& p : points) put(p);
  }

  static constexpr double smooth = 4e-6;  // records are in floats, which the weights above add up

  AtomicFile file_;
  TextSink out_;
  double segments_;
  std::size_t count_ = 0;  // points of the curve that is being written
  std::array<CurvePoint, 3> last_;
};

struct Kinds {
  std::size_t cubic = 0, straight = 0;
  bool open_ends = false, any_inside = false;
};

Kinds kinds_of(const QuadricPlaces& curves, bool flipped) {
  Kinds kinds;
  for_each_strand(curves, [&](std::span<const PlacedCurve> strand) {
    const PlacedCurve& first = strand.front();
    (first.straight ? kinds.straight : kinds.cubic) += strand.size();
    if (first.straight && !(first.to[0] == Vector3f{})) kinds.open_ends = true;
    if (first.mirrored != flipped) kinds.any_inside = true;
  });
  return kinds;
}

}  // namespace

std::vector<Element> add_curves(Context& context, Element parent, const Shape& shape, bool sides_matter,
                                const std::string& id) {
  const Transform& to_world = shape.object_to_world;
  if (!is_of_curves(context.scene, shape) || shape.area_light || !is_similarity(to_world)) return {};
  const TriangleMesh& mesh = context.scene.meshes[shape.mesh.value];
  const Kinds kinds = kinds_of(*mesh.places, shape.flip_orientation != swaps_handedness(to_world));
  if (sides_matter && kinds.any_inside) return {};  // Mitsuba's front is outside
  std::vector<Element> elements;
  bool v_differs = mesh.quadric->uv != QuadricUv::mitsuba;
  for (const bool straight : {false, true}) {
    const std::size_t count = straight ? kinds.straight : kinds.cubic;
    if (count == 0) continue;
    const std::string name = context.new_file("meshes", "txt", context.curve_files);
    CurveFileWriter file(context.file.parent_path() / name, static_cast<double>(count));
    for_each_strand(*mesh.places, [&](std::span<const PlacedCurve> strand) {
      if (strand.front().straight == straight) file.write(strand, to_world);
    });
    file.commit();
    v_differs = v_differs || file.v_differs;
    elements.push_back(
        add(parent, "shape", straight ? "linearcurve" : "bsplinecurve", "", elements.empty() ? id : ""));
    add_string(elements.back(), "filename", name);
  }
  if (kinds.open_ends) context.approximated("open ends of straight curves become half balls");
  if (v_differs && context.uv_uses_of_curves.of(shape))
    context.approximated("(u,v) of curves: Mitsuba's v goes from 0 to 1 along all of a file, u around them");
  return elements;
}

}  // namespace vitrail::mitsuba_writer
