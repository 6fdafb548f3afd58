// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/read/load.h"

#include <fmt/format.h>

#include <cstdlib>
#include <optional>
#include <pugixml.hpp>
#include <set>

#include "importers/bytes/included_text.h"
#include "importers/bytes/input_bytes.h"
#include "importers/mitsuba/read/old_versions.h"
#include "importers/mitsuba/read/references.h"
#include "importers/mitsuba/read/value_elements.h"
#include "importers/mitsuba/xml_text.h"
#include "importers/reading/guarded_xml.h"
#include "importers/reading/xml_nesting.h"

namespace vitrail::mitsuba {

namespace {

class Loader {
 public:
  Loader(const std::filesystem::path& file, const ImportOptions& options, std::vector<std::string>& files,
         Report& report)
      : files_(files),
        report_(report),
        folders_(std::filesystem::absolute(file).parent_path()),
        definitions_(options.definitions, report),
        references_(report),
        included_(options.include_limit) {}

  ObjectPtr run(const std::filesystem::path& file) {
    scene_->tag = "scene";
    try {
      read_file(file, scene_, {}, 0);
      definitions_.require_given(file);
      attach_files();
      objects_.push_back(scene_);
      references_.resolve(objects_);
      refuse_cycles(*scene_, report_);
    } catch (const Error&) {
      for (const MutablePtr& object : objects_)
        object->properties.clear();  // a cycle would keep itself alive
      throw;
    }
    return scene_;
  }

 private:
  void read_file(const std::filesystem::path& file, const MutablePtr& parent, const Origin& from, int depth) {
    std::error_code ignored;
    const std::string canonical = std::filesystem::weakly_canonical(file, ignored).string();
    const bool first = files_.empty();
    if (!first && !std::filesystem::is_regular_file(file, ignored))
      report_.fail(fmt::format("cannot find the file \"{}\"", file.string()), from);
    if (open_.contains(canonical))
      report_.fail(fmt::format("the file \"{}\" includes itself", file.string()), from);
    if (depth > static_cast<int>(most_included)) report_.fail("includes are nested too deeply", from);
    open_.insert(canonical);
    const InputBytes stored(file);
    if (!included_.add(file, stored.size())) report_.fail(included_.refusal(), from);
    const std::optional<std::string> converted = in_utf8({stored.begin(), stored.size()});
    const std::string_view bytes = converted ? *converted : std::string_view{stored.begin(), stored.size()};
    files_.push_back(file.string());
    guard_xml();
    Source source{static_cast<std::uint32_t>(files_.size() - 1),
                  Lines(bytes.data(), bytes.data() + bytes.size())};
    pugi::xml_document document;
    const auto parsed =
        document.load_buffer(bytes.data(), bytes.size(), pugi::parse_default, pugi::encoding_utf8);
    if (!parsed)
      report_.fail(fmt::format("this is not XML: {}", parsed.description()),
                   source.lines.origin(source.number, parsed.offset));
    if (const pugi::xml_node deep = too_deep_element(document))
      report_.fail("elements are nested too deeply", source.origin(deep));
    const pugi::xml_node root = document.document_element();
    if (std::string_view(root.name()) == "scene") {
      read_version(root, source);
      read_children(root, source, parent, depth);
    } else if (first) {
      report_.fail(fmt::format("expected <scene>, found <{}>: this is not a Mitsuba scene", root.name()),
                   source.origin(root));
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
        report_.fail(
            "<scene> has no version: Mitsuba needs one, other renderers with such files (Nori) are not read",
            source.origin(root));
      source.is_old = main_is_old_;
      return;
    }
    const int major = std::atoi(version.c_str());
    source.is_old = major < 2;
    if (files_.size() == 1) main_is_old_ = source.is_old;
    if (major > 3)
      report_.approximated(fmt::format("version {} is read as version 3", version), source.origin(root));
  }

  // What is read is let go: a large document and all of its objects are not in memory together.
  void read_children(pugi::xml_node node, const Source& source, const MutablePtr& parent, int depth) {
    while (const pugi::xml_node child = node.first_child()) {
      if (child.type() == pugi::node_element) read_element(child, source, parent, depth);
      node.remove_child(child);
    }
  }

  void read_element(pugi::xml_node node, const Source& source, const MutablePtr& parent, int depth) {
    const Element element(node, source, definitions_, report_);
    if (++nesting_ > most_nested) element.fail("elements are nested too deeply");
    if (element.is_object())
      read_object(element, parent, depth);
    else
      read_property(element, parent, depth);
    --nesting_;
  }

  void read_object(const Element& element, const MutablePtr& parent, int depth) {
    auto object = std::make_shared<MutableObject>();
    object->tag = element.tag();
    object->type = object->tag == "scene" ? "scene" : element.required("type");
    object->id = element.attribute("id");
    object->origin = element.place();
    read_children(element.node(), element.source(), object, depth);
    if (element.is_old()) upgrade(*object);
    references_.add(object);
    objects_.push_back(object);
    add(*parent, element.name(), ObjectPtr(object), element.place());
  }

  static void add(MutableObject& object, std::string name, Value value, const Origin& place) {
    object.properties.push_back({std::move(name), std::move(value), place});
  }

  // A value, or what says how others are read.
  void read_property(const Element& element, const MutablePtr& parent, int depth) {
    const auto put = [&](Value value) { add(*parent, element.name(), std::move(value), element.place()); };
    const std::string tag = element.tag();
    // Mitsuba takes such values from its command line.
    if (const std::string name = definitions_.undefined_in(element.node().attribute("value").value());
        !name.empty()) {
      report_.dropped(fmt::format("\"${}\" has no <default>: the value is left at its plugin's own", name),
                      element.place());
    } else if (tag == "include") {
      read_file(folders_.resolve(element.required("filename")), parent, element.place(), depth + 1);
    } else if (tag == "default") {
      const std::string parameter = element.required("name");
      definitions_.add(parameter, element.required("value"));
    } else if (tag == "path") {
      folders_.add(folders_.resolve(element.required("value")));
    } else if (tag == "alias") {
      const std::string id = element.required("id");
      references_.add_alias(element.required("as"), id);
    } else if (tag == "ref") {
      parent->references.push_back({parent->properties.size(), element.required("id")});
      put(ObjectPtr());
    } else {
      put(read_value(element, *parent, folders_));
    }
  }

  // <default name="glazing:ID" value="FILE"/> is a parameter of the BSDF of that id that other readers of
  // Mitsuba's files do not stop at; "picture:ID" is one of a grid that holds a picture.
  void attach_files() {
    for (const MutablePtr& object : objects_) {
      const char* const name = object->tag == "bsdf"     ? "glazing"
                               : object->tag == "volume" ? "picture"
                                                         : nullptr;
      const std::string* const file =
          name ? definitions_.find(fmt::format("{}:{}", name, object->id)) : nullptr;
      if (file && !object->has(name)) add(*object, name, folders_.resolve(*file).string(), object->origin);
    }
  }

  std::vector<std::string>& files_;
  Report& report_;
  SearchFolders folders_;
  Definitions definitions_;
  References references_;
  MutablePtr scene_ = std::make_shared<MutableObject>();
  std::vector<MutablePtr> objects_;
  std::set<std::string> open_;  // files that are being read
  IncludedText included_;
  int nesting_ = 0;
  bool main_is_old_ = false;
};

}  // namespace

ObjectPtr load(const std::filesystem::path& file, const ImportOptions& options,
               std::vector<std::string>& files, Report& report) {
  return Loader(file, options, files, report).run(file);
}

}  // namespace vitrail::mitsuba
