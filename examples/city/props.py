# SPDX-License-Identifier: Apache-2.0
"""Cars and street lamps, about their own origin on the ground; a car's front looks along +x."""

import numpy as np

from meshes import Mesh, Parts, box, boxes, fan_faces, lathe, quad, rings, tile, tubes

CAR_COLOURS = ("car-0", "car-1", "car-2", "car-3", "car-4", "car-5", "car-6")
CAR_SHAPES = 3
# Outlines seen from the side: (x, z) of the body, and of the cabin's bottom and top edges.
BODIES = (
    [(-2.1, 0.35), (-2.15, 0.6), (-2.05, 0.92), (-1.0, 0.98), (0.9, 0.95), (2.0, 0.78), (2.12, 0.55), (2.08, 0.35)],
    [(-2.0, 0.35), (-2.05, 0.7), (-2.0, 1.0), (-0.9, 1.02), (1.0, 0.98), (1.85, 0.85), (1.95, 0.55), (1.9, 0.35)],
    [(-2.6, 0.4), (-2.65, 0.8), (-2.62, 1.15), (-1.0, 1.15), (1.3, 1.12), (2.3, 1.0), (2.45, 0.65), (2.4, 0.4)],
)
CABINS = (
    [(-1.75, 0.93), (-1.1, 1.40), (0.25, 1.43), (1.05, 0.93)],
    [(-1.98, 0.99), (-1.85, 1.48), (0.2, 1.52), (1.05, 0.97)],
    [(-2.6, 1.13), (-2.55, 2.05), (0.9, 2.1), (1.6, 1.1)],
)


def car(shape, colour, fine):
    parts = Parts()
    body, cabin = np.array(BODIES[shape]), np.array(CABINS[shape])
    half = (0.88, 0.86, 0.98)[shape]
    stations = [(-half, 0.94), (-0.86 * half, 1.0), (0.86 * half, 1.0), (half, 0.94)]
    loops = [[(x * k, y, 0.35 + (z - 0.35) * (1 if abs(y) < half else 0.93)) for x, z in body] for y, k in stations]
    shell = rings(loops[::-1])
    parts.add(CAR_COLOURS[colour], shell)
    for loop, flip in ((loops[0], False), (loops[-1], True)):
        f = fan_faces(len(loop))
        parts.add(CAR_COLOURS[colour], Mesh(np.array(loop), f if flip else f[:, ::-1]))
    b, t = 0.84 * half, 0.66 * half
    lower = np.array([(x, s * b, z) for x, z in (cabin[0], cabin[3]) for s in (-1, 1)])
    upper = np.array([(x, s * t, z) for x, z in (cabin[1], cabin[2]) for s in (-1, 1)])
    ring = [lower[0], lower[2], lower[3], lower[1]], [upper[0], upper[2], upper[3], upper[1]]
    parts.add("dark-glass", rings(ring))
    top = np.array(ring[1])
    centre = top.mean(axis=0)
    roof = centre + (top - centre) * 1.02
    parts.add(CAR_COLOURS[colour], rings([roof, roof + [0, 0, 0.04]]))
    parts.add(CAR_COLOURS[colour], quad(*(roof + [0, 0, 0.04])))
    for low, high in zip(*ring) if fine else ():  # pillars
        parts.add(CAR_COLOURS[colour], tubes(np.array([[low, high]]) * [1, 1.01, 1], 0.045, 4))
    wheel = lathe([(0.31, 0.0), (0.31, 0.2)], 12 if fine else 8)
    hub = lathe([(0.17, -0.01), (0.17, 0.21)], 6)
    upright = np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]])
    xs, ys = (0.62 * body[0, 0], 0.66 * body[-1, 0]), (-half - 0.01, half - 0.19)
    axles = np.array([[x, y, 0.31] for x in xs for y in ys])
    parts.add("tyre", tile(wheel, axles, upright))
    if not fine:
        return parts
    parts.add("metal", tile(hub, axles, upright))
    front, rear = body[5][0] + 0.06, body[1][0] - 0.02
    for y in (-0.62 * half, 0.62 * half):
        parts.add("curtain-0", box((front - 0.1, y - 0.17, 0.62), (front + 0.01, y + 0.17, 0.74)))
        parts.add("awning-0", box((rear - 0.01, y - 0.2, 0.7), (rear + 0.15, y + 0.2, 0.82)))
    return parts


def lamp(fine):
    """The arm reaches towards +x."""
    parts = Parts()
    t = np.array([0, 0.6, 0.68, 0.76, 0.84, 0.92, 1.0]) if fine else np.array([0, 0.6, 0.8, 1.0])
    x = np.where(t < 0.6, 0, 1.9 * np.sin((t - 0.6) / 0.4 * np.pi / 2))
    z = 7.5 * np.minimum(t / 0.6, 1) + 1.1 * np.sin(np.clip((t - 0.6) / 0.4, 0, 1) * np.pi / 2)
    path = np.stack([x, 0 * t, z], axis=1)
    parts.add("frame-dark", tubes(path[None], np.linspace(0.1, 0.045, len(t))[None], 6 if fine else 5))
    if fine:
        parts.add("frame-dark", lathe([(0.2, 0), (0.2, 0.5), (0.12, 0.9)], 8))
    parts.add("frame-dark", boxes([(1.7, -0.17, 8.58)], [(2.6, 0.17, 8.72)]))
    parts.add("lens", box((1.8, -0.12, 8.53), (2.5, 0.12, 8.58)))
    return parts
