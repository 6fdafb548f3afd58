// SPDX-License-Identifier: Apache-2.0
// The Scene is what every importer makes, every exporter writes and the partitioner takes. It consists of
// plain records; free functions work on them. It holds what the files say in the files' own terms: it is
// decided later how much of it a renderer can show.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/geometry/motion.h"
#include "scene/records/camera.h"
#include "scene/records/film_settings.h"
#include "scene/records/id.h"
#include "scene/records/light.h"
#include "scene/records/material.h"
#include "scene/records/medium.h"
#include "scene/records/render_settings.h"
#include "scene/records/texture.h"
#include "scene/shapes/mesh.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

// The front of a triangle is the side from which its vertices, taken to the world, run counter-clockwise;
// `flip_orientation` swaps the sides. Shading normals do not decide sides.
struct Shape {
  Id<TriangleMesh> mesh;
  Id<Material> material;
  std::optional<Id<AreaLight>> area_light;
  // It is the share of the surface that is there. A share 1 − opacity of the rays passes as if nothing were
  // there: that is no event, and does not count in a path's depth. The missing part does not shine. Constant
  // 0 with an area light means that nothing meets the surface, but the light shines in full (pbrt-v4's
  // invisible light).
  FloatParameter opacity = 1.0f;
  Transform object_to_world;  // to the prototype's space for shapes of a prototype
  bool flip_orientation = false;
  std::optional<Id<Medium>> interior, exterior;  // behind and in front of the surface; none: vacuum
  std::string name;                              // "" where the file gives none
  Origin origin;
  bool operator==(const Shape&) const = default;
};

struct Prototype;

// It places a prototype. If the transform mirrors, the prototype's own front sides stay its front sides.
struct Instance {
  Id<Prototype> prototype;
  Transform prototype_to_world;  // to the outer prototype's space for instances in a prototype
  Origin origin;
  std::optional<Id<Motion>> motion =
      {};  // of prototype_to_world, which is where it is when the shutter opens
  bool operator==(const Instance&) const = default;
};

// It is used many times (pbrt's ObjectBegin, Mitsuba's shapegroup). Its instances are of prototypes with
// smaller ids.
struct Prototype {
  std::string name;
  std::vector<Shape> shapes;
  std::vector<Instance> instances;
  Origin origin;
  bool operator==(const Prototype&) const = default;
};

// It holds everything that a scene file says, in one form for all formats.
struct Scene {
  Scene();
  Scene(const Scene&);
  Scene(Scene&&) noexcept;
  Scene& operator=(const Scene&);
  Scene& operator=(Scene&&) noexcept;
  ~Scene();

  std::vector<std::string> files;  // that Origins speak of
  std::vector<TriangleMesh> meshes;
  std::vector<Texture> textures;
  std::vector<Material> materials;
  std::vector<Medium> media;
  std::vector<AreaLight> area_lights;
  std::vector<Light> lights;
  std::vector<Shape> shapes;
  std::vector<Prototype> prototypes;
  std::vector<Instance> instances;
  std::vector<Motion> motions;  // of instances
  Camera camera = PerspectiveCamera{};
  Motion camera_motion;                     // of its transform, which is where it is when the shutter opens
  Shutter shutter;                          // where anything moves
  std::optional<Id<Medium>> camera_medium;  // what the camera is in; none: vacuum
  FilmSettings film;
  RenderSettings settings;
  Origin camera_origin, film_origin, sampler_origin, integrator_origin;  // line 0: the file has none
};

// Returns {} where the origin is not known.
SourceLocation location(const Scene& scene, const Origin& origin);

// It holds a Scene and diagnostics for what it does not say exactly as its file does.
struct ImportedScene {
  Scene scene;
  Diagnostics diagnostics;
};

}  // namespace vitrail
