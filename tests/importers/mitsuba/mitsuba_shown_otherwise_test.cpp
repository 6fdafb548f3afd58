// SPDX-License-Identifier: Apache-2.0
// What Mitsuba 3.9.1 was measured to show otherwise than the Scene says it: its writer and its reader say so,
// and say nothing of what is alike.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "images/image_files.h"
#include "importers/mitsuba/read/mitsuba.h"
#include "importers/mitsuba/write/write_mitsuba.h"
#include "scene/spectra/color.h"
#include "tests/importers/temporary_folder.h"
#include "tests/importers/written_scenes.h"

namespace vitrail::mitsuba_shown_otherwise_test {
namespace {

using testing::Contains;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;

auto say(const char* words) { return Contains(Field(&Diagnostic::message, HasSubstr(words))); }

class ShownOtherwise : public testing::Test {
 protected:
  ShownOtherwise() {
    scene_.settings.straight_counts = false;
    write_exr_image(folder_ / "n.exr", black_image(2, 2, 3));
    write_exr_image(folder_ / "h.exr", black_image(2, 2, 1));
    scene_.textures = {{ImageTexture{(folder_ / "n.exr").string()}, false, "n", {}},
                       {ImageTexture{(folder_ / "h.exr").string()}, true, "h", {}}};
    std::get<ImageTexture>(scene_.textures[0].model).encoding = Encoding::linear;
  }
  Id<Material> add(MaterialModel model) { return add_to(scene_.materials, Material{std::move(model)}); }
  void write() { written_ = write_mitsuba(scene_, folder_ / "scene.xml"); }
  void write_and_read() {
    write();
    read_ = read_mitsuba(folder_ / "scene.xml").diagnostics;
  }
  enum class Bumps { height, normals };
  void write_and_read(MaterialModel model, Bumps bumps) {
    scene_.materials[0] = {std::move(model)};
    if (bumps == Bumps::height) scene_.materials[0].displacement = FloatParameter{Id<Texture>{1}};
    if (bumps == Bumps::normals) scene_.materials[0].normal_map = Id<Texture>{0};
    write_and_read();
  }

  TemporaryFolder folder_;
  Scene scene_ = square_scene({});
  Diagnostics written_, read_;
};

// Of .4 of nothing beside glass that spreads light .15 was left.
TEST_F(ShownOtherwise, NothingBlendedWithWhatSpreadsLightThrough) {
  const Id<Material> nothing = add(InterfaceMaterial{}), diffuse = add(DiffuseMaterial{});
  add(BlendMaterial{diffuse, nothing, 0.4f});
  write();
  EXPECT_THAT(written_, IsEmpty());
  add(BlendMaterial{add(PrincipledMaterial{.spec_trans = 0.8f}), nothing, 0.4f});
  write_and_read();
  EXPECT_THAT(written_, say("makes it darker"));
  EXPECT_THAT(read_, say("darker in Mitsuba"));
}

TEST_F(ShownOtherwise, BumpsOfSomeMaterials) {
  using enum Bumps;
  const Roughness brushed{0.1f, 0.4f}, rough{0.3f, 0.3f};
  write_and_read(ConductorMaterial{.roughness = rough}, height);
  EXPECT_THAT(written_, IsEmpty());
  write_and_read(ConductorMaterial{.roughness = brushed}, normals);
  EXPECT_THAT(written_, IsEmpty());

  write_and_read(ConductorMaterial{.roughness = brushed}, height);
  EXPECT_THAT(written_, say("brushed"));
  EXPECT_THAT(read_, say("brushed"));
  write_and_read(ConductorMaterial{}, normals);
  EXPECT_THAT(written_, say("reflect into the surface"));
  EXPECT_THAT(read_, say("reflect into the surface"));
  write_and_read(PrincipledMaterial{.diff_trans = 0.5f, .thin = true}, height);
  EXPECT_THAT(written_, say("what light goes through"));
  EXPECT_THAT(read_, say("what light goes through"));
}

TEST_F(ShownOtherwise, TintsOfPrincipledMaterials) {
  scene_.materials[0] = {PrincipledMaterial{.sheen = 0.5f}};
  write();
  EXPECT_THAT(written_, IsEmpty());
  scene_.materials[0] = {PrincipledMaterial{.spec_tint = 0.4f}};
  write_and_read();
  EXPECT_THAT(written_, say("tints"));
  EXPECT_THAT(read_, say("tints"));
}

TEST_F(ShownOtherwise, BumpsOfABack) {
  const Id<Material> other = add(DiffuseMaterial{});
  scene_.materials[0].normal_map = Id<Texture>{0};
  add(TwoSidedMaterial{Id<Material>{0}, other});
  write();
  EXPECT_THAT(written_, IsEmpty());
  add(TwoSidedMaterial{other, Id<Material>{0}});
  write_and_read();
  EXPECT_THAT(written_, say("bumps of a back"));
  EXPECT_THAT(read_, say("on the back"));
}

// Black, where the normal that the winding gives is behind the shading one.
TEST_F(ShownOtherwise, BumpMapsWhereNormalsOpposeTheWinding) {
  scene_.meshes[0] = square_mesh(true);
  scene_.materials[0].displacement = FloatParameter{Id<Texture>{1}};
  scene_.shapes[0].object_to_world = scale({-1, 1, 1});
  write_and_read();
  EXPECT_THAT(written_, say("wound the other way"));
  EXPECT_THAT(read_, IsEmpty());
  const auto as_a_file_may = [](const char* adapter) {
    return fmt::format(
        "<scene version=\"3.0.0\"><shape type=\"ply\"><string name=\"filename\" value=\"m.ply\"/><transform "
        "name=\"to_world\"><scale x=\"-1\"/></transform><bsdf type=\"{}\"><texture type=\"bitmap\" "
        "name=\"normalmap\"><string name=\"filename\" value=\"n.exr\"/></texture><bsdf "
        "type=\"twosided\"><bsdf "
        "type=\"diffuse\"/></bsdf></bsdf></shape></scene>",
        adapter);
  };
  folder_.write(
      "m.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "property float nx\nproperty float ny\nproperty float nz\nelement face 1\nproperty list uchar int "
      "vertex_indices\nend_header\n-1 -1 0 0 0 1\n1 -1 0 0 0 1\n1 1 0 0 0 1\n3 0 1 2\n");
  EXPECT_THAT(read_mitsuba(folder_.write("a.xml", as_a_file_may("bumpmap"))).diagnostics, say("shows black"));
  EXPECT_THAT(read_mitsuba(folder_.write("b.xml", as_a_file_may("normalmap"))).diagnostics,
              testing::Not(say("shows black")));
}

// 0.6 takes one channel of an image for a colour, too.
TEST_F(ShownOtherwise, ChannelsOfColoursAreGreys) {
  const Scene scene =
      read_mitsuba(
          folder_.write("a.xml",
                        "<scene version=\"0.6.0\"><shape type=\"sphere\"><bsdf type=\"diffuse\"><texture "
                        "type=\"bitmap\" name=\"reflectance\"><string name=\"filename\" "
                        "value=\"n.exr\"/><string name=\"channel\" value=\"b\"/></texture></bsdf>"
                        "</shape></scene>"))
          .scene;
  const auto& diffuse = std::get<DiffuseMaterial>(scene.materials.at(0).model);
  const Texture& color = scene.textures.at(std::get<Id<Texture>>(diffuse.reflectance).value);
  EXPECT_FALSE(color.is_float);
  const auto& grey = std::get<ProductTexture>(color.model);
  const Texture& image = scene.textures.at(std::get<Id<Texture>>(grey.second).value);
  EXPECT_TRUE(image.is_float);
  EXPECT_EQ(std::get<ImageTexture>(image.model).number, ImageNumber::blue);
}

TEST_F(ShownOtherwise, AttributesOfVerticesInInstances) {
  const auto place = [&](const char* name, bool per_face) {
    scene_ = square_scene({});
    scene_.textures = {{MeshAttributeTexture{name}, false, "a", {}}};
    scene_.materials[0].model = DiffuseMaterial{Id<Texture>{0}};
    scene_.meshes[0].attributes = {{name, per_face, 3, std::vector<float>(per_face ? 6 : 12, 0.5f)}};
    write();
    EXPECT_THAT(written_, IsEmpty());
    scene_.prototypes.push_back({"group", std::exchange(scene_.shapes, {}), {}});
    scene_.instances.push_back({{0}, translate({1, 0, 0}), {}});
    write_and_read();
  };
  place("face_color", true);
  EXPECT_THAT(written_, IsEmpty());
  place("vertex_color", false);
  EXPECT_THAT(written_, say("attributes of vertices"));
  EXPECT_THAT(read_, say("attributes of vertices"));
}

// In a reflectance it counts as white.
TEST_F(ShownOtherwise, BrightColoursInMixes) {
  const auto write_mix = [&](RGB color) {
    scene_.textures = {
        {MixTexture{unbounded_from_rgb(color), ConstantSpectrum{0.2f}, 0.3f}, false, "mix", {}}};
    scene_.materials[0].model = DiffuseMaterial{Id<Texture>{0}};
    write();
  };
  write_mix({0.9, 0.5, 0.2});
  EXPECT_THAT(written_, IsEmpty());
  write_mix({1.5, 0.5, 0.2});
  EXPECT_THAT(written_, say("above 1"));
}

// Mitsuba's rgb variants decode it, its spectral ones refuse it.
TEST_F(ShownOtherwise, NormalMapsThatAreNotRaw) {
  const auto with = [](const char* more) {
    return fmt::format(
        "<scene version=\"3.0.0\"><bsdf type=\"normalmap\" id=\"m\"><texture type=\"bitmap\" "
        "name=\"normalmap\"><string name=\"filename\" value=\"n.exr\"/>{}</texture><bsdf "
        "type=\"diffuse\"/></bsdf></scene>",
        more);
  };
  EXPECT_THAT(read_mitsuba(folder_.write("a.xml", with(""))).diagnostics, say("is not raw"));
  EXPECT_THAT(
      read_mitsuba(folder_.write("b.xml", with("<boolean name=\"raw\" value=\"true\"/>"))).diagnostics,
      testing::Not(say("is not raw")));
}

// Around bumps twosided would mirror them.
TEST_F(ShownOtherwise, NotTheSidesOfBumpsInBlends) {
  scene_.materials[0].normal_map = Id<Texture>{0};
  scene_.shapes[0].material = add(BlendMaterial{Id<Material>{0}, add(DiffuseMaterial{}), 0.5f});
  write_and_read();
  EXPECT_THAT(written_, IsEmpty());
  EXPECT_THAT(read_, IsEmpty());
}

// scalar_rgb against scalar_spectral of 3.9.1, in luminance: lines of 2 nm at 650 nm 1.51, of .2 nm at 546.15
// nm nothing.
TEST_F(ShownOtherwise, LightOfLinesInRgb) {
  const auto lit_by = [&](const Spectrum& radiance) {
    scene_.lights = {{InfiniteLight{radiance}, {}}};
    write();
  };
  lit_by(tabulate({{649, 0}, {650, 1000}, {651, 0}}, false));
  EXPECT_THAT(written_, say("light is 1.5 times as bright"));
  lit_by(tabulate({{546.05, 0}, {546.06, 1}, {546.24, 1}, {546.25, 0}}, false));
  EXPECT_THAT(written_, say("light is 0 times as bright"));
  lit_by(tabulate({{400, 1}, {700, 2}}, false));
  EXPECT_THAT(written_, IsEmpty());
  lit_by(emission_from_rgb({1, 0, 0}));
  EXPECT_THAT(written_, IsEmpty());
}

}  // namespace
}  // namespace vitrail::mitsuba_shown_otherwise_test
