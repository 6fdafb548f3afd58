// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "importers/povray/read/reader.h"
#include "importers/povray/read/scene_maker.h"

namespace vitrail::pov {

namespace {

Transform columns(Vector3d x, Vector3d y, Vector3d z, Vector3d origin) {
  Transform t;
  t.m[0] = {x.x, y.x, z.x, origin.x};
  t.m[1] = {x.y, y.y, z.y, origin.y};
  t.m[2] = {x.z, y.z, z.z, origin.z};
  return t;
}

// Unit axes, with the screen in the plane z = 1, where the view is across both; else the vectors themselves.
template <class Camera>
Camera camera_of(const CameraView& v, Vector3d right, Vector3d up, bool perspective) {
  Camera camera;
  const double wide = length(right), high = length(up), far = length(v.direction);
  const Vector3d x = right * (1 / wide), y = up * (1 / high), z = v.direction * (1 / far);
  const double depth = perspective ? far : 1;
  constexpr double tolerance = 1e-9;
  if (std::abs(dot(x, z)) < tolerance && std::abs(dot(y, z)) < tolerance && std::abs(dot(x, y)) < tolerance) {
    camera.camera_to_world = columns(x, y, z, v.location);
    camera.screen = {-wide / (2 * depth), wide / (2 * depth), -high / (2 * depth), high / (2 * depth)};
  } else {
    camera.camera_to_world = columns(right, up, v.direction, v.location);
    camera.screen = {-0.5, 0.5, -0.5, 0.5};
  }
  return camera;
}

// Measured by the directions that POV-Ray's pictures show.
WideCamera wide_camera(const CameraView& v) {
  using enum WideCamera::Projection;
  const double wide = length(v.right), high = length(v.up), far = length(v.direction);
  const double half = (v.angle > 0 ? v.angle : v.kind == Word::spherical_ ? 360 : 90) / 2;
  WideCamera camera;
  camera.camera_to_world =
      columns(v.right * (1 / wide), v.up * (1 / high), v.direction * (1 / far), v.location);
  const auto set = [&](WideCamera::Projection projection, double across, double above) {
    camera.projection = projection, camera.across = across, camera.above = above;
  };
  switch (v.kind) {
    case Word::spherical_:  // it turns the view about `up` and `right`, whatever their hand
      camera.camera_to_world =
          columns(normalize(cross(v.up, v.direction)), normalize(cross(v.direction, v.right)),
                  v.direction * (1 / far), v.location);
      set(latitude_longitude, half, v.angle_v > 0 ? v.angle_v / 2 : half / 2);
      break;
    case Word::fisheye_:
      set(fisheye, wide * half, high * half);
      camera.edge_deg = half;
      break;
    case Word::omnimax_:
      set(fisheye, wide * 81, high * 81);
      camera.edge_deg = 90;
      break;
    case Word::ultra_wide_angle_:
      set(ultra_wide, half, half * high / wide);
      break;
    case Word::panoramic_:
      set(panoramic, wide / far, high / far);
      break;
    default:  // a cylinder
      camera.parallel = v.kind_number > 2;
      if (v.kind_number % 2 == 1)
        set(upright_cylinder, half, high / 2);
      else
        set(lying_cylinder, wide / 2, half);
  }
  return camera;
}

}  // namespace

void SceneMaker::set_view() {
  scene_.settings.direct_only = !world_.radiosity;
  scene_.settings.max_depth = world_.max_trace_level;
  scene_.settings.rgb = RgbMethod::bands;  // its colours are three numbers, and so are their products
  // What goes straight on stays on its level, as povray's pictures of clear planes show.
  scene_.settings.straight_counts = reader_.for_export;
  const CameraView view = world_.camera ? *world_.camera : CameraView{};
  const SourceLocation place = reader_.location(view.place);
  if (!world_.camera) reader_.notes.approximated("there is no camera: POV-Ray's, at the origin", place);
  if (!(length(view.right) > 0) || !(length(view.up) > 0) || !(length(view.direction) > 0))
    throw Error("a vector of the camera is 0", place);
  // The picture is as wide for its height as the camera sees.
  const double aspect = std::clamp(length(view.right) / length(view.up), 0.01, 100.0);
  FilmSettings& film = scene_.film;
  film.width = aspect >= 1 ? 640 : static_cast<int>(std::lround(640 * aspect));
  film.height = aspect >= 1 ? static_cast<int>(std::lround(640 / aspect)) : 640;
  film.crop = {0, film.width, 0, film.height};
  film.filter = BoxFilter{};
  const double gamma = reader_.gamma().value_or(srgb_gamma);
  if (!reader_.for_export)
    film.working_gamma = gamma;
  else if (gamma != 1)
    reader_.notes.approximated(
        "assumed_gamma: each colour and light becomes linear, and their sums differ from POV-Ray's", place);
  scene_.camera_origin = origin(view.place);
  if (view.has_normal) reader_.notes.dropped("normal of a camera", place);
  if (view.kind == Word::orthographic_) {
    scene_.camera = camera_of<OrthographicCamera>(view, view.right, view.up, false);
    return;
  }
  if (reader_.for_export && view.kind == Word::spherical_) {
    // Its middle looks along −x there, with its right along −z.
    const Transform wide = wide_camera(view).camera_to_world;
    const auto axis = [&](Vector3d v) { return transform_vector(wide, v); };
    SphericalCamera camera;
    camera.projection = SphericalCamera::Projection::latitude_longitude;
    camera.camera_to_world = columns(axis({0, 0, -1}), axis({0, 1, 0}), axis({-1, 0, 0}), view.location);
    if (view.angle > 0 && view.angle < 359)
      reader_.notes.approximated("a spherical camera: all of the sphere", place);
    scene_.camera = camera;
    return;
  }
  if (!reader_.for_export && view.kind != Word::perspective_ && view.kind != Word::mesh_camera_) {
    if (view.kind == Word::omnimax_)
      reader_.notes.approximated("an omnimax camera: a fisheye of 162 degrees", place);
    scene_.camera = wide_camera(view);
    return;
  }
  CameraView seen = view;
  if (view.kind != Word::perspective_) {
    constexpr double widest = 120, usual = 90;
    const double angle = view.angle > 0 ? std::min(view.angle, widest) : usual;
    seen.direction =
        normalize(view.direction) * (0.5 * length(view.right) / std::tan(angle * std::numbers::pi / 360));
    reader_.notes.approximated(fmt::format("a camera of this kind: perspective, {} degrees wide", angle),
                               place);
  }
  auto camera = camera_of<PerspectiveCamera>(seen, seen.right, seen.up, true);
  if (view.aperture > 0) {
    // POV-Ray's aperture is twice the diameter of the lens (measured: the blur of an edge far behind), at the
    // width of `right` as it is given.
    const Vector3d z = normalize(view.direction);
    camera.lens.radius = view.aperture / 4;
    camera.lens.focal_distance = std::max(dot(view.focal_point - view.location, z), 1e-6);
  }
  scene_.camera = camera;
}

}  // namespace vitrail::pov
