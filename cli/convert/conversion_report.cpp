// SPDX-License-Identifier: Apache-2.0
#include "cli/convert/conversion_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <span>
#include <unordered_map>

#include "scene/records/kinds.h"
#include "scene/system/atomic_file.h"

namespace vitrail {

namespace {

using Json = nlohmann::ordered_json;

std::string named(std::string_view kind, const std::string& name) {
  return name.empty() ? std::string(kind) : fmt::format("{} \"{}\"", kind, name);
}

// What is called an item that no record stands for.
std::string_view name_of(RecordKind kind) {
  switch (kind) {
    case RecordKind::any:
      return "directive";
    case RecordKind::camera:
      return "camera";
    case RecordKind::film:
      return "film";
    case RecordKind::sampler:
      return "sampler";
    case RecordKind::integrator:
      return "integrator";
    case RecordKind::texture:
      return "texture";
    case RecordKind::material:
      return "material";
    case RecordKind::medium:
      return "medium";
    case RecordKind::area_light:
      return "area light";
    case RecordKind::light:
      return "light";
    case RecordKind::shape:
      return "shape";
    case RecordKind::object:
      return "object";
    case RecordKind::instance:
      return "instance";
  }
  return "";
}

// By place and kind. Where several of a kind come from one place (a material that is made of two), what is
// said of one is said of all.
class Items {
 public:
  explicit Items(const Scene& scene) : scene_(scene) {}

  void add(RecordKind kind, std::string what, const Origin& origin) {
    add(kind, std::move(what), location(scene_, origin));
  }
  void note(const Diagnostic& diagnostic) {
    const SourceLocation& place = diagnostic.item.file.empty() ? diagnostic.location : diagnostic.item;
    const std::string at = to_string(place);
    auto& there = by_place_[at];
    const auto is_meant = [&](const Entry& e) {
      return diagnostic.kind == RecordKind::any || e.kind == diagnostic.kind;
    };
    if (std::ranges::none_of(there, is_meant))
      add(diagnostic.kind, std::string(name_of(diagnostic.kind)), place);
    for (const Entry& e : there)
      if (is_meant(e)) items[e.item].notes.push_back(&diagnostic);
  }

  std::vector<ConversionItem> items;

 private:
  struct Entry {
    RecordKind kind;
    std::size_t item;
  };

  void add(RecordKind kind, std::string what, SourceLocation place) {
    by_place_[to_string(place)].push_back({kind, items.size()});
    items.push_back({std::move(what), std::move(place), {}});
  }

  const Scene& scene_;
  std::unordered_map<std::string, std::vector<Entry>> by_place_;
};

void add_shapes(Items& items, const Scene& scene, const std::vector<Shape>& shapes) {
  for (const Shape& shape : shapes) {
    const std::optional<Quadric>& quadric = scene.meshes[shape.mesh.value].quadric;
    items.add(RecordKind::shape, named(quadric ? kind_of(quadric->kind) : "shape", shape.name), shape.origin);
  }
}

Fidelity worst(const std::vector<const Diagnostic*>& notes) {
  for (const Diagnostic* note : notes)
    if (note->fidelity == Fidelity::dropped) return Fidelity::dropped;
  return Fidelity::approximated;
}

void put_place(Json& json, const SourceLocation& place) {
  json["file"] = place.file;
  json["line"] = place.line;
  json["column"] = place.column;
}

}  // namespace

std::vector<ConversionItem> conversion_items(const Scene& scene, const Diagnostics& diagnostics) {
  constexpr std::array lights{"point light",   "spot light",     "projection light",  "goniometric light",
                              "distant light", "infinite light", "environment light", "sky"};
  static_assert(lights.size() == std::variant_size_v<LightVariant>);
  Items items(scene);
  items.add(RecordKind::camera, "camera", scene.camera_origin);
  items.add(RecordKind::film, "film", scene.film_origin);
  if (scene.sampler_origin.line > 0) items.add(RecordKind::sampler, "sampler", scene.sampler_origin);
  if (scene.integrator_origin.line > 0)
    items.add(RecordKind::integrator, "integrator", scene.integrator_origin);
  for (const Texture& texture : scene.textures)
    items.add(RecordKind::texture, named("texture", texture.name), texture.origin);
  for (const Material& material : scene.materials)
    items.add(RecordKind::material, named("material", material.name), material.origin);
  for (const Medium& medium : scene.media)
    items.add(RecordKind::medium, named("medium", medium.name), medium.origin);
  for (const AreaLight& light : scene.area_lights)
    items.add(RecordKind::area_light, "area light", light.origin);
  for (const Light& light : scene.lights)
    items.add(RecordKind::light, lights.at(light.model.index()), light.origin);
  add_shapes(items, scene, scene.shapes);
  for (const Prototype& prototype : scene.prototypes) {
    items.add(RecordKind::object, named("object", prototype.name), prototype.origin);
    add_shapes(items, scene, prototype.shapes);
    for (const Instance& instance : prototype.instances)
      items.add(RecordKind::instance, "instance", instance.origin);
  }
  for (const Instance& instance : scene.instances)
    items.add(RecordKind::instance, "instance", instance.origin);
  for (const Diagnostic& diagnostic : diagnostics) items.note(diagnostic);
  return std::move(items.items);
}

ConversionCounts count(const std::vector<ConversionItem>& items) {
  ConversionCounts counts;
  for (const ConversionItem& item : items)
    ++(item.notes.empty()                            ? counts.exact
       : worst(item.notes) == Fidelity::approximated ? counts.approximated
                                                     : counts.dropped);
  return counts;
}

const char* name_of(Fidelity fidelity) { return fidelity == Fidelity::dropped ? "dropped" : "approximated"; }

const char* fidelity_of(const ConversionItem& item) {
  return item.notes.empty() ? "exact" : name_of(worst(item.notes));
}

void write_conversion_report(const std::filesystem::path& file, const std::filesystem::path& in,
                             const std::filesystem::path& out, const std::string& quadrics,
                             const std::vector<std::string>& options, const ConversionChecks& checks,
                             const std::vector<ConversionItem>& items) {
  const ConversionCounts counts = count(items);
  Json report{{"program", "vitrail convert"},
              {"input", in.string()},
              {"output", out.string()},
              {"options", options},
              {"quadrics", quadrics},
              {"exact", counts.exact},
              {"approximated", counts.approximated},
              {"dropped", counts.dropped}};
  if (!checks.pictures.is_null()) report["pictures"] = checks.pictures;
  if (!checks.peer.is_null()) report["peer"] = checks.peer;
  report["items"] = Json::array();
  for (const ConversionItem& item : items) {
    Json entry{{"item", item.what}, {"fidelity", fidelity_of(item)}};
    put_place(entry, item.location);
    if (!item.notes.empty()) entry["notes"] = Json::array();
    for (const Diagnostic* note : item.notes) {
      Json& said =
          entry["notes"].emplace_back(Json{{"fidelity", name_of(note->fidelity)}, {"what", note->message}});
      put_place(said, note->location);
    }
    report["items"].push_back(std::move(entry));
  }
  const std::string text = report.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
  AtomicFile target(file);
  target.write(std::as_bytes(std::span(text)));
  target.commit();
}

}  // namespace vitrail
