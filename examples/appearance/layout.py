# SPDX-License-Identifier: Apache-2.0
"""The room that both files show, in metres, y up: x in ±3, y in 0..3.2, z in −1.2..3.8, open to the front."""

import math

from meshes import box, lathe, quad, sphere, vase

COLUMNS = [round(-2.24 + 0.56 * i, 2) for i in range(9)]
PLANKS = [2.22, 1.42, 0.62]  # their upper sides
DEPTH_Z, SIZE = -0.75, 0.24

EYE, TARGET = (0.0, 1.75, 5.9), (0.0, 1.52, -0.75)
FOV_DEG = 35.5  # on the height

WINDOW = {"y": (0.9, 2.5), "z": (0.4, 2.2)}  # in the wall x = 3
PORTAL = [(3, 0.9, 0.4), (3, 0.9, 2.2), (3, 2.5, 2.2), (3, 2.5, 0.4)]


def right_wall():
    """Four rectangles around the window, (u, v) in metres."""
    (y0, y1), (z0, z1) = WINDOW["y"], WINDOW["z"]
    vertices, faces = [], []
    for z, y, dz, dy in (
        (-1.2, 0, 5, y0),
        (-1.2, y1, 5, 3.2 - y1),
        (-1.2, y0, z0 + 1.2, y1 - y0),
        (z1, y0, 3.8 - z1, y1 - y0),
    ):
        part, indices = quad((3, y, z), (0, 0, dz), (0, dy, 0))
        first = len(vertices)
        vertices += [(*v[:6], v[2], v[1]) for v in part]
        faces += [tuple(first + i for i in f) for f in indices]
    return vertices, faces


def bookcase():
    """Three planks and two sides."""
    vertices, faces = [], []
    parts = [(0, y - 0.03, DEPTH_Z, 2.62, 0.03, 0.36) for y in PLANKS]
    parts += [(side * 2.66, 1.35, DEPTH_Z, 0.04, 1.35, 0.36) for side in (-1, 1)]
    for x, y, z, *half in parts:
        part, indices = box(*half)
        first = len(vertices)
        vertices += [(v[0] + x, v[1] + y, v[2] + z, *v[3:]) for v in part]
        faces += [tuple(first + i for i in f) for f in indices]
    return vertices, faces


def bowl():
    return lathe([(0, -1)] + [(math.sin(t), -math.cos(t)) for t in (0.26, 0.52, 0.79, 1.05, 1.31, 1.57, 1.8)])


def candlestick():
    return lathe([(0, 0), (0.12, 0), (0.12, 0.03), (0.03, 0.06), (0.03, 0.4), (0.07, 0.44), (0, 0.45)], 16)


def meshes():
    return {
        "sphere": sphere(),
        "vase": vase(),
        "bowl": bowl(),
        "box": box(0.85, 1, 0.85),
        "floor": quad((-3, 0, 3.8), (6, 0, 0), (0, 0, -5)),
        "ceiling": quad((-3, 3.2, -1.2), (6, 0, 0), (0, 0, 5)),
        "back": quad((-3, 0, -1.2), (6, 0, 0), (0, 3.2, 0)),
        "left": quad((-3, 0, 3.8), (0, 0, -5), (0, 3.2, 0)),
        "right": right_wall(),
        "window": quad((3, 0.9, 0.4), (0, 0, 1.8), (0, 1.6, 0)),
        "bookcase": bookcase(),
        "candlestick": candlestick(),
        "lamp": quad((-0.4, 3.15, 0.8), (0.8, 0, 0), (0, 0, 0.8)),
        "downlight": quad((1.5, 3.15, 0.1), (0.35, 0, 0), (0, 0, 0.35)),
        "screen": quad((-2.95, 1.2, 2.3), (0, 0, -1.3), (0, 1.0, 0)),
        "picture": quad((-2.97, 1.15, 0.6), (0, 0, -1.1), (0, 1.1, 0)),
        "rug": quad((-1.4, 0.01, 1.9), (2.8, 0, 0), (0, 0, -1.5)),
        "card": quad((-0.2, 0, 0), (0.4, 0, 0), (0, 0.6, 0)),
        "sheet": quad((-0.3, 0, 0), (0.6, 0, 0.15), (0, 0.75, 0)),
    }


# (mesh, x) on the floor before the shelf
CANDLESTICKS = [(-2.3, 0.3), (2.05, 0.5), (2.4, 0.2)]
LEAVES, PANE = (-1.75, 0.0, 0.35), (1.2, 0.0, 0.45)


def places():
    """Where the 27 objects stand: x and the height of their plank, from the upper left."""
    return [(x, y) for y in PLANKS for x in COLUMNS]
