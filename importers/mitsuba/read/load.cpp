// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/read/load.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <new>
#include <optional>
#include <pugixml.hpp>
#include <set>

#include "importers/bytes/included_text.h"
#include "importers/bytes/input_bytes.h"
#include "importers/mitsuba/read/old_versions.h"
#include "importers/mitsuba/read/values.h"
#include "importers/mitsuba/xml_text.h"
#include "importers/reading/xml_nesting.h"

namespace vitrail::mitsuba {

namespace {

constexpr std::size_t most_expanded = 1 << 20;  // bytes of an attribute after defaults are put in
constexpr std::size_t most_expanded_in_all = 64 << 20;

constexpr std::array object_tags{"scene",    "shape",  "bsdf",   "emitter",    "texture",
                                 "spectrum", "sensor", "film",   "rfilter",    "sampler",
                                 "medium",   "phase",  "volume", "integrator", "subsurface"};
constexpr std::array value_tags{"boolean", "integer", "float",     "string",    "vector", "point",
                                "rgb",     "srgb",    "transform", "blackbody", "ref",    "include",
                                "default", "path",    "alias",     "animation"};

// Rodrigues' formula with the axis as it is: since version 2 Mitsuba does not make it a unit vector, and
// files depend on that.
Transform rotate_about(Vector3d a, double angle_rad) {
  const double s = std::sin(angle_rad), c = std::cos(angle_rad), d = 1 - c;
  Transform t;
  t.m[0] = {a.x * a.x * d + c, a.x * a.y * d - a.z * s, a.x * a.z * d + a.y * s, 0};
  t.m[1] = {a.y * a.x * d + a.z * s, a.y * a.y * d + c, a.y * a.z * d - a.x * s, 0};
  t.m[2] = {a.z * a.x * d - a.y * s, a.z * a.y * d + a.x * s, a.z * a.z * d + c, 0};
  return t;
}

// Where the lines of a text begin.
class Lines {
 public:
  Lines(const char* begin, const char* end) {
    starts_.push_back(0);
    for (const char* at = begin; at < end; ++at)
      if (*at == '\n') starts_.push_back(at - begin + 1);
  }
  Origin origin(std::uint32_t file, std::ptrdiff_t offset) const {
    const auto above = std::upper_bound(starts_.begin(), starts_.end(), std::max<std::ptrdiff_t>(offset, 0));
    const auto line = static_cast<std::uint32_t>(above - starts_.begin());
    return {file, line, static_cast<std::uint32_t>(std::max<std::ptrdiff_t>(offset, 0) - *(above - 1) + 1)};
  }

 private:
  std::vector<std::ptrdiff_t> starts_;
};

struct MutableObject : Object {
  struct Reference {
    std::size_t property;  // of this object
    std::string id;
  };
  std::vector<Reference> references;
};
using MutablePtr = std::shared_ptr<MutableObject>;

class Loader {
 public:
  Loader(const ImportOptions& options, std::vector<std::string>& files, Report& report)
      : files_(files), report_(report), defaults_(options.definitions), included_(options.include_limit) {}

  ObjectPtr run(const std::filesystem::path& file) {
    scene_ = std::make_shared<MutableObject>();
    scene_->tag = "scene";
    search_.push_back(std::filesystem::absolute(file).parent_path());
    try {
      const std::map<std::string, std::string> definitions = defaults_;
      read_file(file, scene_, {}, 0);
      for (const auto& [name, value] : definitions) require_parameter(name, file);
      attach_glazing();
      resolve_references();
      std::set<const Object*> done, path;
      visit(*scene_, done, path);
    } catch (const Error&) {
      for (const MutablePtr& object : objects_)
        object->properties.clear();  // a cycle would keep itself alive
      throw;
    }
    return scene_;
  }

 private:
  // A file that is being read.
  struct Source {
    std::uint32_t number;
    Lines lines;
    bool is_old = false;  // before version 2: names are in camel case
  };

  void require_parameter(const std::string& name, const std::filesystem::path& file) const {
    if (parameters_.contains(name)) return;
    const std::string known = fmt::format("{}", fmt::join(parameters_, ", "));
    throw Error(fmt::format("the scene has no parameter \"{}\"; {}", name,
                            known.empty() ? "it has none" : "it has " + known),
                {file.string()});
  }

  Origin origin(const Source& source, pugi::xml_node node) const {
    return source.lines.origin(source.number, node.offset_debug() - 1);
  }
  [[noreturn]] void fail(const std::string& message, const Origin& place) const {
    report_.fail(message, place);
  }
  Fail failing_at(const Origin& place) const {
    return [this, place](const std::string& message) { fail(message, place); };
  }

  // ---- Files

  // A path of Windows counts with slashes where there is no such file.
  std::filesystem::path resolve(const std::string& name) const {
    std::error_code ignored;
    if (name.find('\\') != std::string::npos && !std::filesystem::exists(found(name), ignored)) {
      std::string with_slashes = name;
      std::ranges::replace(with_slashes, '\\', '/');
      return found(with_slashes);
    }
    return found(name);
  }

  std::filesystem::path found(const std::string& name) const {
    std::error_code ignored;
    for (auto folder = search_.rbegin(); folder != search_.rend(); ++folder)
      if (std::filesystem::exists(*folder / name, ignored)) return (*folder / name).lexically_normal();
    // Collections of scenes keep what they share in a folder "common" above them.
    std::filesystem::path above = search_.front();
    for (int levels = 0; levels < 4 && above.has_relative_path(); ++levels, above = above.parent_path())
      if (std::filesystem::exists(above / "common" / name, ignored))
        return (above / "common" / name).lexically_normal();
    return (search_.front() / name).lexically_normal();
  }

  void read_file(const std::filesystem::path& file, const MutablePtr& parent, const Origin& from, int depth) {
    std::error_code ignored;
    const std::string canonical = std::filesystem::weakly_canonical(file, ignored).string();
    const bool first = files_.empty();
    if (!first && !std::filesystem::is_regular_file(file, ignored))
      fail(fmt::format("cannot find the file \"{}\"", file.string()), from);
    if (open_.contains(canonical)) fail(fmt::format("the file \"{}\" includes itself", file.string()), from);
    if (depth > static_cast<int>(most_included)) fail("includes are nested too deeply", from);
    open_.insert(canonical);
    const InputBytes stored(file);
    if (!included_.add(file, stored.size())) fail(included_.refusal(), from);
    const std::optional<std::string> converted = in_utf8({stored.begin(), stored.size()});
    const std::string_view bytes = converted ? *converted : std::string_view{stored.begin(), stored.size()};
    files_.push_back(file.string());
    // What `new` refuses, the document is refused too (scene/system/memory_guard.h).
    pugi::set_memory_management_functions([](std::size_t size) { return ::operator new(size, std::nothrow); },
                                          [](void* block) { ::operator delete(block); });
    Source source{static_cast<std::uint32_t>(files_.size() - 1),
                  Lines(bytes.data(), bytes.data() + bytes.size())};
    pugi::xml_document document;
    const auto parsed =
        document.load_buffer(bytes.data(), bytes.size(), pugi::parse_default, pugi::encoding_utf8);
    if (!parsed)
      fail(fmt::format("this is not XML: {}", parsed.description()),
           source.lines.origin(source.number, parsed.offset));
    if (const pugi::xml_node deep = too_deep_element(document))
      fail("elements are nested too deeply", origin(source, deep));
    const pugi::xml_node root = document.document_element();
    if (std::string_view(root.name()) == "scene") {
      read_version(root, source);
      read_children(root, source, parent, depth);
    } else if (first) {
      fail(fmt::format("expected <scene>, found <{}>: this is not a Mitsuba scene", root.name()),
           origin(source, root));
    } else {
      read_version(root, source);
      read_element(root, source, parent, depth);
    }
    open_.erase(canonical);
  }

  void read_version(pugi::xml_node root, Source& source) {
    const std::string version = root.attribute("version").value();
    if (version.empty()) {
      if (files_.size() == 1)
        fail("<scene> has no version: Mitsuba needs one, other renderers with such files (Nori) are not read",
             origin(source, root));
      source.is_old = main_is_old_;
      return;
    }
    const int major = std::atoi(version.c_str());
    source.is_old = major < 2;
    if (files_.size() == 1) main_is_old_ = source.is_old;
    if (major > 3)
      report_.approximated(fmt::format("version {} is read as version 3", version), origin(source, root));
  }

  // ---- Attributes

  // The name of the first variable in the text that has no default.
  std::string undefined_in(const std::string& text) const {
    for (std::size_t at = text.find('$'); at != std::string::npos; at = text.find('$', at + 1)) {
      std::size_t end = at + 1;
      while (end < text.size() && (std::isalnum(static_cast<unsigned char>(text[end])) || text[end] == '_'))
        ++end;
      std::size_t length = end - at - 1;
      while (length > 0 && !defaults_.contains(text.substr(at + 1, length))) --length;
      if (length == 0) return text.substr(at + 1, end - at - 1);
    }
    return "";
  }

  // Replaces $name by its default.
  std::string expanded(const std::string& text, const Origin& place) {
    if (text.find('$') == std::string::npos) return text;
    std::string result;
    for (std::size_t i = 0; i < text.size();) {
      if (text[i] != '$') {
        result += text[i++];
        continue;
      }
      // The longest known name that follows.
      std::size_t end = ++i;
      while (end < text.size() && (std::isalnum(static_cast<unsigned char>(text[end])) || text[end] == '_'))
        ++end;
      std::size_t length = end - i;
      while (length > 0 && !defaults_.contains(text.substr(i, length))) --length;
      if (length == 0) fail(fmt::format("\"${}\" has no <default>", text.substr(i, end - i)), place);
      parameters_.insert(text.substr(i, length));
      result += defaults_[text.substr(i, length)];
      i += length;
      if (result.size() > most_expanded) fail("an attribute grows without bound by its defaults", place);
    }
    expanded_ += result.size();
    if (expanded_ > most_expanded_in_all) fail("the attributes grow without bound by their defaults", place);
    return result;
  }

  std::string attribute(pugi::xml_node node, const char* name, const Origin& place) {
    return expanded(node.attribute(name).value(), place);
  }
  std::string required(pugi::xml_node node, const char* name, const Origin& place) {
    if (!node.attribute(name)) fail(fmt::format("<{}> needs an attribute \"{}\"", node.name(), name), place);
    return attribute(node, name, place);
  }

  // ---- Elements

  // What is read is let go: a large document and all of its objects are not in memory together.
  void read_children(pugi::xml_node node, const Source& source, const MutablePtr& parent, int depth) {
    while (const pugi::xml_node child = node.first_child()) {
      if (child.type() == pugi::node_element) read_element(child, source, parent, depth);
      node.remove_child(child);
    }
  }

  void read_element(pugi::xml_node node, const Source& source, const MutablePtr& parent, int depth) {
    const Origin place = origin(source, node);
    if (++nesting_ > most_nested) fail("elements are nested too deeply", place);
    const std::string tag = tag_of_today(node.name());
    const bool by_value = tag == "spectrum" && !node.attribute("type");
    if (std::find(object_tags.begin(), object_tags.end(), tag) != object_tags.end() && !by_value)
      read_object(node, tag, source, parent, place, depth);
    else
      read_value(node, tag, source, parent, place, depth);
    --nesting_;
  }

  void read_object(pugi::xml_node node, const std::string& tag, const Source& source,
                   const MutablePtr& parent, const Origin& place, int depth) {
    auto object = std::make_shared<MutableObject>();
    object->tag = tag;
    object->type = tag == "scene" ? "scene" : required(node, "type", place);
    object->id = attribute(node, "id", place);
    object->origin = place;
    read_children(node, source, object, depth);
    if (source.is_old) upgrade(*object);
    if (!object->id.empty() && !ids_.emplace(object->id, object).second)
      fail(fmt::format("the id \"{}\" is given twice", object->id), place);
    objects_.push_back(object);
    add(*parent, name_of(node, source, place), ObjectPtr(object), place);
  }

  std::string name_of(pugi::xml_node node, const Source& source, const Origin& place) {
    const std::string name = attribute(node, "name", place);
    return source.is_old ? name_of_today(name) : name;
  }

  static void add(MutableObject& object, std::string name, Value value, const Origin& place) {
    object.properties.push_back({std::move(name), std::move(value), place});
  }

  // <default name="glazing:ID" value="FILE"/> is a parameter of the BSDF of that id that other readers of
  // Mitsuba's files do not stop at.
  void attach_glazing() {
    for (const MutablePtr& object : objects_) {
      const auto found = object->tag == "bsdf" ? defaults_.find("glazing:" + object->id) : defaults_.end();
      if (found == defaults_.end()) continue;
      if (!object->has("glazing")) add(*object, "glazing", resolve(found->second).string(), object->origin);
    }
  }

  void read_value(pugi::xml_node node, const std::string& tag, const Source& source, const MutablePtr& parent,
                  const Origin& place, int depth) {
    const Fail fails = failing_at(place);
    const auto value = [&] { return required(node, "value", place); };
    const auto put = [&](Value v) { add(*parent, name_of(node, source, place), std::move(v), place); };
    // Mitsuba takes such values from its command line.
    if (const std::string name = undefined_in(node.attribute("value").value()); !name.empty()) {
      report_.dropped(fmt::format("\"${}\" has no <default>: the value is left at its plugin's own", name),
                      place);
      return;
    }
    if (tag == "include")
      return read_file(resolve(required(node, "filename", place)), parent, place, depth + 1);
    if (tag == "default") {
      const std::string name = required(node, "name", place);
      parameters_.insert(name);
      defaults_.try_emplace(name, value());
    } else if (tag == "path") {
      search_.push_back(resolve(value()));
    } else if (tag == "alias") {
      aliases_[required(node, "as", place)] = required(node, "id", place);
    } else if (tag == "ref") {
      parent->references.push_back({parent->properties.size(), required(node, "id", place)});
      put(ObjectPtr());
    } else if (tag == "boolean") {
      put(parse_boolean(value(), fails));
    } else if (tag == "integer") {
      put(parse_integer(value(), fails));
    } else if (tag == "float") {
      put(parse_number(value(), fails));
    } else if (tag == "string") {
      put(file_or_text(node, value(), source, place));
    } else if (tag == "vector" || tag == "point") {
      put(read_triple(node, 0, place));
    } else if (tag == "rgb") {
      put(RgbValue{parse_rgb(value(), fails)});
    } else if (tag == "srgb") {
      const RGB c = parse_rgb(value(), fails);
      put(value().starts_with('#') ? RgbValue{c}
                                   : RgbValue{{srgb_decode(c.r), srgb_decode(c.g), srgb_decode(c.b)}});
    } else if (tag == "spectrum") {
      put(read_spectrum(node, source, *parent, place));
    } else if (tag == "blackbody") {
      read_blackbody(node, source, parent, place);
    } else if (tag == "transform") {
      put(read_transform(node, source));
    } else if (tag == "animation") {
      put(read_animation(node, source, place));
    } else {
      unknown_tag(tag, place);
    }
  }

  [[noreturn]] void unknown_tag(const std::string& tag, const Origin& place) {
    std::vector<std::string> known(object_tags.begin(), object_tags.end());
    known.insert(known.end(), value_tags.begin(), value_tags.end());
    const std::string closest = closest_word(tag, known);
    fail(fmt::format("<{}> is not known{}", tag,
                     closest.empty() ? "" : fmt::format("; did you mean <{}>?", closest)),
         place);
  }

  // Names of files become absolute while it is known which folders are searched.
  std::string file_or_text(pugi::xml_node node, std::string text, const Source& source, const Origin& place) {
    const std::string name = name_of(node, source, place);
    return name == "filename" || name == "glazing" ? resolve(text).string() : text;
  }

  Value read_spectrum(pugi::xml_node node, const Source& source, const Object& owner, const Origin& place) {
    if (!node.attribute("filename")) {
      const std::string text = required(node, "value", place);
      if (source.is_old && is_color_of_old_file(text, owner))
        return RgbValue{parse_rgb(text, failing_at(place))};
      return parse_spectrum(text, failing_at(place));
    }
    SpectrumValue spectrum;
    spectrum.filename = resolve(attribute(node, "filename", place)).string();
    return spectrum;
  }

  // 0.6's element is 3's plugin.
  void read_blackbody(pugi::xml_node node, const Source& source, const MutablePtr& parent,
                      const Origin& place) {
    auto object = std::make_shared<MutableObject>();
    object->tag = "spectrum";
    object->type = "blackbody";
    object->origin = place;
    std::string kelvin = required(node, "temperature", place);
    if (kelvin.ends_with('K') || kelvin.ends_with('k')) kelvin.pop_back();
    add(*object, "temperature", parse_number(kelvin, failing_at(place)), place);
    if (node.attribute("scale"))
      add(*object, "scale", parse_number(attribute(node, "scale", place), failing_at(place)), place);
    add(*parent, name_of(node, source, place), ObjectPtr(object), place);
  }

  // ---- Transforms

  // x, y, z, or value with one number or three.
  Vector3d read_triple(pugi::xml_node node, double otherwise, const Origin& place) {
    const Fail fails = failing_at(place);
    if (node.attribute("value")) {
      const std::vector<double> v = parse_numbers(attribute(node, "value", place), fails);
      if (v.size() == 1) return {v[0], v[0], v[0]};
      if (v.size() != 3) fail(fmt::format("<{}> needs 3 numbers, has {}", node.name(), v.size()), place);
      return {v[0], v[1], v[2]};
    }
    const auto component = [&](const char* name) {
      return node.attribute(name) ? parse_number(attribute(node, name, place), fails) : otherwise;
    };
    return {component("x"), component("y"), component("z")};
  }

  Vector3d triple_of(pugi::xml_node node, const char* name, const Origin& place) {
    const std::vector<double> v = parse_numbers(required(node, name, place), failing_at(place));
    if (v.size() != 3) fail(fmt::format("\"{}\" needs 3 numbers, has {}", name, v.size()), place);
    return {v[0], v[1], v[2]};
  }

  Transform read_matrix(pugi::xml_node node, const Origin& place) {
    const std::vector<double> v = parse_numbers(required(node, "value", place), failing_at(place));
    if (v.size() != 16 && v.size() != 9)
      fail(fmt::format("a matrix needs 16 or 9 numbers, has {}", v.size()), place);
    const std::size_t size = v.size() == 16 ? 4 : 3;
    Transform t;
    for (std::size_t i = 0; i < v.size(); ++i) t.m[i / size][i % size] = v[i];
    return t;
  }

  Transform read_look_at(pugi::xml_node node, const Origin& place) {
    const Vector3d eye = triple_of(node, "origin", place), target = triple_of(node, "target", place);
    const Vector3d up = node.attribute("up") ? triple_of(node, "up", place) : Vector3d{0, 1, 0};
    const Transform t = look_at({eye.x, eye.y, eye.z}, {target.x, target.y, target.z}, up);
    if (!is_invertible(t))
      fail("lookat has no direction: origin and target coincide, or up is along the view", place);
    return t;
  }

  Transform read_step(pugi::xml_node node, const Source& source, const Origin& place) {
    const std::string tag = name_of_today(node.name());
    if (tag == "translate") return translate(read_triple(node, 0, place));
    if (tag == "scale") return scale(read_triple(node, 1, place));
    if (tag == "rotate") {
      const double angle =
          parse_number(required(node, "angle", place), failing_at(place)) * 3.14159265358979323846 / 180;
      const Vector3d axis = read_triple(node, 0, place);
      return source.is_old ? rotate(angle, axis) : rotate_about(axis, angle);
    }
    if (tag == "matrix") return read_matrix(node, place);
    if (tag == "lookat" || tag == "look_at") return read_look_at(node, place);
    const std::string closest = closest_word(tag, {"translate", "scale", "rotate", "matrix", "lookat"});
    fail(fmt::format("<{}> is not a step of a transform{}", node.name(),
                     closest.empty() ? "" : fmt::format("; did you mean <{}>?", closest)),
         place);
  }

  // Each step is applied after those before it.
  Transform read_transform(pugi::xml_node node, const Source& source) {
    Transform total;
    for (const pugi::xml_node step : node.children())
      if (step.type() == pugi::node_element) total = read_step(step, source, origin(source, step)) * total;
    return total;
  }

  // 0.6's: transforms with times, in any order.
  std::vector<Keyframe> read_animation(pugi::xml_node node, const Source& source, const Origin& place) {
    std::vector<Keyframe> keys;
    for (const pugi::xml_node child : node.children()) {
      if (child.type() != pugi::node_element) continue;
      const Origin at = origin(source, child);
      if (std::string_view(child.name()) != "transform")
        fail(fmt::format("an <animation> has <transform time=\"…\"> alone, not <{}>", child.name()), at);
      keys.push_back(
          {parse_number(required(child, "time", at), failing_at(at)), read_transform(child, source)});
    }
    if (keys.empty()) fail("an <animation> needs a <transform time=\"…\">", place);
    std::ranges::stable_sort(keys, {}, &Keyframe::time_s);
    for (std::size_t i = 1; i < keys.size(); ++i)
      if (keys[i - 1].time_s == keys[i].time_s)
        fail(fmt::format("two transforms of an <animation> have the time {}", keys[i].time_s), place);
    return keys;
  }

  // ---- References

  MutablePtr find(const std::string& id, const Origin& place) {
    std::string name = id;
    for (std::size_t steps = 0; aliases_.contains(name); ++steps) {
      if (steps > aliases_.size()) fail(fmt::format("the alias \"{}\" stands for itself", id), place);
      name = aliases_[name];
    }
    if (const auto found = ids_.find(name); found != ids_.end()) return found->second;
    std::vector<std::string> known;
    for (const auto& entry : ids_) known.push_back(entry.first);
    const std::string closest = closest_word(name, known);
    fail(fmt::format("there is no object with the id \"{}\"{}", name,
                     closest.empty() ? "" : fmt::format("; did you mean \"{}\"?", closest)),
         place);
  }

  void resolve_references() {
    objects_.push_back(scene_);
    for (const MutablePtr& object : objects_)
      for (const MutableObject::Reference& reference : object->references) {
        Property& property = object->properties[reference.property];
        property.value = ObjectPtr(find(reference.id, property.origin));
      }
  }

  // Depth first; `path` are the objects from the scene down.
  void visit(const Object& object, std::set<const Object*>& done, std::set<const Object*>& path) {
    if (done.contains(&object)) return;
    if (static_cast<int>(path.size()) > most_nested) fail("references are nested too deeply", object.origin);
    path.insert(&object);
    for (const Property& property : object.properties)
      if (const auto* child = std::get_if<ObjectPtr>(&property.value)) {
        if (path.contains(child->get()))
          fail(fmt::format("the {} \"{}\" contains itself", (*child)->tag, (*child)->id), property.origin);
        visit(**child, done, path);
      }
    path.erase(&object);
    done.insert(&object);
  }

  std::vector<std::string>& files_;
  Report& report_;
  MutablePtr scene_;
  std::vector<std::filesystem::path> search_;
  std::set<std::string> open_;
  std::map<std::string, std::string> defaults_, aliases_;
  std::set<std::string> parameters_;  // that the scene has
  std::map<std::string, MutablePtr> ids_;
  std::vector<MutablePtr> objects_;
  IncludedText included_;
  std::size_t expanded_ = 0;
  int nesting_ = 0;
  bool main_is_old_ = false;
};

}  // namespace

ObjectPtr load(const std::filesystem::path& file, const ImportOptions& options,
               std::vector<std::string>& files, Report& report) {
  return Loader(options, files, report).run(file);
}

}  // namespace vitrail::mitsuba
