# SPDX-License-Identifier: Apache-2.0
"""Everything inside the room that shines. Radiances are linear sRGB; a pixel of 1 is white."""

import numpy as np

from meshes import grid, join, lathe, moved, rounded, tubes
from parts import Part
from room import HEIGHT

BEDSIDE = (2.1, 1.45, 0.80)
PENDANT = (1.05, 0.95, 0.80)
SOFTBOX = (4.6, 4.4, 4.1)


def bedside_lamp(x, y, z):
    foot = rounded(
        [
            (0, 0),
            (0.075, 0),
            (0.080, 0.02),
            (0.035, 0.05),
            (0.085, 0.14),
            (0.075, 0.22),
            (0.018, 0.27),
            (0.016, 0.30),
            (0, 0.30),
        ],
        0.035,
        5,
    )
    stem = tubes([[(0, 0, 0.28), (0, 0, 0.40)]], 0.006, 10)
    shade = lathe([(0.155, 0.30), (0.115, 0.52)], 40)
    trims = join([tubes([ring(r, h)], 0.003, 6) for r, h in ((0.155, 0.30), (0.115, 0.52))])
    return [
        Part("lamps", "ceramic", moved(lathe(foot, 36), (x, y, z))),
        Part("lamps", "brass", moved(join([stem, trims]), (x, y, z))),
        Part("lamp-shades", "shade", moved(shade, (x, y, z)), BEDSIDE),
    ]


def ring(radius, z, points=49):
    a = np.linspace(0, 2 * np.pi, points)
    return np.stack([radius * np.cos(a), radius * np.sin(a), z + 0 * a], axis=-1)


def pendant(x, y):
    """A drum of paper under the ceiling."""
    shade = lathe([(0.26, HEIGHT - 0.40), (0.26, HEIGHT - 0.18)], 48)
    disc = lathe(
        rounded(
            [(0, HEIGHT - 0.385), (0.255, HEIGHT - 0.385), (0.255, HEIGHT - 0.38), (0, HEIGHT - 0.38)], 0.002
        ),
        48,
    )
    rod = tubes([[(x, y, HEIGHT - 0.39), (x, y, HEIGHT + 0.01)]], 0.007, 10)
    rose = lathe(
        rounded(
            [(0, HEIGHT - 0.03), (0.05, HEIGHT - 0.03), (0.055, HEIGHT + 0.005), (0, HEIGHT + 0.005)], 0.006
        ),
        32,
    )
    rings = [moved(tubes([ring(0.26, z)], 0.004, 6), (x, y, 0)) for z in (HEIGHT - 0.40, HEIGHT - 0.18)]
    return [
        Part("pendant-shade", "shade", moved(shade, (x, y, 0)), PENDANT),
        Part("pendant", "paper", moved(disc, (x, y, 0))),
        Part("pendant", "brass", join([rod, moved(rose, (x, y, 0))] + rings)),
    ]


def softbox():
    """A photographer's soft light on the wall behind the camera."""
    lamp = grid(
        np.array([[(1.6, 0.05, 1.3), (1.6, 0.05, 2.6)], [(5.2, 0.05, 1.3), (5.2, 0.05, 2.6)]], float)[::-1]
    )
    return Part("softbox", "shade", lamp, SOFTBOX)
