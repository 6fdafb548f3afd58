// SPDX-License-Identifier: Apache-2.0
#include "farm/transport/list_to_root.h"

namespace vitrail {

std::vector<std::int64_t> list_to_root(Transport& transport, int rank, std::vector<std::int64_t> mine) {
  if (transport.rank() != rank) mine.clear();
  std::int64_t counted[] = {static_cast<std::int64_t>(mine.size())};
  transport.sum_to_root(std::span(counted));
  std::uint64_t size[] = {static_cast<std::uint64_t>(counted[0])};
  transport.broadcast_from_root(std::span(size));
  mine.resize(size[0]);
  transport.sum_to_root(std::span(mine));
  if (transport.rank() != 0) mine.clear();
  return mine;
}

}  // namespace vitrail
