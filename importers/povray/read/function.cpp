// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/read/function.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "importers/povray/read/number_words.h"
#include "importers/povray/read/reader.h"
#include "importers/povray/read/surface.h"

namespace vitrail::pov {

namespace {

using Op = Instruction::Op;

constexpr std::size_t most_operands = 64;

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
    if (operands_ > most_operands) reader_.fail("a function is too deep", reader_.here());
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
    const std::size_t wanted = callee->built_in ? callee->count : callee->parameters.size();
    if (callee->pigment || callee->placement)
      reader_.fail("functions of pigments and transformations in other functions are not read", name.place);
    if (count != wanted)
      reader_.fail(fmt::format("function {} takes {} arguments, not {}", name.symbol->name, wanted, count),
                   name.place);
    Instruction i;
    i.op = Op::call;
    i.index = static_cast<std::uint32_t>(function_.callees.size());
    function_.callees.push_back(callee);
    emit(i, 1 - static_cast<int>(count));
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
      i.op = Op::one, i.one = known.one;
      emit(i, 0);
    } else {
      std::size_t count = 1;
      while (reader_.accept(',')) {
        if (++count > 2 && !known.folds)
          reader_.fail(fmt::format("{}() takes two arguments", token.symbol->name), token.place);
        expression();
        i.op = Op::two, i.two = known.two;
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

}  // namespace

double evaluate(const Function& f, const double* arguments) {
  if (f.built_in) return f.built_in(arguments);
  std::array<double, most_operands + 2> stack;
  std::size_t top = 0;  // operands
  constexpr double tolerance = 1e-10;
  for (const Instruction& i : f.code) {
    double* const a = stack.data() + (top >= 2 ? top - 2 : 0);  // of two operands
    const double b = top > 0 ? stack[top - 1] : 0;
    switch (i.op) {
      case Op::constant:
        stack[top++] = i.value;
        continue;
      case Op::argument:
        stack[top++] = arguments[i.index];
        continue;
      case Op::one:
        stack[top - 1] = i.one(b);
        continue;
      case Op::negate:
        stack[top - 1] = -b;
        continue;
      case Op::invert:
        stack[top - 1] = b == 0;
        continue;
      case Op::choose: {
        const double* const s = stack.data() + (top - i.index);
        const double chosen = s[0] < 0 ? s[1] : s[0] == 0 || i.index == 3 ? s[2] : s[3];
        top -= i.index - 1;
        stack[top - 1] = chosen;
        continue;
      }
      case Op::call: {
        const Function& callee = *f.callees[i.index];
        const std::size_t count = callee.built_in ? callee.count : callee.parameters.size();
        const double result = evaluate(callee, stack.data() + (top - count));
        top -= count;
        stack[top++] = result;
        continue;
      }
      case Op::two:
        *a = i.two(*a, b);
        break;
      case Op::add:
        *a += b;
        break;
      case Op::subtract:
        *a -= b;
        break;
      case Op::multiply:
        *a *= b;
        break;
      case Op::divide:
        *a = b == 0 ? 0 : *a / b;
        break;
      case Op::less:
        *a = *a < b;
        break;
      case Op::greater:
        *a = *a > b;
        break;
      case Op::less_equal:
        *a = *a <= b + tolerance;
        break;
      case Op::greater_equal:
        *a = *a >= b - tolerance;
        break;
      case Op::equal:
        *a = std::abs(*a - b) < tolerance;
        break;
      case Op::unequal:
        *a = std::abs(*a - b) >= tolerance;
        break;
      case Op::both:
        *a = *a != 0 && b != 0;
        break;
      case Op::either:
        *a = *a != 0 || b != 0;
        break;
    }
    --top;
  }
  return stack[0];
}

Shared<Function> read_function(Reader& reader) {
  auto function = std::make_shared<Function>();
  const Place place = reader.here();
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
    function->pigment = read_pigment_block(reader);
  } else if (first.is(Word::pattern_)) {
    function->pigment = read_pattern_block(reader);
  } else if (first.is(Word::transform_)) {
    function->placement = std::make_shared<Placement>(Placement{read_transform_block(reader)});
  } else if (first.is(Word::spline_)) {
    reader.fail("functions of splines are not read", place);
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

Value call_function(Reader& reader, const Function& function, const std::vector<double>& arguments,
                    const Token& name) {
  const auto first = [&](std::size_t i) { return i < arguments.size() ? arguments[i] : 0; };
  if (function.pigment) return mean_color(*function.pigment);
  if (function.placement) {
    const Point3d moved = transform_point(function.placement->transform, {first(0), first(1), first(2)});
    return Numbers::vector(moved.x, moved.y, moved.z);
  }
  const std::size_t wanted = function.built_in ? function.count : function.parameters.size();
  if (function.unknown) {
    reader.notes.approximated("a formula of functions.inc that is not known: 0", reader.location(name.place));
    return Numbers(0.0);
  }
  if (arguments.size() != wanted)
    reader.fail(
        fmt::format("function {} takes {} arguments, not {}", name.symbol->name, wanted, arguments.size()),
        name.place);
  return Numbers(evaluate(function, arguments.data()));
}

}  // namespace vitrail::pov
