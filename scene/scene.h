// SPDX-License-Identifier: Apache-2.0
// The Scene: what every importer makes and the partitioner takes. Plain records; free functions work on them.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scene/diagnostics.h"
#include "scene/id.h"
#include "scene/spectrum.h"
#include "scene/transform.h"
#include "scene/vec.h"

namespace vitrail {

// ---- Geometry
// ------------------------------------------------------------------------------------------------

// Object-space triangles. `normals` and `uvs` are empty or have one entry a position.
// All indices are in range and all positions finite: importers guarantee it, with the place of the first
// offender.
struct TriangleMesh {
  std::vector<Point3f> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Normal3f> normals;  // shading normals, not necessarily unit length
  std::vector<Point2f> uvs;       // v = 0 is the bottom row of an image
  bool operator==(const TriangleMesh&) const = default;
};

// ---- Materials
// -----------------------------------------------------------------------------------------------

// Lambertian on both sides: f = reflectance/π.
struct DiffuseMaterial {
  Spectrum reflectance = ConstantSpectrum{0.5f};
  bool operator==(const DiffuseMaterial&) const = default;
};

// Smooth interface between vacuum (on the front side) and a medium of index eta(λ) (behind).
struct DielectricMaterial {
  Spectrum eta = ConstantSpectrum{1.5f};
  bool operator==(const DielectricMaterial&) const = default;
};

// No interface at all: rays go through unchanged.
struct InterfaceMaterial {
  bool operator==(const InterfaceMaterial&) const = default;
};

using Material = std::variant<DiffuseMaterial, DielectricMaterial, InterfaceMaterial>;

// ---- Lights
// --------------------------------------------------------------------------------------------------

// Emission of a surface: radiance, W·m⁻²·sr⁻¹·nm⁻¹, from its front side or from both.
struct AreaLight {
  Spectrum radiance;
  bool two_sided = false;
  bool operator==(const AreaLight&) const = default;
};

// Radiant intensity, W·sr⁻¹·nm⁻¹, equal in all directions.
struct PointLight {
  Point3d position;
  Spectrum intensity;
  bool operator==(const PointLight&) const = default;
};

// Irradiance on a plane across `direction` (unit, the way the light travels), W·m⁻²·nm⁻¹.
struct DistantLight {
  Vector3d direction;
  Spectrum irradiance;
  bool operator==(const DistantLight&) const = default;
};

// Constant radiance from everywhere around the scene.
struct InfiniteLight {
  Spectrum radiance;
  bool operator==(const InfiniteLight&) const = default;
};

using Light = std::variant<PointLight, DistantLight, InfiniteLight>;

// ---- Placement
// -----------------------------------------------------------------------------------------------

// The front of a triangle is the side from which its vertices, taken to the world, run counter-clockwise;
// `flip_orientation` swaps the sides.
struct Shape {
  Id<TriangleMesh> mesh;
  Id<Material> material;
  std::optional<Id<AreaLight>> area_light;
  Transform object_to_world;  // to the prototype's space for shapes of a prototype
  bool flip_orientation = false;
  bool operator==(const Shape&) const = default;
};

// Shapes that are used many times (pbrt's ObjectBegin, Mitsuba's shapegroup).
struct Prototype {
  std::string name;
  std::vector<Shape> shapes;
  bool operator==(const Prototype&) const = default;
};

// If the transform mirrors, the prototype's own front sides stay its front sides.
struct Instance {
  Id<Prototype> prototype;
  Transform prototype_to_world;
  bool operator==(const Instance&) const = default;
};

// ---- Camera and film
// -----------------------------------------------------------------------------------------

// Camera space: +z is the view, +x raster right, +y up. The raster covers `screen` (in units of the plane z =
// 1 for the perspective camera, of the world for the orthographic one): x0 at the left edge, y1 at the top.
struct ScreenWindow {
  double x0 = -1, x1 = 1, y0 = -1, y1 = 1;
  bool operator==(const ScreenWindow&) const = default;
};

struct PerspectiveCamera {
  Transform camera_to_world;
  ScreenWindow screen;  // tan of the half angles: ±tan(fov/2) on the axis that fov measures
  bool operator==(const PerspectiveCamera&) const = default;
};

struct OrthographicCamera {
  Transform camera_to_world;
  ScreenWindow screen;
  bool operator==(const OrthographicCamera&) const = default;
};

using Camera = std::variant<PerspectiveCamera, OrthographicCamera>;

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
using Filter = std::variant<BoxFilter, TriangleFilter, GaussianFilter>;

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
  bool operator==(const FilmSettings&) const = default;
};

// What the scene file asks for; the command line overrides it. Depth counts scattering events as pbrt does: 0
// shows emitters only, 1 adds direct light.
struct RenderSettings {
  int samples_per_pixel = 16;
  int max_depth = 5;
  bool direct_only = false;  // direct light at the first diffuse hit; specular chains go on
  bool operator==(const RenderSettings&) const = default;
};

// ---- The scene
// -----------------------------------------------------------------------------------------------

struct Scene {
  std::vector<TriangleMesh> meshes;
  std::vector<Material> materials;
  std::vector<AreaLight> area_lights;
  std::vector<Light> lights;
  std::vector<Shape> shapes;
  std::vector<Prototype> prototypes;
  std::vector<Instance> instances;
  Camera camera = PerspectiveCamera{};
  FilmSettings film;
  RenderSettings settings;
};

// A Scene and what of its file it does not say exactly.
struct ImportedScene {
  Scene scene;
  Diagnostics diagnostics;
};

}  // namespace vitrail
