// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "importers/mitsuba/read/builder.h"
#include "importers/mitsuba/read/film.h"
#include "importers/mitsuba/read/properties.h"
#include "importers/mitsuba/screen.h"
#include "importers/reading/suggestion.h"

namespace vitrail::mitsuba {

namespace {

// From the space of our camera to that of Mitsuba's, which has +x on the left of the picture. 0.6's image of
// all directions: its middle looks along +z, ours along −x.
Transform camera_to_mitsuba(const Object& sensor) {
  if (sensor.type != "spherical") return scale({-1, 1, 1});
  Transform turn;
  turn.m[0] = {0, 0, 1, 0}, turn.m[2] = {-1, 0, 0, 0};
  return turn;
}

Transform read_camera_to_world(const Object& sensor, const Report& report) {
  const Transform t = sensor.transform("to_world", report) * camera_to_mitsuba(sensor);
  if (!is_invertible(t)) report.fail("the camera's to_world has no inverse", place_of(sensor, "to_world"));
  return snapped(t);
}

double aspect_of(const FilmSettings& film) { return static_cast<double>(film.width) / film.height; }

// Half of the diagonal in the plane z = 1.
HalfScreen half_screen_of_diagonal(double half_diagonal, double aspect) {
  return half_screen_of_width(half_diagonal / std::sqrt(1 + 1 / (aspect * aspect)), aspect);
}

// "35mm" or 35, of a film of 36 × 24 mm.
double read_focal_length_mm(const Object& sensor, const Report& report) {
  const Property* property = sensor.find("focal_length");
  const auto* text = property ? std::get_if<std::string>(&property->value) : nullptr;
  if (!text) return sensor.number("focal_length", 50, report);
  double value = 0;
  const char* end = text->data() + text->size();
  const auto [rest, error] = std::from_chars(text->data(), end, value);
  const std::string_view unit(rest, static_cast<std::size_t>(end - rest));
  if (error != std::errc() || (!unit.empty() && unit != "mm" && unit != " mm"))
    report.fail(fmt::format("expected a focal length such as 50mm, found \"{}\"", *text), property->origin);
  return value;
}

HalfScreen half_screen_of_focal_length(const Object& sensor, double aspect, const Report& report) {
  const double focal_length = read_focal_length_mm(sensor, report);
  if (!(focal_length > 0))
    report.fail(fmt::format("the focal length is {} mm, but has to be above 0", focal_length),
                place_of(sensor, "focal_length"));
  return half_screen_of_diagonal(std::hypot(36, 24) / (2 * focal_length), aspect);
}

HalfScreen read_half_screen(const Object& sensor, double aspect, const Report& report) {
  if (!sensor.has("fov")) return half_screen_of_focal_length(sensor, aspect, report);
  if (sensor.has("focal_length"))
    report.fail("a camera has a fov or a focal length, not both", place_of(sensor, "focal_length"));
  const double fov = sensor.number("fov", 50, report);
  if (!(fov > 0 && fov < 180))
    report.fail(fmt::format("the field of view is {} degrees, which is not between 0 and 180", fov),
                place_of(sensor, "fov"));
  const std::string axis = sensor.text("fov_axis", "x", report);
  const double half = tan_half(fov);
  if (axis == "x" || axis == (aspect > 1 ? "larger" : "smaller")) return half_screen_of_width(half, aspect);
  if (axis == "y" || axis == (aspect > 1 ? "smaller" : "larger")) return half_screen_of_height(half, aspect);
  if (axis == "diagonal") return half_screen_of_diagonal(half, aspect);
  report.fail(fmt::format("expected the fov_axis x, y, diagonal, smaller or larger, found \"{}\"", axis),
              place_of(sensor, "fov_axis"));
}

Lens read_lens(const Object& sensor, const Report& report) {
  const double far_clip = sensor.number("far_clip", 1e4, report);
  const Lens lens{sensor.number("aperture_radius", 0, report),
                  sensor.number("focus_distance", far_clip, report)};
  if (!sensor.has("aperture_radius"))
    report.fail(fmt::format("a {} camera needs an \"aperture_radius\"", sensor.type), sensor.origin);
  if (!(lens.radius >= 0))
    report.fail("\"aperture_radius\" is negative", place_of(sensor, "aperture_radius"));
  if (lens.radius == 0) return {};
  if (!(lens.focal_distance > 0))
    report.fail("\"focus_distance\" has to be above 0", place_of(sensor, "focus_distance"));
  return lens;
}

bool is_sound(const ScreenWindow& s) {
  const double width = s.x1 - s.x0, height = s.y1 - s.y0;
  return width > 0 && height > 0 && std::isfinite(width) && std::isfinite(height);
}

Camera perspective(const Object& sensor, const FilmSettings& film, const Report& report) {
  PerspectiveCamera camera{read_camera_to_world(sensor, report), {}, {}};
  const HalfScreen half = read_half_screen(sensor, aspect_of(film), report);
  const bool lens = sensor.type == "thinlens";
  const double x = lens ? 0 : sensor.number("principal_point_offset_x", 0, report),
               y = lens ? 0 : sensor.number("principal_point_offset_y", 0, report);
  camera.screen = screen_window(half, x, y);
  if (!is_sound(camera.screen)) report.fail("the camera's screen is empty or without end", sensor.origin);
  if (lens) camera.lens = read_lens(sensor, report);
  return camera;
}

// The screen is ±1 wide in the camera's space.
Camera orthographic(const Object& sensor, const FilmSettings& film, const Report& report) {
  OrthographicCamera camera{read_camera_to_world(sensor, report), {}, {}};
  camera.screen = screen_window(half_screen_of_width(1, aspect_of(film)), 0, 0);
  if (sensor.type == "telecentric") camera.lens = read_lens(sensor, report);
  return camera;
}

// Meters have a to_world, or say where they are and look.
std::optional<Transform> place_of_meter(const Object& sensor, const Report& report) {
  const auto origin = sensor.vector("origin", report), direction = sensor.vector("direction", report);
  if (!origin || !direction) return std::nullopt;
  const double long_enough = length(*direction);
  if (!(long_enough > 0) || !std::isfinite(long_enough))
    report.fail("the meter's \"direction\" has no length", place_of(sensor, "direction"));
  const Point3d from = Point3d{} + *origin;
  const Vector3d up = std::abs(direction->y) > 0.9 * long_enough ? Vector3d{1, 0, 0} : Vector3d{0, 1, 0};
  return look_at(from, from + *direction, up);
}

// A camera of the sensor's place that looks along its axis.
Camera stand_in(const Object& sensor, double fov_deg, const FilmSettings& film, const Report& report) {
  const auto place = place_of_meter(sensor, report);
  PerspectiveCamera camera{place ? *place : read_camera_to_world(sensor, report), {}, {}};
  camera.screen = screen_window(half_screen_of_width(tan_half(fov_deg), aspect_of(film)), 0, 0);
  return camera;
}

Camera spherical(const Object& sensor, const Report& report) {
  return SphericalCamera{read_camera_to_world(sensor, report),
                         SphericalCamera::Projection::latitude_longitude};
}

void read_motion(Builder& builder, const Object& camera) {
  Scene& scene = builder.scene;
  std::vector<Keyframe> keys = camera.keyframes("to_world");
  for (Keyframe& key : keys) key.transform = snapped(key.transform * camera_to_mitsuba(camera));
  const std::optional<Motion> motion = motion_of(builder, std::move(keys), place_of(camera, "to_world"));
  if (!motion) return;
  std::visit([&](auto& c) { c.camera_to_world = motion->at(scene.shutter.open_s); }, scene.camera);
  if (!stands_still(*motion, scene.shutter)) scene.camera_motion = *motion;
}

const std::vector<std::string> kinds{"perspective",    "thinlens",        "orthographic",      "telecentric",
                                     "radiancemeter",  "irradiancemeter", "distant",           "batch",
                                     "mradiancemeter", "mdistant",        "perspective_rdist", "spherical"};

Camera read_camera(const Object& sensor, const FilmSettings& film, Report& report) {
  const std::string& kind = sensor.type;
  if (kind == "perspective" || kind == "thinlens") return perspective(sensor, film, report);
  if (kind == "orthographic" || kind == "telecentric") return orthographic(sensor, film, report);
  if (kind == "spherical") return spherical(sensor, report);
  const auto nearest = [&](const char* camera) {
    report.approximated(fmt::format("sensor \"{}\": {} at its place stands for it", kind, camera),
                        sensor.origin);
  };
  if (kind == "perspective_rdist") {
    report.dropped("the radial distortion of a camera", sensor.origin);
    sensor.ignore({"kc"});
    return perspective(sensor, film, report);
  }
  if (kind == "distant" || kind == "mdistant") {
    nearest("an orthographic camera");
    return orthographic(sensor, film, report);
  }
  if (kind == "radiancemeter" || kind == "mradiancemeter") {
    nearest("a perspective camera of 0.01 degrees");
    return stand_in(sensor, 0.01, film, report);
  }
  if (kind == "irradiancemeter" || kind == "fluencemeter") {
    nearest("a perspective camera of 90 degrees");
    return stand_in(sensor, 90, film, report);
  }
  report.approximated(
      fmt::format("sensor \"{}\" is not known: a perspective camera at its place stands for it{}", kind,
                  suggestion(kind, kinds)),
      sensor.origin);
  return perspective(sensor, film, report);
}

int read_sample_count(const Object& sensor, Report& report) {
  const Object* sampler = sensor.child("sampler");
  if (!sampler) return 4;
  const int count = sampler->integer("sample_count", 4, report);
  if (count < 1)
    report.fail(fmt::format("\"sample_count\" is {}, but has to be at least 1", count),
                place_of(*sampler, "sample_count"));
  sampler->ignore({"seed", "jitter", "dimension", "samples_per_wavefront", "scramble", "max_depth"});
  report_unused_in_one(*sampler, report, {"sample_count"});
  return count;
}

// Of several cameras in one the first.
const Object& first_camera(const Object& sensor, Report& report) {
  if (sensor.type != "batch") return sensor;
  const auto inner = sensor.children("sensor");
  if (inner.empty()) report.fail("a batch needs a sensor", sensor.origin);
  if (inner.size() > 1)
    report.dropped(fmt::format("all but the first of the {} sensors of a batch", inner.size()),
                   sensor.origin);
  return *std::get<ObjectPtr>(inner.front()->value);
}

}  // namespace

void read_sensor(Builder& builder, const Object& sensor) {
  Scene& scene = builder.scene;
  Report& report = builder.report;
  read_film(builder, sensor);
  report.begin_item({sensor.origin, RecordKind::camera});
  const Object& camera = first_camera(sensor, report);
  scene.camera_origin = camera.origin;
  scene.camera = read_camera(camera, scene.film, report);
  if (const Object* sampler = sensor.child("sampler")) {
    scene.sampler_origin = sampler->origin;
    report.begin_item({sampler->origin, RecordKind::sampler});
  }
  scene.settings.samples_per_pixel = read_sample_count(sensor, report);
  report.begin_item({camera.origin, RecordKind::camera});
  if (!sensor.children("srf").empty() || sensor.find("srf"))
    report.dropped("the spectral response of a sensor: the CIE 1931 observer takes its place",
                   place_of(sensor, "srf"));
  for (const Object* object : {&sensor, &camera}) {
    builder.shutter_open = object->number("shutter_open", builder.shutter_open, report);
    builder.shutter_close = object->number("shutter_close", builder.shutter_close, report);
    read_clipping(builder, *object);
    object->ignore({"focus_distance"});
    object->children("film"), object->children("sampler");
    if (const Object* medium = object->child("medium")) scene.camera_medium = add_medium(builder, *medium);
    report.begin_item({object->origin, RecordKind::camera});
    report_unused(*object, report,
                  {"to_world", "fov", "fov_axis", "focal_length", "principal_point_offset_x",
                   "principal_point_offset_y", "aperture_radius", "focus_distance"});
    if (object == &camera) break;
  }
  if (!(builder.shutter_open <= builder.shutter_close))
    report.fail("the shutter closes before it has opened", place_of(camera, "shutter_close"));
  scene.shutter = {builder.shutter_open, builder.shutter_close};
  read_motion(builder, camera);
}

std::optional<Motion> motion_of(Builder& builder, std::vector<Keyframe> keys, const Origin& place) {
  if (keys.empty()) return std::nullopt;
  if (can_move(keys)) return Motion(std::move(keys));
  builder.report.approximated(
      "motion between transforms of which one mirrors or is no affine one: the first holds for the whole "
      "picture",
      place);
  return std::nullopt;
}

}  // namespace vitrail::mitsuba
