# SPDX-License-Identifier: Apache-2.0
"""Small things: pictures made of coloured patches, a potted plant, books, and glasses and a carafe of BK7."""

import numpy as np

from bed import MIDDLE_X
from meshes import (
    Mesh,
    box,
    generator,
    grid,
    join,
    lathe,
    moved,
    rounded,
    smooth,
    steps,
    tubes,
    turned,
    waves,
)
from parts import Part
from room import DEPTH

# ---- Pictures --------------------------------------------------------------------------------------------------


def patch(x0, x1, bottom, top, y):
    """Flat upright patch facing −y between two curves given at equal steps of x."""
    x = np.linspace(x0, x1, len(top))
    lower, upper = (
        np.stack([x, np.full(len(x), y), z], axis=-1) for z in (np.broadcast_to(bottom, x.shape), top)
    )
    return grid(np.stack([lower, upper], axis=1))


def picture(name, x, z, width, height, sun):
    """A framed landscape: hills before hills, a low sun, cut from coloured sheets half a millimetre apart."""
    rng = generator(name)
    wall, bar, mat = DEPTH, 0.022, 0.055
    a, b, c, d = x - width / 2, x + width / 2, z - height / 2, z + height / 2
    frame = [box((a, wall - 0.03, e), (b, wall + 0.004, e + bar)) for e in (c, d - bar)]
    frame += [box((e, wall - 0.03, c), (e + bar, wall + 0.004, d)) for e in (a, b - bar)]
    a, b, c, d = a + bar + mat, b - bar - mat, c + bar + mat, d - bar - mat
    parts = [
        Part("pictures", "walnut", join(frame)),
        Part(
            "pictures",
            "paper",
            box(
                (a - mat - 0.005, wall - 0.012, c - mat - 0.005),
                (b + mat + 0.005, wall + 0.004, d + mat + 0.005),
            ),
        ),
    ]
    front = wall - 0.0125
    parts.append(Part("pictures", "art-sky", patch(a, b, c, np.full(2, d), front)))
    angle = np.linspace(0, 2 * np.pi, 49)
    disc = np.stack(
        [
            sun[0] * (b - a) + a + 0.15 * (b - a) * np.cos(angle),
            0 * angle + front - 0.0005,
            sun[1] * (d - c) + c + 0.15 * (b - a) * np.sin(angle),
        ],
        axis=-1,
    )
    f = np.stack([np.zeros(47, int), np.arange(1, 48), np.arange(2, 49)], axis=1)
    parts.append(Part("pictures", "art-sun", Mesh(disc, f)))
    u = np.linspace(0, 1, 60)
    for k, (material, level, swing) in enumerate(
        (
            ("art-far", 0.50, 0.10),
            ("art-mid", 0.36, 0.09),
            ("art-earth", 0.24, 0.05),
            ("art-near", 0.15, 0.06),
        )
    ):
        top = c + (d - c) * np.clip(level + swing * waves(u, 0 * u, rng, 5, 0.5, 1.6), 0.03, 0.95)
        parts.append(Part("pictures", material, patch(a, b, c, top, front - 0.001 - 0.0005 * k)))
    return parts


# ---- Plant -----------------------------------------------------------------------------------------------------


def leaf(length, width, curl, detail, rng):
    """A pointed oval leaf along +x, sagging at its tip, folded along the midrib, its edge waved."""
    u, v = np.meshgrid(
        np.linspace(0, 1, steps(30, detail)), np.linspace(-1, 1, steps(20, detail)), indexing="ij"
    )
    half = width / 2 * np.sin(np.pi * u**0.8) ** 0.8 * (1 - 0.25 * u)
    ribs = 0.004 * np.cos(2 * np.pi * (9 * u - 1.5 * np.abs(v))) * (1 - u)
    z = (
        0.22 * np.abs(v) * half
        - curl * length * u**2
        + 0.05 * half * waves(2 * u, v, rng, 5, 0.4, 1.5) * np.abs(v)
        + ribs * np.abs(v)
    )
    return smooth(grid(np.stack([length * u * (1 - 0.25 * curl * u), v * half, z], axis=-1)))


def plant(x, y, detail):
    rng = generator("plant")
    pot = lathe(
        rounded([(0, 0), (0.13, 0), (0.185, 0.36), (0.165, 0.36), (0.155, 0.31), (0, 0.31)], 0.012, 5), 64
    )
    stems, green, young = [], [], []
    for trunk in range(3):
        t = np.linspace(0, 1, 24)
        lean = rng.normal(0, 0.10, 2) + 0.10 * np.array(
            [np.cos(2.1 * trunk + 0.6), np.sin(2.1 * trunk + 0.6)]
        )
        tall = (1.52, 1.25, 1.02)[trunk]
        path = np.stack(
            [
                0.03 * np.cos(2.1 * trunk) + lean[0] * t + 0.03 * np.sin(5 * t + trunk),
                0.03 * np.sin(2.1 * trunk) + lean[1] * t + 0.03 * np.cos(4 * t + trunk),
                0.29 + (tall - 0.29) * t,
            ],
            axis=-1,
        )
        stems.append(tubes([path], 0.013 - 0.006 * t, 10))
        count = (17, 14, 12)[trunk]
        for k in range(count):
            h = 0.30 + 0.70 * (k + 0.5) / count
            root = path[int(h * 23)]
            heading = 137.5 * k + 50 * trunk + rng.uniform(-15, 15)
            size = rng.uniform(0.8, 1.15) * (1.1 - 0.35 * h)
            blade = leaf(0.37 * size, 0.24 * size, rng.uniform(0.15, 0.5), detail, rng)
            stalk = tubes([[(0, 0, 0), (0.03, 0, 0.012), (0.075, 0, 0.016)]], 0.0035, 6)
            rise = -rng.uniform(5, 35) - 35 * (h > 0.93)
            for part, bag in ((moved(blade, (0.07, 0, 0.016)), young if h > 0.86 else green), (stalk, stems)):
                bag.append(moved(turned(turned(part, rise, "y"), heading), root))
    soil = lathe([(0.158, 0.318), (0, 0.325)], 32)
    return [
        Part("plant", m, moved(mesh, (x, y, 0)))
        for m, mesh in (
            ("porcelain", pot),
            ("soil", soil),
            ("stem", join(stems)),
            ("leaf", join(green)),
            ("leaf-young", join(young)),
        )
    ]


# ---- Books and glass -------------------------------------------------------------------------------------------


def books(place, sizes, first=0):
    """A stack; sizes are (width, depth, thickness, degrees) from the bottom."""
    covers = ("indigo", "terracotta", "mustard", "ceramic", "cream")
    parts, z = [], 0.0
    for k, (w, d, t, degrees) in enumerate(sizes):
        boards = [
            box((-w / 2, -d / 2, z), (w / 2, d / 2, z + 0.003)),
            box((-w / 2, -d / 2, z + t - 0.003), (w / 2, d / 2, z + t)),
            box((-w / 2 - 0.002, -d / 2, z), (-w / 2 + 0.002, d / 2, z + t)),
        ]
        leaves = box(
            (-w / 2 + 0.001, -d / 2 + 0.004, z + 0.002), (w / 2 - 0.005, d / 2 - 0.004, z + t - 0.002)
        )
        for mesh, material in ((join(boards), covers[(k + first) % 5]), (leaves, "paper")):
            parts.append(Part("books", material, moved(turned(mesh, degrees), place)))
        z += t + 0.0003
    return parts


def tumbler(detail):
    return lathe(
        rounded(
            [(0, 0), (0.032, 0), (0.038, 0.095), (0.0355, 0.095), (0.0298, 0.012), (0, 0.012)], 0.0011, 4
        ),
        steps(120, detail),
    )


def carafe(detail):
    outer = [(0, 0), (0.055, 0), (0.064, 0.03), (0.060, 0.10), (0.026, 0.17), (0.024, 0.215), (0.034, 0.25)]
    inner = [
        (0.0315, 0.25),
        (0.0214, 0.215),
        (0.0232, 0.169),
        (0.0572, 0.0985),
        (0.0612, 0.031),
        (0.053, 0.008),
        (0, 0.008),
    ]
    angle = np.linspace(0, np.pi, 7)[1:-1]
    rim = np.stack([0.03275 + 0.00125 * np.cos(angle), 0.25 + 0.00125 * np.sin(angle)], axis=1)
    return lathe(np.concatenate([rounded(outer, 0.02, 6), rim, rounded(inner, 0.02, 6)]), steps(160, detail))


def glassware(x, y, z, detail):
    tray = lathe(
        rounded([(0, 0), (0.15, 0), (0.158, 0.016), (0.152, 0.016), (0.146, 0.005), (0, 0.005)], 0.003, 4), 96
    )
    parts = [Part("tray", "brass", moved(tray, (x, y, z)))]
    lift = z + 0.0055  # half a millimetre above the tray: glass must not share a plane with it
    for mesh, dx, dy in (
        (carafe(detail), -0.045, 0.04),
        (tumbler(detail), 0.065, 0.03),
        (tumbler(detail), 0.035, -0.07),
    ):
        parts.append(Part("glassware", "glass", moved(mesh, (x + dx, y + dy, lift))))
    return parts


def bowl(x, y, z):
    shape = lathe(
        rounded([(0, 0), (0.05, 0), (0.13, 0.055), (0.124, 0.058), (0.048, 0.008), (0, 0.008)], 0.012, 6), 64
    )
    parts = [Part("bowl", "porcelain", moved(shape, (x, y, z)))]
    rng = generator("fruit")
    for k in range(5):
        a = 72 * k * np.pi / 180
        t = np.linspace(-np.pi / 2, np.pi / 2, 17)
        r = 0.036 * rng.uniform(0.93, 1.07)
        profile = np.stack(
            [r * np.cos(t), 0.93 * r * np.sin(t) - 0.006 * np.exp(-((np.cos(t) / 0.25) ** 2)) * np.sign(t)],
            axis=1,
        )
        profile[[0, -1], 0] = 0
        fruit = turned(lathe(profile, 28), rng.uniform(-30, 30), "x")
        place = (x + 0.055 * np.cos(a), y + 0.055 * np.sin(a), z + 0.058) if k < 4 else (x, y, z + 0.095)
        parts.append(Part("fruit", "art-sun" if k % 2 else "mustard", moved(fruit, place)))
    return parts


def decor(detail):
    parts = []
    for k, x in enumerate((MIDDLE_X - 0.74, MIDDLE_X, MIDDLE_X + 0.74)):
        parts += picture(f"picture-{k}", x, 1.86, 0.60, 0.78, ((0.68, 0.66), (0.45, 0.72), (0.30, 0.64))[k])
    parts += picture("picture-desk", 1.32, 1.62, 0.86, 0.62, (0.72, 0.70))
    parts += plant(0.50, 5.66, detail)
    parts += books(
        (1.06, DEPTH - 0.30, 0.75), ((0.21, 0.28, 0.030, 8), (0.19, 0.26, 0.024, -6), (0.16, 0.23, 0.035, 14))
    )
    parts += books(
        (MIDDLE_X + 1.28, DEPTH - 0.36, 0.5255), ((0.15, 0.21, 0.022, -12), (0.13, 0.19, 0.028, 4)), 3
    )
    parts += books((2.36, 2.83, 0.4105), ((0.20, 0.27, 0.020, 25), (0.17, 0.24, 0.018, 38)), 1)
    return parts + glassware(2.10, 3.06, 0.4105, detail) + bowl(1.62, DEPTH - 0.34, 0.7505)
