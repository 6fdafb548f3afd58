// SPDX-License-Identifier: Apache-2.0
// A bundle and a list of frames, for tests of `render --frames`.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/command.h"
#include "tests/support/paths.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test {

class FramesFixture : public ::testing::Test {
 protected:
  FramesFixture() {
    const CommandResult made = run(fmt::format("{} {}/examples/cornell-box/cornell-box.pbrt -o {} --quiet",
                                               vitrail("partition"), source_dir(), path("box.vit")));
    EXPECT_EQ(made.status, 0) << made.output;
  }
  std::string path(const std::string& name) const { return (directory_ / name).string(); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(directory_ / name, std::ios::binary) << text;
  }
  void write_frames(const std::string& text) const { write("frames.txt", text); }
  // Lines that differ in their seed.
  void write_seeds(int count) const {
    std::string text;
    for (int i = 1; i <= count; ++i) text += fmt::format("--seed {}\n", i);
    write_frames(text);
  }
  std::string command(const std::string& more, const std::string& output = "f%03d.png", int ranks = 1) const {
    return fmt::format("{} {} --width 16 --spp 2 --frames {} -o {} {}",
                       ranks == 1 ? vitrail("render") : mpi_vitrail("render", ranks), path("box.vit"),
                       path("frames.txt"), path(output), more);
  }
  CommandResult render_frames(const std::string& more = "", const std::string& output = "f%03d.png",
                              int ranks = 1) const {
    return run(command(more, output, ranks));
  }
  bool exists(const std::string& name) const { return std::filesystem::exists(directory_ / name); }
  std::string bytes(const std::string& name) const {
    std::ifstream in(directory_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  TemporaryDirectory directory_;
};

}  // namespace vitrail::test
