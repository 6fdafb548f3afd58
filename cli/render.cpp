// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <new>
#include <optional>

#include "cli/main_guard.h"
#include "cli/mesh_options.h"
#include "cli/rectangle.h"
#include "cli/run_program.h"
#include "cli/sizes.h"
#include "cli/temporary_bundle.h"
#include "farm/agreement.h"
#include "farm/render.h"
#include "farm/signals.h"
#include "film/develop.h"

namespace vitrail {
namespace {

struct Arguments {
  std::filesystem::path input, output;
  int bins = 0;
  std::string memory, crop, integrator, progress = "auto";
  MeshOptions meshes;
  RenderOptions options;
};

void declare(CLI::App& app, Arguments& a) {
  RenderOptions& o = a.options;
  app.add_option("input", a.input, "a bundle (NAME.vit) or a scene, which is partitioned first")->required();
  app.add_option("-o,--output", a.output, "picture (.exr, .png) or film (.film)")->required();
  app.add_option("--spp", o.samples_per_pixel, "samples a pixel");
  app.add_option("--max-depth", o.max_depth,
                 "scattering events of a path; 0: emitters only, 1: direct light");
  app.add_option("--seed", o.seed, "films of different seeds are independent");
  app.add_option("--integrator", a.integrator, "path or direct; default as the scene says")
      ->check(CLI::IsMember({"path", "direct"}));
  app.add_option("--memory", a.memory, "most memory a rank may use, e.g. 512M or 2G");
  app.add_option("--threads", o.threads, "worker threads a rank; default: all cores");
  app.add_option("--crop", a.crop, "x0,x1,y0,y1 in pixels from the top left");
  app.add_option(
         "--spectral", a.bins,
         "keep the spectrum of each pixel in this many bins over 360 to 830 nm; default: as the scene says")
      ->check(CLI::Range(1, max_spectral_bins));
  app.add_option("--checkpoint-every", o.checkpoint_every_s, "seconds between checkpoints");
  app.add_flag("--resume", o.resume, "go on from the checkpoint");
  app.add_option("--time", o.time_limit_s, "stop after this many seconds with what there is");
  app.add_option("--stats", o.stats, "write statistics as JSON");
  app.add_option("--profile", o.profile, "write where rays went, for `partition --profile`");
  declare_mesh_options(app, a.meshes);
  app.add_option("--progress", a.progress)->check(CLI::IsMember({"auto", "bar", "json", "none"}));
  app.add_option("--shuffle-delivery", o.shuffle_seed)->group("");
  app.add_option("--domain-memory", o.domain_memory_bytes)->group("");
}

bool is_bundle(const std::filesystem::path& input) {
  return std::filesystem::exists(input / "manifest.json") || input.extension() == ".vit";
}

void interpret(Arguments& a) {
  if (a.meshes.any() && is_bundle(a.input))
    throw UsageError("the meshes of a bundle stay as they are: give " + arguments_of(a.meshes)[0] +
                     " to partition");
  const std::string extension = a.output.extension().string();
  constexpr const char* known[] = {".exr", ".png", ".film"};
  if (std::ranges::find(known, extension) == std::end(known))
    throw UsageError("the output must end in .exr, .png or .film: " + a.output.string());
  a.options.film = std::filesystem::path(a.output).replace_extension(".film");
  if (!a.memory.empty()) a.options.memory_bytes = parse_bytes(a.memory);
  if (!a.crop.empty()) a.options.crop = parse_rectangle("--crop", a.crop);
  if (a.bins > 0) a.options.bins = SpectralBins{a.bins};
  if (!a.integrator.empty()) a.options.direct_only = a.integrator == "direct";
  if (a.progress == "json") a.options.progress = ProgressMode::json;
  if (a.progress == "bar" || (a.progress == "auto" && ::isatty(STDERR_FILENO)))
    a.options.progress = ProgressMode::bar;
  const std::filesystem::path folder = std::filesystem::absolute(a.output).parent_path();
  if (::access(folder.c_str(), W_OK) != 0) throw MachineError("cannot write to " + folder.string());
}

std::vector<std::string> partition_arguments(const Arguments& a) {
  std::vector<std::string> arguments = arguments_of(a.meshes);
  arguments.insert(arguments.end(), {"--quiet", "--no-sync"});
  // It may have to load what reads images, of more than 100 MiB, and is gone when rendering begins.
  constexpr std::uint64_t least = 256u << 20;
  if (!a.memory.empty())
    arguments.insert(arguments.end(), {"--memory", std::to_string(std::max(parse_bytes(a.memory), least))});
  if (a.options.threads > 0)
    arguments.insert(arguments.end(), {"--threads", std::to_string(a.options.threads)});
  return arguments;
}

int render_job(Transport& transport, Arguments& a) {
  agree(transport, [&] { interpret(a); });
  const auto beside_the_film = std::filesystem::path(a.options.film).replace_extension(".tmp.vit");
  a.options.bundle = is_bundle(a.input) ? a.input : beside_the_film;
  std::optional<TemporaryBundle> temporary;
  if (a.options.bundle != a.input)
    temporary.emplace(transport, a.input, a.options.bundle, partition_arguments(a));
  agree(transport, [] {
    if (stop_signalled()) throw MachineError("interrupted before rendering began");
  });
  const RenderStats stats = render(transport, a.options);
  agree(transport, [&] { require_unsaturated(stats.refused, a.options.film); });
  if (transport.rank() != 0) return exit_done;
  if (stats.complete) {
    if (a.output.extension() != ".film") {
      std::vector<std::string> arguments{a.options.film.string(), "-o", a.output.string()};
      if (stats.spectral_bins > 0 && a.output.extension() == ".exr") arguments.push_back("--spectral");
      run_program("vitrail-develop", arguments);
    }
  } else {
    fmt::print(stderr, "vitrail: stopped; {}.partial holds what was done, go on with --resume\n",
               a.options.film.string());
  }
  return exit_done;
}

// A job of several ranks says which one speaks.
int guarded_job(Transport& transport, Arguments& a) {
  const std::string who =
      transport.size() > 1 ? fmt::format("rank {} of {}: ", transport.rank(), transport.size()) : "";
  try {
    return render_job(transport, a);
  } catch (const OtherRankFailed& failed) {
    return failed.bad_input ? exit_bad_input : exit_machine;
  } catch (const Error& error) {
    throw Error(who + error.what(), error.location, error.excerpt);
  } catch (const UsageError& error) {
    throw UsageError(who + error.what());
  } catch (const std::bad_alloc&) {
    throw MachineError(who + "out of memory; a large picture is rendered in parts with --crop");
  } catch (const std::exception& error) {
    throw MachineError(who + error.what());
  }
}

}  // namespace
}  // namespace vitrail

int main(int argc, char** argv) {
  using namespace vitrail;
  CLI::App app("renders a bundle or a scene, alone or as the ranks of an MPI job", "vitrail render");
  Arguments arguments;
  declare(app, arguments);
  return run_guarded(app, argc, argv, [&] {
    const auto transport = make_transport(&argc, &argv);
    return run_guarded([&] { return guarded_job(*transport, arguments); });
  });
}
