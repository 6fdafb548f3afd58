// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/write/write_shapes.h"

#include <algorithm>
#include <iterator>

#include "importers/mitsuba/write/rgb_variants.h"
#include "importers/mitsuba/write/unseen_lamps.h"
#include "importers/mitsuba/write/write_curves.h"
#include "importers/mitsuba/write/write_lights.h"
#include "importers/mitsuba/write/write_materials.h"
#include "importers/mitsuba/write/write_media.h"
#include "importers/mitsuba/write/write_sides.h"
#include "importers/shapes/vertex_normals.h"
#include "importers/writing/placed_quadric.h"
#include "scene/records/kinds.h"
#include "scene/shapes/deferred_mesh.h"

namespace vitrail::mitsuba_writer {

namespace {

bool sides_matter(const Context& context, const Shape& shape) {
  return shape.area_light || shape.interior || shape.exterior || context.sided[shape.material.value];
}

bool is_there(const Shape& shape) { return shape.opacity == FloatParameter{1.0f}; }

// What is not there of a shape is a mask around its material.
void write_mask(Context& context, Element root, const Shape& shape) {
  if (is_there(shape) || is_unseen_lamp(shape)) return;
  std::string& id = context.masks[{shape.material.value, opacity_key(shape.opacity)}];
  if (!id.empty()) return;
  id = context.new_id("", "mask", context.masks.size() - 1);
  context.origin = shape.origin;
  write_model(context, root, Material{MaskMaterial{shape.opacity, shape.material}}, id);
}

const std::string& bsdf_of(const Context& context, const Shape& shape) {
  if (is_there(shape)) return context.material_ids[shape.material.value];
  return context.masks.at({shape.material.value, opacity_key(shape.opacity)});
}

// Mitsuba joins meshes of one bsdf, and refuses those of which some are turned and some are not: the others
// have a mask around it that hides nothing. (Of equal copies Mitsuba makes one.)
std::string bsdf_facing(Context& context, Element parent, const std::string& id, bool turned) {
  Context::Facing& facing = context.facings.try_emplace(id, Context::Facing{turned}).first->second;
  if (facing.turned == turned) return id;
  if (!facing.other.empty()) return facing.other;
  Element root = parent.root().child("scene");
  const Element original = root.find_child_by_attribute("bsdf", "id", id.c_str());
  if (!original) return id;
  facing.other = context.new_id(id + "-turned", "material", context.facings.size());
  Element mask = root.insert_child_after("bsdf", original);
  mask.append_attribute("type") = "mask";
  mask.append_attribute("id") = facing.other.c_str();
  add_float(mask, "opacity", 1.0f);
  add_reference(mask, id);
  return facing.other;
}

Element add_mesh(Context& context, Element parent, const Shape& shape, const MeshFile& file,
                 const std::string& id) {
  const TriangleMesh& mesh = context.scene.meshes[shape.mesh.value];
  Element element = add(parent, "shape", "ply", "", id);
  add_string(element, "filename", file.filename);
  add_transform(element, shape.object_to_world);
  add_boolean(element, "face_normals", mesh.normals.empty() && !mesh.quadric);
  // Where nobody sees the side, all of a bsdf are as they are, and need no copy of it.
  const bool is_turned =
      file.flip_normals && (sides_matter(context, shape) || !context.turned_both_ways[shape.material.value]);
  add_boolean(element, "flip_normals", is_turned);
  add_reference(element, bsdf_facing(context, parent, bsdf_of(context, shape), is_turned), "bsdf");
  return element;
}

// As Mitsuba has it: it takes spheres and cylinders for round, and all for whole.
std::optional<QuadricShape> quadric_of(Context& context, const Shape& shape) {
  const auto placed = placed_quadric(context.scene, shape, QuadricUv::mitsuba, context.uv_uses);
  if (!placed || !is_whole(placed->quadric)) return std::nullopt;
  const Axes axes = axes_of(placed->to_world);
  switch (placed->quadric.kind) {
    case QuadricKind::sphere:
      return axes.keep_spheres() ? placed : std::nullopt;
    case QuadricKind::cylinder:
      return axes.keep_circles() ? placed : std::nullopt;
    case QuadricKind::disk:
      return placed;
    default:
      return std::nullopt;
  }
}

// Of a transform that moves and scales alone, the scale; else 0.
double plain_scale(const Transform& t) {
  const double s = t.m[0][0];
  return s > 0 && translate({t.m[0][3], t.m[1][3], t.m[2][3]}) * scale({s, s, s}) == t ? s : 0;
}

Element add_quadric(Context& context, Element parent, const Shape& shape, const QuadricShape& placed,
                    const std::string& id) {
  const Transform& t = placed.to_world;
  const bool sphere = placed.quadric.kind == QuadricKind::sphere;
  Element element = add(parent, "shape", kind_of(placed.quadric.kind), "", id);
  if (const double radius = sphere ? plain_scale(t) : 0; radius > 0) {
    add_coordinates(element, "point", "center", Vector3d{t.m[0][3], t.m[1][3], t.m[2][3]});
    add_float(element, "radius", radius);
  } else if (t != Transform{}) {
    add_transform(element, t);
  }
  // A mirror turns only spheres inside out.
  const bool turned = !sphere && sides_matter(context, shape) && swaps_handedness(t);
  add_boolean(element, "flip_normals", placed.flip_orientation != turned);
  add_reference(element, bsdf_of(context, shape), "bsdf");
  return element;
}

// Right behind it, and facing backwards.
QuadricShape back_of(const QuadricShape& placed) {
  constexpr double gap = 1e-4;
  const double behind = placed.flip_orientation != swaps_handedness(placed.to_world) ? gap : -gap;
  const double across = 1 + behind, along = placed.quadric.kind == QuadricKind::sphere ? across : 1;
  QuadricShape back = placed;
  back.flip_orientation = !placed.flip_orientation;
  back.to_world =
      placed.to_world *
      (placed.quadric.kind == QuadricKind::disk ? translate({0, 0, behind}) : scale({across, across, along}));
  return back;
}

void add_media(const Context& context, Element element, const Shape& shape) {
  const std::string inside =
      shape.interior ? context.medium_ids[shape.interior->value] : interior_of(context, shape.material);
  if (!inside.empty()) add_reference(element, inside, "interior");
  if (shape.exterior) add_reference(element, context.medium_ids[shape.exterior->value], "exterior");
}

// Of a surface of which something is not there: Mitsuba's masks leave the light of the surface alone.
AreaLight light_of(Context& context, const Shape& shape) {
  AreaLight light = context.exposed.area_lights[shape.area_light->value];
  // Ids are unique, and a lamp that has none is known by its shape, or by its material.
  if (light.name == shape.name || light.name == context.scene.materials[shape.material.value].name)
    light.name.clear();
  if (!is_there(shape)) light.scale *= constant_of(context, shape.opacity, "the opacity of what shines");
  return light;
}

void write_shape(Context& context, Element parent, const Shape& shape, std::size_t index) {
  if (is_unseen_lamp(shape)) return write_unseen_lamp(context, parent, shape);
  context.begin(RecordKind::shape, shape.origin);
  const std::string id = shape.name.empty() ? "" : context.new_id(shape.name, "shape", index);
  const std::vector<Element> curves = add_curves(context, parent, shape, sides_matter(context, shape), id);
  for (Element element : curves) {
    add_reference(element, bsdf_of(context, shape), "bsdf");
    add_media(context, element, shape);
  }
  if (!curves.empty()) return;
  if (context.hair_along_u[shape.material.value])
    context.approximated("Mitsuba's hair runs along v, this along u");
  const auto quadric = quadric_of(context, shape);
  const TriangleMesh& mesh = context.scene.meshes[shape.mesh.value];
  if (mesh.quadric && !quadric) context.approximated(as_triangles(*mesh.quadric));
  Element element =
      quadric ? add_quadric(context, parent, shape, *quadric, id)
              : add_mesh(context, parent, shape, mesh_file(context, shape, sides_matter(context, shape)), id);
  add_media(context, element, shape);
  if (!quadric && !mesh.deferred && !is_mitsuba_file(context.scene, shape.origin) && normals_lean(mesh, 45))
    context.approximated(
        "its shading normals lean by more than 45° from its faces: where one looks away from the eye, "
        "Mitsuba "
        "shows the light of the other side (of a cube with smooth edges a pixel of 144 by 18 %)");
  if (!shape.area_light) return;
  const AreaLight light = light_of(context, shape);
  write_area_light(context, element, light, shape);
  TriangleMesh storage;
  if (!quadric && normals_lean(loaded(mesh, storage), 14))
    context.approximated("Mitsuba 3.9 weighs the light of a mesh by its shading normals");
  if (!light.two_sided) return;
  context.approximated(
      "Mitsuba's area lights shine to one side: a copy of the surface right behind it shines to the other");
  write_area_light(context,
                   quadric ? add_quadric(context, parent, shape, back_of(*quadric), "")
                           : add_mesh(context, parent, shape, back_of(context, shape), ""),
                   light, shape);
}

// Mitsuba allows no area lights in shape groups: they are written with every instance.
struct Group {
  bool empty = true;
  std::vector<std::size_t> outside;  // shapes of the prototype
};

Group group_of(const Prototype& prototype) {
  Group group;
  for (std::size_t i = 0; i < prototype.shapes.size(); ++i)
    if (prototype.shapes[i].area_light)
      group.outside.push_back(i);
    else
      group.empty = false;
  return group;
}

void write_prototype(Context& context, Element root, const Prototype& prototype, const Group& group,
                     std::size_t index) {
  context.begin(RecordKind::object, prototype.origin);
  std::string& id = context.prototype_ids[index];
  id = context.new_id(prototype.name, "shapegroup", index);
  if (group.empty) return;
  Element element = add(root, "shape", "shapegroup", "", id);
  for (std::size_t i = 0; i < prototype.shapes.size(); ++i) {
    const Shape& shape = prototype.shapes[i];
    if (shape.area_light) continue;
    write_shape(context, element, shape, i);
    if (mitsuba::has_read_vertices(context.scene, context.scene.meshes[shape.mesh.value]))
      context.approximated("attributes of vertices in instances: Mitsuba 3.9 takes them from elsewhere");
  }
}

void write_instance(Context& context, Element root, const Instance& instance, const Group& group) {
  if (!group.empty) {
    Element element = add(root, "shape", "instance");
    add_reference(element, context.prototype_ids[instance.prototype.value]);
    add_transform(element, instance.prototype_to_world);
  }
  for (const std::size_t i : group.outside) {
    Shape shape = context.scene.prototypes[instance.prototype.value].shapes[i];
    shape.object_to_world = instance.prototype_to_world * shape.object_to_world;
    if (swaps_handedness(instance.prototype_to_world)) shape.flip_orientation = !shape.flip_orientation;
    shape.name.clear();
    write_shape(context, root, shape, i);
    context.begin(RecordKind::instance, instance.origin);
    context.approximated("Mitsuba instances no area lights: this one is a shape of its own");
  }
}

}  // namespace

namespace {

// Of each material: whether shapes of it face both ways.
std::vector<bool> turned_both_ways(const Scene& scene) {
  std::vector<bool> turned(scene.materials.size()), plain(turned), both(turned);
  const auto look_at = [&](const Shape& shape) {
    const std::size_t material = shape.material.value;
    (shape.flip_orientation ? turned : plain)[material] = true;
    both[material] = turned[material] && plain[material];
  };
  std::ranges::for_each(scene.shapes, look_at);
  for (const Prototype& prototype : scene.prototypes) std::ranges::for_each(prototype.shapes, look_at);
  return both;
}

}  // namespace

void write_shapes(Context& context, Element root) {
  const Scene& scene = context.scene;
  context.turned_both_ways = turned_both_ways(scene);
  context.unseen_lamps = count_unseen_lamps(scene);
  for (const Shape& shape : scene.shapes) write_mask(context, root, shape);
  for (const Prototype& prototype : scene.prototypes)
    for (const Shape& shape : prototype.shapes) write_mask(context, root, shape);
  context.prototype_ids.resize(scene.prototypes.size());
  std::vector<Group> groups;
  std::ranges::transform(scene.prototypes, std::back_inserter(groups), group_of);
  std::size_t next = 0;
  const auto first_mesh = [](const Prototype& prototype) {
    return prototype.shapes.empty() ? 0u : prototype.shapes.front().mesh.value;
  };
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
    while (next < scene.prototypes.size() &&
           first_mesh(scene.prototypes[next]) < scene.shapes[i].mesh.value) {
      write_prototype(context, root, scene.prototypes[next], groups[next], next);
      ++next;
    }
    write_shape(context, root, scene.shapes[i], i);
  }
  for (; next < scene.prototypes.size(); ++next)
    write_prototype(context, root, scene.prototypes[next], groups[next], next);
  for (const Instance& instance : scene.instances) {
    context.begin(RecordKind::instance, instance.origin);
    write_instance(context, root, instance, groups[instance.prototype.value]);
  }
}

}  // namespace vitrail::mitsuba_writer
