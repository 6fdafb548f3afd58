// SPDX-License-Identifier: Apache-2.0
// Rounds go up a tree of ranks and down again, so that a rank speaks with five others at most, however many
// there are. MPI_Iallgather connects everybody with everybody.
#pragma once

// OMPI_SKIP_MPICXX leaves the C interface only.
#define OMPI_SKIP_MPICXX 1
#include <mpi.h>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "farm/scheduler/round.h"

namespace vitrail {

// It is a rank's place: it gathers for the ranks [rank, end). Ranks side by side, often of one node, are
// near.
struct TreePlace {
  static constexpr int most_children = 4;
  int parent = -1;  // −1: none
  int end = 1;
  std::vector<int> children{};  // ascending; each gathers for the ranks up to the next one, or `end`
};
// Returns the place of `rank` in the tree of ranks 0 … ranks − 1.
TreePlace place_in_tree(int rank, int ranks);

// It holds one round at a time, as Transport has them.
class RoundTree {
 public:
  RoundTree(int rank, int ranks);

  void start(const RoundSums& mine, const RankReport& report);
  std::optional<Round> finish();

 private:
  // They are sums, then a report a rank.
  using Numbers = std::vector<std::int64_t>;
  enum class Step : std::uint8_t { gathers, hears, tells };

  void add_children();
  Round told() const;

  int rank_;
  TreePlace place_;
  Step step_ = Step::gathers;
  Numbers part_;                // of the ranks that this one gathers for
  std::vector<Numbers> parts_;  // of each child
  Numbers all_;                 // what comes down
  std::array<MPI_Request, 2> with_parent_{MPI_REQUEST_NULL, MPI_REQUEST_NULL};
  std::vector<MPI_Request> with_children_;
};

}  // namespace vitrail
