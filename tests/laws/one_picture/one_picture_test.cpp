// SPDX-License-Identifier: Apache-2.0
// One scene, seed and sample count give one film, bit for bit, whatever the number of sub-domains, ranks and
// threads, the memory, and the order in which rays arrive.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "bundle/manifest.h"
#include "bundle/reflectances/color_words.h"
#include "tests/support/command.h"
#include "tests/support/long_tests.h"
#include "tests/support/paths.h"
#include "tests/support/ranks.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::one_picture_test {
namespace {

constexpr std::uint64_t mib = 1 << 20;

struct Bundle {
  int domains = 0;
  std::uint64_t conversion = 0;  // what finding spectra of codes may take
  std::filesystem::path path;
  std::uint64_t bytes = 0, largest = 0;
};

Bundle make_bundle(const TemporaryDirectory& directory, const std::filesystem::path& scene, int domains,
                   const std::string& more = "") {
  Bundle bundle{domains};
  bundle.path = directory / fmt::format("{}.vit", domains);
  const CommandResult made = run(fmt::format("{} '{}' -o '{}' --domains {} {}", vitrail("partition"),
                                             scene.string(), bundle.path.string(), domains, more));
  EXPECT_EQ(made.status, 0) << made.output;
  for (const DomainInfo& d : read_manifest(bundle.path).domains) {
    bundle.bytes += d.bytes;
    bundle.largest = std::max(bundle.largest, d.bytes);
  }
  for (const TextureFileEntry& t : read_manifest(bundle.path).texture_files)
    if (t.read_bytes > 0) bundle.conversion = conversion_bytes;
  return bundle;
}

nlohmann::json render(const TemporaryDirectory& directory, const Bundle& bundle, int ranks, int threads,
                      const std::string& more) {
  const auto stats = directory / "stats.json";
  const CommandResult done = run(fmt::format(
      "{} '{}' -o '{}' --force --crop 0,48,0,32 --threads {} --stats '{}' {}",
      bundle.domains == 1 ? mpi_vitrail("render", ranks) : vitrail_on(ranks, "render"), bundle.path.string(),
      (directory / "picture.film").string(), threads, stats.string(), more));
  EXPECT_EQ(done.status, 0) << done.output;
  return done.status == 0 ? read_json(stats) : nlohmann::json();
}

// A quarter of the bundle for domains (the largest has to fit), and a budget for the whole rank to keep.
std::string quarter(const Bundle& bundle, const nlohmann::json& everything, int threads) {
  const std::uint64_t domains = std::max(bundle.bytes / 4, bundle.largest);
  const std::uint64_t rank = everything["base_rss_bytes"].get<std::uint64_t>() +
                             (9 + static_cast<unsigned>(threads)) * mib + bundle.conversion + domains +
                             domains / 4;
  return fmt::format("--memory {} --domain-memory {}", rank, domains);
}

// Whether all numbers of ranks meet all of domains and every distribution, or some. With VITRAIL_LONG_TESTS
// all do.
enum class Share { all, part };

// Each number of threads meets each of domains and each of ranks, and so does little memory; with
// VITRAIL_LONG_TESTS each pair of them.
std::vector<int> threads_with(int domains, int ranks) {
  if (are_long()) return {1, 2};
  return {(domains == 8) == (ranks == 2) ? 1 : 2};
}
std::vector<int> ranks_with(int domains, Share share) {
  if (share == Share::all || are_long()) return {1, 2, 4};
  return domains == 1 ? std::vector{1} : domains == 8 ? std::vector{2} : std::vector{2, 4};
}

// `samples`: enough that rays wait on the disk, however the ranks take turns.
void expect_one_picture(const TemporaryDirectory& directory, const std::filesystem::path& scene, Share share,
                        int samples = 2) {
  const auto trace = [&](const Bundle& bundle, int ranks, int threads, const std::string& more) {
    return render(directory, bundle, ranks, threads, fmt::format("--spp {} {}", samples, more));
  };
  std::string hash;
  int runs = 0;
  std::uint64_t forwarded = 0, evictions = 0, spilled = 0;
  const auto check = [&](const nlohmann::json& stats, const std::string& what) {
    ASSERT_FALSE(stats.is_null()) << what;
    if (hash.empty()) hash = stats["film_hash"];
    EXPECT_EQ(stats["film_hash"], hash) << what;
    EXPECT_EQ(stats["nonfinite_samples"], 0) << what;
    forwarded += stats["forwarded_rays"].get<std::uint64_t>();
    evictions += stats["evictions"].get<std::uint64_t>();
    spilled += stats["spilled_bytes"].get<std::uint64_t>();
    const auto budget = stats["memory_budget_bytes"].get<std::uint64_t>();
    if (budget > 0) {
      EXPECT_LE(stats["peak_rss_bytes"].get<std::uint64_t>(), budget) << what;
    }
    ++runs;
  };
  for (const int domains : {1, 8, 64}) {
    const Bundle bundle = make_bundle(directory, scene, domains);
    nlohmann::json crossings;  // the same for all runs of a bundle
    for (const int ranks : ranks_with(domains, share))
      for (const int threads : threads_with(domains, ranks)) {
        const std::string what = fmt::format("{} domains, {} ranks, {} threads", domains, ranks, threads);
        const nlohmann::json all = trace(bundle, ranks, threads, "");
        check(all, what);
        if (all.is_null()) return;
        if (crossings.is_null()) crossings = all["crossings"];
        EXPECT_EQ(all["crossings"], crossings) << what;
        EXPECT_EQ(all["forwarded_rays"], 0) << what;
        const std::string memory = quarter(bundle, all, threads);
        if (threads == 1 || are_long()) {
          const nlohmann::json little = trace(bundle, ranks, threads, memory);
          check(little, what + ", a quarter of the memory");
          EXPECT_EQ(little["crossings"], crossings) << what;
        }
        if (domains == 64 && ranks == 2 && threads == 2)
          for (const int seed : {1, 2})
            check(trace(bundle, ranks, threads, fmt::format("{} --shuffle-delivery {}", memory, seed)),
                  what + ", shuffled");
      }
  }
  const Bundle shared = make_bundle(directory, scene, 8);
  check(trace(shared, 4, 1, "--distribution decompose"), "decompose");
  if (share == Share::all || are_long()) {
    // Cut anew for the rays that were seen.
    const auto profile = (directory / "profile.json").string();
    trace(shared, 2, 1, fmt::format("--profile '{}'", profile));
    const Bundle recut = make_bundle(directory, scene, 8, fmt::format("--profile '{}'", profile));
    check(trace(recut, 1, 2, ""), "cut by a profile");
    // Domains shared out otherwise, by the rays of the bundle itself.
    make_bundle(directory, scene, 8);
    trace(shared, 1, 2, fmt::format("--profile '{}'", profile));
    for (const std::string& how : {fmt::format("decompose --homes '{}'", profile), std::string("replicate")})
      check(trace(shared, 4, 1, "--distribution " + how), how);
  }
  EXPECT_GT(forwarded, 0u) << "no run ever sent a ray";
  EXPECT_GT(evictions, 0u) << "no run ever evicted a domain";
  EXPECT_GT(spilled, 0u) << "no ray ever waited on the disk";
  fmt::print("{} runs, film {}, {} rays forwarded, {} evictions, {} bytes spilled\n", runs, hash, forwarded,
             evictions, spilled);
}

std::filesystem::path generate(const TemporaryDirectory& directory, const std::string& example,
                               const std::string& arguments) {
  const CommandResult made =
      run(fmt::format("/usr/bin/python3 '{}/examples/{}/generate.py' -o '{}' {}", source_dir(), example,
                      (directory / example).string(), arguments));
  EXPECT_EQ(made.status, 0) << made.output;
  return directory / example / (example + ".pbrt");
}

TEST(OnePicture, HotelRoom) {
  const TemporaryDirectory directory;
  expect_one_picture(directory, generate(directory, "hotel-room", "--detail 0.1 --width 48 --height 32"),
                     Share::all);
}

// With instances of objects.
TEST(OnePicture, City) {
  const TemporaryDirectory directory;
  expect_one_picture(directory, generate(directory, "city", "--triangles 80000 --width 48 --height 32"),
                     Share::all, 6);
}

TEST(OnePicture, CornellBox) {
  const TemporaryDirectory directory;
  expect_one_picture(directory, project_file("examples/cornell-box/cornell-box.pbrt"), Share::part);
}

// Every material, texture, light and medium, in a file of each format that has some alone.
TEST(OnePicture, Appearance) {
  const TemporaryDirectory directory;
  expect_one_picture(directory, generate(directory, "appearance", "--width 48 --height 32"), Share::all);
}

TEST(OnePicture, AppearanceOfMitsuba) {
  const TemporaryDirectory directory;
  const auto scene = generate(directory, "appearance", "--width 48 --height 32");
  expect_one_picture(directory, scene.parent_path() / "appearance.xml", Share::part);
}

TEST(OnePicture, AppearanceOfPbrt3) {
  const TemporaryDirectory directory;
  const auto scene = generate(directory, "appearance", "--width 48 --height 32");
  expect_one_picture(directory, scene.parent_path() / "appearance-v3.pbrt", Share::part);
}

TEST(OnePicture, Adversarial) {
  const TemporaryDirectory directory;
  expect_one_picture(directory, generate(directory, "adversarial", ""), Share::part);
}

}  // namespace
}  // namespace vitrail::test::one_picture_test
