// SPDX-License-Identifier: Apache-2.0
// Small scenes of every material × wrapper × texture × number × light × shape: an object before a wall and on
// a floor, 32 × 32 pixels. Writers have to be right about each, or to say that they are not.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "scene/records/scene.h"

namespace vitrail::test {

class CrossProduct {
 public:
  // The number of its value in each dimension.
  using Row = std::vector<std::size_t>;

  // Images that the scenes refer to are written into `folder`.
  explicit CrossProduct(const std::filesystem::path& folder);

  // Scenes in which all pairs of values occur.
  std::vector<Row> rows() const;
  // The same of the values that a scene that is plain but for them passes `test` with. What is wrong with one
  // value would hide what is wrong with the others.
  std::vector<Row> rows_that(const std::function<bool(const Scene&)>& test) const;

  // "rough glass / mask / image / 0.3 / soft spot / ball".
  std::string name(const Row& row) const;
  Scene scene(const Row& row) const;

 private:
  std::filesystem::path folder_;
};

// Of `rows` the first ones in which every value occurs.
std::vector<CrossProduct::Row> short_form(const std::vector<CrossProduct::Row>& rows);

}  // namespace vitrail::test
