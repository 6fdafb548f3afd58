# SPDX-License-Identifier: Apache-2.0
"""What the window shows: the balcony with its railing, a street three floors below, houses, trees and hills."""

import numpy as np

from meshes import Mesh, box, generator, grid, join, smooth, soft_box, tubes, waves
from parts import Part
from room import WALL

GROUND = -9.5
# x and y of the front's middle, width, depth, floors
HOUSES = (
    (-34, 9, 13, 11, 4),
    (-40, 27, 15, 12, 3),
    (-33, 43, 14, 10, 4),
    (-58, -6, 12, 12, 3),
    (-90, 30, 24, 14, 4),
    (-38, 66, 22, 12, 4),
    (-90, 52, 26, 14, 6),
    (-66, 96, 24, 14, 5),
)
# x, y, height, radius of the crown
TREES = (
    (-12.0, 7.4, 13.0, 2.9),
    (-11.5, 12.5, 10.5, 2.7),
    (-21, 14.5, 10.5, 2.9),
    (-27.5, 33, 11, 3.0),
    (-12, 20, 9.0, 2.5),
    (-27, 1.5, 10.5, 2.8),
    (-13, 30, 10, 2.8),
    (-27, 53, 11, 3.0),
)


def balcony(detail):
    y0, y1, edge = 0.9, 6.6, -1.75
    slab = box((edge, y0, -0.25), (-WALL + 0.01, y1, -0.05))
    tiles = [
        box((x, y, -0.06), (x + 0.296, y + 0.296, -0.035))
        for x in np.arange(edge + 0.01, -WALL - 0.2, 0.3)
        for y in np.arange(y0, y1 - 0.2, 0.3)
    ]
    x = edge + 0.07
    bars = tubes([[(x, y, -0.04), (x, y, 1.0)] for y in np.arange(y0 + 0.05, y1, 0.115)], 0.007, 8)
    posts = [
        box((x - 0.02, y - 0.02, -0.05), (x + 0.02, y + 0.02, 1.0))
        for y in (y0 + 0.03, 2.1, 3.75, 5.4, y1 - 0.03)
    ]
    rails = [
        box((x - 0.018, y0, 0.07), (x + 0.018, y1, 0.10)),
        box((x - 0.022, y0, 0.985), (x + 0.022, y1, 1.01)),
    ]
    hand = soft_box((x - 0.035, y0, 1.01), (x + 0.035, y1, 1.05), 0.012)
    return [
        Part("balcony", "stone", join([slab] + tiles)),
        Part("railing", "dark", join([bars] + posts + rails)),
        Part("railing", "walnut", hand),
    ] + planter(-1.45, 4.25, detail)


def planter(x, y, detail):
    tub = box((x - 0.15, y - 0.48, -0.035), (x + 0.15, y + 0.48, 0.36))
    rng = generator("planter")
    count = int(9000 * detail)
    size = 0.030 / np.sqrt(max(detail, 0.05)) ** 0.6
    angle, r = rng.uniform(0, 2 * np.pi, count), np.sqrt(rng.uniform(0, 1, count))
    px, py = x + 0.16 * r * np.cos(angle), y + 0.50 * r * np.sin(angle)
    top = 0.36 + (0.22 + 0.09 * waves(px, py, rng, 6, 0.15, 0.5)) * np.sqrt(1 - 0.8 * r * r)
    pz = 0.34 + (top - 0.34) * rng.uniform(0, 1, count) ** 0.4
    parts = [Part("planter", "stone", tub)]
    blades = leaves(np.stack([px, py, pz], axis=-1), size, rng)
    flower = rng.uniform(0, 1, count) < 0.10 * (pz > 0.45)
    return parts + [
        Part("planter", "leaf", pick(blades, ~flower)),
        Part("planter", "terracotta", pick(blades, flower)),
    ]


def leaves(centres, size, rng):
    """Two triangles a leaf, turned at random: a bent rhombus."""
    count = len(centres)
    axis = rng.normal(size=(2, count, 3))
    a = axis[0] / np.linalg.norm(axis[0], axis=1, keepdims=True)
    b = np.cross(a, axis[1])
    b /= np.linalg.norm(b, axis=1, keepdims=True)
    bend = np.cross(a, b) * (0.25 * size)
    s = size * rng.uniform(0.7, 1.3, (count, 1))
    v = np.stack(
        [centres - a * s, centres - b * s * 0.5 + bend, centres + a * s, centres + b * s * 0.5 + bend], axis=1
    )
    f = np.array([(0, 1, 2), (0, 2, 3)])[None] + 4 * np.arange(count)[:, None, None]
    return Mesh(v.reshape(-1, 3), f.reshape(-1, 3))


def pick(blades, chosen):
    """The leaves of which chosen is true."""
    return blades._replace(f=blades.f[np.repeat(chosen, 2)])


def tree(k, x, y, height, spread, detail):
    rng = generator(f"tree-{k}")
    t = np.linspace(0, 1, 8)
    trunk = [
        np.stack([x + 0.2 * np.sin(2 * t + k), y + 0.2 * np.cos(3 * t), GROUND + height * 0.7 * t], axis=-1)
    ]
    boughs = []
    for _ in range(9):
        heading, rise = rng.uniform(0, 2 * np.pi), rng.uniform(0.5, 0.8)
        start = trunk[0][rng.integers(3, 7)]
        tip = np.array(
            [x + 0.7 * spread * np.cos(heading), y + 0.7 * spread * np.sin(heading), GROUND + height * rise]
        )
        boughs.append(
            start + (tip - start) * t[:, None] + np.stack([0 * t, 0 * t, 0.6 * np.sin(np.pi * t)], axis=-1)
        )
    wood = join([tubes(trunk, 0.24 - 0.15 * t, 8), tubes(boughs, 0.09 - 0.07 * t, 4)])
    count = int(6000 * detail)
    # Leaves crowd on the shells of some thirty clumps.
    direction = rng.normal(size=(34, 3))
    direction /= np.linalg.norm(direction, axis=1, keepdims=True)
    radius = rng.uniform(0.35, 0.85, (34, 1))
    clumps = np.array([x, y, GROUND + height * 0.68]) + direction * radius * [spread, spread, height * 0.32]
    which = rng.integers(0, 34, count)
    offset = rng.normal(size=(count, 3))
    offset *= (
        0.34 * spread * rng.uniform(0.75, 1.05, (count, 1)) / np.linalg.norm(offset, axis=1, keepdims=True)
    )
    size = 0.11 / detail**0.35 * (spread / 2.2)
    return [
        Part("trees", "bark", wood),
        Part("trees", f"tree-{k % 2}", leaves(clumps[which] + offset, size, rng)),
    ]


def house(k, x, y, width, depth, floors):
    """Front towards +x. Windows and sills stand proud of the walls, as panels."""
    z0, storey = GROUND, 3.1
    top = z0 + floors * storey + 0.5
    a, b = y - width / 2, y + width / 2
    body, dark, pale = (
        [box((x - depth, a, z0 - 1), (x, b, top))],
        [],
        [box((x - depth - 0.3, a - 0.3, top), (x + 0.3, b + 0.3, top + 0.25))],
    )
    for floor in range(floors):
        z = z0 + floor * storey + 1.0
        for w in np.linspace(a, b, max(3, int(width / 2.4)) + 1)[:-1] + width / max(3, int(width / 2.4)) / 2:
            dark.append(box((x - 0.1, w - 0.5, z), (x + 0.03, w + 0.5, z + 1.6)))
            pale += [
                box((x - 0.1, w - 0.62, z - 0.12), (x + 0.12, w + 0.62, z)),
                box((x - 0.1, w - 0.03, z), (x + 0.05, w + 0.03, z + 1.6)),
            ]
        for w in np.arange(x - depth + 2, x - 1, 2.8):
            dark.append(box((w - 0.5, a - 0.03, z), (w + 0.5, a + 0.1, z + 1.6)))
    ridge = x - depth / 2
    v = np.array(
        [
            (x + 0.4, a - 0.4, top + 0.2),
            (x + 0.4, b + 0.4, top + 0.2),
            (x - depth - 0.4, b + 0.4, top + 0.2),
            (x - depth - 0.4, a - 0.4, top + 0.2),
            (ridge, a + 1.5, top + 3.2),
            (ridge, b - 1.5, top + 3.2),
        ]
    )
    f = np.array([(0, 1, 5), (0, 5, 4), (2, 3, 4), (2, 4, 5), (3, 0, 4), (1, 2, 5), (0, 3, 2), (0, 2, 1)])
    return [
        Part("houses", f"facade-{k % 3}", join(body)),
        Part("houses", "window-dark", join(dark)),
        Part("houses", "stone", join(pale)),
        Part("houses", "roof", Mesh(v, f)),
    ]


def land():
    # Centred on the room: importers that shift a scene to its middle then keep the room's coordinates precise.
    ground = box((-217, -217, GROUND - 1), (223, 223, GROUND))
    street = box((-24, -217, GROUND - 0.5), (-15, 223, GROUND + 0.02))
    y = np.linspace(-20, 222, 60)
    crest = GROUND + 18 + 6 * waves(y / 110, 0 * y, generator("hill"), 6, 0.5, 2.5)
    foot, brow = np.full_like(y, -168), np.full_like(y, -214)
    low, high = np.stack([foot, y, 0 * y + GROUND], axis=-1), np.stack([brow, y, crest], axis=-1)
    hill = smooth(grid(np.stack([low, (low + high) / 2 + [0, 0, 2], high], axis=1)))
    return [Part("land", "lawn", ground), Part("land", "street", street), Part("land", "hill", hill)]


def exterior(detail):
    parts = balcony(detail) + land()
    for k, place in enumerate(HOUSES):
        parts += house(k, *place)
    for k, place in enumerate(TREES):
        parts += tree(k, *place, detail)
    return parts
