// SPDX-License-Identifier: Apache-2.0
// The fade of interiors leaves c + (1 − c)/(1 + (d/distance)^power) of what is behind, and of a power of 1000
// e^(−(1 − c)·d/distance), where c is its colour. media {} as POV-Ray's pictures show them. Over a distance
// d, absorption a leaves e^(−a·d), emission e adds e·d. Scattering s takes s·extinction·d away, and under a
// lamp of colour c that does not fade shows c·s·d where it is isotropic: four times what σ_s = s does here,
// as such a lamp has the intensity π·c.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "importers/povray/read/extents.h"
#include "importers/povray/read/object_hits.h"
#include "importers/povray/read/pattern_field.h"
#include "importers/povray/read/reader.h"
#include "importers/povray/read/scene_maker.h"
#include "scene/spectra/rgb_to_spectrum.h"

namespace vitrail::pov {

namespace {

using Three = std::array<double, 3>;

// Of a grid of densities, along each axis: usually, and where neighbours of the first have little in common.
constexpr int usual_cells = 48, fine_cells = 128;
constexpr double nothing = 1e-4;   // an optical thickness that nobody sees
constexpr double boundless = 1e6;  // the size of what has no end

double mean(const Three& c) { return (c[0] + c[1] + c[2]) / 3; }
double greatest(const Three& c) { return std::max({c[0], c[1], c[2]}); }

// g of Henyey and Greenstein's phase function; of Mie's, as bright as POV-Ray's from behind.
double asymmetry(const MediaBlock& media) {
  constexpr double hazy = 0.19, murky = 0.24;
  switch (media.scattering_type) {
    case 2:
      return hazy;
    case 3:
      return murky;
    case 5:
      return std::clamp(media.eccentricity, -0.99, 0.99);
    default:
      return 0;
  }
}

// Of all blocks: coefficients where each density is 1.
struct Sums {
  Three absorption{}, emission{}, scattering{}, extinction{};
  double g = 0;
};

Sums sums_of(const std::vector<Shared<MediaBlock>>& blocks, const Reader& reader) {
  Sums sums;
  double weights = 0;
  for (const Shared<MediaBlock>& block : blocks) {
    double scattered = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double s = reader.linear(block->scattering.v[i]);
      sums.absorption[i] += reader.linear(block->absorption.v[i]);
      sums.emission[i] += reader.linear(block->emission.v[i]);
      sums.scattering[i] += s;
      sums.extinction[i] += s * block->extinction;
      scattered += s;
    }
    sums.g += scattered * asymmetry(*block);
    weights += scattered;
  }
  if (weights > 0) sums.g /= weights;
  return sums;
}

// The densities of each block at points of the space that has the media.
class Densities {
 public:
  Densities(Reader& reader, const std::vector<Shared<MediaBlock>>& blocks) : reader_(reader) {
    for (const Shared<MediaBlock>& block : blocks) {
      blocks_.push_back(block.get());
      from_object_.push_back(inverse(block->to_object));
      fields_.emplace_back();
      for (const Shared<Pigment>& density : block->densities) fields_.back().emplace_back(reader, *density);
    }
  }
  Three at(std::size_t block, Point3d p) const {
    Three all{1, 1, 1};
    const Point3d q = transform_point(from_object_[block], p);
    for (const PatternField& field : fields_[block]) {
      const Numbers color = field.color(q);
      for (std::size_t i = 0; i < 3; ++i) all[i] *= std::max(reader_.linear(color.v[i]), 0.0);
    }
    return all;
  }
  // What shines at a point.
  Three emission(Point3d p) const {
    Three sum{};
    for (std::size_t k = 0; k < blocks_.size(); ++k) {
      const Three density = at(k, p);
      for (std::size_t i = 0; i < 3; ++i) sum[i] += density[i] * reader_.linear(blocks_[k]->emission.v[i]);
    }
    return sum;
  }
  // Of what is there where each density is 1, this share is.
  double share(Point3d p) const {
    double sum = 0, all = 0;
    for (std::size_t k = 0; k < blocks_.size(); ++k) {
      const MediaBlock& block = *blocks_[k];
      double weight = 0;
      for (std::size_t i = 0; i < 3; ++i)
        weight += block.absorption.v[i] + block.emission.v[i] + block.scattering.v[i];
      sum += weight * mean(at(k, p)), all += weight;
    }
    return all > 0 ? sum / all : 0;
  }

 private:
  Reader& reader_;
  std::vector<const MediaBlock*> blocks_;
  std::vector<Transform> from_object_;
  std::vector<std::vector<PatternField>> fields_;
};

// Of `channels` values that at(point) appends for the middle of each cell.
template <class AtPoint>
Grid sampled(const Bounds3d& box, int channels, int cells, const AtPoint& at) {
  Grid grid;
  grid.nx = grid.ny = grid.nz = cells;
  grid.channels = channels;
  grid.bounds = box;
  const auto side = static_cast<std::size_t>(cells);
  grid.values.reserve(side * side * side * static_cast<std::size_t>(channels));
  const Vector3d step = (box.upper - box.lower) * (1.0 / cells);
  for (int k = 0; k < cells; ++k)
    for (int j = 0; j < cells; ++j)
      for (int i = 0; i < cells; ++i)
        at(grid.values, box.lower + Vector3d{(i + 0.5) * step.x, (j + 0.5) * step.y, (k + 0.5) * step.z});
  return grid;
}

// The mean difference of neighbours over the mean value: of a ball that fades outwards 0.1, and 2 where each
// value stands alone, as those of shells do that are thinner than a cell.
double roughness(const Grid& grid) {
  double differences = 0, sum = 0;
  const auto step = static_cast<std::size_t>(grid.channels);
  for (std::size_t i = step; i < grid.values.size(); ++i) {
    const auto value = static_cast<double>(grid.values[i]);
    differences += std::abs(value - static_cast<double>(grid.values[i - step]));
    sum += std::abs(value);
  }
  return sum > 0 ? differences / sum : 0;
}

template <class AtPoint>
Grid densities_over(const Bounds3d& box, int channels, const AtPoint& at) {
  constexpr double rough = 0.5;
  Grid grid = sampled(box, channels, usual_cells, at);
  return roughness(grid) > rough ? sampled(box, channels, fine_cells, at) : grid;
}

// By default media around everything weaken no lamp (3.7.0.10). A parallel light is far away here.
struct WeakenedLamps {
  bool any = false, all = false;
};

WeakenedLamps weakened_lamps(const World& world) {
  WeakenedLamps lamps{false, true};
  for (const Placed& placed : world.objects)
    if (const auto* const light = std::get_if<LightShape>(&placed.object->shape)) {
      lamps.any = lamps.any || light->attenuated;
      lamps.all = lamps.all && light->attenuated && !light->parallel;
    }
  lamps.all = lamps.all && lamps.any;
  return lamps;
}

}  // namespace

std::optional<Id<Medium>> SceneMaker::medium_of(const std::vector<Shared<MediaBlock>>& blocks,
                                                const Transform& to_world, const Bounds3d& box) {
  const SourceLocation place = reader_.location(blocks.front()->place);
  Sums sums = sums_of(blocks, reader_);
  const bool shines = greatest(sums.emission) > 0, scatters = greatest(sums.scattering) > 0,
             fades = greatest(sums.absorption) > 0 || greatest(sums.extinction) > 0;
  if (!shines && !scatters && !fades) return std::nullopt;
  if (std::ranges::any_of(blocks, [](const auto& b) { return b->scattering_type == 4; }))
    reader_.notes.approximated("Rayleigh's scattering: alike in all directions", place);
  const bool bounded = !box.empty() && length(extent(box)) < boundless;
  const double size = bounded ? length(transform_vector(to_world, extent(box))) : reach_;
  const bool has_densities = std::ranges::any_of(blocks, [](const auto& b) { return !b->densities.empty(); });
  Medium medium;
  medium.name = "media";
  medium.origin = origin(blocks.front()->place);
  medium.medium_to_world = to_world;
  medium.g = static_cast<float>(sums.g);
  Three shown = sums.emission;
  if (has_densities && bounded) {
    const Densities densities(reader_, blocks);
    Grid grid;
    if (shines && !scatters && !fades) {
      grid = densities_over(box, 3, [&](std::vector<float>& values, Point3d p) {
        for (const double x : densities.emission(p)) values.push_back(static_cast<float>(x));
      });
      shown = {1, 1, 1};
    } else {
      grid = densities_over(box, 1, [&](std::vector<float>& values, Point3d p) {
        values.push_back(static_cast<float>(densities.share(p)));
      });
    }
    reader_.notes.approximated(fmt::format("densities of media: a grid of {} cells along each axis", grid.nx),
                               place);
    if (grid.channels == 3)
      medium.emission_scale = std::move(grid);
    else
      medium.density = std::move(grid);
  } else if (has_densities) {
    reader_.notes.dropped("densities of media that have no end", place);
  }
  for (double& a : sums.absorption) a = std::max(a, shines ? nothing / size : 0.0);
  const bool around = box.empty();
  const auto spectrum = [](const Three& c) { return unbounded_from_rgb({c[0], c[1], c[2]}); };
  const WeakenedLamps lamps = around ? weakened_lamps(world_) : WeakenedLamps{};
  medium.veils = around && !lamps.all;
  if (lamps.any && !lamps.all)
    reader_.notes.approximated("media_attenuation of some lights, or of parallel ones: media weaken no lamp",
                               place);
  if (around && !scatters) {
    medium.coefficients = AbsorptionScattering{spectrum(sums.absorption), Spectrum{ConstantSpectrum{0}}};
  } else {
    // Where it shines as well, σ_a has to be what POV-Ray's is; and paths scatter more than once. Else σ_t is
    // POV-Ray's, and what is scattered once is as bright.
    const bool dense = scatters && (shines || world_.radiosity);
    if (dense)
      reader_.notes.approximated(
          "scattering with emission or radiosity: four times as dense, to be as bright", place);
    Three extinction = sums.absorption, albedo{};
    for (std::size_t i = 0; i < 3; ++i) {
      extinction[i] += dense ? 4 * sums.scattering[i] : sums.extinction[i];
      extinction[i] = std::max(extinction[i], nothing / size);
      albedo[i] = 4 * sums.scattering[i] / extinction[i];
    }
    medium.coefficients = ExtinctionAlbedo{spectrum(extinction), spectrum(albedo)};
  }
  if (shines) {  // the record has the radiance of what is thick: e/σ_a
    for (std::size_t i = 0; i < 3; ++i) shown[i] /= sums.absorption[i];
    medium.emission = emission_from_rgb({shown[0], shown[1], shown[2]});
  }
  scene_.media.push_back(std::move(medium));
  return Id<Medium>{static_cast<std::uint32_t>(scene_.media.size() - 1)};
}

std::optional<Id<Medium>> SceneMaker::fade_of(const Object& object, const Interior& interior,
                                              const Transform& to_world) {
  if (!has_medium(interior)) return std::nullopt;
  constexpr double exponential = 1000;  // that power, and those above
  double way = interior.fade_distance;
  // Other formats have absorption alone.
  if (const Vector3d size = extent(extents_of(object)); interior.fade_power < exponential) {
    const double a = length(transform_vector(to_world, {size.x, 0, 0})),
                 b = length(transform_vector(to_world, {0, size.y, 0})),
                 c = length(transform_vector(to_world, {0, 0, size.z}));
    if (a + b + c < boundless) way = std::max(2 * a * b * c / (a * b + b * c + c * a), nothing * way);
    if (reader_.for_export)
      reader_.notes.approximated(
          "fade_power below 1000: absorption, as strong over the mean way through the object",
          reader_.location(interior.place));
  }
  const double ratio = way / interior.fade_distance;
  const double left = 1 / (1 + std::pow(ratio, std::min(interior.fade_power, exponential)));
  const auto color = [&](std::size_t i) {
    return std::clamp(reader_.linear(interior.fade_color.v[i]), 0.0, 1.0);
  };
  Three absorption{};
  for (std::size_t i = 0; i < 3; ++i) {
    absorption[i] = interior.fade_power >= exponential ? (1 - color(i)) / interior.fade_distance
                                                       : -std::log(color(i) + (1 - color(i)) * left) / way;
  }
  if (!(greatest(absorption) > 0)) return std::nullopt;
  Medium medium;
  medium.name = "fade";
  medium.origin = origin(interior.place);
  medium.coefficients =
      AbsorptionScattering{Spectrum{unbounded_from_rgb({absorption[0], absorption[1], absorption[2]})},
                           Spectrum{ConstantSpectrum{0}}};
  if (!reader_.for_export)
    medium.fade = {static_cast<float>(interior.fade_distance), static_cast<float>(interior.fade_power),
                   reflectance_from_rgb({color(0), color(1), color(2)})};
  scene_.media.push_back(std::move(medium));
  const Id<Medium> id{static_cast<std::uint32_t>(scene_.media.size() - 1)};
  if (is_inside(object, transform_point(inverse(to_world), eye()))) eye_medium_ = id;
  return id;
}

std::optional<Id<Medium>> SceneMaker::media_of(const Object& object, const Interior& interior,
                                               const Transform& to_world) {
  if (interior.media.empty()) return fade_of(object, interior, to_world);
  if (!object.hollow) {
    reader_.notes.approximated("media of an object without hollow: there are none",
                               reader_.location(interior.place));
    return std::nullopt;
  }
  const auto medium = medium_of(interior.media, to_world, extents_of(object));
  if (medium && is_inside(object, transform_point(inverse(to_world), eye()))) eye_medium_ = medium;
  return medium;
}

void SceneMaker::add_atmosphere() {
  if (world_.media.empty()) return;
  if (atmosphere_)
    return reader_.notes.dropped("media around everything, beside fog",
                                 reader_.location(world_.media.front()->place));
  atmosphere_ = medium_of(world_.media, {}, {});
}

namespace {

// Whether a point of its parent's space is in the object, and the object is not hollow.
bool keeps_out(const Object& object, Point3d p, bool hollow) {
  if (std::holds_alternative<LightShape>(object.shape) || !is_invertible(object.to_parent)) return false;
  hollow = hollow || object.hollow;
  const auto* const group = std::get_if<GroupShape>(&object.shape);
  if (!group || (group->kind != Word::union_ && group->kind != Word::light_group_) ||
      !object.clipped_by.empty())
    return !hollow && is_inside(object, p);
  const Point3d within = transform_point(inverse(object.to_parent), p);
  return std::ranges::any_of(object.children,
                             [&](const auto& child) { return keeps_out(*child, within, hollow); });
}

}  // namespace

void SceneMaker::set_eye_medium() {
  scene_.camera_medium = atmosphere_;
  const auto around_eye = [&](const Placed& placed) { return keeps_out(*placed.object, eye(), false); };
  if (atmosphere_ && std::ranges::any_of(world_.objects, around_eye)) scene_.camera_medium.reset();
  if (eye_medium_) scene_.camera_medium = eye_medium_;
}

}  // namespace vitrail::pov
