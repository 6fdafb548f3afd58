// SPDX-License-Identifier: Apache-2.0
// Settings become statistics: which renders each takes, and how far all are.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "measure/measure.h"

namespace vitrail {

class Session {
 public:
  // `renders`: how many there are at most, for the progress.
  Session(Runs& runs, const MeasureOptions& options, int spp, int renders, const MeasureNews& news);

  // Of paths without a limit, whatever the scene's own is: what depth costs is to be seen.
  Reference reference(int spp);
  // The scene's own setting, then one change of it each, appended to `m.settings`. One that cannot change
  // the picture takes one seed. Throws MachineError where the machine fails, but for settings of little
  // memory: those have a `failure`.
  void measure_axes(Measurement& m);
  // The scene's own at other counts of samples, and the law that they follow.
  void measure_samples(Measurement& m);
  // Of `spp` samples, or as many as the setting takes at least.
  MeasuredSetting measure_setting(const Measurement& m, const Setting& setting, int spp);
  // The same, once more, for its error alone: what is known of its bias stays.
  MeasuredSetting check(const Measurement& m, const MeasuredSetting& known, int spp);
  // As many samples of a setting as a check may have, of those that are wanted, within the budget.
  int checkable(const MeasuredSetting& s, int wanted_spp) const;
  // What `plan` says of a setting that was measured so, on the options' farm. Throws as the programs do.
  FarmTime plan_farm(const Measurement& m, const MeasuredSetting& setting);

  // CPU seconds a second of all renders.
  double parallelism() const { return wall_s_ > 0 ? cpu_s_ / wall_s_ : 1; }

 private:
  enum class Beside { unbiased, reference };  // what a bias is measured against
  MeasuredSetting measure_setting(const Measurement& m, const Setting& setting, int spp, Beside beside);
  std::optional<RunResult> try_run(const Measurement& m, MeasuredSetting& s, int seed);
  void add_run(MeasuredSetting& s, const RunResult& r, int seed);
  void find_error(const Measurement& m, MeasuredSetting& s, const std::vector<Image>& pictures,
                  Beside beside);
  RunRequest request(const Measurement& m, const Setting& setting, int spp, int seed) const;
  RunResult run(const RunRequest& request, const std::string& what);
  const std::vector<Image>& unbiased_pictures(int spp);

  Runs& runs_;
  const MeasureOptions& options_;
  int spp_, renders_;
  std::vector<std::string> whole_;  // arguments of the reference
  int done_ = 0;
  double cpu_s_ = 0, wall_s_ = 0;
  double checks_s_ = 0;                         // wall time of checks
  std::vector<Image> own_pictures_;             // of the scene's own setting, of each seed
  std::string own_hash_;                        // of the film of the first
  std::map<int, std::vector<Image>> unbiased_;  // of the reference's setting, by samples; of each seed
  const MeasureNews& news_;
};

}  // namespace vitrail
