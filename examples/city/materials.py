# SPDX-License-Identifier: Apache-2.0
"""The city's materials in PBRT's words: linear sRGB reflectances; glass is a thin sheet."""

DIFFUSE = {
    "brick-0": (0.36, 0.15, 0.10),
    "brick-1": (0.28, 0.13, 0.09),
    "brick-2": (0.45, 0.28, 0.18),
    "stucco-0": (0.66, 0.54, 0.36),
    "stucco-1": (0.68, 0.63, 0.54),
    "stucco-2": (0.58, 0.60, 0.60),
    "stone-0": (0.55, 0.51, 0.44),
    "stone-1": (0.42, 0.40, 0.37),
    "concrete": (0.46, 0.45, 0.43),
    "panel-0": (0.40, 0.44, 0.48),
    "panel-1": (0.17, 0.20, 0.24),
    "frame-white": (0.74, 0.73, 0.70),
    "frame-dark": (0.06, 0.06, 0.065),
    "frame-green": (0.08, 0.16, 0.12),
    "wood": (0.27, 0.17, 0.09),
    "roofing": (0.20, 0.20, 0.21),
    "gravel": (0.42, 0.40, 0.36),
    "slate": (0.14, 0.15, 0.18),
    "tile": (0.45, 0.17, 0.09),
    "tile-brown": (0.28, 0.15, 0.10),
    "copper": (0.22, 0.42, 0.35),
    "dark": (0.03, 0.03, 0.03),
    "room-0": (0.30, 0.26, 0.21),
    "room-1": (0.16, 0.14, 0.13),
    "room-2": (0.42, 0.38, 0.32),
    "room-3": (0.10, 0.10, 0.11),
    "curtain-0": (0.76, 0.74, 0.68),
    "curtain-1": (0.60, 0.50, 0.36),
    "curtain-2": (0.50, 0.53, 0.56),
    "awning-0": (0.45, 0.06, 0.05),
    "awning-1": (0.06, 0.22, 0.14),
    "awning-2": (0.62, 0.48, 0.22),
    "asphalt": (0.115, 0.115, 0.12),
    "marking": (0.62, 0.62, 0.58),
    "kerb": (0.46, 0.45, 0.43),
    "paving": (0.38, 0.37, 0.35),
    "paving-dark": (0.30, 0.29, 0.28),
    "grass": (0.12, 0.21, 0.06),
    "land-0": (0.19, 0.23, 0.09),
    "land-1": (0.29, 0.27, 0.12),
    "land-2": (0.14, 0.21, 0.07),
    "land-3": (0.25, 0.19, 0.12),
    "hill": (0.16, 0.21, 0.13),
    "bark": (0.14, 0.10, 0.07),
    "leaf-0": (0.10, 0.22, 0.05),
    "leaf-1": (0.15, 0.27, 0.06),
    "leaf-2": (0.20, 0.25, 0.07),
    "tyre": (0.025, 0.025, 0.025),
    "lens": (0.75, 0.74, 0.70),
}
PAINT = {
    "car-0": (0.70, 0.70, 0.70),
    "car-1": (0.04, 0.04, 0.045),
    "car-2": (0.33, 0.34, 0.36),
    "car-3": (0.35, 0.03, 0.03),
    "car-4": (0.04, 0.10, 0.28),
    "car-5": (0.75, 0.73, 0.66),
    "car-6": (0.72, 0.45, 0.03),
}
OTHERS = (
    'MakeNamedMaterial "glass" "string type" "thindielectric" "float eta" [1.5]',
    'MakeNamedMaterial "dark-glass" "string type" "coateddiffuse" "rgb reflectance" [0.03 0.035 0.04]'
    ' "float roughness" [0]',
    'MakeNamedMaterial "metal" "string type" "conductor" "spectrum eta" "metal-Al-eta" "spectrum k" "metal-Al-k"'
    ' "float roughness" [0.35]',
)


def all_materials():
    """Lines that define them."""
    for name, rgb in DIFFUSE.items():
        yield f'MakeNamedMaterial "{name}" "string type" "diffuse" "rgb reflectance" [{rgb[0]} {rgb[1]} {rgb[2]}]'
    for name, rgb in PAINT.items():
        yield (
            f'MakeNamedMaterial "{name}" "string type" "coateddiffuse"'
            f' "rgb reflectance" [{rgb[0]} {rgb[1]} {rgb[2]}] "float roughness" [0]'
        )
    yield from OTHERS
