// SPDX-License-Identifier: Apache-2.0
// How jobs are started, ended and started again on a cluster.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>

#include "film/film_progress.h"
#include "tests/support/background.h"
#include "tests/support/partitioned_box.h"
#include "tests/support/paths.h"

namespace vitrail::test::launchers_test {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using ::testing::HasSubstr;

class Launchers : public PartitionedBox {
 protected:
  Launchers() : PartitionedBox(4) {}
  std::string arguments(const std::string& out, const std::string& more = "") const {
    return fmt::format(" '{}' -o '{}' {} {} --threads 1 --checkpoint-every .1 --quiet {}", path("box.vit"),
                       path(out), more.find("--crop") == std::string::npos ? "--crop 0,64,0,64" : "",
                       more.find("--spp") == std::string::npos ? "--spp 256" : "", more);
  }
  // Of a render on two ranks: a signal by mpirun, or to a rank that has to be found, comes late on a busy
  // machine.
  static constexpr const char* long_enough = "--spp 512";
  std::string alone(const std::string& out, const std::string& more = "") const {
    return vitrail("render") + arguments(out, more);
  }
  std::uint64_t hash(const std::string& film) const { return read_film(path(film), nullptr).hash(); }
  // Of the film that nothing happened to, rendered once for all tests.
  std::uint64_t whole_hash(const std::string& more = "") const {
    static std::map<std::string, std::uint64_t> known;
    const auto [it, is_new] = known.try_emplace(more);
    if (is_new) {
      EXPECT_EQ(run(alone("whole.film", more)).status, 0);
      it->second = hash("whole.film");
      fs::remove(path("whole.film"));
    }
    return it->second;
  }
  std::string text(const std::string& file) const {
    std::ifstream in(path(file));
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void wait_for_checkpoint(Background& job, const std::string& film) const {
    while (job.running() && !fs::exists(path(film + ".partial"))) std::this_thread::sleep_for(5ms);
  }
  // Kills a rank after the first checkpoint. False where the job is over.
  bool kill_a_rank(Background& job, const std::string& film) const {
    wait_for_checkpoint(job, film);
    const std::vector<pid_t> ranks = ranks_of(film);
    return job.running() && !ranks.empty() && ::kill(ranks.back(), SIGKILL) == 0;
  }
  // Not their supervisor, whose command line is theirs and more.
  std::vector<pid_t> ranks_of(const std::string& film) const {
    std::istringstream pids(run("pgrep -f '[v]itrail-render .*" + path(film) + "'").output);
    std::vector<pid_t> ranks;
    for (pid_t pid; pids >> pid;)
      if (const std::string line = test::process_text(pid, "cmdline");
          line.starts_with(bin_dir()) && line.find("--restarts") == std::string::npos)
        ranks.push_back(pid);
    return ranks;
  }
};

TEST_F(Launchers, TasksOfSrunThatDoNotKnowOfEachOtherAreRefused) {
  const CommandResult refused = run("SLURM_STEP_NUM_TASKS=4 SLURM_PROCID=2 " + alone("a.film"));
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.output, HasSubstr("srun started 4 tasks that do not know of each other"));
  EXPECT_FALSE(fs::exists(path("a.film")));
  EXPECT_EQ(run("SLURM_STEP_NUM_TASKS=1 SLURM_NTASKS=4 " + alone("a.film", "--crop 0,8,0,8")).status, 0)
      << "in the job's script itself";
}

// As MPICH's, Intel's and MVAPICH's mpiexec leave it to the processes that they start, and Hydra's
// with -pmi-port.
TEST_F(Launchers, RanksOfAnotherMpiAreRefused) {
  for (const char* started : {"PMI_RANK=1 PMI_SIZE=2", "PMI_RANK=0 PMI_SIZE=2 MPI_LOCALNRANKS=2",
                              "MV2_COMM_WORLD_RANK=1 MV2_COMM_WORLD_SIZE=2",
                              "PMI_ID=0 PMI_PORT=vm:4711 MPI_LOCALNRANKS=2", "PMI_ID=1 PMI_PORT=vm:4711"}) {
    const CommandResult refused = run(fmt::format("{} {}", started, alone("a.film")));
    EXPECT_EQ(refused.status, 2) << refused.output;
    EXPECT_THAT(refused.output, HasSubstr("another MPI started 2 processes that do not know of each other"));
    EXPECT_THAT(refused.output, HasSubstr("start the ranks with its mpirun"));
    EXPECT_FALSE(fs::exists(path("a.film")));
  }
  EXPECT_EQ(run("PMI_RANK=0 PMI_SIZE=1 MPI_LOCALNRANKS=1 " + alone("a.film", "--crop 0,8,0,8")).status, 0);
}

TEST_F(Launchers, AJobsMemoryAndTimeAreTaken) {
  const auto in_job = [&](int seconds) {
    const auto end = std::chrono::system_clock::now() + std::chrono::seconds(seconds);
    return fmt::format("SLURM_JOB_ID=7 SLURM_MEM_PER_NODE=4000 SLURM_JOB_END_TIME={} ",
                       std::chrono::system_clock::to_time_t(end));
  };
  std::string line = alone("a.film", fmt::format("--stats '{}'", path("stats.json")));
  const CommandResult made = run(in_job(3600) + line.erase(line.find("--quiet"), 7));
  EXPECT_EQ(made.status, 0) << made.output;
  EXPECT_THAT(made.output, HasSubstr("3600 MiB a rank, as Slurm gives this job"));
  EXPECT_THAT(made.output, HasSubstr("stops with a checkpoint after 35"));
  EXPECT_EQ(read_json(path("stats.json"))["memory_budget_bytes"], 3600u << 20);
  const CommandResult stopped = run(in_job(1) + alone("b.film"));
  EXPECT_EQ(stopped.status, 128 + SIGTERM) << stopped.output;
  EXPECT_TRUE(fs::exists(path("b.film.partial")));
  EXPECT_EQ(run(alone("b.film")).status, 0);
  EXPECT_EQ(hash("b.film"), hash("a.film"));
}

// srun leaves its --mem in no variable: rank 0 asks once, for all.
TEST_F(Launchers, TheMemoryOfSrunIsAskedFor) {
  const std::string tools = path("tools"), asked = path("asked");
  fs::create_directory(tools);
  std::ofstream(tools + "/scontrol") << fmt::format(
      "#!/bin/sh\necho \"$*\" >> '{}'\necho 'JobId=7 TRES=cpu=2,mem=400M,node=1,billing=1 "
      "MinMemoryNode=400M'\n",
      asked);
  fs::permissions(tools + "/scontrol", fs::perms::owner_all);
  std::string line =
      mpi_vitrail("render", 2) + arguments("a.film", fmt::format("--stats '{}'", path("stats.json")));
  line.erase(line.find("--quiet"), 7);
  const CommandResult made = run(fmt::format("export PATH='{}':\"$PATH\" SLURM_JOB_ID=7; {}", tools, line));
  EXPECT_EQ(made.status, 0) << made.output;
  EXPECT_THAT(made.output, HasSubstr("180 MiB a rank, as Slurm gives this job"));
  EXPECT_EQ(read_json(path("stats.json"))["memory_budget_bytes"], 180u << 20);
  EXPECT_EQ(text("asked"), "-o show job 7\n");
}

TEST_F(Launchers, TermToMpirunLeavesWhatCanBeResumed) {
  Background job(mpi_vitrail("render", 2) + arguments("a.film", long_enough));
  wait_for_checkpoint(job, "a.film");
  ASSERT_TRUE(job.running());
  job.send(SIGTERM);
  EXPECT_NE(job.wait(), 0);
  EXPECT_TRUE(fs::exists(path("a.film.partial")));
  EXPECT_FALSE(fs::exists(path("a.film")));
  for (int wait = 0; wait < 200 && !ranks_of("a.film").empty(); ++wait)  // mpirun does not wait for its ranks
    std::this_thread::sleep_for(50ms);
  ASSERT_EQ(run(alone("a.film", long_enough)).status, 0);
  EXPECT_EQ(hash("a.film"), whole_hash(long_enough));
}

TEST_F(Launchers, AKilledRenderIsBroughtBack) {
  Background job(alone("a.film", "--restarts 3"));
  int killed = 0;
  while (killed < 2 && kill_a_rank(job, "a.film")) {
    ++killed;
    std::this_thread::sleep_for(1500ms);  // it begins anew after 1 s
  }
  EXPECT_GT(killed, 0);
  EXPECT_EQ(job.wait(), 0);
  EXPECT_EQ(hash("a.film"), whole_hash());
  EXPECT_EQ(std::distance(fs::directory_iterator(directory_.path()), {}), 2) << "leftovers";
}

TEST_F(Launchers, AKilledRankOfMpirunIsBroughtBack) {
  const std::string mpirun = mpi_vitrail("render", 2);
  const auto begin = mpirun.find("mpirun"), end = mpirun.find(" '");
  Background job(mpirun.substr(0, begin) +
                 alone("a.film", fmt::format("{} --restarts 9 --launcher '{}'", long_enough,
                                             mpirun.substr(begin, end - begin))));
  EXPECT_TRUE(kill_a_rank(job, "a.film"));
  EXPECT_EQ(job.wait(), 0);
  EXPECT_EQ(hash("a.film"), whole_hash(long_enough));
}

// As where memory ends at the same place, whoever comes: it does not go on for ever, and says what it was.
TEST_F(Launchers, ARenderThatDiesAgainAndAgainEndsWithTheReason) {
  const std::string script = path("launcher.sh");
  std::ofstream(script) << fmt::format(
      "echo start >> '{0}/starts'; \"$@\" &\n"
      "while [ ! -e '{0}/a.film.lock' ]; do sleep .01; done\n"
      "kill -9 $!; wait $!\n",
      directory_.path().string());
  const CommandResult failed = run(alone("a.film", fmt::format("--restarts 2 --launcher 'sh {}'", script)));
  EXPECT_EQ(failed.status, 128 + SIGKILL);
  EXPECT_EQ(fs::file_size(path("starts")), 3 * std::string("start\n").size());
  EXPECT_THAT(failed.output, HasSubstr("2 times in a row without another checkpoint; started again in 2 s"));
  EXPECT_THAT(
      failed.output,
      HasSubstr("ended with status 137 (killed, as by the system where memory ends), 3 times in a row "
                "without another checkpoint: it was started again 2 times and is not once more"));
}

// As mpirun at times, whose rank it was.
TEST_F(Launchers, ALauncherThatDoesNotEndIsKilled) {
  const std::string script = path("launcher.sh");
  std::ofstream(script) << fmt::format(
      "[ -e '{0}/again' ] && exec \"$@\"\n"
      "touch '{0}/again'; \"$@\" &\n"
      "while [ ! -e '{0}/a.film.partial' ]; do sleep .01; done\n"
      "kill -9 $!; exec sleep 600\n",
      directory_.path().string());
  Background job(alone("a.film", fmt::format("--restarts 1 --patience 1 --launcher 'sh {}'", script)));
  EXPECT_EQ(job.wait(), 0);
  EXPECT_EQ(hash("a.film"), whole_hash());
}

// It has nobody to answer, and is not taken for one that hangs.
TEST_F(Launchers, ARankOfMpirunThatIsAloneIsPatient) {
  const CommandResult made =
      run(mpi_vitrail("render", 1) + arguments("a.film", "--patience 1.5 --spp 65536 --time 4"));
  EXPECT_EQ(made.status, 0) << made.output;
}

// Nobody else misses a rank that is alone.
TEST_F(Launchers, AStoppedRenderIsKilledAndBroughtBack) {
  Background job(alone("a.film", "--restarts 2 --patience 1"));
  wait_for_checkpoint(job, "a.film");
  const std::vector<pid_t> ranks = ranks_of("a.film");
  ASSERT_EQ(ranks.size(), 1u);
  ASSERT_EQ(::kill(ranks[0], SIGSTOP), 0);
  EXPECT_EQ(job.wait(), 0);
  EXPECT_EQ(hash("a.film"), whole_hash());
}

TEST_F(Launchers, ALauncherThatCannotBeginIsStartedTwice) {
  const CommandResult failed = run(alone("a.film", "--restarts 9 --launcher false"));
  EXPECT_EQ(failed.status, 1);
  EXPECT_THAT(failed.output, HasSubstr("started again in 1 s, 1 of 9"));
  EXPECT_THAT(failed.output, ::testing::Not(HasSubstr("2 of 9")));
  EXPECT_THAT(failed.output, HasSubstr("false ended with status 1 twice"));
}

TEST_F(Launchers, WhatCannotBecomeBetterIsNotStartedAgain) {
  const CommandResult bad = run(vitrail("render") + " no-such.pbrt --restarts 5");
  EXPECT_EQ(bad.status, 3);
  EXPECT_EQ(bad.output.find("started again"), std::string::npos);
  EXPECT_EQ(run(alone("a.film", "--restarts 5 --force")).status, 2);
  EXPECT_EQ(run(mpi_vitrail("render", 1) + arguments("a.film", "--restarts 5")).status, 2);
  Background job(alone("a.film", "--restarts 5"));
  wait_for_checkpoint(job, "a.film");
  job.send(SIGTERM);
  EXPECT_EQ(job.wait(), 128 + SIGTERM);
  EXPECT_TRUE(fs::exists(path("a.film.partial")));
}

TEST_F(Launchers, APreviewIsMadeOfEachCheckpoint) {
  Background job(alone("a.film", fmt::format("--spp 512 --preview '{}'", path("preview.png"))));
  while (job.running() && !fs::exists(path("preview.png"))) std::this_thread::sleep_for(5ms);
  EXPECT_TRUE(job.running());
  EXPECT_GT(fs::file_size(path("preview.png")), 1000u);
  job.send(SIGTERM);
  EXPECT_EQ(job.wait(), 128 + SIGTERM);
}

// As some cluster file systems are mounted.
TEST_F(Launchers, WithoutLocksTheFileIsBelieved) {
  const std::string without = fmt::format("LD_PRELOAD='{}' ", VITRAIL_NO_FLOCK);
  std::ofstream(path("a.film.lock")) << "process 1 on some-other-host";
  const CommandResult refused = run(without + alone("a.film"));
  EXPECT_EQ(refused.status, 4);
  EXPECT_THAT(refused.output, HasSubstr("process 1 on some-other-host"));
  EXPECT_THAT(refused.output, HasSubstr("remove"));
  Background first(without + alone("b.film"));
  wait_for_checkpoint(first, "b.film");
  EXPECT_EQ(run(without + alone("b.film")).status, 4);
  first.send(SIGKILL);
  first.wait();
  EXPECT_TRUE(fs::exists(path("b.film.lock")));
  std::ofstream(path("b.film.partial.tmp123")) << "of a killed run";
  std::ofstream(path("b.film.tmp.mine")) << "no leftover";
  const CommandResult resumed = run(without + alone("b.film"));
  EXPECT_EQ(resumed.status, 0) << resumed.output;
  EXPECT_FALSE(fs::exists(path("b.film.lock")));
  EXPECT_FALSE(fs::exists(path("b.film.partial.tmp123")));
  EXPECT_TRUE(fs::exists(path("b.film.tmp.mine")));
  const CommandResult again = run(without + alone("b.film").substr(0, alone("b.film").find("--quiet")));
  EXPECT_EQ(again.status, 0);
  EXPECT_THAT(again.output, HasSubstr("is finished already"));
}

}  // namespace
}  // namespace vitrail::test::launchers_test
