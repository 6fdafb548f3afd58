// SPDX-License-Identifier: Apache-2.0
#include "cli/common/distribution.h"
#include "cli/common/layer_names.h"
#include "cli/common/number_checks.h"
#include "cli/render/quality.h"
#include "cli/render/render_arguments.h"

namespace vitrail {

namespace {

void declare_files(CLI::App& app, RenderArguments& a) {
  app.add_option("input", a.input, "a bundle (NAME.vit) or a scene, which is partitioned first")->required();
  app.add_option(
      "-o,--output,--outfile", a.output,
      "picture (.exr, .hdr, .png, .jpg, .tif) or film (.film) to write; default: the scene's name for "
      "it, else the input's name with .exr, in this folder");
  app.add_option("--film", a.film, "keep the film under this name (.film), to add samples later");
}

// How many samples.
void declare_samples(CLI::App& app, RenderArguments& a) {
  RenderOptions& o = a.options;
  app.add_option("--spp", o.picture.samples_per_pixel, "samples a pixel; default: the scene's")
      ->transform(plain_count)
      ->check(more_than_0);
  app.add_flag("--adaptive,!--no-adaptive", o.picture.adaptive,
               "more samples where the picture is noisy, fewer elsewhere; --spp is then the mean");
  app.add_option(
      "--target-error", a.target_error,
      "render until the error is below this: the relative mean squared error of luminance, e.g. 0.01, or the "
      "visible error, e.g. 1jnd: one just noticeable difference. --spp is then the most");
  app.add_option("--quality", a.quality,
                 "noise is visible (draft), hardly visible (good) or invisible (final); sets --target-error, "
                 "--spp and --adaptive unless they are given")
      ->check(CLI::IsMember(qualities()));
}

void declare_denoiser(CLI::App& app, RenderArguments& a) {
  app.add_flag("--denoise", a.denoised,
               "remove noise from the picture, by develop --denoise. The film keeps its noise, and without "
               "--aov also gets the albedo and normals that guide the denoiser");
}

// What of the scene is seen, and by which paths.
void declare_picture(CLI::App& app, RenderArguments& a) {
  RenderOptions& o = a.options;
  app.add_option("--max-depth", a.max_depth,
                 "most scattering events of a path; 0: emitters only, 1: direct light, -1: no limit; "
                 "default: the scene's")
      ->check(CLI::Range(-1, 1'000'000));
  app.add_option("--width", o.picture.width,
                 "width of the picture in pixels; default: the scene's, or in proportion to --height")
      ->check(CLI::Range(1, 1 << 20));
  app.add_option("--height", o.picture.height,
                 "height of the picture in pixels; default: the scene's, or in proportion to --width")
      ->check(CLI::Range(1, 1 << 20));
  app.add_option("--scale", o.picture.scale, "multiply the scene's width and height by this")
      ->check(CLI::Range(1e-3, 1e3))
      ->capture_default_str();
  app.add_option("--seed", o.picture.seed,
                 "number that starts all randomness: films of different seeds have independent noise")
      ->check(not_below_0)
      ->capture_default_str();
  app.add_option("--integrator", a.integrator,
                 "path: all light; direct: light from lamps only, also through glass and by mirrors; photon: "
                 "photon mapping, for caustics; default: the scene's")
      ->check(CLI::IsMember({"path", "direct", "photon"}));
  declare_sample_options(app, a.samples);
  app.add_option(
      "--look-at", a.look_at,
      "move the camera without partitioning again: x,y,z of the eye, x,y,z of the point that it "
      "looks at and, where wanted, x,y,z of the direction up. Without it a level camera stays level. The "
      "camera then stands still");
  app.add_option("--fov", o.picture.view.fov_deg,
                 "field of view of a perspective camera along the shorter side of the picture")
      ->check(CLI::Range(0.001, 179.999));
  app.add_option("--set", a.settings,
                 "change the scene without partitioning it again; may repeat. Lights, by the names of "
                 "inspect or of their material: NAME.scale=2; a sky: NAME.sun=X:Y:Z (towards it) and "
                 "NAME.turbidity=3, NAME.ground=0.2, or NAME.sky= and the words of --sky. Materials: "
                 "NAME.color=R:G:B, NAME.roughness=0.2. Switchable glazing: NAME.state=0.6, "
                 "NAME.temperature (°C), NAME.uv (W/m²), NAME.seconds")
      ->allow_extra_args(false);
  app.add_option("--threshold", o.picture.threshold,
                 "of --integrator direct: end a path that brings less than this share of the light that it "
                 "sees, e.g. 0.01. No pixel becomes darker by more than this share of the brightest light")
      ->check(CLI::Range(0.0, 0.999))
      ->capture_default_str();
}

void declare_photons(CLI::App& app, RenderOptions& o) {
  app.add_option("--photons", o.picture.photons.photons,
                 "photons of an iteration, e.g. 500k or 2M; an iteration is one sample of every pixel; "
                 "default: the scene's, else as many as pixels, at least 65536")
      ->transform(plain_count)
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 31));
  app.add_option("--photon-radius", o.picture.photons.first_radius,
                 "radius in which the first iteration gathers photons, in scene units; default: the scene's, "
                 "else from its extent and the number of photons")
      ->check(more_than_0);
  app.add_option("--photon-alpha", o.picture.photons.alpha,
                 "how fast the radius shrinks, between 0 (fast, noisy) and 1 (slow, blurred); default: the "
                 "scene's, else 0.667")
      ->check(CLI::Range(0.01, 0.99));
}

void declare_resources(CLI::App& app, RenderArguments& a) {
  RenderOptions& o = a.options;
  app.add_option("--memory", a.memory,
                 "most memory a rank may use, e.g. 512M or 2G; default: what Slurm, a control group or "
                 "the machine gives");
  app.add_option("-t,--threads,--nthreads", o.resources.threads,
                 "threads a rank, at most 64 or four a processor; default: one a processor allowed")
      ->check(CLI::Range(1, 4096));
  declare_distribution(app, o.resources.distribution, o.resources.homes, o.resources.homes_stay);
  app.add_option_function<std::string>(
         "--traversal",
         [&o](const std::string& whose) {
           o.resources.traversal = whose == "embree" ? Traversal::embree : Traversal::own;
         },
         "own (default): rays go through the bundle's trees. embree: through trees that Embree builds as a "
         "domain is loaded, for a second opinion: slower, and the same picture to the bit")
      ->check(CLI::IsMember({"own", "embree"}));
}

// What the film keeps.
void declare_film(CLI::App& app, RenderArguments& a) {
  RenderOptions& o = a.options;
  app.add_option("--crop,--pixelbounds", a.crop,
                 "render this rectangle only: x0,x1,y0,y1 in pixels from the top left; default: all");
  app.add_option("--spectral", a.bins,
                 "keep the spectrum of each pixel in this many bins over 360 to 830 nm; default: the scene's")
      ->check(CLI::Range(1, max_spectral_bins));
  app.add_option("--clamp", o.picture.clamp,
                 "limit the light that one connection of a path adds to a sample, in the picture's units; 0: "
                 "no limit. Fewer bright specks, but a darker picture; the film records by how much")
      ->check(not_below_0)
      ->capture_default_str();
  app.add_option("--aov", a.aov, layers_help);
  app.add_option("--aov-space", a.aov_space,
                 "space of positions and normals of --aov; default: the scene's, else world")
      ->check(CLI::IsMember({"world", "camera"}));
  app.add_flag("--alpha", a.alpha,
               "write an alpha channel (.exr and .png): the share of a pixel that surfaces and scattering "
               "media cover; surroundings do not count");
  // Not by its address: CLI11 would count it, and say false where it is not given.
  app.add_flag_function(
      "--hide-emitters,!--show-emitters", [&o](std::int64_t given) { o.picture.hides_emitters = given > 0; },
      "the camera does not see lamps and surroundings directly; they still light the scene; default: as the "
      "scene says");
  app.add_flag("--light-groups", o.picture.light_groups.each,
               "keep the light of each lamp apart in the film, by the names of inspect, for develop "
               "--groups; 48 bytes a pixel for each lamp");
  app.add_option("--light-group", a.light_groups,
                 "NAME=LIGHT,LIGHT…: keep the light of these lamps apart, together under NAME; * stands for "
                 "any characters; lights in no group are \"others\"; may repeat")
      ->allow_extra_args(false);
}

// How long the job takes, and how it ends and goes on.
void declare_job(CLI::App& app, RenderArguments& a) {
  RenderOptions& o = a.options;
  app.add_option("--patience", o.resources.patience_s,
                 "seconds after which a rank or a file without an answer ends the job, with its name; "
                 "default: 600, 0: never")
      ->transform(plain_seconds)
      ->check(not_below_0);
  app.add_option("--checkpoint-every", o.resources.checkpoint_every_s,
                 "seconds between checkpoints; 0: only on signals")
      ->transform(plain_seconds)
      ->check(not_below_0)
      ->capture_default_str();
  app.add_flag("--resume", o.outputs.resume,
               "report it if there is no render to continue. With or without this option, a render that was "
               "begun continues, and a finished film gets more samples");
  app.add_flag("--force", o.outputs.force,
               "begin anew, and replace any film, checkpoint or picture that has the output's name");
  app.add_option(
         "--time", o.resources.time_limit_s,
         "end after this many seconds, or a time such as 15m or 1h30m, with partitioning and writing the "
         "picture. Without --spp it uses all of it. Tracing gets at least half, and finishes some "
         "samples. The same command then continues")
      ->transform(plain_seconds)
      ->check(more_than_0);
  app.add_flag("--dry-run", o.outputs.dry_run,
               "render for a few seconds, write nothing, and print the memory and time of the whole render");
  app.add_option("--restarts", a.restarts,
                 "start again at most this often if the render is killed or the machine fails; it continues "
                 "from its checkpoint")
      ->check(CLI::Range(0, 1'000'000));
  app.add_option("--launcher", a.launcher,
                 "with --restarts: the command that starts the ranks, e.g. 'mpirun -np 8'");
}

// What is written besides.
void declare_outputs(CLI::App& app, RenderArguments& a) {
  RenderOptions& o = a.options;
  app.add_option("--sensors", o.picture.sensors,
                 "measure irradiance instead of rendering a picture. The text has lines of x y z nx ny nz, "
                 "or plane O U V NXxNY. Each sensor gets 16 times --spp samples; develop writes the .csv");
  app.add_option(
      "--frames", a.frames,
      "render a picture of a bundle for each line of this text: --camera, --look-at, --fov, "
      "--sky, --lamps, --set, --seed or --spp. "
      "--output has %04d for its number, from 1. A picture that is there stays; if it is not what its line "
      "asks for, the difference is named");
  app.add_option(
      "--range", a.range,
      "of --frames: render these alone, by their numbers: 7, 1-30,47, or 1-100x2 for every second");
  app.add_option(
         "--retries", a.retries,
         "of --frames: try frames that the machine failed again, at most this often, after the others")
      ->check(CLI::Range(0, 1'000'000))
      ->capture_default_str();
  app.add_option("--preview", a.preview,
                 "write the picture so far to this file, .png or another: soon, after twice the time and so "
                 "on, and when the render is stopped");
  app.add_option("--display-server", a.display_server,
                 "send the picture so far, as often as --preview, to a viewer such as tev at HOST:PORT");
  app.add_option("--stats", o.outputs.stats, "write statistics as JSON");
  app.add_option("--profile", o.outputs.profile,
                 "write how many rays each domain traced and sent on, for `partition --profile` and `plan`");
  app.add_option("--trace", o.outputs.trace,
                 "write what each thread does over time: loads, batches, idleness, "
                 "messages; for Perfetto (ui.perfetto.dev)");
}

// What is said, and what is refused.
void declare_words(CLI::App& app, RenderArguments& a) {
  app.add_option("--progress", a.progress,
                 "auto: a bar on a terminal, else lines; lines: more often at first, at last one a minute; "
                 "json: lines of JSON on standard output, the last with the event \"end\"")
      ->check(CLI::IsMember({"auto", "bar", "lines", "json", "none"}))
      ->capture_default_str();
  app.add_flag("--strict", a.strict, "refuse a scene that is not imported exactly");
  app.add_flag("--quiet", a.quiet, "print problems only");
}

// For tests and for supervise_job: not in the help.
void declare_hidden(CLI::App& app, RenderArguments& a) {
  RenderOptions& o = a.options;
  app.add_option("--held-lock", a.held_lock)->group("");
  app.add_option("--shuffle-delivery", o.resources.shuffle_seed)->group("");
  app.add_option("--settle-after", o.resources.settle_after_s)->group("");
  app.add_option("--settle-ending", o.resources.settle_ending_s)->group("");
  app.add_option("--domain-memory", o.resources.domain_memory_bytes)->group("");
}

}  // namespace

void declare(CLI::App& app, RenderArguments& a) {
  declare_files(app, a);
  declare_denoiser(app, a);
  declare_samples(app, a);
  declare_picture(app, a);
  declare_photons(app, a.options);
  declare_resources(app, a);
  declare_film(app, a);
  declare_job(app, a);
  declare_outputs(app, a);
  declare_import_options(app, a.imports);
  declare_lamps_option(app, a.imports);
  app.remove_option(app.get_option("--camera"));
  app.add_option(
      "--camera", a.camera,
      "N: which sensor of a Mitsuba scene, or camera of a glTF, FBX or COLLADA, from 0. FILE: the camera of "
      "another scene of any format, without partitioning again");
  CLI::Option* const sky = app.get_option("--sky");
  sky->description(sky->get_description() + ". It replaces the one sky of a bundle, without up and north");
  declare_rgb_option(app, a.rgb);
  declare_mesh_options(app, a.meshes);
  app.add_flag("--no-cache{false}", a.cached,
               "bake all images and cut the scene: keep nothing, and use nothing that is kept, in "
               "$XDG_CACHE_HOME/vitrail or ~/.cache/vitrail");
  declare_words(app, a);
  declare_hidden(app, a);
}

}  // namespace vitrail
