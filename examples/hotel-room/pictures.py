# SPDX-License-Identifier: Apache-2.0
"""Pictures side by side in one PNG, and lines in an SVG: what the scripts here need of either, without a library."""

import math
import struct
import zlib

import numpy as np

COLORS = ("#4c9be8", "#c97b1a", "#333333", "#7a4fb5", "#2a9d5c")


def read_png(path):
    """[height, width, 3] of an RGB file with 8 bits a channel (PNG specification, 2nd edition, chapters 5 and 9)."""
    data, at, packed = path.read_bytes(), 8, b""
    while at < len(data):
        (length,) = struct.unpack(">I", data[at : at + 4])
        kind, body = data[at + 4 : at + 8], data[at + 8 : at + 8 + length]
        if kind == b"IHDR":
            width, height, *form = struct.unpack(">IIBBBBB", body)
            if form != [8, 2, 0, 0, 0]:
                raise ValueError(f"{path} is not plain RGB of 8 bits")
        elif kind == b"IDAT":
            packed += body
        at += length + 12
    rows = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(height, 1 + 3 * width)
    image = np.zeros((height + 1, width + 1, 3), int)  # with what lies above and left of it: 0
    for y, row in enumerate(rows, 1):
        method, line = row[0], row[1:].reshape(width, 3).astype(int)
        if method in (0, 2):
            image[y, 1:] = line + (image[y - 1, 1:] if method == 2 else 0)
        else:
            for x, value in enumerate(line, 1):
                left, up, corner = image[y, x - 1] % 256, image[y - 1, x], image[y - 1, x - 1]
                if method == 1:
                    near = left
                elif method == 3:
                    near = (left + up) // 2
                else:
                    guess = left + up - corner
                    away = [abs(guess - v) for v in (left, up, corner)]
                    near = np.where(
                        (away[0] <= away[1]) & (away[0] <= away[2]), left, np.where(away[1] <= away[2], up, corner)
                    )
                image[y, x] = value + near
        image[y] %= 256
    return image[1:, 1:].astype(np.uint8)


def write_png(path, image):
    height, width, _ = image.shape
    rows = np.zeros((height, 1 + 3 * width), np.uint8)
    rows[:, 1:] = image.reshape(height, 3 * width)

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    head = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    packed = zlib.compress(rows.tobytes(), 9)
    path.write_bytes(
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", packed) + chunk(b"IEND", b"")
    )


def write_mosaic(path, rows, pad=4):
    """`rows` of PNG files of one size, in one."""
    images = [[read_png(name) for name in row] for row in rows]
    height, width, _ = images[0][0].shape
    sheet = np.full(
        (len(rows) * (height + pad) - pad, len(rows[0]) * (width + pad) - pad, 3), 255, np.uint8
    )
    for i, row in enumerate(images):
        for j, image in enumerate(row):
            y, x = i * (height + pad), j * (width + pad)
            sheet[y : y + height, x : x + width] = image
    write_png(path, sheet)


def write_plot(path, panels, x_name):
    """A panel of each (title, {name of a line: [(x, y), …]}, {name of a level: y}); y by its logarithm."""
    width, height, left, top, foot = 300, 200, 52, 34, 44
    svg = []
    for number, (title, lines, levels) in enumerate(panels):
        x0 = left + number * (width + left + 16)
        points = [p for line in lines.values() for p in line if p[1] > 0]
        first, last = min(x for x, _ in points), max(x for x, _ in points)
        values = [y for _, y in points] + list(levels.values())
        low, high = math.floor(math.log10(min(values))), math.ceil(math.log10(max(values)))

        def place(x, y):
            return (
                x0 + (x - first) / max(last - first, 1e-9) * width,
                top + height * (1 - (math.log10(y) - low) / max(high - low, 1)),
            )

        def text(x, y, words, anchor="middle", color="#000"):
            svg.append(f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" fill="{color}">{words}</text>')

        text(x0 + width / 2, top - 12, title)
        text(x0 + width / 2, top + height + 34, x_name)
        for decade in range(low, high + 1):
            _, y = place(first, 10**decade)
            svg.append(f'<path d="M{x0} {y:.1f}h{width}" stroke="#ddd"/>')
            text(x0 - 5, y + 4, f"{10**decade:g}", "end")
        for x in range(math.ceil(first), math.floor(last) + 1):
            at, _ = place(x, 10**low)
            svg.append(f'<path d="M{at:.1f} {top + height}v4" stroke="#000"/>')
            if (x - math.ceil(first)) % 2 == 0:
                text(at, top + height + 17, x)
        for name, value in levels.items():
            _, y = place(first, value)
            svg.append(f'<path d="M{x0} {y:.1f}h{width}" stroke="#888" stroke-dasharray="4 3"/>')
            text(x0 + width - 6, y - 4, name, "end", "#666")
        for (name, line), color in zip(lines.items(), COLORS):
            seen = [place(x, y) for x, y in line if y > 0]
            way = " ".join(f"{x:.1f},{y:.1f}" for x, y in seen)
            svg.append(f'<polyline points="{way}" fill="none" stroke="{color}" stroke-width="2"/>')
            svg += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="2.5" fill="{color}"/>' for x, y in seen]
        for i, (name, color) in enumerate(zip(lines, COLORS)):
            text(x0 + width - 6, top + 14 + 14 * i, name, "end", color)
    size = f'viewBox="0 0 {len(panels) * (width + left + 16)} {top + height + foot}"'
    style = 'font-family="sans-serif" font-size="11"'
    body = "\n".join(['<rect width="100%" height="100%" fill="#fff"/>', *svg])
    path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" {size} {style}>\n{body}\n</svg>\n')
