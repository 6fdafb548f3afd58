// SPDX-License-Identifier: Apache-2.0
// These lanes are eight floats as two vectors of four, which every SIMD instruction set has, for kernel.inl.
// The including file puts them into a namespace of its own.

typedef float Quad __attribute__((vector_size(16), may_alias));
typedef std::int32_t QuadBits __attribute__((vector_size(16), may_alias));

struct Floats {
  Quad low, high;
};
struct Lanes {  // all bits of a lane set or none
  QuadBits low, high;
};

inline unsigned bits(QuadBits a) {
#if defined(__SSE__)
  return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(a)));
#else
  const QuadBits chosen = a & QuadBits{1, 2, 4, 8};
  return static_cast<unsigned>(chosen[0] | chosen[1] | chosen[2] | chosen[3]);
#endif
}
inline QuadBits as_bits(Quad a) { return reinterpret_cast<QuadBits>(a); }
inline Quad as_floats(QuadBits a) { return reinterpret_cast<Quad>(a); }
inline QuadBits sign_bits() { return as_bits(Quad{-0.0f, -0.0f, -0.0f, -0.0f}); }

inline Floats load(const float* p) {
  return {*reinterpret_cast<const Quad*>(p), *reinterpret_cast<const Quad*>(p + 4)};
}
inline Floats fill(float x) { return {Quad{x, x, x, x}, Quad{x, x, x, x}}; }
inline void store(float* p, Floats a) {
  *reinterpret_cast<Quad*>(p) = a.low;
  *reinterpret_cast<Quad*>(p + 4) = a.high;
}
inline Floats add(Floats a, Floats b) { return {a.low + b.low, a.high + b.high}; }
inline Floats sub(Floats a, Floats b) { return {a.low - b.low, a.high - b.high}; }
inline Floats mul(Floats a, Floats b) { return {a.low * b.low, a.high * b.high}; }
inline Floats mul_add(Floats a, Floats b, Floats c) { return add(mul(a, b), c); }  // a·b + c
inline Floats sub_mul(Floats c, Floats a, Floats b) { return sub(c, mul(a, b)); }  // c − a·b
inline Floats min(Floats a, Floats b) {
  return {a.low < b.low ? a.low : b.low, a.high < b.high ? a.high : b.high};
}
inline Floats max(Floats a, Floats b) {
  return {a.low > b.low ? a.low : b.low, a.high > b.high ? a.high : b.high};
}
inline Floats abs(Floats a) {
  return {as_floats(as_bits(a.low) & ~sign_bits()), as_floats(as_bits(a.high) & ~sign_bits())};
}
inline Floats flip_by(Floats a, Floats sign) {  // −a where the sign bit is set
  return {as_floats(as_bits(a.low) ^ (as_bits(sign.low) & sign_bits())),
          as_floats(as_bits(a.high) ^ (as_bits(sign.high) & sign_bits()))};
}
inline Lanes less_equal(Floats a, Floats b) { return {a.low <= b.low, a.high <= b.high}; }
inline Lanes both(Lanes a, Lanes b) { return {a.low & b.low, a.high & b.high}; }
inline Lanes either(Lanes a, Lanes b) { return {a.low | b.low, a.high | b.high}; }
inline unsigned bits(Lanes a) { return bits(a.low) | bits(a.high) << 4; }
// Returns row[i] of the lowest set bit i.
inline std::uint32_t first_of(const std::uint32_t* row, unsigned bits) { return row[__builtin_ctz(bits)]; }
// Returns at least 1/a, and hardly more, for a in [1e-30, 1e30].
inline Floats reciprocal_above(Floats a) {
  constexpr float above = 1.000001f;
  return {Quad{above, above, above, above} / a.low, Quad{above, above, above, above} / a.high};
}
inline Quad choose(QuadBits lanes, Quad a, Quad b) {
  return as_floats((as_bits(a) & lanes) | (as_bits(b) & ~lanes));
}
inline Floats choose(Lanes lanes, Floats a, Floats b) {  // a where set
  return {choose(lanes.low, a.low, b.low), choose(lanes.high, a.high, b.high)};
}
inline float least(Floats a) {
  const Quad four = a.low < a.high ? a.low : a.high;
  const float low = four[0] < four[1] ? four[0] : four[1], high = four[2] < four[3] ? four[2] : four[3];
  return low < high ? low : high;
}
// Returns the lanes whose number in the row differs from `number`.
inline Lanes unlike(const std::uint32_t* row, std::uint32_t number) {
  const auto n = static_cast<std::int32_t>(number);
  const QuadBits all = {n, n, n, n};
  const auto* four = reinterpret_cast<const QuadBits*>(row);
  return {four[0] != all, four[1] != all};
}
constexpr int exact_parts = 4;  // of 64 bytes, that a register of doubles is
