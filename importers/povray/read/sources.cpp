// SPDX-License-Identifier: Apache-2.0
// Where tokens come from: files, and what macros and loops have stored.
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>

#include "importers/povray/read/reader.h"
#include "scene/records/nesting_limits.h"

namespace vitrail::pov {

namespace {

// About where the stack is.
std::uintptr_t stack_address() { return reinterpret_cast<std::uintptr_t>(__builtin_frame_address(0)); }

// Half of a thread's stack: what is left is for whoever reads and for messages.
std::uintptr_t usable_stack_bytes() {
  constexpr rlim_t most = rlim_t{64} << 20;
  rlimit limit{};
  if (getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return most / 8;
  return std::min(limit.rlim_cur, most) / 2;
}

}  // namespace

Reader::Source::Source(const std::filesystem::path& path, Symbols& symbols, std::deque<std::string>& texts,
                       std::uint16_t file)
    : bytes(path), lexer(symbols, texts, bytes->begin(), bytes->end(), file) {}

Reader::Source::Source(std::string text, Symbols& symbols, std::deque<std::string>& texts, std::uint16_t file)
    : content(std::move(text)),
      lexer(symbols, texts, content.data(), content.data() + content.size(), file) {}

Reader::Reader(const std::filesystem::path& file, const Search& search, const Limits& limits)
    : search_(search),
      limits_(limits),
      included_(limits.include_bytes),
      stack_begin_(stack_address()),
      stack_bytes_(usable_stack_bytes()) {
  files_.push_back(file.string());
  frames_.reserve(64);
  open_file(file, file.string(), {});
}

std::uint16_t Reader::file_index(const std::string& name) {
  for (std::size_t i = 0; i < files_.size(); ++i)
    if (files_[i] == name) return static_cast<std::uint16_t>(i);
  if (files_.size() > 65'000) fail("too many files are included", last_);
  files_.push_back(name);
  return static_cast<std::uint16_t>(files_.size() - 1);
}

void Reader::open_file(const std::filesystem::path& path, const std::string& name, const Place& place) {
  Frame opened;
  opened.call = place;
  opened.name = name;
  const auto written = written_files_.find(name);
  if (written != written_files_.end()) {
    opened.source = std::make_unique<Source>(written->second, symbols_, texts_, file_index(name));
  } else {
    opened.source = std::make_unique<Source>(path, symbols_, texts_, file_index(path.string()));
    if (!included_.add(path, opened.source->bytes->size())) fail(included_.refusal(), place);
  }
  push(std::move(opened));
}

void Reader::push(Frame opened) {
  if (frames_.size() >= limits_.open_calls)
    fail(fmt::format("too deep: {} macros, loops and files lie within each other; --call-limit raises that",
                     limits_.open_calls),
         opened.call);
  frames_.push_back(std::move(opened));
}

void Reader::pop_frame() {
  const FrameKind kind = frame().kind;
  frames_.pop_back();
  if (kind == FrameKind::macro || (kind == FrameKind::file && !frames_.empty())) symbols_.close_scope();
}

void Reader::count_token() {
  if (++tokens_ > limits_.tokens)
    fail(fmt::format("too long: more than {} tokens are read; does a loop end? --token-limit raises that",
                     limits_.tokens),
         last_);
}

Token Reader::raw() {
  for (;;) {
    Frame& top = frame();
    Token token;
    if (top.kind == FrameKind::file) {
      try {
        token = top.source->lexer.next();
      } catch (const LexicalError& error) {
        fail(error.what(), error.place);
      }
      if (token.kind != TokenKind::end) {
        count_token();
        last_ = token.place;
        return token;
      }
      if (frames_.size() == 1 && top.blocks.empty()) return token;
    } else if (top.at < top.end) {
      count_token();
      token = (*top.buffer)[top.at++];
      last_ = token.place;
      return token;
    }
    end_frame();
  }
}

// At the end of a loop's tokens it may begin again. What is left of the stack is ready to be read then.
bool Reader::end_frame() {
  Frame& top = frame();
  if (!top.blocks.empty()) {
    const Block& open = top.blocks.back();
    fail(open.is_switch ? "this #switch has no #end" : "this #if has no #end", open.place);
  }
  count_token();
  if (top.kind == FrameKind::while_loop) {
    if (top.is_asking) fail("the condition of a loop has no ')'", last_);
    top.is_asking = true;
    top.at = top.begin;
    const std::size_t level = frames_.size();
    const bool again = condition();
    frame().is_asking = false;
    if (again) return true;
    if (frames_.size() != level) fail("a macro ends within the condition of a loop", last_);
  } else if (top.kind == FrameKind::for_loop) {
    auto& counter = std::get<Numbers>(*top.variable);
    counter = Numbers(counter.v[0] + top.step);
    constexpr double tolerance = 1e-10;
    const double left = (top.last - counter.v[0]) * (top.step > 0 ? 1 : -1);
    if (left >= -tolerance) {
      top.at = top.begin;
      return true;
    }
  }
  pop_frame();
  return false;
}

// Whatever reads calls this at each of its levels, however they are mixed: none can go round it.
void Reader::guard_stack() {
  const std::uintptr_t here = stack_address();
  const std::uintptr_t used = here < stack_begin_ ? stack_begin_ - here : here - stack_begin_;
  if (used > stack_bytes_)
    fail(
        "too deep: directives, expressions and blocks lie within each other beyond the stack of the program; "
        "`ulimit -s` raises that",
        last_);
}

Token Reader::next() {
  guard_stack();
  for (;;) {
    Token token;
    if (put_back_.empty()) {
      token = raw();
    } else {
      token = put_back_.back();
      put_back_.pop_back();
      last_ = token.place;
    }
    if (token.kind == TokenKind::directive) {
      const Word word = token.symbol->word;
      const bool flow = opens_block(word) || parts_block(word) || word == Word::break_;
      if (!declaring_ && (!flow || word == Word::macro_)) return token;
      execute(token);
      continue;
    }
    if (token.kind == TokenKind::word && expanding_ && token.symbol->word == Word::none)
      if (const Value* value = token.symbol->value())
        if (const auto* macro = std::get_if<Shared<Macro>>(value)) {
          const Shared<Macro> held = *macro;
          invoke(token, held);
          continue;
        }
    return token;
  }
}

Token Reader::peek() {
  const Token token = next();
  put_back(token);
  return token;
}

bool Reader::accept(char sign) {
  const Token token = next();
  if (token.is(sign)) return true;
  put_back(token);
  return false;
}

bool Reader::accept(Word word) {
  const Token token = next();
  if (token.is(word)) return true;
  put_back(token);
  return false;
}

void Reader::expect(char sign, const char* where) {
  const Token token = next();
  if (!token.is(sign))
    fail(fmt::format("a '{}' is expected {}, not {}", sign, where, describe(token)), token.place);
}

}  // namespace vitrail::pov
