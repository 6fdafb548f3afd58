// SPDX-License-Identifier: Apache-2.0
// Rounds and nothing else: `mpirun -n RANKS cluster_rounds COUNT`. Each rank checks what every round tells
// it. Rank 0 prints, of all ranks, the most sockets that are open and the mean processor time of a round in
// µs.
#include <fmt/format.h>
#include <sys/resource.h>
#include <time.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include "farm/transport/transport.h"

namespace vitrail {
namespace {

std::int64_t open_sockets() {
  std::int64_t count = 0;
  std::error_code gone;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd"))
    count += std::filesystem::read_symlink(entry.path(), gone).string().starts_with("socket:");
  return count;
}

double cpu_us() {
  timespec t{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return 1e6 * static_cast<double>(t.tv_sec) + 1e-3 * static_cast<double>(t.tv_nsec);
}

// A number that no other rank or round has.
std::int64_t number_of(std::int64_t round, std::int64_t rank) { return round * 100'003 + rank; }

bool tells_all(const Round& told, std::int64_t round, int ranks) {
  if (told.ranks.size() != static_cast<std::size_t>(ranks)) return false;
  std::int64_t born = 0;
  for (std::int64_t rank = 0; rank < ranks; ++rank) {
    const RankReport& report = told.ranks[static_cast<std::size_t>(rank)];
    if (report.waiting != number_of(round, rank) || report.resident != rank || report.items != -round)
      return false;
    born += number_of(round, rank);
  }
  return told.sums.born == born && told.sums.working == ranks && told.sums.died == 0;
}

int run(Transport& transport, std::int64_t rounds) {
  const int ranks = transport.size(), rank = transport.rank();
  double begun_us = 0;
  constexpr std::int64_t first_ones = 10;  // in which ranks connect
  for (std::int64_t round = 0; round < rounds + first_ones; ++round) {
    if (round == first_ones) begun_us = cpu_us();
    RoundSums mine;
    mine.born = number_of(round, rank);
    mine.working = 1;
    transport.start_round(mine, {number_of(round, rank), rank, -round});
    std::optional<Round> told;
    while (!(told = transport.finish_round())) std::this_thread::sleep_for(std::chrono::microseconds(50));
    if (!tells_all(*told, round, ranks)) {
      fmt::print(stderr, "rank {}: round {} tells something else\n", rank, round);
      transport.abandon(1);
    }
  }
  const double us = (cpu_us() - begun_us) / static_cast<double>(std::max<std::int64_t>(rounds, 1));
  std::array<std::int64_t, 1> most{open_sockets()};
  transport.max_to_root(most);
  std::array<double, 1> sum{us};
  transport.sum_to_root(sum);
  rlimit files{};
  ::getrlimit(RLIMIT_NOFILE, &files);
  if (rank == 0)
    fmt::print("{{\"ranks\": {}, \"sockets\": {}, \"us\": {:.1f}, \"files\": {}}}\n", ranks, most[0],
               sum[0] / ranks, files.rlim_cur);
  transport.leave();
  return 0;
}

}  // namespace
}  // namespace vitrail

int main(int argc, char** argv) {
  const std::int64_t rounds = argc > 1 ? std::atoll(argv[1]) : 100;
  const auto transport = vitrail::make_transport(&argc, &argv);
  return vitrail::run(*transport, rounds);
}
