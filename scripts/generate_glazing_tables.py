# SPDX-License-Identifier: Apache-2.0
"""Writes glazing/standard_tables.cpp: the weights of NFRC 300-2003, EN 410 and ISO 9050, and CIE 13.3's colours.

    pip install colour-science==0.4.7 pywincalc==3.3.1
    python3 scripts/generate_glazing_tables.py > glazing/standard_tables.cpp
    python3 scripts/generate_glazing_tables.py fidelity > glazing/color_fidelity_tables.cpp  # of TM-30

ASTM E891-87, Table 1, direct normal irradiance at air mass 1.5 (W/(m2 um)), is withdrawn and in no library of colour; LBNL's
pywincalc has it with the standard that names it, and CIE D65 at 1 nm. The CIE 1964 observer is colour-science's, and so is
D65 as far as it goes there, which is checked.

pywincalc also has the weights of EN 410 (prEN 410 of 1998, table 2; its table 3 is ISO 9050:1990's table 4), of
ISO 9050:1990 and of ISO 9845-1. colour-science has the reflectances of CIE 13.3's test colours.
"""
import importlib.metadata
import sys
import textwrap
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


def wrapped(items):
    return textwrap.fill(", ".join(items), 108, initial_indent="    ", subsequent_indent="    ",
                         break_long_words=False, break_on_hyphens=False) + ",\n"


def pair(a, b):
    return f"{{{a:g},\N{NO-BREAK SPACE}{b:g}}}"


def write_fidelity():
    samples = load_TCS_CIE2017(colour.SpectralShape(380, 780, 5))
    basis = colour.colorimetry.SDS_BASIS_FUNCTIONS_CIE_ILLUMINANT_D_SERIES
    print("""// SPDX-License-Identifier: Apache-2.0
// By scripts/generate_glazing_tables.py, which names the sources.
// clang-format off
#include "glazing/color_fidelity_tables.h"

namespace vitrail {

namespace {

constexpr std::array<double, 3> daylight_5nm[] = {""")
    for nm in range(380, 781, 5):
        print("    {" + ", ".join(f"{basis[s][float(nm)]:g}" for s in ("S0", "S1", "S2")) + "},")
    print("};\n\nconstexpr std::array<float, 99> samples_5nm[] = {")
    for nm in range(380, 781, 5):
        print("    {" + wrapped([f"{value:.4g}F" if value else "0" for value in samples[float(nm)]]).strip() + "},")
    print("""};

}  // namespace

std::span<const std::array<double, 3>> cie_daylight_5nm() { return daylight_5nm; }
std::span<const std::array<float, 99>> cie_224_samples_5nm() { return samples_5nm; }

}  // namespace vitrail""")


if sys.argv[1:] == ["fidelity"]:
    write_fidelity()
    sys.exit()

d65 = dict(spectrum("CIE Illuminant D65 1nm.ssp"))
known = colour.SDS_ILLUMINANTS["D65"]
assert np.allclose(known.values, [d65[nm] for nm in known.wavelengths], rtol=1e-5)
observer = colour.MSDS_CMFS["CIE 1964 10 Degree Standard Observer"]
print("""// SPDX-" "License-Identifier: Apache-2.0
// By scripts/generate_glazing_tables.py, which names the sources.
// clang-format off
#include "glazing/standard_tables.h"

namespace vitrail {

namespace {

constexpr std::pair<double, double> e891[] = {""")
print(wrapped([pair(round(1000 * um, 4), value) for um, value in spectrum("ASTM E891 Table 1 Direct AM1_5.ssp")]).replace("\N{NO-BREAK SPACE}", " "), end="")
print("};\n\nconstexpr double d65[] = {")
print(wrapped([f"{d65[float(nm)]:g}" for nm in range(300, 831, 5)]), end="")
print("};\n\nconstexpr std::array<double, 3> observer_1964_5nm[] = {")
for nm in range(360, 831, 5):
    print("    {" + ", ".join(f"{value:g}" for value in observer[float(nm)]) + "},")
for array, file, to_nm in [("en_410_sun", "prEN 410 Table 2 AM1_0.ssp", 1),
                           ("iso_9050_1990_sun", "ISO 9050 Table 3.ssp", 1),
                           ("iso_9050_1990_uv", "ISO 9050 Table 4.ssp", 1),
                           ("iso_9845_sun", "ISO 9845 Table 1 Raw Global AM1_5.ssp", 1000)]:
    print(f"}};\n\nconstexpr std::pair<double, double> {array}[] = {{")
    print(wrapped([pair(round(to_nm * at, 4), value) for at, value in spectrum(file)]).replace("\N{NO-BREAK SPACE}", " "),
          end="")
print("};\n\nconstexpr std::array<double, 8> test_colors_5nm[] = {")
patches = [SDS_TCS["CIE 1995"][f"TCS{number:02}"] for number in range(1, 9)]
for nm in range(380, 781, 5):
    print("    {" + ", ".join(f"{patch[float(nm)]:g}" for patch in patches) + "},")
print("""};

}  // namespace

std::span<const std::pair<double, double>> en_410_solar() { return en_410_sun; }
std::span<const std::pair<double, double>> iso_9050_1990_solar() { return iso_9050_1990_sun; }
std::span<const std::pair<double, double>> iso_9050_1990_ultraviolet() { return iso_9050_1990_uv; }
std::span<const std::pair<double, double>> iso_9845_global() { return iso_9845_sun; }
std::span<const std::array<double, 8>> cie_test_colors_5nm() { return test_colors_5nm; }
std::span<const std::pair<double, double>> astm_e891() { return e891; }
std::span<const double> cie_d65_5nm() { return d65; }
std::span<const std::array<double, 3>> cie_1964_5nm() { return observer_1964_5nm; }

}  // namespace vitrail""")
