// SPDX-License-Identifier: Apache-2.0
// Directives that choose and repeat: #if, #switch, #while, #for, #macro.
#include <fmt/format.h>

#include <cmath>

#include "importers/povray/read/reader.h"
#include "importers/povray/read/truth.h"
#include "importers/reading/suggestion.h"
#include "scene/records/nesting_limits.h"

namespace vitrail::pov {

void Reader::execute(const Token& directive) {
  const bool declaring = declaring_, comparing = comparing_;
  const auto first = first_;
  declaring_ = true, comparing_ = false, first_.reset();
  switch (directive.symbol->word) {
    case Word::declare_:
    case Word::local_:
      declare(directive.symbol->word == Word::local_);
      break;
    case Word::undef_:
      undefine();
      break;
    case Word::include_:
      include(directive);
      break;
    case Word::macro_:
      define_macro(directive);
      break;
    case Word::if_:
    case Word::ifdef_:
    case Word::ifndef_:
      open_if(directive);
      break;
    case Word::switch_:
      open_switch(directive);
      break;
    case Word::while_:
      open_while(directive);
      break;
    case Word::for_:
      open_for(directive);
      break;
    case Word::else_:
    case Word::elseif_:
    case Word::case_:
    case Word::range_:
    case Word::end_:
      part(directive);
      break;
    case Word::break_:
      break_out(directive);
      break;
    case Word::version_:
      set_version(directive.place);
      break;
    case Word::default_:
      set_defaults();
      break;
    case Word::error_:
      fail("#error: " + message_text(), directive.place);
    case Word::warning_:
    case Word::debug_:
    case Word::render_:
    case Word::statistics_:
      message_text();
      break;
    case Word::max_trace_level_: {  // of version 1: a statement
      Token statement = directive;
      statement.kind = TokenKind::word;
      put_back(statement);
      break;
    }
    case Word::fopen_:
      open_text_file(directive);
      break;
    case Word::fclose_:
      close_text_file();
      break;
    case Word::write_:
      write_text();
      break;
    case Word::read_:
      read_text();
      break;
    default:
      fail(fmt::format("#{} is no directive", directive.symbol->name), directive.place);
  }
  declaring_ = declaring, comparing_ = comparing, first_ = first;
}

bool Reader::condition() {
  expect('(', "before a condition");
  const bool comparing = comparing_;
  comparing_ = true;
  const Numbers value = conditional();
  comparing_ = comparing;
  expect(')', "behind a condition");
  return is_true(value.v[0]);
}

// ---- Blocks

void Reader::choose(const Block& block, Token part, bool taken) {
  // `part` opened the block, or parts it and was left out.
  std::uint32_t match = part.match;
  while (!taken) {
    part = skip_part(match, block.place);
    match = part.match;
    const Word word = part.symbol->word;
    if (word == Word::end_) return;
    if (word == Word::else_) break;
    if (word == Word::elseif_ && !block.is_switch) {
      taken = condition();
    } else if (block.is_switch && word == Word::case_) {
      expect('(', "behind #case");
      const double value = number("a number");
      expect(')', "behind the number of #case");
      taken = are_equal(value, block.value);
    } else if (block.is_switch && word == Word::range_) {
      expect('(', "behind #range");
      const double low = number("a number");
      expect(',', "between the numbers of #range");
      const double high = number("a number");
      expect(')', "behind the numbers of #range");
      taken = block.value >= low && block.value <= high;
    } else {
      fail(fmt::format("#{} does not belong here", part.symbol->name), part.place);
    }
  }
  Block open = block;
  open.match = match;
  frame().blocks.push_back(open);
}

void Reader::open_if(const Token& directive) {
  const Word word = directive.symbol->word;
  const bool holds = word == Word::if_ ? condition() : test_defined() == (word == Word::ifdef_);
  choose({false, 0, directive.place}, directive, holds);
}

void Reader::open_switch(const Token& directive) {
  expect('(', "behind #switch");
  const double value = number("a number");
  expect(')', "behind the number of #switch");
  choose({true, value, directive.place}, directive, false);
}

// A part of a block ends that was carried out.
void Reader::part(const Token& directive) {
  auto& blocks = frame().blocks;
  const Word word = directive.symbol->word;
  if (blocks.empty())
    fail(fmt::format("#{} without #if or #switch", directive.symbol->name), directive.place);
  if (word == Word::end_) {
    blocks.pop_back();
    return;
  }
  Block& block = blocks.back();
  block.match = directive.match;
  if (block.is_switch) {  // without #break, the next part is carried out, too
    if (word == Word::case_ || word == Word::range_) {
      expect('(', "behind #case");
      number("a number");
      if (accept(',')) number("a number");
      expect(')', "behind the number");
    }
    return;
  }
  const Place opened = block.place;
  std::uint32_t match = directive.match;
  for (Token next = skip_part(match, opened); next.symbol->word != Word::end_;
       next = skip_part(match, opened))
    match = next.match;
  frame().blocks.pop_back();
}

void Reader::break_out(const Token& directive) {
  auto& blocks = frame().blocks;
  std::size_t inner = 0;  // blocks of #if within the #switch
  while (!blocks.empty()) {
    const Block block = blocks.back();
    blocks.pop_back();
    if (!block.is_switch) {
      ++inner;
      continue;
    }
    if (frame().kind != FrameKind::file) {
      std::uint32_t match = block.match;
      for (Token next = skip_part(match, block.place); next.symbol->word != Word::end_;
           next = skip_part(match, block.place))
        match = next.match;
      return;
    }
    for (std::size_t i = 0; i <= inner;)
      if (skip_part(0, block.place).symbol->word == Word::end_) ++i;
    return;
  }
  if (frame().kind != FrameKind::while_loop && frame().kind != FrameKind::for_loop)
    fail("#break outside of a loop or #switch", directive.place);
  pop_frame();
}

Token Reader::skip_part(std::uint32_t match, const Place& opened) {
  Frame& top = frame();
  if (top.kind != FrameKind::file) {
    top.at = match + 1;
    return (*top.buffer)[match];
  }
  std::size_t depth = 0;
  try {
    while (top.source->lexer.skip_to_directive()) {
      const Token token = top.source->lexer.next();
      count_token();
      const Word word = token.symbol->word;
      if (depth == 0 && parts_block(word)) return token;
      if (opens_block(word)) ++depth;
      if (word == Word::end_) --depth;
    }
  } catch (const LexicalError& error) {
    fail(error.what(), error.place);
  }
  fail("this block has no #end", opened);
}

Reader::Body Reader::body(const Token& directive) {
  Frame& top = frame();
  if (!put_back_.empty()) fail("this directive does not belong here", directive.place);
  if (top.kind != FrameKind::file) {
    const std::size_t begin = top.at, end = directive.match;
    top.at = end + 1;
    return {top.buffer, begin, end};
  }
  auto buffer = std::make_shared<TokenBuffer>();
  std::vector<std::size_t> open;  // the directives whose match is to come
  for (;;) {
    Token token;
    try {
      token = top.source->lexer.next();
    } catch (const LexicalError& error) {
      fail(error.what(), error.place);
    }
    count_token();
    if (token.kind == TokenKind::end)
      fail(fmt::format("this #{} has no #end", directive.symbol->name), directive.place);
    if (token.kind == TokenKind::directive) {
      const Word word = token.symbol->word;
      const auto index = static_cast<std::uint32_t>(buffer->size());
      if (parts_block(word)) {
        if (open.empty() && word == Word::end_) break;
        if (!open.empty()) {
          (*buffer)[open.back()].match = index;
          open.pop_back();
        }
        if (word != Word::end_) open.push_back(index);
      } else if (opens_block(word)) {
        open.push_back(index);
      }
    }
    if (buffer->size() > 0xFFFF'FFF0u) fail("this block is too long", directive.place);
    buffer->push_back(token);
  }
  const std::size_t end = buffer->size();
  return {std::move(buffer), 0, end};
}

// ---- Loops

void Reader::open_while(const Token& directive) {
  Body read = body(directive);
  Frame loop;
  loop.kind = FrameKind::while_loop;
  loop.call = directive.place;
  loop.buffer = std::move(read.buffer);
  loop.begin = read.begin, loop.at = read.end, loop.end = read.end;
  push(std::move(loop));  // its end is where the condition is asked
}

void Reader::open_for(const Token& directive) {
  expect('(', "behind #for");
  Symbol* const name = raw_name("the name of the counter");
  expect(',', "behind the name of the counter");
  const double from = number("where the counter begins");
  expect(',', "behind where the counter begins");
  const double to = number("where the counter ends");
  const double step = accept(',') ? number("the step of the counter") : 1;
  expect(')', "behind the numbers of #for");
  if (step == 0) fail("the step of #for is 0", directive.place);
  Body read = body(directive);
  Frame loop;
  loop.kind = FrameKind::for_loop;
  loop.call = directive.place;
  loop.buffer = std::move(read.buffer);
  loop.begin = read.begin, loop.at = read.end, loop.end = read.end;
  loop.variable = symbols_.variable(name, symbols_.depth());
  *loop.variable = Numbers(from - step);  // its end makes the first step
  loop.last = to, loop.step = step;
  push(std::move(loop));
}

// ---- Macros

void Reader::define_macro(const Token& directive) {
  Symbol* const name = raw_name("the name of the macro");
  auto macro = std::make_shared<Macro>();
  macro->name = name->name;
  expect('(', "behind the name of a macro");
  while (!accept(')')) {
    macro->parameters.push_back(raw_name("the name of a parameter"));
    comma();
  }
  Body read = body(directive);
  macro->buffer = std::move(read.buffer);
  macro->begin = read.begin, macro->end = read.end;
  *symbols_.visible(name) = Shared<Macro>(std::move(macro));
}

void Reader::invoke(const Token& name, const Shared<Macro>& macro) {
  const bool declaring = declaring_, comparing = comparing_;
  const auto first = first_;
  declaring_ = true, comparing_ = true, first_.reset();
  std::vector<std::shared_ptr<Value>> arguments;
  {
    const Deeper deeper(*this, name.place);
    expect('(', "behind the name of a macro");
    while (!accept(')')) {
      if (!arguments.empty()) comma();
      if (arguments.size() >= macro->parameters.size()) {
        if (!arguments.empty() && accept(')')) break;  // povray takes a comma behind the last one
        fail(fmt::format("macro {} takes {} arguments", macro->name, macro->parameters.size()), name.place);
      }
      // A name alone is passed as what it stands for, which the macro may change.
      const Token token = next();
      if (token.kind == TokenKind::word && token.symbol->word == Word::none) {
        const Token after = peek_operator();
        if (after.is(',') || after.is(')')) {
          arguments.push_back(symbols_.visible(token.symbol));
          continue;
        }
      }
      put_back(token);
      arguments.push_back(std::make_shared<Value>(read_value(*this)));
    }
  }
  if (arguments.size() < macro->parameters.size())
    fail(fmt::format("macro {} takes {} arguments, not {}", macro->name, macro->parameters.size(),
                     arguments.size()),
         name.place);
  Frame call;
  call.kind = FrameKind::macro;
  call.call = name.place;
  call.name = macro->name;
  call.buffer = macro->buffer;
  call.begin = call.at = macro->begin, call.end = macro->end;
  push(std::move(call));
  symbols_.open_scope();
  for (std::size_t i = 0; i < arguments.size(); ++i)
    symbols_.alias(macro->parameters[i], std::move(arguments[i]));
  declaring_ = declaring, comparing_ = comparing, first_ = first;
}

void Reader::include(const Token& directive) {
  const std::string name = text("the name of a file");
  if (frames_.size() >= most_included) {
    std::size_t files = 0;
    for (const Frame& open : frames_) files += open.kind == FrameKind::file;
    if (files >= most_included) fail("too many files include each other", directive.place);
  }
  const auto path =
      written_files_.contains(name) ? std::filesystem::path(name) : find_file(name, directive.place);
  open_file(path, name, directive.place);
  symbols_.open_scope();
}

}  // namespace vitrail::pov
