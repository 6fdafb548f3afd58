// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/read/view.h"

#include <cmath>
#include <numbers>

#include "importers/povray/read/reader.h"

namespace vitrail::pov {

namespace {

Vector3d turned(const Transform& t, Vector3d v) { return transform_vector(t, v); }

void move(CameraView& c, const Transform& t) {
  c.location = transform_point(t, Point3d{} + c.location) - Point3d{};
  c.focal_point = transform_point(t, Point3d{} + c.focal_point) - Point3d{};
  c.direction = turned(t, c.direction), c.right = turned(t, c.right), c.up = turned(t, c.up),
  c.sky = turned(t, c.sky);
}

// Turns the camera so that it looks at the point with `sky` above; lengths stay, and the hand of `right`.
void look_at(Reader& reader, CameraView& c, Vector3d target) {
  const Vector3d to = target - c.location;
  if (!(length(to) > 0)) return;
  const double far = length(c.direction), wide = length(c.right), high = length(c.up);
  // Where they lie in a plane, as after `up z` alone, POV-Ray shows what the opposite would show.
  const bool left = dot(cross(c.up, c.direction), c.right) <= 0;
  c.direction = normalize(to);
  Vector3d right = cross(c.sky, c.direction);
  if (!(length(right) > 1e-9)) {  // it looks along the sky
    right = cross(
        std::abs(c.direction.y) > 0.9 ? Vector3d{0, 0, c.direction.y > 0 ? -1.0 : 1.0} : Vector3d{0, 1, 0},
        c.direction);
    if (!(length(right) > 0)) reader.fail("the camera looks along its sky", c.place);
  }
  right = normalize(right);
  c.up = cross(c.direction, right) * high;
  c.right = right * (left ? -wide : wide);
  c.direction = c.direction * far;
}

// An orthographic view of an angle is as wide as a perspective one is at the distance of what it looks at,
// whatever `right` says; without look_at that is <0,0,1>. Measured with povray 3.7.
void size_by_angle(CameraView& c, Vector3d target) {
  const double wide = 2 * length(target - c.location) * std::tan(c.angle * std::numbers::pi / 360);
  if (!(wide > 0)) return;
  const double factor = wide / length(c.right);
  c.right = c.right * factor, c.up = c.up * factor;
  c.angle = 0;  // once: what transforms the camera comes after it
}

// Without an angle, and with neither `right` nor `up`, it is as large as a perspective view is there.
void size_by_distance(CameraView& c, Vector3d target) {
  const double factor = length(target - c.location) / length(c.direction);
  if (factor > 0 && std::isfinite(factor)) c.right = c.right * factor, c.up = c.up * factor;
}

}  // namespace

Shared<CameraView> read_camera_block(Reader& reader) {
  if (const auto named = reader.identifier<Shared<CameraView>>()) return *named;
  reader.expect('{', "behind camera");
  CameraView c;
  c.place = reader.here();
  std::optional<Vector3d> target;
  bool sized = false;
  const auto settle = [&] {
    if (c.angle > 0 && c.kind == Word::perspective_ && c.angle < 180) {
      c.direction =
          normalize(c.direction) * (0.5 * length(c.right) / std::tan(c.angle * std::numbers::pi / 360));
      c.angle = 0;  // of a camera that is named and moved, the vectors say it
    }
    if (c.kind == Word::orthographic_ && c.angle > 0 && c.angle < 180)
      size_by_angle(c, target.value_or(Vector3d{0, 0, 1}));
    else if (c.kind == Word::orthographic_ && !sized)
      size_by_distance(c, target.value_or(Vector3d{0, 0, 1}));
    if (target) look_at(reader, c, *target);
  };
  Transform step;  // of all transforms: they come after the rest, wherever they stand (measured)
  for (;;) {
    reader.comma();
    if (const auto named = reader.identifier<Shared<CameraView>>()) {
      c = **named;
      sized = true;
      continue;
    }
    const Token token = reader.peek();
    if (token.is('}')) break;
    if (read_transform(reader, step)) continue;
    reader.next();
    if (token.kind != TokenKind::word) reader.unexpected(token, "a part of camera");
    switch (token.symbol->word) {
      case Word::perspective_:
      case Word::orthographic_:
      case Word::fisheye_:
      case Word::ultra_wide_angle_:
      case Word::omnimax_:
      case Word::panoramic_:
      case Word::spherical_:
        c.kind = token.symbol->word;
        break;
      case Word::mesh_camera_:
        c.kind = Word::mesh_camera_;
        if (reader.peek().is('{')) skip_block(reader);
        break;
      case Word::cylinder_:
        c.kind = token.symbol->word;
        c.kind_number = reader.integer("the kind of a cylindrical camera");
        break;
      case Word::location_:
        c.location = reader.vector("the place of a camera");
        break;
      case Word::look_at_:
        target = reader.vector("look_at");
        break;
      case Word::direction_:
        c.direction = reader.vector("direction");
        break;
      case Word::right_:
        c.right = reader.vector("right"), sized = true;
        break;
      case Word::up_:
        c.up = reader.vector("up"), sized = true;
        break;
      case Word::sky_:
        c.sky = reader.vector("sky");
        break;
      case Word::angle_:
        c.angle = reader.number("angle");
        if (reader.accept(',') || reader.number_follows()) c.angle_v = reader.number("angle");
        break;
      case Word::aperture_:
        c.aperture = reader.number("aperture");
        break;
      case Word::focal_point_:
        c.focal_point = reader.vector("focal_point");
        break;
      case Word::blur_samples_:
        reader.numbers();
        if (reader.accept(',')) reader.numbers();
        break;
      case Word::confidence_:
      case Word::variance_:
        reader.numbers();
        break;
      case Word::bokeh_:
        skip_block(reader);
        break;
      case Word::normal_:
        read_normal_block(reader);
        c.has_normal = true;
        break;
      default:
        reader.unexpected(token, "a part of camera");
    }
  }
  reader.next();
  settle();
  move(c, step);
  return std::make_shared<CameraView>(c);
}

Shared<SkySphere> read_sky_sphere_block(Reader& reader) {
  if (const auto named = reader.identifier<Shared<SkySphere>>()) return *named;
  reader.expect('{', "behind sky_sphere");
  SkySphere sky;
  sky.place = reader.here();
  while (!reader.accept('}')) {
    if (const auto named = reader.identifier<Shared<SkySphere>>()) {
      sky = **named;
    } else if (reader.accept(Word::pigment_)) {
      sky.pigments.push_back(read_pigment_block(reader));
    } else if (reader.accept(Word::emission_)) {
      reader.numbers();
    } else {
      Transform step;
      if (!read_transform(reader, step)) reader.unexpected(reader.next(), "a part of sky_sphere");
      for (Shared<Pigment>& pigment : sky.pigments) {
        auto copy = std::make_shared<Pigment>(*pigment);
        copy->to_object = step * copy->to_object;
        pigment = copy;
      }
    }
  }
  return std::make_shared<SkySphere>(std::move(sky));
}

}  // namespace vitrail::pov
