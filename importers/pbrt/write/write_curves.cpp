// SPDX-License-Identifier: Apache-2.0
#include "importers/pbrt/write/write_curves.h"

#include <algorithm>
#include <cmath>

#include "importers/writing/text_sink.h"
#include "scene/shapes/curve_strands.h"

namespace vitrail::pbrt {

namespace {

// What pbrt's curves cannot say.
struct Differences {
  bool radii = false, ends = false, uvs = false;
};

double widest_of(std::span<const PlacedCurve> strand) {
  float widest = 0;
  for (const PlacedCurve& c : strand) widest = std::max(widest, *std::ranges::max_element(c.radius));
  return double{widest};
}

// Whether the radii of the whole go from the one to the other in equal steps, but for this much.
bool are_linear(const CurveSegment& s, double first, double step, double tolerance) {
  for (std::size_t k = 0; k < 4; ++k)
    if (!(std::abs(s[k].radius - (first + step * static_cast<double>(k))) <= tolerance)) return false;
  return true;
}
bool are_linear(const CurveSegment& s, double tolerance) {
  return are_linear(s, s[0].radius, (s[3].radius - s[0].radius) / 3, tolerance);
}

// A curve whose radii are cubic, in so many parts that they nearly are linear.
void append_parts(const CurveSegment& s, double widest, int halvings, std::vector<CurveSegment>& parts) {
  if (halvings == 0 || are_linear(s, 0.01 * widest)) return parts.push_back(s);
  CurveSegment first, second;
  halve(s, first, second);
  append_parts(first, widest, halvings - 1, parts);
  append_parts(second, widest, halvings - 1, parts);
}

class CurveWriter {
 public:
  CurveWriter(TextSink& out, const std::string& common, bool reversed, bool is_pbrt)
      : out_(out), common_(common), reversed_(reversed), is_pbrt_(is_pbrt) {}

  void write(std::span<const PlacedCurve> strand) {
    const bool reverse = strand.front().mirrored != reversed_;
    if (reverse != turned_) out_.put(FMT_COMPILE("ReverseOrientation\n"));
    turned_ = reverse;
    constexpr int most_halvings = 5;
    const double widest = widest_of(strand), rounding = 2e-6 * widest;
    std::vector<CurveSegment> segments;
    for (const PlacedCurve& c : strand) {
      const CurveSegment s = segment_of(c);
      const bool linear = are_linear(s, rounding);
      if (!linear) differences.radii = true;
      append_parts(s, widest, linear ? 0 : most_halvings, segments);
    }
    if (strand.front().straight && (strand.size() > 1 || strand.front().to[0] == Vector3f{}))
      differences.ends = true;
    std::size_t begin = 0;
    while (begin < segments.size()) {
      const std::size_t end = end_of_run(segments, begin, rounding);
      const bool whole = begin == 0 && end == segments.size() && segments.size() == strand.size() &&
                         strand.front().along_first == 0 && strand.back().along_last == 1;
      if (!whole || !is_pbrt_) differences.uvs = true;
      put(std::span(segments).subspan(begin, end - begin));
      begin = end;
    }
  }

  Differences differences;

 private:
  // Widths are linear along a whole curve.
  static std::size_t end_of_run(std::span<const CurveSegment> segments, std::size_t begin, double tolerance) {
    const double first = segments[begin][0].radius, step = (segments[begin][3].radius - first) / 3;
    std::size_t end = begin + 1;
    while (end < segments.size() &&
           are_linear(segments[end], first + step * 3 * static_cast<double>(end - begin), step, tolerance))
      ++end;
    return end;
  }

  void put_point(Point3d p) { out_.put(FMT_COMPILE(" {:.12g} {:.12g} {:.12g}"), p.x, p.y, p.z); }

  void put(std::span<const CurveSegment> run) {
    out_.put(FMT_COMPILE("Shape \"curve\" \"string type\" \"cylinder\" \"point3 P\" ["));
    put_point(run.front()[0].position);
    for (const CurveSegment& s : run)
      for (std::size_t k = 1; k < 4; ++k) put_point(s[k].position);
    const auto width = [](const CurvePoint& p) { return static_cast<float>(2 * p.radius); };
    out_.put(FMT_COMPILE(" ] \"float width0\" {} \"float width1\" {}{}\n"), width(run.front()[0]),
             width(run.back()[3]), common_);
  }

  TextSink& out_;
  const std::string& common_;
  bool reversed_, is_pbrt_, turned_ = false;
};

}  // namespace

std::string write_curves(Writer& w, const Shape& shape, bool uvs, Parameters& p) {
  const TriangleMesh& mesh = w.scene.meshes.at(shape.mesh.value);
  std::string name = w.new_file("meshes", "pbrt");
  AtomicFile file(w.directory / name);
  TextSink out(&file);
  CurveWriter curves(out, p.list(), shape.flip_orientation, mesh.quadric->uv == QuadricUv::pbrt);
  for_each_strand(*mesh.places, [&](std::span<const PlacedCurve> strand) { curves.write(strand); });
  out.flush();
  file.commit();
  if (curves.differences.radii)
    p.approximated("radii that are cubic along a curve become linear, within 1 % of the greatest");
  if (curves.differences.ends)
    p.approximated("straight segments become Bézier curves, which end across and not round or in a mitre");
  if (uvs && curves.differences.uvs)
    p.approximated("(u,v) of curves: pbrt's u goes from 0 to 1 on each, v around it");
  return name;
}

}  // namespace vitrail::pbrt
