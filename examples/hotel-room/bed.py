# SPDX-License-Identifier: Apache-2.0
"""The bed: frame, channelled headboard, mattress, draped duvet, pillows and a throw woven from real yarns."""

import numpy as np

from meshes import (
    creases,
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
    weld,
)
from parts import Part
from room import DEPTH

MIDDLE_X = 3.62
HALF_WIDTH = 0.90
FOOT_Y, HEAD_Y = 4.03, DEPTH - 0.10
MATTRESS_TOP = 0.56
ROUND = 0.085  # radius with which the duvet turns over the mattress' edge


# ---- Cloth over the bed ----------------------------------------------------------------------------------------


def relief(s, t):
    """Height of the duvet's folds and quilting over its smooth shape."""
    rng = generator("duvet-relief")
    z = 0.012 * waves(s, t, rng, 10, 0.5, 1.6)
    z += 0.022 * creases(s, t, rng, 70, (-1.2, 1.2, -0.4, 1.6), 0.28, 0.036, 0.6, 2.2)
    z += 0.007 * creases(s, t, rng, 120, (-1.2, 1.2, -0.4, 1.6), 0.12, 0.014)
    # The filling swells between seams 30 cm apart.
    return z + 0.016 * np.abs(np.sin(np.pi * s / 0.31) * np.sin(np.pi * (t + 0.05) / 0.33)) ** 0.7


def draped(s, t, lift=0.0):
    """Points of a sheet on the bed, `lift` above it along its normal; shape s.shape + (3,).

    Coordinates on the cloth: s across, 0 in the middle; t along, 0 at the foot's edge. What reaches over the edge
    turns down with the radius ROUND, hangs, flares and folds.
    """
    w = HALF_WIDTH - 0.035
    flat_s, flat_t = np.clip(s, -w, w), np.maximum(t, 0)
    over_s, over_t = s - flat_s, t - flat_t
    r = np.hypot(over_s, over_t)
    out_s, out_t = over_s / np.maximum(r, 1e-9), over_t / np.maximum(r, 1e-9)
    bend = np.minimum(r / ROUND, np.pi / 2)
    below = np.maximum(r - ROUND * np.pi / 2, 0)
    side = np.arctan2(np.abs(out_s), np.abs(out_t)) * 2 / np.pi  # 1 at the sides, 0 at the foot
    corner = np.sin(np.pi * side) * (r > 0)
    around = flat_s + np.sign(s) * (0.25 * side * (r > 0) + flat_t)
    hang = np.minimum(below / 0.25, 1)
    folds = waves(around, 0.15 * r, generator("duvet-hang"), 8, 0.16, 0.6)
    reach = ROUND * np.sin(bend) + 0.10 * below + hang * (0.020 * folds + 0.05 * corner)
    drop = ROUND * (1 - np.cos(bend)) + 0.985 * below
    normal = np.stack([out_s * np.sin(bend), out_t * np.sin(bend), np.cos(bend)], axis=-1)
    base = np.stack(
        [
            MIDDLE_X + flat_s + out_s * reach,
            FOOT_Y + 0.02 + flat_t + out_t * reach,
            MATTRESS_TOP + 0.045 - drop,
        ],
        axis=-1,
    )
    return base + (lift + relief(s, t) * (1 - 0.6 * hang))[..., None] * normal


def duvet(detail):
    s, t = np.meshgrid(
        np.linspace(-1.24, 1.24, steps(420, detail)),
        np.linspace(-0.36, 1.42, steps(300, detail)),
        indexing="ij",
    )
    sheet = smooth(grid(draped(s, t)))
    # The turned-down end: a flat roll of cloth across the bed.
    s, turn = np.meshgrid(
        np.linspace(-1.19, 1.19, steps(320, detail)),
        np.linspace(0, 2 * np.pi, steps(90, detail), endpoint=False),
        indexing="ij",
    )
    flat = lambda c, power: np.sign(c) * np.abs(c) ** power
    t = 1.30 + 0.17 * flat(np.cos(turn), 0.7)
    lift = 0.028 + 0.030 * flat(np.sin(turn), 0.8) * (1 - 0.25 * np.cos(turn))
    roll = smooth(grid(draped(s, t, lift)[:, ::-1], wrap_v=True))
    return [Part("duvet", "linen", sheet), Part("duvet", "linen", roll)]


def throw(detail):
    """A blanket woven from yarns of 10 mm: warp and weft pass over and under each other; fringes at both ends."""
    s0, s1, t0, t1 = -1.17, 1.17, 0.10, 0.66
    pitch = 0.0125 / min(1, detail) ** 0.4  # coarser yarn where triangles are few
    radius = 0.4 * pitch
    per_crossing, sides = (4, 5) if detail >= 0.5 else (2, 4)
    columns, rows = int((s1 - s0) / pitch), int((t1 - t0) / pitch)
    base = 0.012 + 2 * radius

    def yarns(count, start, length_count, along_s, phase):
        k = np.arange(count)[:, None]
        m = np.arange(length_count * per_crossing + 1)[None, :] / per_crossing
        fixed, running = start[0] + (k + 0.5) * pitch + 0 * m, start[1] + (m + 0 * k) * pitch
        lift = base + 0.85 * radius * np.cos(np.pi * (m - 0.5 + k + phase))
        s, t = (running, fixed) if along_s else (fixed, running)
        return draped(s, t, lift)

    weft = yarns(rows, (t0, s0), columns, True, 0)
    warp = yarns(columns, (s0, t0), rows, False, 1)
    stripe = np.isin(np.arange(rows) * 18 // rows, (12, 14, 16))
    rng = generator("fringe")
    strands = []
    for end, sign in ((s0, -1), (s1, 1)):
        t = np.linspace(t0 + pitch, t1 - pitch, rows * 2)[:, None]
        run = np.linspace(0, 0.085, 7)[None, :]
        sway = rng.normal(0, 0.012, t.shape) * (run / 0.085) ** 2
        strands.append(
            draped(
                end + sign * run + 0 * t, t + sway, base + 0 * t + rng.normal(0, 0.003, t.shape) * run / 0.05
            )
        )
    return [
        Part("throw", "mustard", tubes(weft[~stripe], radius, sides)),
        Part("throw", "cream", tubes(weft[stripe], radius, sides)),
        Part("throw", "mustard", tubes(warp, radius, sides)),
        Part("throw", "mustard", tubes(np.concatenate(strands), 0.0026, 4)),
    ]


# ---- Pillows ---------------------------------------------------------------------------------------------------


def pillow(name, width, height, thickness, detail, cells=90):
    """Closed cushion standing in the xz plane, centred, its front towards −y; pinched at the seam and corners."""
    rng = generator(name)
    k = steps(cells, detail)
    across = np.sin(np.linspace(-np.pi / 2, np.pi / 2, k))
    u, v = np.meshgrid(across, across, indexing="ij")
    swell = ((1 - u**4) * (1 - v**4)) ** 0.55
    relief = 0.05 * waves(u, v, rng, 8, 0.8, 2.5) + 0.06 * creases(u, v, rng, 22, (-1, 1, -1, 1), 0.35, 0.06)
    x = width / 2 * u * (1 - 0.07 * (1 - v**2) * u**2)
    z = height / 2 * v * (1 - 0.09 * (1 - u**2) * v**2)
    z = z + 0.015 * height * (1 - v) * waves(u, 0 * v, rng, 4, 0.9, 2.0)
    front = np.stack([x, -thickness / 2 * swell * (1 + relief), z], axis=-1)
    back = np.stack([x, thickness / 2 * swell, z], axis=-1)
    return smooth(weld(join([grid(front), grid(back[::-1])])))


def striped(mesh, bands):
    """Splits a pillow's faces by the height of their middle: bands of (from, to) in z form the second part."""
    z = mesh.v[mesh.f].mean(axis=1)[:, 2]
    inside = np.any([(z >= a) & (z < b) for a, b in bands], axis=0)
    return mesh._replace(f=mesh.f[~inside]), mesh._replace(f=mesh.f[inside])


def pillows(detail):
    parts = []
    top = MATTRESS_TOP + 0.02
    for k, side in enumerate((-1, 1)):
        back = pillow(f"pillow-back-{k}", 0.78, 0.56, 0.22, detail)
        parts.append(
            Part(
                "pillows",
                "sheet",
                moved(turned(back, -14, "x"), (MIDDLE_X + side * 0.44, HEAD_Y - 0.16, top + 0.27)),
            )
        )
        front = turned(turned(pillow(f"pillow-front-{k}", 0.74, 0.48, 0.21, detail), -38, "x"), side * 3)
        parts.append(
            Part("pillows", "sheet", moved(front, (MIDDLE_X + side * 0.43, HEAD_Y - 0.36, top + 0.20)))
        )
        square = turned(turned(pillow(f"cushion-{k}", 0.46, 0.46, 0.20, detail), -30, "x"), side * -9)
        parts.append(
            Part("cushions", "velvet", moved(square, (MIDDLE_X + side * 0.34, HEAD_Y - 0.54, top + 0.225)))
        )
    small = pillow("cushion-small", 0.50, 0.30, 0.17, detail, 140)
    plain, bands = striped(small, [(a, a + 0.022) for a in (-0.10, -0.055, 0.033, 0.078)])
    for mesh, material in ((plain, "cream"), (bands, "terracotta")):
        parts.append(
            Part(
                "cushions",
                material,
                moved(turned(mesh, -30, "x"), (MIDDLE_X + 0.02, HEAD_Y - 0.74, top + 0.165)),
            )
        )
    return parts


# ---- What carries it -------------------------------------------------------------------------------------------


def frame():
    x0, x1 = MIDDLE_X - HALF_WIDTH, MIDDLE_X + HALF_WIDTH
    base = soft_box((x0, FOOT_Y, 0.10), (x1, HEAD_Y, 0.34), 0.025)
    mattress = soft_box((x0 + 0.01, FOOT_Y + 0.01, 0.33), (x1 - 0.01, HEAD_Y, MATTRESS_TOP + 0.02), 0.06, 5)
    legs = [lathe(rounded([(0, 0), (0.022, 0), (0.03, 0.11), (0, 0.11)], 0.004), 20)] * 4
    places = [(x, y, 0) for x in (x0 + 0.10, x1 - 0.10) for y in (FOOT_Y + 0.10, HEAD_Y - 0.2)]
    legs = join([moved(leg, place) for leg, place in zip(legs, places)])
    return [
        Part("bed-base", "upholstery", base),
        Part("mattress", "sheet", mattress),
        Part("bed-legs", "walnut", legs),
    ]


def headboard(detail):
    """Upright channels of velvet between seams, in a walnut frame."""
    width, z0, z1, y, channels = 2.30, 0.30, 1.28, DEPTH, 15
    rng = generator("headboard")
    pitch = width / channels
    pads = []
    for k in range(channels):
        u, v = np.meshgrid(
            np.linspace(-1, 1, steps(44, detail)), np.linspace(-1, 1, steps(60, detail)), indexing="ij"
        )
        swell = ((1 - u**2) * (1 - np.abs(v) ** 14)) ** 0.5
        x = MIDDLE_X + width * ((k + 0.5) / channels - 0.5) + pitch / 2 * u
        z = (z0 + z1) / 2 + (z1 - z0) / 2 * v
        depth = 0.045 + 0.05 * swell * (1 + 0.05 * waves(u, 4 * v, rng, 5, 1, 4))
        pads.append(smooth(grid(np.stack([x, y - depth, z], axis=-1))))
    a, b = MIDDLE_X - width / 2, MIDDLE_X + width / 2
    rails = [
        soft_box((a - 0.05, y - 0.085, 0.02), (a, y + 0.005, z1 + 0.045), 0.006),
        soft_box((b, y - 0.085, 0.02), (b + 0.05, y + 0.005, z1 + 0.045), 0.006),
        soft_box((a - 0.05, y - 0.085, z1), (b + 0.05, y + 0.005, z1 + 0.045), 0.006),
    ]
    return [Part("headboard", "velvet", join(pads)), Part("headboard", "walnut", join(rails))]


def bed(detail):
    return frame() + headboard(detail) + duvet(detail) + throw(detail) + pillows(detail)
