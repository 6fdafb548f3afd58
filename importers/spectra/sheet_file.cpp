// SPDX-License-Identifier: Apache-2.0
#include "importers/spectra/sheet_file.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string_view>

#include "importers/bytes/input_bytes.h"
#include "importers/spectra/spectrum_text.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

constexpr std::array<std::string_view, 4> header{"wavelength_nm", "angle_deg", "R", "T"};

// Words of a text and the lines that they are in, without comments.
class Words {
 public:
  explicit Words(std::string_view text) : rest_(text) {
    if (rest_.starts_with("\xef\xbb\xbf")) rest_.remove_prefix(3);
  }
  bool next(std::string_view& word) {
    while (!rest_.empty()) {
      const char c = rest_.front();
      if (c == '#') {
        rest_.remove_prefix(std::min(rest_.find('\n'), rest_.size()));
      } else if (separators.find(c) != separators.npos) {
        line_ += c == '\n';
        rest_.remove_prefix(1);
      } else {
        word = rest_.substr(0, rest_.find_first_of(ends));
        rest_.remove_prefix(word.size());
        return true;
      }
    }
    return false;
  }
  int line() const { return line_; }

 private:
  static constexpr std::string_view separators = " \t\r\n\v\f,;", ends = " \t\r\n\v\f,;#";
  std::string_view rest_;
  int line_ = 1;
};

bool skip_header(Words& words) {
  for (const std::string_view expected : header)
    if (std::string_view word; !words.next(word) || word != expected) return false;
  return true;
}

struct Cell {
  double reflectance = 0, transmittance = 0;
  int count = 0;
};
// By wavelength and angle.
using Grid = std::map<double, std::map<double, Cell>>;

class SheetReader {
 public:
  SheetReader(std::string_view text, std::string name) : words_(text), name_(std::move(name)) {}

  MeasuredSheetFile read() {
    if (!skip_header(words_)) fail("a table of measured glass begins with \"wavelength_nm angle_deg R T\"");
    Grid grid = read_rows();
    if (grid.empty()) fail("there are no rows in a table of measured glass");
    MeasuredSheetFile file;
    average(grid, file.repairs);
    file.sheet = sheet_of(grid);
    return file;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw Error(message, {name_, words_.line(), 0});
  }

  bool number(double& value) {
    std::string_view word;
    if (!words_.next(word)) return false;
    if (!parse_padded_number(word, value))
      throw Error("expected a number in a table of measured glass", {name_, words_.line(), 0},
                  std::string(word.substr(0, 80)));
    return true;
  }

  Grid read_rows() {
    Grid grid;
    std::array<double, 4> row{};
    while (number(row[0])) {
      for (std::size_t i = 1; i < row.size(); ++i)
        if (!number(row[i])) fail("the last row of a table of measured glass is not complete");
      const auto [nm, angle, r, t] = row;
      if (!(nm > 0)) fail("a wavelength has to be above 0");
      if (angle < 0 || angle > 90) fail("an angle of incidence has to be in [0, 90]");
      if (r < 0 || t < 0 || r > 1 || t > 1) fail("reflectance and transmittance have to be in [0, 1]");
      Cell& cell = grid[nm][angle];
      cell.reflectance += r;
      cell.transmittance += t;
      ++cell.count;
    }
    return grid;
  }

  void average(Grid& grid, std::vector<std::string>& repairs) const {
    int repeated = 0, bright = 0;
    for (auto& [nm, angles] : grid)
      for (auto& [angle, cell] : angles) {
        repeated += cell.count > 1;
        cell.reflectance /= cell.count;
        cell.transmittance /= cell.count;
        const double sum = cell.reflectance + cell.transmittance;
        if (sum <= 1) continue;
        ++bright;
        cell.reflectance /= sum;
        cell.transmittance /= sum;
      }
    if (repeated > 0)
      repairs.push_back(
          fmt::format("{}: {} rows are there more than once and become their mean", name_, repeated));
    if (bright > 0)
      repairs.push_back(fmt::format("{}: {} rows have R + T above 1 and are scaled to it", name_, bright));
  }

  MeasuredSheet sheet_of(Grid& grid) const {
    MeasuredSheet sheet;
    for (auto& [nm, angles] : grid) angles.emplace(90, Cell{1, 0, 1});
    const auto& first = grid.begin()->second;
    for (auto angle = first.rbegin(); angle != first.rend(); ++angle)
      sheet.cosines.push_back(
          angle->first == 90 ? 0 : static_cast<float>(std::cos(angle->first * std::numbers::pi / 180)));
    for (const auto& [nm, angles] : grid) {
      if (!std::equal(angles.begin(), angles.end(), first.begin(), first.end(),
                      [](const auto& a, const auto& b) { return a.first == b.first; }))
        throw Error(fmt::format("the angles at {} nm are not those at {} nm", nm, grid.begin()->first),
                    {name_, 0, 0});
      sheet.wavelengths_nm.push_back(static_cast<float>(nm));
      for (auto angle = angles.rbegin(); angle != angles.rend(); ++angle) {
        sheet.reflectance.push_back(static_cast<float>(angle->second.reflectance));
        sheet.transmittance.push_back(static_cast<float>(angle->second.transmittance));
      }
    }
    return sheet;
  }

  Words words_;
  std::string name_;
};

}  // namespace

bool is_measured_sheet(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return false;
  const InputBytes bytes(path);
  constexpr std::size_t most = 1 << 16;
  Words words({bytes.begin(), std::min(most, bytes.size())});
  return skip_header(words);
}

MeasuredSheetFile read_measured_sheet(const std::filesystem::path& path) {
  const InputBytes bytes(path);
  constexpr std::size_t most_bytes = 64 << 20;
  if (bytes.size() > most_bytes)
    throw Error("a table of measured glass is larger than 64 MiB", {path.string(), 0, 0});
  return SheetReader({bytes.begin(), bytes.size()}, path.string()).read();
}

}  // namespace vitrail
