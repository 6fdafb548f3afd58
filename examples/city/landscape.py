# SPDX-License-Identifier: Apache-2.0
"""What lies about the city: fields, the avenues that leave it, and hills that close the horizon."""

import numpy as np

from meshes import Mesh, Parts, compacted, grid, level

FIELDS = 4  # materials
HILLS = 240


def landscape(city, seed):
    parts = Parts()
    x0, y0, x1, y1 = extent = city.extent()
    reach = 1.2 * max(x1 - x0, y1 - y0) + 500
    rng = np.random.default_rng([seed, 9])
    _fields(parts, rng, extent, reach)
    for (start, _, road), at in ((city.x[city.avenue], 0), (city.y[city.size.rows // 2], 1)):
        for a, b in ((0, -1), (1, 1)):
            lo, hi = (y0, y1) if at == 0 else (x0, x1)
            along = sorted((hi if a else lo, (hi if a else lo) + b * reach))
            across = start - road, start
            xs, ys = (across, along) if at == 0 else (along, across)
            parts.add("asphalt", level(xs[0], ys[0], xs[1], ys[1], -0.02))
    _hills(parts, rng, reach)
    return parts


def _lines(a, b, reach, outside, inside):
    """From a − reach to b + reach, with `outside` steps beyond either end of [a, b] and `inside` within."""
    spans = ((a - reach, a, outside), (a, b, inside), (b, b + reach, outside))
    return np.concatenate([np.linspace(lo, hi, n, endpoint=False) for lo, hi, n in spans] + [[b + reach]])


def _fields(parts, rng, extent, reach):
    """Unequal oblong fields with a hole where the city is."""
    x0, y0, x1, y1 = extent
    xs, ys = _lines(x0, x1, reach, 12, 6), _lines(y0, y1, reach, 14, 8)
    p = np.stack(np.broadcast_arrays(xs[:, None], ys[None], 0.0), axis=-1).copy()
    inner_x, inner_y = slice(12, 19), slice(14, 23)
    step = reach / 14
    p[..., :2] += rng.uniform(-0.3, 0.3, (*p.shape[:2], 2)) * step
    p[..., 2] = -1.0
    p[inner_x, inner_y] = np.stack(np.broadcast_arrays(xs[inner_x, None], ys[None, inner_y], -0.1), axis=-1)
    mesh = grid(p)
    u, v = np.meshgrid(np.arange(len(xs) - 1), np.arange(len(ys) - 1), indexing="ij")
    outside = (u < 12) | (u >= 18) | (v < 14) | (v >= 22)
    kind = np.repeat(np.where(outside, rng.integers(FIELDS, size=u.shape), -1).ravel(), 2)
    for k in range(FIELDS):
        parts.add(f"land-{k}", compacted(Mesh(mesh.v, mesh.f[kind == k])))


def _hills(parts, rng, reach):
    turn = 2 * np.pi * np.arange(HILLS) / HILLS
    height = np.zeros(HILLS)
    for k in range(1, 25):
        height += rng.uniform(0, 1) / k**0.9 * np.cos(k * turn + rng.uniform(0, 2 * np.pi))
    height = (0.5 + 0.5 * np.tanh(height)) * 0.10 * reach + 0.02 * reach
    out = np.array([1.0, 1.12, 1.3, 1.6]) * 1.05 * reach
    rise = np.array([0, 0.45, 0.85, 1.0])
    p = np.empty((HILLS, 4, 3))
    p[..., 0], p[..., 1] = out * np.cos(turn)[:, None], out * np.sin(turn)[:, None]
    p[..., 2] = height[:, None] * rise - 1.5
    parts.add("hill", grid(p[:, ::-1], wrap_u=True))
