# SPDX-License-Identifier: Apache-2.0
"""Triangle meshes in numpy for scenes that are written as a stream. Metres, right-handed, z up."""

from collections import defaultdict
from functools import lru_cache
from typing import NamedTuple

import numpy as np


class Mesh(NamedTuple):
    """v: (n,3) positions; f: (m,3) int32 indices, counter-clockwise seen from outside."""

    v: np.ndarray
    f: np.ndarray


def cross(a, b):
    """As np.cross of (…,3) arrays, without its overhead."""
    ax, ay, az, bx, by, bz = a[..., 0], a[..., 1], a[..., 2], b[..., 0], b[..., 1], b[..., 2]
    return np.stack([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx], axis=-1)


class Parts:
    """Meshes by material."""

    def __init__(self):
        self.by_material = defaultdict(list)
        self.triangles = 0

    def add(self, material, mesh):
        if len(mesh.f):
            self.by_material[material].append(mesh)
            self.triangles += len(mesh.f)


def rotations(degrees):
    """About z, (k,3,3)."""
    angle = np.radians(degrees)
    turns = np.zeros((len(angle), 3, 3))
    turns[:, 0, 0] = turns[:, 1, 1] = np.cos(angle)
    turns[:, 1, 0] = np.sin(angle)
    turns[:, 0, 1] = -turns[:, 1, 0]
    turns[:, 2, 2] = 1
    return turns


def join(meshes):
    if len(meshes) == 1:
        return meshes[0]
    faces, first = [], 0
    for mesh in meshes:
        faces.append(mesh.f + np.int32(first))
        first += len(mesh.v)
    return Mesh(np.concatenate([m.v for m in meshes]), np.concatenate(faces))


def tile(mesh, origins, turn=None):
    """One copy of the mesh at each of the (k,3) origins; turn: (3,3), or (k,3,3) for each its own."""
    n, k = len(mesh.v), len(origins)
    if k == 0:
        return Mesh(np.empty((0, 3)), np.empty((0, 3), np.int32))
    if turn is None:
        v = mesh.v[None] + origins[:, None]
    elif turn.ndim == 2:
        v = (mesh.v @ turn.T)[None] + origins[:, None]
    else:
        v = mesh.v @ turn.transpose(0, 2, 1) + origins[:, None]
    f = mesh.f[None] + (n * np.arange(k, dtype=np.int32))[:, None, None]
    return Mesh(v.reshape(-1, 3), f.reshape(-1, 3))


@lru_cache(maxsize=512)
def grid_faces(nu, nv, wrap_u=False, wrap_v=False):
    index = np.arange(nu * nv, dtype=np.int32).reshape(nu, nv)
    if wrap_u:
        index = np.concatenate([index, index[:1]], axis=0)
    if wrap_v:
        index = np.concatenate([index, index[:, :1]], axis=1)
    a, b, c, d = index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]
    return np.stack([np.stack([a, b, c], -1), np.stack([a, c, d], -1)], axis=2).reshape(-1, 3)


def grid(p, wrap_u=False, wrap_v=False):
    """Surface over points p[u, v] of shape (nu,nv,3); its front is ∂p/∂u × ∂p/∂v."""
    nu, nv = p.shape[:2]
    return Mesh(p.reshape(-1, 3), grid_faces(nu, nv, wrap_u, wrap_v))


def rings(loops):
    """Surface through closed loops (k,n,3) of equally many points, counter-clockwise seen from where they go to."""
    p = np.asarray(loops, float)
    return Mesh(p.reshape(-1, 3), _ring_faces(*p.shape[:2]))


@lru_cache(maxsize=512)
def _ring_faces(k, n):
    index = np.arange(k * n, dtype=np.int32).reshape(k, n)
    a, d = index[:-1], index[1:]
    b, c = np.roll(a, -1, axis=1), np.roll(d, -1, axis=1)
    return np.stack([np.stack([a, b, c], -1), np.stack([a, c, d], -1)], axis=2).reshape(-1, 3)


QUAD = np.array([[0, 1, 2], [0, 2, 3]], np.int32)
BOX = np.array(
    [
        t
        for a, b, c, d in [(0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6)]
        for t in ((a, b, c), (a, c, d))
    ],
    np.int32,
)
CORNERS = np.array([[k & 1, k >> 1 & 1, k >> 2 & 1] for k in range(8)], float)


def quad(*corners):
    return Mesh(np.array(corners, float), QUAD)


def level(x0, y0, x1, y1, z):
    """A horizontal rectangle that faces up."""
    return quad((x0, y0, z), (x1, y0, z), (x1, y1, z), (x0, y1, z))


def box(lo, hi):
    lo = np.asarray(lo, float)
    return Mesh(lo + CORNERS * (np.asarray(hi, float) - lo), BOX)


def boxes(lo, hi):
    """lo, hi: (k,3)."""
    lo = np.asarray(lo, float)
    v = lo[:, None] + CORNERS * (np.asarray(hi, float) - lo)[:, None]
    f = BOX + (8 * np.arange(len(lo), dtype=np.int32))[:, None, None]
    return Mesh(v.reshape(-1, 3), f.reshape(-1, 3))


def rectangle(x0, y0, x1, y1, z):
    """The loop of a horizontal rectangle, counter-clockwise from above."""
    return [(x0, y0, z), (x1, y0, z), (x1, y1, z), (x0, y1, z)]


@lru_cache(maxsize=64)
def circle(n):
    angle = 2 * np.pi * np.arange(n) / n
    return np.stack([np.cos(angle), np.sin(angle)], axis=1)


@lru_cache(maxsize=64)
def fan_faces(n):
    k = np.arange(1, n - 1, dtype=np.int32)
    return np.stack([0 * k, k, k + 1], axis=1)


def lathe(profile, n):
    """Closed by flat ends. profile: (radius, height) from the bottom up, radii > 0."""
    c = circle(n)
    profile = np.asarray(profile, float)
    p = np.empty((len(profile), n, 3))
    p[..., :2] = profile[:, 0, None, None] * c
    p[..., 2] = profile[:, 1, None]
    side, ends = _ring_faces(len(profile), n), fan_faces(n)
    top = ends + np.int32((len(profile) - 1) * n)
    return Mesh(p.reshape(-1, 3), np.concatenate([side, ends[:, ::-1], top]))


def tubes(paths, radius, sides):
    """Open tubes along paths (k,m,3), m ≥ 2; radius broadcasts to (k,m)."""
    paths = np.asarray(paths, float)
    k, m, _ = paths.shape
    along = paths[:, -1] - paths[:, 0]
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    other = np.where(np.abs(along[:, 2:]) < 0.9, np.array([[0, 0, 1.0]]), np.array([[1.0, 0, 0]]))
    e1 = cross(other, along)
    e1 /= np.linalg.norm(e1, axis=1, keepdims=True)
    e2 = cross(along, e1)
    c = circle(sides)
    ring = c[:, :1] * e1[:, None] + c[:, 1:] * e2[:, None]  # (k, sides, 3)
    r = np.broadcast_to(radius, (k, m))
    p = paths[:, :, None] + r[..., None, None] * ring[:, None]
    f = _ring_faces(m, sides) + (m * sides * np.arange(k, dtype=np.int32))[:, None, None]
    return Mesh(p.reshape(-1, 3), f.reshape(-1, 3))


@lru_cache(maxsize=8)
def ball(level):
    """The unit sphere: an octahedron whose faces are split in four `level` times."""
    v = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    f = [(a, b, c) if (a + b + c) % 2 == 0 else (a, c, b) for a in (0, 1) for b in (2, 3) for c in (4, 5)]
    for _ in range(level):
        middles, faces = {}, []
        for corners in f:
            edges = []
            for a, b in zip(corners, corners[1:] + corners[:1]):
                key = min(a, b), max(a, b)
                if key not in middles:
                    middles[key] = len(v)
                    m = np.add(v[a], v[b])
                    v.append(tuple(m / np.sqrt((m * m).sum())))
                edges.append(middles[key])
            (a, b, c), (ab, bc, ca) = corners, edges
            faces += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        f = faces
    return Mesh(np.array(v, float), np.array(f, np.int32))


def compacted(mesh):
    """Without the vertices that no triangle uses."""
    used = np.zeros(len(mesh.v), bool)
    used[mesh.f] = True
    return Mesh(mesh.v[used], (np.cumsum(used, dtype=np.int32) - 1)[mesh.f])
