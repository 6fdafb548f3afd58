# SPDX-License-Identifier: Apache-2.0
"""The ground of a block, with the roads to its left and below it, and what stands on them."""

from typing import NamedTuple

import numpy as np

from layout import SIDEWALK
from meshes import Mesh, Parts, grid, level, rectangle, rings, rotations
from props import CAR_COLOURS, CAR_SHAPES

KERB = 0.15  # height of the sidewalks
TREE_SHAPES = 24
SIDE_SHAPES, SIDE_STEP = 3, 4  # of each length, in steps of metres
GROVE_SHAPES, GROVE = 8, 6  # trees in one


class Standing(NamedTuple):
    """Something that may be instanced: degrees about z."""

    kind: str  # tree, lamp, car; a group of them: side (of a block), grove
    variant: int
    x: float
    y: float
    z: float
    degrees: float


def ground(block, last_column, last_row):
    parts = Parts()
    x0, y0, x1, y1 = block.x0, block.y0, block.x1, block.y1
    right, above = (13 if last_column else 0), (13 if last_row else 0)
    parts.add("asphalt", level(x0 - block.left, y0 - block.below, x1 + right, y1 + above, 0))
    shrunk = lambda d, z: rectangle(x0 + d, y0 + d, x1 - d, y1 - d, z)
    parts.add("kerb", rings([shrunk(0, 0), shrunk(0.02, KERB), shrunk(0.3, KERB)]))
    parts.add("paving", rings([shrunk(0.3, KERB), shrunk(SIDEWALK, KERB)]))
    inner = "grass" if block.use in ("park", "houses") else "paving-dark" if block.use == "towers" else "gravel"
    parts.add(inner, level(x0 + SIDEWALK, y0 + SIDEWALK, x1 - SIDEWALK, y1 - SIDEWALK, KERB))
    if block.use == "park":
        _paths(parts, x0 + SIDEWALK, y0 + SIDEWALK, x1 - SIDEWALK, y1 - SIDEWALK)
    z = 0.008
    _markings(parts, x0 - block.left, x0, y0, y1, z, False)
    _markings(parts, y0 - block.below, y0, x0, x1, z, True)
    return parts


def _paths(parts, x0, y0, x1, y1):
    t = np.linspace(0, 1, 17)
    for a, b in (((x0, y0), (x1, y1)), ((x1, y0), (x0, y1))):
        middle = np.outer(1 - t, a) + np.outer(t, b)
        across = np.array([-(b[1] - a[1]), b[0] - a[0]]) / np.hypot(b[0] - a[0], b[1] - a[1])
        bend = 6 * np.sin(2 * np.pi * t)[:, None] * across
        p = np.empty((17, 2, 3))
        p[:, 0, :2], p[:, 1, :2] = middle + bend + 1.3 * across, middle + bend - 1.3 * across
        p[..., :2] = np.clip(p[..., :2], [x0, y0], [x1, y1])
        p[..., 2] = KERB + (0.02 if a[0] == x0 else 0.03)
        parts.add("gravel", grid(p[1:-1, ::-1]))


def _markings(parts, side0, side1, from_, to, z, level_road):
    """Lines and crossings of the road between side0 and side1, which runs from `from_` to `to`."""
    middle, half = 0.5 * (side0 + side1), 0.5 * (side1 - side0)
    lo, hi = [], []
    stripes = np.arange(side0 + 0.6, side1 - 0.8, 1.0)  # crossings
    for end in (from_ + 1.0, to - 4.0):
        lo += [(s, end) for s in stripes]
        hi += [(s + 0.5, end + 3.0) for s in stripes]
    dashes = np.arange(from_ + 7, to - 9, 6.0)
    lines = [middle - 0.06] if half < 9 else [middle - 0.2, middle + 0.08, middle - 4.0, middle + 3.88]
    for k, line in enumerate(lines):
        if half >= 9 and k < 2:  # a double line parts the two directions of an avenue
            lo.append((line, from_ + 6)), hi.append((line + 0.12, to - 6))
        else:
            lo += [(line, d) for d in dashes]
            hi += [(line + 0.12, d + 2.5) for d in dashes]
    halves = (side0 + 0.3, middle - 0.3), (middle + 0.3, side1 - 0.3)
    for stop, (a, b) in zip((from_ + 5.0, to - 5.4), halves[::-1] if level_road else halves):  # lines to stop at
        lo.append((a, stop)), hi.append((b, stop + 0.35))
    lo, hi = np.array(lo), np.array(hi)
    v = np.empty((len(lo), 4, 3))
    v[:, 0, :2], v[:, 2, :2] = lo, hi
    v[:, 1, 0], v[:, 1, 1], v[:, 3, 0], v[:, 3, 1] = hi[:, 0], lo[:, 1], lo[:, 0], hi[:, 1]
    if level_road:
        v[..., :2] = v[:, ::-1, 1::-1]
    v[..., 2] = z
    f = np.array([[0, 1, 2], [0, 2, 3]], np.int32) + (4 * np.arange(len(lo), dtype=np.int32))[:, None, None]
    parts.add("marking", Mesh(v.reshape(-1, 3), f.reshape(-1, 3)))


def standing(block, size, seed, nested):
    """Trees, lamps and cars of a block and its roads; `nested`: in groups."""
    rng = np.random.default_rng([seed, 6, *block.index])
    out = []
    x0, y0, x1, y1 = block.x0, block.y0, block.x1, block.y1
    # Each side of the kerb: a corner, the direction along it, the direction out to the road.
    sides = [((x0, y0), (1, 0), (0, -1), x1 - x0), ((x1, y0), (0, 1), (1, 0), y1 - y0),
             ((x1, y1), (-1, 0), (0, 1), x1 - x0), ((x0, y1), (0, -1), (-1, 0), y1 - y0)]  # fmt: skip
    for (cx, cy), (ax, ay), outwards, length in sides:
        if nested:
            whole = int(length) // SIDE_STEP * SIDE_STEP
            start = 0.5 * (length - whole)
            variant = 10 * whole + int(rng.integers(SIDE_SHAPES))
            turn = float(np.degrees(np.arctan2(ay, ax)))
            out.append(Standing("side", variant, cx + ax * start, cy + ay * start, 0.0, turn))
        else:
            out += _side(rng, size, (cx, cy), (ax, ay), outwards, length)
    count, inset = {"park": (70, 6), "houses": (18, 20), "perimeter": (6, 24)}.get(block.use, (0, 0))
    area = x0 + inset, y0 + inset, x1 - inset, y1 - inset
    if nested:
        out += _scattered(rng, "grove", round(count * size.busy / GROVE), GROVE_SHAPES, 0.0, *area)
    elif count:
        out += _scattered(rng, "tree", int(count * size.busy), TREE_SHAPES, KERB, *area)
    return out


def members(group, size, seed):
    """What a side of a block or a grove consists of, around its own origin."""
    rng = np.random.default_rng([seed, 8, group.variant])
    if group.kind == "side":
        return _side(rng, size, (0, 0), (1, 0), (0, -1), group.variant // 10)
    return _scattered(rng, "tree", GROVE, TREE_SHAPES, KERB, -6, -6, 6, 6)


def placed(group, thing):
    """A member of a group where the group stands."""
    turn = rotations([group.degrees])[0]
    x, y, z = turn @ (thing.x, thing.y, thing.z) + (group.x, group.y, group.z)
    return thing._replace(x=float(x), y=float(y), z=float(z), degrees=thing.degrees + group.degrees)


def _side(rng, size, corner, along, outwards, length):
    out = []
    (cx, cy), (ax, ay), (ox, oy) = corner, along, outwards
    heading = float(np.degrees(np.arctan2(-ay, -ax)))  # traffic keeps to the right
    outward = float(np.degrees(np.arctan2(oy, ox)))

    def at(s, out_by):
        return cx + ax * s + ox * out_by, cy + ay * s + oy * out_by

    for s in np.arange(9.0, length - 8, 10.0 / size.busy):
        x, y = at(s + rng.uniform(-0.5, 0.5), -1.1)
        out.append(Standing("tree", int(rng.integers(TREE_SHAPES)), x, y, KERB, float(rng.uniform(0, 360))))
    for s in np.arange(4.5, length - 4, 27.0 if size.busy > 0.5 else 40.0):
        out.append(Standing("lamp", 0, *at(s, -0.5), KERB, outward))
    for s in np.arange(10.0, length - 11, 6.2):
        if rng.random() < 0.5 * size.busy:
            out.append(_car(rng, *at(s + rng.uniform(-0.4, 0.4), 1.25), heading))
        if rng.random() < 0.1 * size.busy:
            out.append(_car(rng, *at(s, 4.1), heading))
    return out


def _car(rng, x, y, heading):
    shape = rng.choice(CAR_SHAPES, p=[0.5, 0.35, 0.15])
    return Standing("car", int(shape * len(CAR_COLOURS) + rng.integers(len(CAR_COLOURS))), x, y, 0.0, heading)


def _scattered(rng, kind, count, shapes, z, x0, y0, x1, y1):
    if x1 <= x0 or y1 <= y0:
        return []
    variants = rng.integers(shapes, size=count)
    places = rng.uniform((x0, y0), (x1, y1), (count, 2))
    return [Standing(kind, int(k), float(x), float(y), z, 0.0) for k, (x, y) in zip(variants, places)]
