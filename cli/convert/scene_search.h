// SPDX-License-Identifier: Apache-2.0
// This file finds the scenes that a list of files and folders means, and the names of their conversions.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vitrail {

struct FoundScene {
  std::filesystem::path input;
  std::filesystem::path name;  // relative, with the input's extension
};

// Returns a file as itself. A folder is searched with all below it for whole scenes, in alphabetical
// order: .pbrt files with a WorldBegin, .xml files with a sensor. Files that these include, and OBJ and
// PLY files, mostly parts of scenes, count only where they are named; so do files in `results`. Throws
// UsageError for missing inputs.
std::vector<FoundScene> find_scenes(const std::vector<std::filesystem::path>& inputs,
                                    const std::filesystem::path& results);

// Returns name.xml of name.pbrt for "xml"; where two scenes would become one file, name.pbrt.xml. Equal names
// from different folders throw UsageError.
std::vector<std::filesystem::path> converted_names(const std::vector<FoundScene>& scenes,
                                                   const std::string& format);

}  // namespace vitrail
