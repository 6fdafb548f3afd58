// SPDX-License-Identifier: Apache-2.0
// These lanes are W numbers side by side, one a path. They are the vectors of GCC and clang, W in {1, 2, 4,
// 8}; W = 1 is plain numbers. One text serves every W, and every W gives the bits that the scalar function
// gives.
//
// Functions take their width from their arguments. All is in an unnamed namespace, so that what one file
// compiles for its instruction set is never linked into another; README.md has more.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>

#if defined(__SSE2__)
#if !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"  // GCC 12 warns of registers in its own header
#endif
#include <immintrin.h>
#if !defined(__clang__)
#pragma GCC diagnostic pop
#endif
#endif

#define VITRAIL_LANES [[gnu::always_inline]] inline

namespace vitrail::lanes {
namespace {

// It has W numbers of T. Its alignment is its size.
template <class T, int W>
struct VectorOf {
  typedef T type __attribute__((vector_size(sizeof(T) * W)));
};
template <class T>
struct VectorOf<T, 1> {
  using type = T;
};
template <class T, int W>
using Lanes = typename VectorOf<T, W>::type;

template <int W>
using Doubles = Lanes<double, W>;
template <int W>
using Floats = Lanes<float, W>;
template <int W>
using Ints = Lanes<std::int32_t, W>;
template <int W>
using Words = Lanes<std::uint32_t, W>;
template <int W>
using Longs = Lanes<std::uint64_t, W>;

template <class V>
struct LanesOf {};  // of other types
template <class V>
requires(!std::is_arithmetic_v<V> && !std::is_class_v<V> && !std::is_pointer_v<V>) struct LanesOf<V> {
  using Number = std::remove_cvref_t<decltype(std::declval<V&>()[0])>;
  static constexpr int width = sizeof(V) / sizeof(Number);
};
template <class V>
requires std::is_arithmetic_v<V>
struct LanesOf<V> {
  using Number = V;
  static constexpr int width = 1;
};
template <class V>
using Number = typename LanesOf<V>::Number;
template <class V>
inline constexpr int width = LanesOf<V>::width;

// It has as many numbers of T as V has.
template <class T, class V>
using Like = Lanes<T, LanesOf<V>::width>;
template <class V>
using FloatsLike = Like<float, V>;
template <class V>
using DoublesLike = Like<double, V>;
template <class V>
using IntsLike = Like<std::int32_t, V>;
template <class V>
using WordsLike = Like<std::uint32_t, V>;
template <class V>
using LongsLike = Like<std::uint64_t, V>;

// Comparing gives a Mask: integers of the numbers' size, all bits of a lane set or none; for plain numbers
// bool. Masks are combined by & | and `no`. Those of doubles and of floats differ: `mask_for`.
template <class V>
using Mask = decltype(std::declval<V>() < std::declval<V>());

template <class V>
VITRAIL_LANES V fill(Number<V> x) {
  if constexpr (width<V> == 1)
    return x;
  else
    return x - V{};  // not x + V{}, which makes −0 a 0
}

template <class V>
VITRAIL_LANES Number<V> lane(const V& v, int j) {
  if constexpr (width<V> == 1)
    return v;
  else
    return v[j];
}
template <class M>
VITRAIL_LANES bool is_set(const M& mask, int j) {
  return lane(mask, j) != 0;
}

namespace detail {

template <class V, class Get, int... J>
VITRAIL_LANES V gathered(const Get& get, std::integer_sequence<int, J...>) {
  return V{static_cast<Number<V>>(get(J))...};
}

template <class V>
struct Halves {
  Lanes<Number<V>, width<V> / 2> low, high;
};

}  // namespace detail

// Returns get(j) in each lane j.
template <class V, class Get>
VITRAIL_LANES V gather(const Get& get) {
  return detail::gathered<V>(get, std::make_integer_sequence<int, width<V>>{});
}
// Returns table[index] in each lane.
template <class I, class T>
VITRAIL_LANES Like<T, I> at(const T* table, I index) {
  return gather<Like<T, I>>([&](int j) __attribute__((always_inline)) { return table[lane(index, j)]; });
}
// They change one lane; in a mask, whether it is set.
template <class V>
VITRAIL_LANES void set_lane(V& v, int j, std::type_identity_t<Number<V>> x) {
  if constexpr (width<V> == 1)
    v = x;
  else
    v[j] = x;
}
template <class M>
VITRAIL_LANES void set_mask(M& mask, int j, bool set) {
  if constexpr (width<M> == 1)
    mask = set;
  else
    mask[j] = set ? -1 : 0;
}
// Returns the mask of the lanes j for which set(j).
template <class V, class Get>
VITRAIL_LANES Mask<V> gather_mask(const Get& get) {
  if constexpr (width<V> == 1)
    return get(0);
  else
    return gather<Mask<V>>([&](int j) __attribute__((always_inline)) { return get(j) ? -1 : 0; });
}

template <class V>
VITRAIL_LANES V select(std::type_identity_t<Mask<V>> mask, V a, std::type_identity_t<V> b) {
  return mask ? a : b;
}
template <class M>
VITRAIL_LANES M no(M mask) {
  return mask == 0;
}

// Returns one bit a lane, the lowest that of lane 0.
template <class M>
VITRAIL_LANES unsigned bits(M mask) {
  if constexpr (width<M> == 1) {
    return mask != 0;
#if defined(__AVX512DQ__) && defined(__AVX512VL__)
  } else if constexpr (sizeof(M) == 64 && width<M> == 8) {
    return _mm512_movepi64_mask(reinterpret_cast<__m512i>(mask));
#endif
#if defined(__AVX2__)
  } else if constexpr (sizeof(M) == 32 && width<M> == 4) {
    return static_cast<unsigned>(_mm256_movemask_pd(reinterpret_cast<__m256d>(mask)));
  } else if constexpr (sizeof(M) == 32 && width<M> == 8) {
    return static_cast<unsigned>(_mm256_movemask_ps(reinterpret_cast<__m256>(mask)));
#endif
#if defined(__SSE2__)
  } else if constexpr (sizeof(M) == 16 && width<M> == 2) {
    return static_cast<unsigned>(_mm_movemask_pd(reinterpret_cast<__m128d>(mask)));
  } else if constexpr (sizeof(M) == 16 && width<M> == 4) {
    return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(mask)));
#endif
  } else if constexpr (width<M> == 2) {
    return is_set(mask, 0) | is_set(mask, 1) << 1;
  } else {
    const auto half = std::bit_cast<detail::Halves<M>>(mask);
    return bits(half.low) | bits(half.high) << (width<M> / 2);
  }
}
template <class M>
VITRAIL_LANES bool any(M mask) {
  return bits(mask) != 0;
}
template <class M>
VITRAIL_LANES bool all(M mask) {
  return bits(mask) == (1u << width<M>)-1;
}

// Converts numbers between types. Floating-point numbers are rounded towards 0; a number that T cannot hold
// gives any value, but no trap.
template <class T, class V>
VITRAIL_LANES Like<T, V> convert(V v) {
  using To = Like<T, V>;
  if constexpr (std::is_same_v<To, V>) {
    return v;
  } else if constexpr (width<V> == 1) {
    return static_cast<T>(v);
#if defined(__AVX512F__)
  } else if constexpr (sizeof(To) == 64 && std::is_same_v<T, double> && std::is_same_v<Number<V>, float>) {
    return reinterpret_cast<To>(_mm512_cvtps_pd(reinterpret_cast<__m256>(v)));
  } else if constexpr (sizeof(To) == 64 && std::is_same_v<T, double> &&
                       std::is_same_v<Number<V>, std::int32_t>) {
    return reinterpret_cast<To>(_mm512_cvtepi32_pd(reinterpret_cast<__m256i>(v)));
#endif
#if defined(__AVX2__)
  } else if constexpr (sizeof(To) == 32 && std::is_same_v<T, double> && std::is_same_v<Number<V>, float>) {
    return reinterpret_cast<To>(_mm256_cvtps_pd(reinterpret_cast<__m128>(v)));
  } else if constexpr (sizeof(To) == 32 && std::is_same_v<T, double> &&
                       std::is_same_v<Number<V>, std::int32_t>) {
    return reinterpret_cast<To>(_mm256_cvtepi32_pd(reinterpret_cast<__m128i>(v)));
#endif
  } else {
    return __builtin_convertvector(v, To);
  }
}
template <class V>
VITRAIL_LANES DoublesLike<V> to_doubles(V v) {
  return convert<double>(v);
}
template <class V>
VITRAIL_LANES FloatsLike<V> to_floats(V v) {
  return convert<float>(v);
}
// Returns a mask of doubles or floats for as many numbers of another type.
template <class V, class M>
VITRAIL_LANES Mask<V> mask_for(M mask) {
  if constexpr (width<V> == 1)
    return mask;
  else
    return __builtin_convertvector(mask, Mask<V>);
}

// Returns the same bits as another type.
template <class T, class V>
VITRAIL_LANES Like<T, V> cast_bits(V v) {
  return std::bit_cast<Like<T, V>>(v);
}

// It is IEEE's, correctly rounded.
template <class V>
VITRAIL_LANES V sqrt(V x) {
  if constexpr (width<V> == 1) {
    return std::sqrt(x);
#if defined(__AVX512F__)
  } else if constexpr (sizeof(V) == 64 && width<V> == 8) {
    return reinterpret_cast<V>(_mm512_sqrt_pd(reinterpret_cast<__m512d>(x)));
  } else if constexpr (sizeof(V) == 64 && width<V> == 16) {
    return reinterpret_cast<V>(_mm512_sqrt_ps(reinterpret_cast<__m512>(x)));
#endif
#if defined(__AVX2__)
  } else if constexpr (sizeof(V) == 32 && width<V> == 4) {
    return reinterpret_cast<V>(_mm256_sqrt_pd(reinterpret_cast<__m256d>(x)));
  } else if constexpr (sizeof(V) == 32 && width<V> == 8) {
    return reinterpret_cast<V>(_mm256_sqrt_ps(reinterpret_cast<__m256>(x)));
#endif
#if defined(__SSE2__)
  } else if constexpr (sizeof(V) == 16 && width<V> == 2) {
    return reinterpret_cast<V>(_mm_sqrt_pd(reinterpret_cast<__m128d>(x)));
  } else if constexpr (sizeof(V) == 16 && width<V> == 4) {
    return reinterpret_cast<V>(_mm_sqrt_ps(reinterpret_cast<__m128>(x)));
#endif
  } else if constexpr (width<V> == 2) {
    return V{std::sqrt(x[0]), std::sqrt(x[1])};
  } else {
    auto half = std::bit_cast<detail::Halves<V>>(x);
    half.low = lanes::sqrt(half.low);
    half.high = lanes::sqrt(half.high);
    return std::bit_cast<V>(half);
  }
}

template <class V>
VITRAIL_LANES V abs(V x) {
  if constexpr (width<V> == 1) {
    return std::abs(x);
  } else if constexpr (sizeof(Number<V>) == 8) {
    return cast_bits<double>(cast_bits<std::uint64_t>(x) & ~(std::uint64_t{1} << 63));
  } else {
    return cast_bits<float>(cast_bits<std::uint32_t>(x) & 0x7fffffffu);
  }
}

// They take their arguments in the order of std::min and std::max: the result is `a` where one is NaN or both
// are equal.
template <class V>
VITRAIL_LANES V min(V a, std::type_identity_t<V> b) {
  return select<V>(b < a, b, a);
}
template <class V>
VITRAIL_LANES V max(V a, std::type_identity_t<V> b) {
  return select<V>(a < b, b, a);
}
template <class V>
VITRAIL_LANES V clamp(V x, Number<V> low, Number<V> high) {
  return select<V>(x < low, fill<V>(low), select<V>(high < x, fill<V>(high), x));
}

// It is safe_sqrt, which is 0 where x is not above 0.
template <class D>
VITRAIL_LANES D safe_sqrt(D x) {
  return lanes::sqrt(select<D>(x > 0, x, fill<D>(0)));
}
// x is ≥ 0 and not above 2³⁰.
template <class D>
VITRAIL_LANES D ceil_of_few(D x) {
  const D below = to_doubles(convert<std::int32_t>(x));
  return below + select<D>(below < x, fill<D>(1), fill<D>(0));
}
// Returns ±1 with the sign of x, for zeros too.
template <class D>
VITRAIL_LANES D sign_of(D x) {
  constexpr std::uint64_t one = std::bit_cast<std::uint64_t>(1.0);
  return cast_bits<double>((cast_bits<std::uint64_t>(x) & (std::uint64_t{1} << 63)) | one);
}

}  // namespace
}  // namespace vitrail::lanes
