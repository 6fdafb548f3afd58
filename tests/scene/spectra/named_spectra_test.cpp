// SPDX-License-Identifier: Apache-2.0
#include "scene/spectra/named_spectra.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "scene/spectra/color.h"
#include "scene/spectra/metal_tables.h"

namespace vitrail::named_spectra_test {
namespace {

struct Illuminant {
  const char* name;
  double x, y;  // CIE 15, tables T.3 and T.7
};

TEST(Illuminants, HaveTheirChromaticityAndLuminanceOne) {
  for (const Illuminant& i :
       {Illuminant{"stdillum-A", .4476, .4074}, Illuminant{"stdillum-D50", .3457, .3585},
        Illuminant{"stdillum-D65", .3127, .3290}, Illuminant{"stdillum-E", .3333, .3333},
        Illuminant{"illum-acesD60", .32168, .33767}, Illuminant{"stdillum-F1", .3131, .3371},
        Illuminant{"stdillum-F2", .3721, .3751}, Illuminant{"stdillum-F3", .4091, .3941},
        Illuminant{"stdillum-F4", .4402, .4031}, Illuminant{"stdillum-F5", .3138, .3452},
        Illuminant{"stdillum-F6", .3779, .3882}, Illuminant{"stdillum-F7", .3129, .3292},
        Illuminant{"stdillum-F8", .3458, .3586}, Illuminant{"stdillum-F9", .3741, .3727},
        Illuminant{"stdillum-F10", .3458, .3588}, Illuminant{"stdillum-F11", .3805, .3769},
        Illuminant{"stdillum-F12", .4370, .4042}}) {
    const auto spectrum = named_spectrum(i.name);
    ASSERT_TRUE(spectrum) << i.name;
    const XYZ c = to_xyz(*spectrum);
    EXPECT_NEAR(c.y, 1, 1e-6) << i.name;
    EXPECT_NEAR(c.x / (c.x + c.y + c.z), i.x, 3e-4) << i.name;
    EXPECT_NEAR(c.y / (c.x + c.y + c.z), i.y, 3e-4) << i.name;
  }
}

TEST(NamedSpectra, ListIsSortedAndEachNameIsKnown) {
  const std::vector<std::string> names = spectrum_names();
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
  for (const std::string& name : names) EXPECT_TRUE(named_spectrum(name)) << name;
}

// Of the tables of materials in the documentation of pbrt-v4 and Mitsuba 3.
TEST(NamedSpectra, HaveTheMetalsAndGlassesOfPbrtAndMitsuba) {
  for (const char* metal :
       {"Ag",       "Al",  "Au",       "Cu",     "CuZn", "MgO",     "TiO2", "a-C",  "AlAs", "AlSb", "Be",
        "Cr",       "CsI", "Cu2O",     "CuO",    "d-C",  "Hg",      "HgTe", "Ir",   "K",    "Li",   "Mo",
        "Na_palik", "Nb",  "Ni_palik", "Rh",     "Se",   "Se-e",    "SiC",  "SnTe", "Ta",   "Te",   "Te-e",
        "ThF4",     "TiC", "TiN",      "TiO2-e", "VC",   "V_palik", "VN",   "W"})
    for (const char* part : {"eta", "k"})
      EXPECT_TRUE(named_spectrum(fmt::format("metal-{}-{}", metal, part))) << metal;
  for (const char* glass : {"BK7", "BAF10", "FK51A", "LASF9", "F5", "F10", "F11"})
    EXPECT_TRUE(named_spectrum(fmt::format("glass-{}", glass))) << glass;
}

TEST(NamedSpectra, BrassIsThatOfQuerry) {
  EXPECT_NEAR(evaluate(*named_spectrum("metal-CuZn-eta"), 550), .527, 1e-6);
  EXPECT_NEAR(evaluate(*named_spectrum("metal-CuZn-k"), 650), 3.695, 1e-6);
}

}  // namespace
}  // namespace vitrail::named_spectra_test
