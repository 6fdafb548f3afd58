# SPDX-License-Identifier: Apache-2.0
"""The room itself: shell, herringbone floor, mouldings, door, and the glazed window with its curtains.

x runs from the window wall (x = 0) to the right, y from the camera to the bed's wall, z up; the floor is z = 0.
"""

import numpy as np

from meshes import (
    Mesh,
    box,
    generator,
    grid,
    join,
    lathe,
    moved,
    prism,
    rounded,
    smooth,
    soft_box,
    tubes,
    turned,
    waves,
)
from parts import Part

WIDTH, DEPTH, HEIGHT = 6.4, 6.2, 2.8
WALL = 0.32
WINDOW = (2.35, 5.15, 2.48)  # y0, y1, top; it reaches down to the floor
FRAME = 0.07  # width of the frame's bars
PANE_M, GAP_M = 0.006, 0.016


def shell():
    y0, y1, top = WINDOW
    w, d, h, t = WIDTH, DEPTH, HEIGHT, WALL
    lap = 0.1  # the slabs reach into the walls: no light comes through an edge
    walls = [
        box((w, -t, -t), (w + t, d + t, h + t)),
        box((-lap, -t, -t), (w + lap, 0, h + t)),
        box((-t, -t, -t), (0, y0, h + t)),
        box((-t, y1, -t), (0, d + t, h + t)),
        box((-t, y0 - lap, top), (0, y1 + lap, h + t)),
        box((-t, y0 - lap, -t), (0, y1 + lap, -0.03)),
    ]
    return [
        Part("shell", "wall", join(walls)),
        Part("shell", "wall-bed", box((-lap, d, -t), (w + lap, d + t, h + t))),
        Part("shell", "ceiling", box((-lap, -lap, h), (w + lap, d + lap, h + t))),
        Part("shell", "dark", box((-lap, -lap, -t), (w + lap, d + lap, -0.012))),
    ]


def clipped(polygon, extent):
    """Convex polygon cut to the rectangle extent = (x0, x1, y0, y1) (Sutherland & Hodgman 1974)."""
    for axis, bound, side in ((0, extent[0], 1), (0, extent[1], -1), (1, extent[2], 1), (1, extent[3], -1)):
        kept = []
        for p, q in zip(polygon, np.roll(polygon, -1, axis=0)):
            dp, dq = side * (p[axis] - bound), side * (q[axis] - bound)
            if dp >= 0:
                kept.append(p)
            if dp * dq < 0:
                kept.append(p + (q - p) * dp / (dp - dq))
        if len(kept) < 3:
            return None
        polygon = np.array(kept)
    return polygon


def floor():
    """Herringbone oak: blocks of four staves in slightly different tones, with open joints between the blocks."""
    rng = generator("floor")
    length, breadth, joint, staves = 0.60, 0.12, 0.0012, 4
    tones = [[] for _ in range(6)]
    half = np.sqrt(0.5)
    turn = np.array([[half, half], [-half, half]])
    for i in range(-6, 43):
        for j in range(-1, 10):
            for lying in (True, False):
                corner = np.array(
                    [i * breadth + j * length, i * breadth - j * length + (not lying) * breadth]
                )
                size = np.array([length, breadth]) if lying else np.array([breadth, length])
                tone = rng.integers(0, 6)
                cuts = np.concatenate([[0], np.sort(rng.uniform(0.1, 0.9, staves - 1)), [1]])
                for lo, hi in zip(cuts[:-1], cuts[1:]):
                    a, b = corner + joint / 2, corner + size - joint / 2
                    across = 1 if lying else 0
                    a[across], b[across] = (
                        corner[across] + joint / 2 + (breadth - joint) * s for s in (lo, hi)
                    )
                    outline = np.array([a, (b[0], a[1]), b, (a[0], b[1])]) @ turn
                    outline = clipped(outline, (0, WIDTH, 0, DEPTH))
                    if outline is not None:
                        stave = (tone + rng.choice([0, 0, 1, 4])) % 6
                        tones[stave].append(prism(outline, -0.012, 0))
    return [Part("floor", f"oak-{k}", join(blocks)) for k, blocks in enumerate(tones)]


def mouldings():
    w, d, h = WIDTH, DEPTH, HEIGHT
    rim = 0.005  # how far everything is sunk into the walls
    skirting = rounded([(-rim, 0.0), (0.018, 0.0), (0.018, 0.085), (0.010, 0.10), (-rim, 0.105)], 0.006)
    cornice = rounded(
        [(-rim, -0.11), (0.02, -0.11), (0.02, -0.09), (0.05, -0.05), (0.09, -0.025), (0.09, rim)], 0.03, 5
    )

    def around(profile, z):  # mitred at the four corners
        corners = [[(o, o), (w - o, o), (w - o, d - o), (o, d - o)] for o in profile[:, 0]]
        p = np.empty((4, len(profile), 3))
        p[..., :2] = np.transpose(corners, (1, 0, 2))
        p[..., 2] = z + profile[:, 1]
        return grid(p[::-1], wrap_u=True)

    y0, y1, _ = WINDOW
    runs = around(skirting, 0)
    sill = box((-WALL - 0.03, y0 - 0.02, -0.05), (0.06, y1 + 0.02, 0.004))
    return [Part("mouldings", "trim", join([runs, around(cornice, h)])), Part("sill", "stone", sill)]


def window_frame():
    """Anthracite frame with six lights, and a handle on the middle one, which is the balcony door."""
    y0, y1, top = WINDOW
    x0, x1 = -0.20, -0.11
    posts = np.linspace(y0, y1, 4)
    bars = [
        box((x0, y0 - 0.02, 0.002), (x1, y1 + 0.02, FRAME)),
        box((x0, y0 - 0.02, top - FRAME), (x1, y1 + 0.02, top + 0.02)),
        box((x0, y0 - 0.02, 0), (x1, y0 + FRAME, top)),
        box((x0, y1 - FRAME, 0), (x1, y1 + 0.02, top)),
    ]
    bars += [box((x0, y - FRAME / 2, 0), (x1, y + FRAME / 2, top)) for y in posts[1:3]]
    bars.append(box((x0, y0, 1.95), (x1, y1, 1.95 + FRAME * 0.7)))
    # The door's own sash stands a little proud and has a kick board.
    a, b = posts[1] + FRAME / 2 - 0.02, posts[2] - FRAME / 2 + 0.02
    sash = [
        box((x1 - 0.01, a, 0.03), (x1 + 0.015, a + 0.075, 1.97)),
        box((x1 - 0.01, b - 0.075, 0.03), (x1 + 0.015, b, 1.97)),
        box((x1 - 0.01, a, 0.03), (x1 + 0.015, b, 0.20)),
        box((x1 - 0.01, a, 1.90), (x1 + 0.015, b, 1.97)),
    ]
    rose = soft_box((x1 + 0.013, a + 0.025, 0.93), (x1 + 0.025, a + 0.055, 1.11), 0.004)
    lever = tubes(
        [
            [
                (x1 + 0.02, a + 0.04, 1.02),
                (x1 + 0.05, a + 0.04, 1.02),
                (x1 + 0.062, a + 0.055, 1.02),
                (x1 + 0.062, a + 0.16, 1.02),
            ]
        ],
        0.008,
        10,
    )
    return [
        Part("window-frame", "dark", join(bars + sash)),
        Part("window-handle", "brass", join([rose, lever])),
    ]


def panes(switching=False):
    """Double glazing: in each light two closed boxes of BK7, all faces exactly parallel, edges inside the frame. Or
    one sheet that is the whole glazing, its front outside."""
    y0, y1, top = WINDOW
    posts = np.linspace(y0, y1, 4)
    glass = []
    for k in range(3):
        a = posts[k] + (FRAME if k == 0 else FRAME / 2) - 0.012
        b = posts[k + 1] - (FRAME if k == 2 else FRAME / 2) + 0.012
        for z0, z1 in ((FRAME - 0.012, 1.962), (1.95 + FRAME * 0.7 - 0.012, top - FRAME + 0.012)):
            if switching:
                x = -0.170 + PANE_M + GAP_M / 2
                corners = [(x, a, z0), (x, a, z1), (x, b, z1), (x, b, z0)]
                glass.append(Mesh(np.array(corners), np.array([(0, 1, 2), (0, 2, 3)])))
                continue
            for x in (-0.170, -0.170 + PANE_M + GAP_M):
                glass.append(box((x, a, z0), (x + PANE_M, b, z1)))
    return [Part("panes", "window" if switching else "glass", join(glass))]


def curtain(name, y0, y1, folds, detail):
    """A gathered length of cloth: deep folds that wander on the way down, and the relief of a coarse weave."""
    rng = generator(name)
    columns, rows = (int(n * np.sqrt(detail)) for n in (420, 320))
    u, v = np.meshgrid(np.linspace(0, 1, columns), np.linspace(0, 1, rows), indexing="ij")
    fall = 1 - v  # 0 at the rail, 1 at the hem
    wander = 0.35 * fall * waves(2.2 * u, 0.5 * v, rng, 8, 0.4, 2.0)
    phase = 2 * np.pi * (folds * u + 0.35 * waves(3 * u, 0 * v, rng, 6, 0.5, 2.0)) + wander
    depth = 0.042 + 0.022 * fall + 0.010 * waves(4 * u, 1.2 * v, rng, 6, 0.5, 2.0)
    y = y0 + (y1 - y0) * u + 0.012 * (0.4 + fall) * np.sin(2 * phase) + 0.02 * (u - 0.5) * fall
    x, z = 0.165 + depth * np.sin(phase), 0.015 + 2.645 * v
    cloth = smooth(grid(np.stack([x, y, z], axis=-1)))
    threads = 0.0011 * np.sin(2 * np.pi * 60 * u) + 0.0006 * np.sin(2 * np.pi * 45 * v) * np.sin(
        2 * np.pi * 30 * u
    )
    return Part("curtains", "curtain", smooth(cloth._replace(v=cloth.v + threads.reshape(-1, 1) * cloth.n)))


def curtains(detail):
    y0, y1, _ = WINDOW
    rail = tubes([[(0.165, y0 - 0.75, 2.685), (0.165, y1 + 0.75, 2.685)]], 0.014, 12)
    ends = [
        moved(soft_box((-0.03,) * 3, (0.03,) * 3, 0.025, 4), (0.165, y, 2.685))
        for y in (y0 - 0.76, y1 + 0.76)
    ]
    brackets = [
        box((-0.005, y - 0.01, 2.675), (0.17, y + 0.01, 2.695)) for y in (y0 - 0.7, (y0 + y1) / 2, y1 + 0.7)
    ]
    return [
        curtain("curtain-near", y0 - 0.60, y0 - 0.02, 6, detail),
        curtain("curtain-far", y1 - 0.02, y1 + 0.60, 6, detail),
        Part("curtain-rail", "brass", join([rail] + ends + brackets)),
    ]


def door():
    x0, x1, y, top = 5.36, 6.16, DEPTH, 2.08
    jamb = [
        box((x0 - 0.09, y - 0.028, 0), (x0, y + 0.01, top + 0.09)),
        box((x1, y - 0.028, 0), (x1 + 0.09, y + 0.01, top + 0.09)),
        box((x0, y - 0.028, top), (x1, y + 0.01, top + 0.09)),
    ]
    # Rails and stiles stand before two sunken panels.
    leaf = [box((x0, y - 0.006, 0.005), (x1, y + 0.01, top))]
    stile = 0.11
    leaf += [
        box((a, y - 0.018, 0.005), (b, y, top))
        for a, b in ((x0 + 0.003, x0 + stile), (x1 - stile, x1 - 0.003))
    ]
    leaf += [
        box((x0 + stile, y - 0.018, a), (x1 - stile, y, b))
        for a, b in ((0.005, 0.20), (0.92, 1.05), (top - 0.12, top - 0.003))
    ]
    rose = turned(
        lathe(rounded([(0, -0.004), (0.026, -0.004), (0.026, 0.008), (0, 0.008)], 0.003), 24), 90, "x"
    )
    lever = tubes([[(0, 0, 0), (0, -0.045, 0), (0.012, -0.055, 0), (0.12, -0.055, 0)]], 0.0085, 10)
    handle = moved(join([rose, lever]), (x0 + 0.06, y - 0.02, 1.02))
    return [Part("door", "trim", join(jamb + leaf)), Part("door-handle", "brass", handle)]
