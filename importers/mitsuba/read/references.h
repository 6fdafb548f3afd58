// SPDX-License-Identifier: Apache-2.0
// Objects have names; others refer to them, also before they come.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "importers/mitsuba/read/object.h"

namespace vitrail::mitsuba {

// It is an object while its file is read.
struct MutableObject : Object {
  struct Reference {
    std::size_t property;  // of this object
    std::string id;
  };
  std::vector<Reference> references;
};
using MutablePtr = std::shared_ptr<MutableObject>;

class References {
 public:
  explicit References(const Report& report) : report_(report) {}

  // Takes an object, which may be referred to by its id, if it has one. The same id twice throws Error.
  void add(const MutablePtr& object);
  void add_alias(const std::string& alias, const std::string& id) { aliases_[alias] = id; }

  // Gives the objects' references what they refer to. Ids that no object has throw Error.
  void resolve(const std::vector<MutablePtr>& objects);

 private:
  MutablePtr find(const std::string& id, const Origin& place);

  const Report& report_;
  std::map<std::string, std::string> aliases_;
  std::map<std::string, MutablePtr> ids_;
};

// Throws Error where an object contains itself, or is nested too deeply.
void refuse_cycles(const Object& scene, const Report& report);

}  // namespace vitrail::mitsuba
