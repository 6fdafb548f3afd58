// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "bundle/manifest.h"
#include "bundle/verify.h"
#include "cli/common/bundle_origin.h"
#include "cli/common/switching_glazing.h"
#include "cli/inspect/inspect.h"
#include "glazing/kept_system.h"

namespace vitrail {

namespace {

Report domain_line(std::uint32_t index, const DomainInfo& d) {
  const Vector3f size = extent(d.tight_bounds);
  Report line{{"domain", index},
              {"triangles", d.triangles},
              {"pieces", d.pieces},
              {"bytes", d.bytes},
              {"extent", {size.x, size.y, size.z}}};
  if (d.pack) line["pack"] = d.pack->pack, line["offset"] = d.pack->offset;
  return line;
}

// Glass that can be set.
Report describe_glazing(const std::filesystem::path& bundle, const Manifest& m) {
  Report table = Report::array();
  for (const KeptGlazing& g : read_glazings(bundle, m)) {
    const GlazingSystem system = kept_system(g.system, glazing_path(bundle).string());
    table.push_back({{"name", g.name},
                     {"system", system.name.empty() ? Report(nullptr) : Report(system.name)},
                     {"panes", system.layers.size()},
                     {"set", describe_setting(system)},
                     {"can_be_set", names_of_quantities(system)}});
  }
  return table;
}

}  // namespace

Report inspect_bundle(const std::filesystem::path& bundle) {
  const Manifest m = read_manifest(bundle);
  const VerifyResult found = verify_bundle(bundle);
  Report r{{"file", bundle.string()}, {"kind", "bundle"}, {"bytes", found.bytes}};
  r["summary"] = summary_of(m, found.bytes);
  const BundleOrigin origin = read_bundle_origin(bundle);
  if (!origin.scene.empty()) {
    r["made_of"] = origin.scene;
    r["made_by"] = origin.program;
    r["made_with"] = origin.options;
  }
  r["made_at"] = time_of(bundle / "manifest.json");
  r.update(describe(m));
  if (Report glazing = describe_glazing(bundle, m); !glazing.empty()) r["glazing"] = std::move(glazing);
  Report problems = Report::array();
  for (const VerifyFinding& p : found.problems) problems.push_back(p.file + ": " + p.what);
  if (problems.empty())
    r["checksums"] = "all correct";
  else
    r["problems"] = std::move(problems);
  if (found.census) {
    r["ghost_free"] = found.census->ghost_free();
    r["cut_triangles"] = found.census->cut_triangles;
    r["pieces"] = found.census->pieces;
    r["duplicates"] = found.census->duplicates;
    r["lost"] = found.census->lost;
    r["area_error"] = found.census->area_error;
  }
  r["domains"] = Report::array();
  for (std::uint32_t i = 0; i < m.domains.size(); ++i) r["domains"].push_back(domain_line(i, m.domains[i]));
  return r;
}

}  // namespace vitrail
