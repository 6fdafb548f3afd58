// SPDX-License-Identifier: Apache-2.0
// Pages that people read have sentences that people can read.
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <sstream>

#include "tests/docs/pages.h"

namespace vitrail::test::sentences_test {
namespace {

namespace fs = std::filesystem;

constexpr int most_words = 25;

struct Sentence {
  std::string text;
  int line = 0;  // where its paragraph begins
};

bool is_held(const std::string& page) {
  return page.find('/') == std::string::npos || page == "docs/README.md" || page == "docs/glossary.md" ||
         page.starts_with("docs/tutorial/") || page.starts_with("docs/how-to/") ||
         page.starts_with("docs/why/");
}

bool is_item(const std::string& line) {
  static const std::regex item(R"(\s*([-*]|\d+\.) .*)");
  return std::regex_match(line, item);
}

// A paragraph, or an item of a list; tables, headings and code are none.
std::vector<Sentence> paragraphs_of(const fs::path& page) {
  std::vector<Sentence> found;
  bool open = false;
  for (const PageLine& line : lines_of(page)) {
    const bool is_prose =
        !line.is_code && !line.text.empty() && !line.text.starts_with("|") && !line.text.starts_with("#");
    if (is_prose && (!open || is_item(line.text))) found.push_back({"", line.number});
    if (is_prose) found.back().text += line.text + " ";
    open = is_prose;
  }
  return found;
}

// A span of code and a link count as the words that a reader sees; a colon and a semicolon end a sentence,
// too.
std::vector<Sentence> sentences_of(const Sentence& paragraph) {
  static const std::regex link(R"(\[([^\]]*)\]\([^)]*\))"), code("`[^`]*`"), end(R"(([.!?:;]) +)");
  const std::string words = std::regex_replace(std::regex_replace(paragraph.text, link, "$1"), code, "code");
  std::vector<Sentence> found;
  std::istringstream lines(std::regex_replace(words, end, "$1\n"));
  for (std::string text; std::getline(lines, text);) found.push_back({text, paragraph.line});
  return found;
}

// Signs alone (×, −, /) are no words.
int words_in(const std::string& sentence) {
  std::istringstream words(sentence);
  int count = 0;
  for (std::string word; words >> word;)
    count += std::ranges::any_of(word, [](unsigned char c) { return std::isalnum(c) != 0; });
  return count;
}

TEST(Sentences, AreShortWherePeopleRead) {
  int count = 0;
  for (const fs::path& page : pages()) {
    if (!is_held(name_of(page))) continue;
    for (const Sentence& paragraph : paragraphs_of(page))
      for (const Sentence& sentence : sentences_of(paragraph)) {
        EXPECT_LE(words_in(sentence.text), most_words)
            << name_of(page) << ":" << sentence.line << ": " << sentence.text;
        ++count;
      }
  }
  EXPECT_GT(count, 3000);
}

}  // namespace
}  // namespace vitrail::test::sentences_test
