# SPDX-License-Identifier: Apache-2.0
"""What the modules of the room hand to the generator."""

from typing import NamedTuple, Optional, Tuple

from meshes import Mesh


class Part(NamedTuple):
    """A piece of the object `name`. Pieces of one object and one material share a file."""

    name: str
    material: str
    mesh: Mesh
    radiance: Optional[Tuple[float, float, float]] = None  # linear sRGB of an area light, both sides
