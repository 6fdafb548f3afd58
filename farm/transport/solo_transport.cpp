// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

#include "farm/transport/transport.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

class SoloTransport final : public Transport {
 public:
  int rank() const override { return 0; }
  int size() const override { return 1; }
  void send(int, std::vector<std::byte>) override { throw std::logic_error("a single rank sent rays"); }
  std::uint64_t sending_bytes() override { return 0; }
  std::optional<Message> receive() override { return std::nullopt; }
  void start_round(const RoundSums& mine, const RankReport& report) override { round_ = {mine, {report}}; }
  std::optional<Round> finish_round() override { return round_; }
  void say(int, Word) override {}
  std::optional<std::pair<int, Word>> hear() override { return std::nullopt; }
  void abandon(int status) override { std::_Exit(status); }
  void leave() override {}
  void sum_to_root(std::span<std::int64_t>) override {}
  void sum_to_root(std::span<std::uint32_t>) override {}
  void sum_to_root(std::span<double>) override {}
  void sum_to_root(std::span<WideSum>) override {}
  void sum_to_root(std::span<MattePixel>) override {}
  void max_to_root(std::span<std::int64_t>) override {}
  void broadcast_from_root(std::span<std::uint64_t>) override {}
  void broadcast_from_root(std::span<std::uint32_t>) override {}

 private:
  Round round_;
};

}  // namespace

bool launched_by_mpi() {
  constexpr const char* launchers[] = {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"};
  return std::ranges::any_of(launchers, [](const char* name) { return std::getenv(name) != nullptr; });
}

namespace {

// 0 where it is not set.
int number(const char* variable) {
  const char* text = std::getenv(variable);
  return text ? std::atoi(text) : 0;
}

// By the environment that a launcher leaves, how many processes it started at least.
int processes_of_launcher() {
  // mpirun's ranks are not the tasks of srun that it may run under.
  if (const int ranks = number("OMPI_COMM_WORLD_SIZE")) return ranks;
  int processes = 1;
  // MPICH and Intel MPI (Hydra), MVAPICH; the last two are of one host.
  for (const char* size : {"PMI_SIZE", "MV2_COMM_WORLD_SIZE", "MPI_LOCALNRANKS", "MV2_COMM_WORLD_LOCAL_SIZE"})
    processes = std::max(processes, number(size));
  // Hydra's -pmi-port and PMIx tell no size.
  for (const char* rank : {"PMI_RANK", "PMI_ID", "PMIX_RANK"})
    processes = std::max(processes, number(rank) + 1);
  return processes;
}

// Of one process that was started with others and does not know of them.
void require_no_others() {
  if (const int tasks = number("SLURM_STEP_NUM_TASKS"); tasks > 1 && !std::getenv("OMPI_COMM_WORLD_SIZE"))
    throw UsageError(fmt::format(
        "srun started {} tasks that do not know of each other, and each would render everything: start the "
        "ranks with mpirun, or with srun --mpi=pmix where Slurm and Open MPI have it",
        tasks));
  if (const int processes = processes_of_launcher(); processes > 1)
    throw UsageError(
        fmt::format("the launcher of another MPI started {} processes that do not know of each other, and "
                    "each would render everything: this program is built with {}, start the ranks with its "
                    "mpirun",
                    processes, name_of_mpi()));
}

}  // namespace

std::unique_ptr<Transport> make_transport(int* argc, char*** argv) {
  std::unique_ptr<Transport> made;
  if (launched_by_mpi())
    made = make_mpi_transport(argc, argv);
  else
    made = std::make_unique<SoloTransport>();
  if (made->size() == 1) require_no_others();
  return made;
}

}  // namespace vitrail
