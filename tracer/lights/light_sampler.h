// SPDX-License-Identifier: Apache-2.0
// A LightSampler chooses a light and a point on it to connect to. It also gives what lights emit where a ray
// finds them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "bundle/manifest.h"
#include "scene/geometry/bounds.h"
#include "scene/records/light.h"
#include "tracer/lights/environment.h"
#include "tracer/lights/light_ref.h"
#include "tracer/lights/light_tree.h"
#include "tracer/lights/point_emitter.h"
#include "tracer/lights/quadric_light.h"
#include "tracer/lights/triangle_parts.h"
#include "tracer/sampling/flat_spectrum.h"
#include "tracer/sampling/guide_table.h"
#include "tracer/sampling/wavelengths.h"
#include "tracer/textures/textures.h"

namespace vitrail {

// It holds all that a scene's light comes from. Spectra are resolved, positions and transforms end in the
// bundle's coordinates, and filenames are baked files of the bundle. The data that the spans show outlive the
// sampler.
struct LightScene {
  std::span<const AreaLight> area_lights;
  std::span<const EmissiveTriangle> triangles;
  std::span<const CornerValues> attributes;   // of the triangles, [triangle][slot], or empty
  std::span<const FloatParameter> opacities;  // of the triangles' surfaces, or empty: all 1
  std::span<const EmissiveQuadric> quadrics;
  std::span<const Light> lights;
  const Textures* textures = nullptr;        // null: no light has a texture; images get 16 MiB
  std::span<const Texture> texture_records;  // of `textures`: for the shape of a projected image
  Bounds3f bounds;                           // of the scene
  bool refracts = false;                     // some smooth surface of it does
  bool bands = false;                        // its colours are spectra of bands (scene/spectra/rgb_bands.h)
};

// It is a point of an emissive triangle or quadric with what its textures read.
struct EmissivePoint {
  TexturePoint at;
  std::array<AttributeValue, max_attributes> attributes;
  std::uint32_t attribute_count = 0;  // quadrics have none
  EmissivePoint(const LightScene& scene, std::size_t triangle, double b1, double b2);
  EmissivePoint(const QuadricLight& quadric, Point3d local);
  // Returns a point that refers to this.
  TexturePoint point() const;
};

// Returns whether an emissive surface is a light that nothing meets.
inline bool is_invisible(const FloatParameter& opacity) { return opacity == FloatParameter{0.0f}; }

// It has luminances of an area light on its surfaces. A surface that nothing meets counts as whole.
struct Glow {
  double mean = 0;  // over the surfaces
  double most = 0;  // of what is seen of any point, about; 0: certainly nothing shines
};

// One choice is the tree over all triangles, quadrics and point-like lights; every distant light and every
// environment image is one more. Each has a share: half of them equal, half by power. Power is luminous; of a
// scene in bands it is the mean of the three for lamps without a surface, or blue ones were hardly chosen.
// Constant infinite lights are left to the BSDF's own samples, which find them with weight 1.
struct LightSampler {
  LightScene scene;
  LightNumbers numbers;  // of all its lights
  LightTree tree;        // of the triangles, the quadrics, the emitters
  // It holds what sampling reads of a triangle, in one cache line. The last three members are those of a
  // quadric, too.
  struct alignas(64) Slot {
    std::array<Point3f, 3> p;
    LightRef light;
    std::uint32_t area_light = 0;
    FloatParameter opacity = 1.0f;
  };
  static_assert(sizeof(Slot) == 64);
  std::vector<Slot> slots;  // in the tree's order; empty where there are no surfaces in it
  LightRef light_of(std::size_t slot) const { return numbers.light(tree.order()[slot]); }
  // It holds what follows from the corners of a triangle. There is one for each triangle, but none where
  // there are so many that reading one would take longer than making it anew.
  struct Face {
    Vector3d normal;  // unit; 0 of one without area
    double area = 0;
    double tilt_rad = 0;  // of this triangle and a neighbour in the same plane, against each other
    Face() = default;
    explicit Face(std::span<const Point3f, 3> corners);
  };
  static constexpr std::size_t most_faces = 1 << 15;
  std::vector<Face> faces;
  Face face(std::size_t triangle) const {
    return faces.empty() ? Face(scene.triangles[triangle].p) : faces[triangle];
  }
  // Triangles with a texture that shines in places have one of `parts`, others `whole`; empty where all are
  // whole.
  static constexpr std::uint32_t whole = ~0u;
  std::vector<TriangleParts> parts;
  std::vector<std::uint32_t> parts_of;
  const TriangleParts* parts_of_triangle(std::size_t triangle) const {
    return triangle < parts_of.size() && parts_of[triangle] != whole ? &parts[parts_of[triangle]] : nullptr;
  }
  std::vector<QuadricLight> quadrics;
  std::vector<Glow> glows;  // of the area lights
  std::vector<PointEmitter> emitters;
  LightBounds bounds_of_emitter(const PointEmitter& emitter) const;  // power: luminous flux
  // It is a light of one direction. The sun of a sky is one where some surface refracts. No sample of a BSDF
  // would find its disc through glass. A connection to a disc could not tell where behind the glass it ends.
  // So each path and each photon sees one point of the disc.
  struct Distant {
    Vector3d direction;       // unit, the way the light travels; of a sun, of its middle
    std::uint32_t light = 0;  // index into scene.lights
    Spectrum irradiance{};    // across its direction; of a sun, of all its disc
    std::shared_ptr<const SkyModel> sun{};
    DirectionFrame frame{};
    // They are the directions towards each of the suns that it stands for in the rows of a film
    // (tracer/prepared/daylight_rows.h). The first number then chooses the sun. Empty: it is one light.
    std::span<const Vector3d> rows{};
    // Returns a unit direction for two numbers in [0,1).
    Vector3d to_light(float u, float v) const;
    // Returns the irradiance from one of those directions.
    SampledSpectrum irradiance_from(Vector3d to_light, const SampledWavelengths& wavelengths) const;
  };
  // Returns the first number of Distant::to_light for a point of a row's disc, which u, another number in
  // [0,1), chooses.
  static float number_of_row(std::size_t row, std::size_t rows, float u);
  std::vector<Distant> distant;     // ascending by their lights
  std::vector<std::uint32_t> suns;  // those of them that are suns
  std::vector<Environment> environments;
  std::vector<std::uint32_t> infinite;  // index into scene.lights
  std::vector<FlatSpectrum> constant;   // their radiances
  std::vector<double> share;            // of each of LightNumbers' choices; sums to 1, empty: no light
  std::vector<double> share_sums;       // of the shares before each, and of all: 1
  GuideTable share_guide;               // of the sums
  std::size_t choice_of(double u) const { return share_guide.bin(share_sums, u); }  // u in [0,1)

  // It says that the global ids [first, first + count) are triangles and quadrics that emit, numbered from
  // `number` on.
  struct Run {
    std::uint32_t first = 0, count = 0, number = 0;
  };
  std::vector<Run> runs;  // ascending

  // It says that sample_light does not need u[3]: there is nothing but the tree, and it is small enough for
  // 24 bits.
  bool three_numbers = false;
  // It says that one candidate is enough: there is one light with one direction to it, or some are all
  // around. A sun, its sky or what shines into a room brings most wherever nothing is in its way, and most
  // shadows are where something is.
  bool one_is_enough = false;
  bool tree_chooses = false;  // among several lamps of one radiance each
  Point3d lamp_center;        // where there is one lamp, of one or two surfaces and one radiance,
  double lamp_radius2 = 0;    // a sphere around it; else 0

  // Returns the first choice (LightNumbers) that is an environment.
  std::size_t first_environment() const { return LightNumbers::choice_of_tree + 1 + distant.size(); }
  // Returns whether sample_light may ever give something.
  bool can_sample() const { return !share.empty(); }
  // It says that a scattered ray finds no light that connections also go to.
  bool has_only_glows = false;
  bool fades = false;  // some emitter does, as POV-Ray's
  // They return whether background's radiance may be other than 0, and that of discs.
  bool has_background() const { return !infinite.empty() || !environments.empty() || has_discs(); }
  bool has_discs() const { return !suns.empty(); }
};

// An ImageSource opens an image by its name in the records.
using ImageSource = std::function<std::shared_ptr<const LightImage>(const std::string& filename)>;

// Throws Error where an image is damaged.
LightSampler make_light_sampler(const LightScene& scene, const std::filesystem::path& bundle,
                                LightChoice choice = LightChoice::tree);
LightSampler make_light_sampler(const LightScene& scene, const ImageSource& images,
                                LightChoice choice = LightChoice::tree);

struct LightSample {
  Vector3d to_light;    // unit
  Vector3d normal{};    // of the surface there, unit; 0: a point, or not finitely far
  double tilt_rad = 0;  // bound of what the rounding of corners turns that surface's triangles by
  const EmissiveQuadric* quadric = nullptr;  // that the surface is of
  double distance = 0;                       // ∞ for distant lights and environments
  SampledSpectrum radiance;                  // of points and distant lights: irradiance across the direction
  double pdf = 0;         // solid angle, the choice included; of those: probability of the choice
  bool is_delta = false;  // no ray finds it by chance
  LightRef light;
};

// It keeps the radiance, at the wavelengths of one path, of the lamp without a texture that was met last.
struct LastLamp {
  static constexpr std::uint32_t none = ~0u;
  std::uint32_t area_light = none;
  SampledSpectrum radiance;
};

struct LightQuery;

// It makes connections from p, of several candidates one after the other: what is the same for all is found
// once. It refers to all its arguments. `far` has the numbers for distant lights at the point, one pair for
// all of a path. `last` is what a path keeps from one connection to the next.
class LightChooser {
 public:
  LightChooser(const LightSampler& sampler, Point3d p, const std::array<float, 2>& far,
               const SampledWavelengths& wavelengths, LastLamp& last)
      : sampler_(sampler), p_(p), far_(far), wavelengths_(wavelengths), last_(last), tree_(sampler.tree, p) {}
  // u[0], u[1] are for the point, u[2], u[3] for the light. It returns nothing where nothing arrives.
  std::optional<LightSample> sample(const std::array<float, 4>& u);

 private:
  bool draw(const LightQuery& query, LightSample& sample);
  bool draw_from_tree(const LightQuery& query, double choice, LightSample& sample);
  const LightSampler& sampler_;
  Point3d p_;
  const std::array<float, 2>& far_;
  const SampledWavelengths& wavelengths_;
  LastLamp& last_;
  LightTree::Point tree_;
};

// Returns one connection, as LightChooser does.
std::optional<LightSample> sample_light(const LightSampler& sampler, Point3d p, const std::array<float, 4>& u,
                                        const std::array<float, 2>& far,
                                        const SampledWavelengths& wavelengths, LastLamp& last);
// Here `far` is u[0], u[1].
std::optional<LightSample> sample_light(const LightSampler& sampler, Point3d p, const std::array<float, 4>& u,
                                        const SampledWavelengths& wavelengths);

// It says how much samples of the lights differ by what they bring to a diffuse point. `none`: not at all.
// `little`: there is one lamp that is small from there, or the tree chooses from lamps by what they send
// there. `much`: all else.
enum class Variety : std::uint8_t { none, little, much };
Variety variety(const LightSampler& sampler, Point3d p);

// Returns the density, per solid angle and with the choice included, with which sample_light(from) gives the
// point `at` of the triangle or quadric (global id). The point is at that distance, seen at `cosine` from its
// normal (> 0: its front).
double triangle_pdf(const LightSampler& sampler, Point3d from, std::uint32_t triangle, Point3d at,
                    double distance, double cosine);
// Returns the radiance of an emitter's surface where a ray meets it, seen at `cosine` from its normal. It is
// 0 for directional lights.
SampledSpectrum emitted(const LightSampler& sampler, std::uint32_t area_light, const TexturePoint& at,
                        double cosine, const SampledWavelengths& wavelengths, LastLamp& last);
SampledSpectrum emitted(const LightSampler& sampler, std::uint32_t area_light, const TexturePoint& at,
                        double cosine, const SampledWavelengths& wavelengths);
// Returns the radiance that leaves a triangle or quadric at a point. It counts the part of the surface that
// is there, and a surface that nothing meets as whole.
SampledSpectrum leaving(const LightSampler& sampler, LightRef light, const EmissivePoint& point,
                        const SampledWavelengths& wavelengths);
// It holds what a ray finds that leaves the scene: the sum of constant and image environments. Its pdf is the
// density, as of triangle_pdf, with which sample_light gives the direction.
struct Background {
  SampledSpectrum radiance;
  double pdf = 0;
};
// `direction` is unit, outwards.
Background background(const LightSampler& sampler, Vector3d direction, const SampledWavelengths& wavelengths);

// Returns the radiance of the suns among the distant lights where a ray leaves the scene through their discs.
SampledSpectrum discs(const LightSampler& sampler, Vector3d direction, const SampledWavelengths& wavelengths);

// Visits the lights of `background` and `discs`, one by one: see(index into scene.lights, radiance).
template <class See>
void each_background_light(const LightSampler& sampler, Vector3d direction,
                           const SampledWavelengths& wavelengths, See&& see) {
  for (const std::uint32_t i : sampler.infinite)
    see(i, evaluate(std::get<InfiniteLight>(sampler.scene.lights[i].model).radiance, wavelengths));
  for (const Environment& e : sampler.environments)
    see(e.light, value_towards(e, direction, wavelengths).radiance);
  for (const std::uint32_t i : sampler.suns)
    if (const LightSampler::Distant& d = sampler.distant[i]; d.sun->meets_sun(d.frame.to_light(direction)))
      see(d.light, d.sun->sun(d.frame.to_light(direction), wavelengths));
}

// Returns whether `accept` accepts any of the directions to certain distant lights. Their numbers
// (LightSampler::Distant::light) are `bits` in the bits of `mask`, which is 2ⁿ − 1. `far` is that of
// sample_light.
template <class Accept>
bool any_distant_light(const LightSampler& sampler, std::uint32_t bits, std::uint32_t mask,
                       const std::array<float, 2>& far, Accept&& accept) {
  auto at = sampler.distant.begin();
  for (std::uint64_t light = bits; at != sampler.distant.end(); light += std::uint64_t{mask} + 1) {
    at = std::lower_bound(
        at, sampler.distant.end(), light,
        [](const LightSampler::Distant& d, std::uint64_t number) { return d.light < number; });
    if (at != sampler.distant.end() && at->light == light && accept(at->to_light(far[0], far[1])))
      return true;
  }
  return false;
}

}  // namespace vitrail
