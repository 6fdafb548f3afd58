// SPDX-License-Identifier: Apache-2.0
#include "bundle/held_ids.h"

#include <fmt/format.h>

#include <algorithm>

#include "bundle/triangle_number.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

// Calls visit(first, object) for each of the instances once, which is held with all parts of its prototype.
void for_each_whole(const Manifest& m, std::vector<HeldInstance> instances, const auto& visit) {
  std::ranges::sort(instances);
  instances.erase(std::unique(instances.begin(), instances.end()), instances.end());
  for (std::size_t i = 0; i < instances.size();) {
    const auto [place, first, object] = instances[i];
    if (object >= m.objects.size()) throw Error("it has instances of objects that are not there");
    if (object > 0 && end_of_prototype(m, object - 1) > object)
      throw Error(fmt::format("it has an instance of object {} without the parts before it", object));
    for (std::uint32_t part = object; part < end_of_prototype(m, object); ++part, ++i)
      if (i == instances.size() || instances[i] != HeldInstance{place, first, part})
        throw Error(
            fmt::format("it has an instance of object {}, but not of its other part {}", object, part));
    visit(first, m.objects[object]);
  }
}

// The ids of instances, ascending.
std::vector<IdRange> ids_of(const Manifest& m, std::uint64_t triangles, std::vector<HeldInstance> instances) {
  constexpr const char* wrong = "its instances share triangles, or have some that it does not have";
  std::vector<IdRange> ranges;
  std::uint64_t sum = 0;
  for_each_whole(m, std::move(instances), [&](std::uint32_t first, const ObjectInfo& object) {
    sum += object.triangles;
    if (sum > triangles) throw Error(wrong);
    if (triangles <= triangle_numbers) ranges.push_back({first, object.triangles});
  });
  if (triangles > triangle_numbers) return {{triangles - sum, sum}};
  std::ranges::sort(ranges, {}, &IdRange::first);
  std::uint64_t end = 0;
  for (const IdRange& range : ranges) {
    if (range.first < end || range.first + range.count > triangles) throw Error(wrong);
    end = range.first + range.count;
  }
  return ranges;
}

bool holds(const Bounds3f& box, const Bounds3f& other) {
  for (int axis = 0; axis < 3 && !other.empty(); ++axis)
    if (!(box.lower[axis] <= other.lower[axis] && other.upper[axis] <= box.upper[axis])) return false;
  return true;
}

}  // namespace

HeldIds::HeldIds(std::string name, const Manifest& manifest, std::uint64_t triangles,
                 std::uint64_t cut_triangles, std::vector<HeldInstance> instances)
    : name_(std::move(name)), cut_triangles_(cut_triangles) {
  try {
    census_.emplace(triangles, ids_of(manifest, triangles, std::move(instances)));
  } catch (const Error& e) {
    instances_problem_ = e.what();
  }
}

void HeldIds::count(std::uint32_t part, const MappedDomain& mapped) {
  if (census_) {
    const auto [pieces, piece_vertices] = mapped.pieces();
    census_->add(part, mapped.view(), pieces, piece_vertices);
  }
  ++counted_;
}

std::vector<std::string> HeldIds::problems() const {
  if (counted_ != parts_) return {};
  if (!instances_problem_.empty()) return {instances_problem_};
  if (!census_) return {};
  const CensusResult r = census_->result();
  std::vector<std::string> found;
  if (r.duplicates > 0)
    found.push_back(fmt::format("{} triangles or pieces are stored more than once", r.duplicates));
  if (r.lost > 0) found.push_back(fmt::format("{} triangles are in none of the files", r.lost));
  if (r.strays > 0)
    found.push_back(fmt::format("{} triangles or pieces are where they should not be", r.strays));
  if (r.cut_triangles != cut_triangles_)
    found.push_back(fmt::format("{} triangles are cut, and {} should be", r.cut_triangles, cut_triangles_));
  if (!(r.area_error < most_area_error))
    found.push_back(
        fmt::format("pieces do not tile their triangle: their areas differ by {:.3g} of it", r.area_error));
  return found;
}

std::uint32_t end_of_prototype(const Manifest& m, std::uint32_t first) {
  const auto surfaces = [&](std::uint32_t i) {
    return std::pair(m.objects[i].first_surface, m.objects[i].surface_count);
  };
  std::uint32_t end = first + 1;
  const bool has_own = surfaces(first).second > 0;
  while (end < m.objects.size() &&
         (m.objects[end].continues || (has_own && surfaces(end) == surfaces(first))))
    ++end;
  return end;
}

void check_counts(const Manifest& manifest, std::uint32_t domain, const MappedDomain& mapped,
                  const std::filesystem::path& file) {
  const DomainInfo& info = manifest.domains[domain];
  const DomainView& view = mapped.view();
  const auto [pieces, piece_vertices] = mapped.pieces();
  if (info.triangles != triangles_in(view.clusters) || info.pieces != pieces.size() ||
      info.instances != view.instances.size())
    throw Error("it does not hold as many triangles as the manifest says", {file.string()});
  if (!holds(info.tight_bounds, content_bounds(view)))
    throw Error("it reaches beyond the tight bounds that the manifest has for it", {file.string()});
  const Occupancy held = occupancy_of(info.tight_bounds, view, pieces, piece_vertices, cell_margin(manifest));
  for (std::size_t z = 0; z < held.slice.size(); ++z)
    if (held.slice[z] & ~info.occupancy.slice[z])
      throw Error("it holds something where the manifest says it is empty", {file.string()});
}

}  // namespace vitrail
