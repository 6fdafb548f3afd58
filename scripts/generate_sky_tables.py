#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes scene/daylight/sky_tables.txt: the data of Hošek and Wilkie's sky and sun.

    pip install mitsuba==3.9.1
    python3 scripts/generate_sky_tables.py > scene/daylight/sky_tables.txt

They are the spectral data sets that Mitsuba ships (data/sunsky/sunsky_datasets.bin, doubles) with its licence, without
the band at 320 nm, which is not sampled, to seven digits.
"""
import os
import struct

import mitsuba
import numpy as np

folder = os.path.join(os.path.dirname(mitsuba.__file__), "data", "sunsky")
mitsuba.set_variant("scalar_rgb")
tables = {
    "shape": ("sky_params_spec", "Nine of the formula a row, by turbidity 1 to 10, albedo 0 and 1, Bézier point, band 360 to 720 nm."),
    "radiance": ("sky_rad_spec", "The bands' means a row, by turbidity, albedo, Bézier point."),
    "sun": ("sun_rad_spec", "Four coefficients a row, constant first, by turbidity, segment of elevation, band."),
    "limb": ("sun_ld_spec", "Six coefficients a row, constant first, by band."),
}


def load(name):
    """Of Mitsuba's tensor files: a field's header is its name, dimensions, type and place, then its shape."""
    data = open(os.path.join(folder, "sunsky_datasets.bin"), "rb").read()
    at = data.index(struct.pack("<H", len(name)) + name.encode()) + 2 + len(name)
    dimensions, _, offset = struct.unpack_from("<HBQ", data, at)
    shape = struct.unpack_from(f"<{dimensions}Q", data, at + 11)
    return np.frombuffer(data, np.float64, int(np.prod(shape)), offset).reshape(shape)


def without_first_band(values):
    return np.delete(values, 0, values.shape.index(11))


licence = open(os.path.join(folder, "LICENSE")).read().split("This source")[1]
print("# SPDX-" "License-Identifier: Apache-2.0 AND BSD-3-Clause")
print("# Written by scripts/generate_sky_tables.py from the data of PyPI package mitsuba 3.9.1: change that, not this.")
print("# The data are of https://cgg.mff.cuni.cz/projects/SkylightModelling/ and come under this licence:\n#")
print("\n".join(("# " + line).rstrip() for line in ("This source" + licence).strip().splitlines()))
for name, (field, rows) in tables.items():
    values = without_first_band(load(field))
    print(f"\n# {rows}\n[{name}]")
    for row in values.reshape(-1, values.shape[-1]):
        print(" ".join(f"{value:.7g}" for value in row))
