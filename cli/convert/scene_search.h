// SPDX-License-Identifier: Apache-2.0
// Which scenes a list of files and folders means, and what they are called when they are converted.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vitrail {

struct FoundScene {
  std::filesystem::path input;
  std::filesystem::path name;  // relative, with the input's extension
};

// A file is itself. A folder is searched with all below it for whole scenes, in alphabetical order: .pbrt
// files with a WorldBegin, .xml files with a sensor; what these include, and OBJ and PLY files, which are
// mostly parts of scenes, count only where they are named; so does what lies in `results`. Throws UsageError
// for what is not there.
std::vector<FoundScene> find_scenes(const std::vector<std::filesystem::path>& inputs,
                                    const std::filesystem::path& results);

// name.pbrt → name.xml for "xml"; where two scenes would become one file, name.pbrt.xml. Those of equal names
// from different folders throw UsageError.
std::vector<std::filesystem::path> converted_names(const std::vector<FoundScene>& scenes,
                                                   const std::string& format);

}  // namespace vitrail
