# SPDX-License-Identifier: Apache-2.0
"""What covers the land, and the materials in PBRT's words: linear sRGB reflectances; the lake is of water."""

import numpy as np

# In the order in which `covers` numbers them.
COLOURS = {
    "meadow": (0.14, 0.20, 0.06),
    "grass": (0.20, 0.22, 0.09),
    "scree": (0.30, 0.28, 0.25),
    "cliff": (0.21, 0.195, 0.18),
    "snow": (0.86, 0.88, 0.90),
    "shore": (0.36, 0.31, 0.23),
}
OTHERS = {
    "rock-0": (0.27, 0.26, 0.24),
    "rock-1": (0.34, 0.31, 0.27),
    "bark": (0.12, 0.085, 0.06),
    "needle-0": (0.045, 0.10, 0.035),
    "needle-1": (0.06, 0.12, 0.035),
    "needle-2": (0.04, 0.085, 0.04),
}


def all_materials():
    """Lines that define them."""
    for name, rgb in {**COLOURS, **OTHERS}.items():
        yield f'MakeNamedMaterial "{name}" "string type" "diffuse" "rgb reflectance" [{rgb[0]} {rgb[1]} {rgb[2]}]'
    yield 'MakeNamedMaterial "water" "string type" "dielectric" "float eta" [1.333]'


def covers(z, step, lake, top):
    """The number of the material of each triangle of a tile, two to a cell, in the order of the cells."""
    a, b, c, d = z[:-1, :-1], z[1:, :-1], z[1:, 1:], z[:-1, 1:]
    n = a.size
    out = np.empty((n, 2), np.int8)
    step = np.float32(step)
    # Triangle abc: its slopes are (b − a, c − b); acd: (c − d, d − a).
    for k, (dx, dy, height) in enumerate(((b - a, c - b, b), (c - d, d - a, d))):
        dx, dy = dx / step, dy / step
        steep = np.sqrt(dx * dx + dy * dy)
        rise = (height - lake) / np.float32(top - lake)
        ragged = rise + np.float32(0.06) * (dx + dy)  # snow lies longer where the sun is less
        cover = np.where(ragged < 0.34, 0, 1)
        cover[(steep > 0.62) | (rise > 0.66)] = 2
        cover[steep > 0.85] = 3
        cover[(ragged > 0.62) & (steep < 0.95)] = 4
        cover[rise < 0.012] = 5
        out[:, k] = cover.ravel()
    return out.ravel()
