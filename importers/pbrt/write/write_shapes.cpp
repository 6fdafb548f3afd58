// SPDX-License-Identifier: Apache-2.0
// Shapes, objects and their instances.
#include <cmath>
#include <map>
#include <numbers>

#include "importers/pbrt/read/mesh_fronts.h"
#include "importers/pbrt/read/turning_motion.h"
#include "importers/pbrt/write/write_curves.h"
#include "importers/pbrt/write/write_images.h"
#include "importers/writing/placed_quadric.h"
#include "scene/geometry/bounds.h"
#include "scene/records/curve_uses.h"
#include "scene/records/kinds.h"
#include "scene/records/uv_uses.h"
#include "scene/shapes/deferred_mesh.h"
#include "scene/shapes/mesh_uv.h"

namespace vitrail::pbrt {

namespace {

// Small meshes stand in the file. Not those that lie far from the origin: they would be moved to it when they
// are read.
bool stands_in_file(const TriangleMesh& mesh) {
  constexpr std::size_t most_triangles = 64;
  if (mesh.triangles.size() > most_triangles) return false;
  Bounds3f bounds;
  for (const Point3f& p : mesh.positions) extend(bounds, p);
  const double half = length(extent(bounds)) / 2.0, away = length(center(bounds) - Point3f{});
  return away <= 512 * half;
}

template <class Values>
std::string listed(const char* type_and_name, const Values& values) {
  std::string text = fmt::format(" \"{}\" [", type_and_name);
  for (const auto& v : values) {
    if constexpr (requires { v.z; })
      text += fmt::format(" {} {} {}", v.x, v.y, v.z);
    else
      text += fmt::format(" {} {}", v.x, v.y);
  }
  return text + " ]";
}

std::string inline_mesh(const TriangleMesh& mesh) {
  std::string text = "Shape \"trianglemesh\" \"integer indices\" [";
  for (const auto& t : mesh.triangles) text += fmt::format(" {} {} {}", t[0], t[1], t[2]);
  text += " ]" + listed("point3 P", mesh.positions);
  if (!mesh.normals.empty()) text += listed("normal N", mesh.normals);
  if (!mesh.uvs.empty()) text += listed("point2 uv", mesh.uvs);
  for (const MeshAttribute& faces : mesh.attributes) {
    text += " \"integer faceIndices\" [";
    for (const float face : faces.values) text += fmt::format(" {}", face);
    text += " ]";
  }
  return text;
}

// A directive and what has to hold where it stands.
struct Written {
  std::string shape;
  Transform to_world;
  bool reversed = false;
};

// What the reader makes these radians of, and nothing else.
double degrees_of(double radians) {
  const double degrees = radians * 180 / std::numbers::pi;
  for (const double near : {degrees, std::nextafter(degrees, 0), std::nextafter(degrees, INFINITY)})
    if (near * std::numbers::pi / 180 == radians) return near;
  return degrees;
}

// Its sizes as pbrt has them, and the transform without them.
struct Sizes {
  double radius, height;
  Transform rest;
};

Sizes sizes_of(const Quadric& q, const Transform& to_world) {
  const Axes axes = axes_of(to_world);
  Sizes sizes{axes.x, q.kind == QuadricKind::cylinder ? axes.z : axes.x, to_world};
  for (auto& row : sizes.rest.m) row[0] /= axes.x, row[1] /= axes.x, row[2] /= axes.z;
  return sizes;
}

// What there is of the quadric, beside its radius; `height`: of a cylinder.
std::string extent_parameters(const Quadric& q, double height) {
  std::string text;
  const auto number = [&](const char* name, double value) {
    text += fmt::format(" \"float {}\" [ {} ]", name, value);
  };
  if (q.kind == QuadricKind::cylinder) {
    number("zmin", 0), number("zmax", height);
  } else if (q.kind == QuadricKind::sphere) {
    if (q.low > -1) number("zmin", q.low);
    if (q.high < 1) number("zmax", q.high);
  } else if (q.low > 0) {
    number("innerradius", q.low);
  }
  if (!is_whole_turn(q)) number("phimax", degrees_of(q.phi_max_rad));
  return text;
}

// The same surface by a transform that does not mirror, of a quadric that goes all the way round; φ runs the
// other way.
QuadricShape unmirrored(QuadricShape placed) {
  placed.to_world = placed.to_world * scale({1, -1, 1});
  placed.flip_orientation = !placed.flip_orientation;
  return placed;
}

// pbrt measures lights, and looks for their points, before the transform, and does not know that they may be
// partial; where a transform mirrors, the points that it looks for shine to one side and those that it sees
// to the other. Nothing where it would go wrong, and for what v4 does not have.
std::optional<Written> written(const QuadricShape& given, bool shines, bool uvs_show) {
  const Quadric& q = given.quadric;
  if (q.kind == QuadricKind::cone || q.kind == QuadricKind::paraboloid) return std::nullopt;
  const bool turns = shines && swaps_handedness(given.to_world);
  if (turns && (uvs_show || !is_whole_turn(q))) return std::nullopt;
  const QuadricShape placed = turns ? unmirrored(given) : given;
  const Sizes sizes = sizes_of(q, placed.to_world);
  const bool is_rigid =
      (q.kind == QuadricKind::cylinder || is_whole(q)) && axes_of(sizes.rest).keep_spheres();
  if (shines && !is_rigid) return std::nullopt;
  const bool sized = is_rigid && (shines || sizes.rest * scale({sizes.radius, sizes.radius, sizes.height}) ==
                                                placed.to_world);
  const std::string text =
      fmt::format("Shape \"{}\" \"float radius\" [ {} ]{}", kind_of(q.kind), sized ? sizes.radius : 1,
                  extent_parameters(q, sized ? sizes.height : 1));
  return Written{text, sized ? sizes.rest : placed.to_world, placed.flip_orientation};
}

class ShapeWriter {
 public:
  explicit ShapeWriter(Writer& w)
      : w_(w),
        fixed_(w.scene.meshes.size()),
        uvs_show_(meshes_whose_uvs_show(w.scene)),
        uv_uses_(w.scene),
        uv_uses_of_curves_(w.scene, true),
        hair_(with_hair(w.scene.materials, true)) {}

  // Where pbrt has it in a space of its own, before its transform.
  bool is_placed(const Shape& shape) {
    if (const auto quadric = placed_quadric(w_.scene, shape, QuadricUv::pbrt, uv_uses_))
      if (const auto as = written(*quadric, shape.area_light.has_value(), uvs_show_[shape.mesh.value]))
        return as->to_world != Transform{};
    return shape.object_to_world != Transform{};
  }

  // `moving`: the instance that moves it, of a shape that has no transform of its own.
  void write(const Shape& shape, const Instance* moving = nullptr) {
    const ShapeSurface surface = surface_of(w_, shape);
    Parameters p(w_, "shape", shape.origin, RecordKind::shape);
    w_.begin("AttributeBegin");
    w_.line("NamedMaterial " + in_quotes(surface.material));
    const auto tint = w_.tints.find(&shape);
    const std::string inside = tint == w_.tints.end() ? medium(shape.interior) : in_quotes(tint->second);
    if (inside != in_quotes("") || shape.exterior)
      w_.line(fmt::format("MediumInterface {} {}", inside, medium(shape.exterior)));
    if (shape.area_light) w_.line(area_light(*shape.area_light));
    const bool curves = is_of_curves(w_.scene, shape) && !shape.area_light;
    const Written as = curves ? Written{{}, shape.object_to_world} : surface_written(shape, p);
    if (moving)
      w_.transforms(w_.scene.motions.at(moving->motion->value), moving->origin, RecordKind::instance);
    else
      w_.transform(as.to_world);
    if (as.reversed) w_.line("ReverseOrientation");
    if (surface.alpha != FloatParameter{1.0f}) p.number("alpha", surface.alpha);
    if (curves) {
      w_.line("Include " + in_quotes(write_curves(w_, shape, uv_uses_of_curves_.of(shape), p)));
    } else {
      if (hair_[shape.material.value])
        p.approximated(
            "pbrt's hair runs along u and takes where light meets its width from v: it is meant "
            "for curves");
      w_.line(as.shape + p.list());
    }
    w_.end("AttributeEnd");
  }

 private:
  std::string medium(const std::optional<Id<Medium>>& id) const {
    return in_quotes(id ? w_.media.at(id->value) : "");
  }

  const std::string& area_light(Id<AreaLight> id) {
    std::string& line = area_lights_[id.value];
    if (!line.empty()) return line;
    const AreaLight& light = w_.scene.area_lights.at(id.value);
    Parameters p(w_, "area light", light.origin, RecordKind::area_light);
    if (!light.sampled) p.approximated("lights the scene: pbrt has no surface that shines and does not");
    if (light.directional) p.approximated("shines in all directions, not along its normal alone");
    if (const auto* radiance = std::get_if<Spectrum>(&light.radiance)) {
      p.emission("L", *radiance);
    } else if (const auto file = file_for_pbrt(p, std::get<Id<Texture>>(light.radiance), ImageUse::light)) {
      p.file("filename", *file).number("scale", light.scale);
      look_up_of_image(std::get<Id<Texture>>(light.radiance), p);
    } else {
      p.approximated("white stands for a texture that is not an image");
      p.number("scale", light.scale);
    }
    if (light.two_sided) p.boolean("twosided", true);
    return line = "AreaLightSource \"diffuse\"" + p.list();
  }

  void look_up_of_image(Id<Texture> texture, Parameters& p) const {
    const ImageTexture image = tinted_image(w_.scene, texture)->image;
    if (image.wrap != Wrap::clamp) p.approximated("the edges of its image go on outside of it");
    if (image.filter != TextureFilter::bilinear) p.approximated("its image is looked up bilinearly");
  }

  Written surface_written(const Shape& shape, Parameters& p) {
    if (const auto quadric = placed_quadric(w_.scene, shape, QuadricUv::pbrt, uv_uses_))
      if (auto as = written(*quadric, shape.area_light.has_value(), uvs_show_[shape.mesh.value])) return *as;
    return {mesh(shape, p), shape.object_to_world,
            shape.flip_orientation != swaps_handedness(shape.object_to_world)};
  }

  std::string mesh(const Shape& shape, Parameters& p) {
    const TriangleMesh& mesh = w_.scene.meshes.at(shape.mesh.value);
    std::optional<TriangleMesh>& fixed = fixed_[shape.mesh.value];
    if (mesh.quadric) {
      p.approximated(as_triangles(*mesh.quadric));
      if (!fixed) loaded(mesh, fixed.emplace());
    }
    const bool follow = fronts_follow_normals(mesh);
    const bool lacks_uvs =
        uvs_show_[shape.mesh.value] && mesh.uvs.empty() && mesh.missing_uv != MissingUv::pbrt;
    const auto is_foreign = [](const MeshAttribute& a) { return a.name != face_indices; };
    const bool has_foreign = std::ranges::any_of(mesh.attributes, is_foreign);
    if (!fixed && (!follow || lacks_uvs || has_foreign)) {
      fixed = lacks_uvs ? with_uvs(mesh) : mesh;
      if (!fronts_follow_normals(*fixed)) fixed = with_normals_in_front(std::move(*fixed));
      std::erase_if(fixed->attributes, is_foreign);
    }
    if (has_foreign) p.dropped("the attributes of a mesh: pbrt has none");
    if (fixed && fixed->normals.empty() && !mesh.normals.empty())
      p.approximated("its shading normals lie on both sides of its faces and are left out");
    const TriangleMesh& written = fixed ? *fixed : mesh;
    if (stands_in_file(written)) return inline_mesh(written);
    return "Shape \"plymesh\" \"string filename\" " +
           in_quotes(fixed ? w_.meshes.name(shape.mesh, *fixed) : w_.meshes.name(shape.mesh));
  }

  Writer& w_;
  std::vector<std::optional<TriangleMesh>> fixed_;  // what is written instead of a mesh
  std::vector<bool> uvs_show_;                      // of meshes
  ShapeUvUses uv_uses_, uv_uses_of_curves_;
  std::vector<bool> hair_;                            // by material
  std::map<std::uint32_t, std::string> area_lights_;  // their directives
};

// Of each instance that turns, whether its shapes are written where they are, each with the motion: those
// that the file has as shapes, with no transform of their own.
std::vector<bool> moved_as_shapes(const Scene& scene, ShapeWriter& shapes) {
  std::vector<bool> result;
  for (const Instance& instance : scene.instances) {
    const Prototype& prototype = scene.prototypes[instance.prototype.value];
    result.push_back(
        instance.motion && turns(scene.motions.at(instance.motion->value)) && prototype.name.empty() &&
        std::ranges::none_of(prototype.shapes, [&](const Shape& shape) { return shapes.is_placed(shape); }));
  }
  return result;
}

void write_object_instance(Writer& w, const Instance& instance) {
  w.begin("AttributeBegin");
  if (instance.motion) {
    const Motion& motion = w.scene.motions.at(instance.motion->value);
    w.transforms(motion, instance.origin, RecordKind::instance);
    if (turns(motion)) w.approximated(turned_by_camera, instance.origin, RecordKind::instance);
  } else {
    w.transform(instance.prototype_to_world);
  }
  w.line("ObjectInstance " + in_quotes(w.objects.at(instance.prototype.value)));
  w.end("AttributeEnd");
}

// pbrt leaves out area lights in objects: what shines is written with every instance.
void write_instance(Writer& w, ShapeWriter& shapes, const Instance& instance, bool as_shapes) {
  const Prototype& prototype = w.scene.prototypes.at(instance.prototype.value);
  if (!as_shapes) write_object_instance(w, instance);
  for (const Shape& of : prototype.shapes) {
    if (!of.area_light) {
      if (as_shapes) shapes.write(of, &instance);
      continue;
    }
    Shape shape = of;
    shape.object_to_world = instance.prototype_to_world * of.object_to_world;
    if (swaps_handedness(instance.prototype_to_world)) shape.flip_orientation = !shape.flip_orientation;
    shapes.write(shape);
    w.approximated("pbrt instances no area lights: this one is a shape of its own", instance.origin,
                   RecordKind::instance);
  }
}

}  // namespace

void write_shapes(Writer& w) {
  ShapeWriter shapes(w);
  const std::vector<bool> as_shapes = moved_as_shapes(w.scene, shapes);
  std::vector<bool> is_object(w.scene.prototypes.size(), true);
  for (std::size_t i = 0; i < as_shapes.size(); ++i)
    if (as_shapes[i]) is_object[w.scene.instances[i].prototype.value] = false;
  for (std::size_t i = 0; i < w.scene.prototypes.size(); ++i) {
    if (!is_object[i]) continue;
    w.begin("ObjectBegin " + in_quotes(w.objects[i]));
    for (const Shape& shape : w.scene.prototypes[i].shapes)
      if (!shape.area_light) shapes.write(shape);
    w.end("ObjectEnd");
  }
  for (const Shape& shape : w.scene.shapes) shapes.write(shape);
  for (std::size_t i = 0; i < as_shapes.size(); ++i)
    write_instance(w, shapes, w.scene.instances[i], as_shapes[i]);
}

}  // namespace vitrail::pbrt
