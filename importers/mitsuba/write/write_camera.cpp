// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/write/write_camera.h"
#include "importers/reading/clip_planes.h"
#include "importers/reading/sensor_view.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>

#include "importers/mitsuba/aovs.h"
#include "importers/mitsuba/clip_units.h"
#include "importers/mitsuba/screen.h"
#include "importers/mitsuba/write/write_film.h"
#include "scene/models/paraxial_lens.h"

namespace vitrail::mitsuba_writer {

namespace {

using mitsuba::half_screen_of_height;
using mitsuba::half_screen_of_width;
using mitsuba::HalfScreen;
using mitsuba::tan_half;

// Camera space is mirrored in x between the Scene and Mitsuba.
Transform mirrored(const Transform& camera_to_world) { return camera_to_world * scale({-1, 1, 1}); }

double column_length(const Transform& t, std::size_t column) {
  return std::hypot(t.m[0][column], t.m[1][column], t.m[2][column]);
}

// Mitsuba refuses scales in perspective cameras: they go to the screen and the lens.
PerspectiveCamera without_scale(const PerspectiveCamera& camera) {
  const double x = column_length(camera.camera_to_world, 0), y = column_length(camera.camera_to_world, 1),
               z = column_length(camera.camera_to_world, 2);
  constexpr double tolerance = 1e-6;
  const auto is_unit = [](double l) { return std::abs(l - 1) <= tolerance; };
  if ((is_unit(x) && is_unit(y) && is_unit(z)) || !(x > 0 && y > 0 && z > 0)) return camera;
  PerspectiveCamera unit = camera;
  unit.camera_to_world = camera.camera_to_world * scale({1 / x, 1 / y, 1 / z});
  unit.screen = {camera.screen.x0 * x / z, camera.screen.x1 * x / z, camera.screen.y0 * y / z,
                 camera.screen.y1 * y / z};
  unit.lens.radius *= x;
  unit.lens.focal_distance *= z;
  return unit;
}

bool nearly(double a, double b) { return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b)); }

// The numbers from which readers get the window back, to the bit where there are such.
struct WrittenScreen {
  bool by_height = false;
  double fov_deg = 90, offset_x = 0, offset_y = 0;
};

// The value and those that differ from it in the last digits, the nearest first.
std::array<double, 9> neighbours(double value) {
  std::array<double, 9> all{value};
  double below = value, above = value;
  for (std::size_t i = 1; i < all.size(); i += 2) {
    all[i] = below = std::nextafter(below, -HUGE_VAL);
    all[i + 1] = above = std::nextafter(above, HUGE_VAL);
  }
  return all;
}

// The offset that moves ±`half` to [lower, upper], in parts of its width.
std::optional<double> exact_offset(double lower, double upper, double half) {
  for (const double centre : neighbours((lower + upper) / 2)) {
    if (centre - half != lower || centre + half != upper) continue;
    for (const double offset : neighbours(centre / (2 * half)))
      if (offset * 2 * half == centre) return offset;
  }
  return std::nullopt;
}

HalfScreen half_screen(bool by_height, double size, double aspect) {
  return by_height ? half_screen_of_height(size, aspect) : half_screen_of_width(size, aspect);
}

// The nearest where no numbers give exactly the window.
WrittenScreen nearest_screen(const ScreenWindow& s, bool by_height) {
  const double size = by_height ? (s.y1 - s.y0) / 2 : (s.x1 - s.x0) / 2;
  return {by_height, field_of_view_deg(size), (s.x0 + s.x1) / 2 / (s.x1 - s.x0),
          -(s.y0 + s.y1) / 2 / (s.y1 - s.y0)};
}

double error_of(const WrittenScreen& written, const ScreenWindow& s, double aspect) {
  const HalfScreen half = half_screen(written.by_height, tan_half(written.fov_deg), aspect);
  const ScreenWindow r = mitsuba::screen_window(half, written.offset_x, written.offset_y);
  return std::abs(r.x0 - s.x0) + std::abs(r.x1 - s.x1) + std::abs(r.y0 - s.y0) + std::abs(r.y1 - s.y1);
}

WrittenScreen written_screen(const ScreenWindow& s, double aspect) {
  const double x = (s.x1 - s.x0) / 2, y = (s.y1 - s.y0) / 2;
  const bool first_by_height =
      half_screen_of_width(x, aspect).y != y && half_screen_of_height(y, aspect).x == x;
  for (const bool by_height : {first_by_height, !first_by_height})
    for (const double size : neighbours(by_height ? y : x)) {
      const double fov = field_of_view_deg(size);
      if (tan_half(fov) != size) continue;
      const HalfScreen half = half_screen(by_height, size, aspect);
      const auto offset_x = exact_offset(s.x0, s.x1, half.x), offset_y = exact_offset(-s.y1, -s.y0, half.y);
      if (offset_x && offset_y) return {by_height, fov, *offset_x, *offset_y};
    }
  const WrittenScreen by_width = nearest_screen(s, false), by_height = nearest_screen(s, true);
  return error_of(by_height, s, aspect) < error_of(by_width, s, aspect) ? by_height : by_width;
}

WrittenScreen add_field_of_view(Context& context, Element sensor, const ScreenWindow& screen) {
  const double width = context.scene.film.width, height = context.scene.film.height;
  if (!nearly((screen.x1 - screen.x0) * height, (screen.y1 - screen.y0) * width))
    context.approximated("Mitsuba's pixels are square: the picture's height follows from its width");
  const WrittenScreen written = written_screen(screen, width / height);
  add_float(sensor, "fov", written.fov_deg);
  add_string(sensor, "fov_axis", written.by_height ? "y" : "x");
  return written;
}

bool is_centred(const ScreenWindow& s) { return s.x0 == -s.x1 && s.y0 == -s.y1; }

Element write(Context& context, Element root, const PerspectiveCamera& scaled_camera) {
  const PerspectiveCamera camera = without_scale(scaled_camera);
  const ScreenWindow& screen = camera.screen;
  const bool lens = camera.lens.radius > 0 && is_centred(screen);
  if (camera.lens.radius > 0 && !lens)
    context.dropped("depth of field: Mitsuba's lens cannot look past the picture's centre");
  Element sensor = add(root, "sensor", lens ? "thinlens" : "perspective");
  add_transform(sensor, mirrored(camera.camera_to_world));
  const WrittenScreen written = add_field_of_view(context, sensor, screen);
  if (lens) {
    add_float(sensor, "aperture_radius", camera.lens.radius);
    add_float(sensor, "focus_distance", camera.lens.focal_distance);
  } else if (!is_centred(screen)) {
    add_float(sensor, "principal_point_offset_x", written.offset_x);
    add_float(sensor, "principal_point_offset_y", written.offset_y);
  }
  return sensor;
}

// Mitsuba's screen is ±1 wide and as high as the film's shape wants; other windows go to the transform.
Element write(Context& context, Element root, const OrthographicCamera& camera) {
  if (camera.lens.radius > 0) context.dropped("depth of field: Mitsuba has none in orthographic cameras");
  const ScreenWindow& s = camera.screen;
  const double width = context.scene.film.width, height = context.scene.film.height;
  const bool natural = s.x0 == -1 && s.x1 == 1 && nearly(s.y1, height / width) && s.y0 == -s.y1;
  Transform window;
  if (!natural)
    window = translate({(s.x0 + s.x1) / 2, (s.y0 + s.y1) / 2, 0}) *
             scale({(s.x1 - s.x0) / 2, (s.y1 - s.y0) / 2 * width / height, 1});
  Element sensor = add(root, "sensor", "orthographic");
  add_transform(sensor, mirrored(natural ? camera.camera_to_world : camera.camera_to_world * window));
  return sensor;
}

Element write(Context& context, Element root, const SphericalCamera& camera) {
  context.dropped("Mitsuba has no camera that sees all directions: a perspective one of 90 degrees");
  const double y = static_cast<double>(context.scene.film.height) / context.scene.film.width;
  return write(context, root, PerspectiveCamera{camera.camera_to_world, {-1, 1, -y, y}, {}});
}

Element write(Context& context, Element root, const WideCamera& camera) {
  context.dropped("a camera that sees more than a plane shows: a perspective one of 90 degrees");
  const double y = static_cast<double>(context.scene.film.height) / context.scene.film.width;
  return write(context, root, PerspectiveCamera{camera.camera_to_world, {-1, 1, -y, y}, {}});
}

Element write(Context& context, Element root, const SensorCamera& camera) {
  context.dropped("sensors of irradiance: a camera that looks along the first one's normal");
  return write(context, root, view_of(camera, context.scene.film));
}

Element write(Context& context, Element root, const RealisticCamera& camera) {
  context.approximated("lens of many surfaces: a thin one, without distortion and darker corners");
  return write(context, root, view_of(camera, context.scene.film));
}

}  // namespace

double field_of_view_deg(double half_width) {
  const double nearest = 2 * std::atan(half_width) * 180 / std::numbers::pi;
  for (int digits = 1; digits <= std::numeric_limits<double>::max_digits10; ++digits) {
    const double rounded = std::strtod(fmt::format("{:.{}g}", nearest, digits).c_str(), nullptr);
    if (tan_half(rounded) == half_width) return rounded;
  }
  double below = nearest, above = nearest;
  for (int step = 0; step < 16; ++step) {
    below = std::nextafter(below, 0.0);
    above = std::nextafter(above, 180.0);
    if (tan_half(below) == half_width) return below;
    if (tan_half(above) == half_width) return above;
  }
  return nearest;
}

namespace {

// Mitsuba's adapters do not say what goes straight through the material inside of them.
void report_dark_sheets(Context& context) {
  for (const Material& material : context.scene.materials) {
    const bool bumps = material.normal_map || material.displacement;
    if (!bumps || !std::holds_alternative<ThinDielectricMaterial>(material.model)) continue;
    context.begin(RecordKind::material, material.origin);
    context.approximated(
        "a thin sheet with bumps: Mitsuba's volumetric path tracer lets no light of emitters through it");
  }
}

// What the integrator that makes the picture stands in, to keep layers of first surfaces too.
Element layers_around(Context& context, Element root) {
  FilmLayers layers = context.scene.film.layers;
  if (!layers.any()) return root;
  context.begin(RecordKind::integrator, context.scene.integrator_origin);
  layers.remove(Layer::alpha);  // the film's (write_film)
  if (layers.has(Layer::material)) context.dropped("Mitsuba has no index of materials");
  layers.remove(Layer::material);
  FilmLayers lost;
  for (const Layer layer : {Layer::motion, Layer::crypto_object, Layer::crypto_material})
    if (layers.has(layer)) lost.add(layer), layers.remove(layer);
  if (lost.any()) context.dropped("layers that Mitsuba has not: " + names_of(lost));
  if (!layers.any()) return root;
  if (layers.in_camera_space)
    context.approximated("the layers of first surfaces: Mitsuba's positions and normals are the world's");
  if (const std::string what = mitsuba::difference_from_mitsuba(layers); !what.empty())
    context.approximated("the layers of first surfaces: " + what);
  Element element = add(root, "integrator", "aov");
  std::string names;
  for (std::size_t i = 0; i < layer_count; ++i)
    if (layers.has(static_cast<Layer>(i)))
      names += fmt::format("{0}{1}:{1}", names.empty() ? "" : ",", layer_kinds[i].name);
  add_string(element, "aovs", names);
  return element;
}

}  // namespace

void write_integrator(Context& context, Element root) {
  const Scene& scene = context.scene;
  root = layers_around(context, root);
  if (scene.settings.direct_only) {
    context.begin(RecordKind::integrator, scene.integrator_origin);
    context.approximated("Mitsuba's direct integrator ends at the first surface, specular or not");
    if (!scene.media.empty()) context.dropped("media: Mitsuba's direct integrator ignores them");
    Element element = add(root, "integrator", "direct");
    add_integer(element, "emitter_samples", 1);
    add_integer(element, "bsdf_samples", 1);
    return add_boolean(element, "hide_emitters", scene.settings.hides_emitters);
  }
  if (scene.settings.photons) {
    context.begin(RecordKind::integrator, scene.integrator_origin);
    context.approximated("photon mapping becomes path tracing: Mitsuba 3 has no photons");
  }
  // Only the volumetric one counts no event where a mask or `null` stands for what is not there.
  const bool media = !scene.media.empty() || !context.interiors.empty();
  const bool nothing = !context.masks.empty() || std::ranges::any_of(scene.materials, [](const Material& m) {
    return std::holds_alternative<InterfaceMaterial>(m.model);
  });
  const bool volpath = media || nothing || !scene.settings.straight_counts;
  // Of a colored extinction `volpath` samples one wavelength's free flights, whose weights grow without
  // bound.
  const char* const volumetric = context.colored_extinction ? "volpathmis" : "volpath";
  Element element = add(root, "integrator", volpath ? volumetric : "path");
  // A depth is meant for what scatters at surfaces, not in their interiors.
  const int depth = context.interiors.empty() ? scene.settings.max_depth : unlimited_depth;
  if (volpath && scene.settings.straight_counts && depth < unlimited_depth &&
      std::ranges::any_of(context.traits, &MaterialTraits::counts)) {
    context.origin = scene.camera_origin;
    context.approximated(
        "the depth: Mitsuba's volumetric path tracer does not count going straight through sheets and masks");
  }
  if (volpath) report_dark_sheets(context);
  add_integer(element, "max_depth",
              depth >= unlimited_depth ? -1 : depth + 1);  // Mitsuba counts the eye's ray
  add_integer(element, "rr_depth", 5);
  add_boolean(element, "hide_emitters", scene.settings.hides_emitters);
}

namespace {

// Mitsuba has both planes always: where the camera has none, so wide that they cut nothing away.
void add_clip(Element sensor, const Scene& scene) {
  const Transform to_world = std::visit([](const auto& c) { return c.camera_to_world; }, scene.camera);
  const ClipRange wide = wide_clip(scene, to_world), kept = clip_of(scene.camera);
  const ClipRange clip = mitsuba::to_mitsuba(kept, scene.camera);
  float near = kept.near > 0 ? clip.near : wide.near;
  const float far = std::isfinite(kept.far) ? clip.far : wide.far;
  if (!(near < far)) near = 1e-6f * far;
  add_float(sensor, "near_clip", near);
  add_float(sensor, "far_clip", far);
}

}  // namespace

void write_camera(Context& context, Element root) {
  const Scene& scene = context.scene;
  context.begin(RecordKind::camera, scene.camera_origin);
  Element sensor = std::visit([&](const auto& camera) { return write(context, root, camera); }, scene.camera);
  add_clip(sensor, scene);
  if (scene.camera_medium) add_reference(sensor, context.medium_ids[scene.camera_medium->value], "medium");
  write_film(context, sensor);
  Element sampler = add(sensor, "sampler", "independent");
  add_integer(sampler, "sample_count", scene.settings.samples_per_pixel);
}

}  // namespace vitrail::mitsuba_writer
