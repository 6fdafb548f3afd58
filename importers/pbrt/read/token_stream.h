// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "importers/bytes/included_text.h"
#include "importers/bytes/input_bytes.h"
#include "importers/pbrt/read/lexer.h"

namespace vitrail::pbrt {

// It gives the tokens of a file and of all that it includes, as one text. The end of an imported file is a
// token of its own.
class TokenStream {
 public:
  TokenStream(const std::filesystem::path& file, std::uint64_t include_limit);

  // Continues with `file`, then comes back. Cycles, too many levels (scene/records/nesting_limits.h) and more
  // text that is included again than the limit throw Error at `where`.
  void include(const std::filesystem::path& file, bool import, const Place& where);

  Token next();
  bool next_number(double& value) {
    return sources_.back()->lexer.next_plain_number(value) || current().next_number(value);
  }
  // Returns whether the next token is a quoted string.
  bool text_follows();
  // Returns the text that comes, up to so many bytes of the file that is being read.
  std::string_view upcoming(std::size_t bytes) const;
  // Has long lists of numbers counted alone.
  void skip_lists() { skips_lists_ = true; }
  bool skips_lists() const { return skips_lists_; }
  // Returns which share of the main file is read.
  double fraction_read() const;
  // Lets go of the memory of what has been read.
  void release();

 private:
  struct Source {
    Source(const std::filesystem::path& path, const std::string* name, bool imported);
    InputBytes bytes;
    Lexer lexer;
    std::filesystem::path identity;  // canonical
    bool import;
  };

  // Returns the lexer that has something left, or the outermost one; stops at the end of an import.
  Lexer& current();

  std::deque<std::string> names_;
  IncludedText included_;
  std::vector<std::unique_ptr<Source>> sources_;
  bool skips_lists_ = false;
};

}  // namespace vitrail::pbrt
