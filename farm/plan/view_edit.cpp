// SPDX-License-Identifier: Apache-2.0
#include "farm/plan/view_edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <sstream>
#include <vector>

#include "bundle/checksum.h"
#include "bundle/manifest_json.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

constexpr const char* look_at_takes =
    "--look-at takes the eye and the point that it looks at, as 4,2,5,0,0.5,0, and may have the direction up "
    "behind "
    "them: ";

// What stays up where the camera is moved: the axis of the world over which the camera is level, so that its
// horizon stays level too. Its right is at a right angle to that axis; of two, the one nearer to its up. A
// camera that is level over no axis keeps its own up.
Vector3d kept_up(const Transform& camera_to_world) {
  constexpr double level = 1e-6, least_cosine = 0.1;
  const Vector3d right = normalize(transform_vector(camera_to_world, {1, 0, 0})),
                 up = normalize(transform_vector(camera_to_world, {0, 1, 0}));
  Vector3d kept = up;
  double greatest = least_cosine;
  for (const Vector3d axis : {Vector3d{1, 0, 0}, Vector3d{0, 1, 0}, Vector3d{0, 0, 1}}) {
    const double cosine = dot(up, axis);
    if (std::abs(dot(right, axis)) > level || std::abs(cosine) < greatest) continue;
    greatest = std::abs(cosine);
    kept = axis * std::copysign(1.0, cosine);
  }
  return kept;
}

// Left and right stay where they are: files of pbrt and of Mitsuba mean opposite hands.
Transform look_from(const ViewEdit::LookAt& view, const Transform& before) {
  const bool has_up = view.up != Vector3d{0, 0, 0};
  const Vector3d up = has_up ? view.up : kept_up(before);
  const Transform to_world = look_at(view.eye, view.target, up);
  if (!is_invertible(to_world))
    throw UsageError("--look-at has no direction: eye and target coincide, or up is along the view");
  return snapped(swaps_handedness(before) == swaps_handedness(to_world) ? to_world
                                                                        : to_world * scale({-1, 1, 1}));
}

// As pbrt has it: a picture's shorter side is seen under the angle.
ScreenWindow screen_under(double fov_deg, const FilmSettings& film) {
  const double aspect = static_cast<double>(film.width) / film.height;
  const double half = fov_deg == 90 ? 1 : std::tan(fov_deg / 2 * std::numbers::pi / 180);
  const double x = aspect > 1 ? aspect : 1, y = aspect > 1 ? 1 : 1 / aspect;
  return {-x * half, x * half, -y * half, y * half};
}

// Its screen is fitted with the film (resize_film). Where objects of the bundle move, its shutter stays, as
// their times are.
void put_view(const View& view, Manifest& m) {
  m.camera = view.camera;
  std::visit([&](auto& c) { c.camera_to_world = translate(-m.offset) * c.camera_to_world; }, m.camera);
  m.camera_motion = translate(-m.offset) * view.motion;
  const bool objects_move =
      std::ranges::any_of(m.objects, [](const ObjectInfo& object) { return object.motion.moves(); });
  if (!objects_move) m.shutter = view.shutter;
  m.requirements.motion = objects_move || m.camera_motion.moves();
}

}  // namespace

ViewEdit::LookAt parse_look_at(const std::string& text) {
  std::vector<double> v;
  std::istringstream list(text);
  for (std::string part; std::getline(list, part, ',');) {
    double value = 0;
    const char* const end = part.data() + part.size();
    const auto [at, failed] = std::from_chars(part.data(), end, value);
    if (failed != std::errc() || at != end || !std::isfinite(value)) throw UsageError(look_at_takes + text);
    v.push_back(value);
  }
  if (v.size() != 6 && v.size() != 9) throw UsageError(look_at_takes + text);
  ViewEdit::LookAt view{{v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
  if (v.size() == 9) view.up = {v[6], v[7], v[8]};
  if (v.size() == 9 && view.up == Vector3d{0, 0, 0})
    throw UsageError("--look-at: no direction is up: " + text);
  return view;
}

void edit_view(const ViewEdit& edit, Manifest& m) {
  if (!edit.view && !edit.look_at && !edit.fov_deg) return;
  if (edit.view) put_view(*edit.view, m);
  if (edit.look_at) {
    std::visit(
        [&](auto& camera) {
          camera.camera_to_world = translate(-m.offset) * look_from(*edit.look_at, camera.camera_to_world);
        },
        m.camera);
    m.camera_motion = {};
  }
  if (edit.fov_deg) {
    auto* const perspective = std::get_if<PerspectiveCamera>(&m.camera);
    if (!perspective) throw UsageError("--fov is for perspective cameras, and the scene has another one");
    perspective->screen = screen_under(*edit.fov_deg, m.film);
  }
  std::string camera = camera_to_json(m.camera).dump();
  if (edit.view) camera += view_to_json(*edit.view).dump();
  Hasher hasher;
  hasher.add(std::as_bytes(std::span(&m.scene_hash, 1)));
  hasher.add(std::as_bytes(std::span(camera)));
  m.scene_hash = hasher.digest();
}

}  // namespace vitrail
