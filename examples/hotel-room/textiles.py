# SPDX-License-Identifier: Apache-2.0
"""The rug: every tuft is a bent, tapered blade of its own."""

import numpy as np

from meshes import Mesh, box, generator, waves
from parts import Part

EXTENT = (1.55, 5.05, 1.25, 4.45)
TUFTS_AT_DETAIL_1 = 300_000


def pattern(x, y):
    """Index of the colour: a lattice of diamonds inside a striped border."""
    x0, x1, y0, y1 = EXTENT
    edge = np.minimum(np.minimum(x - x0, x1 - x), np.minimum(y - y0, y1 - y))
    a, b = ((x + y) / 0.42) % 1, ((x - y) / 0.42) % 1
    line = np.minimum(np.minimum(a, 1 - a), np.minimum(b, 1 - b)) < 0.055
    heart = np.maximum(np.abs(a - 0.5), np.abs(b - 0.5)) < 0.11
    index = np.where(line, 1, np.where(heart, 2, 0))
    index = np.where(edge < 0.30, 0, index)
    for near, far, colour in ((0.24, 0.275, 1), (0.12, 0.20, 1), (0.145, 0.175, 2), (0.055, 0.07, 3)):
        index = np.where((edge >= near) & (edge < far), colour, index)
    return index


COLOURS = ("cream", "indigo", "terracotta", "sand")


def rug(detail):
    x0, x1, y0, y1 = EXTENT
    rng = generator("rug")
    spacing = np.sqrt((x1 - x0) * (y1 - y0) / (TUFTS_AT_DETAIL_1 * detail))
    nx, ny = int((x1 - x0) / spacing), int((y1 - y0) / spacing)
    x, y = (a.reshape(-1) for a in np.meshgrid(np.arange(nx), np.arange(ny), indexing="ij"))
    x = x0 + (x + rng.uniform(0, 1, x.shape)) * spacing
    y = y0 + (y + rng.uniform(0, 1, y.shape)) * spacing
    count = len(x)
    heading = rng.uniform(0, 2 * np.pi, count)
    # The pile leans where feet and the brush have left it.
    lean_x = 0.006 * waves(x, y, rng, 8, 0.25, 1.5) + rng.normal(0, 0.0035, count)
    lean_y = 0.006 * waves(x, y, rng, 8, 0.25, 1.5) + rng.normal(0, 0.0035, count)
    height = rng.uniform(0.012, 0.017, count)
    breadth = 0.68 * spacing * rng.uniform(0.7, 1.2, count)
    side = np.stack([np.cos(heading), np.sin(heading), 0 * x], axis=-1)
    root = np.stack([x, y, np.full(count, 0.004)], axis=-1)
    lean = np.stack([lean_x, lean_y, 0 * x], axis=-1)

    def at(t, across):
        rise = np.stack([0 * x, 0 * x, height * t], axis=-1)
        return root + lean * t * t + rise + side * (across * breadth / 2)[:, None]

    one = np.ones(count)
    v = np.stack(
        [at(0, -one), at(0, one), at(0.62, -0.85 * one), at(0.62, 0.85 * one), at(1.0, 0 * one)], axis=1
    )
    f = np.array([(0, 1, 3), (0, 3, 2), (2, 3, 4)])
    index = pattern(x, y)
    parts = [Part("rug", "sand", box((x0, y0, 0), (x1, y1, 0.005)))]
    for k, colour in enumerate(COLOURS):
        blades = v[index == k]
        faces = (f[None] + 5 * np.arange(len(blades))[:, None, None]).reshape(-1, 3)
        parts.append(Part("rug-tufts", colour, Mesh(blades.reshape(-1, 3), faces)))
    return parts
