// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/read/symbols.h"

#include <algorithm>

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

Symbols::Symbols() {
  const auto reserve = [&](const char* name, Word word) { find(name)->word = word; };
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
    if (!symbol->bindings.empty() && symbol->bindings.back().scope == scope) symbol->bindings.pop_back();
  scopes_.pop_back();
}

std::shared_ptr<Value> Symbols::variable(Symbol* symbol, std::size_t scope) {
  auto& bindings = symbol->bindings;
  auto at = bindings.begin();
  while (at != bindings.end() && at->scope < scope) ++at;
  if (at == bindings.end() || at->scope != scope) {
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
  if (!symbol->bindings.empty()) symbol->bindings.pop_back();
}

std::vector<std::string> Symbols::defined() const {
  std::vector<std::string> names;
  for (const Symbol& symbol : symbols_)
    if (symbol.word == Word::none && !symbol.bindings.empty()) names.push_back(symbol.name);
  return names;
}

}  // namespace vitrail::pov
