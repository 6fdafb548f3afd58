// SPDX-License-Identifier: Apache-2.0
// The plugins and parameters of a format, each once, from the .txt files of this folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vitrail::test {

enum class SceneFormat { pbrt_v3, pbrt_v4, mitsuba_06, mitsuba_3, gltf, obj };

struct PluginCase {
  std::string name;                     // Material "mix"; bsdf mask
  std::string needs;                    // what it cannot be without
  std::vector<std::string> parameters;  // as they stand in a file
};

std::vector<PluginCase> read_cases(const std::filesystem::path& file);

// What a table calls a parameter: "float fov"; of OBJ and MTL the line itself.
std::string parameter_name(SceneFormat format, const std::string& parameter);

// A scene in which a plugin with `parameters` is seen: a sphere of its material, or with its texture, medium,
// light …; of "", the scene around it.
std::string host_scene(SceneFormat format, const PluginCase& plugin, const std::string& parameters);

// The same of glTF; host_scene calls it.
std::string gltf_scene(const PluginCase& plugin, const std::string& parameters);

// The same of OBJ, and its library in.mtl: lines of a case are divided by " / ".
std::string obj_scene(const PluginCase& plugin, const std::string& parameters);
std::string mtl_library(const PluginCase& plugin, const std::string& parameters);

// The files that the cases name, images apart; those of them that a reader of scenes opens.
void write_case_files(const std::filesystem::path& folder);
void write_opened_files(const std::filesystem::path& folder);

}  // namespace vitrail::test
