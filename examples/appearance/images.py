# SPDX-License-Identifier: Apache-2.0
"""The scene's images, computed: PNG (8 bit), PFM and Radiance HDR (float), written with the standard library alone."""

import math
import struct
import zlib


def hash01(*cell):
    """A number in [0, 1) of whole numbers."""
    h = 2166136261
    for value in cell:
        h = ((h ^ (value & 0xFFFF)) * 16777619) & 0xFFFFFFFF
        h ^= h >> 13
    return (h * 2654435761 & 0xFFFFFFFF) / 2**32


def noise(x, y, period, seed=0):
    """Smooth, in [0, 1), of `period` cells a unit, periodic in the unit square."""
    x, y = x * period, y * period
    i, j = math.floor(x), math.floor(y)
    fade = lambda t: t * t * (3 - 2 * t)
    u, v = fade(x - i), fade(y - j)
    at = lambda di, dj: hash01((i + di) % period, (j + dj) % period, seed)
    return (at(0, 0) * (1 - u) + at(1, 0) * u) * (1 - v) + (at(0, 1) * (1 - u) + at(1, 1) * u) * v


def mixed(a, b, t):
    return tuple(p + (q - p) * t for p, q in zip(a, b))


def raster(width, height, value):
    """value(u, v) at pixel centres, v from the bottom; rows from the top."""
    return [
        [value((x + 0.5) / width, 1 - (y + 0.5) / height) for x in range(width)] for y in range(height)
    ]


def write_png(path, rows):
    """Of tuples of 1 (grey) or 3 numbers in [0, 1], as they are."""
    channels = len(rows[0][0])
    data = b"".join(
        b"\0" + bytes(max(0, min(255, round(255 * c))) for pixel in row for c in pixel) for row in rows
    )

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 0 if channels == 1 else 2, 0, 0, 0)
    path.write_bytes(
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(data, 9)) + chunk(b"IEND", b"")
    )


def write_pfm(path, rows):
    body = b"".join(struct.pack("<3f", *pixel) for row in reversed(rows) for pixel in row)
    path.write_bytes(f"PF\n{len(rows[0])} {len(rows)}\n-1.0\n".encode() + body)


def rgbe(pixel):
    most = max(pixel)
    if most < 1e-32:
        return bytes(4)
    mantissa, exponent = math.frexp(most)
    return bytes(int(c * mantissa * 256 / most) for c in pixel) + bytes([exponent + 128])


def write_hdr(path, rows):
    header = f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {len(rows)} +X {len(rows[0])}\n"
    path.write_bytes(header.encode() + b"".join(rgbe(pixel) for row in rows for pixel in row))


# ---- What they show


def wood(u, v):
    ring = noise(u, v, 4, 1) + 0.35 * noise(u, v, 16, 2)
    return mixed((0.45, 0.28, 0.15), (0.72, 0.52, 0.32), 0.5 + 0.5 * math.sin(2 * math.pi * (3 * v + ring)))


def plaster(u, v):
    return mixed((0.78, 0.72, 0.62), (0.90, 0.87, 0.80), noise(u, v, 8, 3) * 0.6 + noise(u, v, 32, 4) * 0.4)


def brick_height(u, v):
    """1 on bricks, 0 in the joints, rounded; 4 rows and 4 columns."""
    row = math.floor(v * 4)
    x, y = (u * 4 + 0.5 * (row % 2)) % 1, v * 4 % 1
    edge = min(x, 1 - x, 0.6 * y, 0.6 * (1 - y))
    return min(1.0, max(0.0, edge * 14))


def brick(u, v):
    stone = mixed((0.50, 0.26, 0.20), (0.66, 0.38, 0.28), noise(u, v, 16, 5))
    return mixed((0.66, 0.63, 0.58), stone, brick_height(u, v))


def waves(u, v):
    return 0.5 + 0.25 * math.sin(2 * math.pi * (4 * u + v)) + 0.25 * math.sin(2 * math.pi * (5 * v - 2 * u))


def normals_of(height, depth):
    """A tangent-space normal map, 0.5 + 0.5·n."""

    def value(u, v):
        e = 1 / 128
        n = (
            -depth * (height(u + e, v) - height(u - e, v)) / (2 * e),
            -depth * (height(u, v + e) - height(u, v - e)) / (2 * e),
            1,
        )
        length = math.sqrt(sum(c * c for c in n))
        return tuple(0.5 + 0.5 * c / length for c in n)

    return value


def painting(u, v):
    """Hills before a setting sun."""
    sky = mixed((0.95, 0.62, 0.30), (0.25, 0.38, 0.66), min(1, max(0, (v - 0.3) * 1.6)))
    if (u - 0.62) ** 2 + (v - 0.52) ** 2 < 0.012:
        sky = (1.0, 0.93, 0.70)
    if v < 0.42 + 0.10 * math.sin(6 * u + 0.5):
        sky = (0.35, 0.42, 0.40)
    if v < 0.26 + 0.09 * math.sin(5 * u + 2):
        sky = (0.20, 0.32, 0.16)
    return mixed(sky, (1, 1, 1), 0.12 * noise(u, v, 32, 6))


def leaf(u, v):
    """Opacity: 1 within a leaf with holes."""
    x, y = 2 * u - 1, 2 * v - 1
    inside = abs(x) < 0.9 * (1 - y * y) * (0.75 - 0.25 * y)
    hole = noise(u, v, 8, 7) > 0.72
    return 1.0 if inside and not hole else 0.0


def spots(u, v):
    return 1.0 if noise(u, v, 8, 8) > 0.55 else 0.0


def window_slide(u, v):
    """What the projector throws: coloured panes with leads."""
    i, j = math.floor(u * 4), math.floor(v * 4)
    if min(u * 4 % 1, v * 4 % 1) < 0.08:
        return (0.02, 0.02, 0.02)
    hue = 2 * math.pi * hash01(i, j, 9)
    return tuple(0.5 + 0.45 * math.cos(hue - k * 2 * math.pi / 3) for k in range(3))


def sky(d):
    """Radiance from direction d, y up: a blue dome, a warm sun, dim ground."""
    x, y, z = d
    if y < 0:
        return (0.10, 0.09, 0.07)
    dome = mixed((0.75, 0.82, 0.95), (0.18, 0.32, 0.70), y)
    sun = 0.75 * x + 0.55 * y + 0.37 * z  # about 0.75 long towards the window
    glow = 10 * max(0.0, sun) ** 64
    return tuple(c + glow * s for c, s in zip(dome, (1.0, 0.85, 0.6)))


def latitude_longitude(u, v):
    """Mitsuba's: u = atan2(x, −z)/2π, the top row is +y."""
    phi, theta = 2 * math.pi * u, math.pi * (1 - v)
    return sky((math.sin(theta) * math.sin(phi), math.cos(theta), -math.sin(theta) * math.cos(phi)))


def equal_area_direction(u, v):
    """The square of Clarberg 2008 as a direction, +z up."""
    x, y = 2 * u - 1, 2 * v - 1
    signed = 1 - abs(x) - abs(y)
    r = 1 - abs(signed)
    phi = math.pi / 4 * ((abs(y) - abs(x)) / r + 1) if r > 0 else 0
    z = math.copysign(1 - r * r, signed)
    s = r * math.sqrt(max(0, 2 - r * r))
    return math.copysign(math.cos(phi), x) * s, math.copysign(math.sin(phi), y) * s, z


def equal_area_sky(u, v):
    """The scene turns +z of the light's frame to its +y; rows from the top count as v from 0, as pbrt has it."""
    x, y, z = equal_area_direction(u, 1 - v)
    return sky((x, z, -y))


def lantern(u, v):
    """Equal-area; bright bands for the goniometric light."""
    z = equal_area_direction(u, 1 - v)[2]
    band = 1.0 if math.floor(4 * z + 8) % 2 else 0.15
    return (band, 0.9 * band, 0.7 * band)


def grey(value):
    return lambda u, v: (value(u, v),)


def write_all(folder, size=64):
    folder.mkdir(parents=True, exist_ok=True)
    for name, value in {
        "wood": wood,
        "plaster": plaster,
        "brick": brick,
        "brick-height": grey(brick_height),
        "brick-normals": normals_of(brick_height, 0.012),
        "waves": grey(waves),
        "waves-normals": normals_of(waves, 0.05),
        "painting": painting,
        "leaf": grey(leaf),
        "spots": grey(spots),
        "slide": window_slide,
    }.items():
        write_png(folder / f"{name}.png", raster(size, size, value))
    write_pfm(folder / "rainbow.pfm", raster(size, 8, lambda u, v: window_slide(u / 4 + 0.02, v / 8 + 0.1)))
    write_hdr(folder / "sky-lat-long.hdr", raster(2 * size, size, latitude_longitude))
    write_hdr(folder / "sky-equal-area.hdr", raster(size, size, equal_area_sky))
    write_hdr(folder / "lantern.hdr", raster(size, size, lantern))
