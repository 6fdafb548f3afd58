// SPDX-License-Identifier: Apache-2.0
// Reading what a test writes as a Mitsuba file.
#pragma once

#include <gmock/gmock.h>

#include <algorithm>
#include <string>

#include "importers/mitsuba/read/mitsuba.h"
#include "tests/importers/temporary_folder.h"

namespace vitrail {

inline const std::string head = "<scene version=\"3.0.0\">", tail = "</scene>";
inline const std::string floor = "<shape type=\"rectangle\"><ref id=\"m\"/></shape>";

class MitsubaLoad : public ::testing::Test {
 protected:
  ImportedScene read(const std::string& inside) {
    return read_mitsuba(folder_.write("scene.xml", head + inside + tail));
  }
  Material material(const std::string& inside) {
    imported_ = read(inside + floor);
    return imported_.scene.materials.at(imported_.scene.shapes.at(0).material.value);
  }
  std::string error(const std::string& text) {
    try {
      read_mitsuba(folder_.write("scene.xml", text));
    } catch (const Error& e) {
      EXPECT_FALSE(e.location.file.empty()) << e.what();
      return e.what();
    }
    return "no error";
  }
  std::string error_inside(const std::string& inside) { return error(head + inside + tail); }
  bool mentions(const std::string& words) const {
    return std::any_of(imported_.diagnostics.begin(), imported_.diagnostics.end(),
                       [&](const Diagnostic& d) { return d.message.find(words) != std::string::npos; });
  }
  TemporaryFolder folder_;
  ImportedScene imported_;
};

}  // namespace vitrail
