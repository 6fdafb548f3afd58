// SPDX-License-Identifier: Apache-2.0
// Photons land with other ranks and are asked of others, and the film is the same bit for bit: whatever the
// domains, ranks, threads, memory and order, and however often the job is killed between or within
// iterations.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <fstream>
#include <iterator>
#include <thread>

#include "tests/support/background.h"
#include "tests/support/command.h"
#include "tests/support/paths.h"
#include "tests/support/png.h"
#include "tests/support/ranks.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::one_picture_of_photons_test {
namespace {

using namespace std::chrono_literals;

class OnePictureOfPhotons : public ::testing::Test {
 protected:
  // The box with an image on its block that is looked up by a photon's footprint.
  void SetUp() override {
    write_png(directory_ / "image.png", 4, 4, 1,
              {0, 90, 250, 40, 180, 20, 70, 255, 5, 130, 240, 60, 200, 15, 99, 30});
    std::ifstream in(project_file("examples/cornell-box/cornell-box.pbrt"));
    std::string text((std::istreambuf_iterator<char>(in)), {});
    const std::string block = "  NamedMaterial \"white\"\n  Translate -0.36";
    const std::size_t at = text.find(block);
    ASSERT_NE(at, std::string::npos);
    text.replace(
        at, block.size(),
        "  Texture \"image\" \"spectrum\" \"imagemap\" \"string filename\" \"image.png\" \"string filter\" "
        "\"trilinear\"\n  Material \"diffuse\" \"texture reflectance\" \"image\"\n  Translate -0.36");
    std::ofstream(directory_ / "box.pbrt") << text;
    for (const int domains : {1, 8, 64}) {
      const CommandResult made =
          run(fmt::format("{} '{}' -o '{}' --domains {} --quiet", vitrail("partition"),
                          (directory_ / "box.pbrt").string(), bundle(domains), domains));
      ASSERT_EQ(made.status, 0) << made.output;
    }
  }
  std::string bundle(int domains) const { return (directory_ / fmt::format("{}.vit", domains)).string(); }
  std::string command(const std::string& film, int domains, int ranks, const std::string& more) const {
    return fmt::format("{} '{}' -o '{}' --width 40 --integrator photon --quiet --stats '{}' {}",
                       vitrail_on(ranks, "render"), bundle(domains), (directory_ / film).string(),
                       (directory_ / (film + ".json")).string(), more);
  }
  nlohmann::json stats(const std::string& film) const { return read_json(directory_ / (film + ".json")); }

  TemporaryDirectory directory_;
};

TEST_F(OnePictureOfPhotons, HoweverItIsRendered) {
  std::string hash;
  nlohmann::json first;
  std::uint64_t forwarded = 0, evictions = 0;
  struct Manner {
    int domains, ranks;
    const char* options;
  };
  for (const Manner& m :
       {Manner{1, 1, "--threads 1"}, Manner{1, 2, "--threads 1"}, Manner{8, 1, "--threads 2"},
        Manner{8, 2, "--threads 2 --memory 200M"}, Manner{64, 1, "--threads 1 --domain-memory 1"},
        Manner{64, 4, "--threads 1"}, Manner{64, 3, "--threads 2 --domain-memory 1 --shuffle-delivery 5"}}) {
    const CommandResult done = run(
        command("a.film", m.domains, m.ranks, fmt::format("--force --spp 2 --photons 6000 {}", m.options)));
    ASSERT_EQ(done.status, 0) << done.output;
    const nlohmann::json s = stats("a.film");
    if (hash.empty()) {
      hash = s["film_hash"];
      first = s;
      EXPECT_EQ(s["photons_emitted"], 12000);
      EXPECT_GT(s["photon_bytes"], 0);
    }
    for (const char* key : {"photons_emitted", "photons_landed", "photon_gathers", "photons_gathered"}) {
      EXPECT_EQ(s[key], first[key]) << key << ": " << m.domains << " domains, " << m.ranks << " ranks";
      EXPECT_GT(s[key], 0) << key;
    }
    EXPECT_EQ(s["film_hash"], hash) << m.domains << " domains, " << m.ranks << " ranks, " << m.options;
    forwarded += s["forwarded_rays"].get<std::uint64_t>();
    evictions += s["evictions"].get<std::uint64_t>();
  }
  EXPECT_GT(forwarded, 0u);
  EXPECT_GT(evictions, 0u);
}

// Items stay one iteration each, however many there are.
TEST_F(OnePictureOfPhotons, ManyIterationsGoOn) {
  const std::string few = "--photons 300 --threads 1 --crop 0,8,0,8 --spp ";
  ASSERT_EQ(run(command("long.film", 1, 1, few + "130")).status, 0);
  ASSERT_EQ(run(command("long.film", 1, 1, few + "300")).status, 0);
  const CommandResult again = run(command("long.film", 1, 1, few + "300"));
  EXPECT_EQ(again.status, 0) << again.output;
  const std::string hash = stats("long.film")["film_hash"];
  ASSERT_EQ(run(command("at-once.film", 1, 1, few + "300")).status, 0);
  EXPECT_EQ(stats("at-once.film")["film_hash"], hash);
}

TEST_F(OnePictureOfPhotons, KilledAndContinued) {
  const std::string photons = "--photons 20000 --threads 1 --spp 20";
  ASSERT_EQ(run(command("whole.film", 8, 1, photons)).status, 0);
  const auto partial = directory_ / "killed.film.partial";
  int kills = 0;
  for (int tries = 0; tries < 4; ++tries) {
    std::error_code none;
    const auto before = std::filesystem::last_write_time(partial, none);
    Background job(command("killed.film", 8, 1 + tries % 2, photons + " --checkpoint-every 0.02"));
    while (job.running() && std::filesystem::last_write_time(partial, none) == before)
      std::this_thread::sleep_for(2ms);
    std::this_thread::sleep_for(std::chrono::milliseconds(37 * tries));
    for (const pid_t pid : tries % 2 == 0 ? std::vector{job.pid()} : job.ranks())
      kills += job.running() && ::kill(pid, SIGKILL) == 0;
    job.wait();
  }
  EXPECT_GT(kills, 0);
  ASSERT_EQ(run(command("killed.film", 8, 2, photons)).status, 0);
  EXPECT_EQ(stats("killed.film")["film_hash"], stats("whole.film")["film_hash"]);
  // More iterations behind a finished film's, as if all had been asked for at once.
  const std::string more = "--photons 20000 --threads 1 --spp 22";
  ASSERT_EQ(run(command("killed.film", 8, 1, more)).status, 0);
  ASSERT_EQ(run(command("whole.film", 1, 2, more + " --force")).status, 0);
  EXPECT_EQ(stats("killed.film")["film_hash"], stats("whole.film")["film_hash"]);
  // Of other photons it is another picture.
  for (const char* other :
       {"--photons 20001", "--photons 20000 --photon-radius 0.01", "--photons 20000 --photon-alpha 0.5"}) {
    const CommandResult refused = run(command("whole.film", 8, 1, fmt::format("--spp 24 {}", other)));
    EXPECT_EQ(refused.status, 3) << refused.output;
    EXPECT_THAT(refused.output, ::testing::HasSubstr("number, radius or alpha of photons"));
  }
}

// Sensors by photons: some close together, so that their discs overlap, one of them twice, and ranks other
// than those that hold them ask for their light.
TEST_F(OnePictureOfPhotons, OfSensors) {
  std::ofstream(directory_ / "sensors.txt")
      << "plane -0.9 -0.9 -0.99  1.8 0 0  0 1.8 0  9x7\n0 0 -0.9  0 0 1\n0 0 -0.9  0 0 1\n0.1 0 0  0 1 0\n";
  const auto measure = [&](const std::string& film, int domains, int ranks, const std::string& more) {
    return fmt::format(
        "{} '{}' -o '{}' --integrator photon --photons 6000 --quiet --stats '{}' --sensors '{}' {}",
        vitrail_on(ranks, "render"), bundle(domains), (directory_ / film).string(),
        (directory_ / (film + ".json")).string(), (directory_ / "sensors.txt").string(), more);
  };
  nlohmann::json first;
  struct Manner {
    int domains, ranks;
    const char* options;
  };
  for (const Manner& m : {Manner{1, 1, "--threads 1"}, Manner{8, 2, "--threads 2"},
                          Manner{64, 3, "--threads 2 --domain-memory 1 --shuffle-delivery 5"}}) {
    const CommandResult done =
        run(measure("s.film", m.domains, m.ranks, fmt::format("--force --spp 2 {}", m.options)));
    ASSERT_EQ(done.status, 0) << done.output;
    const nlohmann::json s = stats("s.film");
    if (first.is_null()) first = s;
    for (const char* key :
         {"photons_emitted", "photons_landed", "photon_gathers", "photons_gathered", "film_hash"})
      EXPECT_EQ(s[key], first[key]) << key << ": " << m.domains << " domains, " << m.ranks << " ranks";
    EXPECT_GT(s["photons_gathered"], 100);
  }
  EXPECT_EQ(first["photons_emitted"], 2 * 6000);
  // Killed in iterations and between them.
  const std::string long_job = "--threads 1 --spp 12";
  ASSERT_EQ(run(measure("whole.film", 8, 1, long_job)).status, 0);
  const auto partial = directory_ / "killed.film.partial";
  int kills = 0;
  for (int tries = 0; tries < 3; ++tries) {
    std::error_code none;
    const auto before = std::filesystem::last_write_time(partial, none);
    Background job(measure("killed.film", 8, 1 + tries % 2, long_job + " --checkpoint-every 0.02"));
    while (job.running() && std::filesystem::last_write_time(partial, none) == before)
      std::this_thread::sleep_for(2ms);
    for (const pid_t pid : tries % 2 == 0 ? std::vector{job.pid()} : job.ranks())
      kills += job.running() && ::kill(pid, SIGKILL) == 0;
    job.wait();
  }
  EXPECT_GT(kills, 0);
  ASSERT_EQ(run(measure("killed.film", 8, 2, long_job)).status, 0);
  EXPECT_EQ(stats("killed.film")["film_hash"], stats("whole.film")["film_hash"]);
}

// Many photons ask for no more memory than few: those that it has no room for wait on the disk.
TEST_F(OnePictureOfPhotons, MorePhotonsThanMemoryHasRoomFor) {
  const auto least = [&](int photons) {
    const CommandResult refused =
        run(command("no.film", 8, 1, fmt::format("--spp 1 --threads 1 --photons {} --memory 8M", photons)));
    const std::size_t at = refused.output.find("Give at least ");
    EXPECT_NE(at, std::string::npos) << refused.output;
    return at == std::string::npos ? 0 : std::stoi(refused.output.substr(at + 14));
  };
  EXPECT_LE(least(100000000), least(20000) + 2);
  const std::string photons = "--spp 2 --threads 1 --photons 200000";
  const int memory = least(200000);
  ASSERT_EQ(run(command("all.film", 8, 1, photons)).status, 0);
  EXPECT_EQ(stats("all.film")["spilled_bytes"], 0);
  for (const int ranks : {1, 2}) {
    const int more = ranks > 1 ? 12 : 0;
    const CommandResult done =
        run(command("little.film", 8, ranks, fmt::format("{} --force --memory {}M", photons, memory + more)));
    ASSERT_EQ(done.status, 0) << done.output;
    const nlohmann::json little = stats("little.film");
    EXPECT_EQ(little["film_hash"], stats("all.film")["film_hash"]) << ranks << " ranks";
    EXPECT_LE(little["peak_rss_bytes"], (memory + more) << 20);
    if (ranks == 1) {
      EXPECT_GT(little["spilled_bytes"], 0);
    }
  }
}

TEST_F(OnePictureOfPhotons, RefusesWhatItCannotDo) {
  const auto refused = [&](const std::string& options, int status, const char* words) {
    const CommandResult r = run(command("no.film", 1, 1, options));
    EXPECT_EQ(r.status, status) << options;
    EXPECT_THAT(r.output, ::testing::HasSubstr(words)) << options;
  };
  refused("--spp 2 --adaptive", 2, "no --adaptive");
  refused("--target-error 0.1", 2, "no --target-error");
  refused("--spp 2 --photons 2000000 --memory 8M", 4, "Give at least");
}

}  // namespace
}  // namespace vitrail::test::one_picture_of_photons_test
