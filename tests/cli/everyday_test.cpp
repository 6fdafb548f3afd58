// SPDX-License-Identifier: Apache-2.0
// The verbs a user types, and what they see.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "film/film_progress.h"
#include "scene/system/machine_limits.h"
#include "tests/support/command.h"
#include "tests/support/paths.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::everyday_test {
namespace {

using ::testing::HasSubstr;

const std::string scene = project_file("examples/cornell-box/cornell-box.pbrt");

TEST(Everyday, SceneToPictureInOneStep) {
  const TemporaryDirectory directory;
  const auto out = directory / "picture.exr";
  const CommandResult made =
      run(fmt::format("{} '{}' -o '{}' --spp 4 --crop 0,64,0,64", vitrail("render"), scene, out.string()));
  EXPECT_EQ(made.status, 0) << made.output;
  EXPECT_TRUE(std::filesystem::exists(out));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(directory.path()), {}), 1)
      << "something was left over";
}

// OpenImageIO and what hangs on it take 0.3 s to load: only what reads or writes images waits for that.
TEST(Everyday, ProgramsStartWithFewLibraries) {
  for (const char* verb : {"compare", "convert", "develop", "inspect", "partition", "render", "verify"}) {
    std::string program = vitrail(verb);
    program.replace(program.find("' "), 2, "-").push_back('\'');
    const CommandResult loaded = run("LD_TRACE_LOADED_OBJECTS=1 " + program);
    EXPECT_THAT(loaded.output, HasSubstr("libc.so")) << program;
    EXPECT_THAT(loaded.output, ::testing::Not(HasSubstr("OpenImageIO"))) << program;
  }
}

TEST(Everyday, SaysWhereItStandsAndIsSilentIfAsked) {
  const TemporaryDirectory directory;
  const std::string line = fmt::format("{} '{}' -o '{}' --spp 4 --crop 0,64,0,64", vitrail("render"), scene,
                                       (directory / "a.film").string());
  const CommandResult quiet = run(line + " --quiet");
  EXPECT_EQ(quiet.status, 0);
  EXPECT_EQ(quiet.output, "");
  const CommandResult lines = run(line + " --force");
  EXPECT_EQ(lines.status, 0);
  EXPECT_THAT(lines.output, HasSubstr("rendering 64 × 64 pixels, 4 samples each"));
  EXPECT_THAT(lines.output, HasSubstr("a.film: 4 of 4 samples a pixel after"));
  // One more where this machine's memory is not all for this job.
  EXPECT_EQ(std::ranges::count(lines.output, '\n'), memory_limit().is_machine ? 2 : 3) << lines.output;
}

// By --memory, and by what Slurm gives: none is killed for more.
TEST(Everyday, EachVerbKeepsItsMemory) {
  const TemporaryDirectory directory;
  const auto path = [&](const char* name) { return (directory / name).string(); };
  ASSERT_EQ(run(fmt::format("{} '{}' -o '{}' --spp 1 --width 640 --height 640 --quiet", vitrail("render"),
                            scene, path("a.film")))
                .status,
            0);
  for (const std::string& command :
       {fmt::format("{} '{}' -o '{}' --force", vitrail("develop"), path("a.film"), path("a.png")),
        fmt::format("{} '{}' '{}'", vitrail("compare"), path("a.film"), path("a.film")),
        fmt::format("{} '{}' '{}' --force", vitrail("convert"), scene, path("a.xml")),
        fmt::format("{} '{}'", vitrail("inspect"), scene)}) {
    const CommandResult refused = run(command + " --memory 10M");
    EXPECT_EQ(refused.status, 4) << command;
    EXPECT_THAT(refused.output, HasSubstr("10 MiB of memory are too little for ")) << command;
    EXPECT_EQ(run("SLURM_JOB_ID=7 SLURM_MEM_PER_NODE=12 " + command).status, 4) << command;
    EXPECT_EQ(run(command + " --memory 300M").status, 0) << command;
  }
}

// Standard output holds nothing else.
TEST(Everyday, ProgressAsJsonLines) {
  const TemporaryDirectory directory;
  const auto events = directory / "events";
  const std::string line = fmt::format(
      "{} '{}' -o '{}' --spp 65536 --crop 0,64,0,64 --threads 1 --time 2.5 --progress json > '{}'; true",
      vitrail("render"), scene, (directory / "a.film").string(), events.string());
  for (const int run_number : {1, 2}) {
    const CommandResult result = run(line);
    std::ifstream lines(events);
    std::vector<nlohmann::json> all;
    for (std::string text; std::getline(lines, text);) all.push_back(nlohmann::json::parse(text));
    ASSERT_GE(all.size(), 3u) << result.output;
    double last = -1;
    for (const nlohmann::json& event : all) {
      EXPECT_GE(event["progress"].get<double>(), last);
      EXPECT_LE(event["remaining_s"].get<double>(), 2.5) << "the time limit comes first";
      if (&event != &all.back()) {
        EXPECT_EQ(event["rays_waiting_by_rank"].size(), 1u);
      }
      last = event["progress"];
      EXPECT_EQ(event["event"], &event == &all.back() ? "end" : "progress");
    }
    EXPECT_EQ(all.back()["ending"], "time is up") << run_number;
  }
}

// With what there is, which is not all, and the same command goes on.
TEST(Everyday, ARenderOfSomeSeconds) {
  const TemporaryDirectory directory;
  const auto film = directory / "a.film", stats = directory / "stats.json",
             profile = directory / "profile.json";
  const std::string line =
      fmt::format("{} '{}' -o '{}' --crop 0,64,0,64 --threads 1 --time 1.5 --stats '{}' --profile '{}'",
                  vitrail("render"), scene, film.string(), stats.string(), profile.string());
  const auto samples = [&] { return read_json(stats)["samples"].get<std::uint64_t>(); };
  ASSERT_EQ(run(line).status, 0);
  EXPECT_FALSE(read_json(stats)["complete"].get<bool>());
  EXPECT_FALSE(std::filesystem::exists(profile)) << "it is of a whole picture";
  FilmProgress progress;
  const Film first = read_film(film, &progress);
  EXPECT_FALSE(progress.complete());
  const std::uint64_t before = samples();
  EXPECT_GE(before, 64u * 64 * 2) << "every pixel has its first";
  const CommandResult second = run(line);
  EXPECT_EQ(second.status, 0);
  EXPECT_THAT(second.output, HasSubstr("going on from"));
  EXPECT_GT(samples(), before);
}

// However short the time is, and however long partitioning takes: the picture goes on at each run.
TEST(Everyday, ATimeThatPartitioningTakesBringsSamplesAllTheSame) {
  const TemporaryDirectory directory;
  const std::string line =
      fmt::format("{} '{}' -o '{}' --time 0.02", vitrail("render"), scene, (directory / "a.film").string());
  std::uint64_t before = 0;
  for (int turn = 0; turn < 3; ++turn) {
    const CommandResult done = run(line);
    EXPECT_EQ(done.status, 0) << done.output;
    EXPECT_THAT(done.output, HasSubstr("went by before tracing began"));
    const std::uint64_t samples = read_film(directory / "a.film", nullptr).samples();
    EXPECT_GT(samples, before) << "turn " << turn;
    before = samples;
  }
}

TEST(Everyday, AFilmWithoutSamplesIsNoPicture) {
  const TemporaryDirectory directory;
  FilmSettings settings;
  settings.width = settings.height = 4;
  settings.crop = {0, 4, 0, 4};
  write_film(directory / "a.film", Film(settings, {}), {1, 1, {0}, 0, {}, {}, false, {}});
  const CommandResult done =
      run(fmt::format("{} '{}' -o '{}'", vitrail("develop"), (directory / "a.film").string(),
                      (directory / "a.png").string()));
  EXPECT_EQ(done.status, 3);
  EXPECT_THAT(done.output, HasSubstr("holds no sample yet"));
  EXPECT_FALSE(std::filesystem::exists(directory / "a.png"));
}

TEST(Everyday, QualityIsWhatIsNotGiven) {
  const TemporaryDirectory directory;
  const auto stats = directory / "stats.json";
  const auto render = [&](const std::string& options) {
    const CommandResult done =
        run(fmt::format("{} '{}' -o '{}' --crop 0,32,0,32 --force --stats '{}' {}", vitrail("render"), scene,
                        (directory / "a.film").string(), stats.string(), options));
    EXPECT_EQ(done.status, 0) << done.output;
    return read_json(stats);
  };
  const nlohmann::json draft = render("--quality draft");
  EXPECT_EQ(draft["target_error"], 3.8);
  EXPECT_EQ(draft["target_error_unit"], "jnd");
  EXPECT_FALSE(draft["adaptive"].get<bool>());
  const nlohmann::json good = render("--quality good --spp 32");
  EXPECT_EQ(good["target_error"], 1);
  EXPECT_EQ(good["spp"], 32);
  EXPECT_TRUE(good["adaptive"].get<bool>());
  const nlohmann::json given = render("--quality final --target-error 0.5 --no-adaptive --spp 64");
  EXPECT_EQ(given["target_error"], 0.5);
  EXPECT_EQ(given["target_error_unit"], "relmse");
  EXPECT_FALSE(given["adaptive"].get<bool>());
  EXPECT_EQ(run(fmt::format("{} '{}' -o a.film --quality best", vitrail("render"), scene)).status, 2);
}

TEST(Everyday, FilmsOfDifferentSeedsMerge) {
  const TemporaryDirectory directory;
  for (const int seed : {1, 2})
    ASSERT_EQ(run(fmt::format("{} '{}' -o '{}' --spp 8 --crop 0,64,0,64 --seed {}", vitrail("render"), scene,
                              (directory / fmt::format("{}.film", seed)).string(), seed))
                  .status,
              0);
  const std::string one = (directory / "1.film").string(), two = (directory / "2.film").string();
  const std::string ab = (directory / "ab.exr").string(), ba = (directory / "ba.exr").string();
  ASSERT_EQ(run(fmt::format("{} '{}' '{}' -o '{}'", vitrail("develop"), one, two, ab)).status, 0);
  ASSERT_EQ(run(fmt::format("{} '{}' '{}' -o '{}'", vitrail("develop"), two, one, ba)).status, 0);
  EXPECT_EQ(run(fmt::format("{} '{}' '{}' --metric bitwise", vitrail("compare"), ab, ba)).status, 0);
  EXPECT_EQ(run(fmt::format("{} '{}' '{}' -o '{}'", vitrail("develop"), one, one, ab)).status, 3)
      << "the same seed twice";
  const CommandResult differs =
      run(fmt::format("{} '{}' '{}' --metric bitwise", vitrail("compare"), one, two));
  EXPECT_EQ(differs.status, 1) << differs.output;
}

// Shapes that stand and are used, whose records have gaps, partitioned in memory full of one byte or another.
TEST(Everyday, ABundleIsOfItsSceneAlone) {
  const TemporaryDirectory directory;
  std::ofstream(directory / "scene.pbrt")
      << "Film \"rgb\" \"integer xresolution\" 4 \"integer yresolution\" 4\nWorldBegin\n"
         "LightSource \"infinite\" \"rgb L\" [1 1 1]\nMaterial \"diffuse\" \"rgb reflectance\" [0.8 0.2 "
         "0.1]\n"
         "Shape \"sphere\"\nObjectBegin \"o\"\nShape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0]\n"
         "Shape \"disk\"\nObjectEnd\nTranslate 1 2 3\nObjectInstance \"o\"\nTranslate 1 2 3\nObjectInstance "
         "\"o\"\n";
  std::vector<std::string> manifests;
  for (const int byte : {85, 170}) {
    const CommandResult made =
        run(fmt::format("MALLOC_PERTURB_={} {} '{}' -o '{}' --force --quiet", byte, vitrail("partition"),
                        (directory / "scene.pbrt").string(), (directory / "a.vit").string()));
    ASSERT_EQ(made.status, 0) << made.output;
    std::string& text = manifests.emplace_back();
    for (const char* file : {"manifest.json", "domains.bin"}) {
      std::ifstream in(directory / "a.vit" / file);
      text.append(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    }
  }
  EXPECT_EQ(manifests[0], manifests[1]);
}

TEST(Everyday, InspectSaysWhatASceneRequires) {
  const CommandResult result = run(fmt::format("{} '{}'", vitrail("inspect"), scene));
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.output, HasSubstr("triangles"));
  const CommandResult json = run(fmt::format("{} '{}' --json", vitrail("inspect"), scene));
  EXPECT_EQ(json.status, 0);
  EXPECT_TRUE(nlohmann::json::accept(json.output)) << json.output;
}

TEST(Everyday, StatisticsKeepTheirContract) {
  const TemporaryDirectory directory;
  const auto bundle = directory / "a.vit", p = directory / "p.json", r = directory / "r.json";
  ASSERT_EQ(run(fmt::format("{} '{}' -o '{}' --domains 4 --stats '{}'", vitrail("partition"), scene,
                            bundle.string(), p.string()))
                .status,
            0);
  ASSERT_EQ(run(fmt::format("{} '{}' -o '{}' --spp 1 --stats '{}'", vitrail("render"), bundle.string(),
                            (directory / "a.film").string(), r.string()))
                .status,
            0);
  for (const char* key :
       {"input_triangles", "cut_triangles", "pieces", "domains", "triangles_min", "triangles_mean",
        "triangles_max", "bundle_bytes", "duplicates", "area_error", "wall_s", "cpu_s", "peak_rss_bytes"})
    EXPECT_TRUE(read_json(p).contains(key)) << key;
  EXPECT_THAT(read_json(r)["command"].get<std::string>(),
              testing::EndsWith(" --spp 1 --stats " + r.string()));
  EXPECT_THAT(read_json(r)["version"].get<std::string>(), HasSubstr("vitrail "));
  EXPECT_EQ(read_json(r)["by_rank"].size(), 1u);
  EXPECT_EQ(read_json(r)["by_rank"][0]["host"], read_json(r)["hosts"][0]);
  for (const char* key : {"ranks",
                          "threads",
                          "spp",
                          "seed",
                          "samples",
                          "wall_s",
                          "cpu_s",
                          "load_s",
                          "trace_s",
                          "busiest_trace_s",
                          "idle_s",
                          "rays_camera",
                          "rays_indirect",
                          "rays_shadow",
                          "crossings",
                          "forwarded_rays",
                          "forwarded_bytes",
                          "messages",
                          "domains_total",
                          "domains_touched",
                          "domain_loads",
                          "evictions",
                          "memory_budget_bytes",
                          "peak_rss_bytes",
                          "base_rss_bytes",
                          "setup_peak_rss_bytes",
                          "clamped_share",
                          "nonfinite_samples",
                          "saturated_samples",
                          "film_hash"})
    EXPECT_TRUE(read_json(r).contains(key)) << key;
}

}  // namespace
}  // namespace vitrail::test::everyday_test
