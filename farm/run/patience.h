// SPDX-License-Identifier: Apache-2.0
// Ranks wait for each other only so long: a rank that does not answer is named, and the job ends. This holds
// from the start of the job to its end, whatever ranks do meanwhile.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "farm/run/watchdog.h"
#include "farm/scheduler/watch.h"
#include "farm/transport/transport.h"

namespace vitrail {

class Patience {
 public:
  // All ranks make it together. Words are heard, and answered, in every wait of the transport; a step that
  // takes a while is done beside it (transport/agreement.h).
  Patience(Transport& transport, Watchdog& watchdog, double patience_s);
  ~Patience();
  Patience(const Patience&) = delete;
  Patience& operator=(const Patience&) = delete;

  // Waits for the others, as the last step of a rank. A rank that has `failed`, and told nobody else, is not
  // waited for by those that still work: they end the job.
  void leave(bool failed);

 private:
  void watch();
  void answer();
  double now_s();
  void learn_names();
  std::string name(int rank) const;
  void give_up();
  void end_job();

  Transport& transport_;
  Watchdog& watchdog_;
  double patience_s_;
  Watch watch_;
  bool leaving_ = false, failed_ = false;
  std::vector<std::string> names_;  // "node7, process 1234", by rank; empty until all have told theirs
  // It is a clock that stands still while this rank does: where all of a job was suspended nobody is missing.
  double now_s_ = 0;
  std::chrono::steady_clock::time_point looked_ = std::chrono::steady_clock::now();
};

}  // namespace vitrail
