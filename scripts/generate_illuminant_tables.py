# SPDX-License-Identifier: Apache-2.0
"""Writes scene/spectra/illuminant_tables.cpp: CIE illuminants D50, D60 and F1-F12.

    pip install colour-science==0.4.7
    python3 scripts/generate_illuminant_tables.py > scene/spectra/illuminant_tables.cpp

All are tabulated at 5 nm (CIE 15): D50 from 300, F1-F12 from 380 to 780 nm. D50 up to 830 nm, and D60 altogether, are
computed from the CIE daylight components at kelvin*1.4388/1.4380; where D50 has a table, the two agree to a unit of its
last digit, which is checked here.
"""
import warnings

warnings.filterwarnings("ignore")
import colour
import numpy as np


def literal(value):
    text = f"{value:.7g}"
    return text + ("f" if "." in text or "e" in text else ".0f")


def daylight(kelvin, name):
    steps = np.arange(360, 831, 5)
    white = colour.temperature.CCT_to_xy_CIE_D(kelvin * 1.4388 / 1.4380)
    formula = colour.sd_CIE_illuminant_D_series(white, M1_M2_rounding=True)
    values = np.array([formula[float(s)] for s in steps])
    if name == "D50":
        table = colour.SDS_ILLUMINANTS[name]
        inside = steps <= table.shape.end
        from_table = np.array([table[float(s)] for s in steps[inside]])
        assert np.abs(from_table - values[inside]).max() < 1.1e-3  # the table has six digits
        values[inside] = from_table
    return steps[0], values


def fluorescent(number):
    table = colour.SDS_ILLUMINANTS[f"FL{number}"]
    assert (table.shape.start, table.shape.end, table.shape.interval) == (380, 780, 5)
    return 380, table.values


tables = [("stdillum-D50", *daylight(5000, "D50")), ("illum-acesD60", *daylight(6000, "D60"))]
tables += [(f"stdillum-F{n}", *fluorescent(n)) for n in range(1, 13)]

print("// SPDX-" "License-Identifier: Apache-2.0")
print(f"""// Written by scripts/generate_illuminant_tables.py: change that, not this.
// Source: PyPI package colour-science {colour.__version__}, data sets SDS_ILLUMINANTS and
// SDS_BASIS_FUNCTIONS_CIE_ILLUMINANT_D_SERIES.
// clang-format off
#include "scene/spectra/illuminant_tables.h"

namespace vitrail {{

namespace {{
""")
for i, (name, first, values) in enumerate(tables):
    texts = [literal(v) for v in values]
    print(f"constexpr float values_{i}[] = {{")
    for j in range(0, len(texts), 12):
        print("    " + ", ".join(texts[j:j + 12]) + ",")
    print("};")
print("\nconstexpr IlluminantTable tables[] = {")
for i, (name, first, _) in enumerate(tables):
    print(f'    {{"{name}", {first}, values_{i}}},')
print("""};

}  // namespace

std::span<const IlluminantTable> illuminant_tables() { return tables; }

}  // namespace vitrail
// clang-format on""")
