// SPDX-License-Identifier: Apache-2.0
// How the picture is taken: camera, film and what the file asks of a renderer.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scene/film_layers.h"
#include "scene/spectral_bins.h"
#include "scene/transform.h"

namespace vitrail {

// Camera space: +z is the view, +x raster right, +y up. The raster covers `screen` (in units of the plane z =
// 1 for the perspective camera, of the world for the orthographic one): x0 at the left edge, y1 at the top.
struct ScreenWindow {
  double x0 = -1, x1 = 1, y0 = -1, y1 = 1;
  bool operator==(const ScreenWindow&) const = default;
};

// Rays start on a disk of `radius` around the camera's origin and meet in the plane z = `focal_distance`.
struct Lens {
  double radius = 0;  // 0: a pinhole, everything is in focus
  double focal_distance = 1e6;
  bool operator==(const Lens&) const = default;
};

struct PerspectiveCamera {
  Transform camera_to_world;
  ScreenWindow screen;  // tan of the half angles: ±tan(fov/2) on the axis that fov measures
  Lens lens;
  bool operator==(const PerspectiveCamera&) const = default;
};

struct OrthographicCamera {
  Transform camera_to_world;
  ScreenWindow screen;
  Lens lens;
  bool operator==(const OrthographicCamera&) const = default;
};

// The whole sphere of directions around the camera, +y up: by latitude and longitude, or the equal-area
// octahedral map.
struct SphericalCamera {
  enum class Projection : std::uint8_t { equal_area, latitude_longitude };
  Transform camera_to_world;
  Projection projection = Projection::equal_area;
  bool operator==(const SphericalCamera&) const = default;
};

// Irradiance meters instead of a picture: column x of the raster is sensor x, and every row repeats it with
// samples of its own, so that rows tell how far their mean is off. A sensor is as a white diffuse surface
// that is seen: its radiance times π, the film's imaging ratio, is the irradiance.
struct Sensor {
  Point3d position;          // in camera space
  Vector3d normal{0, 0, 1};  // unit
  bool operator==(const Sensor&) const = default;
};
struct SensorCamera {
  Transform camera_to_world;
  std::vector<Sensor> sensors;
  bool operator==(const SensorCamera&) const = default;
};

// A lens of many surfaces before a film (Kolb, Mitchell, Hanrahan 1995), as pbrt's. The film is in the plane
// z = 0, its middle at the origin.
struct LensSurface {
  double radius = 0;     // of curvature; above 0: its centre is on the film's side. 0: the stop, a plane
  double thickness = 0;  // to the next surface towards the film; of the last, to the film
  double index = 1;      // of refraction, towards the film
  double aperture_radius = 0;
  bool operator==(const LensSurface&) const = default;
};
// Of a ring of the film: where its rays to the plane of the lens's last vertex go to, for a point of the film
// on the x axis (they turn with it), and what each brings beside cos⁴θ.
struct ExitPupil {
  ScreenWindow rectangle{0, 0, 0, 0};
  double weight = 0;
  bool operator==(const ExitPupil&) const = default;
};
struct RealisticCamera {
  Transform camera_to_world;
  double film_diagonal = 0;
  std::vector<LensSurface> surfaces;  // from the scene to the film
  std::vector<ExitPupil> pupils;      // of rings of the film, equally wide, out to half the diagonal
  bool operator==(const RealisticCamera&) const = default;
};

using Camera =
    std::variant<PerspectiveCamera, OrthographicCamera, SphericalCamera, SensorCamera, RealisticCamera>;

// Pixel reconstruction filters, all normalised; radii and σ in pixels. The Gaussian is pbrt's: lowered to
// reach 0 at its radius.
struct BoxFilter {
  double radius_x = 0.5, radius_y = 0.5;
  bool operator==(const BoxFilter&) const = default;
};
struct TriangleFilter {
  double radius_x = 2, radius_y = 2;
  bool operator==(const TriangleFilter&) const = default;
};
struct GaussianFilter {
  double radius_x = 1.5, radius_y = 1.5, sigma = 0.5;
  bool operator==(const GaussianFilter&) const = default;
};
// Mitchell and Netravali 1988, their B and C; its two radii of support are stretched to the radius.
struct MitchellFilter {
  double radius_x = 2, radius_y = 2, b = 1.0 / 3, c = 1.0 / 3;
  bool operator==(const MitchellFilter&) const = default;
};
// sinc(x)·sinc(x/τ): Lanczos' window of τ lobes, cut at the radius.
struct SincFilter {
  double radius_x = 4, radius_y = 4, tau = 3;
  bool operator==(const SincFilter&) const = default;
};
using Filter = std::variant<BoxFilter, TriangleFilter, GaussianFilter, MitchellFilter, SincFilter>;

// Pixels x in [x0,x1), y in [y0,y1), from the top left.
struct PixelRect {
  int x0 = 0, x1 = 0, y0 = 0, y1 = 0;
  bool operator==(const PixelRect&) const = default;
};

struct FilmSettings {
  int width = 1280, height = 720;
  PixelRect crop{0, 1280, 0, 720};
  Filter filter = GaussianFilter{};
  double imaging_ratio = 1;  // every pixel is multiplied by it (pbrt: exposure time · ISO / 100)
  SpectralBins spectrum;     // kept beside the colours; none: colours alone
  FilmLayers layers;         // of the first surfaces, kept too
  bool operator==(const FilmSettings&) const = default;
};

inline constexpr int unlimited_depth = 1 << 20;

// What the scene file asks for; the command line overrides it. Depth counts scattering events as pbrt does: 0
// shows emitters only, 1 adds direct light.
// How colours given as RGB become spectra.
enum class RgbMethod {
  jakob_hanika,  // smooth sigmoids (scene/rgb_to_spectrum.h)
  matrix_r,      // sums of D65 times the colour-matching functions (scene/matrix_r.h)
};

// Photon mapping. Empty optionals: as the extent of the scene and the size of the picture suggest.
struct PhotonSettings {
  std::optional<std::uint64_t> photons;  // an iteration, which is a sample of every pixel
  std::optional<double> first_radius;    // in which they are gathered, scene units
  std::optional<double> alpha;           // how fast the radius shrinks, in (0, 1); ⅔
  bool operator==(const PhotonSettings&) const = default;
};

struct RenderSettings {
  int samples_per_pixel = 16;
  int max_depth = 5;
  bool direct_only = false;  // direct light at the first diffuse hit; specular chains go on
  // Whether going straight through a MaskMaterial or a thin sheet is a scattering event, too. Mitsuba's
  // volumetric integrators do not count it. (Going through where a shape's opacity says that nothing is there
  // never is.)
  bool straight_counts = true;
  RgbMethod rgb = RgbMethod::jakob_hanika;
  std::optional<PhotonSettings> photons;  // empty: no photon mapping
  bool operator==(const RenderSettings&) const = default;
};

}  // namespace vitrail
