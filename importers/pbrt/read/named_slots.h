// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "importers/pbrt/read/lexer.h"
#include "importers/reading/suggestion.h"

namespace vitrail::pbrt {

// It gives numbers to names that may be used before they are defined.
class NamedSlots {
 public:
  explicit NamedSlots(std::string what) : what_(std::move(what)) {}

  // Returns the number that the name has now; `next_free` if it has none yet.
  std::uint32_t use(const std::string& name, const Place& place, std::uint32_t next_free) {
    const auto [entry, added] = entries_.try_emplace(name, Entry{next_free, place, false});
    return entry->second.slot;
  }

  // It has the number to define the name under: that of its uses, or `next_free` if it was defined before
  // (`redefined`), which later uses then get.
  struct Definition {
    std::uint32_t slot;
    bool redefined;
  };
  Definition define(const std::string& name, const Place& place, std::uint32_t next_free) {
    Entry& entry = entries_.try_emplace(name, Entry{next_free, place, false}).first->second;
    const bool redefined = entry.defined;
    if (redefined) entry.slot = next_free;
    entry.defined = true;
    return {entry.slot, redefined};
  }

  // `end` needs it to undo the definition that comes next.
  struct Before {
    std::string name;
    std::optional<std::uint32_t> slot;
  };
  Before before(const std::string& name) const {
    const auto entry = entries_.find(name);
    const bool defined = entry != entries_.end() && entry->second.defined;
    return {name, defined ? std::optional(entry->second.slot) : std::nullopt};
  }
  // Makes the name what it was then.
  void end(const Before& before) {
    const auto entry = entries_.find(before.name);
    if (before.slot) {
      entry->second.slot = *before.slot;
    } else {
      ended_.insert(before.name);
      entries_.erase(entry);
    }
  }
  // Returns whether it had a definition and has none now.
  bool has_ended(const std::string& name) const { return ended_.contains(name) && !entries_.contains(name); }

  // Gives each name that is used and never defined, by its number, to `define(name, slot, place)`.
  template <class F>
  void define_others(F&& define) {
    std::map<std::uint32_t, std::string> others;
    for (const auto& [name, entry] : entries_)
      if (!entry.defined) others.emplace(entry.slot, name);
    for (const auto& [slot, name] : others) {
      Entry& entry = entries_.at(name);
      entry.defined = true;
      define(name, slot, entry.place);
    }
  }

  // Throws Error at the first use of a name that has no definition.
  void require_definitions() const {
    for (const auto& [name, entry] : entries_) {
      if (entry.defined) continue;
      std::vector<std::string> defined;
      for (const auto& [other, state] : entries_)
        if (state.defined) defined.push_back(other);
      fail(what_ + " \"" + name + "\" is not defined" + suggestion(name, defined), entry.place);
    }
  }

 private:
  struct Entry {
    std::uint32_t slot;
    Place place;  // first use or definition
    bool defined;
  };
  std::string what_;
  std::map<std::string, Entry> entries_;
  std::set<std::string> ended_;
};

}  // namespace vitrail::pbrt
