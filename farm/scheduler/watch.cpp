// SPDX-License-Identifier: Apache-2.0
#include "farm/scheduler/watch.h"

#include <algorithm>
#include <limits>

namespace vitrail {

Watch::Watch(int rank, int ranks, double patience_s) : rank_(rank), ranks_(ranks), patience_s_(patience_s) {}

void Watch::round_begins(double now_s) {
  waiting_ = true;
  asking_ = false;
  since_s_ = heard_s_ = now_s;
}

void Watch::answered(int rank) {
  if (!asking_ || answered_[static_cast<std::size_t>(rank)]) return;
  answered_[static_cast<std::size_t>(rank)] = true;
  --missing_;
}

// Half of the patience until it is asked, half for the answers; those that wait to be asked have twice that.
double Watch::stands_until_s() const {
  if (!asks()) return heard_s_ + 2 * patience_s_;
  return (asking_ ? asked_s_ : since_s_) + patience_s_ / 2;
}

double Watch::due_s() const {
  return waiting_ && ranks_ > 1 && patience_s_ > 0 ? stands_until_s()
                                                   : std::numeric_limits<double>::infinity();
}

Watch::Step Watch::step(double now_s) {
  if (now_s < due_s()) return Step::nothing;
  if (!asks()) return Step::give_up;
  if (asking_ && missing_ > 0) return Step::give_up;
  // All are well, or nobody was asked yet.
  if (asking_) {
    asking_ = false;
    since_s_ = now_s;
    return Step::nothing;
  }
  asking_ = true;
  asked_s_ = now_s;
  answered_.assign(static_cast<std::size_t>(ranks_), false);
  missing_ = ranks_;
  answered(rank_);
  return Step::ask_all;
}

std::vector<int> Watch::silent() const {
  std::vector<int> all;
  for (int r = 0; r < ranks_; ++r)
    if (asks() ? !answered_[static_cast<std::size_t>(r)] : r < asking_ranks) all.push_back(r);
  return all;
}

}  // namespace vitrail
