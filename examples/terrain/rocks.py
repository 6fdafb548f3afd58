# SPDX-License-Identifier: Apache-2.0
"""Boulders: spheres with broken faces and a rough surface, no two alike."""

import numpy as np

from meshes import Mesh, ball


def boulder(rng, radius, level):
    """About its middle; 8·4^level triangles."""
    sphere = ball(level)
    v = sphere.v.copy()
    for _ in range(7):  # cut flat, except for a little
        n = rng.normal(size=3)
        n /= np.sqrt((n * n).sum())
        over = np.maximum(v @ n - rng.uniform(0.45, 0.85), 0)
        v -= 0.93 * over[:, None] * n
    rough = np.zeros(len(v))
    for k in range(1, 2 + 2 * level):
        wave = rng.normal(size=3) * 2.0**k
        t = v @ wave + rng.random()
        q = t - np.rint(t)
        rough += (1 - 16 * q * q) * 0.5 ** (1.1 * k)
    v *= 1 + 0.05 * rough[:, None]
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    v = (v * rng.uniform(0.6, 1.0, 3) * radius) @ turn.T
    f = sphere.f if np.linalg.det(turn) > 0 else sphere.f[:, ::-1]
    return Mesh(v, f)
