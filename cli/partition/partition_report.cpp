// SPDX-License-Identifier: Apache-2.0
#include "cli/partition/partition_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cli/common/sizes.h"
#include "scene/system/atomic_file.h"
#include "scene/system/say.h"

namespace vitrail {

void write_stats(const std::filesystem::path& file, const PartitionStats& s) {
  const nlohmann::ordered_json json{{"program", "vitrail partition"},
                                    {"input_triangles", s.input_triangles},
                                    {"cut_triangles", s.cut_triangles},
                                    {"pieces", s.pieces},
                                    {"domains", s.domains},
                                    {"domains_planned", s.domains_planned},
                                    {"triangles_min", s.triangles_min},
                                    {"triangles_mean", s.triangles_mean},
                                    {"triangles_max", s.triangles_max},
                                    {"bundle_bytes", s.bundle_bytes},
                                    {"duplicates", s.duplicates},
                                    {"area_error", s.area_error},
                                    {"quadrics", s.quadrics},
                                    {"objects", s.objects},
                                    {"instances", s.instances},
                                    {"domain_bytes_max", s.domain_bytes_max},
                                    {"wall_s", s.wall_s},
                                    {"cpu_s", s.cpu_s},
                                    {"peak_rss_bytes", s.peak_rss_bytes},
                                    {"memory_budget_bytes", s.memory_budget_bytes},
                                    {"ledger_meshes_bytes", s.ledger.meshes},
                                    {"ledger_shapes_bytes", s.ledger.shapes},
                                    {"ledger_instances_bytes", s.ledger.instances},
                                    {"ledger_prototypes_bytes", s.ledger.prototypes},
                                    {"ledger_materials_bytes", s.ledger.materials},
                                    {"ledger_textures_bytes", s.ledger.textures},
                                    {"ledger_lights_bytes", s.ledger.lights},
                                    {"ledger_media_bytes", s.ledger.media},
                                    {"buckets", s.buckets},
                                    {"spill_bytes", s.spill_bytes},
                                    {"triangles_per_s", s.triangles_per_s},
                                    {"coarse_shapes", s.coarse_shapes}};
  const std::string text = json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
  AtomicFile out(file);
  out.write(std::as_bytes(std::span(text)));
  out.commit();
}

void print_summary(const PartitionStats& s, const std::filesystem::path& bundle) {
  show("{}: {} triangles{} in {} domain{}, {}\n", bundle.string(), s.input_triangles,
       s.quadrics > 0 ? fmt::format(" and {} quadrics", s.quadrics) : "", s.domains,
       s.domains == 1 ? "" : "s", format_bytes(s.bundle_bytes));
  if (s.domains < s.domains_planned)
    show("  fewer domains than {}: more would not separate the triangles, only cut them into more pieces\n",
         s.domains_planned);
  show("  a domain has {} to {} triangles, {:.0f} on average\n", s.triangles_min, s.triangles_max,
       s.triangles_mean);
  show("  {} triangles were cut into {} pieces; {} duplicates, area error {:.2g}\n", s.cut_triangles,
       s.pieces, s.duplicates, s.area_error);
  if (s.objects > 0)
    show("  {} instances of {} objects are kept; a domain takes at most {} with its objects\n", s.instances,
         s.objects, format_bytes(s.domain_bytes_max));
  if (s.coarse_shapes > 0)
    show(
        "  {} shapes are so far from the others that rounding moves their vertices by more than a thousandth "
        "of "
        "their size\n",
        s.coarse_shapes);
  show("  {:.2f} s, {:.2f} s of processor time, {:.2f} million triangles a second\n", s.wall_s, s.cpu_s,
       s.triangles_per_s * 1e-6);
  show("  at most {} of memory, {} allowed; {}\n", format_bytes(s.peak_rss_bytes),
       format_bytes(s.memory_budget_bytes),
       s.buckets > 1
           ? fmt::format("in {} parts, {} on disk on the way", s.buckets, format_bytes(s.spill_bytes))
           : "all triangles at once");
}

}  // namespace vitrail
