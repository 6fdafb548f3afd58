// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/read/function.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "importers/povray/read/levels.h"
#include "importers/povray/read/number_words.h"
#include "importers/povray/read/pattern_field.h"
#include "importers/povray/read/reader.h"
#include "importers/povray/read/spline.h"
#include "importers/povray/read/surface.h"

namespace vitrail::pov {

namespace {

using Op = Instruction::Op;

class Compiler {
 public:
  Compiler(Reader& reader, Function& function) : reader_(reader), function_(function) {}

  void expression() {
    conjunction();
    while (reader_.accept('|')) conjunction(), emit(Op::either, -1);
  }

 private:
  void emit(Op op, int growth) {
    Instruction i;
    i.op = op;
    emit(i, growth);
  }
  void emit(const Instruction& i, int growth) {
    function_.code.push_back(i);
    operands_ = static_cast<std::size_t>(static_cast<int>(operands_) + growth);
    function_.depth = std::max(function_.depth, operands_);
    if (operands_ > Function::most_operands) reader_.fail("a function is too deep", reader_.here());
  }
  void constant(double value) {
    Instruction i;
    i.value = value;
    emit(i, 1);
  }

  void conjunction() {
    relation();
    while (reader_.accept('&')) relation(), emit(Op::both, -1);
  }
  void relation() {
    sum();
    for (;;) {
      const Token token = reader_.peek();
      Op op;
      if (token.is('<'))
        op = Op::less;
      else if (token.is('>'))
        op = Op::greater;
      else if (token.is('l'))
        op = Op::less_equal;
      else if (token.is('g'))
        op = Op::greater_equal;
      else if (token.is('='))
        op = Op::equal;
      else if (token.is('n'))
        op = Op::unequal;
      else
        return;
      reader_.next();
      sum();
      emit(op, -1);
    }
  }
  void sum() {
    product();
    for (;;) {
      if (reader_.accept('+'))
        product(), emit(Op::add, -1);
      else if (reader_.accept('-'))
        product(), emit(Op::subtract, -1);
      else
        return;
    }
  }
  void product() {
    unary();
    for (;;) {
      if (reader_.accept('*'))
        unary(), emit(Op::multiply, -1);
      else if (reader_.accept('/'))
        unary(), emit(Op::divide, -1);
      else
        return;
    }
  }
  void unary() {
    if (reader_.accept('-'))
      unary(), emit(Op::negate, 0);
    else if (reader_.accept('!'))
      unary(), emit(Op::invert, 0);
    else if (reader_.accept('+'))
      unary();
    else
      operand();
  }

  bool parameter(const Token& token) {
    const auto& names = function_.parameters;
    const auto found = std::find(names.begin(), names.end(), token.symbol);
    Instruction i;
    i.op = Op::argument;
    const Word word = token.symbol->word;
    if (found != names.end()) {
      i.index = static_cast<std::uint32_t>(found - names.begin());
    } else if (function_.unnamed && (word == Word::u_ || word == Word::v_)) {  // of a parametric
      i.index = word == Word::u_ ? 0 : 1;
    } else {
      return false;
    }
    emit(i, 1);
    return true;
  }

  std::size_t arguments() {
    reader_.expect('(', "behind the name of a function");
    std::size_t count = 0;
    for (; !reader_.accept(')'); ++count) {
      if (count) reader_.comma();
      expression();
    }
    return count;
  }

  void call(const Shared<Function>& callee, const Token& name) {
    const std::size_t count = arguments();
    if (callee->unknown) {
      reader_.notes.approximated("a formula of functions.inc that is not known: 0",
                                 reader_.location(name.place));
      Instruction drop;
      drop.op = Op::two, drop.two = [](double a, double) { return a; };
      for (std::size_t i = 1; i < count; ++i) emit(drop, -1);
      drop.op = Op::one, drop.one = [](double) { return 0.0; };
      return emit(drop, 0);
    }
    const std::size_t wanted = callee->arguments();
    if (count != wanted)
      reader_.fail(fmt::format("function {} takes {} arguments, not {}", name.symbol->name, wanted, count),
                   name.place);
    Instruction i;
    i.op = callee->gives_vector() ? Op::part : Op::call;
    if (callee->gives_vector()) i.component = component_name();
    i.index = static_cast<std::uint32_t>(function_.callees.size());
    function_.callees.push_back(callee);
    emit(i, 1 - static_cast<int>(count));
  }

  // ".red", ".x" … behind a call.
  std::uint8_t component_name() {
    reader_.expect('.', "behind a function that gives a vector");
    const Token name = reader_.next();
    if (name.kind == TokenKind::word) {
      if (name.symbol->name == "hf") return height_component;
      switch (name.symbol->word) {
        case Word::x_:
        case Word::u_:
        case Word::red_:
          return 0;
        case Word::y_:
        case Word::v_:
        case Word::green_:
          return 1;
        case Word::z_:
        case Word::blue_:
          return 2;
        case Word::t_:
        case Word::filter_:
          return 3;
        case Word::transmit_:
          return 4;
        case Word::gray_:
          return grey_component;
        default:
          break;
      }
    }
    reader_.unexpected(name, "a component of a vector or colour");
  }

  void operand() {
    const Reader::Deeper deeper(reader_, reader_.here());
    const Token token = reader_.next();
    if (token.kind == TokenKind::number) return constant(token.number);
    if (token.is('(')) {
      expression();
      reader_.expect(')', "behind an expression in brackets");
      return;
    }
    if (token.kind != TokenKind::word) reader_.unexpected(token, "a number");
    if (parameter(token)) return;
    const Word word = token.symbol->word;
    if (word == Word::none) {
      if (const Value* value = token.symbol->value())
        if (const auto* callee = std::get_if<Shared<Function>>(value)) return call(*callee, token);
    } else if (const NumberFunction* known = number_function(word)) {
      return number_function_of(*known, token);
    } else if (word == Word::select_) {
      const std::size_t count = arguments();
      if (count != 3 && count != 4) reader_.fail("select() takes three or four arguments", token.place);
      Instruction i;
      i.op = Op::choose;
      i.index = static_cast<std::uint32_t>(count);
      return emit(i, 1 - static_cast<int>(count));
    } else if (word == Word::internal_) {
      reader_.expect('(', "behind internal");
      const int number = reader_.integer("the number of a function");
      reader_.expect(')', "behind the number of a function");
      Shared<Function> formula = internal_function(number);
      if (!formula) {
        auto unknown = std::make_shared<Function>();
        unknown->unknown = true;
        formula = unknown;
      }
      return call(formula, token);
    }
    reader_.put_back(token);
    constant(reader_.operand());
  }

  void number_function_of(const NumberFunction& known, const Token& token) {
    reader_.expect('(', "behind the name of a function");
    expression();
    Instruction i;
    if (known.one) {
      i.op = Op::one, i.one = known.one, i.index = static_cast<std::uint32_t>(known.word);
      emit(i, 0);
    } else {
      std::size_t count = 1;
      while (reader_.accept(',')) {
        if (++count > 2 && !known.folds)
          reader_.fail(fmt::format("{}() takes two arguments", token.symbol->name), token.place);
        expression();
        i.op = Op::two, i.two = known.two, i.index = static_cast<std::uint32_t>(known.word);
        emit(i, -1);
      }
      if (count < 2) reader_.fail(fmt::format("{}() takes two arguments", token.symbol->name), token.place);
    }
    reader_.expect(')', "behind the arguments of a function");
  }

  Reader& reader_;
  Function& function_;
  std::size_t operands_ = 0;
};

std::shared_ptr<Function> read_braces(Reader& reader) {
  auto function = std::make_shared<Function>();
  if (reader.accept('(')) {
    while (!reader.accept(')')) {
      const Token name = reader.next();
      if (name.kind != TokenKind::word) reader.unexpected(name, "the name of a parameter");
      function->parameters.push_back(name.symbol);
      reader.comma();
    }
  } else {
    for (const char* name : {"x", "y", "z"}) function->parameters.push_back(reader.symbols().find(name));
    function->unnamed = true;
  }
  reader.expect('{', "behind function");
  const Token first = reader.next();
  if (first.is(Word::pigment_)) {
    function->source = read_pigment_block(reader);
    function->pigment = std::make_shared<PatternField>(reader, *function->source);
  } else if (first.is(Word::pattern_)) {
    function->source = read_pattern_block(reader);
    function->pattern = std::make_shared<PatternField>(reader, *function->source);
  } else if (first.is(Word::transform_)) {
    function->placement = std::make_shared<Placement>(Placement{read_transform_block(reader)});
  } else if (first.is(Word::spline_)) {
    reader.put_back(first);
    function->spline = std::get<std::shared_ptr<Spline>>(read_value(reader));
  } else if (first.is(Word::internal_)) {
    reader.expect('(', "behind internal");
    const int number = reader.integer("the number of a function");
    reader.expect(')', "behind the number of a function");
    const Shared<Function> formula = internal_function(number);
    if (formula) {
      *function = *formula;
    } else {
      function->unknown = true;
    }
  } else {
    reader.put_back(first);
    Compiler(reader, *function).expression();
  }
  reader.expect('}', "at the end of a function");
  return function;
}

// Of a function and of those that it calls, each once.
void say_notes(Reader& reader, const Function& function, const SourceLocation& place,
               std::set<const Function*>& said) {
  if (!function.notable || !said.insert(&function).second) return;
  for (const Diagnostic& note : function.notes) reader.notes.add(note);
  for (const auto& callee : function.callees) say_notes(reader, *callee, place, said);
}

void say_notes(Reader& reader, const Function& function, const SourceLocation& place) {
  if (!function.notable) return;
  std::set<const Function*> said;
  say_notes(reader, function, place, said);
}

}  // namespace

Shared<Function> declare_function(Reader& reader) {
  Notes others = std::exchange(reader.notes, {});
  const std::shared_ptr<Function> function = read_braces(reader);
  settle(reader, *function);
  function->notes = std::exchange(reader.notes, std::move(others)).take();
  function->notable |= !function->notes.empty() ||
                       std::ranges::any_of(function->callees, [](const auto& f) { return f->notable; });
  return function;
}

Shared<Function> read_function(Reader& reader) {
  const SourceLocation place = reader.location(reader.peek().place);
  Shared<Function> function = declare_function(reader);
  say_notes(reader, *function, place);
  reader.function_levels = std::max(reader.function_levels, function->levels);
  return function;
}

Value call_function(Reader& reader, const Function& function, const std::vector<double>& arguments,
                    const Token& name) {
  const std::size_t wanted = function.arguments();
  if (function.unknown) {
    reader.notes.approximated("a formula of functions.inc that is not known: 0", reader.location(name.place));
    return Numbers(0.0);
  }
  if (arguments.size() != wanted)
    reader.fail(
        fmt::format("function {} takes {} arguments, not {}", name.symbol->name, wanted, arguments.size()),
        name.place);
  say_notes(reader, function, reader.location(name.place));
  if (function.gives_vector()) return evaluate_vector(function, arguments.data());
  return Numbers(evaluate(function, arguments.data()));
}

}  // namespace vitrail::pov
