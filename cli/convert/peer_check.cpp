// SPDX-License-Identifier: Apache-2.0
#include "cli/convert/peer_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "cli/common/run_program.h"
#include "cli/convert/block_luminances.h"
#include "scene/system/diagnostics.h"
#include "scene/system/temporary_folder.h"

namespace vitrail {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* mitsuba_script =
#include "cli/convert/mitsuba_peer.inc"
    ;

struct Peer {
  const char *extension, *name, *program;
};
constexpr std::array peers{Peer{".xml", "Mitsuba", "python3"}, Peer{".pov", "POV-Ray", "povray"},
                           Peer{".pbrt", "pbrt", "pbrt"}};

const Peer& peer_of(const fs::path& out) {
  const auto found = std::ranges::find(peers, out.extension().string(), &Peer::extension);
  if (found == peers.end())
    throw UsageError("--check=peer has no program that renders " + out.extension().string());
  return *found;
}

// 64 pixels, or about: of the sizes up to 160, the one that comes nearest to the film's shape.
SmallPicture small(const FilmSettings& film) {
  const double shape = std::log(static_cast<double>(film.width) / film.height);
  SmallPicture best{8, 8};
  double least = std::numeric_limits<double>::infinity();
  for (int width = 1; width <= 160; ++width)
    for (int height = std::max(1, 32 / width); width * height <= 160; ++height) {
      const double off = std::abs(std::log(static_cast<double>(width) / height) - shape) +
                         0.01 * std::abs(std::log(width * height / 64.0));
      if (off < least) best = {width, height}, least = off;
    }
  return best;
}

std::string text_of(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

// The line that says what is wrong: the last that has the word, else the last.
std::string last_words(const std::string& text) {
  std::istringstream lines(text);
  std::string last, wrong;
  for (std::string line; std::getline(lines, line);) {
    if (line.find_first_not_of(' ') == std::string::npos) continue;
    last = line;
    if (line.find("Error") != std::string::npos) wrong = line;
  }
  if (!wrong.empty()) return wrong;
  return last.empty() ? "nothing was said" : last;
}

// The input as vitrail shows it, for a peer that does not read it. Pixels of so small a picture are compared
// as boxes, in both: a filter of another reach, which has its own note, would spread a lamp over half of
// them.
std::string picture_of_input(const PeerCheck& check, SmallPicture size, int samples_per_pixel,
                             const TemporaryFolder& folder) {
  const std::string exact = folder.file("before.film"), picture = folder.file("before.exr");
  std::vector<std::string> words = check.options;
  words.insert(words.end(), {check.in.string(), "-o", exact, "--spp", std::to_string(samples_per_pixel),
                             "--width", std::to_string(size.width), "--height", std::to_string(size.height),
                             "--crop", fmt::format("0,{},0,{}", size.width, size.height), "--filter", "box",
                             "--aov", "none", "--quiet"});
  run_program("vitrail-render", words);
  run_program("vitrail-develop", {exact, "-o", picture, "--quiet"});
  return picture;
}

// Mitsuba's words on what was written and a reference: a scene of its own, or a picture.
Json asked(const PeerCheck& check, const std::string& python, SmallPicture size, int samples,
           const std::string& reference, const TemporaryFolder& folder) {
  const std::string script = folder.file("peer.py"), said = folder.file("said.json"),
                    errors = folder.file("errors");
  std::ofstream(script) << mitsuba_script;
  const ForeignEnd end =
      run_foreign({python, script, fs::absolute(check.out).string(), reference, std::to_string(size.width),
                   std::to_string(size.height), std::to_string(samples)},
                  said, errors);
  if (!end.found) return {{"missing", python + " is not there"}};
  const Json result = Json::parse(text_of(said), nullptr, false);
  if (end.status == 0 && result.is_object()) return result;
  return {
      {"variants",
       {{{"variant", "any"}, {"loads", false}, {"passed", false}, {"said", last_words(text_of(errors))}}}}};
}

bool is_not_compared(const Json& variant) { return variant.contains("not_compared"); }

// Of `samples` for each of eight seeds.
Json once_in_mitsuba(const PeerCheck& check, const std::string& python, SmallPicture size, int samples,
                     const TemporaryFolder& folder) {
  const auto by_vitrail = [&] {
    return asked(check, python, size, samples, picture_of_input(check, size, 16 * samples, folder), folder);
  };
  if (check.in.extension() != ".xml" || !check.options.empty()) return by_vitrail();
  Json found = asked(check, python, size, samples, fs::absolute(check.in).string(), folder);
  if (found.contains("missing") || std::ranges::none_of(found["variants"], is_not_compared)) return found;
  const Json others = by_vitrail();  // where Mitsuba shows nothing of the input
  for (const Json& variant : others.at("variants"))
    for (Json& refused : found["variants"])
      if (is_not_compared(refused) && refused["variant"] == variant["variant"]) {
        const Json why = refused["not_compared"];
        refused = variant;
        refused["not_compared"] = why;
      }
  return found;
}

// Whether the noise leaves no room for a difference that is beyond the tolerance.
bool is_decided(const Json& variant) {
  if (!variant.contains("pixel_noise")) return true;
  const double tolerance = variant.at("tolerance");
  return 4 * variant.at("mean_noise").get<double>() <= tolerance &&
         4 * variant.at("pixel_noise").get<double>() <= 5 * tolerance;
}

Json in_mitsuba(const PeerCheck& check, const std::string& python, const FilmSettings& film,
                const TemporaryFolder& folder) {
  constexpr std::array samples{64, 256, 1024};
  constexpr std::chrono::seconds most{10};  // of a round: the next takes up to four times as long
  Json found;
  for (const int count : samples) {
    const auto start = std::chrono::steady_clock::now();
    found = once_in_mitsuba(check, python, small(film), count, folder);
    if (found.contains("missing") || std::ranges::all_of(found["variants"], is_decided) ||
        std::chrono::steady_clock::now() - start > most)
      break;
  }
  return found;
}

// Programs whose exit status says whether they take a scene.
Json in_program(const std::vector<std::string>& words, const TemporaryFolder& folder) {
  const std::string said = folder.file("said"), errors = folder.file("errors");
  const ForeignEnd end = run_foreign(words, said, errors);
  if (!end.found) return {{"missing", words.front() + " is not there"}};
  Json variant{{"variant", "any"}, {"loads", end.status == 0}, {"passed", end.status == 0}};
  if (end.status != 0) variant["said"] = last_words(text_of(errors));
  return {{"variants", {variant}}};
}

// POV-Ray's picture of a scene, in linear colours. It looks for images in its working directory and in those
// of +L, not beside the scene.
Json picture_by_povray(const std::string& program, const fs::path& scene, SmallPicture size,
                       const std::string& picture, const TemporaryFolder& folder) {
  return in_program(
      {program, "+I" + scene.string(), "+L" + scene.parent_path().string(), fmt::format("+W{}", size.width),
       fmt::format("+H{}", size.height), "-D", "+A0.0", "+AM1", "+R4", "-J", "+FE", "+O" + picture},
      folder);
}

// Blocks of a larger picture are compared: POV-Ray filters no pixel beyond its edges.
Json in_povray(const PeerCheck& check, const std::string& program, const FilmSettings& film,
               const TemporaryFolder& folder) {
  constexpr double tolerance = 0.02;
  const SmallPicture size = small(film),
                     all{size.width * SmallPicture::block, size.height * SmallPicture::block};
  const std::string after = folder.file("after.exr"), before = folder.file("itself.exr");
  Json found = picture_by_povray(program, fs::absolute(check.out), all, after, folder);
  if (found.contains("missing") || !found["variants"][0]["passed"].get<bool>()) return found;
  Json& variant = found["variants"][0];
  bool reads_input = check.in.extension() == ".pov" && check.options.empty();
  if (reads_input) {
    const Json input = picture_by_povray(program, fs::absolute(check.in), all, before, folder)["variants"][0];
    if (!input["passed"].get<bool>()) {
      variant["not_compared"] = input["said"];
      reads_input = false;
    }
  }
  const std::string reference = reads_input ? before : picture_of_input(check, all, 64, folder);
  variant["compared_with"] = reads_input ? "itself" : "vitrail";
  variant.update(
      compare_luminances(block_luminances(after, size), block_luminances(reference, size), tolerance));
  return found;
}

// Programs go on to print all that they were given.
std::string first_line(const Json& v, const char* key) {
  const std::string text = v.at(key);
  return text.substr(0, text.find('\n'));
}

std::string noise_in_words(const Json& v, const char* key, int digits) {
  return v.contains(key) ? fmt::format(" ± {:.{}f} %", 100 * v.at(key).get<double>(), digits) : "";
}

std::string variant_in_words(const std::string& name, const Json& v) {
  if (!v.at("loads").get<bool>()) return fmt::format("{} refuses it: {}", name, first_line(v, "said"));
  if (v.contains("said")) return fmt::format("{} ruins it: {}", name, first_line(v, "said"));
  const std::string refused =
      v.contains("not_compared") ? "; of the input it says: " + first_line(v, "not_compared") : "";
  if (!v.contains("luminance_ratio"))
    return name + (v.at("passed").get<bool>() ? " renders it" : " shows light where the input has none") +
           refused;
  return fmt::format(
      "{} shows it {} {} shows the input: luminance {:+.2f} %{}, a pixel of 64 by up to {:.1f} %{}{}", name,
      v.at("passed").get<bool>() ? "as" : "otherwise than",
      v.at("compared_with") == "itself" ? "it" : "vitrail", 100 * (v.at("luminance_ratio").get<double>() - 1),
      noise_in_words(v, "mean_noise", 2), 100 * v.at("worst_pixel").get<double>(),
      noise_in_words(v, "pixel_noise", 1), refused);
}

}  // namespace

Json check_in_peer(const PeerCheck& check, const FilmSettings& film) {
  const Peer& peer = peer_of(check.out);
  const std::string program = check.program.empty() ? peer.program : check.program;
  const TemporaryFolder folder;
  Json found{{"name", peer.name}};
  if (std::string_view(peer.name) == "Mitsuba")
    found.update(in_mitsuba(check, program, film, folder));
  else if (std::string_view(peer.name) == "POV-Ray")
    found.update(in_povray(check, program, film, folder));
  else
    found.update(in_program(
        {program, "--spp", "1", "--outfile", folder.file("picture.exr"), fs::absolute(check.out).string()},
        folder));
  if (found.contains("missing")) {
    if (!check.program.empty()) throw UsageError("--peer: " + found.at("missing").get<std::string>());
    return found;
  }
  found["passed"] =
      std::ranges::all_of(found.at("variants"), [](const Json& v) { return v.at("passed").get<bool>(); });
  return found;
}

std::string peer_in_words(const Json& peer, const char* between) {
  const std::string name = peer.at("name");
  if (peer.contains("missing"))
    return fmt::format("not looked at in {}: {}", name, peer.at("missing").get<std::string>());
  std::string words;
  for (const Json& v : peer.at("variants")) {
    const std::string variant = v.at("variant");
    words +=
        (words.empty() ? "" : between) + variant_in_words(variant == "any" ? name : name + " " + variant, v);
  }
  return words;
}

}  // namespace vitrail
