// SPDX-License-Identifier: Apache-2.0
#include "partitioner/memory_plan.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

constexpr double mib = 1 << 20;
constexpr double default_domain_bytes = 64 * mib;
constexpr std::uint32_t most_domains = 999'999;  // six digits in a file name
// A domain's share of triangles may be exceeded by this much (kd_plan.h), and some of them are cut.
constexpr double fullest = 1.3;

// Resident before there is a scene, and what reads images.
constexpr double program_bytes = 12 * mib, image_library_bytes = 132 * mib;

// A piece in memory: its polygon, with the room that vectors keep, and twice where a leaf is gathered; and
// its line in the census.
constexpr double piece_bytes = 300;

// Of a reference to a quadric with its place in trees: in a domain file; in a cell that is divided; and while
// a domain is made.
constexpr double quadric_bytes = 170, quadric_held = 230, quadric_built = 400;

// Bytes a triangle: measured, docs/why/partitioning.md.
struct Costs {
  double placed, built;
};

Costs costs_of(const Manifest& m) {
  const double normals = m.requirements.shading_normals, uvs = m.requirements.uv, attributes = m.attributes;
  return {48 + 12 * normals + 24 * uvs + 36 * attributes,  // id, vertices, index in its leaf
          230 + 16 * normals + 32 * uvs + 48 * attributes};
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
  if (domains > most_domains)
    throw UsageError(fmt::format("{:.0f} domains are asked for; the most is {}", domains, most_domains));
  return static_cast<std::uint32_t>(domains);
}

double bytes_of_a_triangle(const Manifest& m) {
  return 62 + 16.0 * m.requirements.shading_normals + 32.0 * m.requirements.uv + 48.0 * m.attributes;
}

double bytes_left(const MemoryNeeds& needs) {
  const double program = program_bytes + (needs.image_library ? image_library_bytes : 0);
  const double fixed = program + static_cast<double>(needs.triangles) / 4;  // and the census
  return static_cast<double>(needs.budget_bytes) - static_cast<double>(needs.scene_bytes) -
         static_cast<double>(needs.instance_bytes) - fixed;
}

double bytes_to_build(const Manifest& m, double triangles, double built) {
  const Costs costs = costs_of(m);
  return costs.placed * triangles + costs.built * built;
}

MemoryPlan plan_memory(const Manifest& m, const MemoryNeeds& needs) {
  const Costs costs = costs_of(m);
  MemoryPlan plan;
  plan.domains = number_of_domains(m, needs);
  const auto triangles = static_cast<double>(needs.triangles);
  const double left = bytes_left(needs);
  const double items = triangles * needs.expansion;
  // Triangles and pieces: most of what a plane has cut is twice where it was once.
  const double domain = plan.domains == 1 ? triangles : fullest * items / plan.domains;
  const double pieces_each = items > 0 ? std::min(1.0, 2 * (items - triangles) / items) : 0;
  const double held = costs.placed + piece_bytes * pieces_each;  // an item of a cell that is divided
  const auto quadrics = static_cast<double>(needs.quadrics);
  const double quadrics_of_domain = plan.domains == 1 ? quadrics : fullest * quadrics / plan.domains;
  const double in_cell = held * domain + quadric_held * quadrics_of_domain;
  const double build = costs.built * domain + quadric_built * quadrics_of_domain;
  const double least = in_cell + build;
  if (triangles + quadrics > 0 && left < least)
    throw MachineError(
        fmt::format("{:.0f} MiB of memory are too little for domains of {:.0f} triangles and pieces: {:.0f} "
                    "MiB is needed, or more "
                    "and smaller domains (--domains, --domain-bytes)",
                    static_cast<double>(needs.budget_bytes) / mib, domain,
                    (static_cast<double>(needs.budget_bytes) - left + least) / mib + 1));
  // With its vertices placed, and with the blocks on their way to disk.
  const double mesh = static_cast<double>(needs.largest_mesh) * 1.5;
  if (mesh > left * 3 / 4)
    throw MachineError(
        fmt::format("{:.0f} MiB of memory are too little for a mesh of {:.0f} MiB: {:.0f} MiB is needed, or "
                    "the mesh split "
                    "into several files",
                    static_cast<double>(needs.budget_bytes) / mib, mesh / 1.5 / mib,
                    (static_cast<double>(needs.budget_bytes) - left + mesh * 4 / 3) / mib + 1));
  // All at once, or half of what is left for a bucket's triangles.
  const double threads = std::min<double>(needs.threads, plan.domains);
  const double all = costs.placed * triangles + piece_bytes * pieces_each * items + quadric_held * quadrics;
  const bool all_fit = all + threads * build <= left || plan.domains == 1;
  const double bucket = all_fit ? plan.domains : std::floor(left / 2 / in_cell);
  plan.domains_at_once = static_cast<std::uint32_t>(std::clamp<double>(bucket, 1, plan.domains));
  const double placed = all_fit ? all : in_cell * plan.domains_at_once;
  plan.domains_in_work = static_cast<std::uint32_t>(
      std::clamp<double>(build > 0 ? (left - placed) / build : threads, 1, threads));
  plan.load_bytes = static_cast<std::uint64_t>(all_fit ? std::max(left - placed, left / 8) : left / 2);
  plan.spill_bytes = static_cast<std::uint64_t>(left / 4);
  plan.kept_bytes = std::clamp<std::uint64_t>(needs.budget_bytes / 64, 1 << 20, 32 << 20);
  return plan;
}

std::uint64_t machine_bytes() {
  return static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) *
         static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

}  // namespace vitrail
