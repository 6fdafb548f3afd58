# SPDX-License-Identifier: Apache-2.0
"""Writes cli/spectrum/color_checker.cpp: the reflectances of the 24 patches of a ColorChecker, after Ohta (1997).

    pip install colour-science==0.4.7
    python3 scripts/generate_color_checker.py > cli/spectrum/color_checker.cpp
"""
import textwrap
import warnings

warnings.filterwarnings("ignore")
import colour

print("// SPDX-" "License-Identifier: Apache-2.0")
print("""// By scripts/generate_color_checker.py from colour-science's table of Ohta (1997).
// clang-format off
#include "cli/spectrum/color_checker.h"

namespace vitrail {

namespace {

constexpr ColorCheckerPatch patches[] = {""")
for name, spectrum in colour.SDS_COLOURCHECKERS["cc_ohta"].items():
    values = ", ".join(f"{spectrum[float(nm)]:g}" for nm in range(380, 781, 10))
    lines = textwrap.fill("{" + values + "}},", 104, initial_indent="     ", subsequent_indent="      ")
    print(f'    {{"{name}",\n{lines}')
print("""};

}  // namespace

std::span<const ColorCheckerPatch> color_checker() { return patches; }

}  // namespace vitrail""")
