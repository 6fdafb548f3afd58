// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/read/symbols.h"

#include <algorithm>
#include <array>

namespace vitrail::pov {

const char* name_of(Word word) {
  constexpr const char* names[] = {
      "",
#define VITRAIL_POV_WORD(name) #name,
#include "importers/povray/read/words.inc"
#undef VITRAIL_POV_WORD
  };
  return names[static_cast<std::size_t>(word)];
}

bool is_variable(Word word) {
  constexpr std::array variables{Word::clock_delta_,   Word::final_clock_,  Word::final_frame_,
                                 Word::frame_number_,  Word::image_width_,  Word::image_height_,
                                 Word::initial_clock_, Word::initial_frame_};
  return std::ranges::find(variables, word) != variables.end();
}

namespace {

// These are no words of POV-Ray 3.7, as `povray` shows that lets a scene declare each.
bool is_unknown(Word word) {
  constexpr std::array unknown{
      Word::normalize_, Word::number_of_sources_, Word::potential_, Word::pragma_, Word::sgn_, Word::tau_,
      Word::trunc_};
  return std::ranges::find(unknown, word) != unknown.end();
}

}  // namespace

Symbols::Symbols() {
  const auto reserve = [&](const char* name, Word word) {
    Symbol* const symbol = find(name);
    symbol->word = word;
    if (is_variable(word) || is_unknown(word)) symbol->free_word = word;
  };
#define VITRAIL_POV_WORD(name) reserve(#name, Word::name##_);
#include "importers/povray/read/words.inc"
#undef VITRAIL_POV_WORD
}

Symbol* Symbols::find(std::string_view name) {
  if (const auto known = by_name_.find(name); known != by_name_.end()) return known->second;
  Symbol& symbol = symbols_.emplace_back();
  symbol.name = name;
  by_name_.emplace(symbol.name, &symbol);
  return &symbol;
}

void Symbols::close_scope() {
  const std::size_t scope = scopes_.size();
  for (Symbol* symbol : scopes_.back())
    if (!symbol->bindings.empty() && symbol->bindings.back().scope == scope) unbind(*symbol);
  scopes_.pop_back();
}

std::shared_ptr<Value> Symbols::variable(Symbol* symbol, std::size_t scope) {
  auto& bindings = symbol->bindings;
  auto at = bindings.begin();
  while (at != bindings.end() && at->scope < scope) ++at;
  if (at == bindings.end() || at->scope != scope) {
    if (symbol->free_word != Word::none) symbol->word = Word::none;
    at = bindings.insert(at, {scope, std::make_shared<Value>()});
    if (scope > 0 && scope <= scopes_.size()) scopes_[scope - 1].push_back(symbol);
  }
  return at->value;
}

std::shared_ptr<Value> Symbols::visible(Symbol* symbol) {
  return symbol->bindings.empty() ? variable(symbol, 0) : symbol->bindings.back().value;
}

void Symbols::alias(Symbol* symbol, std::shared_ptr<Value> value) {
  const std::size_t scope = scopes_.size();
  variable(symbol, scope);
  symbol->bindings.back().value = std::move(value);
}

void Symbols::undefine(Symbol* symbol) {
  if (!symbol->bindings.empty()) unbind(*symbol);
}

void Symbols::unbind(Symbol& symbol) {
  symbol.bindings.pop_back();
  if (symbol.bindings.empty()) symbol.word = symbol.free_word;
}

std::vector<std::string> Symbols::defined() const {
  std::vector<std::string> names;
  for (const Symbol& symbol : symbols_)
    if (symbol.word == Word::none && !symbol.bindings.empty()) names.push_back(symbol.name);
  return names;
}

}  // namespace vitrail::pov
