// SPDX-License-Identifier: Apache-2.0
#include "cli/partition/partition_arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "cli/common/layer_names.h"
#include "cli/common/number_checks.h"

namespace vitrail {

void declare(CLI::App& app, PartitionArguments& a) {
  app.add_option("input", a.input, "scene file")->required();
  app.add_option("-o,--output", a.output, "bundle to write (NAME.vit)")->required();
  app.add_option("--domains", a.options.domains, "number of sub-domains; default: as --domain-bytes says")
      ->transform(plain_count)
      ->check(CLI::Range(1, 999'999));
  app.add_option("--domains-at-once", a.options.domains_at_once)->group("");
  app.add_flag("--require-everything", a.options.everything,
               "store and compute all data, required or not, to measure the gain of the analysis");
  app.add_flag("--median-cuts", a.options.median,
               "halve the triangles at every cut, to measure the gain of cuts by cost");
  app.add_flag("--flatten", a.options.flatten,
               "copy the triangles of instances instead of keeping instances");
  app.add_option("--domain-bytes", a.domain_bytes,
                 "size of a sub-domain with the objects that it places, e.g. 256M; default: 64M, or a 32nd "
                 "of --memory "
                 "where that is less. With --domains a sub-domain whose objects take more becomes several");
  app.add_option("--pack", a.pack,
                 "put the sub-domains into few files of at most this size, e.g. 1G; default: a file each");
  app.add_option("--memory", a.memory,
                 "most memory to use, e.g. 512M; default: three quarters of the machine's, or what Slurm or "
                 "a control group gives. A larger scene "
                 "goes through files beside the bundle");
  app.add_flag("--no-sync{false}", a.options.durable, "do not wait until the bundle is on the disk");
  app.add_flag("--no-cache{false}", a.cached, no_cache_help);
  app.add_flag("--keep-domains", a.keeps_domains)->group("");
  app.add_option("--threads", a.options.threads, "threads; default: one a processor allowed")
      ->check(CLI::Range(1, 4096));
  app.add_option("--stats", a.stats, "write statistics as JSON");
  app.add_option("--profile", a.profile,
                 "cut for the rays of an earlier render of this scene (a file of `render --profile`)");
  app.add_option("--aov", a.aov, layers_help);
  declare_import_options(app, a.imports);
  declare_lamps_option(app, a.imports);
  declare_rgb_option(app, a.rgb);
  declare_mesh_options(app, a.meshes);
  app.add_flag("--force", a.force, "replace a bundle of another scene");
  app.add_flag("--strict", a.strict, "refuse a scene that is not imported exactly");
  app.add_option("--progress", a.progress, "bar, none, or auto: a bar on a terminal, else lines")
      ->check(CLI::IsMember({"auto", "bar", "none"}))
      ->capture_default_str();
  app.add_flag("--no-summary{false}", a.summary)->group("");
  app.add_flag("--view-only", a.view_only)->group("");  // for render --camera: how the scene is seen, as JSON
  app.add_flag("--quiet", a.quiet, "print problems only");
}

BundleOrigin origin_of(const PartitionArguments& a) {
  std::vector<std::string> words = arguments_of(a.meshes);
  if (a.options.domains > 0) words.push_back(fmt::format("--domains {}", a.options.domains));
  if (!a.domain_bytes.empty()) words.push_back("--domain-bytes " + a.domain_bytes);
  if (!a.pack.empty()) words.push_back("--pack " + a.pack);
  if (a.options.flatten) words.push_back("--flatten");
  if (a.options.median) words.push_back("--median-cuts");
  if (a.options.everything) words.push_back("--require-everything");
  if (!a.aov.empty()) words.push_back("--aov " + a.aov);
  if (!a.profile.empty()) words.push_back("--profile " + a.profile.string());
  std::ranges::copy(arguments_of(a.imports), std::back_inserter(words));
  if (!a.rgb.empty()) words.push_back("--rgb=" + a.rgb);
  return {std::filesystem::absolute(a.input).string(), "", fmt::format("{}", fmt::join(words, " "))};
}

}  // namespace vitrail
