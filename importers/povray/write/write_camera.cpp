// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/write/write_camera.h"
#include "importers/reading/sensor_view.h"
#include "importers/writing/clip_note.h"
#include "scene/models/paraxial_lens.h"

#include <cmath>

namespace vitrail::povray {

namespace {

// Rays of POV-Ray's cameras start and point at `first` + x·right + y·up with x and y from −½ to ½, when the
// camera has neither angle nor look_at; 17 digits bring the vectors back exactly.
struct Frame {
  Point3d location;
  Vector3d right, up, view, offset;  // `offset`: from the axis to the middle of the raster
};

std::string exact(double x) { return fmt::format("{:.17g}", x); }
std::string exact(Vector3d v) { return fmt::format("<{},{},{}>", exact(v.x), exact(v.y), exact(v.z)); }

Frame frame_of(const Context& context, const Transform& camera_to_world, const ScreenWindow& s) {
  const Transform t = context.units.to_pov * camera_to_world;
  const auto along = [&](double x, double y, double z) { return transform_vector(t, {x, y, z}); };
  return {transform_point(t, {0, 0, 0}), along(s.x1 - s.x0, 0, 0), along(0, s.y1 - s.y0, 0), along(0, 0, 1),
          along((s.x0 + s.x1) / 2, (s.y0 + s.y1) / 2, 0)};
}

std::string vectors(const Frame& f) {
  return fmt::format("  location {}\n  right {}\n  up {}\n  direction {}\n", exact(f.location - Point3d{}),
                     exact(f.right), exact(f.up), exact(f.view));
}

std::string text_of(Context& context, const PerspectiveCamera& camera) {
  Frame f = frame_of(context, camera.camera_to_world, camera.screen);
  const Vector3d view = f.view;
  f.view = f.view + f.offset;
  std::string lens;
  if (camera.lens.radius > 0) {
    context.approximated("lens: POV-Ray samples a grid of points on it", context.scene.camera_origin);
    // POV-Ray's aperture is twice the diameter of the disk (measured: the blur of an edge far behind).
    const Point3d focus = f.location + view * camera.lens.focal_distance;
    lens =
        fmt::format("  aperture {}\n  focal_point {}\n  blur_samples 37 variance 0\n",
                    exact(4 * camera.lens.radius * length(f.right) / (camera.screen.x1 - camera.screen.x0)),
                    exact(focus - Point3d{}));
  }
  return "camera {\n  perspective\n" + vectors(f) + lens + "}\n";
}

std::string text_of(Context& context, const OrthographicCamera& camera) {
  Frame f = frame_of(context, camera.camera_to_world, camera.screen);
  f.location = f.location + f.offset;
  if (camera.lens.radius > 0)
    context.approximated("lens of an orthographic camera: without it", context.scene.camera_origin);
  return "camera {\n  orthographic\n" + vectors(f) + "}\n";
}

// The middle of the raster looks along −x, its right is −z. POV-Ray turns `direction` about `up` and `right`
// in senses of its own: the raster's right is where up × direction points.
std::string text_of(Context& context, const SphericalCamera& camera) {
  if (camera.projection == SphericalCamera::Projection::equal_area)
    context.approximated("equal-area spherical camera: by latitude and longitude",
                         context.scene.camera_origin);
  const Transform t = context.units.to_pov * camera.camera_to_world;
  const auto along = [&](Vector3d v) { return normalize(transform_vector(t, v)); };
  Frame f{transform_point(t, {0, 0, 0}), along({0, 0, -1}), along({0, 1, 0}), along({-1, 0, 0}), {}};
  if (dot(cross(f.up, f.view), f.right) < 0) {
    f.up = -f.up;
    f.right = -f.right;
  }
  return "camera {\n  spherical\n" + vectors(f) + "  angle 360 180\n}\n";
}

std::string text_of(Context& context, const WideCamera& camera) {
  context.approximated("a camera that sees more than a plane shows: all around, by latitude and longitude",
                       context.scene.camera_origin);
  SphericalCamera all{camera.camera_to_world, SphericalCamera::Projection::latitude_longitude};
  return text_of(context, all);
}

std::string text_of(Context& context, const SensorCamera& camera) {
  context.dropped("sensors of irradiance: a camera that looks along the first one's normal",
                  context.scene.camera_origin);
  return text_of(context, view_of(camera, context.scene.film));
}

std::string text_of(Context& context, const RealisticCamera& camera) {
  context.approximated("lens of many surfaces: a thin one, without distortion and darker corners",
                       context.scene.camera_origin);
  return text_of(context, view_of(camera, context.scene.film));
}

bool is_pixel_box(const Filter& filter) {
  const auto* box = std::get_if<BoxFilter>(&filter);
  return box && box->radius_x == 0.5 && box->radius_y == 0.5;
}

}  // namespace

std::string camera_text(Context& context) {
  if (const std::string note = clip_note(clip_of(context.scene.camera)); !note.empty())
    context.dropped(note, context.scene.camera_origin);
  return std::visit([&](const auto& camera) { return text_of(context, camera); }, context.scene.camera);
}

std::string options_text(Context& context, const std::string& pov_name) {
  const FilmSettings& film = context.scene.film;
  if (!is_pixel_box(film.filter))
    context.approximated("pixel filter: POV-Ray takes the mean over each pixel", context.scene.film_origin);
  if (film.layers.any())
    context.dropped("layers of first surfaces: " + names_of(film.layers), context.scene.film_origin);
  if (context.scene.settings.hides_emitters &&
      std::ranges::any_of(context.traits, &MaterialTraits::transmits))
    context.approximated("hidden emitters: glass does not show them either", context.scene.integrator_origin);
  const double side = std::sqrt(std::max(1, context.scene.settings.samples_per_pixel));
  const int depth = std::clamp(static_cast<int>(std::lround(side)), 1, 9);
  std::string text = fmt::format(
      "; In this folder: povray "
      "{}\nInput_File_Name={}\nWidth={}\nHeight={}\nOutput_File_Type=E\nOutput_Alpha=Off\n"
      "Antialias=On\nSampling_Method=1\nAntialias_Threshold=0\nAntialias_Depth={}\nJitter=Off\n",
      std::filesystem::path(pov_name).replace_extension(".ini").generic_string(), pov_name, film.width,
      film.height, depth);
  const PixelRect& crop = film.crop;
  if (crop != PixelRect{0, film.width, 0, film.height})
    text += fmt::format("Start_Column={}\nEnd_Column={}\nStart_Row={}\nEnd_Row={}\n", crop.x0 + 1, crop.x1,
                        crop.y0 + 1, crop.y1);
  return text;
}

}  // namespace vitrail::povray
