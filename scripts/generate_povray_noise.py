#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures the numbers of POV-Ray's noise, as scene/models/pattern_noise_table.cpp has them.

  scripts/generate_povray_noise.py > scene/models/pattern_noise_table.cpp

It needs povray and NumPy. In a cell of the lattice noise is linear in the numbers of its eight corners (scene/models/pattern_noise.h),
so that vturbulence() of one octave at 60 random points gives twelve numbers of each corner: those behind the place that the hash says.
The cells are chosen so that their lower corners have every place of 256. No corner may be off by 10⁻⁹.
"""
import itertools
import pathlib
import subprocess
import tempfile

import numpy as np

HASHES, PLACES, BEGIN, A_CORNER, POINTS = 4096, 256, 10000, 12, 60
HEAD = """// SPDX-License-Identifier: Apache-2.0
// By scripts/generate_povray_noise.py, from povray 3.7.
#include "scene/models/pattern_noise_table.h"

namespace vitrail {

const std::array<double, 267> pattern_noise_table{
"""


def shuffled():
    state, order = 0, list(range(HASHES))
    for i in reversed(range(HASHES)):
        state = (state * 1812433253 + 12345) & 0xFFFFFFFF
        j = (state >> 16 & 0x7FFF) % HASHES
        order[i], order[j] = order[j], order[i]
    return order


def by_povray(points):
    """vturbulence() of one octave."""
    with tempfile.TemporaryDirectory() as folder:
        triples = ",\n".join("<%.17g, %.17g, %.17g>" % tuple(p) for p in points)
        text = f"""#version 3.7;
#declare Points = array[{len(points)}] {{ {triples} }};
#fopen Out "noise.txt" write
#declare I = 0;
#while (I < {len(points)})
  #declare N = vturbulence(2, 0.5, 1, Points[I]);
  #write (Out, str(N.x, 0, 17), " ", str(N.y, 0, 17), " ", str(N.z, 0, 17), "\\n")
  #declare I = I + 1;
#end
#fclose Out
camera {{ }} sphere {{ 0, 1 }}
"""
        (pathlib.Path(folder) / "noise.pov").write_text(text)
        subprocess.run(["povray", "noise.pov", "-D", "+Oout.png", "+W4", "+H4"], cwd=folder, capture_output=True, check=True)
        return np.loadtxt(pathlib.Path(folder) / "noise.txt")


def basis(within):
    """What multiplies value and slopes of each corner, at points of the unit cell."""
    columns = []
    for corner in itertools.product((0, 1), repeat=3):
        faded = within**2 * (3 - 2 * within)
        weight = np.prod([faded[:, i] if corner[i] else 1 - faded[:, i] for i in range(3)], axis=0)
        columns += [weight / 2] + [weight * (within[:, i] - corner[i]) for i in range(3)]
    return np.array(columns).T


def main():
    order, random = shuffled(), np.random.default_rng(1)
    place = lambda i, j, k: order[order[order[i + BEGIN & 4095] ^ (j + BEGIN & 4095)] ^ (k + BEGIN & 4095)] & 255
    cells = {}
    for cell in itertools.product(range(40), repeat=3):
        cells.setdefault(place(*cell), cell)
    assert len(cells) == PLACES
    within = random.random((PLACES, POINTS, 3))
    values = by_povray(np.concatenate([within[p] + np.array(cells[p]) for p in range(PLACES)])).reshape(PLACES, POINTS, 3)
    found = [[] for _ in range(PLACES + A_CORNER - 1)]
    for p in range(PLACES):
        system = basis(within[p])
        numbers = np.linalg.lstsq(system, values[p], rcond=None)[0]
        assert np.abs(system @ numbers - values[p]).max() < 1e-12
        for i in range(A_CORNER):
            found[p + i].append(numbers[i % 4, i // 4])
    assert max(np.ptp(numbers) for numbers in found) < 1e-9
    rows = [f"{np.mean(numbers):.10g}" for numbers in found]
    text = "".join("    " + ", ".join(rows[i : i + 8]) + ",\n" for i in range(0, len(rows), 8))
    print(HEAD + text + "};\n\n}  // namespace vitrail")


if __name__ == "__main__":
    main()
