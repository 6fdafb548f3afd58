// SPDX-License-Identifier: Apache-2.0
#include "farm/files/output_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <csignal>
#include <fstream>
#include <iterator>
#include <optional>
#include <vector>

#include "scene/system/diagnostics.h"
#include "tests/farm/machine_limits.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::output_lock_test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string name_of(pid_t process) {
  std::array<char, 128> host{};
  ::gethostname(host.data(), host.size() - 1);
  return fmt::format("process {} on {}", process, host.data());
}

class TheOutputLock : public ::testing::Test {
 protected:
  std::string text() const {
    std::ifstream in(lock_);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void write(const std::string& who) const { std::ofstream(lock_) << who; }
  // What it says where it is refused; "" where it is not.
  std::string refusal() const {
    try {
      const OutputLock taken(output_);
    } catch (const MachineError& refused) {
      return refused.what();
    }
    return {};
  }
  // A process that has the lock until it is killed.
  pid_t start_holder() const {
    std::array<int, 2> ready{};
    EXPECT_EQ(::pipe(ready.data()), 0);
    const pid_t holder = start_child([&] {
      const OutputLock held(output_);
      EXPECT_EQ(::write(ready[1], "r", 1), 1);
      for (;;) ::pause();
    });
    char byte = 0;
    EXPECT_EQ(::read(ready[0], &byte, 1), 1);
    for (const int end : ready) ::close(end);
    return holder;
  }

  const TemporaryDirectory folder_;
  const fs::path output_ = folder_ / "a.film", lock_ = folder_ / "a.film.lock";
};

TEST_F(TheOutputLock, NamesItsHolderAndGoesWithIt) {
  {
    const OutputLock held(output_);
    EXPECT_EQ(text(), name_of(::getpid()));
  }
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(TheOutputLock, HasOneHolder) {
  std::optional<OutputLock> held(output_);
  EXPECT_THAT(refusal(), AllOf(StartsWith(output_.string()), HasSubstr(name_of(::getpid()))));
  in_child([&] { EXPECT_THAT(refusal(), HasSubstr(name_of(::getppid()))); });
  EXPECT_EQ(text(), name_of(::getpid())) << "whoever is refused leaves it as it is";
  const OutputLock another(folder_ / "b.film");
  held.reset();
  EXPECT_EQ(refusal(), "");
}

TEST_F(TheOutputLock, IsFreedByTheSystemHoweverItsHolderEnds) {
  for (const int signal : {SIGKILL, SIGSEGV, SIGTERM}) {
    const pid_t holder = start_holder();
    EXPECT_THAT(refusal(), HasSubstr(name_of(holder)));
    EXPECT_TRUE(is_being_written(output_));
    ::kill(holder, signal);
    siginfo_t ended{};
    ::waitid(P_PID, static_cast<id_t>(holder), &ended, WEXITED | WNOWAIT);
    EXPECT_FALSE(is_being_written(output_)) << "it has ended, though its parent has not waited for it";
    EXPECT_EQ(text(), name_of(holder)) << "the file stays";
    EXPECT_EQ(refusal(), "") << signal;
    wait_for(holder);
    EXPECT_FALSE(fs::exists(lock_));
  }
}

TEST_F(TheOutputLock, TakesWhatAnEarlierHolderLeft) {
  const std::string longer(1000, 'x');
  for (const std::string& left : {std::string(), std::string("process 1 on elsewhere"), longer}) {
    write(left);
    const OutputLock held(output_);
    EXPECT_EQ(text(), name_of(::getpid()));
  }
}

// Holders remove the file: one that was opened before and locked after that is no lock.
TEST_F(TheOutputLock, HasOneHolderAtATimeWhereManyWantIt) {
  const fs::path marker = folder_ / "held";
  std::vector<pid_t> children;
  for (int i = 0; i < 4; ++i)
    children.push_back(start_child([&] {
      for (int held = 0; held < 300;) {
        try {
          const OutputLock lock(output_);
          ++held;
          const int alone = ::open(marker.c_str(), O_CREAT | O_EXCL | O_CLOEXEC, 0600);
          ASSERT_GE(alone, 0) << "another has it too";
          ::close(alone);
          ::unlink(marker.c_str());
        } catch (const MachineError&) {
        }
      }
    }));
  for (const pid_t child : children) EXPECT_EQ(wait_for(child), 0);
}

TEST_F(TheOutputLock, HoldsOnAFullDisk) {
  const LimitedFiles full(0);
  {
    const OutputLock held(output_);
    EXPECT_EQ(text(), "");
    EXPECT_THAT(refusal(), HasSubstr("another process"));
  }
  EXPECT_FALSE(fs::exists(lock_));
}

TEST_F(TheOutputLock, NeedsItsFolder) {
  const fs::path nowhere = folder_ / "missing" / "a.film";
  EXPECT_THROW(OutputLock lock(nowhere), MachineError);
  EXPECT_FALSE(is_being_written(nowhere));
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(TheOutputLock, BelievesWhatItCannotKnow) {
  EXPECT_FALSE(is_being_written(output_));
  const pid_t ended = start_child([] {});
  wait_for(ended);
  const std::string host = name_of(1).substr(sizeof "process 1 on " - 1);
  for (const auto& [who, lives] : {std::pair(std::string(), false),
                                   {"not a process", false},
                                   {"process 1 on another-" + host, true},
                                   {name_of(ended), false},
                                   {name_of(::getppid()), true}}) {
    write(who);
    EXPECT_EQ(is_being_written(output_), lives) << who;
    EXPECT_EQ(text(), who) << "it is looked at alone";
  }
}

}  // namespace
}  // namespace vitrail::test::output_lock_test
