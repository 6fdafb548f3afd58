#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes scene/daylight/melanopic_table.cpp: the melanopic action spectrum of CIE S 026/E:2018.

    pip install luxpy==1.12.0
    python3 scripts/generate_melanopic_table.py > scene/daylight/melanopic_table.cpp

It is the table of the CIE's own S 026 toolbox (v1.049a), which luxpy ships; blank below 380 nm, which is 0 here.
"""
import csv
import importlib.util
import os

folder = os.path.dirname(importlib.util.find_spec("luxpy").origin)
name = "cie_S026_2018_SI_action_spectra_CIEToolBox_v1.049a_20_11.csv"
rows = csv.DictReader(open(os.path.join(folder, "toolboxes", "photbiochem", "data", name)))
values = {int(row["nm"]): float(row["mel"]) for row in rows}
assert sorted(values) == list(range(360, 831))
texts = [f"{0.0 if v != v else v:.6g}" for _, v in sorted(values.items())]
texts = [t + ("f" if "." in t or "e" in t else ".0f") for t in texts]

print("// SPDX-" "License-Identifier: Apache-2.0")
print("// Written by scripts/generate_melanopic_table.py: change that, not this.")
print("// Source: CIE S 026/E:2018, its toolbox's table in PyPI package luxpy 1.12.0.")
print('// clang-format off\n#include "scene/daylight/photometry.h"\n\nnamespace vitrail {\n')
print("const std::array<float, table_size>& melanopic() {\n  static const std::array<float, table_size> values{")
for i in range(0, len(texts), 12):
    print("    " + ", ".join(texts[i:i + 12]) + ",")
print("  };\n  return values;\n}\n\n}  // namespace vitrail")
