// SPDX-License-Identifier: Apache-2.0
// Symbols are the names of a scene: reserved words, and identifiers with what they stand for at the moment.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "importers/povray/read/value.h"

namespace vitrail::pov {

// It is a reserved word; `none` is an identifier's. The enumerators end in _, as many are words of C++.
enum class Word : std::uint16_t {
  none,
#define VITRAIL_POV_WORD(name) name##_,
#include "importers/povray/read/words.inc"
#undef VITRAIL_POV_WORD
};

// Returns the word as scenes write it.
const char* name_of(Word word);

// Returns whether POV-Ray has the word for a variable of its own, which a scene may declare anew.
bool is_variable(Word word);

// Identifiers are looked up in the innermost scope that has them.
struct Symbol {
  struct Binding {
    std::size_t scope = 0;  // 0: global
    std::shared_ptr<Value> value;
  };
  std::string name;
  Word word = Word::none;
  Word free_word = Word::none;    // what it is again once the scene's own binding is gone
  std::vector<Binding> bindings;  // the innermost last

  Value* value() const { return bindings.empty() ? nullptr : bindings.back().value.get(); }
};

class Symbols {
 public:
  Symbols();
  Symbol* find(std::string_view name);  // made where it is new

  // Macros and included files have scopes.
  void open_scope() { scopes_.emplace_back(); }
  void close_scope();
  std::size_t depth() const { return scopes_.size(); }

  // Returns the variable of that scope, which it makes where there is none. The name is no word from then on.
  std::shared_ptr<Value> variable(Symbol* symbol, std::size_t scope);
  // Returns the variable that the name stands for; it makes a global one where there is none.
  std::shared_ptr<Value> visible(Symbol* symbol);
  // Lets the name stand for another's variable in the innermost scope.
  void alias(Symbol* symbol, std::shared_ptr<Value> value);
  // Removes the innermost variable of the name.
  void undefine(Symbol* symbol);

  // Returns the names of identifiers that stand for something.
  std::vector<std::string> defined() const;

 private:
  static void unbind(Symbol& symbol);

  std::deque<Symbol> symbols_;
  std::unordered_map<std::string_view, Symbol*> by_name_;
  std::vector<std::vector<Symbol*>> scopes_;  // what each has bound; without the global one
};

}  // namespace vitrail::pov
