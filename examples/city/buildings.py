# SPDX-License-Identifier: Apache-2.0
"""Designs of buildings, and their construction within a budget of triangles.

A building stands on its lot with the front along y = 0 facing −y, x in [0, width], y in [0, depth].
"""

from typing import NamedTuple

import numpy as np

from facades import Look, Wall, facade
from meshes import Parts, box, level, quad, rectangle, rings
from roofs import awning, flat_roof, gable_roof, mansard_roof

BRICKS = ("brick-0", "brick-1", "brick-2", "stucco-0", "stucco-1", "stucco-2", "stone-0", "stone-1")
SLABS = ("concrete", "stucco-2", "stone-1", "panel-0", "panel-1")
FRAMES = ("frame-white", "frame-dark", "frame-green")


class Lot(NamedTuple):
    """open_left, open_right: those sides have windows; else they touch a neighbour."""

    kind: str  # masonry, slab, tower, house
    width: float
    depth: float
    floors: int
    open_left: bool
    open_right: bool
    bay: float  # width of a window's cell
    busy: float  # share of the equipment that roofs have room for


class Design(NamedTuple):
    lot: Lot
    walls: list
    blind: list  # (x0, y0, x1, y1, z0, z1, material) of walls without windows
    roofs: list  # calls that add parts: (function, arguments)

    def cells(self):
        return sum(wall.cells() for wall in self.walls)


def _four_sides(x0, y0, x1, y1):
    """Start, heading and length of the walls of a rectangle: front, right, back, left."""
    return [
        ((x0, y0), 0.0, x1 - x0),
        ((x1, y0), np.pi / 2, y1 - y0),
        ((x1, y1), np.pi, x1 - x0),
        ((x0, y1), -np.pi / 2, y1 - y0),
    ]


def _storeys(design, rect, z0, floors, storey, look, bay, sides=(True,) * 4, balconies=0):
    material = look.wall
    for k, ((x, y), heading, length) in enumerate(_four_sides(*rect)):
        if sides[k]:
            bays = max(int(round(length / bay)), 1)
            every = balconies if k in (0, 2) else 0
            design.walls.append(Wall((x, y, z0), heading, length, bays, floors, storey, look, every))
        else:
            dx, dy = round(np.cos(heading)) * length, round(np.sin(heading)) * length
            design.blind.append((x, y, x + dx, y + dy, z0, z0 + floors * storey, material))


def _sides(lot):
    return (True, lot.open_right, True, lot.open_left)


def masonry(rng, lot):
    design = Design(lot, [], [], [])
    wall, frame = BRICKS[rng.integers(len(BRICKS))], FRAMES[rng.integers(3)]
    trim = ("stone-0", "stone-1", "stucco-1")[rng.integers(3)]
    storey, ground = rng.uniform(3.1, 3.7), rng.uniform(4.0, 4.8)
    look = Look(
        wall, trim, frame, rng.uniform(0.36, 0.5), rng.uniform(0.65, 0.95), rng.uniform(0.78, 0.86),
        rng.uniform(0.16, 0.3), 1, int(rng.integers(0, 3)), rng.uniform(0.6, 1.0), rng.random() < 0.7,
    )  # fmt: skip
    shop = Look(trim, "metal", "frame-dark", 0.84, 0.4, 0.76, 0.25, int(rng.integers(1, 3)), 0)
    rect = (0, 0, lot.width, lot.depth)
    _storeys(design, rect, 0, 1, ground, shop, 1.25 * lot.bay, _sides(lot))
    balconies = int(rng.integers(0, 4)) if rng.random() < 0.6 else 0
    _storeys(design, rect, ground, lot.floors - 1, storey, look, lot.bay, _sides(lot), balconies)
    top = ground + (lot.floors - 1) * storey
    design.roofs.append((_courses, (rect, [ground, ground + storey * (lot.floors - 2), top], trim)))
    if rng.random() < 0.75:
        design.roofs.append((awning, (rng.integers(1 << 30), lot.width, ground, lot.bay * 1.25)))
    roof = mansard_roof if rng.random() < 0.35 else flat_roof
    design.roofs.append((roof, (rng.integers(1 << 30), rect, top, wall, trim, lot.busy)))
    return design


def _courses(parts, rect, heights, trim):
    """Projecting bands around the walls: a string course, and a stepped cornice at the last height."""
    for k, z in enumerate(heights):
        last = k == len(heights) - 1
        profile = [(0, -0.7), (0.12, -0.6), (0.12, -0.35), (0.5, -0.15), (0.5, 0.0), (0, 0.02)] if last else [
            (0, -0.3), (0.12, -0.27), (0.12, -0.05), (0, 0.0)]  # fmt: skip
        x0, y0, x1, y1 = rect  # only forwards and backwards: the sides may touch a neighbour
        loops = [rectangle(x0, y0 - out, x1, y1 + out, z + up) for out, up in profile]
        parts.add(trim, rings(loops))


def slab(rng, lot):
    """A modern block with long balconies, whose upper storeys stand back."""
    design = Design(lot, [], [], [])
    wall = SLABS[rng.integers(len(SLABS))]
    storey, ground = rng.uniform(2.9, 3.2), 4.2
    look = Look(
        wall, "concrete", "frame-dark", rng.uniform(0.6, 0.8), rng.uniform(0.12, 0.7), 0.84, 0.14,
        1, 0, rng.uniform(1.1, 1.6),
    )  # fmt: skip
    lobby = Look("stone-1", "metal", "frame-dark", 0.9, 0.2, 0.8, 0.2, 2, 0)
    rect = (0, 0, lot.width, lot.depth)
    back = int(rng.integers(0, 3)) if lot.floors > 5 else 0
    _storeys(design, rect, 0, 1, ground, lobby, 1.4 * lot.bay, _sides(lot))
    full = lot.floors - 1 - back
    _storeys(design, rect, ground, full, storey, look, 1.15 * lot.bay, _sides(lot), int(rng.integers(1, 3)))
    top = ground + full * storey
    design.roofs.append((flat_roof, (rng.integers(1 << 30), rect, top, wall, "concrete", 0 if back else lot.busy)))
    if back:
        upper = (0.8, 2.2, lot.width - 0.8, lot.depth - 2.2)
        _storeys(design, upper, top, back, storey, look._replace(balcony=0.0), 1.15 * lot.bay)
        top += back * storey
        design.roofs.append((flat_roof, (rng.integers(1 << 30), upper, top, wall, "concrete", lot.busy)))
    return design


def tower(rng, lot):
    """A podium and tiers of curtain wall that step back as they rise."""
    design = Design(lot, [], [], [])
    metal = ("metal", "frame-dark", "panel-0", "panel-1", "stone-1")[rng.integers(5)]
    panel = ("panel-0", "panel-1", "frame-dark", "stone-1", "concrete")[rng.integers(5)]
    look = Look(metal, metal, "frame-dark", 0.92, rng.uniform(0.5, 1.1), 0.96, 0.10, int(rng.integers(1, 3)), 1,
                spandrel=panel)  # fmt: skip
    if rng.random() < 0.4:  # piers of stone
        stone = ("stone-0", "stone-1", "brick-0", "concrete")[rng.integers(4)]
        look = look._replace(wall=stone, width=0.62, reveal=0.3)
    lobby = Look("stone-1", "metal", "frame-dark", 0.92, 0.15, 0.9, 0.2, 2, 1)
    storey = rng.uniform(3.5, 4.0)
    rect = (0, 0, lot.width, lot.depth)
    _storeys(design, rect, 0, 1, 6.0, lobby, 1.6 * lot.bay)
    podium = int(rng.integers(2, 6))
    z, left = 6.0, lot.floors - 1
    tiers = [podium] + [int(round(left * share)) for share in np.diff([0, *np.sort(rng.uniform(0.45, 1, 2)), 1])]
    for k, floors in enumerate(tiers):
        floors = min(floors, left)
        if floors < 1:
            continue
        left -= floors
        _storeys(design, rect, z, floors, storey, look, 1.05 * lot.bay)
        z += floors * storey
        last = left < 1
        busy = lot.busy if last else 0
        design.roofs.append((flat_roof, (rng.integers(1 << 30), rect, z, look.wall, metal, busy, last)))
        if last:
            break
        inset = rng.uniform(2.0, 4.5) if k == 0 else rng.uniform(0.8, 2.8)
        slim = min(rect[2] - rect[0], rect[3] - rect[1]) - 2 * inset
        if slim > 12:
            rect = (rect[0] + inset, rect[1] + inset, rect[2] - inset, rect[3] - inset)
    return design


def house(rng, lot):
    design = Design(lot, [], [], [])
    wall, frame = BRICKS[rng.integers(len(BRICKS))], FRAMES[rng.integers(2)]
    look = Look(wall, "stone-0", frame, rng.uniform(0.36, 0.46), 0.8, 0.8, 0.14, 1, 1, surround=rng.random() < 0.4)
    storey = rng.uniform(2.8, 3.1)
    rect = (0, 0, lot.width, lot.depth)
    design.roofs.append((_plinth, (rect,)))
    _storeys(design, rect, 0.5, lot.floors, storey, look, lot.bay, _sides(lot))
    top = 0.5 + lot.floors * storey
    design.roofs.append((gable_roof, (rng.integers(1 << 30), rect, top, wall)))
    return design


def _plinth(parts, rect):
    x0, y0, x1, y1 = rect
    parts.add("stone-0", rings([rectangle(x0, y0 - 0.06, x1, y1 + 0.06, z) for z in (0, 0.5)] +
                               [rectangle(x0, y0, x1, y1, 0.52)]))  # fmt: skip
    door = 0.5 * (x0 + x1)
    parts.add("stone-0", box((door - 0.9, -1.0, 0), (door + 0.9, 0, 0.25)))
    parts.add("stone-0", box((door - 0.9, -0.55, 0.25), (door + 0.9, 0, 0.5)))


KINDS = {"masonry": masonry, "slab": slab, "tower": tower, "house": house}


def design(seed, lot):
    """seed: a list of integers."""
    return KINDS[lot.kind](np.random.default_rng([*seed, 1]), lot)


def build(seed, plan, budget):
    """The building in about `budget` triangles: what its windows do not need is found first."""
    parts = Parts()
    for x0, y0, x1, y1, z0, z1, material in plan.blind:
        parts.add(material, quad((x0, y0, z0), (x1, y1, z0), (x1, y1, z1), (x0, y0, z1)))
    for function, arguments in plan.roofs:
        function(parts, *arguments)
    x0, y0, x1, y1 = 0.3, 0.3, plan.lot.width - 0.3, plan.lot.depth - 0.3
    parts.add("concrete", level(x0, y0, x1, y1, 0.05))
    rng = np.random.default_rng([*seed, 2])
    left, cells = budget - parts.triangles, plan.cells()
    for wall in plan.walls:
        before = parts.triangles
        facade(parts, rng, wall, max(left / cells, 0))
        left -= parts.triangles - before
        cells -= wall.cells()
    return parts
