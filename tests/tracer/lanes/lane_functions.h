// SPDX-License-Identifier: Apache-2.0
// The functions of tracer/lanes, compiled for each instruction set and width, as the tests call them: all
// arguments and results are doubles, which hold floats and 32-bit integers exactly.
#pragma once

namespace vitrail::lane_tests {

struct Context;  // of the functions that read more than their arguments; fixtures.h

struct LaneFunction {
  const char* name;
  int ins, outs;  // numbers a case
  // [case][number]; `count` is a multiple of 8.
  void (*run)(const Context& context, const double* in, double* out, int count);
};

struct LaneFunctions {
  const char* set;
  int width;
  const LaneFunction* functions;
  int count;
};

// One a width: 1, 2, 4, 8.
extern const LaneFunctions portable_functions[4];
#if defined(__x86_64__)
extern const LaneFunctions avx2_functions[4];
extern const LaneFunctions avx512_functions[4];
#endif

}  // namespace vitrail::lane_tests
