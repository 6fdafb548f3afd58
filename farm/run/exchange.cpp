// SPDX-License-Identifier: Apache-2.0
#include "farm/run/exchange.h"

#include <algorithm>
#include <map>

#include "scene/system/diagnostics.h"

namespace vitrail {

using Clock = RankState::Clock;

Exchange::Exchange(Transport& transport, RankState& state, const Phases& phases,
                   std::uint64_t most_sent_bytes)
    : transport_(transport), state_(state), phases_(phases), most_sent_bytes_(most_sent_bytes) {}

bool Exchange::move() {
  if (transport_.size() == 1) return false;
  try {
    const bool came = receive_all();
    return send_waiting() || came;
  } catch (...) {
    fail(state_, std::current_exception());
    return false;
  }
}

bool Exchange::receive_all() {
  bool any = false;
  while (const auto message = transport_.receive()) {
    const auto begin = Clock::now();
    ++received_;
    any = true;
    std::size_t rays = 0;
    for (RayBatch& batch : unpack(message->bytes, state_.scene.manifest.domains.size())) {
      rays += batch.count();
      if (!may_come(batch)) throw MachineError("a message came that holds no rays for a domain of this rank");
      take_in(std::move(batch));
    }
    note(state_, Timeline::Kind::receive, begin,
         {message->from, static_cast<std::int64_t>(message->bytes.size()), static_cast<std::int64_t>(rays)});
  }
  return any;
}

void Exchange::drop_arrivals() {
  while (transport_.receive()) ++received_;
}

bool Exchange::send_waiting() {
  std::vector<RayBatch> batches;
  {
    const Locked locked(state_);
    if (state_.scheduler.send_is_due(state_.elapsed_s())) batches = take_outgoing(locked);
  }
  if (batches.empty()) return false;
  send(std::move(batches));
  return true;
}

// As much as the transport has room for; it begins where the last time ended, so that none waits for ever.
std::vector<RayBatch> Exchange::take_outgoing(const Locked&) {
  std::vector<RayBatch> batches;
  std::uint64_t bytes = transport_.sending_bytes(), rays = 0;
  const auto domains = static_cast<std::uint32_t>(state_.scene.manifest.domains.size());
  const std::uint32_t first = sent_from_;
  for (std::uint32_t i = 0; i < domains; ++i) {
    const std::uint32_t d = (first + i) % domains;
    while (!state_.outgoing.empty(d)) {
      sent_from_ = d;
      if (bytes >= most_sent_bytes_) break;
      RayBatch& batch = batches.emplace_back(state_.outgoing.pop(d));
      bytes += batch.held_bytes();
      rays += batch.count();
    }
    if (bytes >= most_sent_bytes_) break;
  }
  if (rays > 0) state_.scheduler.sent(rays, state_.elapsed_s());
  return batches;
}

// A message a destination.
void Exchange::send(std::vector<RayBatch> batches) {
  struct Filling {
    Parcel parcel;
    std::int64_t rays = 0;
  };
  std::map<int, Filling> parcels;
  const auto send_parcel = [&](int to, Filling& filling) {
    send(to, std::exchange(filling.parcel, {}), std::exchange(filling.rays, 0));
  };
  for (RayBatch& batch : batches) {
    const int to = destination(batch);
    Filling& filling = parcels[to];
    filling.rays += static_cast<std::int64_t>(batch.count());
    filling.parcel.add(std::exchange(batch, {}));
    if (filling.parcel.full()) send_parcel(to, filling);
  }
  for (auto& [to, filling] : parcels)
    if (!filling.parcel.empty()) send_parcel(to, filling);
}

void Exchange::send(int to, Parcel parcel, std::int64_t rays) {
  const auto begin = Clock::now();
  std::vector<std::byte> message = parcel.take();
  const auto bytes = static_cast<std::int64_t>(message.size());
  ++messages_;
  sent_bytes_ += message.size();
  transport_.send(to, std::move(message));
  note(state_, Timeline::Kind::send, begin, {to, bytes, rays});
}

// What photons land at and paths ask them for has one place.
int Exchange::destination(const RayBatch& batch) {
  if (!is_ray(batch.kind())) return state_.scheduler.residency().homes().first(batch.domain());
  const Locked locked(state_);
  return state_.scheduler.destination(batch.domain(), batch.count());
}

// The last ones that it has, so that the picture goes on evenly.
void Exchange::give_items() {
  std::vector<std::pair<int, RayBatch>> given;
  {
    const Locked locked(state_);
    for (const auto& [to, items] : state_.scheduler.give_items()) {
      std::vector<std::uint64_t>& mine = state_.share.items;
      const auto first = mine.begin(), end = first + static_cast<std::ptrdiff_t>(items);
      RayBatch& batch = given.emplace_back(to, RayBatch(0, RayKind::item)).second;
      std::for_each(first, end, [&](std::uint64_t item) { batch.append(item); });
      mine.erase(first, end);
    }
  }
  for (const auto& [to, batch] : given) {
    Parcel parcel;
    parcel.add(batch);
    send(to, std::move(parcel), 0);
  }
}

// Nothing but what ranks send each other. Rays may be on their way to a home that the domain had before.
bool Exchange::may_come(RayBatch& batch) const {
  if (batch.kind() == RayKind::item)
    return std::ranges::all_of(batch.records<std::uint64_t>(),
                               [&](std::uint64_t item) { return item < phases_.items(); });
  return is_ray(batch.kind()) ||
         (state_.photons && state_.scheduler.residency().homes().has(batch.domain(), transport_.rank()));
}

void Exchange::take_in(RayBatch batch) {
  const Locked locked(state_);
  switch (batch.kind()) {
    case RayKind::item:
      return take_items(locked, batch);
    case RayKind::landed:
      for (const Photon& photon : batch.records<Photon>()) state_.photons->land(photon);
      state_.scheduler.count(0, batch.count());
      return;
    case RayKind::question:
      state_.photons->questions.push(std::move(batch));
      state_.work_available.notify_one();
      return;
    case RayKind::path:
    case RayKind::shadow:
      (state_.scheduler.arrived(batch.domain(), batch.count()) ? state_.queues : state_.outgoing)
          .push(std::move(batch));
      state_.work_available.notify_one();
      state_.load_wanted.notify_one();
  }
}

void Exchange::take_items(const Locked&, RayBatch& batch) {
  const std::span<std::uint64_t> items = batch.records<std::uint64_t>();
  state_.share.items.insert(state_.share.items.begin(), items.begin(), items.end());
  state_.scheduler.items_arrived(items.size());
  state_.work_available.notify_all();
}

}  // namespace vitrail
