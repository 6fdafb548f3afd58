// SPDX-License-Identifier: Apache-2.0
// `partition --memory B` of scenes in which other things than meshes are many: never more than B is resident;
// what does not fit is refused, and the message says what is missing.
#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "tests/extremes/memory_scenes.h"
#include "tests/support/long_tests.h"
#include "tests/support/paths.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::memory_test {
namespace {

struct Done {
  int status = -1;
  std::uint64_t peak_bytes = 0;
  double seconds = 0;
  std::string output;
};

Done run(const std::string& command, const std::filesystem::path& output) {
  const auto begin = std::chrono::steady_clock::now();
  const pid_t pid = ::fork();
  if (pid == 0) {
    ::execl("/bin/sh", "sh", "-c", fmt::format("exec {} >'{}' 2>&1", command, output.string()).c_str(),
            nullptr);
    ::_exit(127);
  }
  int status = 0;
  rusage usage{};
  ::wait4(pid, &status, 0, &usage);
  std::ifstream in(output);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
          static_cast<std::uint64_t>(usage.ru_maxrss) * 1024,
          std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(),
          {std::istreambuf_iterator<char>(in), {}}};
}

bool run_whole() { return std::getenv("VITRAIL_EXTREMES_WHOLE") != nullptr; }

class Memory : public ::testing::TestWithParam<MemoryRow> {};

TEST_P(Memory, IsKeptOrRefused) {
  const MemoryRow& row = GetParam();
  const TemporaryDirectory directory;
  // A 32nd of the things, and of the memory that is not the program's own; with VITRAIL_LONG_TESTS a
  // sixteenth.
  const std::uint64_t program = (row.images ? 172u : 40u) << 20;
  const std::uint64_t part = run_whole() ? 1 : of_all(16u, 32u);
  const std::uint64_t budget = run_whole() ? row.budget_bytes : program + row.budget_bytes / part;
  const auto scene = row.write(directory.path(), 1.0 / static_cast<double>(part));
  const Done done =
      run(fmt::format("'{}/vitrail-partition' '{}' -o '{}' --no-sync --quiet --memory {} {}", bin_dir(),
                      scene.string(), (directory / "out.vit").string(), budget, row.options),
          directory / "output");
  fmt::print("{:20} budget {:4} MiB, peak {:6.1f} MiB, {:5.1f} s, status {}: {}\n", row.what, budget >> 20,
             static_cast<double>(done.peak_bytes) / (1 << 20), done.seconds, done.status,
             done.status == 0 ? "" : done.output.substr(0, done.output.find('\n')));
  EXPECT_LE(done.peak_bytes, budget);
  EXPECT_THAT(done.status, ::testing::AnyOf(0, 4)) << done.output;
  if (done.status == 4) {
    EXPECT_THAT(done.output, ::testing::HasSubstr("try --memory ")) << done.output;
  }
  EXPECT_EQ(std::filesystem::exists(directory / "out.vit"), done.status == 0);
}

std::string name_of(const ::testing::TestParamInfo<MemoryRow>& row) { return row.param.what; }

INSTANTIATE_TEST_SUITE_P(Records, Memory, ::testing::ValuesIn(memory_record_rows()), name_of);
INSTANTIATE_TEST_SUITE_P(Files, Memory, ::testing::ValuesIn(memory_file_rows()), name_of);

}  // namespace
}  // namespace vitrail::test::memory_test
