// SPDX-License-Identifier: Apache-2.0
// One sum over all ranks and nothing else: `mpirun -n RANKS cluster_reduction MIB [film]`. Each rank checks
// what it has then. Rank 0 prints what memory it took beside its own sums, and the seconds. `film`: sums of a
// film, of which each rank has touched its share of the pages.
#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <vector>

#include "farm/transport/transport.h"
#include "film/untouched.h"
#include "scene/system/resource_usage.h"

namespace vitrail {
namespace {

template <class Values, class Right>
int add_up(Transport& transport, Values& values, Right&& right) {
  std::int64_t together = 0;  // all begin at once
  transport.sum_to_root(std::span(&together, 1));
  const std::uint64_t before = resident_bytes();
  const auto begun = std::chrono::steady_clock::now();
  transport.sum_to_root(std::span(values));
  const double s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!(values[i] == right(i))) {
      fmt::print(stderr, "rank {}: the sums are wrong\n", transport.rank());
      transport.abandon(1);
    }
  if (transport.rank() == 0)
    fmt::print("{{\"beside_mib\": {:.1f}, \"s\": {:.3f}}}\n",
               static_cast<double>(peak_resident_bytes() - before) / (1 << 20), s);
  transport.leave();
  return 0;
}

int run_numbers(Transport& transport, std::size_t mib) {
  const auto rank = static_cast<std::size_t>(transport.rank()),
             ranks = static_cast<std::size_t>(transport.size());
  std::vector<std::int64_t> values((mib << 20) / sizeof(std::int64_t));
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<std::int64_t>(i * 7 + rank);
  return add_up(transport, values, [&](std::size_t i) {
    return rank == 0 ? static_cast<std::int64_t>(i * 7 * ranks + ranks * (ranks - 1) / 2) : 0;
  });
}

int run_film(Transport& transport, std::size_t mib) {
  constexpr std::size_t together = 1000;  // sums that one rank has
  const auto rank = static_cast<std::size_t>(transport.rank()),
             ranks = static_cast<std::size_t>(transport.size());
  UntouchedVector<WideSum> values((mib << 20) / sizeof(WideSum));
  const auto value = [](std::size_t i) { return WideSum{~i, i}; };
  for (std::size_t i = 0; i < values.size(); ++i)
    if (i / together % ranks == rank) values[i] = value(i);
  return add_up(transport, values, [&](std::size_t i) { return rank == 0 ? value(i) : WideSum{}; });
}

}  // namespace
}  // namespace vitrail

int main(int argc, char** argv) {
  const std::size_t mib = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 64;
  const auto transport = vitrail::make_transport(&argc, &argv);
  return argc > 2 ? vitrail::run_film(*transport, mib) : vitrail::run_numbers(*transport, mib);
}
