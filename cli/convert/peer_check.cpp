// SPDX-License-Identifier: Apache-2.0
#include "cli/convert/peer_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <fstream>
#include <limits>

#include "cli/common/run_program.h"
#include "cli/convert/own_picture.h"
#include "scene/system/diagnostics.h"
#include "scene/system/temporary_folder.h"

namespace vitrail {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

const OwnProgram& peer_of(const fs::path& out) {
  const OwnProgram* found = own_program(out);
  if (!found) throw UsageError("--check=peer has no program that renders " + out.extension().string());
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

// The input as vitrail shows it, for a peer that does not read it. Pixels of so small a picture are compared
// as boxes, in both: a filter of another reach, which has its own note, would spread a lamp over half of
// them.
std::string picture_of_input(const PeerCheck& check, SmallPicture size, int samples_per_pixel,
                             const TemporaryFolder& folder) {
  const std::string exact = folder.file("before.film");
  std::string picture = folder.file("before.exr");
  std::vector<std::string> words = check.options;
  words.insert(words.end(), {check.in.string(), "-o", exact, "--spp", std::to_string(samples_per_pixel),
                             "--width", std::to_string(size.width), "--height", std::to_string(size.height),
                             "--crop", fmt::format("0,{},0,{}", size.width, size.height), "--filter", "box",
                             "--aov", "none", "--quiet"});
  run_program("vitrail-render", words);
  run_program("vitrail-develop", {exact, "-o", picture, "--quiet"});
  return picture;
}

// The picture of the input that the written one is to be compared with: that of its own program, else ours.
struct Reference {
  // "itself", where that is the peer; "POV-Ray" …, "vitrail". Of one that shows nothing: who says why.
  std::string shown_by;
  Luminances luminances;
  std::string not_shown;  // the words of its own program, where that is there and shows nothing
};

Reference by_vitrail(const PeerCheck& check, SmallPicture size, const TemporaryFolder& folder) {
  const SmallPicture all{size.width * SmallPicture::block, size.height * SmallPicture::block};
  return {"vitrail", {block_luminances(picture_of_input(check, all, 64, folder), size), {}}, {}};
}

// Programs of others know nothing of the options of reading.
Reference by_its_program(const PeerCheck& check, SmallPicture size, const TemporaryFolder& folder) {
  const OwnProgram* own = check.options.empty() ? own_program(check.in) : nullptr;
  if (!own) return {};
  const bool is_peer = own == own_program(check.out);
  OwnPicture shown = own_picture(check.in, is_peer ? check.program : check.program_of_input, size, folder);
  if (shown.is_missing && !is_peer && !check.program_of_input.empty())
    throw UsageError("--peer-of-input: " + shown.said);
  if (!shown.luminances.means.empty())
    return {is_peer ? "itself" : own->name, std::move(shown.luminances), {}};
  return {is_peer ? "it" : own->name, {}, shown.is_missing ? "" : shown.said};
}

void note_refusal(const Reference& input, Json& variant) {
  variant["not_compared"] = input.not_shown;
  variant["not_compared_by"] = input.shown_by;
}

// Where the pictures differ: whose side ours is on, which tells reading from writing.
void ask_vitrail(const PeerCheck& check, SmallPicture size, const Luminances& written, const Reference& input,
                 const TemporaryFolder& folder, Json& variant) {
  constexpr double tolerance = 0.02;
  if (variant.at("passed").get<bool>() || input.shown_by == "vitrail") return;
  const Luminances ours = by_vitrail(check, size, folder).luminances;
  const bool as_written = compare_luminances(written, ours, tolerance).at("passed"),
             as_input = compare_luminances(ours, input.luminances, tolerance).at("passed");
  variant["vitrail_shows"] = as_written ? "that of what was written"
                             : as_input ? "that of the input"
                                        : "neither";
}

// Mitsuba's words on what was written and a reference: a scene of its own, or a picture.
Json asked(const PeerCheck& check, const std::string& python, SmallPicture size, int samples,
           const std::string& reference, const TemporaryFolder& folder) {
  const Answer answer = ask_mitsuba(python,
                                    {fs::absolute(check.out).string(), reference, std::to_string(size.width),
                                     std::to_string(size.height), std::to_string(samples)},
                                    folder);
  if (answer.is_missing) return {{"missing", answer.said}};
  if (!answer.json.is_null()) return answer.json;
  return {{"variants", {{{"variant", "any"}, {"loads", false}, {"passed", false}, {"said", answer.said}}}}};
}

bool is_not_compared(const Json& variant) { return variant.contains("not_compared"); }

// Beside the picture of the input's own program.
Json beside(const PeerCheck& check, const std::string& python, SmallPicture size, int samples,
            const Reference& input, const TemporaryFolder& folder) {
  const std::string pixels = folder.file("input.json");
  std::ofstream(pixels) << nlohmann::json{input.luminances.means, input.luminances.noise};
  Json found = asked(check, python, size, samples, pixels, folder);
  if (found.contains("missing")) return found;
  for (Json& variant : found.at("variants"))
    if (variant.contains("compared_with")) {
      variant["compared_with"] = input.shown_by;
      ask_vitrail(check, size, {variant.at("luminances"), variant.at("noise")}, input, folder, variant);
    }
  return found;
}

// Of `samples` for each of eight seeds. `input`: as its own program shows it, where that is another.
Json once_in_mitsuba(const PeerCheck& check, const std::string& python, SmallPicture size, int samples,
                     const Reference& input, const TemporaryFolder& folder) {
  const auto by_ours = [&] {
    return asked(check, python, size, samples, picture_of_input(check, size, 16 * samples, folder), folder);
  };
  if (!input.luminances.means.empty()) return beside(check, python, size, samples, input, folder);
  if (check.in.extension() != ".xml" || !check.options.empty()) {
    Json found = by_ours();
    if (!input.not_shown.empty() && !found.contains("missing"))
      for (Json& variant : found.at("variants")) note_refusal(input, variant);
    return found;
  }
  Json found = asked(check, python, size, samples, fs::absolute(check.in).string(), folder);
  if (found.contains("missing") || std::ranges::none_of(found["variants"], is_not_compared)) return found;
  const Json others = by_ours();  // where Mitsuba shows nothing of the input
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
  const Reference input =
      check.in.extension() == ".xml" ? Reference{} : by_its_program(check, small(film), folder);
  Json found;
  for (const int count : samples) {
    const auto start = std::chrono::steady_clock::now();
    found = once_in_mitsuba(check, python, small(film), count, input, folder);
    if (found.contains("missing") || std::ranges::all_of(found["variants"], is_decided) ||
        std::chrono::steady_clock::now() - start > most)
      break;
  }
  if (found.contains("variants"))
    for (Json& variant : found["variants"]) variant.erase("luminances"), variant.erase("noise");
  return found;
}

// POV-Ray and pbrt: blocks of a larger picture are compared, as POV-Ray filters no pixel beyond its edges.
Json in_program(const PeerCheck& check, const std::string& program, const FilmSettings& film,
                const TemporaryFolder& folder) {
  constexpr double tolerance = 0.02;
  const SmallPicture size = small(film);
  const OwnPicture written = own_picture(check.out, program, size, folder);
  if (written.is_missing) return {{"missing", written.said}};
  const bool loads = !written.luminances.means.empty();
  Json variant{{"variant", "any"}, {"loads", loads}, {"passed", loads}};
  if (!loads) {
    variant["said"] = written.said;
    return {{"variants", {variant}}};
  }
  Reference input = by_its_program(check, size, folder);
  if (!input.not_shown.empty()) note_refusal(input, variant);
  if (input.luminances.means.empty()) input = by_vitrail(check, size, folder);
  variant["compared_with"] = input.shown_by;
  variant.update(compare_luminances(written.luminances, input.luminances, tolerance));
  ask_vitrail(check, size, written.luminances, input, folder, variant);
  return {{"variants", {variant}}};
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
  std::string refused;
  if (v.contains("not_compared"))
    refused = fmt::format("; of the input {} says: {}", v.value("not_compared_by", "it"),
                          first_line(v, "not_compared"));
  if (v.contains("vitrail_shows"))
    refused += "; vitrail's picture is " + v.at("vitrail_shows").get<std::string>();
  if (!v.contains("luminance_ratio"))
    return name + (v.at("passed").get<bool>() ? " renders it" : " shows light where the input has none") +
           refused;
  return fmt::format(
      "{} shows it {} {} shows the input: luminance {:+.2f} %{}, a pixel of 64 by up to {:.1f} %{}{}", name,
      v.at("passed").get<bool>() ? "as" : "otherwise than",
      v.at("compared_with") == "itself" ? "it" : v.at("compared_with").get<std::string>(),
      100 * (v.at("luminance_ratio").get<double>() - 1), noise_in_words(v, "mean_noise", 2),
      100 * v.at("worst_pixel").get<double>(), noise_in_words(v, "pixel_noise", 1), refused);
}

}  // namespace

Json check_in_peer(const PeerCheck& check, const FilmSettings& film) {
  const OwnProgram& peer = peer_of(check.out);
  const std::string program = check.program.empty() ? peer.usual : check.program;
  if (!check.program_of_input.empty() && own_program(check.in) == &peer)
    throw UsageError("--peer-of-input: input and output are of one program; name it by --peer");
  const TemporaryFolder folder;
  Json found{{"name", peer.name}};
  if (std::string_view(peer.name) == "Mitsuba")
    found.update(in_mitsuba(check, program, film, folder));
  else
    found.update(in_program(check, program, film, folder));
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
    if (!words.empty()) words += between;
    words += variant_in_words(variant == "any" ? name : fmt::format("{} {}", name, variant), v);
  }
  return words;
}

}  // namespace vitrail
