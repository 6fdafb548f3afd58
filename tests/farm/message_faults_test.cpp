// SPDX-License-Identifier: Apache-2.0
// Ranks on a network that delays, overtakes, splits and loses messages.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "film/film_progress.h"
#include "tests/support/partitioned_box.h"

namespace vitrail::test::message_faults_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class MessageFaults : public PartitionedBox {
 protected:
  MessageFaults() : PartitionedBox(8) {}
  // Every ray that leaves a rank's domains is sent.
  std::string arguments(const std::string& out) const {
    return fmt::format(" '{}' -o '{}' --crop 0,64,0,64 --spp 16 --threads 1 --quiet --distribution decompose",
                       path("box.vit"), path(out));
  }
  std::string faulty(const std::string& faults, int ranks, const std::string& out) const {
    return fmt::format("LD_PRELOAD='{}' VITRAIL_MESSAGE_FAULTS='{}' {}{}", VITRAIL_MESSAGE_FAULTS, faults,
                       mpi_vitrail("render", ranks), arguments(out));
  }
  std::uint64_t hash(const std::string& film) const { return read_film(path(film), nullptr).hash(); }
};

TEST_F(MessageFaults, DelaysAndOvertakingChangeNothing) {
  ASSERT_EQ(run(vitrail("render") + arguments("whole.film")).status, 0);
  for (int seed = 1; seed <= 3; ++seed) {
    const std::string film = fmt::format("{}.film", seed);
    const CommandResult made = run(faulty(fmt::format("{} {}", seed, 20), seed + 1, film));
    ASSERT_EQ(made.status, 0) << made.output;
    EXPECT_EQ(hash(film), hash("whole.film"));
  }
}

// Its head came. The rank that it is for goes on to answer, so nobody is named who is well.
TEST_F(MessageFaults, AMessageThatNeverComesWholeEndsTheJob) {
  for (int rank = 0; rank < 3; ++rank) {
    const CommandResult ended = run(faulty(fmt::format("1 1 {} 5", rank), 3, "a.film") + " --patience 3");
    EXPECT_EQ(ended.status, 4) << ended.output;
    EXPECT_THAT(ended.output, HasSubstr("no rank has had work for 3 s")) << rank;
    EXPECT_THAT(ended.output, Not(HasSubstr("not answered"))) << rank;
    EXPECT_THAT(ended.output, Not(HasSubstr("not gone on"))) << rank;
  }
}

}  // namespace
}  // namespace vitrail::test::message_faults_test
