// SPDX-License-Identifier: Apache-2.0
#include "tracer/transport/waves/lane_lists.h"

#include <algorithm>
#include <new>
#include <type_traits>

#include "tracer/transport/connect.h"
#include "tracer/transport/first_surface.h"

namespace vitrail {

namespace {

// Behind so many events mirrors and glass let go of paths by chance.
constexpr std::uint32_t most_events = 250;

std::uint32_t index_of(const Tracing& tracing, const Material& material) {
  return static_cast<std::uint32_t>(&material - tracing.manifest().materials.data());
}

PlacedHit placed_hit(const Materials& materials, const Material& material, const LaneMaterial& of,
                     const Interaction& at) {
  const Vector3d shading =
      of.is_tilted ? materials.shading_normal(material, at, of.is_diffuse()) : at.shading;
  const Vector3d along = of.is_tilted ? materials.tangent(material, at) : at.dpdu;
  return {at.p, at.geometric, shading, along, at.rounding, at.uv};
}

// Where a path has hit a triangle of a domain itself.
Point3d hit_point(const DomainView& domain, const Hit& hit) {
  const Cluster& cluster = domain.clusters[hit.cluster];
  const auto corner = [&](std::size_t k) {
    const auto& v = cluster.vertex[k];
    return cast<double>(Point3f{v[0][hit.lane], v[1][hit.lane], v[2][hit.lane]});
  };
  const Point3d p0 = corner(0);
  return p0 + (corner(1) - p0) * hit.u + (corner(2) - p0) * hit.v;
}

// Made in place, as a copy costs much, and not inlined: most paths have hit a triangle of a domain itself.
static_assert(std::is_trivially_destructible_v<Interaction>);
[[gnu::noinline]] const Interaction* find(const Tracing& tracing, const CameraPath& path, Interaction& at) {
  return new (&at) Interaction(interaction_at(tracing, path, cone_of(tracing, path, sample_of(path))));
}

}  // namespace

LaneLists::LaneLists(std::size_t most)
    : surface_(most), material_(most), next_(most), bsdfs_(most), coatings_(most), placed_(most) {
  for (auto& kind : lists_)
    for (auto& placing : kind)
      for (auto& list : placing) list.reserve(most);
  for (auto& list : in_media_) list.reserve(most);
  leaving_.reserve(most);
}

bool LaneLists::apply_to(const Tracing& tracing) { return tracing.stages && !tracing.photons; }

std::uint32_t LaneLists::candidates_of(const Tracing& tracing, const CameraPath& path, std::uint32_t place,
                                       bool is_placed, const LaneMaterial& of) const {
  if (path.pdf > 0) return 1;
  const Point3d p = is_placed ? placed_[place].p : hit_point(*tracing.resident[path.hit_domain], path.hit);
  return light_candidates(tracing, path, p, of.is_diffuse());
}

bool LaneLists::take_leaving(Tracing& tracing, CameraPath& path, std::uint32_t place) {
  const LightSampler& lights = tracing.scene.lights;
  if (!lights.has_background() || (lights.has_discs() && !path.connected)) return false;
  if (is_hidden(tracing, path) || is_past_last_level(tracing, path)) return false;
  record_leaving(tracing, path);
  find_wavelengths(tracing, path, path.film);
  leaving_.push_back(place);
  ++taken_;
  return true;
}

bool LaneLists::take_in_medium(Tracing& tracing, CameraPath& path, std::uint32_t place,
                               const Arrived& arrived) {
  if (path.unrecorded) [[unlikely]]
    record_first_medium(tracing, path);
  path.pane = {};
  placed_[place].p = arrived.p;
  bsdfs_[place].g = arrived.scatters_in->g;
  in_media_[light_candidates(tracing, path, arrived.p, true) > 1].push_back(place);
  ++taken_;
  return true;
}

void LaneLists::enlist(const Tracing& tracing, const CameraPath& path, std::uint32_t place,
                       const LaneMaterial& of, const Interaction* at, bool is_placed) {
  const Materials& materials = tracing.scene.materials;
  const Material& material = tracing.manifest().materials[material_[place]];
  is_placed = is_placed || of.is_tilted;
  if (is_placed) placed_[place] = placed_hit(materials, material, of, *at);
  if (of.has_parameters) {
    const TexturePoint point = of.is_textured ? at->texture_point() : TexturePoint{};
    const Bsdf bsdf = materials.bsdf_at(material, point, path.wavelengths);
    bsdfs_[place] = lane_bsdf(bsdf);
    if (of.is_coated()) coatings_[place] = lane_coating(bsdf, stream_of(path, RayRandom::layers));
  }
  if (domains_.size() < tracing.resident.size()) domains_.resize(tracing.resident.size());
  domains_[path.hit_domain] = lanes::tables_of(*tracing.resident[path.hit_domain]);
  const std::uint32_t candidates = of.is_specular() ? 1 : candidates_of(tracing, path, place, is_placed, of);
  lists_[static_cast<std::size_t>(of.kind)][is_placed][candidates > 1].push_back(place);
}

bool LaneLists::take(Tracing& tracing, CameraPath& path, std::uint32_t place, const Arrived& arrived) {
  if (!arrived.has_flown && is_too_dark(tracing, path)) return false;
  if (path.pane.within && (path.pane.parts || path.pane.owes)) return false;
  if (!arrived.scatters_in && !path.meets_surface()) return take_leaving(tracing, path, place);
  if (is_spent(tracing, path) || path.depth >= most_events) return false;
  if (arrived.scatters_in) return take_in_medium(tracing, path, place, arrived);
  const Surface& surface = surface_at(tracing, path);
  const auto index = static_cast<std::uint32_t>(&surface - tracing.manifest().surfaces.data());
  const LaneSurface& on = tracing.scene.lanes.surfaces[index];
  if (!on.is_for_lanes || (on.emits && is_hidden(tracing, path))) return false;

  const Interaction* at = nullptr;
  const LaneMaterial* const materials = tracing.scene.lanes.materials.data();
  std::uint32_t chosen = surface.material;
  const LaneMaterial* of = materials + chosen;
  if (on.is_chosen) {
    at = find(tracing, path, interaction_);
    const Material* const material = chosen_at(tracing, path, surface, *at);
    if (material) chosen = index_of(tracing, *material);
    of = material ? materials + chosen : nullptr;
    if (of && (of->kind == LaneKind::none || of->kind == LaneKind::glass)) return false;
  }

  find_wavelengths(tracing, path, path.film);
  if (!of || of->kind != LaneKind::glass) path.pane = {};
  if (!at && (path.hit.depth > 0 || of->is_tilted || of->is_textured || on.emits || path.unrecorded))
    at = find(tracing, path, interaction_);
  widen_cone(tracing, path, sample_of(path), path.hit.t);
  if (on.emits) add_emission(tracing, path, *at, static_cast<std::uint32_t>(surface.area_light));
  if (path.unrecorded) [[unlikely]]
    record_first_surface(tracing, path, {surface, tracing.scene.materials.kind(surface.material), *at, true});
  ++taken_;
  if (of) {
    surface_[place] = index;
    material_[place] = chosen;
    enlist(tracing, path, place, *of, at, path.hit.depth > 0 || on.is_chosen);
  } else {
    pass_nothing(tracing, path, surface, *at);
    passing_.push_back(place);
  }
  return true;
}

// So that paths side by side look up one image.
void LaneLists::sort_by_texture(const LaneScene& scene) {
  if (!scene.has_textures) return;
  const auto texture = [&](std::uint32_t place) { return scene.materials[material_[place]].texture.id; };
  for (auto& placing : lists_[static_cast<std::size_t>(LaneKind::diffuse)])
    for (auto& list : placing) std::ranges::sort(list, {}, texture);
}

void LaneLists::run(Tracing& tracing, CameraPath* paths, ShadowRays& shadows,
                    std::vector<std::uint32_t>& live) {
  if (taken_ == 0) return;
  const Roulette roulette = tracing.scene.sampling.roulette;
  const bool has_roulette = roulette != Roulette::never && !tracing.settings().direct_only;
  LaneWork work{.tracing = tracing,
                .scene = tracing.scene.lanes,
                .paths = paths,
                .surface = surface_.data(),
                .material = material_.data(),
                .bsdfs = bsdfs_.data(),
                .coatings = coatings_.data(),
                .placed = placed_.data(),
                .domains = domains_.data(),
                .roulette_worth = has_roulette ? worth_going_on(roulette) : 0,
                .direct_only = tracing.settings().direct_only,
                .ends_lit = ends_lit(tracing),
                .groups_lights = tracing.scene.groups.kept_apart,
                .rounding_of_doubles = rounding_of_doubles(tracing.manifest().scale),
                .shadows = shadows,
                .next = next_.data()};
  sort_by_texture(tracing.scene.lanes);
  if (!leaving_.empty()) tracing.stages->leave_scene(work, {leaving_.data(), leaving_.size(), false, 0});
  leaving_.clear();
  for (const bool several : {false, true}) {
    std::vector<std::uint32_t>& places = in_media_[several];
    if (!places.empty())
      tracing.stages->scatter_in_media(
          work, {places.data(), places.size(), true, several ? tracing.scene.sampling.light_candidates : 1});
    places.clear();
  }
  for (std::size_t kind = 0; kind < lane_kinds; ++kind)
    for (const bool is_placed : {false, true})
      for (const bool several : {false, true}) {
        std::vector<std::uint32_t>& places = lists_[kind][is_placed][several];
        if (places.empty()) continue;
        tracing.stages->stage[kind](work, {places.data(), places.size(), is_placed,
                                           several ? tracing.scene.sampling.light_candidates : 1});
        places.clear();
      }
  tracing.counters.rays_shadow += work.rays_shadow;
  live.insert(live.end(), passing_.begin(), passing_.end());
  const std::size_t going_on = work.next_count + passing_.size();
  passing_.clear();
  tracing.counters.rays_indirect += going_on;
  tracing.counters.died += taken_ - going_on;
  live.insert(live.end(), next_.begin(), next_.begin() + static_cast<std::ptrdiff_t>(work.next_count));
  taken_ = 0;
}

}  // namespace vitrail
