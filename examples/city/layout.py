# SPDX-License-Identifier: Apache-2.0
"""Where everything stands: streets, blocks, lots. A block's content depends on the seed and its place alone."""

from typing import NamedTuple

import numpy as np

from buildings import Lot

SIDEWALK, DEPTH = 3.6, 13.0
KINDS = ("masonry", "slab", "tower", "house")


class Size(NamedTuple):
    """What the number of triangles decides."""

    columns: int
    rows: int
    bay: float  # width of a window's cell
    busy: float  # share of the trees, lamps and cars that a street has room for
    floors: float  # scales the heights
    span: float  # scales the blocks


def size_for(triangles):
    decades = float(np.log10(triangles / 1e5))
    a_window = 11 * 10 ** (0.26 * decades)  # triangles
    blocks = max(0.6 * triangles / (a_window * 1700), 1)
    columns = max(round(np.sqrt(blocks)), 2)
    clip = lambda value, least, most: float(np.clip(value, least, most))
    return Size(
        columns=columns,
        rows=max(round(blocks / columns), 2),
        bay=clip(4.2 - decades, 3.1, 4.4),
        busy=clip(0.35 + 0.4 * decades, 0.3, 1),
        floors=clip(0.55 + 0.2 * decades, 0.5, 1),
        span=clip(0.76 + 0.3 * decades, 0.6, 1),
    )


class Block(NamedTuple):
    index: tuple  # column, row
    x0: float
    y0: float
    x1: float
    y1: float  # the kerb's rectangle
    left: float
    below: float  # widths of the roads on those sides
    use: str  # towers, perimeter, houses, park
    density: float  # 1 in the middle, 0 at the edge of the city


class Item(NamedTuple):
    """A building on its lot: where the lot's corner lies, and its heading in quarter turns."""

    seed: list
    lot: Lot
    x: float
    y: float
    quarters: int


class City:
    def __init__(self, size, seed, library):
        """library: whether lots are chosen from a few kinds, for buildings that are instanced."""
        self.size, self.seed, self.library = size, seed, library
        rng = np.random.default_rng([seed, 0])
        self.avenue = size.columns // 2
        self.x = self._spans(rng, size.columns, self.avenue)
        self.y = self._spans(rng, size.rows, size.rows // 2 if size.rows > 3 else -1)
        i, j = np.meshgrid(np.arange(size.columns), np.arange(size.rows), indexing="ij")
        u = (i + 0.5) / size.columns - 0.5
        v = (j + 0.5) / size.rows - 0.5
        far = np.hypot(u, v) + 0.06 * rng.standard_normal(u.shape)
        rank = np.empty(far.size)
        rank[np.argsort(far.ravel(), kind="stable")] = np.arange(far.size) / far.size
        self.rank = rank.reshape(far.shape)
        self.parks = (rng.random(far.shape) < 0.07) & (self.rank > 0.05) & (far.size > 8)

    def _spans(self, rng, count, avenue):
        """(start, end, road before it) of each block along one axis; the origin is in the middle."""
        roads = rng.uniform(12, 15, count + 1)
        if avenue >= 0:
            roads[avenue] = 22.0
        sizes = rng.uniform(66, 92, count) * self.size.span
        ends = np.cumsum(roads[:-1] + sizes)
        middle = 0.5 * (ends[-1] + roads[-1])
        return [(e - s - middle, e - middle, r) for e, s, r in zip(ends, sizes, roads)]

    def extent(self):
        return self.x[0][0] - self.x[0][2], self.y[0][0] - self.y[0][2], self.x[-1][1] + 13, self.y[-1][1] + 13

    def blocks(self):
        """In rows that run to and fro, so that what is written together lies together."""
        for j in range(self.size.rows):
            order = range(self.size.columns)
            for i in order if j % 2 == 0 else reversed(order):
                yield self.block(i, j)

    def block(self, i, j):
        rank = self.rank[i, j]
        use = "towers" if rank < 0.2 else "perimeter" if rank < 0.72 or self.rank.size < 12 else "houses"
        if self.parks[i, j]:
            use = "park"
        (x0, x1, left), (y0, y1, below) = self.x[i], self.y[j]
        return Block((i, j), x0, y0, x1, y1, left, below, use, 1 - rank)

    def items(self, block):
        rng = np.random.default_rng([self.seed, 3, *block.index])
        x0, y0, x1, y1 = block.x0 + SIDEWALK, block.y0 + SIDEWALK, block.x1 - SIDEWALK, block.y1 - SIDEWALK
        if block.use == "towers":
            placed = list(self._towers(rng, block, x0, y0, x1, y1))
        elif block.use == "park":
            placed = []
        else:
            placed = list(self._perimeter(rng, block, x0, y0, x1, y1))
        return [Item(self._seed(rng, block, n, lot), lot, x, y, turn) for n, (lot, x, y, turn) in enumerate(placed)]

    def _seed(self, rng, block, n, lot):
        if not self.library:
            return [self.seed, 4, *block.index, n]
        sides = 2 * lot.open_left + lot.open_right
        variant = int(rng.integers(2 if self.rank.size < 100 else 4))
        return [self.seed, 5, KINDS.index(lot.kind), round(lot.width), round(lot.depth), lot.floors, sides, variant]

    def _towers(self, rng, block, x0, y0, x1, y1):
        mx, my, gap = 0.5 * (x0 + x1), 0.5 * (y0 + y1), 3.5
        for cx0, cx1 in ((x0, mx - gap), (mx + gap, x1)):
            for cy0, cy1, turn in ((y0, my - gap, 0), (my + gap, y1, 2)):
                w, d = cx1 - cx0, cy1 - cy0
                if self.library:
                    w, d = min(26 + 4 * int((w - 26) / 4), 34), min(26 + 4 * int((d - 26) / 4), 34)
                steps = np.array([12, 18, 26, 36])
                floors = steps[rng.integers(4)] if self.library else rng.integers(11, 40)
                floors = max(int(floors * self.size.floors * (0.6 + 0.5 * block.density)), 7)
                lot = Lot("tower", w, d, floors, True, True, self.size.bay, self.size.busy)
                yield lot, cx0 if turn == 0 else cx0 + w, cy0 if turn == 0 else cy0 + d, turn

    def _row(self, rng, length, kinds, floors):
        """Lots along a row: (lot, where it begins)."""
        widths = []
        houses = kinds == ("house",)
        while True:
            w = rng.choice([8.0, 10.0]) if houses else rng.choice([13.0, 17.0, 21.0])
            if not self.library:
                w *= rng.uniform(0.88, 1.12)
            if sum(widths) + w > length:
                break
            widths.append(w)
        if not widths:
            return
        gap = (length - sum(widths)) / max(len(widths) - 1, 1)
        if not self.library:
            widths, gap = [w * length / sum(widths) for w in widths], 0.0
        at = 0.0
        for k, w in enumerate(widths):
            kind = kinds[rng.integers(len(kinds))]
            depth = 9.0 if houses else DEPTH
            n = int(rng.choice([2, 3]) if houses else max(floors + rng.integers(-2, 3), 3))
            if self.library and not houses:
                n = min([4, 6, 8, 10], key=lambda step: abs(step - n))
            yield Lot(kind, float(w), depth, n, k == 0, k == len(widths) - 1, self.size.bay, self.size.busy), at
            at += w + gap

    def _perimeter(self, rng, block, x0, y0, x1, y1):
        houses = block.use == "houses"
        kinds = ("house",) if houses else ("masonry", "masonry", "slab")
        floors = int(4 + 5 * block.density * self.size.floors)
        if houses:  # front gardens
            x0, y0, x1, y1 = x0 + 3, y0 + 3, x1 - 3, y1 - 3
        depth = 9.0 if houses else DEPTH
        for lot, at in self._row(rng, x1 - x0, kinds, floors):
            yield lot, x0 + at, y0, 0
        for lot, at in self._row(rng, x1 - x0, kinds, floors):
            yield lot, x1 - at, y1, 2
        inner = y1 - y0 - 2 * depth - 4
        for lot, at in self._row(rng, inner, kinds, floors):
            yield lot._replace(open_left=False, open_right=False), x0, y1 - depth - 2 - at, 3
        for lot, at in self._row(rng, inner, kinds, floors):
            yield lot._replace(open_left=False, open_right=False), x1, y0 + depth + 2 + at, 1
