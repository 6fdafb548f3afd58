// SPDX-License-Identifier: Apache-2.0
#include "farm/scheduler/scheduler.h"

#include <algorithm>

namespace vitrail {

namespace {

// With this many rays waiting for a resident domain no new ones are generated.
constexpr std::uint64_t rays_worth_tracing_first = 4096;
// Rays for other ranks leave when this many wait, when a worker here has nothing to do, or after this time.
constexpr std::uint64_t rays_worth_sending = 4096;
constexpr double longest_wait_s = .002;
// In one message; the next round gives more.
constexpr std::uint64_t most_items_given = 4096;

}  // namespace

Scheduler::Scheduler(const Job& job, Residency residency)
    : job_(job),
      residency_(std::move(residency)),
      homes_overlap_(residency_.homes().places() > residency_.homes().domains()),
      pair_(static_cast<unsigned>(job.rank) + 1) {}

Scheduler::Task Scheduler::next_task() const {
  const auto fullest = residency_.fullest();
  const bool may_generate = wants_to_generate() && allowance_ > 0;
  if (fullest && (!may_generate || residency_.waiting(*fullest) >= rays_worth_tracing_first))
    return {Work::trace, *fullest};
  return {may_generate ? Work::generate : Work::none, 0, allowance_};
}

void Scheduler::begin_batch(std::uint32_t domain, std::uint64_t rays) {
  waiting_ -= rays;
  residency_.rays_taken(domain, rays);
}

void Scheduler::begin_items(std::uint64_t items) {
  items_ = items;
  next_item_ = 0;
  calm_ = false;
}

// Those that have nothing to do are dealt out to those that have something to spare, one after the other, and
// each of these keeps as much as it gives to one.
std::vector<Scheduler::Gift> Scheduler::give_items() {
  std::vector<Gift> gifts;
  if (idle_ranks_ == 0 || paused_ || spare_items() == 0 ||
      (*ranks_)[static_cast<std::size_t>(job_.rank)].items <= 0)
    return gifts;
  const auto givers = static_cast<std::size_t>(
      std::ranges::count_if(*ranks_, [](const RankReport& r) { return r.items > 0; }));
  const auto before_this = static_cast<std::size_t>(std::count_if(
      ranks_->begin(), ranks_->begin() + job_.rank, [](const RankReport& r) { return r.items > 0; }));
  std::size_t idle = 0;
  for (std::size_t r = 0; r < ranks_->size(); ++r)
    if ((*ranks_)[r].items < 0 && idle++ % givers == before_this) gifts.push_back({static_cast<int>(r)});
  std::uint64_t shares = gifts.size() + 1;
  for (Gift& gift : gifts) {
    gift.items = std::min(most_items_given, (spare_items() + shares - 1) / shares);
    --shares;
    items_ -= gift.items;
    given_ += gift.items;
    born_ += gift.items;
  }
  std::erase_if(gifts, [](const Gift& gift) { return gift.items == 0; });
  return gifts;
}

void Scheduler::items_arrived(std::uint64_t items) {
  items_ += items;
  died_ += items;
}

// An item may have no rays.
void Scheduler::begin_rays(std::uint64_t rays, bool ends) {
  item_is_open_ = !ends;
  next_item_ += ends;
  in_hand_ += rays > 0;
  rays_in_hand_ += rays;
  allowance_ -= rays;
}

void Scheduler::count(std::uint64_t born, std::uint64_t died) {
  born_ += born;
  died_ += died;
}

void Scheduler::finish_task(std::uint64_t generated) {
  in_hand_ -= generated > 0;
  rays_in_hand_ -= generated;
}

bool Scheduler::route(std::uint32_t domain, std::uint64_t rays) {
  if (residency_.is_local(domain)) {
    waiting_ += rays;
    residency_.rays_wait(domain, rays);
    return true;
  }
  outgoing_ += rays;
  forwarded_ += rays;
  residency_.rays_forwarded(domain, rays);
  return false;
}

// So many times its even share wait here: they are on the disk, and more would only come behind them.
bool Scheduler::is_full() const {
  constexpr std::uint64_t shares = 8;
  return waiting_ + outgoing_ > shares * even_share();
}

bool Scheduler::send_is_due(double now_s) const {
  return outgoing_ > 0 &&
         (outgoing_ >= rays_worth_sending || workers_waiting_ > 0 || now_s - last_sent_s_ > longest_wait_s);
}

// The power of two choices (Mitzenmacher 2001): the fuller of two is avoided, and no rank has all others'
// rays at once, as the emptiest of all would.
int Scheduler::destination(std::uint32_t domain, std::uint64_t rays) {
  const Homes& homes = residency_.homes();
  const int first = homes.first(domain);
  const auto count = static_cast<std::uint64_t>(homes.last(domain) - first + 1);
  int chosen = first;
  if (count > 1 && ranks_) {
    const std::uint64_t one = pair_() % count, other = (one + 1 + pair_() % (count - 1)) % count;
    const auto waiting = [&](std::uint64_t home) {
      const int rank = first + static_cast<int>(home);
      const auto sent = sent_there_.find(rank);
      return (*ranks_)[static_cast<std::size_t>(rank)].waiting +
             (sent == sent_there_.end() ? 0 : sent->second);
    };
    chosen += static_cast<int>(waiting(other) < waiting(one) ? other : one);
    sent_there_[chosen] += static_cast<std::int64_t>(rays);
  }
  return chosen;
}

void Scheduler::sent(std::uint64_t rays, double now_s) {
  outgoing_ -= rays;
  last_sent_s_ = now_s;
}

void Scheduler::ranks_told(std::shared_ptr<const std::vector<RankReport>> by_rank) {
  ranks_ = std::move(by_rank);
  sent_there_.clear();
}

RoundSums Scheduler::contribution() {
  RoundSums mine;
  const bool wants = wants_to_generate();
  // A slow rank would else keep more and more of what all may generate. And where ranks share domains one
  // that has much to trace would make as many rays as one that waits for some, and trace those itself.
  const bool has_enough = homes_overlap_ && waiting_ > even_share();
  asked_ = wants && allowance_ < even_share() && !has_enough;
  mine.born = static_cast<std::int64_t>(born_);
  mine.died = static_cast<std::int64_t>(died_);
  mine.wanting = asked_;
  mine.full = is_full();
  mine.reserved = static_cast<std::int64_t>(rays_in_hand_ + (wants ? allowance_ : 0));
  mine.quiet = in_hand_ == 0 && !wants;
  mine.items_done = static_cast<std::int64_t>(next_item_ - std::min(next_item_, in_hand_));
  mine.domain_loads = static_cast<std::int64_t>(residency_.loads());
  mine.idle = is_idle();
  return mine;
}

RankReport Scheduler::report() const {
  return {static_cast<std::int64_t>(waiting_),
          static_cast<std::int64_t>(residency_.loads() - residency_.evictions()),
          is_idle() ? -1 : static_cast<std::int64_t>(spare_items())};
}

std::uint64_t Scheduler::leaving(std::uint32_t domain, const Homes& homes) const {
  const std::uint64_t waiting = residency_.waiting(domain);
  if (!homes.has(domain, job_.rank)) return waiting;
  return waiting - waiting / static_cast<std::uint64_t>(homes.last(domain) - homes.first(domain) + 1);
}

void Scheduler::leave(std::uint32_t domain, std::uint64_t rays) {
  begin_batch(domain, rays);
  goes_out(rays);
}

LoadStep Scheduler::settle(Homes homes, std::uint64_t domain_bytes) {
  LoadStep step = residency_.settle(std::move(homes), domain_bytes, job_.rank);
  homes_overlap_ = residency_.homes().places() > residency_.homes().domains();
  resume();
  return step;
}

Scheduler::Decision Scheduler::decide(const RoundSums& sums) {
  const std::int64_t alive = sums.born - sums.died;
  // Twice in a row nothing was alive and nothing new was born in between: then nothing was alive at one
  // moment between the two rounds, and nothing can begin (Mattern 1987, the four-counter method).
  const bool calm = alive == 0 && sums.quiet == job_.ranks;
  const bool over = calm && calm_ && sums.born == born_then_;
  calm_ = calm;
  born_then_ = sums.born;
  alive_ = static_cast<std::uint64_t>(std::max<std::int64_t>(0, alive));
  idle_ranks_ = sums.idle;
  paused_ = sums.pause + sums.interrupted + sums.terminated + sums.time_is_up + sums.settles > 0;
  // What is free is shared by those that asked for some; who wants none gives back what it had.
  if (!wants_to_generate()) {
    allowance_ = 0;
  } else if (asked_ && sums.full == 0) {
    const std::int64_t allowed = std::max<std::int64_t>(job_.rays_allowed, job_.ranks);
    allowance_ +=
        static_cast<std::uint64_t>(std::max<std::int64_t>(0, allowed - alive - sums.reserved) / sums.wanting);
  }
  return over ? Decision::all_quiet : Decision::go_on;
}

}  // namespace vitrail
