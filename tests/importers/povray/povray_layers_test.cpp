// SPDX-License-Identifier: Apache-2.0
// Layers of textures over each other, and clear surfaces whose normals are tilted, as povray shows them.
#include "tests/importers/povray/povray_pictures.h"

namespace vitrail::povray_layers_test {
namespace {

class PovrayLayers : public PovrayPictures {
 protected:
  static std::string seen(const char* version, const std::string& rest) {
    return fmt::format(
               "#version {}; global_settings {{ assumed_gamma 1 }}\n"
               "camera {{ orthographic location -5*z look_at 0 right 4*x up 3*y }}\n"
               "light_source {{ <1000, 0, -1000> rgb 1 }}\n",
               version) +
           rest;
  }
  static std::string layers(const char* below, const char* above, const char* finish = "") {
    return fmt::format("plane {{ z, 0 texture {{ pigment {{ {} }} }} texture {{ pigment {{ {} }} {} }} }}\n",
                       below, above, finish);
  }
};

// A layer shows 1 − filter − transmit of itself, and filter·colour + transmit of what is below. Before
// version 3.7 `filter` takes less of itself, before 3.5 it has no colour.
TEST_F(PovrayLayers, FilterWhatIsBelow) {
  const char* const plain = "rgb <.9, .8, .3>";
  const char* const map = "gradient x color_map { [0 rgb <.9, .8, .3>] [1 rgb <.2, .8, .9>] }";
  for (const char* version : {"3.1", "3.5", "3.6", "3.7"})
    for (const char* below : {plain, map}) {
      if (below == map && version != std::string("3.7")) continue;
      for (const char* above :
           {"rgbf <.2, .7, .4, .6>", "rgbft <.2, .7, .4, .3, .4>", "rgbt <.2, .7, .4, .6>"})
        expect_alike(seen(version, layers(below, above)), 0.02);
    }
}

TEST_F(PovrayLayers, FilterByAPattern) {
  for (const char* map :
       {"[0 rgbf <.2, .7, .4, .6>] [1 rgbt <.2, .9, 1, 1>]", "[0 rgb <.2, .7, .4>] [1 rgbf <.9, .2, .5, .8>]",
        "[0 rgbf <.9, .2, .5, .8>] [.5 rgb <.2, .7, .4>] [1 rgbt <.5, .6, .7, .5>]"})
    expect_alike(
        seen("3.7", layers("rgb <.8, .7, .6>", fmt::format("gradient x color_map {{ {} }}", map).c_str())),
        0.03);
}

// Two clear layers: the background is behind both.
TEST_F(PovrayLayers, ThatAreBothClear) {
  expect_alike(seen("3.7", "background { rgb <.3, .5, .8> }\n" +
                               layers("rgbf <.9, .8, .7, .6>", "rgbft <.6, .7, .8, .3, .4>")),
               0.03);
}

// A lamp's light is crand·u less of a layer however clear that is.
TEST_F(PovrayLayers, CrandOfWhatIsClear) {
  for (const char* above : {"rgbt <1, 1, 1, .9>", "rgbf 1"})
    expect_alike(seen("3.7", layers("rgb <.7, .6, .5>", above, "finish { crand .1 }")), 0.03);
}

// Rays that leave glass are on the other side of its surface, wherever bumps tilt that.
TEST_F(PovrayLayers, BumpsOfGlass) {
  for (const char* bumps : {"bumps .02", "gradient x .02 sine_wave", "wrinkles .05 scale .3"})
    expect_alike(seen("3.7", fmt::format("box {{ <-10, -10, -.5>, <10, 10, 0> pigment {{ rgbt 1 }}"
                                         " normal {{ {} }} interior {{ ior 1.5 }} }}\n"
                                         "plane {{ z, 3 hollow pigment {{ rgb <.5, .4, .3> }}"
                                         " finish {{ ambient 1 diffuse 0 }} }}\n",
                                         bumps)),
                 0.03);
}

}  // namespace
}  // namespace vitrail::povray_layers_test
