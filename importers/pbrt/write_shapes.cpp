// SPDX-License-Identifier: Apache-2.0
// Shapes, objects and their instances.
#include <cmath>

#include "importers/pbrt/shapes.h"
#include "importers/pbrt/writer.h"
#include "scene/bounds.h"

namespace vitrail::pbrt {

namespace {

// Small meshes stand in the file. Not those that lie far from the origin: they would be moved to it when they
// are read.
bool stands_in_file(const TriangleMesh& mesh) {
  constexpr std::size_t most_triangles = 64;
  if (mesh.triangles.size() > most_triangles || !mesh.attributes.empty()) return false;
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
  return text;
}

class ShapeWriter {
 public:
  explicit ShapeWriter(Writer& w) : w_(w), fixed_(w.scene.meshes.size()) {}

  void write(const Shape& shape) {
    const ShapeSurface surface = surface_of(w_.scene, shape.material);
    Parameters p(w_, "shape", shape.origin, RecordKind::shape);
    w_.begin("AttributeBegin");
    w_.line("NamedMaterial " + in_quotes(w_.materials.at(surface.material.value)));
    if (shape.interior || shape.exterior)
      w_.line(fmt::format("MediumInterface {} {}", medium(shape.interior), medium(shape.exterior)));
    if (shape.area_light) area_light(w_.scene.area_lights.at(shape.area_light->value));
    w_.transform(shape.object_to_world);
    if (shape.flip_orientation != swaps_handedness(shape.object_to_world)) w_.line("ReverseOrientation");
    if (surface.alpha != FloatParameter{1.0f}) p.number("alpha", surface.alpha);
    w_.line(mesh(shape, p) + p.list());
    w_.end("AttributeEnd");
  }

 private:
  std::string medium(const std::optional<Id<Medium>>& id) const {
    return in_quotes(id ? w_.media.at(id->value) : "");
  }

  void area_light(const AreaLight& light) {
    Parameters p(w_, "area light", light.origin, RecordKind::area_light);
    if (light.directional) p.approximated("shines in all directions, not along its normal alone");
    if (const auto* radiance = std::get_if<Spectrum>(&light.radiance)) {
      p.emission("L", *radiance);
    } else if (const auto* image = std::get_if<ImageTexture>(
                   &w_.scene.textures.at(std::get<Id<Texture>>(light.radiance).value).model)) {
      p.file("filename", image->filename).number("scale", light.scale);
    } else {
      p.approximated("white stands for a texture that is not an image");
      p.number("scale", light.scale);
    }
    if (light.two_sided) p.boolean("twosided", true);
    w_.line("AreaLightSource \"diffuse\"" + p.list());
  }

  std::string mesh(const Shape& shape, Parameters& p) {
    const TriangleMesh& mesh = w_.scene.meshes.at(shape.mesh.value);
    std::optional<TriangleMesh>& fixed = fixed_[shape.mesh.value];
    if (!fixed && fronts_follow_normals(mesh)) {
      if (!mesh.attributes.empty()) p.dropped("the attributes of a mesh: pbrt has none");
      if (stands_in_file(mesh)) return inline_mesh(mesh);
      return "Shape \"plymesh\" \"string filename\" " + in_quotes(w_.meshes.name(shape.mesh));
    }
    if (!fixed) fixed = with_normals_in_front(mesh);
    if (fixed->normals.empty())
      p.approximated("its shading normals lie on both sides of its faces and are left out");
    return stands_in_file(*fixed)
               ? inline_mesh(*fixed)
               : "Shape \"plymesh\" \"string filename\" " + in_quotes(w_.meshes.name(shape.mesh, *fixed));
  }

  Writer& w_;
  std::vector<std::optional<TriangleMesh>> fixed_;
};

}  // namespace

void write_shapes(Writer& w) {
  ShapeWriter shapes(w);
  for (std::size_t i = 0; i < w.scene.prototypes.size(); ++i) {
    w.begin("ObjectBegin " + in_quotes(w.objects[i]));
    for (const Shape& shape : w.scene.prototypes[i].shapes) shapes.write(shape);
    w.end("ObjectEnd");
  }
  for (const Shape& shape : w.scene.shapes) shapes.write(shape);
  for (const Instance& instance : w.scene.instances) {
    w.begin("AttributeBegin");
    w.transform(instance.prototype_to_world);
    w.line("ObjectInstance " + in_quotes(w.objects.at(instance.prototype.value)));
    w.end("AttributeEnd");
  }
}

}  // namespace vitrail::pbrt
