// SPDX-License-Identifier: Apache-2.0
// One sum over all ranks and nothing else: `mpirun -n RANKS cluster_reduction MIB`. Each rank checks what it
// has then. Rank 0 prints what memory it took beside its own sums, and the seconds.
#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <vector>

#include "farm/transport/transport.h"
#include "scene/system/resource_usage.h"

namespace vitrail {
namespace {

int run(Transport& transport, std::size_t mib) {
  const auto rank = static_cast<std::size_t>(transport.rank()),
             ranks = static_cast<std::size_t>(transport.size());
  std::vector<std::int64_t> values((mib << 20) / sizeof(std::int64_t));
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<std::int64_t>(i * 7 + rank);
  std::int64_t together = 0;  // all begin at once
  transport.sum_to_root(std::span(&together, 1));
  const std::uint64_t before = resident_bytes();
  const auto begun = std::chrono::steady_clock::now();
  transport.sum_to_root(std::span(values));
  const double s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  bool right = true;
  for (std::size_t i = 0; i < values.size(); ++i)
    right &=
        values[i] == (rank == 0 ? static_cast<std::int64_t>(i * 7 * ranks + ranks * (ranks - 1) / 2) : 0);
  if (!right) {
    fmt::print(stderr, "rank {}: the sums are wrong\n", rank);
    transport.abandon(1);
  }
  if (rank == 0)
    fmt::print("{{\"beside_mib\": {:.1f}, \"s\": {:.3f}}}\n",
               static_cast<double>(peak_resident_bytes() - before) / (1 << 20), s);
  transport.leave();
  return 0;
}

}  // namespace
}  // namespace vitrail

int main(int argc, char** argv) {
  const std::size_t mib = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 64;
  const auto transport = vitrail::make_transport(&argc, &argv);
  return vitrail::run(*transport, mib);
}
