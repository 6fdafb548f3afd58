// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/formats/feature_cases.h"

namespace vitrail::test {

namespace {

std::string lines_of(std::string text) {
  for (std::size_t at; (at = text.find(" / ")) != std::string::npos;) text.replace(at, 3, "\n");
  return text + "\n";
}

bool is_of_obj(const PluginCase& plugin) { return plugin.name.starts_with("OBJ"); }

}  // namespace

// A square, and statements between two of its copies.
std::string obj_scene(const PluginCase& plugin, const std::string& parameters) {
  std::string text =
      "mtllib in.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
      "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\nusemtl m\nf 1/1 2/2 3/3 4/4\n";
  if (is_of_obj(plugin)) text += lines_of(plugin.needs) + lines_of(parameters);
  return text + "f 5/1 6/2 7/3 8/4\n";
}

std::string mtl_library(const PluginCase& plugin, const std::string& parameters) {
  const std::string text = "newmtl m\nKd .7 .5 .3\n";
  return is_of_obj(plugin) ? text : text + lines_of(plugin.needs) + lines_of(parameters);
}

}  // namespace vitrail::test
