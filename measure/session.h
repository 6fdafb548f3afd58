// SPDX-License-Identifier: Apache-2.0
// A Session turns settings into statistics: it makes the renders of each, and tells how far all are.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "measure/measure.h"

namespace vitrail {

class Session {
 public:
  // `renders` is how many there are at most, for the progress.
  Session(Runs& runs, const MeasureOptions& options, int spp, int renders, const MeasureNews& news);

  // Renders with paths of any depth, whatever the scene's own limit, so that the cost of a limit is seen.
  Reference reference(int spp);
  // Measures the scene's own setting, then one change of it each, and appends them to `m.settings`. A change
  // that cannot change the picture takes one seed. Throws MachineError where the machine fails; a setting of
  // little memory has a `failure` instead.
  void measure_axes(Measurement& m);
  // Measures the scene's own setting at other counts of samples, and fits the law that they follow.
  void measure_samples(Measurement& m);
  // Measures with `spp` samples, or as many as the setting takes at least.
  MeasuredSetting measure_setting(const Measurement& m, const Setting& setting, int spp);
  // Measures a setting once more, for its error alone: what is known of its bias stays.
  MeasuredSetting check(const Measurement& m, const MeasuredSetting& known, int spp);
  // Returns how many of the wanted samples a check of the setting can take within the budget.
  int checkable(const MeasuredSetting& s, int wanted_spp) const;
  // Returns what `plan` says of a setting that was measured so, on the options' farm. Throws as programs do.
  FarmTime plan_farm(const Measurement& m, const MeasuredSetting& setting);

  // Returns the CPU seconds a second of all renders.
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
