// SPDX-License-Identifier: Apache-2.0
// Several `render --frames` that share one list: each frame is rendered by one of them, and those of a worker
// that is killed by the others.
#include <gmock/gmock.h>

#include <chrono>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include "tests/cli/frames_fixture.h"
#include "tests/support/background.h"

namespace vitrail::test::shared_frames_test {
namespace {

using namespace std::chrono_literals;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class SharedFrames : public FramesFixture {
 protected:
  // A worker whose words go into a file.
  std::string worker(const std::string& name, const std::string& more, const std::string& output) const {
    write(name + ".sh", fmt::format("exec env {} > {} 2>&1\n", command(more, output), path(name + ".log")));
    return "sh " + path(name + ".sh");
  }
  int count_of(const std::string& pattern, int frames) const {
    int count = 0;
    for (int i = 1; i <= frames; ++i) count += exists(fmt::format(fmt::runtime(pattern), i));
    return count;
  }
  // The bytes, of a film those of its picture: a film says how long it took.
  std::string picture(const std::string& name) const {
    if (!name.ends_with(".film")) return bytes(name);
    const CommandResult developed =
        run(fmt::format("{} {} -o {} --quiet", vitrail("develop"), path(name), path("developed.png")));
    EXPECT_EQ(developed.status, 0) << developed.output;
    return bytes("developed.png");
  }
  void wait_for(const std::function<bool()>& sign) const {
    for (int i = 0; i < 6000 && !sign(); ++i) std::this_thread::sleep_for(10ms);
    EXPECT_TRUE(sign());
  }
};

// Ten frames by three workers, of which two are killed while they render.
TEST_F(SharedFrames, AreThoseOfOneWorkerHoweverManyAreKilled) {
  constexpr int frames = 10;
  write_seeds(frames);
  const std::string more = "--width 32 --spp 80 --threads 1 --checkpoint-every .1 --progress lines";
  for (const std::string kind : {"png", "film"}) {
    ASSERT_EQ(render_frames(more, "one%03d." + kind).status, 0);
    const std::string output = "f%03d." + kind, pattern = "f{:03}." + kind;
    std::vector<std::unique_ptr<Background>> workers;
    for (const char* name : {"a", "b", "c"})
      workers.push_back(std::make_unique<Background>(worker(name, more, output)));
    for (const int victim : {0, 1}) {
      wait_for([&] {
        return count_of(pattern, frames) > victim && count_of(pattern + ".partial", frames) >= 3 - victim;
      });
      workers[static_cast<std::size_t>(victim)]->send(SIGKILL);
      EXPECT_EQ(workers[static_cast<std::size_t>(victim)]->wait(), 128 + SIGKILL) << "it ended before";
    }
    EXPECT_LT(count_of(pattern, frames), frames) << "the last one has something to take over";
    EXPECT_EQ(workers[2]->wait(), 0);
    const std::string words = bytes("c.log");
    EXPECT_THAT(words, HasSubstr("going on from"));
    EXPECT_THAT(bytes("a.log") + bytes("b.log") + words, HasSubstr("is rendered elsewhere, by process"));
    for (int i = 1; i <= frames; ++i)
      EXPECT_EQ(picture(fmt::format(fmt::runtime(pattern), i)), picture(fmt::format("one{:03}.{}", i, kind)))
          << i << words;
    if (kind == "png") {
      EXPECT_EQ(read_json(path("fframes.png.json"))["pictures"].size(), 10u);
    }
  }
}

TEST_F(SharedFrames, AreRenderedOnce) {
  constexpr int frames = 8;
  write_seeds(frames);
  std::vector<std::unique_ptr<Background>> workers;
  for (const char* name : {"a", "b", "c"})
    workers.push_back(std::make_unique<Background>(worker(name, "--spp 100 --progress lines", "f%03d.png")));
  std::string words;
  for (const auto& one : workers) EXPECT_EQ(one->wait(), 0);
  for (const char* name : {"a.log", "b.log", "c.log"}) words += bytes(name);
  for (int i = 1; i <= frames; ++i) {
    const std::string end = path(fmt::format("f{:03}.png", i)) + ": 100 of 100 samples a pixel";
    EXPECT_NE(words.find(end), words.npos) << i << words;
    EXPECT_EQ(words.find(end), words.rfind(end)) << i << words;
  }
}

// Its lock as a render has it, by a program that renders nothing.
TEST_F(SharedFrames, AreWaitedForAndTakenOver) {
  write_seeds(3);
  const std::string lock = path("f002.png.work.lock");
  for (const int ranks : {1, 2}) {
    const std::string log = fmt::format("worker{}.log", ranks);
    write("f002.png.work.lock", "process 7 on node9");
    Background other(fmt::format("flock {} sleep 60", lock));
    wait_for([&] { return run(fmt::format("flock -n {} true", lock)).status != 0; });
    write("worker.sh",
          fmt::format("exec env {} > {} 2>&1\n", command("--force", "f%03d.png", ranks), path(log)));
    Background worker("sh " + path("worker.sh"));
    wait_for([&] { return bytes(log).find("waits for ") != std::string::npos; });
    EXPECT_TRUE(exists("f001.png") && exists("f003.png"));
    EXPECT_FALSE(exists("f002.png"));
    EXPECT_TRUE(worker.running());
    ::kill(-other.pid(), SIGKILL);
    other.wait();
    EXPECT_EQ(worker.wait(), 0) << bytes(log);
    EXPECT_THAT(bytes(log), AllOf(HasSubstr("f002.png is rendered elsewhere, by process 7 on node9"),
                                  HasSubstr("waits for " + path("f002.png") + " (process 7 on node9)")));
    for (const char* name : {"f001.png", "f002.png", "f003.png"}) {
      EXPECT_TRUE(exists(name));
      std::filesystem::remove(path(name));
    }
  }
}

TEST_F(SharedFrames, AreNotWaitedForOnceOneIsToldToStop) {
  write_seeds(2);
  const std::string lock = path("f002.png.work.lock");
  Background other(fmt::format("flock {} sleep 60", lock));
  wait_for(
      [&] { return exists("f002.png.work.lock") && run(fmt::format("flock -n {} true", lock)).status != 0; });
  Background one(worker("one", "", "f%03d.png"));
  wait_for([&] { return bytes("one.log").find("waits for ") != std::string::npos; });
  std::this_thread::sleep_for(200ms);
  one.send(SIGTERM);
  EXPECT_EQ(one.wait(), 128 + SIGTERM);
  EXPECT_THAT(bytes("one.log"), HasSubstr("stopped while others render " + path("f002.png")));
  ::kill(-other.pid(), SIGKILL);
}

}  // namespace
}  // namespace vitrail::test::shared_frames_test
