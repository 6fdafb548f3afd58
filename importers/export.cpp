// SPDX-License-Identifier: Apache-2.0
#include "importers/export.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "importers/mitsuba/write_mitsuba.h"
#include "importers/obj/write_obj.h"
#include "importers/pbrt/write_pbrt.h"
#include "importers/ply/write_ply_scene.h"
#include "importers/povray/write_povray.h"

namespace vitrail {

namespace {

struct Format {
  std::string_view extension;
  Diagnostics (*write)(const Scene&, const std::filesystem::path&);
};
constexpr std::array<Format, 5> formats{{{".pbrt", write_pbrt},
                                         {".xml", write_mitsuba},
                                         {".pov", write_povray},
                                         {".obj", write_obj},
                                         {".ply", write_ply_scene}}};

const Format& format_of(const std::filesystem::path& out) {
  std::string extension = out.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const Format& format : formats)
    if (format.extension == extension) return format;
  throw UsageError(
      fmt::format("{}: the name of what is written has to end in .pbrt, .xml (Mitsuba), .pov, .obj or .ply",
                  out.string()));
}

}  // namespace

Diagnostics export_scene(const Scene& scene, const std::filesystem::path& out) {
  return format_of(out).write(scene, out);
}

void require_export_format(const std::filesystem::path& out) { format_of(out); }

}  // namespace vitrail
