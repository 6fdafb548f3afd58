// SPDX-License-Identifier: Apache-2.0
#include "importers/gltf/write/write_view.h"

#include <cmath>
#include <numbers>

#include "importers/gltf/write/values.h"
#include "importers/images/mean_intensity.h"
#include "importers/reading/sensor_view.h"
#include "importers/writing/export_colors.h"
#include "importers/writing/physical_light.h"
#include "scene/shapes/deferred_mesh.h"

namespace vitrail::gltf {

namespace {

int add(tinygltf::Model& model, tinygltf::Node node) {
  model.nodes.push_back(std::move(node));
  return static_cast<int>(model.nodes.size()) - 1;
}

// It looks along −z in glTF.
Transform frame_of(const Transform& camera_to_world) { return camera_to_world * scale({1, 1, -1}); }

// The greatest distance from a point to the boxes of what is there; 1 where there is nothing.
double reach(const Scene& scene, Point3d from) {
  double most = 0;
  const auto look_at = [&](const Shape& shape, const Transform& to_world) {
    const Bounds3f box = bounds_of(scene.meshes[shape.mesh.value]);
    for (int corner = 0; corner < 8 && !box.empty(); ++corner) {
      const Point3d p{(corner & 1 ? box.upper : box.lower).x, (corner & 2 ? box.upper : box.lower).y,
                      (corner & 4 ? box.upper : box.lower).z};
      most = std::max(most, length(transform_point(to_world, p) - from));
    }
  };
  for (const Shape& shape : scene.shapes) look_at(shape, shape.object_to_world);
  for (const Instance& instance : scene.instances)
    for (const Shape& shape : scene.prototypes[instance.prototype.value].shapes)
      look_at(shape, instance.prototype_to_world * shape.object_to_world);
  return most > 0 && std::isfinite(most) ? most : 1;
}

struct PunctualLight {
  std::string type;
  Spectrum emission;
  Transform to_world;
  double inner_rad = 0, outer_rad = 0;  // of a spot
};

Transform along(Vector3d direction) {
  const Vector3d z = normalize(-direction),
                 side = std::abs(z.y) < 0.9 ? Vector3d{0, 1, 0} : Vector3d{1, 0, 0};
  const Vector3d x = normalize(cross(side, z)), y = cross(z, x);
  Transform t;
  t.m[0] = {x.x, y.x, z.x, 0}, t.m[1] = {x.y, y.y, z.y, 0}, t.m[2] = {x.z, y.z, z.z, 0};
  return t;
}

struct Punctual {
  const Scene& scene;
  ConversionNotes& notes;
  using Result = std::optional<PunctualLight>;

  Result operator()(const PointLight& l) const {
    return PunctualLight{"point", intensity_of(l, l.position), translate(l.position - Point3d{})};
  }
  Result operator()(const DistantLight& l) const {
    return PunctualLight{"directional", l.irradiance, along(l.direction)};
  }
  Result operator()(const SpotLight& l) const {
    constexpr double radians = std::numbers::pi / 180;
    notes.approximated("a spot: programs fall off between its cones as they like");
    if (l.texture) notes.dropped("the texture of a spot");
    const Spectrum intensity = intensity_of(l, transform_point(l.light_to_world, {0, 0, 0}));
    if (l.tightness != 0) notes.dropped("the tightness of a spot");
    return PunctualLight{"spot", intensity, l.light_to_world * scale({1, -1, -1}),
                         static_cast<double>(l.beam_deg) * radians,
                         std::min(static_cast<double>(l.cutoff_deg), 90.0) * radians};
  }
  Result operator()(const GoniometricLight& l) const {
    const EvenLight even = even_light(l);
    notes.approximated(even.note);
    return PunctualLight{"point", even.intensity,
                         translate(transform_point(l.light_to_world, {0, 0, 0}) - Point3d{})};
  }
  Result operator()(const ProjectionLight&) const { return lost("a projector"); }
  Result operator()(const InfiniteLight&) const { return lost("light from all around"); }
  Result operator()(const EnvironmentLight&) const { return lost("an environment map"); }
  Result operator()(const SkyLight&) const { return lost("a sky"); }

 private:
  Spectrum intensity_of(const auto& light, Point3d position) const {
    const PhysicalLight physical = physical_light(scene, light.fading, position);
    if (!physical.note.empty()) notes.approximated(physical.note);
    return physical.factor == 1 ? light.intensity : scaled(light.intensity, physical.factor);
  }
  Result lost(const char* what) const {
    notes.dropped(std::string(what) + ": glTF has none");
    return {};
  }
};

}  // namespace

tinygltf::Node node_at(const Transform& t) {
  tinygltf::Node node;
  if (t == Transform{}) return node;
  for (std::size_t column = 0; column < 4; ++column)
    for (std::size_t row = 0; row < 4; ++row) node.matrix.push_back(t.m[row][column]);
  return node;
}

bool is_mirrored(const Camera& camera) {
  return std::visit([](const auto& c) { return swaps_handedness(frame_of(c.camera_to_world)); }, camera);
}

int write_camera(tinygltf::Model& model, ConversionNotes& notes, const Transform& mirror) {
  const Scene& scene = notes.scene;
  notes.begin(RecordKind::camera, scene.camera_origin);
  tinygltf::Camera out;
  Transform to_world;
  ScreenWindow screen;
  double focal_radius = 0;
  if (const auto* p = std::get_if<PerspectiveCamera>(&scene.camera)) {
    out.type = "perspective", to_world = p->camera_to_world, screen = p->screen,
    focal_radius = p->lens.radius;
  } else if (const auto* o = std::get_if<OrthographicCamera>(&scene.camera)) {
    out.type = "orthographic", to_world = o->camera_to_world, screen = o->screen,
    focal_radius = o->lens.radius;
  } else if (const auto* s = std::get_if<SensorCamera>(&scene.camera)) {
    notes.approximated("sensors: what the first one sees ahead, at 90 degrees");
    const PerspectiveCamera view = view_of(*s, scene.film);
    out.type = "perspective", to_world = view.camera_to_world, screen = view.screen;
  } else {
    notes.dropped("a camera of all directions, or of lenses: glTF has none");
    return -1;
  }
  const double width = (screen.x1 - screen.x0) / 2, height = (screen.y1 - screen.y0) / 2;
  if (std::abs(screen.x0 + screen.x1) > 1e-6 * width || std::abs(screen.y0 + screen.y1) > 1e-6 * height)
    notes.approximated("a picture beside the camera's axis: about the axis");
  if (focal_radius > 0) notes.dropped("depth of field: glTF's cameras have none");
  // Without planes of its own, around all that there is: what goes by depth buffers cuts there.
  const ClipRange clip = clip_of(scene.camera);
  const double around = 2 * reach(scene, transform_point(to_world, {0, 0, 0}));
  const double far = std::isfinite(clip.far) ? short_number(clip.far) : around;
  const double near = clip.near > 0 ? short_number(clip.near) : 1e-5 * std::min(far, around);
  if (out.type == "perspective") {
    out.perspective.yfov = 2 * std::atan(height), out.perspective.aspectRatio = width / height;
    out.perspective.znear = near, out.perspective.zfar = far;
  } else {
    out.orthographic.xmag = width, out.orthographic.ymag = height;
    out.orthographic.znear = near, out.orthographic.zfar = far;
  }
  model.cameras.push_back(std::move(out));
  tinygltf::Node node = node_at(mirror * frame_of(to_world));
  node.camera = static_cast<int>(model.cameras.size()) - 1, node.name = "camera";
  return add(model, std::move(node));
}

int write_light(tinygltf::Model& model, ConversionNotes& notes, const Scene& scene, const Light& light,
                const Transform& mirror) {
  notes.begin(RecordKind::light, light.origin);
  const auto punctual = std::visit(Punctual{scene, notes}, light.model);
  if (!punctual) return -1;
  if (!is_rgb(punctual->emission)) notes.approximated("spectrum of a light: its colour in linear sRGB");
  const RGB c = emission_rgb(punctual->emission);
  const double most = std::max({c.r, c.g, c.b});
  tinygltf::Light out;
  out.type = punctual->type, out.intensity = short_number(static_cast<float>(most));
  const auto share = [&](double v) { return most > 0 ? short_number(static_cast<float>(v / most)) : 1.0; };
  out.color = {share(c.r), share(c.g), share(c.b)};
  if (out.type == "spot")
    out.spot.innerConeAngle = std::min(punctual->inner_rad, punctual->outer_rad * (1 - 1e-6)),
    out.spot.outerConeAngle = punctual->outer_rad;
  model.lights.push_back(std::move(out));
  // A mirrored light shines as one that is turned: it is the same around its axis.
  Transform t = mirror * punctual->to_world;
  if (swaps_handedness(t)) t = t * scale({-1, 1, 1});
  tinygltf::Node node = node_at(t);
  tinygltf::Value::Object reference;
  reference["light"] = tinygltf::Value(static_cast<int>(model.lights.size()) - 1);
  node.extensions["KHR_lights_punctual"] = tinygltf::Value(reference);
  use(model, "KHR_lights_punctual");
  return add(model, std::move(node));
}

}  // namespace vitrail::gltf
