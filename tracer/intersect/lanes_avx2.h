// SPDX-License-Identifier: Apache-2.0
// These lanes are eight floats in one AVX register, for kernel.inl. The including file puts them into a
// namespace of its own.

using Floats = __m256;
using Lanes = __m256;  // all bits of a lane set or none

inline Floats load(const float* p) { return _mm256_load_ps(p); }
inline Floats fill(float x) { return _mm256_set1_ps(x); }
inline void store(float* p, Floats a) { _mm256_store_ps(p, a); }
inline Floats add(Floats a, Floats b) { return _mm256_add_ps(a, b); }
inline Floats sub(Floats a, Floats b) { return _mm256_sub_ps(a, b); }
inline Floats mul(Floats a, Floats b) { return _mm256_mul_ps(a, b); }
inline Floats mul_add(Floats a, Floats b, Floats c) { return _mm256_fmadd_ps(a, b, c); }   // a·b + c
inline Floats sub_mul(Floats c, Floats a, Floats b) { return _mm256_fnmadd_ps(a, b, c); }  // c − a·b
inline Floats min(Floats a, Floats b) { return _mm256_min_ps(a, b); }
inline Floats max(Floats a, Floats b) { return _mm256_max_ps(a, b); }
inline Floats abs(Floats a) { return _mm256_andnot_ps(_mm256_set1_ps(-0.0f), a); }
inline Floats flip_by(Floats a, Floats sign) {  // −a where the sign bit is set
  return _mm256_xor_ps(a, _mm256_and_ps(_mm256_set1_ps(-0.0f), sign));
}
inline Lanes less_equal(Floats a, Floats b) { return _mm256_cmp_ps(a, b, _CMP_LE_OQ); }
inline Lanes both(Lanes a, Lanes b) { return _mm256_and_ps(a, b); }
inline Lanes either(Lanes a, Lanes b) { return _mm256_or_ps(a, b); }
inline unsigned bits(Lanes a) { return static_cast<unsigned>(_mm256_movemask_ps(a)); }
// Returns row[i] of the lowest set bit i.
inline std::uint32_t first_of(const std::uint32_t* row, unsigned bits) { return row[__builtin_ctz(bits)]; }
// Returns at least 1/a, and hardly more, for a in [1e-30, 1e30].
inline Floats reciprocal_above(Floats a) { return mul(_mm256_rcp_ps(a), fill(1.0005f)); }
inline Floats choose(Lanes lanes, Floats a, Floats b) {
  return _mm256_blendv_ps(b, a, lanes);
}  // a where set
inline float least(Floats a) {
  const __m128 four = _mm_min_ps(_mm256_castps256_ps128(a), _mm256_extractf128_ps(a, 1));
  const __m128 two = _mm_min_ps(four, _mm_movehl_ps(four, four));
  return _mm_cvtss_f32(_mm_min_ss(two, _mm_movehdup_ps(two)));
}
// Returns the lanes whose number in the row differs from `number`.
inline Lanes unlike(const std::uint32_t* row, std::uint32_t number) {
  const __m256i all = _mm256_load_si256(reinterpret_cast<const __m256i*>(row));
  const __m256i same = _mm256_cmpeq_epi32(all, _mm256_set1_epi32(static_cast<int>(number)));
  return _mm256_castsi256_ps(_mm256_xor_si256(same, _mm256_set1_epi32(-1)));
}
constexpr int exact_parts = 2;  // of 64 bytes, that a register of doubles is
