# SPDX-License-Identifier: Apache-2.0
"""Films, bundles and spectra of Vitrail as NumPy arrays, and its programs as functions.

    import vitrail
    film = vitrail.render("room.pbrt", "room.png", spp=16, progress=print)
    film                                  # a notebook shows it
    film.rgb.mean(axis=(0, 1))            # float32, height × width × 3, linear sRGB
    vitrail.Manifest("room.vit").domain_bytes
    vitrail.spectrum("metal-Cu-eta")      # at vitrail.wavelengths, in nm
"""

import numpy as _np

from ._vitrail import Film, Manifest, spectrum, spectrum_names, table_size
from .programs import ProgramError, convert, partition, render, statistics

wavelengths = _np.arange(360.0, 360.0 + table_size)

__all__ = ["Film", "Manifest", "ProgramError", "convert", "partition", "render", "spectrum", "spectrum_names",
           "statistics", "wavelengths"]
