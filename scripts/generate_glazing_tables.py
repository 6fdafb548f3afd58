# SPDX-License-Identifier: Apache-2.0
"""Writes glazing/standard_tables.txt: the weights of NFRC 300-2003, EN 410 and ISO 9050, CIE 13.3's colours, daylight.

    pip install colour-science==0.4.7 pywincalc==3.3.1
    python3 scripts/generate_glazing_tables.py > glazing/standard_tables.txt
    python3 scripts/generate_glazing_tables.py fidelity > glazing/color_fidelity_tables.txt  # of TM-30

ASTM E891-87, Table 1, direct normal irradiance at air mass 1.5 (W/(m2 um)), is withdrawn and in no library of colour; LBNL's
pywincalc has it with the standard that names it, and CIE D65 at 1 nm. The CIE 1964 observer is colour-science's, and so is
D65 as far as it goes there, which is checked.

pywincalc also has the weights of EN 410 (prEN 410 of 1998, table 2; its table 3 is ISO 9050:1990's table 4), of
ISO 9050:1990 and of ISO 9845-1. colour-science has the reflectances of CIE 13.3's test colours.
"""
import importlib.metadata
import sys
import warnings

warnings.filterwarnings("ignore")
import colour
import numpy as np
from colour.quality.cfi2017 import load_TCS_CIE2017
from colour.quality.datasets.tcs import SDS_TCS


def spectrum(name):
    files = importlib.metadata.files("pywincalc")
    for line in open(next(f for f in files if f.name == name).locate()):
        numbers = line.split()
        if len(numbers) == 2 and numbers[0][0].isdigit():
            yield float(numbers[0]), float(numbers[1])


def write(name, rows, comment, digits=6):
    print(f"\n# {comment}\n[{name}]")
    for row in rows:
        print(" ".join(f"{value:.{digits}g}" for value in row))


def rows_of(spectrum, first_nm, last_nm):
    """Each 5 nm, of one spectrum or of several."""
    return [np.atleast_1d(spectrum[float(nm)]) for nm in range(first_nm, last_nm + 1, 5)]


print("# SPDX-" "License-Identifier: Apache-2.0 AND BSD-3-Clause")
print("# Written by scripts/generate_glazing_tables.py, which names the sources: change that, not this.")
if sys.argv[1:] == ["fidelity"]:
    samples = load_TCS_CIE2017(colour.SpectralShape(380, 780, 5))
    write("samples", rows_of(samples, 380, 780),
          "Reflectances of the 99 colour evaluation samples of CIE 224:2017, each 5 nm from 380 to 780 nm.", digits=4)
    sys.exit()

d65 = dict(spectrum("CIE Illuminant D65 1nm.ssp"))
known = colour.SDS_ILLUMINANTS["D65"]
assert np.allclose(known.values, [d65[nm] for nm in known.wavelengths], rtol=1e-5)
basis = colour.colorimetry.SDS_BASIS_FUNCTIONS_CIE_ILLUMINANT_D_SERIES
patches = [SDS_TCS["CIE 1995"][f"TCS{number:02}"] for number in range(1, 9)]
for name, file, to_nm in [("astm-e891", "ASTM E891 Table 1 Direct AM1_5.ssp", 1000),
                          ("en-410", "prEN 410 Table 2 AM1_0.ssp", 1),
                          ("iso-9050-1990", "ISO 9050 Table 3.ssp", 1),
                          ("iso-9050-1990-uv", "ISO 9050 Table 4.ssp", 1),
                          ("iso-9845", "ISO 9845 Table 1 Raw Global AM1_5.ssp", 1000)]:
    write(name, [(round(to_nm * at, 4), value) for at, value in spectrum(file)],
          f"{file.removesuffix('.ssp')}: wavelength in nm, weight.")
write("d65", rows_of(d65, 300, 830), "CIE D65 each 5 nm from 300 to 830 nm.")
write("cie-1964", rows_of(colour.MSDS_CMFS["CIE 1964 10 Degree Standard Observer"], 360, 830),
      "The CIE 1964 observer each 5 nm from 360 to 830 nm.")
write("cie-13.3", zip(*([patch[float(nm)] for nm in range(380, 781, 5)] for patch in patches)),
      "Reflectances of CIE 13.3's test colours 1 to 8 each 5 nm from 380 to 780 nm.")
write("cie-daylight", zip(*([basis[s][float(nm)] for nm in range(380, 781, 5)] for s in ("S0", "S1", "S2"))),
      "The components S0, S1, S2 of daylight each 5 nm from 380 to 780 nm.")
