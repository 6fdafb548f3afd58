// SPDX-License-Identifier: Apache-2.0
// Comments in headers are sentences with a subject and a verb.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <string>

#include "tests/support/paths.h"

namespace vitrail::header_comments_test {
namespace {

// Behind these words a comment has no subject: "Of memory, when it is loaded." They make clauses of
// sentences.
const std::set<std::string> openers{"And",   "As", "At",   "But",  "By",    "For",   "From",    "How",
                                    "If",    "In", "Of",   "On",   "Or",    "So",    "Than",    "That",
                                    "Those", "To", "What", "When", "Where", "Which", "Whether", "With"};

// Returns the first word of the comment line, "" where there is none.
std::string first_word(const std::string& comment) {
  static const std::regex word(R"rx(^\s*// ([A-Za-z]+)\b)rx");
  std::smatch found;
  return std::regex_search(comment, found, word) ? found[1].str() : "";
}

TEST(HeaderComments, OpenWithASubjectOrAVerb) {
  const std::regex comment(R"rx(^\s*//)rx"), licence("SPDX-License-Identifier");
  int blocks = 0;
  for (const char* folder : {"scene", "glazing", "images", "importers", "bundle", "partitioner", "film",
                             "denoise", "tracer", "farm", "compare", "measure", "cli", "python"})
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(std::filesystem::path(test::source_dir()) / folder)) {
      if (entry.path().extension() != ".h") continue;
      std::ifstream in(entry.path());
      bool within = false;
      int number = 0;
      for (std::string line; std::getline(in, line);) {
        ++number;
        if (!std::regex_search(line, comment)) {
          within = false;
        } else if (!std::regex_search(line, licence) && !within) {
          within = true;
          ++blocks;
          EXPECT_FALSE(openers.contains(first_word(line))) << entry.path().string() << ':' << number << line;
        }
      }
    }
  EXPECT_GT(blocks, 4000);
}

}  // namespace
}  // namespace vitrail::header_comments_test
