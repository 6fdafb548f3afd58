// SPDX-License-Identifier: Apache-2.0
// Scenes of one OBJ and its library, read.
#pragma once

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "importers/obj/read/obj.h"
#include "tests/importers/temporary_folder.h"

namespace vitrail {

class Obj : public testing::Test {
 protected:
  ImportedScene read(const std::string& content) { return read_obj(folder_.write("scene.obj", content)); }

  Error error_of(const std::string& content) {
    try {
      read(content);
    } catch (const Error& error) {
      return error;
    }
    ADD_FAILURE() << "accepted: " << content;
    return Error("");
  }

  // The only material of a library with this text.
  Material whole_material(const std::string& mtl) {
    folder_.write("m.mtl", "newmtl m\n" + mtl);
    imported_ = read("mtllib m.mtl\n" + tetrahedron);
    return imported_.scene.materials.at(imported_.scene.shapes.at(0).material.value);
  }
  MaterialModel material(const std::string& mtl) { return whole_material(mtl).model; }

  const ImageTexture& image(const SpectrumParameter& parameter) {
    return std::get<ImageTexture>(imported_.scene.textures.at(std::get<Id<Texture>>(parameter).value).model);
  }
  const ImageTexture& image(const FloatParameter& parameter) {
    return std::get<ImageTexture>(imported_.scene.textures.at(std::get<Id<Texture>>(parameter).value).model);
  }

  static std::vector<std::string> names_of(const Scene& scene) {
    std::vector<std::string> names;
    for (const Shape& shape : scene.shapes) names.push_back(shape.name);
    return names;
  }
  static auto says(const std::string& text) {
    return testing::Contains(testing::Field(&Diagnostic::message, testing::HasSubstr(text)));
  }

  const std::string tetrahedron =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl m\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  TemporaryFolder folder_;
  ImportedScene imported_;
};

}  // namespace vitrail
