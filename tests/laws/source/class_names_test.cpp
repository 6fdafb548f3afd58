// SPDX-License-Identifier: Apache-2.0
// A name in a namespace is that of one class. Where two have it, a program that holds both is undefined: the
// linker keeps one std::vector<Name>, which may move the other's elements in steps of a wrong size.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/support/paths.h"

namespace vitrail::class_names_test {
namespace {

// Calls what is given with each class of the file that other files can see, as "vitrail::pov::Token".
void for_each_class(const std::filesystem::path& file, const std::function<void(std::string)>& call) {
  const std::regex begin(R"rx(^(?:inline )?namespace ([\w:]*) ?\{)rx"),
      end(R"rx(^\}  // (inline )?namespace)rx"),
      definition(
          R"rx(^(?:struct|class|union|enum class|enum) (?:alignas\(\w+\) )?(\w+)(?: final)?(?: : [^;]*| \{.*)?$)rx");
  std::vector<std::string> within;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::smatch found;
    if (std::regex_search(line, found, begin)) {
      within.push_back(found[1]);
    } else if (std::regex_search(line, end)) {
      within.pop_back();
    } else if (std::regex_search(line, found, definition) && !std::ranges::count(within, "")) {
      std::string name;
      for (const std::string& part : within) name += part + "::";
      call(name + found[1].str());
    }
  }
}

TEST(ClassNames, AreThoseOfOneClassEach) {
  std::map<std::string, std::set<std::string>> files_of;
  for (const char* folder : {"scene", "glazing", "images", "importers", "bundle", "partitioner", "film",
                             "denoise", "tracer", "farm", "compare", "measure", "cli", "python"})
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(std::filesystem::path(test::source_dir()) / folder))
      if (const auto extension = entry.path().extension(); extension == ".h" || extension == ".cpp")
        for_each_class(entry.path(),
                       [&](const std::string& name) { files_of[name].insert(entry.path().string()); });
  EXPECT_GT(files_of.size(), 1000u);
  for (const auto& [name, files] : files_of)
    EXPECT_EQ(files.size(), 1u) << name << " in " << *files.begin() << " and " << *files.rbegin();
}

}  // namespace
}  // namespace vitrail::class_names_test
