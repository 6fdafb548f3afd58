// SPDX-License-Identifier: Apache-2.0
// How a function in lanes becomes a LaneFunction.
#pragma once

#include "tests/tracer/lanes/lane_functions.h"
#include "tracer/lanes/sampling.h"
#include "tracer/simd/vectors.h"

namespace vitrail::lane_tests {
namespace {

// The arguments of W cases.
template <int W>
struct In {
  const double* numbers;
  int stride;
  template <class T>
  VITRAIL_LANES lanes::Lanes<T, W> get(int k) const {
    return lanes::gather<lanes::Lanes<T, W>>([&](int j) __attribute__((always_inline)) {
      return static_cast<T>(numbers[j * stride + k]);
    });
  }
  VITRAIL_LANES lanes::Doubles<W> d(int k) const { return get<double>(k); }
  VITRAIL_LANES lanes::Floats<W> f(int k) const { return get<float>(k); }
  VITRAIL_LANES lanes::Words<W> u(int k) const { return get<std::uint32_t>(k); }
  VITRAIL_LANES lanes::Longs<W> l(int k) const {  // two words, the lower first
    return get<std::uint64_t>(k) | get<std::uint64_t>(k + 1) << 32;
  }
  VITRAIL_LANES lanes::Vector<lanes::Doubles<W>> vector(int k) const { return {d(k), d(k + 1), d(k + 2)}; }
};

// And their results, in order.
template <int W>
struct Out {
  double* numbers;
  int stride, next = 0;
  template <class V>
  VITRAIL_LANES void number(V v) {
    for (int j = 0; j < W; ++j) numbers[j * stride + next] = static_cast<double>(lanes::lane(v, j));
    ++next;
  }
  VITRAIL_LANES void word64(lanes::Longs<W> v) {
    number(v & std::uint64_t{0xffffffff});
    number(v >> 32);
  }
  template <class M>
  VITRAIL_LANES void mask(M m) {
    for (int j = 0; j < W; ++j) numbers[j * stride + next] = lanes::is_set(m, j) ? 1 : 0;
    ++next;
  }
  template <class D>
  VITRAIL_LANES void vector(lanes::Vector<D> v) {
    number(v.x), number(v.y), number(v.z);
  }
  template <class F>
  VITRAIL_LANES void four(lanes::Four<F> v) {
    for (int i = 0; i < 4; ++i) number(v[i]);
  }
};

// F: `ins`, `outs` and run<W>(context, In<W>, Out<W>&).
template <class F, int W>
void run(const Context& context, const double* in, double* out, int count) {
  for (int i = 0; i < count; i += W) {
    Out<W> results{out + i * F::outs, F::outs};
    F::template run<W>(context, In<W>{in + i * F::ins, F::ins}, results);
  }
}

// A function by its name, numbers in, numbers out, and what it does with In `in` and Out `out`.
#define LANE_FUNCTION(name, ins_, outs_)                                                 \
  struct name {                                                                          \
    static constexpr const char* title = #name;                                          \
    static constexpr int ins = (ins_), outs = (outs_);                                   \
    template <int W>                                                                     \
    VITRAIL_LANES static void run(const Context& context, const In<W>& in, Out<W>& out); \
  };                                                                                     \
  template <int W>                                                                       \
  VITRAIL_LANES void name::run([[maybe_unused]] const Context& context, const In<W>& in, Out<W>& out)

}  // namespace
}  // namespace vitrail::lane_tests
