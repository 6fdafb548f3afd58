// SPDX-License-Identifier: Apache-2.0
// The laws for shapes that are no triangles: one picture, however they are cut, kept or spilled; hits that
// are the least of all, whatever the kernel; pictures that are those of their tessellation.
#include <gtest/gtest.h>

#include <random>

#include "bundle/loaded_domain.h"
#include "bundle/verify.h"
#include "partitioner/partition.h"
#include "scene/shapes/curve_meshes.h"
#include "scene/shapes/tessellate.h"
#include "tests/support/long_tests.h"
#include "tests/support/render.h"
#include "tests/support/temporary_directory.h"
#include "tracer/intersect/embree_domain.h"
#include "tracer/intersect/instance_ray.h"
#include "tracer/quadrics/quadric_hits.h"
#include "tracer/rays/walk.h"

namespace vitrail::test::quadric_laws_test {
namespace {

Id<TriangleMesh> add(Scene& scene, const Quadric& quadric) {
  scene.meshes.emplace_back().quadric = quadric;
  return {static_cast<std::uint32_t>(scene.meshes.size() - 1)};
}

Quadric random_quadric(std::mt19937& random) {
  std::uniform_real_distribution<double> u(0, 1);
  Quadric q{.kind = static_cast<QuadricKind>(random() % 5)};
  if (q.kind == QuadricKind::disk || q.kind == QuadricKind::paraboloid) q.low = 0;
  if (random() % 2) return q;
  q.low = std::max(q.low, 0.5 * u(random));
  q.phi_max_rad = 1 + 5 * u(random);
  return q;
}

Transform random_transform(std::mt19937& random, double reach, double size) {
  std::uniform_real_distribution<double> u(-1, 1);
  const double s = size * std::pow(10, u(random));
  const Vector3d stretch = random() % 3 ? Vector3d{1, 1, 1} : Vector3d{1, 0.3, random() % 2 ? -2.0 : 2.0};
  return translate({reach * u(random), reach * u(random), reach * u(random)}) *
         rotate(3 * u(random), {u(random), u(random), u(random)}) * scale(stretch * s);
}

Shape shape_of(std::mt19937& random, Id<TriangleMesh> mesh, double reach, double size) {
  Shape shape;
  shape.mesh = mesh;
  shape.material = {static_cast<std::uint32_t>(random() % 3)};
  shape.object_to_world = random_transform(random, reach, size);
  shape.flip_orientation = random() % 2;
  return shape;
}

// All kinds, of all sizes, through each other; in prototypes within prototypes too, with meshes; one that no
// ray can be taken to, as a transform flattens it. A lamp of triangles above.
Scene crowd() {
  std::mt19937 random(11);
  Scene scene;
  scene.materials = {Material{DiffuseMaterial{ConstantSpectrum{0.7f}}}, Material{DielectricMaterial{}},
                     Material{ConductorMaterial{}}};
  for (int i = 0; i < 60; ++i)
    scene.shapes.push_back(shape_of(random, add(scene, random_quadric(random)), 1, 0.1));
  const Id<TriangleMesh> cube = add_quads(scene, box_faces({-1, -1, -1}, {1, 1, 1}));
  for (std::uint32_t p = 0; p < 3; ++p) {
    Prototype& prototype = scene.prototypes.emplace_back();
    for (int i = 0; i < 3; ++i)
      prototype.shapes.push_back(
          shape_of(random, i == 1 ? cube : add(scene, random_quadric(random)), 0.3, 0.1));
    for (std::uint32_t inner = 0; inner < p; ++inner)
      prototype.instances.push_back({{inner}, random_transform(random, 0.3, 0.5), {}});
  }
  for (std::uint32_t i = 0; i < 24; ++i)
    scene.instances.push_back({{i % 3}, random_transform(random, 1, 0.5), {}});
  Shape flat = shape_of(random, add(scene, Quadric{}), 1, 0.1);
  flat.object_to_world = flat.object_to_world * scale({1, 1, 0});
  scene.shapes.push_back(flat);
  add_shape(scene, add_quads(scene, {{{{-3, -3, -1.5f}, {3, -3, -1.5f}, {3, 3, -1.5f}, {-3, 3, -1.5f}}}}),
            Material{DiffuseMaterial{}});
  add_shape(scene, add_quads(scene, {{{{-1, -1, 3}, {-1, 1, 3}, {1, 1, 3}, {1, -1, 3}}}}),
            Material{DiffuseMaterial{}}, AreaLight{ConstantSpectrum{5}});
  for (const QuadricKind kind : {QuadricKind::sphere, QuadricKind::cylinder, QuadricKind::cone}) {
    AreaLight lamp{ConstantSpectrum{20}};
    lamp.two_sided = kind != QuadricKind::sphere;
    add_shape(scene, add(scene, Quadric{.kind = kind}), Material{DiffuseMaterial{}}, lamp);
    scene.shapes.back().object_to_world =
        translate({static_cast<double>(kind) - 1, 1, 1}) * scale({.1, .1, .2});
  }
  set_camera(scene, {3, 3.5, 2.5}, {0, 0, 0}, {0, 0, 1}, 0.7, 40, 30);
  scene.settings.max_depth = 6;
  return scene;
}

// Curves through each other, bent and straight, and hair; as runs of the scene, in prototypes within
// prototypes, mirrored too, and one that no similarity places.
Scene hairy() {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> u(-1, 1);
  Scene scene;
  HairMaterial fibre;
  fibre.sigma_a = ConstantSpectrum{0.3f};
  scene.materials = {Material{DiffuseMaterial{ConstantSpectrum{0.7f}}}, Material{fibre},
                     Material{ConductorMaterial{}}};
  const auto strands = [&](int count, double reach) {
    KeptCurves curves(count % 2 ? QuadricUv::pbrt : QuadricUv::mitsuba, 0);
    for (int i = 0; i < count; ++i) {
      std::vector<CurvePoint> points;
      Point3d p{reach * u(random), reach * u(random), reach * u(random)};
      for (int k = 0; k < 7; ++k) {
        points.push_back({p, 0.02 + 0.01 * u(random)});
        p = p + Vector3d{u(random), u(random), u(random)} * 0.3;
      }
      const bool straight = i % 3 == 0;
      curves.add(placed_curves(straight ? linear_segments(points) : bspline_segments(points), 0, 1, straight,
                               i % 2 == 0));
    }
    scene.meshes.push_back(curves.mesh);
    return Id<TriangleMesh>{static_cast<std::uint32_t>(scene.meshes.size() - 1)};
  };
  const auto similarity = [&](double reach) {
    const double size = std::pow(2, u(random));
    return translate({reach * u(random), reach * u(random), reach * u(random)}) *
           rotate(3 * u(random), {u(random), u(random), u(random)}) *
           scale({size, size, random() % 2 ? -size : size});
  };
  const auto add_to = [&](std::vector<Shape>& shapes, Id<TriangleMesh> mesh) {
    Shape shape;
    shape.mesh = mesh;
    shape.material = {static_cast<std::uint32_t>(random() % 3)};
    shape.object_to_world = similarity(0.3);
    shape.flip_orientation = swaps_handedness(shape.object_to_world);
    shapes.push_back(shape);
  };
  for (int i = 0; i < 6; ++i) add_to(scene.shapes, strands(20 + i, 1));
  for (std::uint32_t p = 0; p < 2; ++p) {
    std::vector<Shape> shapes;
    add_to(shapes, strands(9, 0.3));
    Prototype& prototype = scene.prototypes.emplace_back();
    prototype.shapes = shapes;
    if (p > 0) prototype.instances.push_back({{0}, similarity(0.3), {}});
  }
  for (std::uint32_t i = 0; i < 8; ++i) scene.instances.push_back({{i % 2}, similarity(1), {}});
  add_to(scene.shapes, strands(3, 1));
  scene.shapes.back().object_to_world = scene.shapes.back().object_to_world * scale({1, 1, 0.5});
  add_shape(scene, add_quads(scene, {{{{-3, -3, -1.5f}, {3, -3, -1.5f}, {3, 3, -1.5f}, {-3, 3, -1.5f}}}}),
            Material{DiffuseMaterial{}});
  add_shape(scene, add_quads(scene, {{{{-1, -1, 3}, {-1, 1, 3}, {1, 1, 3}, {1, -1, 3}}}}),
            Material{DiffuseMaterial{}}, AreaLight{ConstantSpectrum{5}});
  set_camera(scene, {3, 3.5, 2.5}, {0, 0, 0}, {0, 0, 1}, 0.7, 40, 30);
  scene.settings.max_depth = 6;
  return scene;
}

std::uint64_t film_hash(const Scene& scene, const PartitionOptions& partitioning) {
  const TemporaryDirectory directory;
  partition(scene, directory / "scene.vit", partitioning);
  EXPECT_TRUE(verify_bundle(directory / "scene.vit", {}).problems.empty());
  RenderOptions options;
  options.bundle = directory / "scene.vit";
  options.outputs.film = directory / "scene.film";
  options.picture.samples_per_pixel = 2;
  int argc = 0;
  char** argv = nullptr;
  const auto transport = make_transport(&argc, &argv);
  return vitrail::render(*transport, options).film_hash;
}

void expect_one_picture(const Scene& scene) {
  const std::uint64_t hash = film_hash(scene, {.domains = 1});
  for (const std::uint32_t domains : {2u, 8u, 64u})
    EXPECT_EQ(film_hash(scene, {.domains = domains}), hash) << domains << " domains";
  EXPECT_EQ(film_hash(scene, {.domains = 8, .flatten = true}), hash) << "copies of instances";
  EXPECT_EQ(film_hash(scene, {.domains = 8, .domains_at_once = 2}), hash) << "spilled";
}

TEST(Quadrics, OnePictureHoweverTheyAreCut) { expect_one_picture(crowd()); }
TEST(Curves, OnePictureHoweverTheyAreCut) { expect_one_picture(hairy()); }

// Places of one quadric, in memory or in a file, are the same shapes one by one.
TEST(Quadrics, OnePictureOfManyPlaces) {
  std::mt19937 random(3);
  Scene one_by_one = crowd(), many = one_by_one;
  const Quadric ball{}, thread{.kind = QuadricKind::cylinder};
  for (const Quadric& quadric : {ball, thread}) {
    const Id<TriangleMesh> mesh = add(one_by_one, quadric), list = add(many, quadric);
    const auto places = std::make_shared<QuadricPlaces>(quadric, 0);
    for (int i = 0; i < 10'000; ++i) {
      Shape shape = shape_of(random, mesh, 1, 0.005);
      shape.material = {0};
      shape.flip_orientation = false;
      if (swaps_handedness(shape.object_to_world))
        shape.object_to_world = shape.object_to_world * scale({1, 1, -1});
      one_by_one.shapes.push_back(shape);
      places->add(shape.object_to_world);
    }
    many.meshes[list.value].places = places;
    Shape all;
    all.mesh = list;
    all.material = {0};
    many.shapes.push_back(all);
  }
  const std::uint64_t hash = film_hash(one_by_one, {.domains = 1});
  EXPECT_EQ(film_hash(many, {.domains = 1}), hash);
  EXPECT_EQ(film_hash(many, {.domains = 16}), hash);
  EXPECT_EQ(film_hash(many, {.domains = 16, .flatten = true}), hash);
  EXPECT_EQ(film_hash(many, {.domains = 16, .domains_at_once = 3}), hash);
}

// Of all quadrics where they stand the least (t, id) that a ray meets, by going through them one by one.
struct Standing {
  Affine to_bundle;
  OrientedQuadric oriented;
  std::uint32_t id;
};

void collect(const DomainView& domain, const DomainView& at, const Affine* chain, std::uint32_t first,
             std::map<std::uint32_t, Standing>& out) {
  for (const InstanceRef& ref : at.instances) {
    const DomainView& object = *domain.objects[ref.object];
    const Affine to_bundle = !chain           ? ref.to_parent
                             : object.quadric ? compose(*chain, object.quadric->quadric, ref.to_parent)
                                              : compose(*chain, ref.to_parent);
    const std::uint32_t id = first + ref.first_triangle;
    if (object.quadric)
      out[id] = {to_bundle, *object.quadric, id};
    else
      collect(domain, object, &to_bundle, id, out);
  }
}

void expect_the_least_of_all(Scene scene) {
  std::erase_if(scene.shapes, [&](const Shape& s) { return !scene.meshes[s.mesh.value].quadric; });
  scene.shapes.pop_back();  // the flat one becomes triangles
  for (Prototype& p : scene.prototypes)
    std::erase_if(p.shapes, [&](const Shape& s) { return !scene.meshes[s.mesh.value].quadric; });
  const TemporaryDirectory directory;
  partition(scene, directory / "scene.vit", {.domains = 16});
  const Manifest manifest = read_manifest(directory / "scene.vit");
  std::vector<std::unique_ptr<const LoadedDomain>> domains;
  std::map<std::uint32_t, Standing> all;
  for (std::uint32_t d = 0; d < manifest.domains.size(); ++d) {
    domains.push_back(load_domain(manifest, directory / "scene.vit", d));
    collect(domains.back()->view(), domains.back()->view(), nullptr, 0, all);
  }
  EXPECT_GT(all.size(), 150u);
  std::vector<std::unique_ptr<EmbreeDomain>> embree;
  for (const auto& domain : domains) embree.push_back(std::make_unique<EmbreeDomain>(domain->view()));

  std::mt19937 random(5);
  std::uniform_real_distribution<float> u(-1.5f, 1.5f);
  std::uint64_t hits = 0, differ = 0, occlusion = 0;
  const std::uint64_t tries = of_all(20'000, 5'000);
  for (std::uint64_t i = 0; i < tries; ++i) {
    const float away = i % 7 == 0 ? 1e6f : i % 3 == 0 ? 10.0f : 1.0f;
    const Point3f to{u(random), u(random), u(random)};
    const Vector3f way{u(random), u(random), u(random)};
    Ray ray{to + way * away, -way};
    Hit least;
    const auto find_least = [&] {
      least = {};
      for (const auto& [id, standing] : all) {
        const RayConstants constants = prepare(ray);
        const QuadricHits found =
            quadric_hits(constants, standing.to_bundle, standing.oriented.quadric, id == ray.exclude);
        if (found.count == 0) continue;
        const double t = seen_t(constants, standing.to_bundle, standing.oriented, found.at[0]);
        if (t < least.t || (t == least.t && id < least.triangle)) least.t = t, least.triangle = id;
      }
    };
    find_least();
    if (i % 5 == 0 && least.triangle != no_triangle) {
      ray.exclude = least.triangle;
      find_least();
    }
    hits += least.triangle != no_triangle;
    const auto walked = [&](const auto& closest) {
      Hit hit;
      DomainWalk walk(manifest, ray);
      for (DomainWalk::Visit visit; walk.next(hit.t, visit);) closest(visit.domain, hit);
      return hit;
    };
    const RayConstants constants = prepare(ray);
    for (const Kernel kernel : available_kernels()) {
      const Hit hit = walked([&](std::uint32_t d, Hit& h) {
        kernel_functions(kernel).closest(domains[d]->view(), constants, h);
      });
      differ += hit.t != least.t || hit.triangle != least.triangle;
    }
    const Hit hit = walked([&](std::uint32_t d, Hit& h) { embree[d]->closest(prepare(ray), h); });
    differ += hit.t != least.t || hit.triangle != least.triangle;
    const float tmax = static_cast<float>(least.t * (i % 2 ? 1 + 1e-6 : 1 - 1e-6));
    bool occluded = false;
    DomainWalk walk(manifest, ray);
    for (DomainWalk::Visit visit; !occluded && walk.next(double{tmax}, visit);)
      occluded = best_kernel().occluded(domains[visit.domain]->view(), constants, tmax);
    occlusion += occluded != (least.t < double{tmax});
  }
  EXPECT_GT(hits, tries / 4);
  EXPECT_EQ(differ, 0u);
  EXPECT_EQ(occlusion, 0u);
}

TEST(Quadrics, HitsAreTheLeastOfAll) { expect_the_least_of_all(crowd()); }
TEST(Curves, HitsAreTheLeastOfAll) {
  Scene scene = hairy();
  std::swap(scene.shapes.back(),
            scene.shapes[scene.shapes.size() - 3]);  // the one that becomes triangles last
  expect_the_least_of_all(scene);
}

// The picture of fine tubes.
TEST(Curves, LookLikeTubes) {
  Scene scene = hairy();
  const Brightness exact = brightness(render(scene, 64).film);
  for (TriangleMesh& mesh : scene.meshes)
    if (mesh.places) mesh = tessellate(*mesh.quadric, *mesh.places, 48);
  const Brightness triangles = brightness(render(scene, 64).film);
  EXPECT_NEAR(exact.mean, triangles.mean, 4 * std::hypot(exact.standard_error, triangles.standard_error));
  EXPECT_LT(exact.standard_error, 0.03 * exact.mean);
}

// Hair that absorbs nothing cannot be seen under a uniform sky.
TEST(Curves, WhiteHairVanishesUnderAUniformSky) {
  Scene scene = hairy();
  scene.shapes.resize(6);
  scene.instances.clear();
  scene.prototypes.clear();
  scene.area_lights.clear();
  HairMaterial fibre;
  fibre.sigma_a = ConstantSpectrum{0};
  for (Material& material : scene.materials) material = Material{fibre};
  scene.lights.push_back(Light{InfiniteLight{ConstantSpectrum{1}}});
  scene.settings.max_depth = 200;
  const Brightness result = brightness(render(scene, 64).film);
  EXPECT_NEAR(result.mean, 1, 4 * result.standard_error + 1e-3);
}

// The picture of finely tessellated ones, which are a little smaller.
TEST(Quadrics, LookLikeTheirTessellation) {
  Scene scene = crowd();
  const Brightness exact = brightness(render(scene, 64).film);
  for (TriangleMesh& mesh : scene.meshes)
    if (mesh.quadric) mesh = tessellate(*mesh.quadric, 256);
  const Brightness triangles = brightness(render(scene, 64).film);
  EXPECT_NEAR(exact.mean, triangles.mean, 4 * std::hypot(exact.standard_error, triangles.standard_error));
  EXPECT_LT(exact.standard_error, 0.03 * exact.mean);
}

// A lamp that shines along its normals alone is one of triangles.
TEST(Quadrics, LampsThatShineAlongTheirNormalsShine) {
  const auto lit = [](bool kept) {
    Scene scene;
    const Quadric disk{.kind = QuadricKind::disk, .low = 0};
    AreaLight light;
    light.radiance = ConstantSpectrum{1};
    light.directional = true;
    add_shape(scene, add(scene, disk), Material{DiffuseMaterial{}}, light);
    scene.shapes[0].object_to_world = translate({0, 0, 2});
    scene.shapes[0].flip_orientation = true;
    if (!kept) scene.meshes[0] = tessellate(disk);
    add_shape(scene, add_quads(scene, {{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}}}),
              Material{DiffuseMaterial{}});
    set_camera(scene, {3, 0, 1.5}, {0, 0, 0}, {0, 0, 1}, 0.6, 16, 16);
    return brightness(render(scene, 16).film).mean;
  };
  EXPECT_GT(lit(true), 0.01);
  EXPECT_EQ(lit(true), lit(false));
}

// A white or glass object under a uniform sky cannot be seen: what enters a ball of glass leaves it.
TEST(Quadrics, VanishUnderAUniformSky) {
  for (const Material& material :
       {Material{DiffuseMaterial{ConstantSpectrum{1}}}, Material{DielectricMaterial{}}})
    for (const double size : {1e-3, 1.0, 1e3}) {
      Scene scene;
      scene.materials = {material};
      Shape shape;
      shape.mesh = add(scene, Quadric{});
      shape.object_to_world = translate({300 * size, 0, 0}) * scale({size, 2 * size, -size});
      shape.flip_orientation = true;
      scene.shapes = {shape};
      scene.lights.push_back(Light{InfiniteLight{ConstantSpectrum{1}}});
      set_camera(scene, {304 * size, size, 0}, {300 * size, 0, 0}, {0, 0, 1}, 0.6, 16, 16);
      scene.settings.max_depth = 60;
      const Brightness result = brightness(render(scene, 64).film);
      EXPECT_NEAR(result.mean, 1, 4 * result.standard_error + 1e-4) << size;
    }
}

}  // namespace
}  // namespace vitrail::test::quadric_laws_test
