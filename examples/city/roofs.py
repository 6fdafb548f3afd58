# SPDX-License-Identifier: Apache-2.0
"""Roofs and what stands on them. Every function adds to `parts` what a seed decides."""

import numpy as np

from meshes import Mesh, box, boxes, lathe, level, quad, rectangle, rings, tile, tubes


def awning(parts, seed, width, ground, bay):
    rng = np.random.default_rng(seed)
    count = max(int(round(width / bay)), 1)
    step, z = width / count, 0.80 * ground
    for k in np.nonzero(rng.random(count) < 0.6)[0]:
        x0, x1, out = k * step + 0.15, (k + 1) * step - 0.15, 1.3
        p = np.array([[(x, 0.02, z), (x, -out, z - 0.55), (x, -out, z - 0.8)] for x in (x0, x1)])
        parts.add(f"awning-{rng.integers(3)}", Mesh(p.reshape(-1, 3), np.array(
            [[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4], [0, 2, 1], [3, 4, 5]], np.int32)))  # fmt: skip


def _water_tank(parts, x, y, z):
    at = np.array([[x, y, z]])
    legs = [(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)]
    parts.add("metal", boxes([(x + a - 0.07, y + b - 0.07, z) for a, b in legs],
                             [(x + a + 0.07, y + b + 0.07, z + 2.2) for a, b in legs]))  # fmt: skip
    parts.add("wood", tile(lathe([(1.4, 2.2), (1.4, 4.9)], 14), at))
    parts.add("slate", tile(lathe([(1.55, 4.9), (0.08, 5.9)], 14), at))


def _air_conditioner(parts, rng, x, y, z):
    w, d, h = rng.uniform(1.0, 2.6), rng.uniform(1.0, 1.6), rng.uniform(0.9, 1.5)
    parts.add("panel-0", box((x - w, y - d, z + 0.15), (x + w, y + d, z + 0.15 + h)))
    parts.add("dark", tile(lathe([(0.75 * d, 0), (0.75 * d, 0.12)], 10), np.array([[x, y, z + 0.15 + h]])))


def _bulkhead(parts, x, y, z, wall):
    parts.add(wall, rings([rectangle(x - 1.8, y - 2.2, x + 1.8, y + 2.2, z + k) for k in (0, 2.9)]))
    parts.add("roofing", box((x - 2.0, y - 2.4, z + 2.9), (x + 2.0, y + 2.4, z + 3.1)))
    parts.add("metal", box((x - 0.5, y - 2.26, z), (x + 0.5, y - 2.2, z + 2.1)))


def _chimneys(parts, rng, rect, z, wall, count):
    x0, y0, x1, y1 = rect
    for _ in range(count):
        x, y, h = rng.uniform(x0 + 1, x1 - 1), rng.choice([y0 + 2.4, y1 - 2.4]), rng.uniform(1.4, 2.4)
        parts.add(wall, box((x - 0.55, y - 0.35, z), (x + 0.55, y + 0.35, z + h)))
        pots = np.array([[x + dx, y, z + h] for dx in (-0.3, 0, 0.3)])
        parts.add("tile", tile(lathe([(0.11, 0), (0.09, 0.45)], 7), pots))


def flat_roof(parts, seed, rect, z, wall, trim, busy, mast=False):
    rng = np.random.default_rng(seed)
    x0, y0, x1, y1 = rect
    t, up = 0.3, rng.uniform(0.7, 1.1)
    inner = (x0 + t, y0 + t, x1 - t, y1 - t)
    parts.add(wall, rings([rectangle(*rect, z), rectangle(*rect, z + up)]))
    parts.add(trim, rings([rectangle(*rect, z + up), rectangle(*inner, z + up), rectangle(*inner, z + 0.02)]))
    parts.add(("roofing", "gravel")[rng.integers(2)], level(*inner, z + 0.02))
    if not busy:
        return
    z += 0.02
    inside = lambda m: (rng.uniform(x0 + m, x1 - m), rng.uniform(y0 + m, y1 - m))
    cx, cy = 0.5 * (x0 + x1), 0.5 * (y0 + y1)
    if mast:
        w, d, h = 0.28 * (x1 - x0), 0.28 * (y1 - y0), rng.uniform(4, 7)
        parts.add("panel-1", rings([rectangle(cx - w, cy - d, cx + w, cy + d, z + k) for k in (0, h)]))
        parts.add("roofing", level(cx - w, cy - d, cx + w, cy + d, z + h))
        if rng.random() < 0.5:
            tall = rng.uniform(12, 30)
            path = np.array([[(cx, cy, z + h + tall * s) for s in (0, 0.5, 1)]])
            parts.add("metal", tubes(path, np.array([[0.35, 0.2, 0.05]]), 7))
    else:
        _bulkhead(parts, cx, cy, z, wall)
    for _ in range(round(busy * rng.integers(2, 6))):
        _air_conditioner(parts, rng, *inside(3.0), z)
    if rng.random() < 0.3 * busy and not mast:
        _water_tank(parts, *inside(2.5), z)
    pipes = np.array([[*inside(1.2), z] for _ in range(1 + round(busy * rng.integers(1, 6)))])
    parts.add("metal", tile(lathe([(0.09, 0), (0.09, 0.8), (0.16, 0.85), (0.14, 1.0)], 6), pipes))
    if rng.random() < 0.5 * busy:
        _chimneys(parts, rng, rect, z, wall, 2)


def mansard_roof(parts, seed, rect, z, wall, trim, busy):
    rng = np.random.default_rng(seed)
    x0, y0, x1, y1 = rect
    h, back = rng.uniform(2.6, 3.2), 1.3
    material = ("slate", "tile", "copper")[rng.integers(3)]
    slope = [rectangle(*rect, z + 0.02), rectangle(x0, y0 + back, x1, y1 - back, z + h)]
    parts.add(material, rings(slope))
    middle, ridge = 0.5 * (y0 + y1), z + h + 0.9
    for a, b in ((y0 + back, 1), (y1 - back, -1)):
        p = [(x0, a, z + h), (x1, a, z + h), (x1, middle, ridge), (x0, middle, ridge)]
        parts.add("roofing", quad(*(p if b > 0 else p[::-1])))
    for x, turn in ((x0, 1), (x1, -1)):
        gable = np.array([(x, y0 + back, z + h), (x, middle, ridge), (x, y1 - back, z + h)], float)
        parts.add(wall, Mesh(gable, np.array([[0, 1, 2] if turn < 0 else [0, 2, 1]], np.int32)))
    count = max(int((x1 - x0) / 3.4), 1)
    step = (x1 - x0) / count
    for k in range(count):
        x = x0 + (k + 0.5) * step
        for y, out in ((y0, -1), (y1, 1)):
            front, rear = y - out * 0.25, y - out * 1.6
            lo, hi = sorted((front, rear))
            parts.add(trim, box((x - 0.75, lo, z + 0.5), (x + 0.75, hi, z + 2.3)))
            parts.add(material, box((x - 0.9, lo - 0.12, z + 2.3), (x + 0.9, hi, z + 2.42)))
            at = front + out * 0.02
            pane = [(x - 0.5, at, z + 0.8), (x + 0.5, at, z + 0.8), (x + 0.5, at, z + 2.1), (x - 0.5, at, z + 2.1)]
            parts.add("dark-glass", quad(*(pane if out < 0 else pane[::-1])))
    _chimneys(parts, rng, rect, z + h - 0.6, wall, round(2 * busy))


def gable_roof(parts, seed, rect, z, wall):
    """The ridge runs along x."""
    rng = np.random.default_rng(seed)
    x0, y0, x1, y1 = rect
    eave, over, t, pitch = 0.5, 0.35, 0.14, rng.uniform(0.6, 0.85)
    middle = 0.5 * (y0 + y1)
    ridge = z + pitch * (middle - y0)
    low = z - pitch * eave
    material = ("tile", "slate", "tile-brown")[rng.integers(3)]
    for edge in (y0 - eave, y1 + eave):
        section = [(edge, low), (middle, ridge), (middle, ridge + t), (edge, low + t)]
        section = section if edge > middle else section[::-1]
        ends = [[(x, y, h) for y, h in section] for x in (x1 + over, x0 - over)]
        parts.add(material, rings(ends))
        parts.add(material, quad(*ends[0][::-1]))
        parts.add(material, quad(*ends[1]))
    for x, front in ((x0, False), (x1, True)):
        corners = np.array([(x, y0, z), (x, y1, z), (x, middle, ridge)])
        parts.add(wall, Mesh(corners, np.array([[0, 1, 2] if front else [0, 2, 1]], np.int32)))
    _chimneys(parts, rng, (x0, middle - 3.5, x1, middle + 3.5), ridge - 1.2, "brick-1", 1)
    for x in (x0 + 0.3 * (x1 - x0), x0 + 0.7 * (x1 - x0)):  # skylights
        y = y0 + 0.45 * (middle - y0)
        corners = ((-0.4, 0), (0.4, 0), (0.4, 1.0), (-0.4, 1.0))
        p = [(x + a, y + b, z + pitch * (y + b - y0) + t + 0.03) for a, b in corners]
        parts.add("dark-glass", quad(*p))
