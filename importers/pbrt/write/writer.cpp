// SPDX-License-Identifier: Apache-2.0
#include "importers/pbrt/write/writer.h"

#include <algorithm>
#include <array>
#include <set>

#include "importers/writing/export_colors.h"
#include "scene/spectra/named_spectra.h"

namespace vitrail::pbrt {

namespace {

// The record's own name where it has one that is free, else one with its number.
template <class Records>
std::vector<std::string> unique_names(const Records& records, std::string_view fallback) {
  std::vector<std::string> names;
  std::set<std::string, std::less<>> taken;
  for (const auto& record : records)
    if (!record.name.empty()) taken.insert(record.name);
  std::set<std::string, std::less<>> given;
  for (std::size_t i = 0; i < records.size(); ++i) {
    std::string name = records[i].name;
    for (std::size_t n = i; name.empty() || given.contains(name); ++n) {
      const std::string candidate =
          fmt::format("{}-{}", records[i].name.empty() ? fallback : records[i].name, n);
      if (!taken.contains(candidate)) name = candidate;
    }
    given.insert(name);
    names.push_back(std::move(name));
  }
  return names;
}

// The spectra that pbrt-v4 has by name and that are kept by name in a Scene.
bool is_known_to_pbrt(std::string_view name) {
  constexpr std::array names{
      "glass-BK7",    "glass-BAF10",    "glass-FK51A",  "glass-LASF9",    "glass-F5",     "glass-F10",
      "glass-F11",    "metal-Ag-eta",   "metal-Ag-k",   "metal-Al-eta",   "metal-Al-k",   "metal-Au-eta",
      "metal-Au-k",   "metal-Cu-eta",   "metal-Cu-k",   "metal-CuZn-eta", "metal-CuZn-k", "metal-MgO-eta",
      "metal-MgO-k",  "metal-TiO2-eta", "metal-TiO2-k", "illum-acesD60",  "stdillum-A",   "stdillum-D50",
      "stdillum-D65", "stdillum-F1",    "stdillum-F2",  "stdillum-F3",    "stdillum-F4",  "stdillum-F5",
      "stdillum-F6",  "stdillum-F7",    "stdillum-F8",  "stdillum-F9",    "stdillum-F10", "stdillum-F11",
      "stdillum-F12"};
  return std::find(names.begin(), names.end(), name) != names.end();
}

TabulatedSpectrum each_nm(const Spectrum& spectrum) {
  const Spectrum known = resolved(spectrum);
  TabulatedSpectrum table;
  for (int i = 0; i < table_size; ++i)
    table.values.push_back(static_cast<float>(evaluate(known, lambda_min_nm + i)));
  return table;
}

}  // namespace

Writer::Writer(const Scene& s, const std::filesystem::path& out)
    : ConversionNotes(s),
      directory(out.parent_path()),
      meshes(s, out),
      materials(unique_names(s.materials, "material")),
      textures(unique_names(s.textures, "texture")),
      media(unique_names(s.media, "medium")),
      objects(unique_names(s.prototypes, "object")),
      side_files_(out) {}

void Writer::transform(const Transform& t) {
  if (t == Transform{}) return;
  std::array<double, 16> columns;
  for (std::size_t i = 0; i < 16; ++i) columns[i] = t.m[i % 4][i / 4];
  line(fmt::format("Transform [ {} ]", fmt::join(columns, " ")));
}

void Writer::transforms(const Motion& motion, const Origin& of, RecordKind kind) {
  const std::vector<Keyframe>& keys = motion.keys();
  const auto& [start, end] = transform_times_s;
  if (keys.size() != 2 || keys.front().time_s != start || keys.back().time_s != end)
    approximated("motion: pbrt has two keyframes, of the same times for all that moves", of, kind);
  for (const auto& [name, time] : {std::pair{"StartTime", start}, {"EndTime", end}}) {
    const Transform at = motion.at(time);
    line(fmt::format("ActiveTransform {}", name));
    transform(kind == RecordKind::camera ? inverse(at) : at);
  }
  line("ActiveTransform All");
}

std::string Writer::add_name(std::vector<std::string>& names, std::string_view wanted) {
  std::string name(wanted);
  for (std::size_t n = names.size(); std::ranges::find(names, name) != names.end(); ++n)
    name = fmt::format("{}-{}", wanted, n);
  return names.emplace_back(std::move(name));
}

std::string Writer::new_file(const std::string& kind, const char* extension) {
  return side_files_.name(kind, file_counts_[kind]++, extension);
}

std::string in_quotes(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (c == '\n')
      result += "\\n";
    else
      result += c;
  }
  return result + '"';
}

Parameters& Parameters::text(std::string_view name, std::string_view value) {
  list_ += fmt::format(" \"string {}\" {}", name, in_quotes(value));
  return *this;
}

Parameters& Parameters::texts(std::string_view name, std::initializer_list<std::string_view> values) {
  list_ += fmt::format(" \"string {}\" [", name);
  for (const std::string_view value : values) list_ += fmt::format(" {}", in_quotes(value));
  list_ += " ]";
  return *this;
}

Parameters& Parameters::file(std::string_view name, const std::string& absolute) {
  return text(name, relative_name(absolute, writer_.directory));
}

Parameters& Parameters::boolean(std::string_view name, bool value) {
  list_ += fmt::format(" \"bool {}\" {}", name, value);
  return *this;
}

Parameters& Parameters::integer(std::string_view name, int value) {
  list_ += fmt::format(" \"integer {}\" {}", name, value);
  return *this;
}

Parameters& Parameters::number(std::string_view name, float value) {
  list_ += fmt::format(" \"float {}\" {}", name, value);
  return *this;
}

Parameters& Parameters::number(std::string_view name, double value) {
  list_ += fmt::format(" \"float {}\" {}", name, value);
  return *this;
}

Parameters& Parameters::number(std::string_view name, const FloatParameter& value) {
  if (const auto* constant = std::get_if<float>(&value)) return number(name, *constant);
  return texture(name, writer_.textures.at(std::get<Id<Texture>>(value).value));
}

Parameters& Parameters::texture(std::string_view name, std::string_view texture) {
  list_ += fmt::format(" \"texture {}\" {}", name, in_quotes(texture));
  return *this;
}

void Parameters::tabulated(std::string_view name, const TabulatedSpectrum& read) {
  const TabulatedSpectrum table = as_seen_at_whole_nm(read);
  list_ += fmt::format(" \"spectrum {}\" [", name);
  for (const auto& [lambda, value] : samples_of(table))
    list_ += fmt::format(" {} {}", lambda, digits_of(table, value));
  list_ += " ]";
}

Parameters& Parameters::spectrum(std::string_view name, const SpectrumParameter& value) {
  if (const auto* id = std::get_if<Id<Texture>>(&value)) return texture(name, writer_.textures.at(id->value));
  const auto& spectrum = std::get<Spectrum>(value);
  const auto rgb = [&](const std::array<float, 3>& c) { numbers(fmt::format("rgb {}", name), c); };
  if (const auto* constant = std::get_if<ConstantSpectrum>(&spectrum)) {
    list_ += fmt::format(" \"spectrum {}\" [ 360 {} 830 {} ]", name, constant->value, constant->value);
  } else if (const auto* sigmoid = std::get_if<SigmoidSpectrum>(&spectrum)) {
    rgb(sigmoid->rgb);
  } else if (const auto* unbounded = std::get_if<RgbUnboundedSpectrum>(&spectrum)) {
    rgb(unbounded->rgb);
  } else if (const auto* table = std::get_if<TabulatedSpectrum>(&spectrum)) {
    tabulated(name, *table);
  } else if (const auto* named = std::get_if<NamedSpectrum>(&spectrum);
             named && is_known_to_pbrt(named->name)) {
    list_ += fmt::format(" \"spectrum {}\" {}", name, in_quotes(named->name));
  } else {
    approximated(fmt::format("its \"{}\" is written as samples of 1 nm", name));
    tabulated(name, each_nm(spectrum));
  }
  return *this;
}

Parameters& Parameters::albedo(std::string_view name, const SpectrumParameter& value) {
  const auto* spectrum = std::get_if<Spectrum>(&value);
  const auto* unbounded = spectrum ? std::get_if<RgbUnboundedSpectrum>(spectrum) : nullptr;
  if (!unbounded || std::ranges::max(unbounded->rgb) <= 1) return this->spectrum(name, value);
  approximated(fmt::format("its \"{}\" is written as samples of 1 nm: pbrt refuses colours above 1", name));
  tabulated(name, each_nm(*spectrum));
  return *this;
}

Parameters& Parameters::input(std::string_view name, const SpectrumParameter& value, bool is_float) {
  const auto* spectrum = std::get_if<Spectrum>(&value);
  if (!is_float) return albedo(name, value);
  if (!spectrum) return this->spectrum(name, value);
  return number(name, static_cast<float>(is_constant(*spectrum) ? evaluate(*spectrum, lambda_min_nm)
                                                                : luminance(*spectrum)));
}

Parameters& Parameters::emission(std::string_view name, const Spectrum& value) {
  if (const auto* color = std::get_if<RgbIlluminantSpectrum>(&value))
    return numbers(fmt::format("rgb {}", name), color->rgb);
  if (const auto* hot = std::get_if<BlackbodySpectrum>(&value)) {
    list_ += fmt::format(" \"blackbody {}\" {}", name, hot->kelvin);
    return number("scale", hot->luminance);
  }
  // What was read, with the scale that gives it back: multiplied, its numbers would be others.
  const auto* table = std::get_if<TabulatedSpectrum>(&value);
  if (table && !as_seen_at_whole_nm(*table).samples.empty()) {
    TabulatedSpectrum as_read = tabulate(table->samples, false);
    if (const double brightness = luminance(as_read); brightness > 0 && table->sample_factor > 0) {
      tabulated(name, as_read);
      return number("scale", table->sample_factor * brightness);
    }
  }
  const double brightness = luminance(value);
  if (!(brightness > 0)) return numbers(fmt::format("rgb {}", name), std::array{0, 0, 0});
  spectrum(name, value);
  return number("scale", brightness);
}

}  // namespace vitrail::pbrt
