# SPDX-License-Identifier: Apache-2.0
"""Triangle meshes in numpy: primitives, smoothing and binary PLY files. Metres, right-handed, z up."""

from typing import NamedTuple, Optional
import zlib

import numpy as np


class Mesh(NamedTuple):
    """v: (n,3) positions; f: (m,3) indices, counter-clockwise seen from outside; n: (n,3) shading normals or None."""

    v: np.ndarray
    f: np.ndarray
    n: Optional[np.ndarray] = None


def generator(name):
    """Random numbers that depend on the object's name alone."""
    return np.random.default_rng(zlib.crc32(name.encode()))


def steps(count, detail):
    """Points along one side of a surface that has `count` of them at detail 1: its triangles scale with the detail."""
    return max(8, int(round(count * np.sqrt(detail))))


# ---- Building blocks -------------------------------------------------------------------------------------------


def join(meshes):
    """One mesh; shading normals are kept only if all parts have them."""
    first = np.cumsum([0] + [len(m.v) for m in meshes])
    v = np.concatenate([m.v for m in meshes])
    f = np.concatenate([m.f + k for m, k in zip(meshes, first)])
    n = np.concatenate([m.n for m in meshes]) if all(m.n is not None for m in meshes) else None
    return Mesh(v, f, n)


def smooth(mesh):
    """Shading normals: the area-weighted mean of the faces around each vertex."""
    a, b, c = (mesh.v[mesh.f[:, k]] for k in range(3))
    face = np.cross(b - a, c - a)
    n = np.stack(
        [sum(np.bincount(mesh.f[:, k], face[:, axis], len(mesh.v)) for k in range(3)) for axis in range(3)],
        axis=1,
    )
    return mesh._replace(n=n / np.maximum(np.linalg.norm(n, axis=1, keepdims=True), 1e-30))


def weld(mesh, tolerance=1e-6):
    """Makes vertices that coincide within the tolerance one vertex and drops triangles that collapse."""
    _, first, same = np.unique(
        np.round(mesh.v / tolerance).astype(np.int64), axis=0, return_index=True, return_inverse=True
    )
    f = same.reshape(-1)[mesh.f]
    keep = (f[:, 0] != f[:, 1]) & (f[:, 1] != f[:, 2]) & (f[:, 2] != f[:, 0])
    return Mesh(mesh.v[first], f[keep])


def settled(mesh):
    """Rounded to a micrometre, so that files do not depend on a CPU's last bit.

    Without triangles of no area and without vertices that nothing uses.
    """
    v = np.round(mesh.v, 6)
    a, b, c = (v[mesh.f[:, k]] for k in range(3))
    f = mesh.f[np.linalg.norm(np.cross(b - a, c - a), axis=1) > 1e-12]
    used = np.zeros(len(v), bool)
    used[f] = True
    return Mesh(v[used], (np.cumsum(used) - 1)[f], None if mesh.n is None else np.round(mesh.n, 5)[used])


def grid(p, wrap_u=False, wrap_v=False):
    """Surface over points p[u, v] of shape (nu,nv,3); its front is ∂p/∂u × ∂p/∂v."""
    nu, nv = p.shape[:2]
    index = np.arange(nu * nv).reshape(nu, nv)
    if wrap_u:
        index = np.concatenate([index, index[:1]], axis=0)
    if wrap_v:
        index = np.concatenate([index, index[:, :1]], axis=1)
    a, b, c, d = index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]
    f = np.stack([np.stack([a, b, c], -1), np.stack([a, c, d], -1)], axis=2)
    return Mesh(p.reshape(-1, 3).astype(float), f.reshape(-1, 3))


def moved(mesh, by):
    return mesh._replace(v=mesh.v + np.asarray(by, float))


def turned(mesh, degrees, axis="z", about=(0, 0, 0)):
    """Rotated right-handedly about a line through `about`."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    i, j = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    m = np.eye(3)
    m[i, i], m[i, j], m[j, i], m[j, j] = c, -s, s, c
    about = np.asarray(about, float)
    return Mesh((mesh.v - about) @ m.T + about, mesh.f, None if mesh.n is None else mesh.n @ m.T)


# ---- Solids ----------------------------------------------------------------------------------------------------


def box(lo, hi):
    """Closed axis-aligned box: 8 vertices, 12 triangles, outward."""
    corners = [[(lo, hi)[k >> axis & 1][axis] for axis in range(3)] for k in range(8)]
    quads = [(0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6)]
    f = [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]
    return Mesh(np.array(corners, float), np.array(f))


def soft_box(lo, hi, radius, rounds=3, cells=2):
    """Closed box with edges rounded by `radius`; `cells` flat cells a side. Welded, with shading normals."""
    lo, hi = np.asarray(lo, float), np.asarray(hi, float)
    inner_lo, inner_hi = lo + radius, hi - radius
    bend = radius * np.tan(np.linspace(np.pi / 4, 0, rounds + 1))
    sides = [
        np.concatenate(
            [
                inner_lo[k] - bend,
                np.linspace(inner_lo[k], inner_hi[k], cells + 1)[1:-1],
                inner_hi[k] + bend[::-1],
            ]
        )
        for k in range(3)
    ]
    faces = []
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for end, (a, b) in ((hi, (u, v)), (lo, (v, u))):
            p = np.empty((len(sides[a]), len(sides[b]), 3))
            p[..., a], p[..., b] = np.meshgrid(sides[a], sides[b], indexing="ij")
            p[..., axis] = end[axis]
            faces.append(grid(p))
    cube = weld(join(faces))
    inner = np.clip(cube.v, inner_lo, inner_hi)
    n = cube.v - inner
    n /= np.linalg.norm(n, axis=1, keepdims=True)
    return Mesh(inner + radius * n, cube.f, n)


def lathe(profile, segments):
    """Surface of revolution about z. profile: (k,2) of (radius, height), the outside on its right going along it."""
    profile = np.asarray(profile, float)
    angle = 2 * np.pi * np.arange(segments) / segments
    p = np.empty((segments, len(profile), 3))
    p[..., 0] = np.cos(angle)[:, None] * profile[:, 0]
    p[..., 1] = np.sin(angle)[:, None] * profile[:, 0]
    p[..., 2] = profile[:, 1]
    return smooth(weld(grid(p, wrap_u=True), 1e-7))


def rounded(profile, radius, rounds=4):
    """The (k,2) polyline with its inner corners replaced by quadratic Bézier arcs that start `radius` before them."""
    profile = np.asarray(profile, float)
    out = [profile[:1]]
    t = np.linspace(0, 1, rounds + 1)[:, None]
    for a, b, c in zip(profile[:-2], profile[1:-1], profile[2:]):
        r = min(radius, np.linalg.norm(b - a) / 2.1, np.linalg.norm(c - b) / 2.1)
        start = b + (a - b) * r / np.linalg.norm(a - b)
        end = b + (c - b) * r / np.linalg.norm(c - b)
        out.append((1 - t) ** 2 * start + 2 * t * (1 - t) * b + t**2 * end)
    return np.concatenate(out + [profile[-1:]])


def tubes(paths, radius, sides=6):
    """Open tubes along paths (k,m,3); radius is a number or broadcasts to (k,m)."""
    paths = np.asarray(paths, float)
    k, m, _ = paths.shape
    tangent = np.gradient(paths, axis=1)
    tangent /= np.linalg.norm(tangent, axis=2, keepdims=True)
    across = np.zeros_like(paths)
    across[np.arange(k), :, np.abs(tangent.mean(axis=1)).argmin(axis=1)] = 1
    e1 = np.cross(tangent, across)
    e1 /= np.linalg.norm(e1, axis=2, keepdims=True)
    e2 = np.cross(tangent, e1)
    angle = 2 * np.pi * np.arange(sides) / sides
    ring = np.cos(angle)[:, None] * e1[:, :, None] + np.sin(angle)[:, None] * e2[:, :, None]
    r = np.broadcast_to(radius, (k, m))[..., None, None]
    p = paths[:, :, None] + r * ring
    index = np.arange(k * m * sides).reshape(k, m, sides)
    a, b = index[:, :-1], index[:, 1:]
    c, d = np.roll(b, -1, axis=2), np.roll(a, -1, axis=2)
    f = np.stack([np.stack([a, d, c], -1), np.stack([a, c, b], -1)], axis=-2)
    return Mesh(p.reshape(-1, 3), f.reshape(-1, 3), ring.reshape(-1, 3))


def sphere(centre, radius, segments=24):
    angle = np.linspace(-np.pi / 2, np.pi / 2, segments // 2 + 1)
    profile = np.stack([np.cos(angle), np.sin(angle)], axis=1) * radius
    profile[[0, -1], 0] = 0
    return moved(lathe(profile, segments), centre)


def prism(outline, z0, z1):
    """Upright prism over a convex outline (k,2), counter-clockwise from above; open below."""
    outline = np.asarray(outline, float)
    k = len(outline)
    v = np.concatenate([np.column_stack([outline, np.full(k, z)]) for z in (z0, z1)])
    i = np.arange(k)
    j = (i + 1) % k
    fan = np.arange(1, k - 1)
    f = np.concatenate(
        [
            np.stack([i, j, j + k], 1),
            np.stack([i, j + k, i + k], 1),
            np.stack([0 * fan + k, fan + k, fan + k + 1], 1),
        ]
    )
    return Mesh(v, f)


# ---- Relief ----------------------------------------------------------------------------------------------------


def waves(x, y, rng, count, shortest, longest):
    """A smooth random function of (x, y), variance about ½: plane waves of random direction, length and phase."""
    total = np.zeros(np.broadcast(x, y).shape)
    for _ in range(count):
        heading, phase = rng.uniform(0, 2 * np.pi, 2)
        k = 2 * np.pi / np.exp(rng.uniform(np.log(shortest), np.log(longest)))
        total += np.sin(k * (x * np.cos(heading) + y * np.sin(heading)) + phase)
    return total / np.sqrt(count)


def creases(x, y, rng, count, extent, length, width, heading=0.0, spread=np.pi):
    """Sum of soft ridges of height ±1 at random places of the rectangle `extent` = (x0, x1, y0, y1)."""
    total = np.zeros(np.broadcast(x, y).shape)
    for _ in range(count):
        cx, cy = rng.uniform(extent[0], extent[1]), rng.uniform(extent[2], extent[3])
        turn = heading + rng.uniform(-spread, spread) / 2
        bend, l, w = rng.normal(0, 0.6), length * rng.uniform(0.5, 1.5), width * rng.uniform(0.6, 1.6)
        along = (x - cx) * np.cos(turn) + (y - cy) * np.sin(turn)
        across = (y - cy) * np.cos(turn) - (x - cx) * np.sin(turn) - bend * along * along
        total += rng.choice([1, 1, -0.7]) * np.exp(-((along / l) ** 2) - (across / w) ** 2)
    return total


# ---- Files -----------------------------------------------------------------------------------------------------


def write_ply(path, mesh):
    """Binary little-endian PLY."""
    names = ["x", "y", "z"]
    columns = mesh.v
    if mesh.n is not None:
        names += ["nx", "ny", "nz"]
        columns = np.concatenate([columns, mesh.n], axis=1)
    faces = np.empty(len(mesh.f), dtype=[("count", "u1"), ("indices", "<i4", 3)])
    faces["count"], faces["indices"] = 3, mesh.f
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(mesh.v)}"]
    header += [f"property float {name}" for name in names]
    header += [f"element face {len(mesh.f)}", "property list uchar int vertex_indices", "end_header", ""]
    with open(path, "wb") as file:
        file.write("\n".join(header).encode())
        file.write(columns.astype("<f4").tobytes())
        file.write(faces.tobytes())
