# SPDX-License-Identifier: Apache-2.0
"""Furniture: bedside tables, desk and chair, armchair, luggage bench, suitcase, low table."""

import numpy as np

from bed import MIDDLE_X, pillow
from meshes import (
    box,
    generator,
    grid,
    join,
    lathe,
    moved,
    rounded,
    smooth,
    soft_box,
    steps,
    tubes,
    turned,
    waves,
)
from lamps import bedside_lamp, pendant, softbox
from parts import Part
from room import DEPTH


def leg(x, y, height, top=0.022, foot=0.013, lean=(0, 0)):
    """A round tapered leg; `lean` is how far its foot stands out."""
    t = np.linspace(0, 1, 6)
    path = np.stack([x + lean[0] * (1 - t), y + lean[1] * (1 - t), height * t], axis=-1)
    return tubes([path], foot + (top - foot) * t, 14)


def moved_all(parts, turn, place):
    """The parts turned about z by degrees, then moved."""
    return [p._replace(mesh=moved(turned(p.mesh, turn), place)) for p in parts]


# ---- Beside the bed --------------------------------------------------------------------------------------------


def bedside(x):
    y0, y1, w = DEPTH - 0.46, DEPTH - 0.02, 0.25
    carcass = [
        soft_box((x - w, y0, 0.50), (x + w, y1, 0.525), 0.006),
        soft_box((x - w + 0.01, y0 + 0.01, 0.30), (x + w - 0.01, y1, 0.505), 0.006),
    ]
    drawer = soft_box((x - w + 0.025, y0 - 0.004, 0.318), (x + w - 0.025, y0 + 0.02, 0.488), 0.004)
    legs = [
        leg(x + a * (w - 0.05), y, 0.31, lean=(a * 0.03, b * 0.02))
        for a in (-1, 1)
        for y, b in ((y0 + 0.06, -1), (y1 - 0.08, 1))
    ]
    knob = moved(
        lathe(rounded([(0, -0.012), (0.008, -0.012), (0.015, 0.006), (0.012, 0.014), (0, 0.014)], 0.004), 20),
        (0, 0, 0),
    )
    knob = moved(turned(knob, 90, "x"), (x, y0 - 0.012, 0.403))
    return [
        Part("bedsides", "walnut", join(carcass + legs)),
        Part("bedsides", "walnut-light", drawer),
        Part("bedsides", "brass", knob),
    ] + bedside_lamp(x, DEPTH - 0.25, 0.525)


# ---- Seats -----------------------------------------------------------------------------------------------------


def cushion(lo, hi, radius, swell, detail, name, cells=26):
    """A soft box whose top and front bulge."""
    mesh = soft_box(lo, hi, radius, 3, steps(cells, detail))
    lo, hi = np.asarray(lo), np.asarray(hi)
    c = 2 * (mesh.v - lo) / (hi - lo) - 1
    rng = generator(name)
    bulge = np.stack(
        [(1 - c[:, (k + 1) % 3] ** 2) * (1 - c[:, (k + 2) % 3] ** 2) * c[:, k] for k in range(3)], axis=1
    )
    relief = 1 + 0.25 * waves(mesh.v[:, 0], mesh.v[:, 1] + mesh.v[:, 2], rng, 8, 0.12, 0.5)
    return smooth(mesh._replace(v=mesh.v + swell * bulge.clip(-1, 1) * relief[:, None]))


def armchair(place, degrees, detail):
    """Faces −y before it is turned."""
    seat = cushion((-0.27, -0.36, 0.27), (0.27, 0.26, 0.43), 0.05, 0.028, detail, "seat")
    back = turned(
        cushion((-0.275, 0.18, 0.36), (0.275, 0.36, 0.86), 0.065, 0.035, detail, "back"),
        -11,
        "x",
        (0, 0.27, 0.36),
    )
    arms = [
        cushion((a - 0.055, -0.36, 0.20), (a + 0.055, 0.33, 0.60), 0.048, 0.012, detail, f"arm{a}")
        for a in (-0.325, 0.325)
    ]
    rest = turned(
        cushion((-0.37, 0.26, 0.20), (0.37, 0.38, 0.83), 0.05, 0.01, detail, "rest"),
        -11,
        "x",
        (0, 0.30, 0.25),
    )
    base = soft_box((-0.36, -0.34, 0.17), (0.36, 0.34, 0.28), 0.03)
    legs = join(
        [
            leg(x, y, 0.19, 0.022, 0.012, (np.sign(x) * 0.04, np.sign(y) * 0.04))
            for x in (-0.29, 0.29)
            for y in (-0.28, 0.29)
        ]
    )
    loose = moved(
        turned(pillow("armchair-cushion", 0.42, 0.30, 0.15, detail, 70), -20, "x"), (0.02, 0.06, 0.57)
    )
    parts = [
        Part("armchair", "mustard", join([seat, back, rest, base] + arms)),
        Part("armchair", "walnut", legs),
        Part("armchair", "indigo", loose),
    ]
    return moved_all(parts, degrees, place)


def desk_chair(place, degrees):
    """Faces −y before it is turned."""
    legs = [leg(x, -0.19, 0.45, 0.017, 0.012, (np.sign(x) * 0.02, -0.02)) for x in (-0.19, 0.19)]
    t = np.linspace(0, 1, 9)
    for x in (-0.18, 0.18):
        legs.append(
            tubes(
                [
                    np.stack(
                        [
                            x + np.sign(x) * 0.02 * (1 - t),
                            0.19 + 0.10 * (t - 0.45) ** 2 + 0.05 * t * t,
                            0.86 * t,
                        ],
                        -1,
                    )
                ],
                0.015,
                12,
            )
        )
    u, v = np.meshgrid(np.linspace(-1, 1, 25), np.linspace(0, 1, 13), indexing="ij")
    slats = []
    for z in (0.58, 0.70, 0.82):
        bow = 0.06 * (1 - u**2)
        front = np.stack([0.19 * u, 0.20 + 0.05 * (z / 0.86) ** 2 + bow, z - 0.035 + 0.07 * v], axis=-1)
        slats.append(smooth(grid(front)))
        slats.append(smooth(grid((front + [0, 0.012, 0])[::-1])))
    seat = cushion((-0.22, -0.22, 0.44), (0.22, 0.21, 0.50), 0.022, 0.012, 0.1, "chair-seat", 20)
    return moved_all(
        [Part("desk-chair", "walnut", join(legs + slats)), Part("desk-chair", "upholstery", seat)],
        degrees,
        place,
    )


# ---- Desk, bench, tables ---------------------------------------------------------------------------------------


def desk(x0, x1):
    y0, y1, z = DEPTH - 0.62, DEPTH - 0.02, 0.75
    top = soft_box((x0, y0, z - 0.032), (x1, y1, z), 0.008)
    apron = [box((x0 + 0.05, y0 + 0.05, z - 0.12), (x1 - 0.05, y1 - 0.03, z - 0.03))]
    drawer = soft_box(
        ((x0 + x1) / 2 - 0.22, y0 + 0.042, z - 0.112), ((x0 + x1) / 2 + 0.22, y0 + 0.06, z - 0.038), 0.004
    )
    legs = [leg(x, y, z - 0.03, 0.024, 0.014) for x in (x0 + 0.07, x1 - 0.07) for y in (y0 + 0.07, y1 - 0.07)]
    pull = tubes(
        [[((x0 + x1) / 2 - 0.05, y0 + 0.03, z - 0.075), ((x0 + x1) / 2 + 0.05, y0 + 0.03, z - 0.075)]],
        0.006,
        10,
    )
    return [
        Part("desk", "walnut", join([top] + apron + legs)),
        Part("desk", "walnut-light", drawer),
        Part("desk", "brass", pull),
    ]


def bench(detail):
    x0, x1, y0, y1 = MIDDLE_X - 0.62, MIDDLE_X + 0.62, 3.36, 3.76
    seat = cushion((x0, y0, 0.34), (x1, y1, 0.46), 0.045, 0.012, detail, "bench", 36)
    rail = soft_box((x0 + 0.02, y0 + 0.02, 0.29), (x1 - 0.02, y1 - 0.02, 0.35), 0.008)
    legs = [
        leg(x, y, 0.30, 0.022, 0.014, (a, b))
        for x, a in ((x0 + 0.08, -0.03), (x1 - 0.08, 0.03))
        for y, b in ((y0 + 0.07, -0.02), (y1 - 0.07, 0.02))
    ]
    return [Part("bench", "leather", seat), Part("bench", "walnut", join([rail] + legs))]


def suitcase(place, degrees):
    w, d, h = 0.40, 0.24, 0.62
    body = soft_box((-w / 2, -d / 2, 0.05), (w / 2, d / 2, 0.05 + h), 0.045, 6)
    ribs = [
        soft_box((x - 0.014, -d / 2 - 0.007, 0.10), (x + 0.014, d / 2 + 0.007, h), 0.006, 2)
        for x in np.linspace(-0.14, 0.14, 6)
    ]
    wheels = [
        moved(
            turned(
                lathe(rounded([(0, -0.012), (0.028, -0.012), (0.028, 0.012), (0, 0.012)], 0.004), 20), 90, "y"
            ),
            (x, y, 0.028),
        )
        for x in (-0.15, 0.15)
        for y in (-0.08, 0.08)
    ]
    grip = tubes(
        [
            [
                (-0.08, 0.06, 0.60),
                (-0.08, 0.06, 0.93),
                (-0.06, 0.06, 0.95),
                (0.06, 0.06, 0.95),
                (0.08, 0.06, 0.93),
                (0.08, 0.06, 0.60),
            ]
        ],
        0.010,
        10,
    )
    return moved_all(
        [Part("suitcase", "ceramic", join([body] + ribs)), Part("suitcase", "dark", join(wheels + [grip]))],
        degrees,
        place,
    )


def low_table(x, y):
    top = lathe(rounded([(0, 0.385), (0.36, 0.385), (0.365, 0.41), (0, 0.41)], 0.010), 96)
    legs = [
        leg(x + 0.20 * c, y + 0.20 * s, 0.39, 0.020, 0.012, (0.10 * c, 0.10 * s))
        for c, s in ((np.cos(a), np.sin(a)) for a in np.radians([30, 150, 270]))
    ]
    return [Part("low-table", "walnut-light", moved(top, (x, y, 0))), Part("low-table", "walnut", join(legs))]


def furniture(detail):
    return (
        bedside(2.20)
        + bedside(5.02)
        + desk(0.78, 1.86)
        + desk_chair((1.33, 5.30, 0), 172)
        + armchair((1.22, 3.72, 0), 62, detail)
        + bench(detail)
        + [softbox()]
        + suitcase((5.66, 5.50, 0), 20)
        + low_table(2.18, 2.95)
        + pendant(3.0, 3.2)
    )
