// SPDX-License-Identifier: Apache-2.0
// A HeldIds counts files that together hold every id once: the domains of a scene, or the parts of one
// prototype.
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "bundle/census.h"
#include "bundle/manifest.h"

namespace vitrail {

struct HeldInstance {
  std::uint64_t place = 0;  // a hash of where it stands
  std::uint32_t first_triangle = 0, object = 0;
  auto operator<=>(const HeldInstance&) const = default;
};

class HeldIds {
 public:
  HeldIds() = default;  // counts nothing
  // Ids are [0, triangles), of which those of the `instances` stand in other files. Where there are more ids
  // than numbers (triangle_number.h), those of instances come last, and only their sum is looked at.
  HeldIds(std::string name, const Manifest& manifest, std::uint64_t triangles, std::uint64_t cut_triangles,
          std::vector<HeldInstance> instances);

  const std::string& name() const { return name_; }
  // Adds a file that is to be counted, and returns its number here.
  std::uint32_t add_part() { return parts_++; }
  // Counts the triangles of a part. Any thread may call it.
  void count(std::uint32_t part, const MappedDomain& mapped);
  // Returns whether every part has been counted.
  bool complete() const { return census_ && counted_ == parts_; }

  CensusResult census() const { return census_->result(); }
  // Returns what the census finds wrong. It returns nothing where a part was not counted, which has been
  // reported already.
  std::vector<std::string> problems() const;

 private:
  std::string name_;
  std::uint64_t cut_triangles_ = 0;
  std::string instances_problem_;
  std::optional<Census> census_;
  std::uint32_t parts_ = 0;
  std::atomic<std::uint32_t> counted_ = 0;
};

// Returns the end of the parts of a prototype that begin with `first`. They are objects that follow each
// other and have the same surfaces, or that continue.
std::uint32_t end_of_prototype(const Manifest& m, std::uint32_t first);

// Throws Error where a domain does not hold what its line in the manifest says.
void check_counts(const Manifest& manifest, std::uint32_t domain, const MappedDomain& mapped,
                  const std::filesystem::path& file);

}  // namespace vitrail
