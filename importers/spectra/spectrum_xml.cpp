// SPDX-License-Identifier: Apache-2.0
#include "importers/spectra/spectrum_xml.h"

#include <fmt/format.h>

#include <algorithm>
#include <pugixml.hpp>

#include "importers/spectra/spectrum_text.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

using Kind = SpectrumFile::Kind;

class SpectrumXmlReader {
 public:
  SpectrumXmlReader(std::string_view text, const std::string& name) : text_(text), name_(name) {
    // Bytes that are not UTF-8, as in Latin-1 comments, go through unread.
    const auto result =
        document_.load_buffer(text.data(), text.size(), pugi::parse_default, pugi::encoding_utf8);
    if (!result) fail(result.description(), result.offset);
  }

  SpectrumFile read() const {
    SpectrumFile file{.holds_ends = true};
    for (const pugi::xml_node entry : document_.document_element().children("entry")) {
      const Kind kind = kind_of(entry);
      if (file.rows.empty()) file.kind = kind;
      if (kind != file.kind) fail("the entries of a spectrum are of different kinds", entry.offset_debug());
      file.rows.push_back(row(entry, kind));
    }
    return file;
  }

 private:
  // `offset` is that behind the < of an element.
  [[noreturn]] void fail(const std::string& message, std::ptrdiff_t offset) const {
    const std::string_view before =
        text_.substr(0, static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0)));
    const auto line = static_cast<int>(std::count(before.begin(), before.end(), '\n')) + 1;
    const std::size_t line_end = before.rfind('\n');
    const std::size_t column = before.size() - (line_end == before.npos ? 0 : line_end + 1);
    throw Error(message, {name_, line, std::max(1, static_cast<int>(column))});
  }

  Kind kind_of(pugi::xml_node entry) const {
    const auto has = [&](const char* attribute) { return !entry.attribute(attribute).empty(); };
    if (has("value")) return Kind::value;
    if (has("n")) return Kind::index;
    if (has("k") && has("s")) return Kind::pigment;
    if (has("x") && has("y") && has("z")) return Kind::observer;
    fail(
        "an entry of a spectrum needs \"value\", \"n\" with \"kappa\" or \"k\", \"k\" with \"s\", or \"x y "
        "z\"",
        entry.offset_debug());
  }

  double number(pugi::xml_node entry, const char* attribute) const {
    double value = 0;
    if (!parse_padded_number(entry.attribute(attribute).value(), value))
      fail(fmt::format("\"{}\" of an entry has to be a number, is \"{}\"", attribute,
                       entry.attribute(attribute).value()),
           entry.offset_debug());
    return value;
  }

  double not_negative(pugi::xml_node entry, const char* attribute) const {
    const double value = number(entry, attribute);
    if (value < 0) fail(fmt::format("\"{}\" of an entry is negative", attribute), entry.offset_debug());
    return value;
  }

  SpectrumFile::Row row(pugi::xml_node entry, Kind kind) const {
    const double nm = number(entry, "wavelength");
    if (kind == Kind::value) return {nm, {number(entry, "value")}};
    if (kind == Kind::observer) return {nm, {number(entry, "x"), number(entry, "y"), number(entry, "z")}};
    if (kind == Kind::pigment) return {nm, {not_negative(entry, "k"), not_negative(entry, "s")}};
    const double n = not_negative(entry, "n");
    if (!entry.attribute("kappa").empty()) return {nm, {n, n * not_negative(entry, "kappa")}};
    return {nm, {n, entry.attribute("k").empty() ? 0 : not_negative(entry, "k")}};
  }

  pugi::xml_document document_;
  std::string_view text_;
  const std::string& name_;
};

}  // namespace

SpectrumFile parse_spectrum_xml(std::string_view text, const std::string& name) {
  return SpectrumXmlReader(text, name).read();
}

}  // namespace vitrail
