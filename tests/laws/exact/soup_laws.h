// SPDX-License-Identifier: Apache-2.0
// The first two laws, judged for one soup.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tests/laws/exact/soup.h"

namespace vitrail::test {

struct Findings {
  std::uint64_t soups = 0, by_files = 0, triangles = 0, cut_triangles = 0, pieces = 0, domains = 0,
                instances = 0;
  std::uint64_t rays = 0, hits = 0, visits = 0, embree_rays = 0, oracle_rays = 0, oracle_triangles = 0;
  // What broke a law: how often, and in which soups (the first few).
  struct Kind {
    std::uint64_t count = 0;
    std::vector<std::uint64_t> seeds;
  };
  std::map<std::string, Kind> differences;

  void differ(const std::string& kind, std::uint64_t seed);
  void add(const Findings& other);
  std::string table() const;
};

struct Effort {
  std::size_t rays = 24;          // a soup
  std::size_t oracle_every = 64;  // rays
  bool verbose = false;           // says on stderr what differs
};

// Most soups are cut in memory, some by way of files, of those some with instances, some in buckets.
void judge(const Soup& soup, const Effort& effort, Findings& findings);

}  // namespace vitrail::test
