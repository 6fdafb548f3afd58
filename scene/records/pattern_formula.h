// SPDX-License-Identifier: Apache-2.0
// Formulas are patterns: a program of a stack machine, without jumps.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace vitrail {

// It takes operands from the top of a stack of numbers, and puts one number there. a, b, c … are the
// operands, the topmost last. Truth is 1 or 0. Where a function has no value, it is 0 or not finite; a
// formula that is not finite counts as 0.
struct PatternStep {
  enum class Op : std::uint8_t {
    constant,  // `value`
    pick,      // the number in place `index`, counted from the bottom
    slide,     // drops `index` numbers that lie below the topmost

    negate,  // of one operand, from here on
    invert,  // whether a = 0
    absolute,
    acos,  // of a within −1 … 1; asin likewise
    acosh,
    asin,
    asinh,
    atan,
    atanh,
    ceil,
    cos,
    cosh,
    exp,
    floor,
    ln,
    sign,
    sin,
    sinh,
    square,
    sqrt,  // 0 below 0
    tan,
    tanh,
    trunc,

    add,  // of two operands, from here on
    subtract,
    multiply,
    divide,  // 0 by 0
    less,
    greater,
    less_equal,
    greater_equal,
    equal,
    unequal,
    both,
    either,
    atan2,
    modulo,  // with the sign of a
    power,
    max,
    min,

    choose,     // of four: b where a < 0, c where a = 0, d where a > 0
    noise,      // of four: that of `bozo` at (a,b,c) by the noise generator d
    ridged_mf,  // of nine: a, b, c, H, lacunarity, octaves, offset, gain, noise generator
    hetero_mf,  // of nine: a, b, c, H, lacunarity, octaves, offset, T, noise generator
    pattern,    // of three: what patterns[index] has at (a,b,c)
    fractal,    // of two: what fractals[index] has at (a,b)
  };
  Op op = Op::constant;
  std::uint32_t index = 0;
  double value = 0;
  bool operator==(const PatternStep&) const = default;
};

// The stack holds at the beginning the point, x y z, and the unit normal towards the ray, in the world.
inline constexpr std::size_t formula_inputs = 6;
inline constexpr std::size_t most_formula_operands = 192;  // on the stack
inline constexpr std::size_t most_formula_steps = 4096;

// It is `julia`, `magnet`, and `mandel` with an exponent or colours of its own, of z from p = x + iy on.
struct PatternFractal {
  enum class Kind : std::uint8_t {
    power,    // z ↦ z^exponent + c from z = p; outside where |z| > 2
    magnet1,  // z ↦ ((z² + c − 1)/(2z + c − 2))²; outside where |z| > 100, or |z − 1| < 1/100
    magnet2,  // z ↦ ((z³ + 3(c−1)z + (c−1)(c−2))/(3z² + 3(c−2)z + (c−1)(c−2) + 1))²
  };
  // It gives the number of a point outside, or inside.
  enum class Color : std::uint8_t {
    constant,    // the factor
    steps,       // outside: steps over `iterations`; inside: the least |z|, times the factor
    real,        // of the last z, times the factor
    imaginary,   // these, too
    real2,       // its square, times the factor
    imaginary2,  // likewise
    modulus,     // outside: |z| times the factor; inside: x² + factor·y², as povray has it
  };
  Kind kind = Kind::power;
  bool is_julia = false;          // c = seed, and magnets begin with z = p; else c = p, and with 0
  std::array<double, 2> seed{};   // real, imaginary
  std::uint32_t exponent = 2;     // 2 … 33
  std::uint32_t iterations = 10;  // 1 … 10000
  Color outside = Color::steps, inside = Color::constant;
  double outside_factor = 1, inside_factor = 1;
  bool operator==(const PatternFractal&) const = default;
};

}  // namespace vitrail
