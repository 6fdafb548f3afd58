#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes scene/daylight/sky_tables.cpp: the data of Hošek and Wilkie's sky and sun.

    pip install mitsuba==3.9.1
    python3 scripts/generate_sky_tables.py > scene/daylight/sky_tables.cpp

They are the spectral data sets that Mitsuba ships (data/sunsky/sunsky_datasets.bin, doubles) with its licence, without
the band at 320 nm, which is not sampled, to seven digits.
"""
import os
import struct

import mitsuba
import numpy as np

folder = os.path.join(os.path.dirname(mitsuba.__file__), "data", "sunsky")
mitsuba.set_variant("scalar_rgb")
names = {"shape": "sky_params_spec", "radiance": "sky_rad_spec", "sun": "sun_rad_spec", "limb": "sun_ld_spec"}


def load(name):
    """Of Mitsuba's tensor files: a field's header is its name, dimensions, type and place, then its shape."""
    data = open(os.path.join(folder, "sunsky_datasets.bin"), "rb").read()
    at = data.index(struct.pack("<H", len(name)) + name.encode()) + 2 + len(name)
    dimensions, _, offset = struct.unpack_from("<HBQ", data, at)
    shape = struct.unpack_from(f"<{dimensions}Q", data, at + 11)
    return np.frombuffer(data, np.float64, int(np.prod(shape)), offset).reshape(shape)


def without_first_band(values):
    return np.delete(values, 0, values.shape.index(11))


def text(value):
    number = f"{value:.7g}"
    return number + ("f" if "." in number or "e" in number else ".0f")


def braces(values):
    if values.ndim == 1:
        return "{" + ",".join(text(v) for v in values) + "}"
    return "{" + ",\n".join(braces(v) for v in values) + "}"


licence = open(os.path.join(folder, "LICENSE")).read().split("This source")[1]
print("// SPDX-" "License-Identifier: Apache-2.0 AND BSD-3-Clause")
print("// Written by scripts/generate_sky_tables.py from the data of PyPI package mitsuba 3.9.1: change that, not this.")
print("// The data are of https://cgg.mff.cuni.cz/projects/SkylightModelling/ and come under this licence:\n//")
print("\n".join(("// " + line).rstrip() for line in ("This source" + licence).strip().splitlines()))
print('// clang-format off\n#include "scene/daylight/sky_tables.h"\n\nnamespace vitrail::sky_tables {\n')
for name, field in names.items():
    values = without_first_band(load(field))
    size = {"shape": "[turbidities][albedos][control_points][bands][shapes]",
            "radiance": "[turbidities][albedos][control_points][bands]",
            "sun": "[turbidities][sun_segments][bands][sun_powers]", "limb": "[bands][limb_powers]"}[name]
    print(f"const float {name}{size} =\n{braces(values)};\n")
print("}  // namespace vitrail::sky_tables")
