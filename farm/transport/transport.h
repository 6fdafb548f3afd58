// SPDX-License-Identifier: Apache-2.0
// Ranks reach each other through a transport. One implementation speaks MPI, the other is a rank alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "farm/scheduler/round.h"
#include "film/mattes.h"
#include "film/wide_sum.h"

namespace vitrail {

// Ranks speak through it: messages, rounds of sums, words.
class Transport {
 public:
  virtual ~Transport() = default;
  // They return this rank, 0 … size() − 1, and how many ranks there are.
  virtual int rank() const = 0;
  virtual int size() const = 0;

  // None of these waits.
  virtual void send(int to, std::vector<std::byte> message) = 0;
  virtual std::uint64_t sending_bytes() = 0;  // that no receiver has taken over yet
  // It is a message that another rank sent.
  struct Message {
    int from = 0;
    std::vector<std::byte> bytes;
  };
  virtual std::optional<Message> receive() = 0;
  // Joins the next round; one at a time. `finish_round` returns its sums and reports once every rank has
  // joined.
  virtual void start_round(const RoundSums& mine, const RankReport& report) = 0;
  virtual std::optional<Round> finish_round() = 0;

  // It is said beside rays and rounds; `hear` returns who said it. A word that nobody hears is lost without
  // harm.
  enum class Word : std::uint8_t { are_you_there, here, failed };
  virtual void say(int to, Word word) = 0;
  virtual std::optional<std::pair<int, Word>> hear() = 0;
  // Ends all ranks at once, however they are, with this status.
  [[noreturn]] virtual void abandon(int status) = 0;

  // It is called again and again while the functions below wait, so that messages are heard. Callers that
  // wait for a round or for work call it too.
  std::function<void()> while_waiting;
  void goes_on() const {
    if (while_waiting) while_waiting();
  }

  // Waits until all ranks have come to it; nothing but the end follows.
  virtual void leave() = 0;

  // These wait for all ranks; they are called when no ray is alive. The first ones make elementwise sums, or
  // maxima, in rank 0's buffer; the others' become zero.
  virtual void sum_to_root(std::span<std::int64_t> values) = 0;
  virtual void sum_to_root(std::span<std::uint32_t> values) = 0;
  virtual void sum_to_root(std::span<double> values) = 0;
  virtual void sum_to_root(std::span<WideSum> values) = 0;
  virtual void sum_to_root(std::span<MattePixel> values) = 0;
  virtual void max_to_root(std::span<std::int64_t> values) = 0;
  virtual void broadcast_from_root(std::span<std::uint64_t> values) = 0;
  virtual void broadcast_from_root(std::span<std::uint32_t> values) = 0;
};

// Returns a transport that speaks MPI when launched by mpirun or srun, else alone. Throws UsageError where
// srun, or the mpiexec of another MPI, started several processes that do not know of each other.
std::unique_ptr<Transport> make_transport(int* argc, char*** argv);
bool launched_by_mpi();
// Returns "Open MPI" or the name of another MPI that this program is built with.
const char* name_of_mpi();
std::unique_ptr<Transport> make_mpi_transport(int* argc, char*** argv);

}  // namespace vitrail
