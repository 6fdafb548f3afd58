// SPDX-License-Identifier: Apache-2.0
#include "tests/support/equal_scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "scene/records/uv_uses.h"
#include "scene/shapes/curve.h"
#include "scene/shapes/mesh_uv.h"
#include "scene/shapes/quadric_places.h"

namespace vitrail::test {

namespace {

// Copies what is asked for, what it refers to first.
class Renumbering {
 public:
  explicit Renumbering(const Scene& from) : from_(from) {}

  void use(Id<TriangleMesh>& id) {
    copy(id, meshes_, from_.meshes, to.meshes, [](TriangleMesh&) {});
  }
  void use(Id<Texture>& id) {
    copy(id, textures_, from_.textures, to.textures, [&](Texture& texture) {
      texture.name.clear();
      std::visit([&](auto& t) { use_inputs(t); }, texture.model);
    });
  }
  void use(Id<Material>& id) {
    copy(id, materials_, from_.materials, to.materials, [&](Material& material) {
      material.name.clear();
      if (material.displacement) use(*material.displacement);
      if (material.normal_map) use(*material.normal_map);
      std::visit([&](auto& m) { use_inputs(m); }, material.model);
    });
  }
  void use(Id<Medium>& id) {
    copy(id, media_, from_.media, to.media, [](Medium& medium) { medium.name.clear(); });
  }
  void use(Id<AreaLight>& id) {
    copy(id, area_lights_, from_.area_lights, to.area_lights, [&](AreaLight& light) {
      light.name.clear();
      use(light.radiance);
    });
  }
  void use(Id<Prototype>& id) {
    copy(id, prototypes_, from_.prototypes, to.prototypes, [&](Prototype& prototype) {
      prototype.name.clear();
      for (Shape& shape : prototype.shapes) use(shape);
      for (Instance& instance : prototype.instances) use(instance);
    });
  }
  void use(Instance& instance) {
    use(instance.prototype);
    if (instance.motion) copy(*instance.motion, motions_, from_.motions, to.motions, [](Motion&) {});
  }
  void use(Shape& shape) {
    shape.name.clear();
    use(shape.mesh), use(shape.material), use(shape.opacity);
    if (shape.area_light) use(*shape.area_light);
    if (shape.interior) use(*shape.interior);
    if (shape.exterior) use(*shape.exterior);
  }
  void use(Light& light) {
    light.name.clear();
    if (auto* projection = std::get_if<ProjectionLight>(&light.model)) use(*projection->image);
    if (auto* spot = std::get_if<SpotLight>(&light.model); spot && spot->texture) use(*spot->texture);
  }

  Scene to;

 private:
  using Numbers = std::map<std::uint32_t, std::uint32_t>;

  template <class Record, class Follow>
  void copy(Id<Record>& id, Numbers& numbers, const std::vector<Record>& from, std::vector<Record>& records,
            Follow&& follow) {
    if (const auto known = numbers.find(id.value); known != numbers.end()) {
      id.value = known->second;
      return;
    }
    Record record = from.at(id.value);
    follow(record);
    const auto same = std::find(records.begin(), records.end(), record);
    const auto number = static_cast<std::uint32_t>(same - records.begin());
    if (same == records.end()) records.push_back(std::move(record));
    numbers[id.value] = number;
    id.value = number;
  }

  void use(SpectrumParameter& parameter) {
    if (auto* id = std::get_if<Id<Texture>>(&parameter)) use(*id);
  }
  void use(FloatParameter& parameter) {
    if (auto* id = std::get_if<Id<Texture>>(&parameter)) use(*id);
  }
  void use(Roughness& r) { use(r.alpha_u), use(r.alpha_v); }
  void use(CoatingVolume& c) { use(c.thickness), use(c.g), use(c.albedo); }
  void use(Metal& metal) {
    if (auto* index = std::get_if<ComplexIndex>(&metal)) use(index->eta), use(index->k);
    if (auto* normal = std::get_if<NormalReflectance>(&metal)) use(normal->reflectance);
  }

  void use_inputs(auto&) {}
  void use_inputs(CheckerboardTexture& t) { use(t.even), use(t.odd); }
  void use_inputs(ProductTexture& t) { use(t.first), use(t.second); }
  void use_inputs(MixTexture& t) { use(t.first), use(t.second), use(t.amount); }
  void use_inputs(DirectionMixTexture& t) { use(t.first), use(t.second); }
  void use_inputs(BilinearTexture& t) { use(t.v00), use(t.v01), use(t.v10), use(t.v11); }
  void use_inputs(DotsTexture& t) { use(t.inside), use(t.outside); }
  void use_inputs(PatternTexture& t) {
    for (PatternStop& stop : t.map) use(stop.value);
  }

  void use_inputs(DiffuseMaterial& m) { use(m.reflectance), use(m.sigma_deg); }
  void use_inputs(DielectricMaterial& m) {
    use(m.roughness), use(m.reflectance_factor), use(m.transmittance_factor);
  }
  void use_inputs(ThinDielectricMaterial& m) { use(m.reflectance_factor), use(m.transmittance_factor); }
  void use_inputs(ConductorMaterial& m) { use(m.metal), use(m.roughness), use(m.reflectance_factor); }
  void use_inputs(PlasticMaterial& m) {
    use(m.diffuse_reflectance), use(m.specular_reflectance), use(m.roughness);
  }
  void use_inputs(CoatedDiffuseMaterial& m) { use(m.reflectance), use(m.roughness), use(m.volume); }
  void use_inputs(CoatedConductorMaterial& m) {
    use(m.metal), use(m.conductor_roughness), use(m.interface_roughness), use(m.volume);
  }
  void use_inputs(DiffuseTransmissionMaterial& m) { use(m.reflectance), use(m.transmittance); }
  void use_inputs(PrincipledMaterial& m) {
    use(m.base_color);
    for (FloatParameter* p :
         {&m.roughness, &m.anisotropic, &m.metallic, &m.spec_trans, &m.spec_tint, &m.sheen, &m.sheen_tint,
          &m.flatness, &m.clearcoat, &m.clearcoat_gloss, &m.diff_trans})
      use(*p);
  }
  void use_inputs(SubsurfaceMaterial& m) {
    if (auto* c = std::get_if<SubsurfaceMaterial::Coefficients>(&m.interior))
      use(c->sigma_a), use(c->sigma_s);
    if (auto* e = std::get_if<SubsurfaceMaterial::Effective>(&m.interior))
      use(e->reflectance), use(e->mean_free_path);
    use(m.roughness);
  }
  void use_inputs(HairMaterial& m) {
    for (auto* p : {&m.sigma_a, &m.color})
      if (*p) use(**p);
    for (auto* p : {&m.eumelanin, &m.pheomelanin})
      if (*p) use(**p);
    use(m.beta_m), use(m.beta_n), use(m.alpha_deg);
  }
  void use_inputs(BlendMaterial& m) { use(m.first), use(m.second), use(m.amount); }
  void use_inputs(MaskMaterial& m) { use(m.opacity), use(m.material); }
  void use_inputs(TwoSidedMaterial& m) { use(m.front), use(m.back); }

  const Scene& from_;
  Numbers meshes_, textures_, materials_, media_, area_lights_, prototypes_, motions_;
};

template <class Record>
std::string difference(const char* what, const std::vector<Record>& a, const std::vector<Record>& b) {
  if (a.size() != b.size()) return fmt::format("there are {} and {} of: {}", a.size(), b.size(), what);
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!(a[i] == b[i])) return fmt::format("{} {}", what, i);
  return "";
}

// A number of a curve's record is rounded where it is written and where it is read.
bool are_near(const PlacedCurve& a, const PlacedCurve& b) {
  double size = 0, off = length(a.origin - b.origin);
  for (std::size_t k = 0; k < 3; ++k) {
    size = std::max(size, length(cast<double>(a.to[k])));
    off = std::max(off, length(cast<double>(a.to[k] - b.to[k])));
  }
  for (std::size_t k = 0; k < 4; ++k)
    off = std::max(off, std::abs(double{a.radius[k]} - double{b.radius[k]}));
  return off <= 1e-5 * size && a.straight == b.straight && a.mirrored == b.mirrored &&
         a.along_first == b.along_first && a.along_last == b.along_last;
}

bool have_same_curves(const TriangleMesh& a, const TriangleMesh& b) {
  if (!a.places || !b.places || !is_curve(*a.quadric) || a.places->size() != b.places->size()) return false;
  std::vector<Transform> of_a(a.places->size()), of_b(of_a.size());
  a.places->read(0, of_a), b.places->read(0, of_b);
  const auto unpacked = [](const Transform& packed) { return unpacked_curve(packed); };
  return std::ranges::equal(of_a, of_b, are_near, unpacked, unpacked);
}

}  // namespace

Scene canonical(const Scene& scene) {
  Renumbering numbers(scene);
  for (Shape shape : scene.shapes) {
    numbers.use(shape);
    numbers.to.shapes.push_back(std::move(shape));
  }
  for (Instance instance : scene.instances) {
    numbers.use(instance);
    numbers.to.instances.push_back(instance);
  }
  for (Light light : scene.lights) {
    numbers.use(light);
    numbers.to.lights.push_back(std::move(light));
  }
  numbers.to.camera = scene.camera;
  numbers.to.camera_motion = scene.camera_motion;
  if (scene.camera_motion.moves() || !scene.motions.empty()) numbers.to.shutter = scene.shutter;
  numbers.to.camera_medium = scene.camera_medium;
  if (numbers.to.camera_medium) numbers.use(*numbers.to.camera_medium);
  numbers.to.film = scene.film;
  numbers.to.settings = scene.settings;
  return std::move(numbers.to);
}

// The (u,v) that a mesh lacks are its format's, and are written out only where they show.
Scene with_explicit_uvs(Scene scene) {
  const std::vector<bool> show = meshes_whose_uvs_show(scene);
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    TriangleMesh& mesh = scene.meshes[i];
    if (mesh.quadric && !show[i]) mesh.quadric->uv = {};
    if (show[i] && mesh.uvs.empty() && !mesh.deferred && !mesh.quadric) mesh = with_uvs(std::move(mesh));
    mesh.missing_uv = {};
  }
  return scene;
}

std::string difference(const Scene& one, const Scene& other) {
  const Scene a = canonical(with_explicit_uvs(one));
  Scene b = canonical(with_explicit_uvs(other));
  for (std::size_t i = 0; i < std::min(a.meshes.size(), b.meshes.size()); ++i)
    if (have_same_curves(a.meshes[i], b.meshes[i])) b.meshes[i].places = a.meshes[i].places;
  if (!(a.camera == b.camera)) return "the camera";
  if (!(a.camera_motion == b.camera_motion && a.shutter == b.shutter)) return "the motion of the camera";
  if (!(a.film == b.film)) return "the film";
  if (!(a.settings == b.settings)) return "the settings";
  if (a.camera_medium != b.camera_medium) return "the medium of the camera";
  for (const std::string& found :
       {difference("mesh", a.meshes, b.meshes), difference("texture", a.textures, b.textures),
        difference("material", a.materials, b.materials), difference("medium", a.media, b.media),
        difference("area light", a.area_lights, b.area_lights), difference("light", a.lights, b.lights),
        difference("shape", a.shapes, b.shapes), difference("prototype", a.prototypes, b.prototypes),
        difference("instance", a.instances, b.instances), difference("motion", a.motions, b.motions)})
    if (!found.empty()) return found;
  return "";
}

}  // namespace vitrail::test
