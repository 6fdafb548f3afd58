// SPDX-License-Identifier: Apache-2.0
#include "tests/tracer/lanes/all_functions.h"

namespace vitrail::lane_tests {

constinit const LaneFunctions avx2_functions[4] = {functions_of<1>("avx2"), functions_of<2>("avx2"),
                                                   functions_of<4>("avx2"), functions_of<8>("avx2")};

}  // namespace vitrail::lane_tests
