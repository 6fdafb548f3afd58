// SPDX-License-Identifier: Apache-2.0
// Files that mean harm: a farm renders what strangers upload. Each is refused or read in bounded time and
// memory, with its place and with the exit status of bad input. No test may hang: all run under `timeout`.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstring>
#include <fstream>

#include "tests/support/command.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::hostile_test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string world = "WorldBegin\n";
const std::string triangle =
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2] \"point3 P\" [0 0 0 1 0 0 0 1 0]\n";

class Hostile : public ::testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) const {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  // In the folder, with a small stack and 60 s.
  CommandResult run_here(const std::string& command) const {
    return run(
        fmt::format("cd '{}' && ulimit -s 1024 && {{ timeout 60 {}; }}", folder_.path().string(), command));
  }
  CommandResult run_verb(const std::string& verb, const std::string& words) const {
    return run_here(vitrail(verb) + " " + words);
  }
  void expect_refused(const std::string& verb, const std::string& words, const std::string& what) const {
    const CommandResult result = run_verb(verb, words);
    EXPECT_EQ(result.status, 3) << verb << ' ' << words << '\n' << result.output;
    EXPECT_THAT(result.output, HasSubstr(what));
  }
  void write_image(const std::string& name) const {
    write(name, std::string("Pf\n1 1\n-1\n") + std::string(4, '\0'));
  }
  void make_pipe(const std::string& name) const { ASSERT_EQ(::mkfifo((folder_ / name).c_str(), 0600), 0); }
  // Textures 0 … n, each made of the one before it.
  std::string textures(int n, const std::string& inputs) const {
    write_image("a.pfm");
    std::string text = world + "Texture \"t0\" \"spectrum\" \"imagemap\" \"string filename\" \"a.pfm\"\n";
    for (int i = 0; i < n; ++i)
      text += fmt::format("Texture \"t{}\" \"spectrum\" {}\n", i + 1, fmt::format(fmt::runtime(inputs), i));
    return text + fmt::format("Material \"diffuse\" \"texture reflectance\" \"t{}\"\n", n) + triangle;
  }
  TemporaryDirectory folder_;
};

// ---- Depth and doubling

TEST_F(Hostile, ChainsOfTexturesEndAtALimitWithTheirPlace) {
  write("a.pbrt", textures(20'000, "\"scale\" \"texture tex\" \"t{}\" \"float scale\" 0.9"));
  for (const char* words : {"inspect a.pbrt", "partition a.pbrt -o a.vit", "convert a.pbrt a.pov"}) {
    const std::string verb(words, std::strcspn(words, " "));
    expect_refused(verb, words + verb.size() + 1, "a.pbrt:130:");
    expect_refused(verb, words + verb.size() + 1, "\"t128\" is nested too deeply: at most 128");
  }
}

TEST_F(Hostile, ChainsOfMaterialsEndAtALimitWithTheirPlace) {
  std::string text = world + "MakeNamedMaterial \"m0\" \"string type\" \"diffuse\"\n";
  for (int i = 0; i < 100'000; ++i)
    text += fmt::format(
        "MakeNamedMaterial \"m{}\" \"string type\" \"mix\" \"string materials\" [\"m{}\" \"m0\"]\n", i + 1,
        i);
  write("a.pbrt", text + triangle);
  expect_refused("convert", "a.pbrt a.xml", "\"m128\" is nested too deeply");
}

TEST_F(Hostile, ChainsOfObjectsEndAtALimitWithTheirPlace) {
  std::string text = world + "ObjectBegin \"o0\"\n" + triangle + "ObjectEnd\n";
  for (int i = 0; i < 1000; ++i)
    text += fmt::format("ObjectBegin \"o{}\"\nObjectInstance \"o{}\"\nObjectEnd\n", i + 1, i);
  write("a.pbrt", text + "ObjectInstance \"o1000\"\n");
  expect_refused("inspect", "a.pbrt", "\"o128\" is nested too deeply");
}

TEST_F(Hostile, ElementsThatNobodyReadsAreCountedToo) {
  std::string deep;
  for (int i = 0; i < 200'000; ++i) deep += "<a>";
  for (int i = 0; i < 200'000; ++i) deep += "</a>";
  write("a.xml", "<scene version=\"3.0.0\">\n<float name=\"x\" value=\"1\">" + deep + "</float></scene>");
  expect_refused("inspect", "a.xml", "a.xml:2:");
}

TEST_F(Hostile, DoubledTexturesAreRefusedByTheReader) {
  write("a.pbrt", textures(24, "\"mix\" \"texture tex1\" \"t{0}\" \"texture tex2\" \"t{0}\""));
  expect_refused("partition", "a.pbrt -o a.vit", "a.pbrt:17:");
  EXPECT_FALSE(fs::exists(folder_ / "a.vit"));
}

// What is within the limit is rendered, and where a format has to repeat what is shared it says so.
TEST_F(Hostile, DoubledTexturesWithinTheLimit) {
  write("a.pbrt", "Film \"rgb\" \"integer xresolution\" 4 \"integer yresolution\" 4\n" +
                      textures(13, "\"mix\" \"texture tex1\" \"t{0}\" \"texture tex2\" \"t{0}\""));
  EXPECT_EQ(run_verb("render", "a.pbrt -o a.exr --spp 1 --quiet").status, 0);
  const CommandResult written = run_verb("convert", "a.pbrt a.pov");
  EXPECT_EQ(written.status, 0) << written.output;
  EXPECT_THAT(written.output, HasSubstr("leads to more than 1024 others"));
  EXPECT_LT(fs::file_size(folder_ / "a.pov"), 1u << 16);
}

TEST_F(Hostile, DoubledMaterialsAreRefusedByTheReader) {
  std::string text = world + "MakeNamedMaterial \"m0\" \"string type\" \"diffuse\"\n";
  for (int i = 0; i < 40; ++i)
    text += fmt::format(
        "MakeNamedMaterial \"m{}\" \"string type\" \"mix\" \"string materials\" [\"m{}\" \"m{}\"]\n", i + 1,
        i, i);
  write("a.pbrt", text + "NamedMaterial \"m40\"\n" + triangle);
  expect_refused("inspect", "a.pbrt", "material \"m15\" is made of too many");
}

TEST_F(Hostile, FilesThatIncludeTheNextOneTwice) {
  for (int i = 0; i < 40; ++i)
    write(fmt::format("a{}.pbrt", i), fmt::format("Include \"a{0}.pbrt\"\nInclude \"a{0}.pbrt\"\n", i + 1));
  write("a40.pbrt", "# nothing\n");
  write("a.pbrt", world + "Include \"a0.pbrt\"\n" + triangle);
  expect_refused("inspect", "a.pbrt --include-limit 4M", "come to more than 4 MiB of text; --include-limit");
  for (int i = 0; i < 15; ++i) {
    std::string includes;
    for (int k = 0; k < 8; ++k) includes += fmt::format("<include filename=\"x{}.xml\"/>", i + 1);
    write(fmt::format("x{}.xml", i), "<scene version=\"3.0.0\">" + includes + "</scene>");
  }
  write("x15.xml", "<scene version=\"3.0.0\"></scene>");
  expect_refused("inspect", "x0.xml --include-limit 4M", "come to more than 4 MiB of text");
}

TEST_F(Hostile, AFileMayBeIncludedAgain) {
  write("part.pbrt", triangle);
  write("a.pbrt", world + "Include \"part.pbrt\"\nInclude \"part.pbrt\"\nInclude \"part.pbrt\"\n");
  EXPECT_EQ(run_verb("inspect", "a.pbrt --quiet").status, 0);
}

// ---- Names

TEST_F(Hostile, PicturesLieInTheCurrentFolder) {
  fs::create_directory(folder_ / "outside");
  fs::create_directory(folder_ / "inside");
  for (const std::string& name : {std::string("../outside/x.exr"), (folder_ / "outside/x.exr").string()}) {
    write("inside/a.pbrt", fmt::format("Film \"rgb\" \"string filename\" \"{}\" \"integer xresolution\" 4 "
                                       "\"integer yresolution\" 4\n{}LightSource \"point\"\n{}",
                                       name, world, triangle));
    const CommandResult result =
        run_here("sh -c \"cd inside && " + vitrail("render") + " a.pbrt --spp 1 --quiet\"");
    EXPECT_EQ(result.status, 0) << result.output;
    EXPECT_TRUE(fs::exists(folder_ / "inside/x.exr"));
    EXPECT_TRUE(fs::is_empty(folder_ / "outside"));
    fs::remove(folder_ / "inside/x.exr");
  }
}

TEST_F(Hostile, WhatASceneNamesIsARegularFile) {
  make_pipe("pipe");
  fs::create_symlink("pipe", folder_ / "pipe.png");
  fs::create_symlink("/dev/zero", folder_ / "zero.png");
  for (const char* image : {"pipe.png", "zero.png"}) {
    write("a.pbrt",
          world + fmt::format("Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"{}\"\n", image) +
              "Material \"diffuse\" \"texture reflectance\" \"t\"\n" + triangle);
    expect_refused("inspect", "a.pbrt", "not a file");
    expect_refused("partition", "a.pbrt -o a.vit", "not a file");
  }
  fs::remove(folder_ / "zero.png");
  write("zero.png", "version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\nsize 12345\n");
  expect_refused("partition", "a.pbrt -o a.vit", "git lfs pull");
  make_pipe("scene.obj");
  expect_refused("inspect", "scene.obj", "this is a pipe, not a file");
}

TEST_F(Hostile, TextOfForeignFilesIsNotRepeated) {
  write("secret/shadow", "root:$6$secret:0\n");
  write("scene/a.pbrt", world + "Include \"../secret/shadow\"\n");
  const CommandResult included = run_verb("inspect", "scene/a.pbrt");
  EXPECT_EQ(included.status, 3);
  EXPECT_THAT(included.output, HasSubstr("shadow:1:1"));
  EXPECT_THAT(included.output, Not(HasSubstr("$6$")));
  write("scene/a.obj", "mtllib ../secret/shadow\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const CommandResult library = run_verb("inspect", "scene/a.obj");
  EXPECT_EQ(library.status, 3);
  EXPECT_THAT(library.output, Not(HasSubstr("$6$")));
  // Of the scene's own files it is.
  write("scene/own.pbrt", "Shpae\n");
  write("scene/b.pbrt", world + "Include \"own.pbrt\"\n");
  EXPECT_THAT(run_verb("inspect", "scene/b.pbrt").output, HasSubstr("Shpae"));
}

TEST_F(Hostile, ControlCharactersDoNotReachTheTerminal) {
  write("note.pbrt", world + "Material \"diffuse\" \"float \x1b]0;owned\x07\xff\" 1\n" + triangle);
  write("error.pbrt", world + "Shape \"\x1b[31m\xff\n\"\n");
  for (const char* words : {"inspect note.pbrt", "inspect note.pbrt --json", "convert note.pbrt a.obj",
                            "inspect error.pbrt", "partition note.pbrt -o a.vit"}) {
    const CommandResult result = run_here(vitrail(words));
    EXPECT_THAT(result.output, Not(HasSubstr("\x1b"))) << words;
    EXPECT_THAT(result.output, Not(HasSubstr("\xff"))) << words;
    EXPECT_THAT(result.output, HasSubstr("\\u001b")) << words;
  }
}

TEST_F(Hostile, ARootConfinesWhatASceneReads) {
  write("inside/part.pbrt", triangle);
  write("inside/a.pbrt", world + "Include \"part.pbrt\"\n");
  EXPECT_EQ(run_verb("inspect", "inside/a.pbrt --quiet --root inside").status, 0);
  write("outside.pbrt", triangle);
  write("inside/b.pbrt", world + "Include \"../outside.pbrt\"\n");
  EXPECT_EQ(run_verb("inspect", "inside/b.pbrt --quiet").status, 0);
  fs::create_symlink(folder_ / "outside.pbrt", folder_ / "inside/link.pbrt");
  write("inside/c.pbrt", world + "Include \"link.pbrt\"\n");
  write_image("outside.pfm");
  write("inside/d.pbrt",
        world +
            "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"../outside.pfm\"\n"
            "Material \"diffuse\" \"texture reflectance\" \"t\"\n" +
            triangle);
  for (const std::string scene : {"b", "c", "d"})
    for (const std::string verb : {"inspect", "partition", "convert", "render"}) {
      if (scene == "d" && verb == "convert") continue;  // names the image and reads nothing of it
      const std::string out = verb == "inspect"     ? ""
                              : verb == "convert"   ? "x.obj"
                              : verb == "partition" ? "-o x.vit"
                                                    : "-o x.exr";
      expect_refused(verb, fmt::format("inside/{}.pbrt {} --root inside", scene, out), "--root allows");
    }
}

// ---- Sizes

TEST_F(Hostile, ImagesAreRefusedByWhatTheyState) {
  const std::string one = "\xff\xff";
  write("a.gif", "GIF89a" + one + one + std::string("\x80\0\0", 3) + std::string(6, '\0') + ',' +
                     std::string(4, '\0') + one + one + std::string("\0\2\2D\1\0;", 7));
  const std::string digits = "1" + std::string(26, '0');
  write("b.pfm", "PF\n" + digits + " " + digits + "\n-1\n" + std::string(48, '\0'));
  for (const char* image : {"a.gif", "b.pfm"}) {
    write("a.pbrt",
          world + fmt::format("Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"{}\"\n", image) +
              "Material \"diffuse\" \"texture reflectance\" \"t\"\n" + triangle);
    expect_refused("inspect", "a.pbrt", "cannot read the image");
    expect_refused("partition", "a.pbrt -o a.vit", "cannot read the image");
  }
}

TEST_F(Hostile, InspectKeepsAPromiseOfMemory) {
  std::string text = world + "Shape \"trianglemesh\" \"integer indices\" [";
  for (int i = 0; i < 1'000'000; ++i) text += "0 1 2 ";
  write("a.pbrt", text + "] \"point3 P\" [0 0 0 1 0 0 0 1 0]\n");
  const CommandResult result = run_verb("inspect", "a.pbrt --memory 24M");
  EXPECT_EQ(result.status, 4) << result.output;
  EXPECT_THAT(result.output, HasSubstr("24 MiB of memory are too little"));
}

// ---- Streams

TEST_F(Hostile, OutputThatCannotBeWrittenIsAnError) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  write("a.pbrt", world + triangle);
  for (const char* words :
       {"inspect --json a.pbrt", "inspect a.pbrt", "convert a.pbrt a.obj", "glazing --help",
        "partition a.pbrt -o a.vit", "verify a.vit", "plan --help", "sky 48,2,2026-06-21T12:00+02:00"})
    for (const char* stream : {">/dev/full", ">&-"}) {
      const CommandResult result = run_here(fmt::format("sh -c \"{} {}\"", vitrail(words), stream));
      EXPECT_EQ(result.status, 4) << words << stream << '\n' << result.output;
      EXPECT_THAT(result.output, HasSubstr("cannot write to standard output"));
    }
}

TEST_F(Hostile, FilesOfABundleAreRegular) {
  write("a.pbrt", "Film \"rgb\" \"integer xresolution\" 4 \"integer yresolution\" 4\n" + world + triangle);
  ASSERT_EQ(run_verb("partition", "a.pbrt -o a.vit --quiet").status, 0);
  for (const char* file : {"a.vit/domains/000000.dom", "a.vit/manifest.json", "a.vit/materials.bin"}) {
    fs::rename(folder_ / file, folder_ / "kept");
    make_pipe(file);
    expect_refused("render", "a.vit -o a.exr --spp 1", "not a file");
    const CommandResult verified = run_verb("verify", "a.vit");
    EXPECT_EQ(verified.status, 3) << verified.output;
    fs::remove(folder_ / file);
    fs::rename(folder_ / "kept", folder_ / file);
  }
}

}  // namespace
}  // namespace vitrail::test::hostile_test
