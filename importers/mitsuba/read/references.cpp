// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/read/references.h"

#include <fmt/format.h>

#include <set>

#include "importers/reading/suggestion.h"
#include "scene/records/nesting_limits.h"

namespace vitrail::mitsuba {

void References::add(const MutablePtr& object) {
  if (!object->id.empty() && !ids_.emplace(object->id, object).second)
    report_.fail(fmt::format("the id \"{}\" is given twice", object->id), object->origin);
}

MutablePtr References::find(const std::string& id, const Origin& place) {
  std::string name = id;
  for (std::size_t steps = 0; aliases_.contains(name); ++steps) {
    if (steps > aliases_.size()) report_.fail(fmt::format("the alias \"{}\" stands for itself", id), place);
    name = aliases_[name];
  }
  if (const auto found = ids_.find(name); found != ids_.end()) return found->second;
  std::vector<std::string> known;
  for (const auto& entry : ids_) known.push_back(entry.first);
  report_.fail(fmt::format("there is no object with the id \"{}\"{}", name, suggestion(name, known)), place);
}

void References::resolve(const std::vector<MutablePtr>& objects) {
  for (const MutablePtr& object : objects)
    for (const MutableObject::Reference& reference : object->references) {
      Property& property = object->properties[reference.property];
      property.value = ObjectPtr(find(reference.id, property.origin));
    }
}

namespace {

// Depth first; `path` are the objects from the scene down.
void visit(const Object& object, const Report& report, std::set<const Object*>& done,
           std::set<const Object*>& path) {
  if (done.contains(&object)) return;
  if (static_cast<int>(path.size()) > most_nested)
    report.fail("references are nested too deeply", object.origin);
  path.insert(&object);
  for (const Property& property : object.properties)
    if (const auto* child = std::get_if<ObjectPtr>(&property.value)) {
      if (path.contains(child->get()))
        report.fail(fmt::format("the {} \"{}\" contains itself", (*child)->tag, (*child)->id),
                    property.origin);
      visit(**child, report, done, path);
    }
  path.erase(&object);
  done.insert(&object);
}

}  // namespace

void refuse_cycles(const Object& scene, const Report& report) {
  std::set<const Object*> done, path;
  visit(scene, report, done, path);
}

}  // namespace vitrail::mitsuba
