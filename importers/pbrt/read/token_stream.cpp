// SPDX-License-Identifier: Apache-2.0
#include "importers/pbrt/read/token_stream.h"

#include <fmt/format.h>

#include <algorithm>

#include "scene/records/nesting_limits.h"

namespace vitrail::pbrt {

TokenStream::Source::Source(const std::filesystem::path& path, const std::string* name, bool imported)
    : bytes(path),
      lexer(name, bytes.begin(), bytes.end()),
      identity(std::filesystem::weakly_canonical(path)),
      import(imported) {}

TokenStream::TokenStream(const std::filesystem::path& file, std::uint64_t include_limit)
    : included_(include_limit) {
  names_.push_back(file.string());
  sources_.push_back(std::make_unique<Source>(file, &names_.back(), false));
}

void TokenStream::include(const std::filesystem::path& file, bool import, const Place& where) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored))
    fail(fmt::format("cannot find the included file \"{}\"", file.string()), where);
  const std::filesystem::path identity = std::filesystem::weakly_canonical(file);
  for (const auto& source : sources_)
    if (source->identity == identity)
      fail(fmt::format("\"{}\" includes itself, directly or through others", file.string()), where);
  if (sources_.size() > most_included)
    fail(fmt::format("files are included more than {} levels deep", most_included), where);
  names_.push_back(file.string());
  sources_.push_back(std::make_unique<Source>(file, &names_.back(), import));
  if (!included_.add(file, sources_.back()->bytes.size())) fail(included_.refusal(), where);
}

Lexer& TokenStream::current() {
  while (sources_.size() > 1 && !sources_.back()->import && sources_.back()->lexer.peek() == '\0' &&
         sources_.back()->lexer.position() == sources_.back()->bytes.end())
    sources_.pop_back();
  return sources_.back()->lexer;
}

Token TokenStream::next() {
  Token token = current().next();
  if (token.kind == TokenKind::end && sources_.back()->import) {
    token.kind = TokenKind::end_of_import;
    sources_.pop_back();
  }
  return token;
}

bool TokenStream::text_follows() { return current().peek() == '"'; }

std::string_view TokenStream::upcoming(std::size_t bytes) const {
  const char* const at = sources_.back()->lexer.position();
  const auto left = static_cast<std::size_t>(sources_.back()->bytes.end() - at);
  return {at, std::min(bytes, left)};
}

double TokenStream::fraction_read() const {
  const Source& main = *sources_.front();
  return static_cast<double>(main.lexer.position() - main.bytes.begin()) /
         static_cast<double>(std::max<std::size_t>(main.bytes.size(), 1));
}

void TokenStream::release() { sources_.back()->bytes.release_before(sources_.back()->lexer.position()); }

}  // namespace vitrail::pbrt
