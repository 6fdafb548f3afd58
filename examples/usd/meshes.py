# SPDX-License-Identifier: Apache-2.0
"""Triangles of UsdGeom meshes and gprims, and binary PLY files that Mitsuba 3 reads."""

import hashlib
import os
from dataclasses import dataclass, replace

import numpy as np
from pxr import UsdGeom


@dataclass
class Triangles:
    """points (n,3); faces (m,3) indices, counter-clockwise from outside; normals (n,3), uvs (n,2) with v upwards and
    colors (n,3), linear, or nothing; sources (m,): the USD face that each triangle is of."""

    points: np.ndarray
    faces: np.ndarray
    normals: np.ndarray | None = None
    uvs: np.ndarray | None = None
    colors: np.ndarray | None = None
    sources: np.ndarray | None = None

    def of(self, kept):
        """The triangles of a mask (m,), with the vertices that they use."""
        used, faces = np.unique(self.faces[kept], return_inverse=True)
        take = lambda values: None if values is None else values[used]
        return Triangles(self.points[used], faces.reshape(-1, 3), take(self.normals), take(self.uvs), take(self.colors))

    def reversed(self):
        return replace(self, faces=self.faces[:, ::-1])


def ear_clipped(polygon, normal):
    """Triangles (k,3) of a simple polygon (n,3) that may be concave (Meisters 1975)."""
    axis = int(np.argmax(np.abs(normal)))
    flat = np.delete(polygon, axis, 1) * ([1, -1] if axis == 1 else [1, 1])
    if normal[axis] < 0:
        flat = flat * [1, -1]
    turn = lambda a, b, c: (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    left, triangles = list(range(len(polygon))), []
    while len(left) > 3:
        for i in range(len(left)):
            corners = left[i - 1], left[i], left[(i + 1) % len(left)]
            a, b, c = flat[list(corners)]
            others = (flat[j] for j in left if j not in corners)
            inside = any(min(turn(a, b, p), turn(b, c, p), turn(c, a, p)) >= 0 for p in others)
            if turn(a, b, c) > 0 and not inside:
                break
        else:  # it crosses itself: any triangle will do
            i, corners = 1, tuple(left[:3])
        triangles.append(corners)
        del left[i]
    return np.array(triangles + [tuple(left)])


def triangulated(points, counts, indices):
    """Corners (m,3), which index `indices`, and faces (m,): fans, or clipped ears where a polygon is concave."""
    starts = np.concatenate([[0], np.cumsum(counts)[:-1]]).astype(np.int64)
    number = np.maximum(counts - 2, 0)
    faces = np.repeat(np.arange(len(counts)), number)
    step = np.arange(len(faces)) - np.repeat(np.cumsum(number) - number, number)
    corners = np.stack([starts[faces], starts[faces] + step + 1, starts[faces] + step + 2], axis=1)
    a, b, c = (points[indices[corners[:, k]]] for k in range(3))
    areas, normals = np.cross(b - a, c - a), np.zeros((len(counts), 3))
    np.add.at(normals, faces, areas)
    against = np.einsum("ij,ij->i", areas, normals[faces]) < 0
    for face in np.unique(faces[against]):
        polygon = points[indices[starts[face] : starts[face] + counts[face]]]
        corners[faces == face] = starts[face] + ear_clipped(polygon, normals[face])
    return corners, faces


def smooth_normals(points, faces):
    """Means of the faces' normals by area, (n,3)."""
    a, b, c = (points[faces[:, k]] for k in range(3))
    normals = np.zeros_like(points)
    np.add.at(normals, faces.ravel(), np.repeat(np.cross(b - a, c - a), 3, axis=0))
    return normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-30)


class Corners:
    """The values of primvars at the corners of triangles: indices of points and of face-varying values (m,3)."""

    def __init__(self, points, corners, faces, note):
        self.points, self.corners, self.faces, self.note = points, corners, faces, note

    def values(self, values, interpolation, width):
        """(3m,width), or nothing where the number of values does not fit."""
        values = np.asarray(values, dtype=np.float64).reshape(-1, width)
        if interpolation == UsdGeom.Tokens.constant:
            values, index = values[:1], np.zeros(self.corners.size, dtype=np.int64)
        else:
            index = {
                UsdGeom.Tokens.uniform: np.repeat(self.faces, 3),
                UsdGeom.Tokens.faceVarying: self.corners.ravel(),
            }.get(interpolation, self.points.ravel())
        if index.size and index.max() < len(values):
            return values[index]
        return self.note("normals or a primvar of fewer values than the mesh needs: left out")

    def primvar(self, primvar, time, width):
        values = primvar.ComputeFlattened(time) if primvar else None
        if values is None or len(values) == 0:
            return None
        return self.values(values, primvar.GetInterpolation(), width)


def read_mesh(prim, time, uv_name, note):
    """Triangles of a UsdGeomMesh; nothing where it has none."""
    mesh, primvars = UsdGeom.Mesh(prim), UsdGeom.PrimvarsAPI(prim)
    points = np.array(mesh.GetPointsAttr().Get(time) or [], dtype=np.float64).reshape(-1, 3)
    counts = np.array(mesh.GetFaceVertexCountsAttr().Get(time) or [], dtype=np.int64)
    indices = np.array(mesh.GetFaceVertexIndicesAttr().Get(time) or [], dtype=np.int64)
    if not len(counts) or counts.sum() != len(indices) or indices.min() < 0 or indices.max() >= len(points):
        note("mesh without faces, or with indices that do not fit", prim)
        return None
    corners, faces = triangulated(points, counts, indices)
    kept = ~np.isin(faces, list(mesh.GetHoleIndicesAttr().Get(time) or []))
    corners, faces = corners[kept], faces[kept]
    if mesh.GetOrientationAttr().Get(time) == UsdGeom.Tokens.leftHanded:
        corners = corners[:, ::-1]
    at = Corners(indices[corners], corners, faces, lambda kind: note(kind, prim))

    scheme = mesh.GetSubdivisionSchemeAttr().Get(time)
    normals = at.primvar(primvars.GetPrimvar("normals"), time, 3)
    if normals is None and (authored := mesh.GetNormalsAttr().Get(time)):
        normals = at.values(authored, mesh.GetNormalsInterpolation(), 3)
    if scheme != UsdGeom.Tokens.none:
        note(f'subdivisionScheme "{scheme}": its control mesh is written, with smooth normals', prim)
        normals = smooth_normals(points, at.points)[at.points.ravel()]
    uvs = at.primvar(primvars.FindPrimvarWithInheritance(uv_name), time, 2)
    colors = at.primvar(primvars.FindPrimvarWithInheritance("displayColor"), time, 3)

    parts = [points[at.points.ravel()], normals, uvs, colors]
    rows = np.concatenate([part for part in parts if part is not None], axis=1).astype("<f4") + np.float32(0)
    _, first, faces_of = np.unique(
        rows.view(np.dtype((np.void, rows.shape[1] * 4))).ravel(), return_index=True, return_inverse=True
    )
    take = lambda values: None if values is None else values[first]
    return Triangles(*map(take, parts[:1]), faces_of.reshape(-1, 3), *map(take, parts[1:]), at.faces)


def revolved(strips, segments=64):
    """Strips of (radius, z, normal's radius, normal's z), each from below to above, turned about z."""
    points, normals, faces, first = [], [], [], 0
    angles = np.linspace(0, 2 * np.pi, segments + 1)
    around = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    for strip in strips:
        for radius, z, normal_radius, normal_z in strip:
            points.append(np.column_stack([radius * around, np.full(segments + 1, z)]))
            normals.append(np.column_stack([normal_radius * around, np.full(segments + 1, normal_z)]))
        for k in range(len(strip) - 1):
            a = first + k * (segments + 1) + np.arange(segments)
            b = a + segments + 1
            faces += [np.stack([a, a + 1, b + 1], axis=1)] if strip[k][0] > 0 else []
            faces += [np.stack([a, b + 1, b], axis=1)] if strip[k + 1][0] > 0 else []
        first += len(strip) * (segments + 1)
    return Triangles(np.concatenate(points), np.concatenate(faces), np.concatenate(normals))


def arc(radius, z, start, end):
    """A strip of a circle about (0, z), between two latitudes in degrees."""
    latitudes = np.radians(np.linspace(start, end, 33))
    directions = zip(np.cos(latitudes), np.sin(latitudes))
    return [(0 if abs(c) < 1e-9 else radius * c, z + radius * s, c, s) for c, s in directions]


def along(triangles, axis):
    """A body about z laid along "X", "Y" or "Z"; turned, not mirrored."""
    shift = {"X": 1, "Y": 2, "Z": 0}[axis]
    turn = lambda values: np.roll(values, shift, axis=1)
    return replace(triangles, points=turn(triangles.points), normals=turn(triangles.normals))


def gprim(prim, time):
    """Triangles of a sphere, cube, cylinder, cone, capsule or plane; nothing of another prim."""
    number = lambda name: float(prim.GetAttribute(name).Get(time))
    kind = prim.GetTypeName().removesuffix("_1")
    axis = prim.GetAttribute("axis").Get(time) or "Z"
    if kind == "Sphere":
        return revolved([arc(number("radius"), 0, -90, 90)])
    if kind == "Cube":
        half = number("size") / 2
        corners = np.array([[x, y, z] for x in (-half, half) for y in (-half, half) for z in (-half, half)])
        quads = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
        return Triangles(corners, np.concatenate([quads[:, :3], quads[:, [0, 2, 3]]]))
    if kind == "Plane":
        w, h = number("width") / 2, number("length") / 2
        if axis != "Z":  # X: the width lies along z, the length along y; Y: along x and z
            w, h = h, w
        points, up = np.array([[-w, -h, 0], [w, -h, 0], [w, h, 0], [-w, h, 0]]), np.array([[0.0, 0, 1]] * 4)
        return along(Triangles(points, np.array([[0, 1, 2], [0, 2, 3]]), up), axis)
    if kind not in ("Cylinder", "Cone", "Capsule"):
        return None
    half = number("height") / 2
    tapered = prim.GetTypeName().endswith("_1")
    below = number("radiusBottom" if tapered else "radius")
    above = 0 if kind == "Cone" else number("radiusTop" if tapered else "radius")
    slope = np.array([2 * half, below - above]) / (np.hypot(2 * half, below - above) or 1)
    if kind == "Capsule" and below == above:
        return along(revolved([arc(below, -half, -90, 0) + arc(above, half, 0, 90)]), axis)
    if kind == "Capsule":  # the side touches both spheres, so that its normal is that of their circles there
        tilt = np.degrees(np.arcsin(np.clip((below - above) / max(2 * half, 1e-30), -1, 1)))
        return along(revolved([arc(below, -half, -90, tilt) + arc(above, half, tilt, 90)]), axis)
    strips = [[(below, -half, *slope), (above, half, *slope)], [(0, -half, 0, -1), (below, -half, 0, -1)]]
    return along(revolved(strips + ([[(above, half, 0, 1), (0, half, 0, 1)]] if above > 0 else [])), axis)


class PlyFiles:
    """Writes meshes to a folder, those of the same bytes once."""

    def __init__(self, folder):
        self.folder, self.written = folder, {}

    def write(self, triangles, name):
        """The file's path. v is turned downwards, as Mitsuba's images have their first row at v = 0."""
        uvs = None if triangles.uvs is None else np.column_stack([triangles.uvs[:, 0], 1 - triangles.uvs[:, 1]])
        columns = [(triangles.points, "xyz"), (triangles.normals, ["nx", "ny", "nz"]), (uvs, "uv")]
        columns = [(values, names) for values, names in columns + [(triangles.colors, "rgb")] if values is not None]
        faces = np.empty(len(triangles.faces), dtype=[("n", "u1"), ("i", "<i4", 3)])
        faces["n"], faces["i"] = 3, triangles.faces
        head = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(triangles.points)}\n"
        head += "".join(f"property float {field}\n" for _, names in columns for field in names)
        head += f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
        vertices = np.concatenate([values for values, _ in columns], axis=1).astype("<f4")
        data = head.encode() + vertices.tobytes() + faces.tobytes()
        digest = hashlib.sha1(data).digest()
        if digest not in self.written:
            os.makedirs(self.folder, exist_ok=True)
            path = os.path.join(self.folder, f"{name}-{len(self.written)}.ply")
            with open(path, "wb") as file:
                file.write(data)
            self.written[digest] = path
        return self.written[digest]
