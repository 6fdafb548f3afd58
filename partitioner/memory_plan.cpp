// SPDX-License-Identifier: Apache-2.0
#include "partitioner/memory_plan.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "images/image_files.h"
#include "scene/system/diagnostics.h"
#include "scene/system/memory_guard.h"

namespace vitrail {

namespace {

constexpr double mib = 1 << 20;
constexpr double default_domain_bytes = 64 * mib;
constexpr std::uint32_t most_named_domains = 999'999;  // six digits in a file name
// A domain's share of triangles may be exceeded by this much (kd_plan.h), and some of them are cut.
constexpr double fullest = 1.3;

// Resident before there is a scene, with the pages of its code, and what reads images.
constexpr double program_bytes = 13 * mib;

// A piece in memory: its polygon, with the room that vectors keep, and twice where a leaf is gathered; and
// its line in the census.
constexpr double piece_bytes = 300;

// Of a reference to a quadric with its place in trees: in a domain file; in a cell that is divided; and while
// a domain is made.
constexpr double quadric_bytes = 170, quadric_held = 230, quadric_built = 400;

// While the tree of parts is planned: of each item of the sample (spill_scene.h).
constexpr double planning_bytes = 110, planning_bytes_of_attribute = 36, most_sampled = 1 << 18;

// Bytes a triangle: measured, docs/why/partitioning.md.
struct Costs {
  double placed, built;
  double alone;  // as built, of an object: it is not cut
};

Costs costs_of(const Manifest& m) {
  const double normals = m.requirements.shading_normals, uvs = m.requirements.uv, attributes = m.attributes;
  return {48 + 12 * normals + 24 * uvs + 36 * attributes,  // id, vertices, index in its leaf
          230 + 16 * normals + 32 * uvs + 48 * attributes, 180 + 16 * normals + 32 * uvs + 48 * attributes};
}

}  // namespace

std::uint32_t number_of_domains(const Manifest& m, const MemoryNeeds& needs) {
  double domains = needs.domains;
  if (needs.domains == 0) {
    const double bytes =
        needs.domain_bytes
            ? static_cast<double>(needs.domain_bytes)
            : std::max(1.0, std::min(default_domain_bytes, static_cast<double>(needs.budget_bytes) / 32));
    const double all = static_cast<double>(needs.triangles) * bytes_of_a_triangle(m) +
                       static_cast<double>(needs.instance_bytes) +
                       quadric_bytes * static_cast<double>(needs.quadrics);
    domains = std::max(1.0, std::ceil(all / bytes));
  }
  if (domains > most_named_domains)
    throw UsageError(
        fmt::format("{:.0f} domains are asked for; the most is {}", domains, most_named_domains));
  return static_cast<std::uint32_t>(domains);
}

double bytes_of_a_triangle(const Manifest& m) {
  return 62 + 16.0 * m.requirements.shading_normals + 32.0 * m.requirements.uv + 48.0 * m.attributes;
}

std::uint64_t meshes_within(std::uint64_t budget_bytes) { return budget_bytes / 8; }

double bytes_left(const MemoryNeeds& needs) {
  const double program = program_bytes + (needs.image_library ? static_cast<double>(image_library_bytes) : 0);
  const std::uint64_t meshes =
      std::max(needs.held_meshes, std::min(needs.mesh_bytes, meshes_within(needs.budget_bytes)));
  const std::uint64_t held =
      needs.scene_bytes + meshes + needs.instance_bytes + memory_reserve(needs.budget_bytes);
  const double census = static_cast<double>(needs.triangles) / 4;
  return static_cast<double>(needs.budget_bytes) - static_cast<double>(held) - program - census;
}

double bytes_to_build(const Manifest& m, double triangles, double built) {
  const Costs costs = costs_of(m);
  return costs.placed * triangles + costs.alone * built;
}

namespace {

// What a number of domains takes.
struct DomainNeeds {
  double triangles = 0;    // of the largest, and pieces
  double pieces_each = 0;  // of them
  double in_cell = 0, build = 0;
};

DomainNeeds needs_of_domain(const Manifest& m, const MemoryNeeds& needs, std::uint32_t domains) {
  const Costs costs = costs_of(m);
  const auto triangles = static_cast<double>(needs.triangles);
  const double items = triangles * needs.expansion;
  // Triangles and pieces: most of what a plane has cut is twice where it was once.
  const double domain = domains == 1 ? triangles : fullest * items / domains;
  const double pieces_each = items > 0 ? std::min(1.0, 2 * (items - triangles) / items) : 0;
  const double held = costs.placed + piece_bytes * pieces_each;  // an item of a cell that is divided
  const auto quadrics = static_cast<double>(needs.quadrics);
  const double quadrics_of_domain = domains == 1 ? quadrics : fullest * quadrics / domains;
  return {domain, pieces_each, held * domain + quadric_held * quadrics_of_domain,
          costs.built * domain + quadric_built * quadrics_of_domain};
}

// What there is too little memory for; empty where it is enough.
std::string lack_of(const Manifest& m, const MemoryNeeds& needs) {
  const double left = bytes_left(needs);
  if (left < static_cast<double>(needs.baking_bytes))
    return needs.image_library ? "the scene and what reads its images" : "the scene";
  if (left < needs.object_bytes) return "the largest object that has instances";
  const DomainNeeds domain = needs_of_domain(m, needs, number_of_domains(m, needs));
  if (left < domain.in_cell + domain.build)
    return fmt::format(
        "domains of {:.0f} triangles and pieces{}", domain.triangles,
        needs.domains || needs.domain_bytes ? "; without --domains and --domain-bytes they are smaller" : "");
  const auto quadrics = static_cast<double>(needs.quadrics);
  const double triangles = static_cast<double>(needs.triangles) * needs.expansion;
  const double all =
      (costs_of(m).placed + piece_bytes * domain.pieces_each) * triangles + quadric_held * quadrics;
  const bool in_parts = all + needs.threads * domain.build > left * needs.share;
  const double planning = planning_bytes + planning_bytes_of_attribute * m.attributes;
  if (in_parts && left < planning * std::min(triangles + quadrics, most_sampled)) return "planning";
  // With its vertices placed, and with the blocks on their way to disk.
  if (const auto mesh = static_cast<double>(needs.largest_mesh); 1.6 * mesh > left * 3 / 4)
    return fmt::format("a mesh of {:.0f} MiB", mesh / mib);
  return {};
}

}  // namespace

std::uint64_t least_budget(const Manifest& m, MemoryNeeds needs) {
  constexpr std::uint64_t step = 1 << 20, most = std::uint64_t{1} << 46;
  const auto is_enough = [&](std::uint64_t steps) {
    needs.budget_bytes = steps * step;
    return needs.budget_bytes >= most || lack_of(m, needs).empty();
  };
  std::uint64_t too_little = needs.budget_bytes / step, enough = too_little + 1;
  if (is_enough(too_little)) return too_little * step;
  while (!is_enough(enough)) too_little = enough, enough *= 2;
  while (enough - too_little > 1) {
    const std::uint64_t middle = (too_little + enough) / 2;
    (is_enough(middle) ? enough : too_little) = middle;
  }
  return enough * step + enough * step / 24;  // runs differ a little
}

std::uint64_t budget_to_hold(std::uint64_t bytes, std::uint64_t budget_bytes) {
  const std::uint64_t held = bytes + static_cast<std::uint64_t>(program_bytes);
  const std::uint64_t budget = held + held / 24;
  return std::max(budget + memory_reserve(budget), budget_bytes + (1 << 20));
}

PartitionMemory plan_memory(const Manifest& m, const MemoryNeeds& needs) {
  if (const std::string lack = lack_of(m, needs); !lack.empty())
    throw MemoryNeeded(needs.budget_bytes, least_budget(m, needs), lack);
  const Costs costs = costs_of(m);
  PartitionMemory plan;
  plan.domains = number_of_domains(m, needs);
  const auto triangles = static_cast<double>(needs.triangles), quadrics = static_cast<double>(needs.quadrics);
  const double items = triangles * needs.expansion, left = bytes_left(needs);
  const auto [domain, pieces_each, in_cell, build] = needs_of_domain(m, needs, plan.domains);
  // All at once, or half of what is left for a bucket's triangles.
  const double threads = std::min<double>(needs.threads, plan.domains);
  const double all = costs.placed * triangles + piece_bytes * pieces_each * items + quadric_held * quadrics;
  const double shared = left * needs.share;
  const bool all_fit = all + threads * build <= shared || plan.domains == 1;
  const double bucket = all_fit ? plan.domains : std::floor(shared / 2 / in_cell);
  plan.domains_at_once = static_cast<std::uint32_t>(std::clamp<double>(bucket, 1, plan.domains));
  const double placed = all_fit ? all : in_cell * plan.domains_at_once;
  plan.domains_in_work = static_cast<std::uint32_t>(
      std::clamp<double>(build > 0 ? (shared - placed) / build : threads, 1, threads));
  plan.load_bytes = static_cast<std::uint64_t>(all_fit ? std::max(shared - placed, shared / 8) : shared / 2);
  plan.spill_bytes = static_cast<std::uint64_t>(shared / 4);
  plan.kept_bytes = std::clamp<std::uint64_t>(needs.budget_bytes / 64, 1 << 20, 32 << 20);
  return plan;
}

}  // namespace vitrail
