// SPDX-License-Identifier: Apache-2.0
#include "partitioner/memory_plan.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "scene/diagnostics.h"

namespace vitrail {

namespace {

constexpr double mib = 1 << 20;
constexpr double default_domain_bytes = 64 * mib;
constexpr std::uint32_t most_domains = 999'999;  // six digits in a file name
// A domain's share of triangles may be exceeded by this much (kd_plan.h), and some of them are cut.
constexpr double fullest = 1.3;

// Resident before there is a scene, and what reads images.
constexpr double program_bytes = 12 * mib, image_library_bytes = 132 * mib;

// Bytes a triangle: measured, docs/partitioning.md.
struct Costs {
  double on_disk, placed, built;
};

Costs costs_of(const Manifest& m) {
  const double normals = m.requirements.shading_normals, uvs = m.requirements.uv, attributes = m.attributes;
  return {bytes_of_a_triangle(m),
          48 + 12 * normals + 24 * uvs + 36 * attributes,  // id, vertices, index in its leaf
          230 + 16 * normals + 32 * uvs + 48 * attributes};
}

std::uint32_t number_of_domains(const MemoryNeeds& needs, const Costs& costs) {
  double domains = needs.domains;
  if (needs.domains == 0) {
    const double bytes =
        needs.domain_bytes
            ? static_cast<double>(needs.domain_bytes)
            : std::max(1.0, std::min(default_domain_bytes, static_cast<double>(needs.budget_bytes) / 32));
    const double all =
        static_cast<double>(needs.triangles) * costs.on_disk + static_cast<double>(needs.instance_bytes);
    domains = std::max(1.0, std::ceil(all / bytes));
  }
  if (domains > most_domains)
    throw UsageError(fmt::format("{:.0f} domains are asked for; the most is {}", domains, most_domains));
  return static_cast<std::uint32_t>(domains);
}

}  // namespace

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
  plan.domains = number_of_domains(needs, costs);
  const auto triangles = static_cast<double>(needs.triangles);
  const double left = bytes_left(needs);
  const double domain = plan.domains == 1 ? triangles : fullest * triangles / plan.domains;  // triangles
  const double build = costs.built * domain;
  const double least = bytes_to_build(m, domain, domain);
  if (triangles > 0 && left < least)
    throw MachineError(fmt::format(
        "{:.0f} MiB of memory are too little for domains of {:.0f} triangles: {:.0f} MiB is needed, or more "
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
  const bool all_fit = costs.placed * triangles + threads * build <= left || plan.domains == 1;
  const double bucket = all_fit ? plan.domains : std::floor(left / 2 / (costs.placed * domain));
  plan.domains_at_once = static_cast<std::uint32_t>(std::clamp<double>(bucket, 1, plan.domains));
  const double placed = all_fit ? costs.placed * triangles : costs.placed * domain * plan.domains_at_once;
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
