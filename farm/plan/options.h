// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>

#include "farm/plan/grouping.h"
#include "farm/plan/sample_choices.h"
#include "farm/plan/scene_edits.h"
#include "farm/plan/set_sheets.h"
#include "farm/plan/view_edit.h"
#include "farm/scheduler/residency.h"
#include "scene/records/scene.h"
#include "tracer/intersect/traversal.h"
#include "tracer/prepared/daylight_rows.h"

namespace vitrail {

enum class ProgressMode { none, bar, lines, json };

// It is an error of the picture's luminance, as film/film_noise.h has it.
struct TargetError {
  double value = 0;
  bool just_noticeable = false;  // in just noticeable differences, root mean square; else relMSE
};

enum class Integrator : std::uint8_t { path, direct, photon };

// It is the time between writing a film and the end of the program: so long for any film, and for each of its
// bytes.
struct AfterFilm {
  double s = 0, s_per_byte = 0;
};

// They say what the picture is: with the scene they make the film, to the bit. An empty optional is as the
// scene says.
struct PictureSettings {
  std::optional<int> samples_per_pixel;
  std::optional<int> max_depth;
  std::optional<Integrator> integrator;
  PhotonSettings photons;        // what of them is given; refused where no photons are traced
  double threshold = 0;          // FilmKey::threshold, with direct light alone
  std::vector<SetSheet> sheets;  // in place of the bundle's; of all ranks the same
  std::vector<SceneEdit> edits;  // of lights and materials
  ViewEdit view;                 // of the camera
  std::string glazing;           // how sheets and edits were asked for: "window.state=0.6"; empty: not at all
  std::optional<int> width, height;  // one of them alone: in the scene's proportions
  double scale = 1;                  // of both, where neither is given
  std::filesystem::path
      sensors;  // measured in place of the picture (scene/models/sensor_file.h); empty: none
  std::optional<DaylightRows> daylight;  // that sensors measure, in place of the scene's light
  std::optional<PixelRect> crop;
  std::optional<SpectralBins> bins;
  double clamp = 0;                     // FilmKey::clamp
  std::optional<std::uint32_t> layers;  // bits of FilmLayers
  std::uint32_t more_layers = 0;        // the same, kept beside those
  std::optional<bool> layers_in_camera_space;
  std::optional<bool> hides_emitters;
  LightGrouping light_groups;
  std::uint64_t seed = 0;
  SampleChoices samples;
  bool adaptive = false;                    // samples go where the picture is noisy
  std::optional<TargetError> target_error;  // the render ends once this is reached
};

// They say what a job has, and how it takes it. Nothing of it shows in the film but how many samples it has,
// where a time limits them.
struct JobResources {
  std::uint64_t memory_bytes = 0;  // a rank; 0: no limit
  std::uint64_t job_bytes = 0;     // of the job for this rank, where the user gives no memory; 0: no limit
  int threads = 0;                 // a rank; 0: one a processor allowed
  Distribution distribution = Distribution::automatic;
  Traversal traversal = Traversal::own;
  std::filesystem::path homes;      // a RayProfile: ranks answer for equal work; empty: for equal bytes
  bool homes_stay = false;          // until the end; else they settle where a job is long (run/settling.h)
  double checkpoint_every_s = 600;  // 0: only when asked by a signal
  // It runs from `start` to the end of all that comes after the film; 0 is no limit. The film then holds what
  // was done. At least half of it is for tracing, and it ends no sooner than with some samples.
  double time_limit_s = 0;
  AfterFilm after_film;
  double stop_after_s = 0;  // from `start` on; 0: never. As if told to stop, by a TERM
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  double patience_s = 600;  // a rank that does not answer for so long ends the job; 0: never
  // It is for tests: domains get at most this, whatever memory_bytes leaves, and rays get so little that they
  // go to the disk; 0: no such limit.
  std::uint64_t domain_memory_bytes = 0;
  // Before homes settle no ray is born for so long; what then lives is sent on to the new homes.
  double settle_ending_s = 2;
  // It is for tests: homes settle after so many seconds, however little time is left.
  std::optional<double> settle_after_s;
  // It is for tests: rays are processed in an arbitrary order, on which no picture may depend.
  std::optional<std::uint64_t> shuffle_seed;
};

// They say what a job writes and prints.
struct JobOutputs {
  std::filesystem::path
      film;  // where the finished film goes; the checkpoint lies beside it (checkpoint_path)
  std::filesystem::path picture;  // made of the film once that is written; empty: the film is the output
  bool keeps_film =
      true;               // false: a work file, worth nothing once the picture is written that was made of it
  bool denoises = false;  // the picture is denoised
  std::filesystem::path preview;  // another program makes it of each checkpoint; empty: none
  bool displays = false;          // rank 0 sends the colours of each checkpoint to a viewer
  std::string scene_name;         // what the picture says that it is of; empty: nothing
  bool dry_run = false;           // renders until the time limit, writes nothing and says what all would take
  bool resume = false;            // says where there is nothing to go on from; going on needs no asking
  bool force = false;             // replaces what lies under the names of film and checkpoint, whatever it is
  // It is called on rank 0, with each checkpoint while the render goes on; empty: nothing is called.
  std::function<void(const std::filesystem::path&)> after_checkpoint;
  std::string command;            // that was typed, for the statistics
  std::filesystem::path stats;    // empty: none
  std::filesystem::path profile;  // where a RayProfile of a whole picture goes; empty: none
  std::filesystem::path trace;    // where what all threads did when goes (trace_events.h); empty: nowhere
  ProgressMode progress = ProgressMode::none;
  bool quiet = false;  // only problems are printed
};

// They are the options of `vitrail render`.
struct RenderOptions {
  std::filesystem::path bundle;
  PictureSettings picture;
  JobResources resources;
  JobOutputs outputs;
};

}  // namespace vitrail
