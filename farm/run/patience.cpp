// SPDX-License-Identifier: Apache-2.0
#include "farm/run/patience.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdlib>
#include <future>

#include "scene/system/say.h"

namespace vitrail {

Patience::Patience(Transport& transport, const RankState& state, double patience_s)
    : transport_(transport),
      state_(state),
      patience_s_(patience_s),
      watch_(transport.rank(), transport.size(), patience_s) {
  transport_.while_waiting = [this] { watch(); };
}

Patience::~Patience() { transport_.while_waiting = nullptr; }

void Patience::watch() {
  while (const auto heard = transport_.hear()) {
    const auto [from, word] = *heard;
    if (word == Transport::Word::here) {
      watch_.answered(from);
    } else {
      watch_.asked(state_.elapsed_s());
      transport_.say(from, Transport::Word::here);
    }
  }
  const Watch::Step step = watch_.step(state_.elapsed_s());
  if (step == Watch::Step::ask_all)
    for (int other = 0; other < transport_.size(); ++other)
      if (other != transport_.rank()) transport_.say(other, Transport::Word::are_you_there);
  if (step == Watch::Step::give_up) give_up();
}

void Patience::give_up() {
  const std::vector<int> silent = watch_.silent();
  const bool one = silent.size() == 1;
  say("vitrail: rank {} of {}: {} {} {} not answered for {} s (--patience): the job ends; what its last "
      "checkpoint holds is not lost, the same command goes on from there\n",
      transport_.rank(), transport_.size(), one ? "rank" : "ranks", fmt::join(silent, ", "),
      one ? "has" : "have", patience_s_);
  constexpr int machine_failed = 4;    // the exit status of that
  transport_.abandon(machine_failed);  // at once: what stopped them may have stopped this rank's loader too
}

void Patience::answer_during(const std::function<void()>& work) {
  using namespace std::chrono_literals;
  if (transport_.size() == 1) return work();
  std::future<void> working = std::async(std::launch::async, work);
  while (working.wait_for(1ms) != std::future_status::ready) watch();
  working.get();
}

}  // namespace vitrail
