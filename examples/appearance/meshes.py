# SPDX-License-Identifier: Apache-2.0
"""The scene's shapes, each about its own origin, y up: positions, normals, (u, v) and faces of a small PLY file."""

import math
import struct

SEGMENTS = 24


def lathe(profile, segments=SEGMENTS):
    """Turns (radius, height) points, from the bottom up, about the y axis; normals are smooth along the profile."""
    rows = []
    for k, (r, y) in enumerate(profile):
        (r0, y0), (r1, y1) = profile[max(k - 1, 0)], profile[min(k + 1, len(profile) - 1)]
        slope = math.hypot(r1 - r0, y1 - y0)
        rows.append((r, y, (y1 - y0) / slope, -(r1 - r0) / slope, k / (len(profile) - 1)))
    vertices, faces = [], []
    for r, y, outward, upward, v in rows:
        for s in range(segments + 1):
            c, d = math.cos(2 * math.pi * s / segments), math.sin(2 * math.pi * s / segments)
            if s == segments:
                c, d = 1.0, 0.0
            vertices.append((r * c, y, r * d, outward * c, upward, outward * d, s / segments, v))
    n = segments + 1
    for k in range(len(rows) - 1):
        for s in range(segments):
            a, b = k * n + s, (k + 1) * n + s
            if rows[k][0] > 0:
                faces.append((a, b, a + 1))
            if rows[k + 1][0] > 0:
                faces.append((a + 1, b, b + 1))
    return vertices, faces


def sphere(radius=1.0, rings=12):
    angles = [math.pi * k / rings for k in range(rings + 1)]
    profile = [(radius * math.sin(t), -radius * math.cos(t)) for t in angles]
    profile[0], profile[-1] = (0.0, -radius), (0.0, radius)
    return lathe(profile)


def vase():
    """Closed, so that it may be of glass; height 2 about the origin."""
    outline = [(0, -1), (0.42, -1), (0.60, -0.82), (0.72, -0.5), (0.68, -0.15), (0.46, 0.2), (0.30, 0.45)]
    outline += [(0.30, 0.65), (0.44, 0.92), (0.42, 1.0), (0.22, 0.9), (0.16, 0.6), (0, 0.45)]
    return lathe(outline)


def box(x, y, z):
    """Half extents; faces of their own, (u, v) in [0, 1]²."""
    half, vertices, faces = (x, y, z), [], []
    for axis in range(3):
        for sign in (-1, 1):
            u, v = (axis + 1) % 3, (axis + 2) % 3
            if sign < 0:
                u, v = v, u
            normal = [0.0, 0.0, 0.0]
            normal[axis] = float(sign)
            first = len(vertices)
            for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)):
                p = [0.0, 0.0, 0.0]
                p[axis], p[u], p[v] = sign * half[axis], (2 * a - 1) * half[u], (2 * b - 1) * half[v]
                vertices.append((*p, *normal, a, b))
            faces += [(first, first + 1, first + 2), (first, first + 2, first + 3)]
    return vertices, faces


def quad(corner, u, v, cells=1):
    """A rectangle from `corner` along u and v, which faces u × v."""
    normal = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
    length = math.sqrt(sum(c * c for c in normal))
    normal = tuple(c / length for c in normal)
    vertices, faces = [], []
    for j in range(cells + 1):
        for i in range(cells + 1):
            s, t = i / cells, j / cells
            vertices.append((*(corner[k] + s * u[k] + t * v[k] for k in range(3)), *normal, s, t))
    for j in range(cells):
        for i in range(cells):
            a = j * (cells + 1) + i
            b = a + cells + 1
            faces += [(a, a + 1, b + 1), (a, b + 1, b)]
    return vertices, faces


def rainbow(t):
    return tuple(0.5 + 0.4 * math.cos(2 * math.pi * (t - k / 3)) for k in range(3))


def write_ply(path, mesh, colors=None):
    """`colors`: "vertex" or "face" adds an attribute of that kind, a rainbow."""
    vertices, faces = mesh
    rgb = "property float r\nproperty float g\nproperty float b\n"
    header = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\n"
    header += "".join(f"property float {name}\n" for name in ("x", "y", "z", "nx", "ny", "nz", "u", "v"))
    header += (rgb if colors == "vertex" else "") + f"element face {len(faces)}\n"
    header += "property list uchar int vertex_indices\n" + (rgb if colors == "face" else "") + "end_header\n"
    body = bytearray(header.encode())
    for vertex in vertices:
        body += struct.pack("<8f", *vertex)
        if colors == "vertex":
            body += struct.pack("<3f", *rainbow(vertex[7] + vertex[6]))
    for i, face in enumerate(faces):
        body += struct.pack("<B3i", 3, *face)
        if colors == "face":
            body += struct.pack("<3f", *rainbow(7 * i / len(faces)))
    path.write_bytes(body)


def write_vol(path, n, channels, value):
    """Mitsuba's grid, version 3, of floats over the unit cube; value(x, y, z) → a tuple of `channels`."""
    body = bytearray(b"VOL\x03" + struct.pack("<5i6f", 1, n, n, n, channels, 0, 0, 0, 1, 1, 1))
    for k in range(n):
        for j in range(n):
            for i in range(n):
                body += struct.pack(f"<{channels}f", *value((i + 0.5) / n, (j + 0.5) / n, (k + 0.5) / n))
    path.write_bytes(body)


def smoke(x, y, z):
    """A density in [0, 1] that curls about the middle axis and ends within the unit cube."""
    dx = x - 0.5 - 0.16 * math.sin(5 * y)
    dz = z - 0.5 - 0.16 * math.cos(5 * y)
    r = math.hypot(dx, dz) / (0.14 + 0.18 * y)
    end = min(1.0, 6 * y, 6 * (1 - y))
    return max(0.0, 1 - r * r) * max(0.0, end)
