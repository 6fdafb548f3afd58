// SPDX-License-Identifier: Apache-2.0
#include "farm/run/patience.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <iterator>
#include <span>

#include "farm/run/stopped_ranks.h"
#include "farm/transport/doing.h"
#include "scene/system/say.h"

namespace vitrail {

Patience::Patience(Transport& transport, Watchdog& watchdog, double patience_s)
    : transport_(transport),
      watchdog_(watchdog),
      patience_s_(patience_s),
      watch_(transport.rank(), transport.size(), patience_s) {
  watchdog_.expect_reports(transport_.size() > 1);
  if (transport_.size() == 1) return;
  watch_.round_begins(0);  // which lasts as long as the job
  transport_.while_waiting = [this] { watch(); };
  learn_names();
  watchdog_.call_it(fmt::format("rank {} of {} ({})", transport_.rank(), transport_.size(),
                                names_[static_cast<std::size_t>(transport_.rank())]));
}

Patience::~Patience() { transport_.while_waiting = nullptr; }

void Patience::learn_names() {
  struct Place {
    std::array<char, 56> host{};  // ends with a zero
    std::int64_t process = 0;
  };
  using Words = std::array<std::uint64_t, sizeof(Place) / sizeof(std::uint64_t)>;
  Place own;
  ::gethostname(own.host.data(), own.host.size() - 1);
  own.process = ::getpid();
  const auto words = std::bit_cast<Words>(own);
  const auto ranks = static_cast<std::size_t>(transport_.size()),
             rank = static_cast<std::size_t>(transport_.rank());
  std::vector<std::int64_t> told(words.size() * ranks);
  std::ranges::copy(words, told.begin() + static_cast<std::ptrdiff_t>(words.size() * rank));
  transport_.sum_to_root(std::span(told));
  std::vector<std::uint64_t> all(told.begin(), told.end());
  transport_.broadcast_from_root(std::span(all));
  std::vector<std::string> names;
  for (std::size_t r = 0; r < ranks; ++r) {
    Words theirs;
    std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(theirs.size() * r), theirs.size(), theirs.begin());
    const auto place = std::bit_cast<Place>(theirs);
    names.push_back(fmt::format("{}, process {}", place.host.data(), place.process));
  }
  names_ = std::move(names);
}

std::string Patience::name(int rank) const {
  if (names_.empty()) return std::to_string(rank);
  return fmt::format("{} ({})", rank, names_[static_cast<std::size_t>(rank)]);
}

double Patience::now_s() {
  const auto now = std::chrono::steady_clock::now();
  const std::chrono::duration<double> since_last = now - looked_;
  looked_ = now;
  return now_s_ += std::min(since_last.count(), patience_s_ / 8);
}

void Patience::watch() {
  watchdog_.report();
  if (watchdog_.has_given_up()) end_job();
  answer();
  const Watch::Step step = watch_.step(now_s());
  if (step == Watch::Step::ask_all)
    for (int other = 0; other < transport_.size(); ++other)
      if (other != transport_.rank()) transport_.say(other, Transport::Word::are_you_there);
  if (step == Watch::Step::give_up) give_up();
}

void Patience::answer() {
  while (const auto heard = transport_.hear()) {
    const auto [from, word] = *heard;
    if (word == Transport::Word::are_you_there) {
      watch_.asked(now_s_);
      transport_.say(from, failed_ ? Transport::Word::failed : Transport::Word::here);
      continue;
    }
    watch_.answered(from);
    if (word == Transport::Word::here || leaving_) continue;
    say("vitrail: rank {} of {}: rank {} has failed, which ends the job\n", transport_.rank(),
        transport_.size(), name(from));
    end_job();
  }
}

// Ranks may be silent because MPI waits for one that is stopped: where that is of this host, it is known.
void Patience::give_up() {
  const std::vector<int> silent = watch_.silent(), stopped = stopped_ranks_of_host();
  std::vector<int> named;
  std::ranges::set_intersection(silent, stopped, std::back_inserter(named));
  const bool are_stopped = !named.empty();
  if (!are_stopped) named = silent;
  std::vector<std::string> names;
  for (const int rank : named) names.push_back(name(rank));
  const bool one = named.size() == 1;
  say("vitrail: rank {} of {}: {} {} {} not answered for {} s (--patience){}, while this one was {}: the job "
      "ends; the same command continues from its last checkpoint\n",
      transport_.rank(), transport_.size(), one ? "rank" : "ranks", fmt::join(names, ", "),
      one ? "has" : "have", patience_s_,
      are_stopped ? (one ? ", for it is stopped" : ", for they are stopped") : "", doing());
  end_job();
}

// At once: what stopped others may have stopped a thread of this rank too.
void Patience::end_job() {
  constexpr int machine_failed = 4;  // the exit status of that
  watchdog_.gives_up();
  transport_.abandon(machine_failed);
}

void Patience::leave(bool failed) {
  if (transport_.size() == 1) return;
  now_doing("ending");
  failed_ = failed;
  leaving_ = true;
  transport_.leave();
  now_doing("ending MPI");
}

}  // namespace vitrail
