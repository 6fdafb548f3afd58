# SPDX-License-Identifier: Apache-2.0
"""The height of the land: ridges, gullies that run down them as if water had cut them, and roughness.

A height depends on (x, y) and the seed alone, so that neighbouring tiles agree on their border.
"""

import numpy as np

SHIFT = 0.3  # of the stripes' phases, in lattice cells


def _gradients(seed, octave, i0, j0, ni, nj):
    """Unit gradients at the lattice points (i0 + i, j0 + j), (ni, nj) each, by an integer hash."""
    i = (np.arange(i0, i0 + ni, dtype=np.int64) & 0xFFFFFFFF).astype(np.uint64)[:, None]
    j = (np.arange(j0, j0 + nj, dtype=np.int64) & 0xFFFFFFFF).astype(np.uint64)[None]
    h = (i * np.uint64(0x9E3779B97F4A7C15)) ^ (j * np.uint64(0xC2B2AE3D27D4EB4F))
    h ^= np.uint64((seed * 1000003 + octave * 7919 + 12345) * 0x165667B19E3779F9 % (1 << 64))
    for shift, factor in ((29, 0xBF58476D1CE4E5B9), (32, 0x94D049BB133111EB)):
        h = (h ^ (h >> np.uint64(shift))) * np.uint64(factor)
    angle = (h >> np.uint64(40)).astype(float) * (2 * np.pi / (1 << 24))
    return np.cos(angle).astype(np.float32), np.sin(angle).astype(np.float32)


def _fade(t):
    return t * t * t * (t * (t * 6 - 15) + 10), 30 * t * t * (t * (t - 2) + 1)


def noise(x, y, seed, octave):
    """Perlin's gradient noise on the grid x (n,) × y (m,), and its two derivatives, (n, m) each.

    It is separable: a gradient's two components are blended along y first, then along x.
    """
    fx, fy = np.floor(x).astype(np.int64), np.floor(y).astype(np.int64)
    i0, j0 = fx[0], fy[0]
    gx, gy = _gradients(seed, octave, i0, j0, fx[-1] - i0 + 2, fy[-1] - j0 + 2)
    i, j, u, v = fx - i0, fy - j0, (x - fx).astype(np.float32), (y - fy).astype(np.float32)
    a, da = _fade(v)
    # Along y at every lattice column: p is the sum of gx, q that of gy·(y − lattice), with their y-derivatives.
    g0, g1, h0, h1 = gx[:, j], gx[:, j + 1], gy[:, j], gy[:, j + 1]
    p, dp = g0 + a * (g1 - g0), da * (g1 - g0)
    low, high = h0 * v, h1 * (v - 1)
    q, dq = low + a * (high - low), da * (high - low) + h0 + a * (h1 - h0)
    b, db = _fade(u)
    b, db, u = b[:, None], db[:, None], u[:, None]
    p0, p1 = p[i], p[i + 1]
    left, right = p0 * u + q[i], p1 * (u - 1) + q[i + 1]
    value = left + b * (right - left)
    along_x = db * (right - left) + p0 + b * (p1 - p0)
    dleft, dright = dp[i] * u + dq[i], dp[i + 1] * (u - 1) + dq[i + 1]
    return value, along_x, dleft + b * (dright - dleft)


def gullies(x, y, sx, sy, seed, octave):
    """Stripes that run down the slope (sx, sy), one to a lattice cell or so, and the derivative across them.

    Each lattice point has stripes of its own phase; the four about a place are blended.
    """
    fx, fy = np.floor(x).astype(np.int64), np.floor(y).astype(np.int64)
    i0, j0 = fx[0], fy[0]
    jx, jy = _gradients(seed, octave, i0, j0, fx[-1] - i0 + 2, fy[-1] - j0 + 2)
    i, j = fx - i0, fy - j0
    u, v = (x - fx).astype(np.float32)[:, None], (y - fy).astype(np.float32)[None]
    steep = np.sqrt(sx * sx + sy * sy) + np.float32(1e-6)
    ax, ay = -sy / steep, sx / steep
    wide, long = _fade(u)[0], _fade(v)[0]
    n, d = np.zeros_like(sx), np.zeros_like(sx)
    for a in (0, 1):
        for b in (0, 1):
            phase = (u - a - SHIFT * jx[i + a][:, j + b]) * ax + (v - b - SHIFT * jy[i + a][:, j + b]) * ay
            q = phase - np.rint(phase)
            bump = 1 - 4 * q * q
            weight = (wide if a else 1 - wide) * (long if b else 1 - long)
            n += weight * (2 * bump * bump - 1)
            d -= weight * (32 * q * bump)
    gate = np.minimum(np.float32(2.2) * steep, 1)
    return n * gate, d * gate * ax, d * gate * ay


class Land:
    """Metres; the middle of the land is the origin. `spacing` is that of the vertices: nothing finer is added."""

    def __init__(self, seed, extent, spacing):
        self.seed, self.extent = seed, extent
        self.longest = 0.42 * extent
        self.finest = 2.5 * spacing

    def _octaves(self, longest, ratio, most):
        """Wavelengths from the longest down."""
        lengths = []
        while longest > self.finest and len(lengths) < most:
            lengths.append(longest)
            longest *= ratio
        return lengths

    def heights(self, x, y):
        """x: (n,), y: (m,), both rising. Returns (n, m)."""
        z = np.zeros((len(x), len(y)), np.float32)
        sx, sy = np.zeros_like(z), np.zeros_like(z)

        def add(height, length, n, dx, dy):
            nonlocal z, sx, sy
            z += np.float32(height) * n
            sx += np.float32(height / length) * dx
            sy += np.float32(height / length) * dy

        octave = 0
        for length in self._octaves(self.longest, 0.47, 4):
            n, dx, dy = noise(x / length + 137.3 * octave + 7.1, y / length - 91.7 * octave + 3.3, self.seed, octave)
            if octave < 2:
                n, dx, dy = _ridge(n, dx, dy)
            add(0.27 * length * (1, 1, 0.8, 0.7)[octave], length, n, dx, dy)
            octave += 1
        for length in self._octaves(0.065 * self.extent, 0.5, 4):
            add(0.075 * length, length, *gullies(x / length, y / length, sx, sy, self.seed, octave))
            octave += 1
        rough = 0.25 + np.minimum(np.sqrt(sx * sx + sy * sy), 1)
        for length in self._octaves(0.025 * self.extent, 0.51, 12):
            n, _, _ = noise(x / length + 137.3 * octave, y / length - 91.7 * octave, self.seed, octave)
            z += np.float32(0.05 * length) * n * rough
            octave += 1
        return z + self._basin(x, y)

    def _basin(self, x, y):
        """A hollow off the middle that holds a lake, and a rise to the mountains behind it."""
        s = self.extent
        r2 = ((x[:, None] + 0.05 * s) / (0.24 * s)) ** 2 + ((y[None] + 0.16 * s) / (0.17 * s)) ** 2
        rise = 0.05 * y[None] + 0.25 * np.maximum(y, 0)[None] ** 2 / s
        return (rise - 0.09 * s / ((1 + r2) * (1 + r2))).astype(np.float32)


def _ridge(n, dx, dy):
    """A crest where the noise is 0, rounded."""
    r = np.sqrt(n * n + np.float32(0.003))
    slope = n / r
    return np.float32(0.35) - r, -slope * dx, -slope * dy
