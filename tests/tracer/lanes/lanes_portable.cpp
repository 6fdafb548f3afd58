// SPDX-License-Identifier: Apache-2.0
#include "tests/tracer/lanes/all_functions.h"

namespace vitrail::lane_tests {

constinit const LaneFunctions portable_functions[4] = {
    functions_of<1>("portable"), functions_of<2>("portable"), functions_of<4>("portable"),
    functions_of<8>("portable")};

}  // namespace vitrail::lane_tests
