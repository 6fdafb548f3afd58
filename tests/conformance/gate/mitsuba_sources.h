// SPDX-License-Identifier: Apache-2.0
// Mitsuba's own scene files, of every BSDF × adapter × texture × number × emitter × shape that stand for a
// way in which people write them: defaults left out, references, old and new forms of one thing.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vitrail::test {

class MitsubaSources {
 public:
  using Row = std::vector<std::size_t>;

  // The meshes that the files refer to are written into `folder`; the images of part_images.cpp have to be
  // there.
  explicit MitsubaSources(const std::filesystem::path& folder);

  // Files in which all pairs of values occur.
  std::vector<Row> rows() const;
  std::string name(const Row& row) const;
  void write(const Row& row, const std::filesystem::path& file) const;  // in the folder
};

}  // namespace vitrail::test
