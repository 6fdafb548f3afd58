// SPDX-License-Identifier: Apache-2.0
#include "bundle/verify.h"

#include <fmt/format.h>
#include <unistd.h>

#include <nlohmann/json.hpp>
#include <set>

#include "cli/common/input_kind.h"
#include "cli/common/main_guard.h"
#include "cli/common/sizes.h"
#include "scene/system/progress_line.h"
#include "scene/system/say.h"

namespace vitrail {
namespace {

using Json = nlohmann::ordered_json;

double bytes_per_s(const VerifyResult& r) { return static_cast<double>(r.bytes) / std::max(r.wall_s, 1e-9); }

Json to_json(const std::vector<VerifyFinding>& findings) {
  Json list = Json::array();
  for (const VerifyFinding& f : findings) list.push_back({{"file", f.file}, {"what", f.what}});
  return list;
}

Json to_json(const std::filesystem::path& bundle, const VerifyResult& r) {
  Json j{{"bundle", bundle.string()},
         {"whole", r.problems.empty()},
         {"problems", to_json(r.problems)},
         {"warnings", to_json(r.warnings)},
         {"files", r.files},
         {"bytes", r.bytes},
         {"wall_s", r.wall_s},
         {"bytes_per_s", bytes_per_s(r)}};
  if (r.census)
    j.update({{"cut_triangles", r.census->cut_triangles},
              {"pieces", r.census->pieces},
              {"duplicates", r.census->duplicates},
              {"lost", r.census->lost},
              {"area_error", r.census->area_error}});
  return j;
}

void print(const std::filesystem::path& bundle, const VerifyResult& r, bool quiet) {
  for (const VerifyFinding& f : r.problems) show("{}: {}\n", f.file, f.what);
  if (quiet) return;
  for (const VerifyFinding& f : r.warnings) show("{}: warning: {}\n", f.file, f.what);
  std::set<std::string> damaged;
  for (const VerifyFinding& f : r.problems) damaged.insert(f.file);
  const std::string verdict =
      r.problems.empty()
          ? "whole"
          : fmt::format("{} problem{} in {} place{}", r.problems.size(), r.problems.size() == 1 ? "" : "s",
                        damaged.size(), damaged.size() == 1 ? "" : "s");
  show("{}: {}; {} files, {}, {:.2f} s, {}/s\n", bundle.string(), verdict, r.files, format_bytes(r.bytes),
       r.wall_s, format_bytes(static_cast<std::uint64_t>(bytes_per_s(r))));
}

}  // namespace
}  // namespace vitrail

int main(int argc, char** argv) {
  using namespace vitrail;
  CLI::App app("reads every byte of a bundle and reports damage", "vitrail verify");
  std::filesystem::path bundle;
  bool json = false, quiet = false, strict = false;
  VerifyOptions options;
  app.add_option("bundle", bundle, "bundle (NAME.vit)")->required();
  app.add_flag("--json", json, "print JSON");
  app.add_flag("--strict", strict, "exit with 3 for warnings too");
  app.add_flag("--quiet", quiet, "print problems only");
  app.add_option("--threads", options.threads, "threads; default: one a processor allowed")
      ->check(CLI::Range(1, 4096));
  return run_guarded(app, argc, argv, [&] {
    require_input(bundle, {InputKind::bundle});
    ProgressLine line(progress_manner(quiet));
    options.progress = [&](double fraction) { line.show(fraction, "read"); };
    const VerifyResult result = verify_bundle(bundle, options);
    line.clear();
    if (json)
      show("{}\n", to_json(bundle, result).dump(1, ' ', false, Json::error_handler_t::replace));
    else
      print(bundle, result, quiet);
    return result.problems.empty() && !(strict && !result.warnings.empty()) ? exit_done : exit_bad_input;
  });
}
