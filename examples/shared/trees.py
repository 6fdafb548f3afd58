# SPDX-License-Identifier: Apache-2.0
"""Trees of any number of triangles: a trunk, branches, twigs and leaves of two triangles each."""

import numpy as np

from meshes import Mesh, Parts, ball, cross, tubes

LEAST_TRIANGLES = 80
FINE = 9000  # from here on all is round, and there are twigs


def _leaves(rng, centres, radius, shell, count, area):
    """Folded rhombi between two shares of the (k,1) radius about (k,3) centres, of the given total area."""
    which = rng.integers(len(centres), size=count)
    out = rng.normal(size=(count, 3))
    out /= np.linalg.norm(out, axis=1, keepdims=True)
    r = radius[which] * np.cbrt(rng.uniform(shell[0] ** 3, shell[1] ** 3, (count, 1)))
    p = centres[which] + out * r * np.array([1, 1, 0.8])
    along = rng.normal(size=(count, 3)) + 0.4 * out
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    across = cross(along, np.array([0.1, 0.2, 1.0]) + 0.5 * out)
    across /= np.linalg.norm(across, axis=1, keepdims=True) + 1e-12
    size = 0.8 * np.sqrt(area / count) * rng.uniform(0.8, 1.25, (count, 1))
    fold = cross(along, across) * (0.15 * size)
    v = np.stack(
        [p - size * along, p + 0.6 * size * across + fold, p + size * along, p - 0.6 * size * across + fold],
        axis=1,
    )
    f = np.array([[0, 1, 2], [0, 2, 3]], np.int32) + (4 * np.arange(count, dtype=np.int32))[:, None, None]
    return Mesh(v.reshape(-1, 3), f.reshape(-1, 3))


def _clumps(rng, lump, centres, radius):
    """Rough balls that stand for the inner foliage of a tree of few triangles."""
    r = radius[:, None] * rng.uniform(0.68, 1.08, (len(centres), len(lump.v), 1))
    v = lump.v * np.array([1, 1, 0.8]) * r + centres[:, None]
    f = lump.f + (len(lump.v) * np.arange(len(centres), dtype=np.int32))[:, None, None]
    return Mesh(v.reshape(-1, 3), f.reshape(-1, 3))


def broadleaf(rng, height, triangles, leaf="leaf-0"):
    """About its foot; of exactly `triangles` if that is even, else of one less."""
    parts = Parts()
    sides = 5 if triangles < FINE else 8
    crown = height * rng.uniform(0.30, 0.38)
    t = np.linspace(0, 1, 4 if triangles < FINE else 8)
    lean = rng.normal(0, 0.03, 2) * height
    trunk = np.stack([lean[0] * t**2, lean[1] * t**2, 0.8 * height * t], axis=1)
    radius = 0.028 * height * (1 - 0.85 * t) * (1 + 0.5 * np.exp(-12 * t))
    parts.add("bark", tubes(trunk[None], radius[None], sides))

    count = int(np.clip(triangles / 60, 4, 60))
    at = rng.uniform(0.35, 0.98, count)
    turn = 2.4 * np.arange(count) + rng.uniform(0, 1, count)
    reach = crown * np.sqrt(np.maximum(1 - ((at - 0.62) / 0.42) ** 2, 0.15)) * rng.uniform(0.75, 1.1, count)
    start = np.stack([np.interp(at, t, trunk[:, k]) for k in range(3)], axis=1)
    aim = np.stack([np.cos(turn) * reach, np.sin(turn) * reach, 0.45 * reach + 0.06 * height], axis=1)
    s = np.linspace(0, 1, 2 if triangles < FINE else 5)[None, :, None]
    path = start[:, None] + aim[:, None] * s - np.array([0, 0, 0.25]) * reach[:, None, None] * s**2
    slim = 0.012 * height * (1 - 0.85 * s[..., 0]) * (reach / crown)[:, None]
    if triangles >= 400:
        parts.add("bark", tubes(path, slim, 3 if triangles < FINE else 5))
    centres = np.concatenate([path[:, -1], 0.5 * (path[:, 0] + path[:, -1]) + [0, 0, 0.1 * crown]])
    if triangles >= FINE:  # twigs
        per = 6
        base = np.repeat(path[:, 2:].mean(axis=1), per, axis=0)
        tip = base + rng.normal(0, 0.28 * crown, base.shape)
        parts.add("bark", tubes(np.stack([base, tip], axis=1), np.array([[0.012, 0.005]]) * height / 8, 3))
        centres = np.concatenate([centres, tip])

    left = triangles - parts.triangles
    lump = ball(2 if triangles > 700 else 1)
    clumps = min(int(0.45 * left / len(lump.f)), 24) if triangles < FINE else 0
    leaf_count = lambda: max((triangles - parts.triangles) // 2, 8)
    if clumps:  # the leaves are on them
        at = centres[rng.permutation(len(centres))[:clumps]]
        radius = crown * (0.75, 0.6, 0.5, 0.42)[min(clumps // 4, 3)] * rng.uniform(0.75, 1.15, (clumps, 1))
        parts.add(leaf, _clumps(rng, lump, at, radius))
        parts.add(leaf, _leaves(rng, at, radius, (0.8, 1.08), leaf_count(), 2.2 * (radius**2).sum()))
    else:
        radius = np.full((len(centres), 1), 0.42 * crown)
        parts.add(leaf, _leaves(rng, centres, radius, (0, 1), leaf_count(), 11 * crown**2))
    return parts


def conifer(rng, height, triangles, leaf="needle"):
    """Whorls of drooping boughs, each a strip of tufts."""
    parts = Parts()
    t = np.linspace(0, 1, 4)
    trunk = np.stack([0 * t, 0 * t, height * t], axis=1)
    parts.add("bark", tubes(trunk[None], (0.018 * height * (1.03 - t))[None], 5))
    tufts = max((triangles - parts.triangles) // 2, 12)
    u = 1 - np.sqrt(rng.random(tufts))  # denser below, as the cone is wider
    z = height * (0.12 + 0.86 * u)
    whorl = np.round(z / (0.06 * height)) * 0.06 * height
    z = whorl + (z - whorl) * 0.35
    r = 0.21 * height * (1.03 - z / height) * np.sqrt(rng.random(tufts))
    turn = 2 * np.pi * rng.random(tufts)
    out = np.stack([np.cos(turn), np.sin(turn), np.full(tufts, -0.35)], axis=1)
    p = np.stack([r * np.cos(turn), r * np.sin(turn), z - 0.35 * r], axis=1)
    side = np.stack([-np.sin(turn), np.cos(turn), rng.uniform(-0.4, 0.4, tufts)], axis=1)
    size = 0.11 * height * np.sqrt(300 / (tufts + 200)) * rng.uniform(0.7, 1.3, (tufts, 1))
    tip = p + size * out
    v = np.stack([p - 0.3 * size * out, p - 0.4 * size * side, tip, p + 0.4 * size * side + [0, 0, 0.02]], axis=1)
    f = np.array([[0, 1, 2], [0, 2, 3]], np.int32) + (4 * np.arange(tufts, dtype=np.int32))[:, None, None]
    parts.add(leaf, Mesh(v.reshape(-1, 3), f.reshape(-1, 3)))
    return parts
