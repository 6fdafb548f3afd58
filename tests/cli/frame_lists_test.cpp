// SPDX-License-Identifier: Apache-2.0
// Lists of `render --frames` as a farm works on them: parts of one, mistakes in it, frames that fail, and
// pictures that are not what they were.
#include <gmock/gmock.h>

#include "tests/cli/frames_fixture.h"

namespace vitrail::test::frame_lists_test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

int count_of(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != text.npos; at += part.size()) ++count;
  return count;
}

class FrameLists : public FramesFixture {};

TEST_F(FrameLists, AreRenderedInParts) {
  write_seeds(5);
  ASSERT_EQ(render_frames("", "all%03d.png").status, 0);
  for (const int ranks : {1, 2}) {
    const CommandResult part = render_frames("--force --range 5,2-5x2", "f%03d.png", ranks);
    ASSERT_EQ(part.status, 0) << part.output;
    EXPECT_THAT(part.output, AllOf(HasSubstr("frame 5 (1 of 3): "), HasSubstr("frame 2 (2 of 3): "),
                                   HasSubstr("frame 4 (3 of 3): ")));
    for (const char* number : {"002", "004", "005"})
      EXPECT_EQ(bytes(fmt::format("f{}.png", number)), bytes(fmt::format("all{}.png", number))) << number;
    EXPECT_FALSE(exists("f001.png") || exists("f003.png"));
  }
  ASSERT_EQ(render_frames("--range 1").status, 0);
  EXPECT_EQ(bytes("f001.png"), bytes("all001.png"));
  EXPECT_EQ(render_frames("--range 1-5").status, 0);
  EXPECT_EQ(bytes("f003.png"), bytes("all003.png"));
}

TEST_F(FrameLists, HaveThePartsThatAreAskedFor) {
  write_seeds(5);
  const std::pair<const char*, const char*> bad[] = {
      {"1-3,x", "at character 5, \"x\""},
      {"0", "at character 1, \"0\""},
      {"", "at character 1, \"\""},
      {"4-2", "at character 3, \"2\": 2 comes before 4"},
      {"1-6", "at character 3, \"6\": there is no frame 6, as the list has 5 frames"},
      {"3,99999999999999999999", "at character 3"},
      {"1-5x0", "at character 5, \"0\": a step has to follow"},
      {"1-3;5", "at character 4, \";5\": a comma has to follow"},
      {"1,", "at character 3"}};
  for (const auto& [range, words] : bad) {
    const CommandResult refused = render_frames(fmt::format("--range '{}'", range));
    EXPECT_EQ(refused.status, 2) << range << refused.output;
    EXPECT_THAT(refused.output, HasSubstr(words)) << range;
  }
  EXPECT_FALSE(exists("f001.png"));
  for (const char* option : {"--range 1", "--retries 2"}) {
    const CommandResult refused =
        run(fmt::format("{} {} {} -o {}", vitrail("render"), path("box.vit"), option, path("f.png")));
    EXPECT_EQ(refused.status, 2) << refused.output;
    EXPECT_THAT(refused.output, HasSubstr("--frames"));
  }
}

TEST_F(FrameLists, AreCheckedBeforeTheFirstFrame) {
  write_frames(
      "--seed 1\n"
      "--set area-9.scale=.5\n"
      "--seed 2   --set area-1.scale=x # a number\n"
      "--camera none.pbrt\n"
      "\n"
      "--seed 4 --threads 2\n"
      "--seed 5\n");
  for (const int ranks : {1, 2}) {
    const CommandResult refused = render_frames("", "f%03d.png", ranks);
    EXPECT_EQ(refused.status, 3);
    EXPECT_THAT(refused.output,
                AllOf(HasSubstr("frames.txt:2:1: --set area-9.scale=.5: no light has this name"),
                      HasSubstr("frames.txt:3:12: --set area-1.scale=x: "), HasSubstr("frames.txt:4:1: "),
                      HasSubstr("none.pbrt"), HasSubstr("frames.txt:6:10: a frame has --camera"),
                      HasSubstr("4 of 6 frames cannot be rendered, so none was")));
    EXPECT_FALSE(exists("f001.png"));
  }
  EXPECT_EQ(render_frames("--range 1,6").status, 0);
  EXPECT_TRUE(exists("f001.png") && exists("f006.png"));
}

TEST_F(FrameLists, NameTenMistakesAndCountThem) {
  std::string text;
  for (int i = 0; i < 12; ++i) text += "--set area-9.scale=2\n";
  write_frames(text);
  const CommandResult refused = render_frames();
  EXPECT_EQ(refused.status, 3);
  EXPECT_EQ(count_of(refused.output, "no light has this name"), 10) << refused.output;
  EXPECT_THAT(refused.output, HasSubstr("12 of 12 frames cannot be rendered, so none was; the first 10"));
}

TEST_F(FrameLists, DoNotAnswerForTheirCommand) {
  write_seeds(3);
  const CommandResult refused = render_frames("--set area-9.scale=2");
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.output, AllOf(HasSubstr("no light has this name"), Not(HasSubstr("frames.txt"))));
  const CommandResult nowhere = render_frames("", "none/f%03d.png");
  EXPECT_EQ(nowhere.status, 4);
  EXPECT_THAT(nowhere.output, HasSubstr("make this folder first"));
  const CommandResult folders = render_frames("", "%03d/f.png");
  EXPECT_EQ(folders.status, 2);
  EXPECT_THAT(folders.output, HasSubstr("not their folders"));
}

TEST_F(FrameLists, PassByFramesThatFail) {
  write_seeds(4);
  for (const int ranks : {1, 2}) {
    fs::create_directory(path("f002.png.work.lock"));
    write("f003.png.partial", "no film");
    const CommandResult most = render_frames("--force", "f%03d.png", ranks);
    EXPECT_EQ(most.status, 4);
    EXPECT_TRUE(exists("f001.png") && exists("f003.png") && exists("f004.png"));
    EXPECT_FALSE(exists("f002.png"));
    EXPECT_THAT(most.output, HasSubstr("vitrail: 1 of 4 frames failed: " + path("f002.png") +
                                       " (status 4); the same command tries them again"));
    fs::remove(path("f002.png.work.lock"));
    fs::remove(path("f001.png"));
    write("f001.png.work", "no film");
    const CommandResult rest = render_frames("--retries 3", "f%03d.png", ranks);
    EXPECT_EQ(rest.status, 3) << rest.output;
    EXPECT_TRUE(exists("f002.png"));
    EXPECT_EQ(count_of(rest.output, "frame 1 of 4: "), 1) << rest.output;
    fs::remove(path("f001.png.work"));
    EXPECT_EQ(render_frames("", "f%03d.png", ranks).status, 0);
    fs::remove(path("f002.png"));
  }
}

TEST_F(FrameLists, TryAgainWhatTheMachineFailed) {
  write_seeds(6);
  fs::create_directory(path("f002.png.work.lock"));
  const CommandResult never = render_frames("--retries 2");
  EXPECT_EQ(never.status, 4);
  EXPECT_EQ(count_of(never.output, "cannot write " + path("f002.png.work.lock")), 3) << never.output;
  for (const int number : {1, 3, 4, 5, 6}) fs::remove(path(fmt::format("f{:03}.png", number)));
  const CommandResult at_last = run(fmt::format(
      "((for i in $(seq 3000); do [ -e {} ] && break; sleep .02; done; rmdir {}) & {}; s=$?; wait; exit $s)",
      path("f003.png"), path("f002.png.work.lock"), command("--retries 1 --spp 200")));
  EXPECT_EQ(at_last.status, 0) << at_last.output;
  EXPECT_TRUE(exists("f002.png"));
}

TEST_F(FrameLists, AreRenderedAgainWhereAPictureIsDamaged) {
  write_seeds(3);
  for (const std::string kind : {"png", "exr", "jpg"}) {
    const std::string output = "f%03d." + kind, second = "f002." + kind;
    ASSERT_EQ(render_frames("", output).status, 0);
    const std::string whole = bytes(second);
    const std::vector<std::string> damages{"", "no picture", whole.substr(0, whole.size() / 2)};
    for (const std::string& damage : damages) {
      write(second, damage);
      const CommandResult mended = render_frames("", output, damage.empty() ? 2 : 1);
      EXPECT_EQ(mended.status, 0) << mended.output;
      EXPECT_THAT(mended.output, AllOf(HasSubstr(path(second) + " is damaged and is rendered again: "),
                                       HasSubstr("f001." + kind + " is there and stays")));
      EXPECT_EQ(bytes(second).size(), whole.size()) << kind << damage.size();
      // An .exr says how long it took.
      EXPECT_TRUE(kind == "exr" || bytes(second) == whole) << kind << damage.size();
    }
  }
}

// A job may be killed after its picture is named and before it has tidied up.
TEST_F(FrameLists, RemoveWhatAKilledJobLeftBesideAWholePicture) {
  write_seeds(2);
  ASSERT_EQ(render_frames().status, 0);
  write("f001.png.work", "a film"), write("f001.png.work.lock", "process 1 on another-host");
  write("f002.png.work.lock", "process 1 on another-host");
  const CommandResult again = render_frames();
  EXPECT_THAT(again.output, AllOf(HasSubstr("f001.png is there and stays"), HasSubstr("f002.png is there")));
  for (const char* left : {"f001.png.work", "f001.png.work.lock", "f002.png.work.lock"})
    EXPECT_FALSE(exists(left)) << left;
}

TEST_F(FrameLists, AreRefusedWhereAPictureIsAnother) {
  write_seeds(2);
  ASSERT_EQ(render_frames().status, 0);
  const std::string first = bytes("f001.png"), second = bytes("f002.png");
  ASSERT_NE(first, second);
  write("f001.png", second), write("f002.png", first);
  const CommandResult exchanged = render_frames();
  EXPECT_EQ(exchanged.status, 3);
  EXPECT_THAT(exchanged.output,
              AllOf(HasSubstr("f001.png: this picture is not what its line asks for: it was "
                              "changed or exchanged since it was rendered (1 more differ)")));
  EXPECT_EQ(bytes("f001.png"), second);
  write("f001.png", first), write("f002.png", second);
  EXPECT_EQ(render_frames().status, 0);
}

// By versions that kept no marks of pictures.
TEST_F(FrameLists, TakePicturesFromBefore) {
  write_seeds(2);
  ASSERT_EQ(render_frames().status, 0);
  const auto forget = [&] {
    nlohmann::json record = read_json(path("fframes.png.json"));
    for (auto& picture : record["pictures"]) EXPECT_EQ(picture.erase("file"), 1u);
    write("fframes.png.json", record.dump());
  };
  const std::string first = bytes("f001.png");
  ASSERT_EQ(render_frames("--width 8", "small%03d.png").status, 0);
  ASSERT_EQ(render_frames("--alpha", "alpha%03d.png").status, 0);
  forget();
  write("f001.png", bytes("small001.png"));
  const CommandResult small = render_frames();
  EXPECT_EQ(small.status, 3);
  EXPECT_THAT(small.output, HasSubstr("it has 8 × 8 pixels, this command 16 × 16"));
  write("f001.png", bytes("alpha001.png"));
  const CommandResult other = render_frames();
  EXPECT_EQ(other.status, 3);
  EXPECT_THAT(other.output, HasSubstr("it has 4 channels, this command 3"));
  write("f001.png", first.substr(0, 300));
  EXPECT_THAT(render_frames().output, HasSubstr("f001.png is damaged and is rendered again"));
  EXPECT_EQ(bytes("f001.png"), first);
  forget();
  EXPECT_THAT(render_frames().output, HasSubstr("f001.png is there and stays"));
  EXPECT_TRUE(read_json(path("fframes.png.json"))["pictures"]["f002.png"].contains("file"));
}

TEST_F(FrameLists, OfSensorsAreHeldToTheirTables) {
  write_seeds(2);
  write("desk.txt", "0 .1 0 0 1 0\n.1 .1 0 0 1 0\n");
  const auto tables = [&] {
    return run(fmt::format("{} {} --spp 1 --sensors {} --frames {} -o {}", vitrail("render"), path("box.vit"),
                           path("desk.txt"), path("frames.txt"), path("desk%d.csv")));
  };
  const CommandResult made = tables();
  ASSERT_EQ(made.status, 0) << made.output;
  const std::string first = bytes("desk1.csv");
  write("desk1.csv", "");
  EXPECT_THAT(tables().output, AllOf(HasSubstr("desk1.csv is damaged"), HasSubstr("desk2.csv is there")));
  EXPECT_EQ(bytes("desk1.csv"), first);
}

TEST_F(FrameLists, SayHowFarTheyAre) {
  write_seeds(3);
  const CommandResult lines = render_frames();
  EXPECT_THAT(lines.output, testing::ContainsRegex("frame 3 of 3: [^\n]*f003.png; about [^\n]* left"));
  const CommandResult events = run(command("--progress json --force") + " 2>/dev/null");
  EXPECT_THAT(events.output, AllOf(HasSubstr("{\"event\":\"frame\",\"frame\":3,"),
                                   HasSubstr("\"frames\":3,\"frames_done\":2,")));
}

TEST_F(FrameLists, AreSupervised) {
  write_seeds(4);
  const CommandResult done = run(fmt::format(
      "((for i in $(seq 3000); do [ -e {0} ] && break; sleep .02; done; kill -KILL $(pgrep -f '[-]-held-lock "
      "{1}' | head -1)) & {2}; "
      "s=$?; wait; exit $s)",
      path("f002.png"), path("fframes"), command("--restarts 2 --spp 300 --checkpoint-every .1")));
  EXPECT_EQ(done.status, 0) << done.output;
  EXPECT_THAT(done.output,
              AllOf(HasSubstr("ended with status 137 (killed"), HasSubstr("f001.png is there and stays")));
  EXPECT_TRUE(exists("f004.png"));
  for (const auto& entry : fs::directory_iterator(directory_.path()))
    EXPECT_NE(entry.path().extension(), ".lock") << entry.path();
}

// Five of the frames that are not there, from the first to the last.
TEST_F(FrameLists, ADryRunSaysHowLongTheyTake) {
  write_seeds(9);
  ASSERT_EQ(render_frames("--range 2").status, 0);
  const CommandResult dry = render_frames("--dry-run");
  EXPECT_EQ(dry.status, 0) << dry.output;
  EXPECT_THAT(dry.output, testing::HasSubstr("frame 1 of 9"));
  EXPECT_THAT(dry.output, testing::HasSubstr("frame 9 of 9"));
  EXPECT_THAT(dry.output, testing::Not(testing::HasSubstr("frame 4 of 9")));
  EXPECT_THAT(dry.output, testing::ContainsRegex("list: about .* machine hours for 8 frames, by 5 of them"));
  EXPECT_FALSE(exists("f001.png"));
}

}  // namespace
}  // namespace vitrail::test::frame_lists_test
