// SPDX-License-Identifier: Apache-2.0
#include "importers/spectra/spectrum_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "importers/bytes/input_bytes.h"
#include "importers/spectra/spectrum_text.h"
#include "importers/spectra/spectrum_xml.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

using Row = SpectrumFile::Row;

void sort_and_merge(SpectrumFile& file) {
  auto& rows = file.rows;
  const auto earlier = [](const Row& a, const Row& b) { return a.lambda_nm < b.lambda_nm; };
  if (!std::is_sorted(rows.begin(), rows.end(), earlier)) {
    file.repairs.emplace_back("its wavelengths are not in ascending order and are sorted");
    std::stable_sort(rows.begin(), rows.end(), earlier);
  }
  std::vector<Row> merged;
  for (std::size_t first = 0, last; first < rows.size(); first = last) {
    Row sum = rows[first];
    for (last = first + 1; last < rows.size() && rows[last].lambda_nm == rows[first].lambda_nm; ++last)
      for (std::size_t i = 0; i < 3; ++i) sum.v[i] += rows[last].v[i];
    for (double& v : sum.v) v /= static_cast<double>(last - first);
    merged.push_back(sum);
  }
  if (merged.size() < rows.size())
    file.repairs.push_back(
        fmt::format("{} of its wavelengths are there more than once: their values become the mean",
                    rows.size() - merged.size()));
  rows = std::move(merged);
}

Spectrum simplified(TabulatedSpectrum table) {
  const float first = table.values.front();
  if (std::all_of(table.values.begin(), table.values.end(), [&](float v) { return v == first; }))
    return ConstantSpectrum{first};
  return table;
}

TabulatedSpectrum column(const SpectrumFile& file, std::size_t i, bool hold_ends) {
  std::vector<SpectrumSample> samples;
  for (const Row& row : file.rows) samples.push_back({row.lambda_nm, row.v[i]});
  return tabulate(samples, hold_ends || file.holds_ends);
}

// Of an opaque layer; k, s ≥ 0. s = 0 does not reflect, unless nothing absorbs.
double opaque_reflectance(double k, double s) {
  if (!(k > 0)) return 1;
  if (!(s > 0)) return 0;
  const double q = k / s;
  return 1 / (1 + q + std::sqrt(q * (q + 2)));  // the form without cancellation
}

}  // namespace

SpectrumFile read_spectrum_file(const std::filesystem::path& path) {
  const InputBytes bytes(path);
  constexpr std::size_t most_bytes = 64 << 20;
  if (bytes.size() > most_bytes) throw Error("a spectrum is larger than 64 MiB", {path.string(), 0, 0});
  std::string_view text(bytes.begin(), bytes.size());
  const bool marked = text.starts_with("\xef\xbb\xbf");
  if (marked) text.remove_prefix(3);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  const bool xml = first != text.npos && text[first] == '<';
  SpectrumFile file =
      xml ? parse_spectrum_xml(text, path.string()) : parse_spectrum_text(text, path.string());
  if (file.rows.empty()) throw Error("there are no samples in a spectrum", {path.string(), 0, 0});
  sort_and_merge(file);
  return file;
}

Spectrum spectrum_of(const SpectrumFile& file, SpectrumPart part, bool hold_ends) {
  if (file.kind == SpectrumFile::Kind::observer)
    throw Error("a file of an observer's three functions stands where one spectrum is needed");
  if (file.kind != SpectrumFile::Kind::pigment) {
    const bool second = file.kind == SpectrumFile::Kind::index && part == SpectrumPart::k;
    return simplified(column(file, second ? 1 : 0, hold_ends));
  }
  TabulatedSpectrum k = column(file, 0, hold_ends);
  const TabulatedSpectrum s = column(file, 1, hold_ends);
  for (std::size_t i = 0; i < k.values.size(); ++i)
    k.values[i] = static_cast<float>(
        opaque_reflectance(static_cast<double>(k.values[i]), static_cast<double>(s.values[i])));
  k.samples.clear();  // of k, and not of what it has become
  return simplified(std::move(k));
}

}  // namespace vitrail
