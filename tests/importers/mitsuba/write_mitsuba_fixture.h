// SPDX-License-Identifier: Apache-2.0
// Scenes written for Mitsuba, as text.
#pragma once

#include <gmock/gmock.h>

#include <fstream>
#include <pugixml.hpp>

#include "importers/mitsuba/write/write_mitsuba.h"
#include "tests/importers/temporary_folder.h"
#include "tests/importers/written_scenes.h"

namespace vitrail {

class WriteMitsuba : public testing::Test {
 protected:
  pugi::xml_node write(const Scene& scene) {
    diagnostics_ = write_mitsuba(scene, folder_ / "scene.xml");
    std::ifstream file(folder_ / "scene.xml");
    text_.assign(std::istreambuf_iterator<char>(file), {});
    EXPECT_TRUE(document_.load_string(text_.c_str()));
    return document_.child("scene");
  }
  // The element of a material's model, inside of its adapters.
  pugi::xml_node write_material(MaterialModel model, bool two_sided = false) {
    Material material;
    material.model = std::move(model);
    material.two_sided = two_sided;
    return write(square_scene(material)).child("bsdf");
  }
  static std::string value(pugi::xml_node element, const char* name) {
    return element.find_child_by_attribute("name", name).attribute("value").value();
  }
  static std::string reference(pugi::xml_node element, const char* name) {
    return element.find_child_by_attribute("ref", "name", name).attribute("id").value();
  }
  static auto says(Fidelity fidelity, const std::string& text) {
    return testing::Contains(testing::AllOf(testing::Field(&Diagnostic::fidelity, fidelity),
                                            testing::Field(&Diagnostic::message, testing::HasSubstr(text))));
  }
  static auto approximates(const std::string& text) { return says(Fidelity::approximated, text); }
  static auto drops(const std::string& text) { return says(Fidelity::dropped, text); }

  TemporaryFolder folder_;
  pugi::xml_document document_;
  std::string text_;
  Diagnostics diagnostics_;
};

}  // namespace vitrail
