// SPDX-License-Identifier: Apache-2.0
// What the scenes of the memory tests are written with.
#pragma once

#include <fmt/format.h>
#include <fmt/os.h>

#include <algorithm>
#include <filesystem>
#include <string>

namespace vitrail::test {

inline constexpr const char* pbrt_head =
    "LookAt 0 0 30 0 0 0 0 1 0\nCamera \"perspective\" \"float fov\" 40\n"
    "Film \"rgb\" \"integer xresolution\" 64 \"integer yresolution\" 64\nWorldBegin\n";
inline constexpr const char* pbrt_triangle =
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2] \"point3 P\" [0 0 0 1 0 0 0 1 0]\n";
inline constexpr const char* mitsuba_head =
    "<scene version=\"3.0.0\">\n<sensor type=\"perspective\"><transform name=\"to_world\">"
    "<lookat origin=\"0,0,30\" target=\"0,0,0\" up=\"0,1,0\"/></transform></sensor>\n"
    "<emitter type=\"constant\"/>\n";

inline int times(double share, double count) { return std::max(1, static_cast<int>(share * count)); }

// A pbrt file: `count` times what `line(i)` gives, then `tail`.
std::filesystem::path write_lines(const std::filesystem::path& directory, int count, const auto& line,
                                  const std::string& tail = pbrt_triangle) {
  const std::filesystem::path file = directory / "scene.pbrt";
  fmt::ostream out = fmt::output_file(file.string());
  out.print("{}", pbrt_head);
  for (int i = 0; i < count; ++i) out.print("{}", line(i));
  out.print("{}", tail);
  return file;
}

}  // namespace vitrail::test
