# SPDX-License-Identifier: Apache-2.0
"""Writes scene/spectra/cie_tables.cpp: the CIE 1931 2° observer and illuminant D65 at 360, 361 … 830 nm.

    pip install colour-science==0.4.7
    python3 scripts/generate_cie_tables.py > scene/spectra/cie_tables.cpp

The observer is tabulated at 1 nm. D65 is tabulated at 5 nm from 300 to 780 nm, as in CIE 15; the rest up to 830 nm is
computed from the CIE daylight components at 6500·1.4388/1.4380 K, the formula that the table itself comes from (the
two agree to a unit of the table's last digit, which is checked here). In between CIE prescribes linear interpolation.
"""
import colour
import numpy as np

OBSERVER = "CIE 1931 2 Degree Standard Observer"
grid = np.arange(360, 831)


def observer():
    cmfs = colour.MSDS_CMFS[OBSERVER]
    assert (cmfs.shape.start, cmfs.shape.end, cmfs.shape.interval) == (360, 830, 1)
    return cmfs.values.astype(np.float32)


def d65():
    table = colour.SDS_ILLUMINANTS["D65"]
    white = colour.temperature.CCT_to_xy_CIE_D(6500 * 1.4388 / 1.4380)
    daylight = colour.sd_CIE_illuminant_D_series(white, M1_M2_rounding=True)
    steps = np.arange(360, 831, 5)
    inside = steps <= table.shape.end
    from_table = np.array([table[float(s)] for s in steps[inside]])
    from_formula = np.array([daylight[float(s)] for s in steps])
    assert np.abs(from_table - from_formula[inside]).max() < 1e-3  # the table has six digits
    values = np.concatenate([from_table, from_formula[~inside]])
    return np.interp(grid, steps, values)


def rows(texts, per_line):
    return "\n".join("    " + ", ".join(texts[i:i + per_line]) + "," for i in range(0, len(texts), per_line))


cmf = observer()
illuminant = d65()
illuminant = (illuminant * cmf[:, 1].astype(float).sum() / (illuminant * cmf[:, 1]).sum()).astype(np.float32)
triples = ["{" + ", ".join(f"{x:.9e}f" for x in row) + "}" for row in cmf]
singles = [f"{x:.9g}f" if "." in f"{x:.9g}" else f"{x:.9g}.f" for x in illuminant]

print("// SPDX-" "License-Identifier: Apache-2.0")
print(f"""// Written by scripts/generate_cie_tables.py: change that, not this.
// Source: PyPI package colour-science {colour.__version__}, data sets MSDS_CMFS["{OBSERVER}"],
// SDS_ILLUMINANTS["D65"] (to 780 nm) and SDS_BASIS_FUNCTIONS_CIE_ILLUMINANT_D_SERIES (beyond).
// clang-format off
#include "scene/spectra/color.h"

namespace vitrail {{

const std::array<std::array<float, 3>, table_size>& cie_1931() {{
  static constexpr std::array<std::array<float, 3>, table_size> table{{{{
{rows(triples, 2)}
  }}}};
  return table;
}}

const std::array<float, table_size>& cie_d65() {{
  static constexpr std::array<float, table_size> table{{
{rows(singles, 8)}
  }};
  return table;
}}

}}  // namespace vitrail
// clang-format on""")
