// SPDX-License-Identifier: Apache-2.0
#include "cli/render/found_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <optional>

#include "cli/common/run_program.h"
#include "farm/run/checkpoint.h"
#include "film/own_picture.h"
#include "scene/system/temporary_folder.h"

namespace vitrail {

namespace fs = std::filesystem;

namespace {

struct Layout {
  int width = 0, height = 0;
  int channels = 0;  // 0: not known
};

std::string field(const WorkWords& work, const char* name) {
  const auto found = std::ranges::find(work.fields, name, &std::pair<std::string, std::string>::first);
  return found == work.fields.end() ? "" : found->second;
}

// The crop is x0,x1,y0,y1. A sensor is a column.
Layout asked_layout(const WorkWords& asked, const fs::path& picture) {
  int x0 = 0, x1 = 0, y0 = 0, y1 = 0;
  std::sscanf(field(asked, "crop").c_str(), "%d,%d,%d,%d", &x0, &x1, &y0, &y1);
  const bool has_alpha = field(asked, "layers").find("alpha") != std::string::npos;
  return {x1 - x0, y1 - y0, picture.extension() == ".png" ? 3 + has_alpha : 0};
}

// A row for each sensor, below the names of the columns.
std::optional<Layout> layout_of_table(const fs::path& table) {
  if (!is_own_picture(table)) return std::nullopt;
  std::ifstream in(table);
  Layout layout{-1, 0};
  for (std::string line; std::getline(in, line);) ++layout.width;
  return layout;
}

// Decodes all of it. Nothing where that fails, and why.
std::optional<Layout> layout_of_picture(const fs::path& picture, std::string& why) {
  const TemporaryFolder folder;
  const fs::path answer = folder.file("layout");
  run_program("vitrail-develop", {"--layout-of", picture.string()}, nullptr, answer);
  Layout layout;
  std::ifstream in(answer);
  const bool is_one = static_cast<bool>(in >> layout.width >> layout.height >> layout.channels);
  if (!is_one) std::getline(std::ifstream(answer), why);
  return is_one ? std::optional(layout) : std::nullopt;
}

// In what size it differs from what is asked for; "" where it does not.
std::string difference_of_size(const fs::path& picture, const Layout& has, const WorkWords& asked) {
  const Layout wanted = asked_layout(asked, picture);
  if (picture.extension() == ".csv")
    return has.width == wanted.width
               ? ""
               : fmt::format("it has {} sensors, this command {}", has.width, wanted.width);
  if (has.width != wanted.width || has.height != wanted.height)
    return fmt::format("it has {} × {} pixels, this command {} × {}", has.width, has.height, wanted.width,
                       wanted.height);
  if (wanted.channels > 0 && has.channels != wanted.channels)
    return fmt::format("it has {} channels, this command {}", has.channels, wanted.channels);
  return {};
}

FoundPicture look_inside(const fs::path& picture, bool has_mark, const WorkWords& asked) {
  const bool is_table = picture.extension() == ".csv";
  std::string why = "it does not begin as a table of sensors does";
  const std::optional<Layout> layout = is_table ? layout_of_table(picture) : layout_of_picture(picture, why);
  if (!layout) return {Found::damaged, std::move(why)};
  if (std::string d = difference_of_size(picture, *layout, asked); !d.empty())
    return {Found::another, std::move(d)};
  if (has_mark) return {Found::another, "it was changed or exchanged since it was rendered"};
  return {Found::whole, {}};
}

}  // namespace

FoundPicture find_picture(const fs::path& picture, const fs::path& film, const FrameRecord& record,
                          const WorkWords& asked) {
  std::error_code unknown;
  if (!fs::is_regular_file(picture, unknown) || fs::exists(checkpoint_path(film))) return {};
  const std::uintmax_t bytes = fs::file_size(picture, unknown);
  const std::optional<FileMark> mark = record.mark(picture);
  const bool is_marked = mark && mark_of(picture) == *mark;
  // A picture so far, of a film that was finished since.
  if (fs::exists(film) && !is_marked) return {};
  if (!unknown && bytes == 0) return {Found::damaged, "it is empty"};
  if (std::string d = record.differences(picture, asked); !d.empty()) return {Found::another, std::move(d)};
  if (is_marked) return {Found::whole, {}};
  return look_inside(picture, mark.has_value(), asked);
}

}  // namespace vitrail
