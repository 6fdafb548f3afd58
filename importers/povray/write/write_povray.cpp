// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/write/write_povray.h"

#include <algorithm>
#include <set>

#include "importers/images/joined_surroundings.h"
#include "importers/povray/write/material_uses.h"
#include "importers/povray/write/units.h"
#include "importers/povray/write/write_camera.h"
#include "importers/povray/write/write_lights.h"
#include "importers/povray/write/write_materials.h"
#include "importers/povray/write/write_media.h"
#include "importers/povray/write/write_meshes.h"
#include "importers/povray/write/write_patterns.h"
#include "importers/povray/write/write_pigments.h"
#include "importers/writing/export_colors.h"
#include "importers/writing/own_scene.h"
#include "importers/writing/placed_quadric.h"
#include "scene/records/light_traits.h"
#include "scene/shapes/deferred_mesh.h"
#include "scene/system/atomic_file.h"

namespace vitrail {

namespace povray {

namespace {

// Up to here a mesh is written into the scene's file.
constexpr std::size_t most_triangles_inline = 64;

class Writer {
 public:
  Writer(const Scene& scene, const std::filesystem::path& out)
      : out_(out),
        context_{ConversionNotes(scene),
                 ExposedLights(scene),
                 out.parent_path(),
                 units_of(scene),
                 false,
                 ConvertedImages{images_beside(out)}},
        folder_(out.stem().string() + "-meshes") {}

  Diagnostics write() {
    context_.has_delta_lights = std::ranges::any_of(scene().lights, [](const Light& light) {
      return std::holds_alternative<PointLight>(light.model) ||
             std::holds_alternative<SpotLight>(light.model) ||
             std::holds_alternative<DistantLight>(light.model);
    });
    join_surroundings(context_, context_.exposed.lights, "POV-Ray", context_.images, context_.directory);
    std::string body = camera_text(context_) + surroundings();
    context_.has_caustics = has_caustics();
    for (const Light& light : context_.exposed.lights)
      if (shows_reflection() || traits_of(light.model).surrounds) body += light_text(context_, light);
    body += materials();
    for (const Prototype& prototype : scene().prototypes) body += prototype_text(prototype);
    for (const Shape& shape : scene().shapes) body += world_shape(shape);
    for (const Instance& instance : scene().instances) body += instance_text(instance);
    save(std::filesystem::path(out_).replace_extension(".ini"),
         options_text(context_, out_.filename().generic_string()));
    if (context_.has_facets) context_.functions = facet_functions() + context_.functions;
    save(out_, header() + context_.functions + body);
    return context_.take();
  }

 private:
  const Scene& scene() const { return context_.scene; }
  // At depth 0 emission alone is seen: no source of light may reach a surface.
  bool shows_reflection() const { return scene().settings.max_depth > 0; }

  // OUT-images/000000.exr and so on.
  static std::function<std::filesystem::path()> images_beside(const std::filesystem::path& out) {
    return [folder = std::filesystem::absolute(out).parent_path() / (out.stem().string() + "-images"),
            count = 0]() mutable {
      std::error_code error;
      std::filesystem::create_directories(folder, error);
      if (error) throw MachineError(fmt::format("cannot create {}: {}", folder.string(), error.message()));
      return folder / fmt::format("{:06}.exr", count++);
    };
  }

  static void save(const std::filesystem::path& path, const std::string& text) {
    AtomicFile file(path);
    file.write(std::as_bytes(std::span(text)));
    file.commit();
  }

  // ---- What holds for the whole file ------------------------------------------------------------

  std::string header() {
    const FilmSettings& film = scene().film;
    const int levels = std::clamp(scene().settings.max_depth + 1, 1, 256);
    std::string text = fmt::format(
        "// {} x {} pixels, {}; the options are in the .ini file of the same name.\n#version "
        "3.7;\nglobal_settings "
        "{{\n  assumed_gamma 1.0\n  max_trace_level {}\n  adc_bailout 0.001\n{}{}}}\n"
        "#default {{ finish {{ ambient 0 diffuse 1 specular 0 reflection 0 }} }}\n"
        "#declare Clear = texture {{ pigment {{ rgbt 1 }} finish {{ diffuse 0 }} }}\n"
        "#declare Black = texture {{ pigment {{ rgb 0 }} finish {{ diffuse 0 }} }}\n",
        film.width, film.height, scene_signature, levels,
        context_.has_caustics ? "  photons { count 400000 gather 20, 50 }\n" : "", radiosity());
    if (!context_.units.is_identity())
      text += fmt::format("// A point p of the scene is {} (p - {}) here.\n", context_.units.scale,
                          vector(transform_point(inverse(context_.units.to_pov), {0, 0, 0})));
    return text;
  }

  // Lamps with an extent, and what throws their light on where no medium scatters it. Paths do not find that
  // of lights without extent: their light goes straight through, as it does without photons.
  bool has_caustics() const {
    const RenderSettings& settings = scene().settings;
    if (settings.direct_only || settings.max_depth < 3 || context_.has_scattering) return false;
    if (context_.exposed.area_lights.empty()) return false;
    for (std::uint32_t i = 0; i < scene().materials.size(); ++i)
      if (caustics_of(scene(), Id<Material>{i}).reflected) return true;
    return false;
  }

  // What photons are shot at.
  std::string target(Id<Material> material) const {
    if (!context_.has_caustics) return "";
    const Caustics caustics = caustics_of(scene(), material);
    if (!caustics.reflected) return "";
    return fmt::format("photons {{ target reflection on {}}}\n", caustics.refracted ? "refraction on " : "");
  }

  // Light that no light source brings: it takes one bounce of radiosity to reach the first surface.
  bool has_indirect_sources() const {
    return shines_without_source_ || std::ranges::any_of(scene().lights, [](const Light& light) {
             return traits_of(light.model).surrounds;
           });
  }

  std::string radiosity() {
    const RenderSettings& settings = scene().settings;
    const int depth = settings.direct_only ? 1 : settings.max_depth;
    const int bounces = depth - (has_indirect_sources() ? 0 : 1);
    if (bounces < 1) return "";
    context_.approximated(
        "light between surfaces, and from sources that are no points or rectangles: POV-Ray's radiosity, "
        "within 1 % of the mean and 10 % of a block where it was measured",
        {});
    return fmt::format(
        "  radiosity {{\n    count 400 nearest_count 10 error_bound 0.25 low_error_factor 0.5\n"
        "    pretrace_start 0.08 pretrace_end 0.01 minimum_reuse 0.005 recursion_limit {}\n"
        "    gray_threshold 0 brightness 1 adc_bailout 0.001 always_sample off normal on }}\n",
        std::min(bounces, 20));
  }

  // A ball around everything, of so many radii of what is there.
  std::string ball(double radii, const std::string& what) const {
    return fmt::format("sphere {{ {}, {} {} }}\n",
                       vector(transform_point(context_.units.to_pov, context_.units.center)),
                       radii * context_.units.radius * context_.units.scale, what);
  }

  // What is around everything. Media without end: POV-Ray looks for lamps at a few places of a ray alone, so
  // they end where light from far away has come through the scene's diameter. A black ball that the camera
  // alone sees hides lights from all around.
  std::string surroundings() {
    for (std::uint32_t i = 0; i < scene().media.size(); ++i) media_text(context_, Id<Medium>{i});
    const std::string media = media_text(context_, medium_around(scene()));
    std::string text;
    if (!media.empty()) text = ball(2, "pigment { rgbt 1 } hollow interior { " + media + " }");
    if (!scene().settings.hides_emitters || std::ranges::none_of(scene().lights, [](const Light& light) {
          return traits_of(light.model).surrounds;
        }))
      return text;
    return text +
           ball(1000, "pigment { rgb 0 } finish { diffuse 0 } hollow no_shadow no_reflection no_radiosity");
  }

  // ---- Materials --------------------------------------------------------------------------------

  std::string materials() {
    std::set<std::uint32_t> used, solid;
    const auto add = [&](const Shape& shape) {
      const bool is_sheet = rectangle_of(text_of(shape, {})).has_value();
      for (const Id<Material> part : parts_of(scene(), shape.material)) {
        used.insert(part.value);
        if (!is_sheet || part != shape.material) solid.insert(part.value);
      }
    };
    std::ranges::for_each(scene().shapes, add);
    for (const Prototype& prototype : scene().prototypes) std::ranges::for_each(prototype.shapes, add);
    std::ranges::set_difference(used, solid, std::inserter(context_.sheets, context_.sheets.end()));
    surfaces_.resize(scene().materials.size());
    std::string text;
    for (const std::uint32_t i : used) {
      Surface& surface = surfaces_[i] = surface_of(context_, {i});
      const std::string& name = scene().materials[i].name;
      if (!name.empty()) text += "// " + one_line(name) + "\n";
      text += fmt::format("#declare Material_{} = {}", i, surface.texture);
      if (!surface.back.empty()) text += fmt::format("#declare Back_{} = {}", i, surface.back);
      if (!surface.interior.empty()) text += fmt::format("#declare Interior_{} = {}", i, surface.interior);
      if (!surface.turned.empty()) text += fmt::format("#declare Turned_{} = {}", i, surface.turned);
    }
    return text;
  }

  static std::string one_line(std::string name) {
    std::ranges::replace_if(
        name, [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
    return name;
  }

  // ---- Shapes -----------------------------------------------------------------------------------

  std::string world_shape(const Shape& shape) {
    const MeshText mesh = text_of(shape, context_.units.to_pov);
    const AreaLight* const light = light_of(shape);
    if (!light || !light->sampled) return shape_text(shape, mesh, "");
    const auto rectangle = rectangle_of(mesh);
    const auto* share = std::get_if<float>(&shape.opacity);
    const bool is_unseen = is_gone(shape);
    if (!rectangle || !share || std::holds_alternative<Id<Texture>>(light->radiance)) {
      shines_without_source_ = true;
      if (is_unseen)
        context_.approximated("a light that nothing meets: it is in the way of other light", shape.origin);
      return shape_text(shape, mesh, is_unseen ? "no_image no_reflection " : unseen_by_camera());
    }
    AreaLight source = *light;
    if (!is_unseen) source.scale *= *share;
    std::string text = shows_reflection() ? rectangle_light_text(context_, *rectangle, source) : "";
    if (is_unseen) return text;
    // The source stands for the mesh, which must not be counted a second time.
    const std::string shining = shape_text(shape, mesh, unseen_by_camera() + "no_radiosity ");
    return text + shining + (shows_reflection() ? unlit(shape, mesh) : "");
  }

  // What radiosity sees of a lamp that a source stands for: it hides what is behind, and reflects.
  std::string unlit(Shape shape, const MeshText& mesh) {
    shape.area_light.reset();
    shape.exterior = shape.interior;  // what fills it is not written twice
    return shape_text(shape, mesh, "no_image no_reflection ");
  }

  // Of what shines.
  std::string unseen_by_camera() const { return scene().settings.hides_emitters ? "no_image " : ""; }

  static bool is_gone(const Shape& shape) { return shape.opacity == FloatParameter{0.0f}; }

  MeshText text_of(const Shape& shape, const Transform& world_to_pov) const {
    const AreaLight* const light = light_of(shape);
    const auto* texture = light ? std::get_if<Id<Texture>>(&light->radiance) : nullptr;
    const auto* opacity = std::get_if<Id<Texture>>(&shape.opacity);
    return {scene().meshes.at(shape.mesh.value), world_to_pov * shape.object_to_world, shape.flip_orientation,
            uses_uvs(scene(), shape.material) || (texture && povray::uses_uvs(scene(), *texture)) ||
                (opacity && povray::uses_uvs(scene(), *opacity))};
  }

  const AreaLight* light_of(const Shape& shape) const {
    return shape.area_light ? &context_.exposed.area_lights.at(shape.area_light->value) : nullptr;
  }

  std::string shape_text(const Shape& shape, const MeshText& mesh, const std::string& flags) {
    const AreaLight* const light = light_of(shape);
    const std::string media = light ? "" : media_of(shape, mesh);
    const bool shows_nothing = is_invisible(scene(), shape.material) && !light;
    if ((shows_nothing && media.empty()) || (is_gone(shape) && !light)) return "";
    const std::string geometry = geometry_text(shape, mesh);
    if (geometry.empty()) return "";
    const Surface& surface = surfaces_.at(shape.material.value);
    std::string text = shape.name.empty() ? "" : "// " + one_line(shape.name) + "\n";
    text += geometry;
    if (shows_nothing) return text + fmt::format("texture {{ Clear }} hollow interior {{ {} }} }}\n", media);
    Shape shining = shape;
    if (is_gone(shape)) shining.opacity = 1.0f;  // of a light that nothing meets
    text += light ? emitter_of(context_, shining, surface, *light)
                  : use_of(context_, shape, surface, !surface.turned.empty() && is_inside_out(mesh), media);
    return text + flags + target(shape.material) + "}\n";
  }

  // What fills a shape that light gets into.
  std::string media_of(const Shape& shape, const MeshText& mesh) {
    const bool lets_in =
        is_invisible(scene(), shape.material) || context_.traits[shape.material.value].transmits;
    return lets_in ? media_text(context_, medium_inside(scene(), shape, mesh)) : "";
  }

  // The beginning of an object; "" for one without area.
  std::string geometry_text(const Shape& shape, const MeshText& mesh) {
    if (!mesh.mesh.quadric) return has_area(mesh) ? "mesh2 {\n" + triangles(mesh) : "";
    if (has_sweeps(mesh)) return "union {\n" + sweeps(shape, mesh);
    if (std::string text = quadric_text(mesh); !text.empty()) return text;
    context_.approximated(as_triangles(*mesh.mesh.quadric), shape.origin);
    TriangleMesh tessellated;
    loaded(mesh.mesh, tessellated);
    return geometry_text(shape, {tessellated, mesh.to_pov, mesh.flip, mesh.with_uvs});
  }

  std::string sweeps(const Shape& shape, const MeshText& mesh) {
    const std::filesystem::path name = new_file();
    AtomicFile file(context_.directory / name);
    TextSink out(&file);
    if (!put_sweeps(mesh, out))
      context_.approximated("curves that are cut off end in half a ball", shape.origin);
    out.flush();
    file.commit();
    return include(name);
  }

  std::string triangles(const MeshText& mesh) {
    if (mesh.mesh.triangles.size() <= most_triangles_inline) return mesh_text(mesh);
    const std::filesystem::path file = new_file();
    write_mesh_text(mesh, context_.directory / file);
    return include(file);
  }

  // OUT-meshes/000000.inc and so on, relative to the scene's folder.
  std::filesystem::path new_file() {
    std::error_code error;
    std::filesystem::create_directories(context_.directory / folder_, error);
    if (error)
      throw MachineError(
          fmt::format("cannot create {}: {}", (context_.directory / folder_).string(), error.message()));
    return folder_ / fmt::format("{:06}.inc", files_++);
  }
  static std::string include(const std::filesystem::path& file) {
    return fmt::format("#include {}\n", quoted(file.generic_string()));
  }

  std::string prototype_text(const Prototype& prototype) {
    const auto number = static_cast<std::size_t>(&prototype - scene().prototypes.data());
    std::string parts;
    for (const Shape& shape : prototype.shapes) {
      if (shape.area_light) shines_without_source_ = true;
      parts += shape_text(shape, text_of(shape, Transform{}), "");
    }
    is_empty_.push_back(parts.empty());
    if (parts.empty()) return "";
    return fmt::format("// {}\n#declare Prototype_{} = union {{\n{}}}\n", one_line(prototype.name), number,
                       parts);
  }

  std::string instance_text(const Instance& instance) const {
    if (is_empty_.at(instance.prototype.value)) return "";
    return fmt::format("object {{ Prototype_{} {} }}\n", instance.prototype.value,
                       matrix(context_.units.to_pov * instance.prototype_to_world));
  }

  std::filesystem::path out_;
  Context context_;
  std::filesystem::path folder_;
  std::vector<Surface> surfaces_;
  std::vector<bool> is_empty_;  // by prototype
  std::size_t files_ = 0;
  bool shines_without_source_ = false;
};

}  // namespace

}  // namespace povray

Diagnostics write_povray(const Scene& scene, const std::filesystem::path& out) {
  return povray::Writer(scene, out).write();
}

}  // namespace vitrail
