// SPDX-License-Identifier: Apache-2.0
// Camera, film, filter, sampler and integrator.
#include <cmath>
#include <numbers>
#include <optional>

#include "importers/pbrt/read/camera_film.h"
#include "importers/pbrt/read/gbuffer.h"
#include "importers/pbrt/write/writer.h"
#include "importers/reading/sensor_view.h"
#include "importers/writing/clip_note.h"
#include "scene/models/paraxial_lens.h"

namespace vitrail::pbrt {

namespace {

// As the reader takes it: tan 45° is 1.
double tan_half(double fov_deg) { return fov_deg == 90 ? 1 : std::tan(fov_deg / 2 * std::numbers::pi / 180); }

// The field of view with the fewest digits whose tangent has the same bits, if there is one.
std::optional<double> field_of_view(double tangent) {
  if (!(tangent > 0)) return std::nullopt;
  const double near = std::atan(tangent) * 2 * 180 / std::numbers::pi;
  for (int digits = 1; digits <= 17; ++digits) {
    const double candidate = std::stod(fmt::format("{:.{}g}", near, digits));
    if (tan_half(candidate) == tangent) return candidate;
  }
  double below = near, above = near;
  for (int i = 0; i < 16; ++i) {
    below = std::nextafter(below, 0.0), above = std::nextafter(above, 180.0);
    if (tan_half(below) == tangent) return below;
    if (tan_half(above) == tangent) return above;
  }
  return std::nullopt;
}

// What pbrt takes where nothing else is said: ±1 on the shorter axis, times `tangent`.
ScreenWindow default_screen(const FilmSettings& film, double tangent) {
  const double aspect = static_cast<double>(film.width) / film.height;
  const double x = aspect > 1 ? aspect : 1, y = aspect > 1 ? 1 : 1 / aspect;
  return {-x * tangent, x * tangent, -y * tangent, y * tangent};
}

void screen(Parameters& p, const ScreenWindow& s) {
  p.numbers("float screenwindow", std::array{s.x0, s.x1, s.y0, s.y1});
}

void lens(Parameters& p, const Lens& lens) {
  if (lens == Lens{}) return;
  p.number("lensradius", lens.radius).number("focaldistance", lens.focal_distance);
}

bool moves(const Scene& scene) { return scene.camera_motion.moves() || !scene.motions.empty(); }

struct CameraWriter {
  Writer& w;
  Parameters p{w, "camera", w.scene.camera_origin, RecordKind::camera};

  void operator()(const PerspectiveCamera& c) {
    const bool wide = w.scene.film.width > w.scene.film.height;
    const auto fov = field_of_view(wide ? c.screen.y1 : c.screen.x1);
    if (fov && default_screen(w.scene.film, tan_half(*fov)) == c.screen)
      p.number("fov", *fov);
    else
      screen(p.number("fov", 90.0), c.screen);
    lens(p, c.lens);
    finish("perspective", c.camera_to_world);
  }
  void operator()(const OrthographicCamera& c) {
    if (default_screen(w.scene.film, 1) != c.screen) screen(p, c.screen);
    lens(p, c.lens);
    finish("orthographic", c.camera_to_world);
  }
  void operator()(const SphericalCamera& c) {
    p.text("mapping",
           c.projection == SphericalCamera::Projection::equal_area ? "equalarea" : "equirectangular");
    finish("spherical", c.camera_to_world);
  }
  void operator()(const WideCamera& c) {
    p.dropped("a camera that sees more than a plane shows: a perspective one of 90 degrees");
    const double y = static_cast<double>(w.scene.film.height) / w.scene.film.width;
    (*this)(PerspectiveCamera{c.camera_to_world, {-1, 1, -y, y}, {}});
  }
  void operator()(const SensorCamera& c) {
    p.dropped("sensors of irradiance: a camera that looks along the first one's normal");
    (*this)(view_of(c, w.scene.film));
  }
  void operator()(const RealisticCamera& c) {
    p.approximated("lens of many surfaces: a thin one, without distortion and darker corners");
    (*this)(view_of(c, w.scene.film));
  }

 private:
  void finish(const char* kind, const Transform& camera_to_world) {
    if (const std::string note = clip_note(clip_of(w.scene.camera)); !note.empty()) p.dropped(note);
    const Motion& motion = w.scene.camera_motion;
    if (motion.moves())
      w.transforms(motion, w.scene.camera_origin, RecordKind::camera);
    else
      w.transform(inverse(camera_to_world));
    if (moves(w.scene))
      p.number("shutteropen", w.scene.shutter.open_s).number("shutterclose", w.scene.shutter.close_s);
    if (w.scene.camera_medium)
      w.line("MediumInterface \"\" " + in_quotes(w.media.at(w.scene.camera_medium->value)));
    w.line(fmt::format("Camera \"{}\"{}", kind, p.list()));
    if (w.scene.camera_medium) w.line("MediumInterface \"\" \"\"");
  }
};

struct FilterWriter {
  Parameters& p;
  std::string operator()(const BoxFilter& f) { return radii("box", f); }
  std::string operator()(const TriangleFilter& f) { return radii("triangle", f); }
  std::string operator()(const GaussianFilter& f) { return p.number("sigma", f.sigma), radii("gaussian", f); }
  std::string operator()(const MitchellFilter& f) {
    return p.number("B", f.b).number("C", f.c), radii("mitchell", f);
  }
  std::string operator()(const SincFilter& f) { return p.number("tau", f.tau), radii("sinc", f); }

 private:
  std::string radii(const char* kind, const auto& f) {
    p.number("xradius", f.radius_x).number("yradius", f.radius_y);
    return kind;
  }
};

// pbrt's film is exposed while the shutter is open.
double exposure_s(const Scene& scene) {
  return moves(scene) ? scene.shutter.close_s - scene.shutter.open_s : 1;
}

// The iso that gives the ratio back, where dividing by 100 does.
double iso_of(double ratio, double seconds) {
  double iso = ratio / seconds * 100;
  for (const double candidate : {iso, std::nextafter(iso, 0.0), std::nextafter(iso, 1e300)})
    if (candidate / 100 * seconds == ratio) iso = candidate;
  return iso;
}

// "gbuffer" has no spectra, "spectral" no layers.
const char* kind_of_film(const FilmSettings& film) {
  if (film.spectrum.count > 0) return "spectral";
  return film.layers.bits & gbuffer_layers().bits ? "gbuffer" : "rgb";
}

// "gbuffer" keeps all that it has.
void write_layers(Writer& w, Parameters& p, std::string_view kind) {
  const FilmLayers& layers = w.scene.film.layers;
  FilmLayers lost = layers;
  if (kind == "gbuffer") {
    lost.bits &= ~gbuffer_layers().bits;
    p.text("coordinatesystem", layers.in_camera_space ? "camera" : "world");
  }
  if (lost.any()) p.dropped(fmt::format("layers that its film \"{}\" has not: {}", kind, names_of(lost)));
}

void write_film(Writer& w) {
  const FilmSettings& f = w.scene.film;
  Parameters filter(w, "filter", w.scene.film_origin, RecordKind::film);
  const std::string kind = std::visit(FilterWriter{filter}, f.filter);
  w.line(fmt::format("PixelFilter \"{}\"{}", kind, filter.list()));
  Parameters p(w, "film", w.scene.film_origin, RecordKind::film);
  p.integer("xresolution", f.width).integer("yresolution", f.height);
  const PixelRect& c = f.crop;
  if (c != PixelRect{0, f.width, 0, f.height})
    p.numbers("integer pixelbounds", std::array{c.x0, c.x1, c.y0, c.y1});
  if (const double seconds = exposure_s(w.scene); f.imaging_ratio != seconds)
    p.number("iso", iso_of(f.imaging_ratio, seconds));
  if (f.spectrum.count > 0)
    p.integer("nbuckets", f.spectrum.count)
        .number("lambdamin", f.spectrum.min_nm)
        .number("lambdamax", f.spectrum.max_nm);
  const char* film = kind_of_film(f);
  write_layers(w, p, film);
  w.line(fmt::format("Film \"{}\"{} \"string filename\" \"render.exr\"", film, p.list()));
}

// TransformTimes hold for all that moves: those of what moves first.
void write_times(Writer& w) {
  if (!moves(w.scene)) return;
  const Motion& first = w.scene.camera_motion.moves() ? w.scene.camera_motion : w.scene.motions.front();
  w.transform_times_s = {first.keys().front().time_s, first.keys().back().time_s};
  if (w.transform_times_s != std::array{0.0, 1.0})
    w.line(fmt::format("TransformTimes {} {}", w.transform_times_s[0], w.transform_times_s[1]));
}

void write_photons(Writer& w, const PhotonSettings& photons, int depth) {
  std::string given;
  if (photons.photons) given += fmt::format(" \"integer photonsperiteration\" {}", *photons.photons);
  if (photons.first_radius) given += fmt::format(" \"float radius\" {}", *photons.first_radius);
  if (photons.alpha && *photons.alpha != 2.0 / 3)
    w.approximated("the radius of photons shrinks by pbrt's own share, 2/3", w.scene.integrator_origin,
                   RecordKind::integrator);
  w.line(fmt::format("Integrator \"sppm\" \"integer maxdepth\" {}{}", depth, given));
}

// pbrt-v4's "path" ignores media, and light that scatters below a surface.
bool needs_volpath(const Writer& w) {
  return !w.scene.media.empty() || !w.tints.empty() || has_subsurface(w.scene);
}

}  // namespace

void write_view(Writer& w) {
  write_times(w);
  std::visit(CameraWriter{w}, w.scene.camera);
  w.line("Identity");
  write_film(w);
  const RenderSettings& s = w.scene.settings;
  w.line(fmt::format("Sampler \"zsobol\" \"integer pixelsamples\" {}", s.samples_per_pixel));
  int depth = s.max_depth;
  if (s.direct_only) {
    w.approximated("direct light alone becomes paths of one bounce; specular chains end there",
                   w.scene.integrator_origin, RecordKind::integrator);
    depth = 1;
  }
  if (s.hides_emitters)
    w.dropped("hidden emitters: the camera sees lamps and surroundings", w.scene.integrator_origin,
              RecordKind::integrator);
  if (s.photons) return write_photons(w, *s.photons, depth);
  w.line(
      fmt::format("Integrator \"{}\" \"integer maxdepth\" {}", needs_volpath(w) ? "volpath" : "path", depth));
}

}  // namespace vitrail::pbrt
