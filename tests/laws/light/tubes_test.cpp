// SPDX-License-Identifier: Apache-2.0
// Curves with gaps that become tubes of triangles: under a sky of 1, α of albedo ρ scatters αρ of it and lets
// 1 − α through, as the curve does, though a ray meets both walls.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "importers/pbrt/read/pbrt.h"
#include "tests/importers/temporary_folder.h"
#include "tests/support/render.h"

namespace vitrail::tubes_test {
namespace {

// The mean of a picture within the silhouette of a curve along x that is stretched along the view.
double seen(const std::string& material, const std::string& alpha, const std::string& stretch) {
  const TemporaryFolder folder;
  const Scene scene =
      read_pbrt(folder.write("scene.pbrt",
                             "Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 8 "
                             "PixelFilter \"box\"\nIntegrator \"path\" \"integer maxdepth\" 100\n"
                             "LookAt 0 0 5 0 0 0 0 1 0 Camera \"perspective\" \"float fov\" 1\n"
                             "WorldBegin LightSource \"infinite\" \"rgb L\" [1 1 1]\n"
                             "Texture \"half\" \"float\" \"constant\" \"float value\" .5\n" +
                                 material + "Scale 1 1 " + stretch +
                                 " Shape \"curve\" \"point3 P\" [-2 0 0 -.7 0 0 .7 0 0 2 0 0] "
                                 "\"float width\" .4 \"string type\" \"cylinder\" " +
                                 alpha + "\n"))
          .scene;
  return test::brightness(test::render(scene, 1024).film).mean;
}

TEST(Tubes, ScatterAndLetThroughWhatTheirCurvesDo) {
  const std::string grey = "Material \"diffuse\" \"rgb reflectance\" [.5 .5 .5]\n";
  for (const double alpha : {0.2, 0.5, 0.9})
    for (const char* stretch : {"1", "1.5"})
      EXPECT_NEAR(seen(grey, fmt::format("\"float alpha\" {}", alpha), stretch), 1 - alpha / 2, 0.004)
          << alpha << ", stretched by " << stretch;
}

// Fibres have nothing behind their outer wall by themselves.
TEST(Tubes, OfHairAreNotCountedTwice) {
  const std::string hair = "Material \"hair\" \"rgb sigma_a\" [5 5 5]\n", half = "\"float alpha\" .5";
  EXPECT_NEAR(seen(hair, half, "1.5"), (1 + seen(hair, "", "1.5")) / 2, 0.01);
}

}  // namespace
}  // namespace vitrail::tubes_test
