// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "importers/bytes/text_cursor.h"
#include "importers/mitsuba/read/shape_geometry.h"
#include "importers/mitsuba/read/subsurface.h"
#include "importers/reading/suggestion.h"
#include "importers/shapes/vertex_normals.h"
#include "scene/shapes/curve.h"

namespace vitrail::mitsuba {

namespace {

const std::vector<std::string> kinds{"obj",   "ply",         "serialized",   "rectangle",     "sphere",
                                     "cube",  "disk",        "cylinder",     "instance",      "shapegroup",
                                     "merge", "linearcurve", "bsplinecurve", "sdfgrid",       "heightfield",
                                     "hair",  "deformable",  "ellipsoids",   "ellipsoidsmesh"};

const std::vector<std::string> parameters{
    "to_world", "bsdf",        "emitter", "interior",        "exterior", "flip_normals",    "face_normals",
    "filename", "shape_index", "radius",  "flip_tex_coords", "center",   "max_smooth_angle"};

// What the programs that write Mitsuba's files call records without a name.

// Mitsuba's lamps reflect nothing unless they are given a bsdf. Before version 2 what bounds a medium has no
// surface unless it is given one.
Id<Material> default_material(Builder& builder, const Object& shape) {
  const bool shines = !shape.children("emitter").empty(),
             bounds = shape.boolean("media_have_no_surface", false, builder.report) && !shines &&
                      !shape.children("medium").empty();
  std::optional<Id<Material>>& known = builder.default_materials[shines ? 1 : bounds ? 2 : 0];
  if (!known) {
    Material material;
    if (shines) material.model = DiffuseMaterial{.reflectance = ConstantSpectrum{0}};
    if (bounds) material.model = InterfaceMaterial{};
    material.two_sided = false;
    material.origin = shape.origin;
    known = append(builder, std::move(material));
  }
  return *known;
}

Id<Material> material_of(Builder& builder, const Object& shape, const ShapeGeometry& geometry) {
  const auto bsdfs = shape.children("bsdf");
  shape.ignore({"media_have_no_surface"});
  if (geometry.bsdf) return add_material(builder, *std::get<ObjectPtr>(geometry.bsdf->value));
  if (geometry.part) {
    builder.report.approximated(fmt::format("obj: no bsdf has the name of its material \"{}\": diffuse, .5",
                                            printable(*geometry.part)),
                                shape.origin);
    return default_material(builder, shape);
  }
  if (bsdfs.size() > 1)
    builder.report.dropped("more than one bsdf of a shape: the first counts", bsdfs[1]->origin);
  if (bsdfs.empty()) return default_material(builder, shape);
  return add_material(builder, *std::get<ObjectPtr>(bsdfs.front()->value));
}

void add_media(Builder& builder, const Object& object, Shape& shape) {
  for (const Property* medium : object.children("medium")) {
    if (medium->name == "interior" || medium->name == "exterior")
      (medium->name == "interior" ? shape.interior : shape.exterior) =
          add_medium(builder, *std::get<ObjectPtr>(medium->value));
    else
      builder.report.dropped("a medium that is neither \"interior\" nor \"exterior\"", medium->origin);
  }
}

void add_emission(Builder& builder, const Object& object, bool in_group, Shape& shape) {
  const auto emitters = object.children("emitter");
  if (emitters.empty()) return;
  if (in_group)
    return builder.report.dropped("emitters in shape groups: Mitsuba allows none", emitters[0]->origin);
  if (emitters.size() > 1)
    builder.report.dropped("more than one emitter of a shape: the first counts", emitters[1]->origin);
  shape.area_light = add_area_light(builder, *std::get<ObjectPtr>(emitters.front()->value));
  TriangleMesh storage;
  const TriangleMesh& mesh = builder.scene.meshes[shape.mesh.value];
  if (shape.area_light && !mesh.quadric && normals_lean(loaded(mesh, storage), 14))
    builder.report.approximated(
        "the light of a mesh goes by its triangles: Mitsuba 3.9 weighs it by the shading normals",
        object.origin);
  builder.report.begin_item({object.origin, RecordKind::shape});
}

bool sides_matter(const Builder& builder, const Shape& shape) {
  return shape.area_light || shape.interior || shape.exterior || builder.sided.at(shape.material.value);
}

// Where it moves, where it is when the shutter opens.
Transform to_world(Builder& builder, const Object& object) {
  const std::vector<Keyframe> keys = object.keyframes("to_world");
  const Transform t = can_move(keys) ? Motion(keys).at(builder.scene.shutter.open_s)
                                     : object.transform("to_world", builder.report);
  for (const auto& row : t.m)
    for (const double entry : row)
      if (!std::isfinite(entry))
        builder.report.fail("the transform is not finite", object.find("to_world")->origin);
  return t;
}

// Mitsuba's spheres are round whatever their to_world does: the radius is that along x (measured with 3.9.1).
// Its z and y are turned as far as they have to be.
Transform round(Builder& builder, const Object& sphere, const Transform& to_world,
                const Transform& to_object) {
  const Transform t = to_world * to_object;
  if (is_similarity(t)) return t;
  builder.report.approximated(
      "a sphere that to_world stretches: Mitsuba shows it round, with its radius along x", sphere.origin);
  const Vector3d x = transform_vector(t, {1, 0, 0}), side = transform_vector(t, {0, 1, 0});
  const double radius = length(x);
  const Vector3d z = normalize(cross(x, side)) * radius;
  const Vector3d y = cross(z, x) * (1 / radius);
  const double handed = swaps_handedness(t) ? -1 : 1;
  Transform ball = translate(transform_point(t, {0, 0, 0}) - Point3d{});
  for (std::size_t row = 0; row < 3; ++row) {
    const auto at = [&](const Vector3d& v) { return row == 0 ? v.x : row == 1 ? v.y : v.z; };
    ball.m[row][0] = at(x), ball.m[row][1] = at(y), ball.m[row][2] = handed * at(z);
  }
  return ball;
}

// A sensor of a shape measures the mean irradiance of it: for a rectangle the report says how it is measured
// here.
void report_sensors(Builder& builder, const Object& shape, const Transform& to_world) {
  for (const Property* sensor : shape.children("sensor")) {
    const std::string& kind = std::get<ObjectPtr>(sensor->value)->type;
    if (kind != "irradiancemeter" || shape.type != "rectangle") {
      builder.report.dropped(fmt::format("sensor \"{}\" of a {}", kind, shape.type), sensor->origin);
      continue;
    }
    Vector3d u = transform_vector(to_world, {2, 0, 0}), v = transform_vector(to_world, {0, 2, 0});
    Point3d corner = transform_point(to_world, {-1, -1, 0});
    if (shape.boolean("flip_normals", false, builder.report) != swaps_handedness(to_world)) std::swap(u, v);
    corner = corner + unit(cross(u, v)) * (1e-4 * std::max(length(u), length(v)));  // off the surface
    builder.report.dropped(
        fmt::format("sensor \"irradiancemeter\": the mean of what render --sensors measures by the line "
                    "\"plane {:g} {:g} {:g}  {:g} {:g} {:g}  {:g} {:g} {:g}  8x8\"",
                    corner.x, corner.y, corner.z, u.x, u.y, u.z, v.x, v.y, v.z),
        sensor->origin);
  }
}

void add_geometry(Builder& builder, const Object& object, const ShapeGeometry& geometry,
                  const Transform& to_world, bool in_group, std::vector<Shape>& shapes) {
  Shape shape;
  shape.mesh = geometry.mesh;
  shape.name = name_of(object);
  shape.origin = object.origin;
  shape.object_to_world = geometry.in_world ? Transform{} : to_world;
  if (!in_group) report_sensors(builder, object, shape.object_to_world);
  if (kind_of(object) == "sphere")
    shape.object_to_world = round(builder, object, to_world, geometry.mesh_to_object);
  else if (geometry.mesh_to_object != Transform{})
    shape.object_to_world = shape.object_to_world * geometry.mesh_to_object;
  shape.material = material_of(builder, object, geometry);
  if (const auto inside = subsurface_material(builder, object, shape.material)) shape.material = *inside;
  add_media(builder, object, shape);
  add_emission(builder, object, in_group, shape);
  shape.flip_orientation = object.boolean("flip_normals", false, builder.report);
  if (geometry.front_by_normals && sides_matter(builder, shape)) {
    TriangleMesh storage;
    const TriangleMesh& mesh = builder.scene.meshes[shape.mesh.value];
    const bool opposed = !mesh.quadric && normals_oppose_winding(loaded(mesh, storage));
    if (opposed != swaps_handedness(shape.object_to_world)) {
      shape.flip_orientation = !shape.flip_orientation;
      if (builder.parts.at(shape.material.value).height)
        builder.report.approximated(
            "bump maps show where shading normals are on the other side than the winding: Mitsuba 3.9 shows "
            "black",
            object.origin);
    }
  }
  if (in_group && has_read_vertices(builder.scene, builder.scene.meshes[shape.mesh.value]))
    builder.report.approximated(
        "attributes of vertices in instances are those of the place met: Mitsuba 3.9 takes them from "
        "elsewhere",
        object.origin);
  shapes.push_back(std::move(shape));
}

void drop(Builder& builder, const Object& object) {
  const std::string kind = kind_of(object);
  const bool known = std::ranges::count(kinds, kind) > 0;
  builder.report.dropped(
      fmt::format("shape \"{}\" {}{}", object.type, known ? "is not supported" : "is unknown",
                  known ? "" : suggestion(kind, kinds)),
      object.origin);
}

void add_shapes(Builder& builder, const Object& object, bool in_group, std::vector<Shape>& shapes);

void add_children(Builder& builder, const Object& object, bool in_group, std::vector<Shape>& shapes) {
  for (const Property* child : object.children("shape"))
    add_shapes(builder, *std::get<ObjectPtr>(child->value), in_group, shapes);
}

Id<Prototype> prototype_of(Builder& builder, const Object& group) {
  if (const auto known = builder.prototypes.find(&group); known != builder.prototypes.end())
    return known->second;
  Prototype prototype;
  prototype.name = name_of(group);
  prototype.origin = group.origin;
  add_children(builder, group, true, prototype.shapes);
  builder.report.begin_item({group.origin, RecordKind::object});
  report_unused(group, builder.report);
  const Id<Prototype> id{static_cast<std::uint32_t>(builder.scene.prototypes.size())};
  builder.scene.prototypes.push_back(std::move(prototype));
  builder.prototypes.emplace(&group, id);
  return id;
}

void move(Builder& builder, const Motion& motion, Instance& instance) {
  Scene& scene = builder.scene;
  instance.prototype_to_world = motion.at(scene.shutter.open_s);
  if (stands_still(motion, scene.shutter)) return;
  instance.motion = Id<Motion>{static_cast<std::uint32_t>(scene.motions.size())};
  scene.motions.push_back(motion);
}

void add_instance(Builder& builder, const Object& object) {
  const auto groups = object.children("shape");
  const Object* group = groups.empty() ? nullptr : std::get<ObjectPtr>(groups.front()->value).get();
  if (!group || kind_of(*group) != "shapegroup")
    builder.report.fail("an instance needs a shape \"shapegroup\"", object.origin);
  object.ignore({"flip_normals"});
  Instance instance;
  instance.prototype = prototype_of(builder, *group);
  builder.report.begin_item({object.origin, RecordKind::instance});
  instance.prototype_to_world = to_world(builder, object);
  if (const auto motion = motion_of(builder, object.keyframes("to_world"), object.origin))
    move(builder, *motion, instance);
  instance.origin = object.origin;
  builder.scene.instances.push_back(instance);
  report_unused(object, builder.report, {"to_world"});
}

// What moves is an instance, as in Mitsuba 0.6.
void add_moving(Builder& builder, const Object& object, const ShapeGeometry& geometry, const Motion& motion) {
  Scene& scene = builder.scene;
  Prototype prototype;
  prototype.origin = object.origin;
  add_geometry(builder, object, geometry, {}, true, prototype.shapes);
  Instance instance{Id<Prototype>{static_cast<std::uint32_t>(scene.prototypes.size())}, {}, object.origin};
  move(builder, motion, instance);
  scene.prototypes.push_back(std::move(prototype));
  scene.instances.push_back(instance);
}

// Empty for kinds that are not known.
std::vector<ShapeGeometry> geometries_of(Builder& builder, const Object& object) {
  for (const auto make : {analytic_shape, curve_shape, distance_shape, height_shape})
    if (auto geometry = make(builder, object)) return {std::move(*geometry)};
  return shapes_of_file(builder, object);
}

void report_unnamed(Builder& builder, const Object& object, const std::vector<ShapeGeometry>& geometries) {
  for (const Property* bsdf : object.children("bsdf"))
    if (std::ranges::none_of(geometries, [&](const ShapeGeometry& g) { return g.bsdf == bsdf; }))
      builder.report.dropped(
          fmt::format("obj: the file has no material \"{}\", whose bsdf is not used", bsdf->name),
          bsdf->origin);
}

void add_shapes(Builder& builder, const Object& object, bool in_group, std::vector<Shape>& shapes) {
  builder.report.begin_item({object.origin, RecordKind::shape});
  const std::string kind = kind_of(object);
  if (kind == "shapegroup" || kind == "instance") {
    if (in_group)
      return builder.report.dropped(fmt::format("a shape \"{}\" inside of another shape", kind),
                                    object.origin);
    kind == "instance" ? add_instance(builder, object) : static_cast<void>(prototype_of(builder, object));
    return;
  }
  if (kind == "merge") {
    add_children(builder, object, in_group, shapes);
    return report_unused(object, builder.report);
  }
  if (builder.replace_missing && lacks_its_file(object)) {
    for (const Property& property : object.properties) property.queried = true;
    return builder.report.dropped(fmt::format("cannot find the file \"{}\": the shape is left out",
                                              object.text("filename", "", builder.report)),
                                  object.origin);
  }
  object.ignore({"silhouette_sampling_weight"});
  const std::vector<ShapeGeometry> geometries = geometries_of(builder, object);
  if (geometries.empty()) return drop(builder, object);
  const std::vector<Keyframe> keys = object.keyframes("to_world");
  if (in_group && !keys.empty())
    builder.report.approximated("motion of a shape in a group: it stands where it is when the shutter opens",
                                object.origin);
  const auto motion = in_group ? std::nullopt : motion_of(builder, keys, object.origin);
  for (const ShapeGeometry& geometry : geometries)
    if (motion && !stands_still(*motion, builder.scene.shutter))
      add_moving(builder, object, geometry, *motion);
    else
      add_geometry(builder, object, geometry, to_world(builder, object), in_group, shapes);
  if (geometries.front().part) report_unnamed(builder, object, geometries);
  builder.report.begin_item({object.origin, RecordKind::shape});
  report_unused(object, builder.report, parameters);
}

}  // namespace

void add_shape(Builder& builder, const Object& shape) {
  add_shapes(builder, shape, false, builder.scene.shapes);
}

}  // namespace vitrail::mitsuba
