// SPDX-License-Identifier: Apache-2.0
#include "tests/bundle/sample_bundle.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>

#include "bundle/texture_file.h"

namespace vitrail::test {

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

Cluster cluster_of(std::uint32_t first_id, std::uint32_t triangles) {
  Cluster c;
  for (std::uint32_t lane = 0; lane < cluster_width; ++lane) {
    const bool filled = lane < triangles;
    c.id[lane] = filled ? first_id + lane : no_triangle;
    for (std::uint32_t k = 0; k < 3; ++k)
      for (std::uint32_t axis = 0; axis < 3; ++axis)
        c.vertex[k][axis][lane] =
            filled ? static_cast<float>(lane + (k == axis ? 1 : 0)) : std::numeric_limits<float>::quiet_NaN();
  }
  return c;
}

BvhNode node_over(std::initializer_list<std::uint32_t> children) {
  BvhNode n{};
  std::fill_n(&n.lower[0][0], 24, infinity);
  std::fill_n(&n.upper[0][0], 24, -infinity);
  std::fill_n(n.child, 8, BvhNode::empty);
  std::size_t i = 0;
  for (const std::uint32_t child : children) {
    for (int axis = 0; axis < 3; ++axis) {
      n.lower[axis][i] = -10;
      n.upper[axis][i] = 10;
    }
    n.child[i++] = child;
  }
  return n;
}

}  // namespace

DomainContent sample_domain() {
  DomainContent d;
  d.nodes = {node_over({1, BvhNode::cluster_bit | 1}), node_over({BvhNode::cluster_bit | 0})};
  d.clusters = {cluster_of(0, 8), cluster_of(8, 3)};
  d.normals.resize(2);
  for (ClusterNormals& n : d.normals) std::fill_n(&n.normal[0][0], 24, encode_normal({0, 0, 1}));
  d.pieces = {{3, 0, 3}};
  d.piece_vertices = {{0, 0, 0}, {0.1, 0, 1.0 / 3}, {0, 1, 0}};
  return d;
}

InstanceRef sample_instance(std::uint32_t object, std::uint32_t first_triangle) {
  InstanceRef ref{affine(translate({1, 2, 3})), {}, {}, object, first_triangle};
  set_box(ref, {{-10, -10, -10}, {10, 10, 10}});
  return ref;
}

DomainContent sample_object(std::uint32_t number) {
  DomainContent d;
  d.nodes = {node_over({BvhNode::cluster_bit | 0})};
  d.clusters = {cluster_of(0, 2)};
  if (number == 0) return d;
  d.instances = {sample_instance(0, 2)};
  d.instance_nodes = {node_over({BvhNode::cluster_bit | 0})};
  return d;
}

void add_objects(Manifest& m) {
  m.triangles = 15;
  m.surfaces.insert(m.surfaces.end(), {{0, 1}, {0, 2}, {1, 0}});
  m.objects = {{2, 1, 1, 3, 1, {}}, {4, 1, 1, 4, 2, {0}}};
  for (DomainInfo& d : m.domains) d.instances = 1, d.objects = {0, 1};
}

Manifest sample_manifest() {
  Manifest m;
  m.triangles = 11;
  m.cut_triangles = 1;
  m.offset = {1e7, -0.1, 1.0 / 3};
  m.bounds = {{-1.1f, -2, -3}, {1, 2.2f, 3}};
  m.scale = 3;
  m.kd_nodes = {{0.1f, 0, 1, KdNode::leaf_bit | 2}, {-1e-20f, 2, KdNode::leaf_bit | 0, KdNode::leaf_bit | 1}};
  m.domains = {{11, 1, 1, 1, {{-1, -2, -3}, {1.0f / 3, 2, 3}}, {{1, 0, 3, 0, ~std::uint64_t{0}}}},
               {11, 1, 1, 1, {}, {}},
               {11, 1, 1, 1, {}, {}}};
  m.surfaces = {{0, 1, -1, 0, -1}, {4, 2, 0, -1, -1}, {9, 0, 1, -1, 1}};
  TabulatedSpectrum table;
  for (int i = 0; i < table_size; ++i) table.values.push_back(static_cast<float>(i) / 7);
  CheckerboardTexture board{ConstantSpectrum{0.1f}, Id<Texture>{0}, UvMapping{1, 2, 3, 4, 5, 6}};
  m.textures = {Texture{ImageTexture{"textures/000000.tex", {}, Wrap::mirror, TextureFilter::trilinear}},
                Texture{board}};
  Material mixed{BlendMaterial{{1}, {0}, Id<Texture>{1}}};
  mixed.two_sided = false;
  mixed.displacement = Id<Texture>{1};
  m.materials = {Material{DiffuseMaterial{SigmoidSpectrum{0.1f, -0.2f, infinity}, 0.5f}},
                 Material{DielectricMaterial{SellmeierSpectrum{{1.03, 0.23, 1.01}, {0.006, 0.02, 103.56}}}},
                 mixed};
  Medium grid;
  grid.coefficients = ExtinctionAlbedo{Grid{"", "", 2, 1, 1, 1, {0.5f, 0.25f}}, ConstantSpectrum{0.9f}};
  grid.medium_to_world = translate({1, 2, 3});
  m.media = {Medium{.coefficients = AbsorptionScattering{table, ConstantSpectrum{2}}, .g = 0.5f}, grid};
  m.area_lights = {{table, 1, true}, {RgbIlluminantSpectrum{{1e-5f, 2, 3}, 4}, 2, false, true}};
  m.emissive_triangles = {{{{0, 0, 0}, {1, 0, 0}, {0, 1.1f, 0}}, {{0, 1}, {2, 3}, {4, 5}}, 5, 0},
                          {{{0, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {}, 10, 1}};
  m.lights = {Light{PointLight{{1, 2, 1.0 / 3}, ConstantSpectrum{1.5f}}},
              Light{DistantLight{{0, 0, -1}, ConstantSpectrum{0.1f}}},
              Light{InfiniteLight{ConstantSpectrum{2}}},
              Light{SpotLight{translate({0, 1, 0}), ConstantSpectrum{3}, 10, 20, SpotLight::Falloff::linear,
                              Id<Texture>{1}}}};
  m.camera_medium = 1;
  m.texture_files = {{"textures/000000.tex", 12, 0x123456789abcdef0u}};
  m.camera = OrthographicCamera{translate({0.1, 1e-300, 3}), {-1.0 / 3, 1, -2, 2}, {0.1, 1.0 / 3}};
  m.film = {640, 480, {10, 600, 20, 400}, GaussianFilter{1.25, 1.5, 0.1}, 0.7, {5, 400, 700}};
  m.settings = {33, 7, true, false};
  m.settings.photons = PhotonSettings{5000, 0.25, {}};
  m.requirements = {true, false, true, false, true, true, true};
  m.scene_hash = 0xfedcba9876543210u;
  return m;
}

void write_sample_bundle(const std::filesystem::path& bundle) {
  Manifest m = sample_manifest();
  std::filesystem::create_directories(bundle / "domains");
  for (std::uint32_t i = 0; i < m.domains.size(); ++i) {
    m.domains[i].bytes = write_domain_file(domain_path(bundle, i), sample_domain());
    m.domains[i].hash = MappedDomain(domain_path(bundle, i)).hash();
  }
  write_manifest(bundle, m);
}

SampleBundle whole_bundle() {
  SampleBundle b{sample_manifest(), std::vector<DomainContent>(3), {sample_object(0), sample_object(1)}};
  b.domains[0] = b.domains[1] = sample_domain();
  b.domains[0].piece_vertices = {{4, 3, 3}, {3, 4, 3}, {3.5, 3, 3.5}};
  b.domains[1].piece_vertices = {{3.5, 3, 3.5}, {3, 4, 3}, {3, 3, 4}};
  b.domains[1].nodes = {node_over({BvhNode::cluster_bit | 0})};
  b.domains[1].clusters.resize(1);
  for (std::uint32_t& id : b.domains[1].clusters[0].id)
    if (id != 3) id = no_triangle;
  for (DomainContent& d : b.domains) {
    d.instances = {sample_instance(1, 11)};
    d.instance_nodes = {node_over({BvhNode::cluster_bit | 0})};
  }
  for (std::vector<DomainContent>* contents : {&b.domains, &b.objects})
    for (DomainContent& d : *contents) {
      d.normals.resize(d.clusters.size());
      d.uvs.resize(d.clusters.size());
      d.attributes.resize(d.clusters.size());
      for (ClusterNormals& n : d.normals) std::fill_n(&n.normal[0][0], 24, encode_normal({0, 1, 1}));
      for (ClusterUvs& u : d.uvs) std::fill_n(&u.uv[0][0][0], 48, 0.3f);
      for (ClusterAttributes& v : d.attributes) std::fill_n(&v.value[0][0][0], 72, 0.7f);
    }
  Manifest& m = b.manifest;
  add_objects(m);
  m.requirements.uv = true;
  m.attributes = 1;
  m.domains[0].triangles = 11, m.domains[1].triangles = 1, m.domains[2].triangles = 0;
  m.domains[2].pieces = 0;
  for (DomainInfo& d : m.domains) {
    d.tight_bounds = {{-10, -10, -10}, {10, 10, 10}};
    d.occupancy.slice.fill(~std::uint64_t{0});
  }
  return b;
}

void write(SampleBundle& b, const std::filesystem::path& bundle) {
  for (const char* folder : {"domains", "objects", "textures"})
    std::filesystem::create_directories(bundle / folder);
  Manifest& m = b.manifest;
  for (std::uint32_t i = 0; i < m.domains.size(); ++i)
    m.domains[i].bytes = write_domain_file(domain_path(bundle, i), b.domains[i], &m.domains[i].hash);
  for (std::uint32_t i = 0; i < m.objects.size(); ++i)
    m.objects[i].bytes = write_domain_file(object_path(bundle, i), b.objects[i], &m.objects[i].hash);
  const auto texel = [](std::uint32_t level, std::uint32_t x, std::uint32_t y) {
    return TexelWords{level + 1, x, y};
  };
  TextureFileEntry& t = m.texture_files[0];
  const WrittenTextureFile written =
      write_texture_file(bundle / t.name, {TexelFormat::reflectance, 70, 40, 3}, texel);
  t.bytes = written.bytes, t.hash = written.hash;
  write_manifest(bundle, m);
}

std::string read_text(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

void write_text(const std::filesystem::path& file, const std::string& text) {
  // Overwrites in place: file systems flush a file that was truncated to nothing, which is slow.
  std::ofstream(file, std::ios::binary | std::ios::in | std::ios::out) << text;
  std::filesystem::resize_file(file, text.size());
}

}  // namespace vitrail::test
