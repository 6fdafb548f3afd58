// SPDX-License-Identifier: Apache-2.0
// Directives that set something: #declare, #undef, #version, and those of text files.
#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "importers/povray/read/levels.h"
#include "importers/povray/read/numbers_text.h"
#include "importers/povray/read/reader.h"
#include "importers/povray/read/text_file.h"

namespace vitrail::pov {

namespace {

// An array that an identifier stands for is copied; one that was just made is not.
Value owned(Value value) {
  if (const auto* array = std::get_if<std::shared_ptr<Array>>(&value); array && array->use_count() > 1)
    return std::make_shared<Array>(**array);
  return value;
}

}  // namespace

Symbol* Reader::raw_name(const char* what) {
  const bool expanding = expanding_;
  expanding_ = false;
  const Token token = next();
  expanding_ = expanding;
  if (token.kind != TokenKind::word)
    fail(fmt::format("{} is expected, not {}", what, describe(token)), token.place);
  const bool is_reserved = token.symbol->word > Word::none && token.symbol->free_word == Word::none;
  if (is_reserved && token.symbol->name.size() > 1)
    fail(fmt::format("{} is a reserved word, and cannot be {}", describe(token), what), token.place);
  return token.symbol;
}

void Reader::declare(bool local) {
  Symbol* name = raw_name("the name that is declared");
  if (name->name == "deprecated" && (accept(Word::once_) || peek().kind == TokenKind::text)) {
    text("the message of a deprecated name");
    name = raw_name("the name that is declared");
  }
  const Place place = last_;
  std::shared_ptr<Value> target;
  const std::size_t scope = symbols_.depth();
  if (!name->bindings.empty() && (!local || name->bindings.back().scope == scope))
    target = name->bindings.back().value;
  if (accept('[')) {
    if (name->bindings.empty()) fail(fmt::format("array {} is not declared", name->name), place);
    const auto* const held = std::get_if<std::shared_ptr<Array>>(name->value());
    if (!held) fail(fmt::format("{} is {}, not an array", name->name, kind_of(*name->value())), place);
    std::shared_ptr<Array> array = *held;
    std::vector<std::shared_ptr<Array>> within;  // those that the indices lead through
    for (;;) {
      within.push_back(array);
      std::size_t at = 0;
      put_back_.push_back([&] {
        Token t;
        t.kind = TokenKind::sign;
        t.sign = '[';
        t.place = last_;
        return t;
      }());
      for (std::size_t i = 0; i < array->sizes.size() && accept('['); ++i) {
        const int index = integer("an index");
        expect(']', "behind an index");
        if (index < 0 || static_cast<std::size_t>(index) >= array->sizes[i])
          fail(fmt::format("index {} is not below {}, the array's size", index, array->sizes[i]), place);
        at = at * array->sizes[i] + static_cast<std::size_t>(index);
      }
      if (!this->at('[')) {
        expect('=', "behind the name that is declared");
        Value value = owned(read_value(*this));
        int levels = levels_of(value);
        array->elements.at(at) = std::move(value);
        for (auto around = within.rbegin(); around != within.rend(); ++around)
          levels = (*around)->levels = std::max((*around)->levels, levels + 1);
        if (levels > most_levels) too_many_levels(most_levels);
        break;
      }
      const auto* const inner = std::get_if<std::shared_ptr<Array>>(&array->elements.at(at));
      if (!inner) fail("there are more indices than the array has dimensions", last_);
      const std::shared_ptr<Array> next_array = *inner;
      accept('[');
      array = next_array;
    }
  } else {
    expect('=', "behind the name that is declared");
    Value value = owned(read_value(*this));
    // A file or macro may have ended behind the value: what was local to it is gone then.
    if (!target && (!local || scope <= symbols_.depth())) target = symbols_.variable(name, local ? scope : 0);
    if (target) *target = std::move(value);
  }
  declaring_ = false;
  accept(';');
  declaring_ = true;
}

void Reader::undefine() {
  symbols_.undefine(raw_name("the name of an identifier"));
  declaring_ = false;
  accept(';');
  declaring_ = true;
}

bool Reader::test_defined() {
  expect('(', "before a name");
  const bool is_defined = defined_value() != 0;
  return is_defined;
}

// What is behind "(": the closing bracket is read, too.
double Reader::defined_value() {
  const bool expanding = expanding_;
  expanding_ = false;
  const Token token = next();
  expanding_ = expanding;
  if (token.kind != TokenKind::word) fail("the name of an identifier is expected", token.place);
  const Value* value = token.symbol->value();
  bool is_defined =
      is_variable(token.symbol->word) || (value && !std::holds_alternative<std::monostate>(*value));
  Value held = value ? *value : Value{};
  while (accept('[')) {
    const int index = integer("an index");
    expect(']', "behind an index");
    const auto* const array = std::get_if<std::shared_ptr<Array>>(&held);
    if (!array || index < 0) {
      is_defined = false;
      continue;
    }
    // Of several dimensions the last index counts where all before it are 0: whether one element is there.
    Value element;
    if (static_cast<std::size_t>(index) < (*array)->elements.size())
      element = (*array)->elements[static_cast<std::size_t>(index)];
    is_defined = !std::holds_alternative<std::monostate>(element);
    if (std::holds_alternative<std::shared_ptr<Array>>(element)) held = element;
  }
  expect(')', "behind the name");
  return is_defined ? 1 : 0;
}

void Reader::set_version(const Place& place) {
  const double asked = number("a version");
  declaring_ = false;
  accept(';');
  declaring_ = true;
  if (asked < 1 || asked >= 4.5) fail(fmt::format("version {} is none of POV-Ray's", asked), place);
  version = asked;
  constexpr double first_corrected = 3.5;
  if (!has_noise) *noise = version < first_corrected ? NoiseGenerator::original : NoiseGenerator::corrected;
}

std::string Reader::message_text() {
  if (number_follows() && peek().kind != TokenKind::text) {
    const Value value = evaluate();
    if (const auto* t = std::get_if<std::string>(&value)) return *t;
    return {};
  }
  return text("a message");
}

// ---- Text files. What is written stays in memory, where #include and #read find it.

void Reader::open_text_file(const Token& directive) {
  Symbol* const name = raw_name("the name of a file's identifier");
  auto file = std::make_shared<OpenFile>();
  file->name = text("the name of a file");
  if (accept(Word::write_)) {
    written_files_[file->name].clear();
    file->writes = true;
  } else if (accept(Word::append_)) {
    written_files_[file->name];
    file->writes = true;
  } else if (accept(Word::read_)) {
    if (const auto written = written_files_.find(file->name); written != written_files_.end()) {
      file->content = written->second;
    } else {
      const InputBytes bytes(find_file(file->name, directive.place));
      file->content.assign(bytes.begin(), bytes.end());
    }
  } else {
    unexpected(next(), "read, write or append");
  }
  *symbols_.visible(name) = std::move(file);
}

void Reader::close_text_file() { symbols_.undefine(raw_name("the name of a file's identifier")); }

void Reader::write_text() {
  expect('(', "behind #write");
  Symbol* const name = raw_name("the name of a file's identifier");
  const auto* const held = name->value() ? std::get_if<std::shared_ptr<OpenFile>>(name->value()) : nullptr;
  if (!held || !(*held)->writes)
    fail(fmt::format("{} is no file that #fopen opened to write", name->name), last_);
  const std::shared_ptr<OpenFile> file = *held;
  std::string written;
  while (!accept(')')) {
    comma();
    const Value value = evaluate();
    if (const auto* t = std::get_if<std::string>(&value)) {
      written += *t;
    } else if (const auto* n = std::get_if<Numbers>(&value)) {
      written += text_of(*n);
    } else {
      fail(fmt::format("#write takes texts and numbers, not {}", kind_of(value)), last_);
    }
  }
  written_ += written.size();
  if (written_ > limits_.written_bytes)
    fail(fmt::format("#write writes more than {} bytes; --write-limit raises that", limits_.written_bytes),
         last_);
  written_files_[file->name] += written;
}

void Reader::read_text() {
  expect('(', "behind #read");
  Symbol* const name = raw_name("the name of a file's identifier");
  const auto* const held = name->value() ? std::get_if<std::shared_ptr<OpenFile>>(name->value()) : nullptr;
  if (!held || (*held)->writes)
    fail(fmt::format("{} is no file that #fopen opened to read", name->name), last_);
  const std::shared_ptr<OpenFile> file = *held;
  while (!accept(')')) {
    comma();
    if (accept(')')) break;
    std::shared_ptr<Value> target = symbols_.visible(raw_name("the name of an identifier"));
    if (Value value = file->next(); !std::holds_alternative<std::monostate>(value))
      *target = std::move(value);
  }
  // At its end, the file's identifier goes: scenes loop while it is defined.
  if (file->at_end()) symbols_.undefine(name);
}

void Reader::define(const std::string& name, const std::string& value) {
  double number = 0;
  const char* const end = value.data() + value.size();
  const auto parsed = fast_float::from_chars(value.data(), end, number);
  const bool is_number = parsed.ec == std::errc{} && parsed.ptr == end && std::isfinite(number);
  if (name == name_of(Word::clock_)) {
    if (!is_number) throw UsageError("-D clock takes a number, not '" + value + "'");
    clock = number;
    return;
  }
  const auto fits = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  const bool is_name = !name.empty() && std::isdigit(static_cast<unsigned char>(name[0])) == 0 &&
                       std::ranges::all_of(name, fits);
  Symbol* const symbol = symbols_.find(name);
  if (!is_name || (symbol->word != Word::none && symbol->free_word == Word::none))
    throw UsageError("-D: a POV-Ray scene cannot declare '" + name + "'");
  *symbols_.variable(symbol, 0) = is_number ? Value{Numbers(number)} : Value{value};
}

}  // namespace vitrail::pov
