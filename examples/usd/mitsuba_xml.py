# SPDX-License-Identifier: Apache-2.0
"""Elements of Mitsuba 3's XML, and matrices (4,4) for columns."""

import xml.etree.ElementTree as ET
from dataclasses import dataclass, field

import numpy as np
from pxr import Tf, UsdGeom

# USD's lights and cameras look along -z, Mitsuba's along +z; x turns too, so that nothing is mirrored.
TURNED = np.diag([-1.0, 1, -1, 1])
DRAWN = (UsdGeom.Tokens.default_, UsdGeom.Tokens.render)


def element(tag, kind=None, name=None, **values):
    attributes = {"type": kind, "name": name, **{key: text(value) for key, value in values.items()}}
    return ET.Element(tag, {key: value for key, value in attributes.items() if value is not None})


def text(value):
    """Numbers with the digits that give the same float back."""
    if isinstance(value, (str, type(None))):
        return value
    return " ".join(f"{float(number):.9g}" for number in np.ravel(value))


def number(name, value):
    return element("float", name=name, value=value)


def color(name, value):
    return element("rgb", name=name, value=value)


def with_children(parent, *children):
    parent.extend(child for child in children if child is not None)
    return parent


def column_matrix(matrix):
    """(4,4) for columns, of a Gf.Matrix4d, which is for rows."""
    return np.array(matrix).T


def placed(matrix, name="to_world"):
    return with_children(element("transform", name=name), element("matrix", value=matrix))


def bounds(stage, time):
    """The centre of what is drawn, (3,), and the diagonal of its box; (0, 0, 0) and 1 where that is unknown."""
    try:
        box = UsdGeom.BBoxCache(time, DRAWN).ComputeWorldBound(stage.GetPseudoRoot()).ComputeAlignedRange()
    except Tf.ErrorException:  # an instancer without its prototypes, for example
        return np.zeros(3), 1.0
    return (np.zeros(3), 1.0) if box.IsEmpty() else (np.array(box.GetMidpoint()), box.GetSize().GetLength())


def rigid(matrix):
    """The rotation nearest to a matrix (4,4), with its translation."""
    u, _, v = np.linalg.svd(matrix[:3, :3])
    turned = np.eye(4)
    turned[:3, :3] = u @ np.diag([1, 1, np.linalg.det(u @ v)]) @ v
    turned[:3, 3] = matrix[:3, 3]
    return turned


def even_scale(matrix):
    """By how much a matrix scales, if alike in all directions; otherwise nothing."""
    square = matrix[:3, :3].T @ matrix[:3, :3]
    scale = np.trace(square) / 3
    return np.sqrt(scale) if scale > 0 and np.abs(square - scale * np.eye(3)).max() < 1e-5 * scale else None


@dataclass
class Shape:
    """A shape of Mitsuba: its parameters but to_world, and its surface, or black. A lamp has a radiance."""

    kind: str
    matrix: np.ndarray
    surface: object = None
    parameters: list = field(default_factory=list)
    radiance: ET.Element | None = None

    def xml(self, world):
        out = with_children(element("shape", self.kind), *self.parameters, placed(world @ self.matrix))
        black = with_children(element("bsdf", "diffuse"), color("reflectance", (0, 0, 0)))
        out.append(element("ref", id=self.surface.id, name="bsdf") if self.surface else black)
        if self.radiance is not None:
            out.append(with_children(element("emitter", "area"), self.radiance))
        return out
