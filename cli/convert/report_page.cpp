// SPDX-License-Identifier: Apache-2.0
#include "cli/convert/report_page.h"

#include <fmt/format.h>

#include <span>

#include "cli/common/grouped_notes.h"
#include "cli/convert/check_conversion.h"
#include "cli/convert/peer_check.h"
#include "scene/system/atomic_file.h"

namespace vitrail {

namespace {

constexpr const char* style =
    "body{font:16px/1.5 sans-serif;max-width:60em;margin:2em auto;padding:0 1em;color:#222}"
    "table{border-collapse:collapse;width:100%}td,th{padding:.3em .6em;text-align:left;vertical-align:top;"
    "border-bottom:1px solid #ddd}.dropped{color:#a00}.approximated{color:#850}.exact{color:#060}"
    "code{font-size:85%;overflow-wrap:anywhere}";

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

std::string cell(std::string_view text) { return fmt::format("<td>{}</td>", text); }
std::string place_of(const SourceLocation& place) {
  const std::string text = to_string(place);
  return text.empty() ? "" : fmt::format("<code>{}</code>", escaped(text));
}

// The first place, and the others behind a word to click on.
std::string places_of(const NoteGroup& group) {
  std::string text = place_of(group.places.front());
  if (group.places.size() == 1) return text;
  text += fmt::format("<details><summary>and {} more</summary>", group.places.size() - 1);
  for (const SourceLocation& place : std::span(group.places).subspan(1)) text += place_of(place) + "<br>";
  return text + "</details>";
}

std::string losses(const Diagnostics& diagnostics) {
  const std::vector<NoteGroup> groups = grouped_notes(diagnostics);
  if (groups.empty()) return "<p>Everything is as it was.</p>\n";
  std::string text =
      "<h2>Differences from the source</h2>\n<table><tr><th><th>times<th>difference<th>where</tr>\n";
  for (const NoteGroup& group : groups)
    text += fmt::format("<tr><td class={0}>{0}</td>{1}{2}{3}</tr>\n", name_of(group.fidelity),
                        cell(fmt::format("{}", group.places.size())), cell(escaped(group.message)),
                        cell(places_of(group)));
  return text + "</table>\n";
}

std::string items_table(const std::vector<ConversionItem>& items) {
  std::string text = "<h2>Every item</h2>\n<table><tr><th>item<th>became<th>where</tr>\n";
  for (const ConversionItem& item : items)
    text += fmt::format("<tr>{0}<td class={1}>{1}</td>{2}</tr>\n", cell(escaped(item.what)),
                        fidelity_of(item), cell(place_of(item.location)));
  return text + "</table>\n";
}

std::string checks_in_words(const ConversionChecks& checks) {
  std::string text;
  if (!checks.pictures.is_null())
    text += fmt::format("<p>{}</p>\n", escaped(pictures_in_words(checks.pictures)));
  if (!checks.peer.is_null()) text += fmt::format("<p>{}</p>\n", escaped(peer_in_words(checks.peer, "; ")));
  return text;
}

}  // namespace

void write_report_page(const std::filesystem::path& file, const std::filesystem::path& in,
                       const std::filesystem::path& out, const ConversionChecks& checks,
                       const Diagnostics& diagnostics, const std::vector<ConversionItem>& items) {
  const ConversionCounts counts = count(items);
  const std::string title = escaped(in.filename().string() + " → " + out.filename().string());
  const std::string page = fmt::format(
      "<!DOCTYPE html>\n<html lang=en><meta "
      "charset=utf-8><meta name=generator "
      "content=vitrail><title>{0}</title><style>{1}</style>\n<h1>{0}</h1>\n"
      "<p>{2} items exact, {3} approximated, {4} dropped</p>\n{5}{6}{7}</html>\n",
      title, style, counts.exact, counts.approximated, counts.dropped, checks_in_words(checks),
      losses(diagnostics), items_table(items));
  AtomicFile target(file);
  target.write(std::as_bytes(std::span(page)));
  target.commit();
}

}  // namespace vitrail
