#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes scene/spectra/srgb_basis_table.cpp: the reflectances of Mallett and Yuksel, "Spectral Primary Decomposition for
Rendering with sRGB Reflectance" (2019), from the package colour-science (BSD-3-Clause) of PyPI."""

import pathlib

from colour.recovery.datasets.mallett2019 import DATA_BASIS_FUNCTIONS_sRGB_MALLETT2019 as rows


def main() -> None:
    out = pathlib.Path(__file__).parent.parent / "scene" / "spectra" / "srgb_basis_table.cpp"
    text = '''// SPDX-License-Identifier: Apache-2.0
// Written by scripts/generate_srgb_basis.py.
#include "scene/spectra/srgb_basis.h"

// clang-format off
namespace vitrail {

const std::array<std::array<float, 3>, 81> srgb_basis_table{{
'''
    for row in rows:
        text += "    {{" + ", ".join(f"{x:.7g}f" for x in row) + "}},\n"
    out.write_text(text + "}};\n\n}  // namespace vitrail\n")


if __name__ == "__main__":
    main()
