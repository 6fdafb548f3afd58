// SPDX-License-Identifier: Apache-2.0
// An Exchange moves what ranks send each other while they trace: rays, photons that landed, questions, items.
#pragma once

#include <vector>

#include "farm/rays/parcel.h"
#include "farm/run/phases.h"
#include "farm/run/rank_state.h"
#include "farm/transport/transport.h"

namespace vitrail {

class Exchange {
 public:
  // The transport may hold `most_sent_bytes`; what is more stays in the state's queues.
  Exchange(Transport& transport, RankState& state, const Phases& phases, std::uint64_t most_sent_bytes);

  // Takes what has arrived and sends what waits for other ranks. Returns whether anything moved. What goes
  // wrong is left in the state: the others learn of it in the next round.
  bool move();
  // Sends idle ranks some of the items that this rank has to spare.
  void give_items();
  // Throws away what arrives, after a failure.
  void drop_arrivals();

  std::uint64_t messages() const { return messages_; }  // sent
  std::uint64_t received() const { return received_; }  // messages
  std::uint64_t sent_bytes() const { return sent_bytes_; }

 private:
  bool receive_all();
  bool send_waiting();
  std::vector<RayBatch> take_outgoing(const Locked& locked);
  int destination(const RayBatch& batch);
  void send(std::vector<RayBatch> batches);
  void send(int to, Parcel parcel, std::int64_t rays);
  bool may_come(RayBatch& batch) const;
  void take_in(RayBatch batch);
  void take_items(const Locked& locked, RayBatch& batch);

  Transport& transport_;
  RankState& state_;
  const Phases& phases_;
  std::uint64_t most_sent_bytes_;
  std::uint32_t sent_from_ = 0;  // the domain that is looked at first when rays are sent
  std::uint64_t messages_ = 0, received_ = 0, sent_bytes_ = 0;
};

}  // namespace vitrail
