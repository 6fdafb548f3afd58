# SPDX-License-Identifier: Apache-2.0
"""Walls of windows. A cell, the part of a wall around one window, is built once and tiled over the wall.

A cell's frame: x along the wall, y into the building, z up; its origin is the cell's lower left corner outside.
"""

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from meshes import Mesh, Parts, box, boxes, grid_faces, join, quad, rings, tile


class Look(NamedTuple):
    """What the windows of a wall have in common; lengths are in metres, shares are of the cell."""

    wall: str
    trim: str
    frame: str
    width: float  # of the opening, as a share
    sill: float  # its height above the floor
    head: float  # its upper edge, as a share of the storey
    reveal: float  # depth
    mullions: int  # upright bars
    transoms: int  # level bars
    balcony: float = 0.0  # depth; 0: none
    surround: bool = False
    spandrel: str = ""  # a panel below the glass of a curtain wall


class Wall(NamedTuple):
    """start: its lower left corner seen from outside; heading: radians, along it; cells are alike on a wall."""

    start: tuple
    heading: float
    length: float
    bays: int
    floors: int
    storey: float
    look: Look
    balconies: int = 0  # every so many bays; 0: none

    def cells(self):
        return self.bays * self.floors


PLAIN, RECESSED, OPEN = 10, 18, 20  # triangles of the three simplest cells
WITH_ROOM = 62  # least triangles of a cell that has more than a back wall


def _opening(w, h, look):
    half = look.width * w / 2
    return w / 2 - half, look.sill, w / 2 + half, look.head * h


def _loop(x0, z0, x1, z1, y):
    """Counter-clockwise seen from outside."""
    return [(x0, y, z0), (x1, y, z0), (x1, y, z1), (x0, y, z1)]


def _wall(w, h, look, level):
    """The wall about the opening with its reveal, and the pane."""
    parts = Parts()
    x0, z0, x1, z1 = _opening(w, h, look)
    loops = [_loop(0, 0, w, h, 0), _loop(x0, z0, x1, z1, 0)]
    depth = look.reveal if level >= RECESSED else 0
    if depth:
        loops.append(_loop(x0, z0, x1, z1, depth))
    parts.add(look.wall, rings(loops))
    parts.add("glass" if level >= OPEN else "dark-glass", quad(*_loop(x0, z0, x1, z1, depth)))
    return parts


def _frame(w, h, look):
    x0, z0, x1, z1 = _opening(w, h, look)
    t, y = 0.06, look.reveal
    ring = lambda d, y: _loop(x0 + d, z0 + d, x1 - d, z1 - d, y)
    return rings([ring(0, y - 0.04), ring(t, y - 0.04), ring(t, y + 0.03)])


def _bars(w, h, look):
    x0, z0, x1, z1 = _opening(w, h, look)
    y0, y1, t = look.reveal - 0.03, look.reveal + 0.03, 0.022
    xs = np.linspace(x0, x1, look.mullions + 2)[1:-1]
    zs = np.linspace(z0, z1, look.transoms + 2)[1:-1]
    lo = [(x - t, y0, z0) for x in xs] + [(x0, y0 + 0.005, z - t) for z in zs]
    hi = [(x + t, y1, z1) for x in xs] + [(x1, y1 - 0.005, z + t) for z in zs]
    return boxes(lo, hi)


def _surround(w, h, look):
    x0, z0, x1, z1 = _opening(w, h, look)
    t = 0.14
    lo = [(x0 - t, -0.05, z0), (x1, -0.05, z0), (x0 - 1.4 * t, -0.09, z1)]
    hi = [(x0, 0.02, z1), (x1 + t, 0.02, z1), (x1 + 1.4 * t, 0.02, z1 + 1.5 * t)]
    return boxes(lo, hi)


def _room(w, h, depth):
    """Floor, ceiling, sides and back of what is behind a window, seen from within."""
    front, back = _loop(0.08, 0.05, w - 0.08, h - 0.25, 0.45), _loop(0.08, 0.05, w - 0.08, h - 0.25, depth)
    walls = rings([front, back])
    return Mesh(walls.v, np.concatenate([walls.f, [[4, 5, 6], [4, 6, 7]]]).astype(np.int32))


def _curtain(w, h, look, columns, closed):
    """Folded sheets behind the glass of each window, from both sides; 2 triangles a column.

    closed: the share of each window that they cover. Returns cells of one mesh, (windows, vertices, 3), and its faces.
    """
    x0, z0, x1, z1 = _opening(w, h, look)
    right = columns // 2
    v, faces, first = [], [], 0
    for n, edge, inward in ((columns - right, x0, 1), (right, x1, -1)):
        if n == 0:
            continue
        k = np.arange(n + 1)
        p = np.empty((len(closed), n + 1, 2, 3))
        reach = inward * (x1 - x0) * (0.5 if right else 1.0) * closed
        p[..., 0] = (edge + reach[:, None] * (k / n))[..., None]
        p[..., 1] = (look.reveal + 0.2 + 0.05 * np.sin(np.pi * k / (2 if n < 40 else n / 20)))[:, None]
        p[..., 0, 2], p[..., 1, 2] = z0 - 0.1, z1 + 0.1
        v.append(p.reshape(len(closed), -1, 3))
        faces.append(grid_faces(n + 1, 2) + np.int32(first))
        first += 2 * (n + 1)
    return np.concatenate(v, axis=1), np.concatenate(faces)


@lru_cache(maxsize=64)
def _balcony(w, look, fine):
    parts = Parts()
    d = look.balcony
    parts.add(look.trim, box((0.15, -d, -0.16), (w - 0.15, 0.02, -0.02)))
    rails = [((0.17, -d + 0.02, 0.98), (w - 0.17, -d + 0.07, 1.03))]
    rails += [((x, -d + 0.07, 0.98), (x + 0.05, 0, 1.03)) for x in (0.17, w - 0.22)]
    n = 22 if fine else 8
    for x in np.linspace(0.19, w - 0.21, n):
        rails.append(((x, -d + 0.035, -0.02), (x + 0.02, -d + 0.055, 0.98)))
    parts.add("metal", boxes([lo for lo, _ in rails], [hi for _, hi in rails]))
    return parts


@lru_cache(maxsize=64)
def _cell(w, h, look, budget):
    """The parts of a cell of at most about `budget` triangles without its curtains; "behind" is its room."""
    level = PLAIN if budget < RECESSED else RECESSED if budget < OPEN else OPEN
    parts = _wall(w, h, look, level)
    if level < OPEN:
        return parts
    x0, _, x1, _ = _opening(w, h, look)
    shallow = quad(*_loop(0.05, 0.05, w - 0.05, h - 0.15, look.reveal + 0.5))
    parts.add("behind", _room(w, h, 2.2) if budget >= WITH_ROOM else shallow)
    sill = box((x0, -0.07, look.sill - 0.09), (x1, look.reveal, look.sill + 0.015))
    extras = [(look.frame, _frame(w, h, look)), (look.trim, sill)]
    if look.mullions + look.transoms:
        extras.append((look.frame, _bars(w, h, look)))
    if look.surround:
        extras.append((look.trim, _surround(w, h, look)))
    if look.spandrel:
        extras.append((look.spandrel, box((0.04, -0.03, 0.02), (w - 0.04, 0.05, look.sill - 0.02))))
    for material, mesh in extras:
        if parts.triangles + len(mesh.f) > budget:
            break
        parts.add(material, mesh)
    return parts


INTERIORS = ("room-0", "room-1", "room-2", "room-3")
CURTAINS = ("curtain-0", "curtain-1", "curtain-2")


def _curtains(parts, rng, wall, origins, turn, columns):
    """`columns` a window on average."""
    w, h = wall.length / wall.bays, wall.storey
    whole = int(columns)
    n = np.full(len(origins), whole)
    n[rng.permutation(len(origins))[: int(round((columns - whole) * len(origins)))]] += 1
    closed = rng.uniform(0.15, 0.9, len(origins))
    curtain = CURTAINS[rng.integers(len(CURTAINS))]
    for k in (whole, whole + 1):
        chosen = n == k
        if k > 0 and chosen.any():
            v, f = _curtain(w, h, wall.look, k, closed[chosen])
            v = v @ turn.T + origins[chosen][:, None]
            f = f + (v.shape[1] * np.arange(len(v), dtype=np.int32))[:, None, None]
            parts.add(curtain, Mesh(v.reshape(-1, 3), f.reshape(-1, 3)))


def facade(parts, rng, wall, budget):
    """Builds the wall's cells in about `budget` triangles each."""
    w, h = wall.length / wall.bays, wall.storey
    c, s = round(np.cos(wall.heading)), round(np.sin(wall.heading))  # walls stand square
    turn = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1.0]])
    j, i = np.divmod(np.arange(wall.cells()), wall.bays)
    origins = np.outer(i, (w * c, w * s, 0)) + np.outer(j, (0, 0, h)) + wall.start
    if wall.balconies and budget >= OPEN + 16:
        at = (i % wall.balconies == wall.balconies // 2) & (j > 0)
        built = _balcony(w, wall.look, budget > 70)
        share = at.sum() * built.triangles / len(origins)
        if share < 0.5 * (budget - OPEN):
            budget -= share
            for material, meshes in built.by_material.items():
                parts.add(material, tile(join(meshes), origins[at], turn))
    if budget < OPEN:  # the lower storeys are the richer ones
        below, above = (PLAIN, RECESSED) if budget < RECESSED else (RECESSED, OPEN)
        rich = int(np.clip(round(len(origins) * (budget - below) / (above - below)), 0, len(origins)))
        _tile_cell(parts, rng, wall, origins[:rich], turn, above)
        _tile_cell(parts, rng, wall, origins[rich:], turn, below)
        return
    used = _tile_cell(parts, rng, wall, origins, turn, budget)
    if budget - used > 0.5:
        _curtains(parts, rng, wall, origins, turn, (budget - used) / 2)


def _tile_cell(parts, rng, wall, origins, turn, budget):
    """Triangles a cell."""
    w, h = wall.length / wall.bays, wall.storey
    cell = _cell(w, h, wall.look, int(budget))
    interior = rng.integers(3, size=len(origins))
    for material, meshes in cell.by_material.items():
        mesh = join(meshes)
        if material != "behind":
            parts.add(material, tile(mesh, origins, turn))
            continue
        for k, name in enumerate(rng.permutation(INTERIORS)[:3]):
            parts.add(name, tile(mesh, origins[interior == k], turn))
    return cell.triangles
