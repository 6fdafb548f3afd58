// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdlib>
#include <stdexcept>

#include "farm/transport.h"

namespace vitrail {

namespace {

class SoloTransport final : public Transport {
 public:
  int rank() const override { return 0; }
  int size() const override { return 1; }
  void send(int, RayBatch) override { throw std::logic_error("a single rank sent rays"); }
  std::optional<RayBatch> receive() override { return std::nullopt; }
  void start_round(const RoundSums& mine) override { round_ = mine; }
  std::optional<RoundSums> finish_round() override { return round_; }
  void sum_to_root(std::span<std::int64_t>) override {}
  void sum_to_root(std::span<std::uint32_t>) override {}
  void sum_to_root(std::span<double>) override {}
  void sum_to_root(std::span<WideSum>) override {}
  void max_to_root(std::span<std::int64_t>) override {}
  void broadcast_from_root(std::span<std::uint64_t>) override {}
  void broadcast_from_root(std::span<std::uint32_t>) override {}

 private:
  RoundSums round_;
};

}  // namespace

bool launched_by_mpi() {
  constexpr const char* launchers[] = {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"};
  return std::ranges::any_of(launchers, [](const char* name) { return std::getenv(name) != nullptr; });
}

std::unique_ptr<Transport> make_transport(int* argc, char*** argv) {
  if (launched_by_mpi()) return make_mpi_transport(argc, argv);
  return std::make_unique<SoloTransport>();
}

}  // namespace vitrail
