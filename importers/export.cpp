// SPDX-License-Identifier: Apache-2.0
#include "importers/export.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>

#include "importers/gltf/write/write_gltf.h"
#include "importers/mitsuba/write/write_mitsuba.h"
#include "importers/obj/write/write_obj.h"
#include "importers/pbrt/write/write_pbrt.h"
#include "importers/ply/write/write_ply_scene.h"
#include "importers/povray/write/write_povray.h"
#include "importers/writing/embedded_images.h"
#include "importers/writing/scaled_normals.h"
#include "scene/models/turned_normal_maps.h"
#include "scene/records/nesting.h"

namespace vitrail {

namespace {

struct Format {
  std::string_view extension;
  Diagnostics (*write)(const Scene&, const std::filesystem::path&);
  bool holds_images = false;  // in the file itself
  bool has_sides = false;     // a material for each
  bool by_image = false;      // normal maps go by the axes of their images
};
constexpr std::array<Format, 7> formats{{{".pbrt", write_pbrt},
                                         {".xml", write_mitsuba, false, true},
                                         {".pov", write_povray, false, true},
                                         {".glb", write_gltf, true, false, true},
                                         {".gltf", write_gltf, true, false, true},
                                         {".obj", write_obj, false, false, true},
                                         {".ply", write_ply_scene}}};

const Format& format_of(const std::filesystem::path& out) {
  std::string extension = out.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const Format& format : formats)
    if (format.extension == extension) return format;
  throw UsageError(fmt::format(
      "{}: the name of what is written has to end in .pbrt, .xml (Mitsuba), .pov, .glb, .gltf, .obj or .ply",
      out.string()));
}

void note_nested_instances(const Scene& scene, Diagnostics& diagnostics) {
  for (const Prototype& prototype : scene.prototypes)
    for (const Instance& instance : prototype.instances) {
      const SourceLocation where = location(scene, instance.origin);
      diagnostics.push_back(
          {Fidelity::approximated,
           "an instance within an object: the format has none there; what it places is written as "
           "shapes of that object, or as instances of their own",
           where, where, RecordKind::instance});
    }
}

// pbrt's format alone has any, and not with instances within objects.
void note_motion(const Scene& scene, const Format& format, Diagnostics& diagnostics) {
  const bool has_motion = format.extension == ".pbrt";
  const auto note = [&](const Origin& origin, RecordKind kind) {
    const SourceLocation where = location(scene, origin);
    diagnostics.push_back({Fidelity::dropped,
                           "motion: the format has none here; it stands where it is when the shutter opens",
                           where, where, kind});
  };
  if (scene.camera_motion.moves() && !has_motion) note(scene.camera_origin, RecordKind::camera);
  for (const Instance& instance : scene.instances) {
    const bool nested = !scene.prototypes[instance.prototype.value].instances.empty();
    if (instance.motion && (nested || !has_motion)) note(instance.origin, RecordKind::instance);
  }
  for (const Prototype& prototype : scene.prototypes)
    for (const Instance& instance : prototype.instances)
      if (instance.motion) note(instance.origin, RecordKind::instance);
}

// What only POV-Ray's scenes have, and readers leave out of those that are read for export.
void note_povray(const Scene& scene, Diagnostics& diagnostics) {
  const auto note = [&](const char* what, const Origin& origin, RecordKind kind) {
    const SourceLocation where = location(scene, origin);
    diagnostics.push_back({Fidelity::dropped, what, where, where, kind});
  };
  if (scene.film.working_gamma != 1)
    note("the film's working gamma: the format adds up light, and pictures are brighter", scene.camera_origin,
         RecordKind::film);
  for (const Material& material : scene.materials)
    if (!material.casts_shadow)
      note("a material without shadow: it has one", material.origin, RecordKind::material);
  for (const Light& light : scene.lights)
    if (!light.casts_shadows) note("a lamp without shadows: it has some", light.origin, RecordKind::light);
  for (const Medium& medium : scene.media)
    if (medium.veils)
      note("a medium that weakens no lamp: it weakens all", medium.origin, RecordKind::medium);
}

}  // namespace

Diagnostics export_scene(const Scene& scene, const std::filesystem::path& out) {
  const Format& format = format_of(out);
  const bool nested = has_nested_instances(scene);
  const bool embedded = !format.holds_images && has_embedded_images(scene);
  const bool turned = format.by_image && std::ranges::any_of(scene.materials, [](const Material& m) {
                        return m.normal_map.has_value();
                      });
  std::optional<Scene> changed;
  if (nested) changed = without_nested_instances(scene);
  if (turned) {
    if (!changed) changed = scene;
    turn_normal_maps(*changed);
  }
  const bool scaled_maps = !format.holds_images && has_scaled_normals(changed ? *changed : scene);
  if (embedded) {
    if (!changed) changed = scene;
    extract_images(*changed, out);
  }
  if (scaled_maps) {
    if (!changed) changed = scene;
    write_scaled_normals(*changed, out);
  }
  Diagnostics diagnostics = format.write(changed ? *changed : scene, out);
  if (nested) note_nested_instances(scene, diagnostics);
  note_motion(scene, format, diagnostics);
  note_povray(scene, diagnostics);
  return diagnostics;
}

bool has_materials_by_side(const std::filesystem::path& out) { return format_of(out).has_sides; }

void require_export_format(const std::filesystem::path& out) { format_of(out); }

}  // namespace vitrail
