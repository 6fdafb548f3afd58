// SPDX-License-Identifier: Apache-2.0
// How fast and how lean a large mesh is read in each form, beside other readers and beside reading its bytes;
// the fastest of interleaved runs, each in a process of its own, so that peaks of memory are its own. The
// files stay in the page cache. Seconds by themselves mean little on a shared machine: the ratios are within
// one run.
//
//   bench_import [--triangles N] [--runs N] [--folder DIR] [--form NAME] [--reader NAME]
//
// DIR keeps the files for the next time (10 M triangles: 6 GB); without it they go when the program ends.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>

#include "tests/bench/import_files.h"
#include "tests/bench/import_readers.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::bench {
namespace {

struct Options {
  std::uint32_t triangles = 10'000'000;
  int runs = 3;
  std::string folder, form, reader;
};

// In a child: this program with --measure.
Measurement measure_apart(const std::string& program, const std::string& reader, const std::string& file) {
  const std::string command = fmt::format("'{}' --measure '{}' '{}'", program, reader, file);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(::popen(command.c_str(), "r"), &::pclose);
  Measurement m;
  if (!pipe || std::fscanf(pipe.get(), "%lf %lf %lu %lu %lu %lu", &m.seconds, &m.cpu_seconds, &m.peak_bytes,
                           &m.final_bytes, &m.triangles, &m.digest) != 6) {
    fmt::print(stderr, "bench_import: {} failed on {}\n", reader, file);
    std::exit(1);
  }
  return m;
}

bool reads(const std::string& reader, const MeshFile& file) {
  const std::string extension = file.path.extension();
  if (reader == "tinyobjloader") return extension == ".obj";
  return reader != "assimp" || extension != ".pbrt";
}

Measurement fastest(const std::vector<Measurement>& runs) {
  return *std::ranges::min_element(runs, {}, &Measurement::seconds);
}

using Results = std::map<std::string, Measurement>;  // of one file, by reader

Results measure_all(const std::string& program, const MeshFile& file, const Options& options) {
  std::map<std::string, std::vector<Measurement>> runs;
  measure_apart(program, "read", file.path);  // fills the page cache
  for (int run = 0; run < options.runs; ++run)
    for (const std::string& reader : readers()) {
      const bool wanted = options.reader.empty() || reader == options.reader || reader == "vitrail";
      if (wanted && reads(reader, file)) runs[reader].push_back(measure_apart(program, reader, file.path));
    }
  Results results;
  for (const auto& [reader, measurements] : runs) results[reader] = fastest(measurements);
  return results;
}

void print_row(const MeshFile& file, const Results& results, const std::string& reader) {
  const Measurement& m = results.at(reader);
  const Measurement& ours = results.at("vitrail");
  const auto triangles = static_cast<double>(ours.triangles);
  const auto megabytes = static_cast<double>(std::filesystem::file_size(file.path)) / 1e6;
  fmt::print("{:18} {:14} {:8.3f} {:8.3f} {:8.0f} {:10.1f} {:10.2f} {:10.2f}\n",
             reader == "vitrail" ? file.form + (file.bare ? ", bare" : "") : "", reader, m.seconds,
             m.cpu_seconds, megabytes / m.seconds, static_cast<double>(m.peak_bytes) / triangles,
             static_cast<double>(m.peak_bytes) / static_cast<double>(ours.final_bytes),
             m.seconds / ours.seconds);
  std::fflush(stdout);
}

void run(const std::string& program, const Options& options) {
  std::unique_ptr<test::TemporaryDirectory> temporary;
  std::filesystem::path folder = options.folder;
  if (options.folder.empty()) {
    temporary = std::make_unique<test::TemporaryDirectory>();
    folder = temporary->path();
  }
  std::filesystem::create_directories(folder);
  std::map<bool, std::uint64_t> digests;
  fmt::print("{:18} {:14} {:>8} {:>8} {:>8} {:>10} {:>10} {:>10}\n", "form", "reader", "seconds", "cpu s",
             "MB/s", "peak B/tri", "peak/mesh", "time/ours");
  for (const MeshFile& file : write_mesh_files(folder, options.triangles)) {
    if (!options.form.empty() && file.form != options.form) continue;
    const Results results = measure_all(program, file, options);
    print_row(file, results, "vitrail");
    for (const auto& [reader, measurement] : results)
      if (reader != "vitrail") print_row(file, results, reader);
    const std::uint64_t digest = results.at("vitrail").digest;
    if (digests.try_emplace(file.bare, digest).first->second != digest)
      fmt::print("{} is another mesh than the forms before it\n", file.form);
  }
}

void print_measurement(const std::string& reader, const std::string& file) {
  const Measurement m = measure(reader, file);
  fmt::print("{} {} {} {} {} {}\n", m.seconds, m.cpu_seconds, m.peak_bytes, m.final_bytes, m.triangles,
             m.digest);
}

}  // namespace
}  // namespace vitrail::bench

int main(int argc, char** argv) {
  using namespace vitrail::bench;
  const std::vector<std::string> words(argv + 1, argv + argc);
  try {
    if (words.size() == 3 && words[0] == "--measure") {
      print_measurement(words[1], words[2]);
      return 0;
    }
    Options options;
    for (std::size_t i = 0; i + 1 < words.size(); i += 2) {
      if (words[i] == "--triangles") options.triangles = static_cast<std::uint32_t>(std::stoul(words[i + 1]));
      if (words[i] == "--runs") options.runs = std::stoi(words[i + 1]);
      if (words[i] == "--folder") options.folder = words[i + 1];
      if (words[i] == "--form") options.form = words[i + 1];
      if (words[i] == "--reader") options.reader = words[i + 1];
    }
    run(argv[0], options);
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_import: {}\n", error.what());
    return 1;
  }
}
