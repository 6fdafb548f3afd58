// SPDX-License-Identifier: Apache-2.0
// How the picture is taken.
#include <cmath>
#include <numbers>

#include "scene/models/paraxial_lens.h"
#include "tests/importers/pbrt/pbrt_text.h"
#include "tests/support/double_gauss.h"

namespace vitrail::pbrt_camera_film_test {
namespace {

ImportedScene settings(const std::string& text) { return import_text(text + "\nWorldBegin\n" + triangle); }

PerspectiveCamera perspective(const std::string& text) {
  return std::get<PerspectiveCamera>(settings(text).scene.camera);
}

void expect_screen(const ScreenWindow& s, double x0, double x1, double y0, double y1) {
  EXPECT_NEAR(s.x0, x0, 1e-12);
  EXPECT_NEAR(s.x1, x1, 1e-12);
  EXPECT_NEAR(s.y0, y0, 1e-12);
  EXPECT_NEAR(s.y1, y1, 1e-12);
}

TEST(PbrtCamera, FovIsOfTheShorterAxis) {
  const double t = std::tan(30 * std::numbers::pi / 180);
  const std::string camera = "Camera \"perspective\" \"float fov\" 60 ";
  expect_screen(
      perspective(camera + "Film \"rgb\" \"integer xresolution\" 200 \"integer yresolution\" 100").screen,
      -2 * t, 2 * t, -t, t);
  expect_screen(
      perspective(camera + "Film \"rgb\" \"integer xresolution\" 100 \"integer yresolution\" 200").screen, -t,
      t, -2 * t, 2 * t);
  expect_screen(
      perspective("Camera \"perspective\" \"float fov\" 60 \"float frameaspectratio\" 3 Film \"rgb\"").screen,
      -3 * t, 3 * t, -t, t);
  expect_screen(
      perspective("Camera \"perspective\" \"float fov\" 60 \"float screenwindow\" [-1 .5 -2 3] Film \"rgb\"")
          .screen,
      -t, .5 * t, -2 * t, 3 * t);
  expect_screen(perspective("Camera \"perspective\" \"float halffov\" 30 Film \"image\" \"integer "
                            "xresolution\" 4 \"integer yresolution\" 4")
                    .screen,
                -t, t, -t, t);
}

// The lens is kept, focussed at what is .8 m from the film; of pbrt-v4 the middle of the film gets about
// π(r/s′)² of the radiance, of v3 what comes through of what is sampled.
TEST(PbrtCamera, ARealisticLensIsKept) {
  const TemporaryFolder folder;
  folder.write("lens.dat", test::double_gauss_file());
  const auto read = [&](const std::string& film, const std::string& more) {
    return read_pbrt(folder.write("scene.pbrt", film +
                                                    "Camera \"realistic\" \"string lensfile\" \"lens.dat\" " +
                                                    more + "\nWorldBegin\n" + triangle));
  };
  const std::string film =
      "Film \"rgb\" \"integer xresolution\" 80 \"integer yresolution\" 60 \"float diagonal\" 20\n";
  const ImportedScene imported = read(film, "\"float focusdistance\" .8 \"float aperturediameter\" 8");
  const auto& camera = std::get<RealisticCamera>(imported.scene.camera);
  ASSERT_EQ(camera.surfaces.size(), 11u);
  EXPECT_EQ(camera.film_diagonal, 0.02);
  EXPECT_NEAR(camera.surfaces[0].radius, 0.029475, 1e-12);
  EXPECT_NEAR(camera.surfaces[5].aperture_radius, 0.004, 1e-12);
  const ThinLens thin = thin_lens(camera.surfaces);
  const double image = camera.surfaces.back().thickness - thin.rear_principal;
  EXPECT_NEAR(image, *image_distance(thin, .8), 1e-12);
  EXPECT_EQ(transform_point(camera.camera_to_world, {}), (Point3d{}));
  EXPECT_NEAR(imported.scene.film.imaging_ratio / (std::numbers::pi * std::pow(thin.pupil_radius / image, 2)),
              1, 0.05);
  EXPECT_EQ(imported.diagnostics.size(), read(film, "").diagnostics.size()) << "nothing is approximated";
  // v3 leaves the area out: π/4 of the rectangle, which is a little larger than the pupil.
  const std::string v3 = "Film \"image\" \"float diagonal\" 20\n";
  const double share =
      read(v3, "\"float aperturediameter\" 8 \"float focusdistance\" .8").scene.film.imaging_ratio;
  EXPECT_LT(share, std::numbers::pi / 4);
  EXPECT_GT(share, 0.9 * std::numbers::pi / 4);
  EXPECT_NEAR(
      read(v3, "\"bool simpleweighting\" \"false\" \"float aperturediameter\" 8 \"float focusdistance\" .8")
          .scene.film.imaging_ratio,
      imported.scene.film.imaging_ratio, 1e-6);
  EXPECT_THROW(read(film, "\"float focusdistance\" .1"), Error) << "too near";
  for (const char* wrong : {"20 40 2", "", "20 4 1.5 -3"}) {
    folder.write("lens.dat", wrong);
    EXPECT_THROW(read(film, ""), Error) << wrong;
  }
}

TEST(PbrtCamera, ALensWithoutAFileIsAnError) {
  EXPECT_THROW(settings("Camera \"realistic\" Film \"rgb\""), Error);
  EXPECT_THROW(settings("Camera \"realistic\" \"string lensfile\" \"none.dat\" Film \"rgb\""), Error);
}

TEST(PbrtCamera, OrthographicScreensAreInTheWorld) {
  const Camera camera =
      settings("Camera \"orthographic\" \"float screenwindow\" [-3.2 3.2 -2.4 2.4] Film \"rgb\"")
          .scene.camera;
  expect_screen(std::get<OrthographicCamera>(camera).screen, -3.2, 3.2, -2.4, 2.4);
}

TEST(PbrtCamera, StandsWhereTheTransformPutsIt) {
  const PerspectiveCamera plain =
      perspective("LookAt 1 2 -3 1 2 0 0 1 0 Camera \"perspective\" Film \"rgb\"");
  EXPECT_EQ(transform_point(plain.camera_to_world, {0, 0, 0}), (Point3d{1, 2, -3}));
  EXPECT_EQ(transform_vector(plain.camera_to_world, {0, 0, 1}), (Vector3d{0, 0, 1}));
  EXPECT_EQ(transform_vector(plain.camera_to_world, {1, 0, 0}), (Vector3d{1, 0, 0}));
  const PerspectiveCamera mirrored =
      perspective("Scale -1 1 1 LookAt 1 2 -3 1 2 0 0 1 0 Camera \"perspective\" Film \"rgb\"");
  EXPECT_EQ(transform_point(mirrored.camera_to_world, {0, 0, 0}), (Point3d{1, 2, -3}));
  EXPECT_EQ(transform_vector(mirrored.camera_to_world, {1, 0, 0}), (Vector3d{-1, 0, 0}));
}

TEST(PbrtCamera, LensesAndSpheresAreKept) {
  EXPECT_EQ(
      perspective("Camera \"perspective\" \"float lensradius\" .125 \"float focaldistance\" 3 Film \"rgb\"")
          .lens,
      (Lens{.125, 3}));
  const auto spherical = std::get<SphericalCamera>(
      settings("Translate 0 0 4 Camera \"spherical\" \"string mapping\" \"equirectangular\" Film \"rgb\"")
          .scene.camera);
  EXPECT_EQ(transform_point(spherical.camera_to_world, {}), (Point3d{0, 0, -4}));
  EXPECT_EQ(spherical.projection, SphericalCamera::Projection::latitude_longitude);
}

TEST(PbrtCamera, NoiseOfTheInverseIsRoundedOff) {
  const PerspectiveCamera camera =
      perspective("LookAt .1 .2 .3 1 2 3 0 0 1 Camera \"perspective\" Film \"rgb\"");
  EXPECT_EQ(camera.camera_to_world, snapped(look_at({.1, .2, .3}, {1, 2, 3}, {0, 0, 1})));
}

TEST(PbrtFilm, HasTheResolutionAndTheCrop) {
  const auto film = [](const std::string& parameters) {
    return settings("Film \"rgb\" \"integer xresolution\" 100 \"integer yresolution\" 50 " + parameters)
        .scene.film;
  };
  EXPECT_EQ(film("").crop, (PixelRect{0, 100, 0, 50}));
  EXPECT_EQ(film("\"float cropwindow\" [.1 .5 0 .25]").crop, (PixelRect{10, 50, 0, 13}));
  EXPECT_EQ(film("\"integer pixelbounds\" [10 20 30 500]").crop, (PixelRect{10, 20, 30, 50}));
  const FilmSettings v4 = settings("Film \"rgb\"").scene.film, v3 = settings("Film \"image\"").scene.film;
  EXPECT_EQ(v4.width * 10000 + v4.height, 12800720);
  EXPECT_EQ(v3.width * 10000 + v3.height, 6400480);
}

TEST(PbrtFilm, ExposesByShutterAndIsoInV4AndByScaleInV3) {
  const auto ratio = [](const std::string& text) { return settings(text).scene.film.imaging_ratio; };
  EXPECT_DOUBLE_EQ(ratio("Film \"rgb\""), 1);
  EXPECT_DOUBLE_EQ(ratio("Film \"rgb\" \"float iso\" 50"), .5);
  EXPECT_DOUBLE_EQ(ratio("Camera \"perspective\" \"float shutteropen\" .25 \"float shutterclose\" .5 Film "
                         "\"rgb\" \"float iso\" 400"),
                   1);
  EXPECT_DOUBLE_EQ(ratio("Camera \"perspective\" \"float shutterclose\" .5 Film \"image\" \"float scale\" 3"),
                   3);
}

// v3 exposes whatever its shutter does; v4 refuses one that does not open.
TEST(PbrtFilm, AClosedShutterIsRefusedByV4Alone) {
  const std::string closed = "Camera \"perspective\" \"float shutteropen\" .5 \"float shutterclose\" .5 ";
  EXPECT_EQ(settings(closed + "Film \"image\"").scene.film.imaging_ratio, 1);
  EXPECT_THROW(settings(closed + "Film \"rgb\""), Error);
  const ImportedScene unknown = settings(closed);
  EXPECT_EQ(unknown.scene.film.imaging_ratio, 1);
  EXPECT_TRUE(mentions(unknown.diagnostics, "shutter"));
}

TEST(PbrtFilm, WhatItLosesIsReported) {
  EXPECT_TRUE(
      mentions(settings("Film \"rgb\" \"string sensor\" \"canon_eos_100d\"").diagnostics, "canon_eos_100d"));
  EXPECT_TRUE(mentions(settings("Film \"rgb\" \"float iso\" 50 \"float maxcomponentvalue\" 10").diagnostics,
                       "--clamp 10 "));
  EXPECT_TRUE(  // v3 scales what it has limited
      mentions(settings("Film \"image\" \"float scale\" 3 \"float maxsampleluminance\" 10").diagnostics,
               "--clamp 30 "));
  const ImportedScene spectral =
      settings("Film \"spectral\" \"integer nbuckets\" 5 \"float lambdamin\" 400 \"float lambdamax\" 700");
  EXPECT_EQ(spectral.scene.film.spectrum, (SpectralBins{5, 400, 700}));
  EXPECT_TRUE(spectral.diagnostics.empty());
  EXPECT_EQ(settings("Film \"spectral\"").scene.film.spectrum, (SpectralBins{16, 360, 830}));
  EXPECT_EQ(settings("Film \"rgb\"").scene.film.spectrum.count, 0);
  EXPECT_TRUE(mentions(settings("Film \"rgb\" \"float whitebalance\" 5000").diagnostics,
                       "develop --white-balance 5000"));
  EXPECT_TRUE(settings("Film \"rgb\" \"float whitebalance\" 6500").diagnostics.empty());
  EXPECT_THROW(settings("Film \"rgb\" \"float whitebalance\" -1"), Error);
  EXPECT_TRUE(mentions(
      settings("Film \"rgb\" \"string sensor\" \"nikon_d850\" \"float whitebalance\" 3200").diagnostics,
      "develop --white-balance 3200"));
  EXPECT_TRUE(mentions(settings("Film \"rgb\" \"integer xresoluton\" 3").diagnostics,
                       "did you mean \"xresolution\""));
  EXPECT_TRUE(
      mentions(settings("Camera \"perspective\" \"float fow\" 40").diagnostics, "did you mean \"fov\""));
  expect_no_diagnostics(settings("Film \"rgb\" \"string filename\" \"a.exr\" \"bool savefp16\" false"));
}

TEST(PbrtFilm, TheGbufferKeepsLayers) {
  const ImportedScene gbuffer = settings("Film \"gbuffer\"");
  EXPECT_EQ(names_of(gbuffer.scene.film.layers), "albedo,position,geo_normal,sh_normal,uv");
  EXPECT_TRUE(gbuffer.scene.film.layers.in_camera_space);
  EXPECT_TRUE(mentions(gbuffer.diagnostics, "dzdx"));
  const auto layers = [](const std::string& text) { return settings(text).scene.film.layers; };
  EXPECT_FALSE(layers("Film \"gbuffer\" \"string coordinatesystem\" \"world\"").in_camera_space);
  EXPECT_THROW(layers("Film \"gbuffer\" \"string coordinatesystem\" \"object\""), Error);
  EXPECT_EQ(layers("Film \"rgb\""), FilmLayers{});
  EXPECT_EQ(layers("Film \"gbuffer\" Film \"rgb\""), FilmLayers{}) << "the last counts";
}

TEST(PbrtFilter, KindsAndDefaultsAreThoseOfTheVersion) {
  const auto filter = [](const std::string& text) { return settings(text).scene.film.filter; };
  EXPECT_EQ(filter("Film \"rgb\""), Filter{GaussianFilter{}});
  EXPECT_EQ(filter("Film \"image\""), Filter{BoxFilter{}});
  EXPECT_EQ(filter("Film \"rgb\" PixelFilter \"box\""), Filter{BoxFilter{}});
  EXPECT_EQ(filter("Film \"rgb\" PixelFilter \"triangle\" \"float xradius\" 3"),
            (Filter{TriangleFilter{3, 2}}));
  EXPECT_EQ(filter("Film \"image\" PixelFilter \"triangle\" \"float xwidth\" 1 \"float ywidth\" 1"),
            (Filter{TriangleFilter{1, 1}}));
  EXPECT_EQ(filter("Film \"rgb\" PixelFilter \"gaussian\" \"float sigma\" .75"),
            (Filter{GaussianFilter{1.5, 1.5, .75}}));
  EXPECT_EQ(filter("Film \"image\" PixelFilter \"gaussian\""), (Filter{GaussianFilter{2, 2, .5}}))
      << "alpha 2";
  EXPECT_EQ(filter("Film \"image\" PixelFilter \"gaussian\" \"float alpha\" .5"),
            (Filter{GaussianFilter{2, 2, 1}}));
  EXPECT_EQ(filter("Film \"rgb\" PixelFilter \"mitchell\" \"float B\" .5"),
            (Filter{MitchellFilter{2, 2, .5, 1.0 / 3}}));
  EXPECT_EQ(filter("Film \"rgb\" PixelFilter \"sinc\" \"float tau\" 2"), (Filter{SincFilter{4, 4, 2}}));
  EXPECT_TRUE(
      mentions(settings("Film \"rgb\" PixelFilter \"mitchel\"").diagnostics, "did you mean \"mitchell\""));
}

TEST(PbrtSettings, SamplesAndDepth) {
  const auto render = [](const std::string& text) { return settings(text).scene.settings; };
  EXPECT_EQ(render("Film \"rgb\""), RenderSettings{});
  EXPECT_EQ(
      render("Sampler \"zsobol\" \"integer pixelsamples\" 256 Integrator \"path\" \"integer maxdepth\" 12"),
      (RenderSettings{256, 12, false}));
  EXPECT_EQ(
      render("Sampler \"stratified\" \"integer xsamples\" 3 \"integer ysamples\" [5]").samples_per_pixel, 15);
  EXPECT_EQ(render("Sampler \"stratified\" \"integer pixelsamples\" 64").samples_per_pixel, 64);
  EXPECT_TRUE(render("Integrator \"directlighting\"").direct_only);
  EXPECT_FALSE(render("Integrator \"bdpt\"").direct_only);
  EXPECT_TRUE(mentions(settings("Integrator \"path\" \"integer maxdept\" 3 Film \"rgb\"").diagnostics,
                       "did you mean \"maxdepth\""));
}

std::string integrator(const std::string& name) {
  return "Film \"rgb\" Integrator \"" + name + "\" WorldBegin ";
}
const std::string metal = "Material \"conductor\" " + triangle;

TEST(PbrtIntegrators, WhatFindsTheSameLightIsExact) {
  for (const char* const name : {"path", "volpath", "simplepath", "simplevolpath"})
    expect_no_diagnostics(import_text(integrator(name) + metal));
  for (const char* const name :
       {"bdpt", "mlt", "lightpath", "randomwalk", "directlighting", "whitted", "sppm"})
    expect_no_diagnostics(import_text(integrator(name) + "LightSource \"infinite\" " + triangle));
}

ImportedScene with_all_media(const std::string& text) {
  const TemporaryFolder folder;
  ImportOptions options;
  options.all_media = true;
  return read_pbrt(folder.write("scene.pbrt", text), MeshMemory{}, {}, options);
}

// What pbrt's "path" shows clear, "volpath" shows coloured.
TEST(PbrtIntegrators, IntegratorsOfSurfacesIgnoreMedia) {
  const std::string world =
      "Film \"rgb\" MakeNamedMedium \"m\" \"string type\" \"homogeneous\" MediumInterface \"\" \"m\" Camera "
      "\"perspective\" WorldBegin ObjectBegin \"o\" MediumInterface \"m\" \"\" " +
      triangle + "ObjectEnd ObjectInstance \"o\" MediumInterface \"m\" \"\" " + triangle;
  for (const std::string name : {"path", "simplepath", "directlighting", "whitted", "lightpath", "randomwalk",
                                 "sppm", "volpath", "simplevolpath", "bdpt", "mlt"}) {
    const ImportedScene imported = import_text("Integrator \"" + name + "\" " + world);
    const Scene& scene = imported.scene;
    const bool sees = name.find("vol") != std::string::npos || name == "bdpt" || name == "mlt";
    EXPECT_EQ(scene.camera_medium.has_value(), sees) << name;
    EXPECT_EQ(scene.shapes.at(0).interior.has_value(), sees) << name;
    EXPECT_EQ(scene.prototypes.at(0).shapes.at(0).interior.has_value(), sees) << name;
    EXPECT_EQ(mentions(imported.diagnostics, "ignores them"), !sees) << name;
    EXPECT_EQ(scene.settings.photons.has_value(), name == "sppm") << "photons cross no media here";
    EXPECT_TRUE(with_all_media("Integrator \"" + name + "\" " + world).scene.camera_medium);
  }
  EXPECT_FALSE(mentions(import_text("Integrator \"path\" WorldBegin " + triangle).diagnostics, "ignores"));
  // Without an integrator v3 takes "path", v4 "volpath".
  const std::string v3 =
      "Film \"image\" MakeNamedMedium \"m\" \"string type\" \"homogeneous\" MediumInterface \"\" \"m\" "
      "Camera "
      "\"perspective\" WorldBegin " +
      triangle + "WorldEnd";
  EXPECT_FALSE(import_text(v3).scene.camera_medium);
  EXPECT_TRUE(import_text(world).scene.camera_medium);
}

// pbrt-v4's "path" takes it for clear glass; v3's shows it.
TEST(PbrtIntegrators, PathShowsNoScatteringBelowSurfaces) {
  const auto says = [](const std::string& name, const std::string& film) {
    const std::string end = film == "image" ? "WorldEnd" : "";
    return mentions(import_text("Integrator \"" + name + "\" Film \"" + film +
                                "\" WorldBegin Material \"subsurface\" " + triangle + end)
                        .diagnostics,
                    "below surfaces");
  };
  EXPECT_TRUE(says("path", "rgb"));
  EXPECT_FALSE(says("volpath", "rgb"));
  EXPECT_FALSE(says("path", "image"));
}

TEST(PbrtIntegrators, OthersSayWhatTheyMiss) {
  const auto says = [](const std::string& text, const char* what) {
    return mentions(import_text(text).diagnostics, what);
  };
  for (const char* const name : {"bdpt", "mlt", "lightpath"})
    EXPECT_TRUE(says(integrator(name) + metal, "from small lamps is missed")) << name;
  EXPECT_TRUE(says(integrator("randomwalk") + "LightSource \"point\"", "lamps that no ray meets"));
  for (const char* const name : {"directlighting", "whitted"})
    EXPECT_TRUE(says(integrator(name) + "Material \"dielectric\" " + triangle, "straight through panes"))
        << name;
  EXPECT_TRUE(says(integrator("ambientocclusion"), "becomes a path tracer"));
  EXPECT_TRUE(says(integrator("phath"), "did you mean \"path\""));
  EXPECT_TRUE(says("Film \"rgb\" Integrator \"path\" \"bool regularize\" true", "not regularised"));
}

TEST(PbrtIntegrators, SppmTracesPhotons) {
  const std::string more =
      "\" \"integer photonsperiteration\" 5000 \"float radius\" .25 \"integer maxdepth\" 9 "
      "\"integer iterations\" 7";
  const auto of = [](const std::string& text) { return import_text(text).scene.settings; };
  const RenderSettings v4 = of("Sampler \"zsobol\" \"integer pixelsamples\" 32 " + integrator("sppm"));
  EXPECT_EQ(v4.photons, PhotonSettings{});
  EXPECT_EQ(v4.samples_per_pixel, 32);
  EXPECT_FALSE(v4.direct_only);
  const RenderSettings given = of("Integrator \"sppm" + more + " Film \"rgb\"");
  EXPECT_EQ(given.photons, (PhotonSettings{5000, .25, {}}));
  EXPECT_EQ(given.samples_per_pixel, 7);
  EXPECT_EQ(given.max_depth, 9);
  EXPECT_EQ(of("Integrator \"sppm\" Sampler \"halton\" Film \"image\"").samples_per_pixel, 64) << "of v3";
  // Photons do not cross media.
  const ImportedScene fog = with_all_media(
      integrator("sppm") +
      "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" MediumInterface \"m\" \"\" " + triangle);
  EXPECT_EQ(fog.scene.settings.photons, std::nullopt);
  EXPECT_TRUE(mentions(fog.diagnostics, "photons do not cross media"));
}

}  // namespace
}  // namespace vitrail::pbrt_camera_film_test
