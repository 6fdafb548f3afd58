#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reads the masks of an .exr by the specifications of OpenEXR and Cryptomatte alone, without a library.

read_cryptomatte.py PICTURE.exr

Prints {"channels": {name: values}, "masks": {layer: {name of a thing: coverages}}}, row by row from the top left.
Floats, scan lines, ZIP.
"""
import json
import struct
import sys
import zlib


def text(data, at):
    end = data.index(b"\0", at)
    return data[at:end].decode(), end + 1


def header_of(data):
    magic, _version = struct.unpack_from("<iI", data, 0)
    assert magic == 20000630
    at, header = 8, {}
    while data[at]:
        name, at = text(data, at)
        _kind, at = text(data, at)
        size, = struct.unpack_from("<i", data, at)
        header[name] = data[at + 4 : at + 4 + size]
        at += 4 + size
    return header, at + 1


def channels_of(chlist):
    at, names = 0, []
    while chlist[at]:
        name, at = text(chlist, at)
        kind, = struct.unpack_from("<i", chlist, at)
        names.append((name, "I" if kind == 0 else "f"))
        at += 16
    return names


def unpacked(block, size):
    if len(block) == size:
        return block
    coded = bytearray(zlib.decompress(block))
    for i in range(1, len(coded)):
        coded[i] = (coded[i - 1] + coded[i] - 128) & 0xFF
    half, plain = (len(coded) + 1) // 2, bytearray(len(coded))
    plain[0::2], plain[1::2] = coded[:half], coded[half:]
    return bytes(plain)


def read(file):
    data = open(file, "rb").read()
    header, at = header_of(data)
    channels = channels_of(header["channels"])
    x0, y0, x1, y1 = struct.unpack("<4i", header["dataWindow"])
    width, height = x1 - x0 + 1, y1 - y0 + 1
    assert header["compression"] == b"\x03", "ZIP, 16 lines a block"
    planes = {name: [] for name, _ in channels}
    for block in range((height + 15) // 16):
        place, = struct.unpack_from("<Q", data, at + 8 * block)
        y, size = struct.unpack_from("<ii", data, place)
        rows = min(16, y1 + 1 - y)
        lines = unpacked(data[place + 8 : place + 8 + size], rows * width * 4 * len(channels))
        offset = 0
        for _ in range(rows):
            for name, kind in channels:
                planes[name] += struct.unpack_from(f"<{width}{kind}", lines, offset)
                offset += 4 * width
    return header, planes


def bits(value):
    return struct.unpack("<I", struct.pack("<f", value))[0]


def masks(header, planes):
    found = {}
    for key, value in header.items():
        if not (key.startswith("cryptomatte/") and key.endswith("/name")):
            continue
        base, layer = key[: -len("name")], value.decode()
        assert len(base) == len("cryptomatte/1234567/")
        assert header[base + "hash"] == b"MurmurHash3_32"
        assert header[base + "conversion"] == b"uint32_to_float32"
        names = {int(digits, 16): name for name, digits in json.loads(header[base + "manifest"]).items()}
        things = {name: [0.0] * len(planes["R"]) for name in names.values()}
        level = 0
        while f"{layer}{level:02}.R" in planes:
            r, g, b, a = (planes[f"{layer}{level:02}.{c}"] for c in "RGBA")
            for ids, covers in ((r, g), (b, a)):
                for p, (one, covered) in enumerate(zip(ids, covers)):
                    assert (covered > 0) == (bits(one) != 0)
                    if covered > 0:
                        things[names[bits(one)]][p] += covered
            level += 1
        found[layer] = things
    return found


if __name__ == "__main__":
    head, values = read(sys.argv[1])
    ids = ("Crypto",)
    json.dump({"channels": {n: v for n, v in values.items() if not n.startswith(ids)},
               "masks": masks(head, values)}, sys.stdout)
