// SPDX-License-Identifier: Apache-2.0
#include "importers/pbrt/write/write_pbrt.h"

#include <span>

#include "importers/pbrt/write/writer.h"
#include "importers/writing/mapped_uvs.h"
#include "importers/writing/own_scene.h"
#include "scene/system/atomic_file.h"

namespace vitrail {

Diagnostics write_pbrt(const Scene& given, const std::filesystem::path& out) {
  const auto is_kept = [](const TextureMapping& m) {
    if (const auto* cylinder = std::get_if<CylindricalMapping>(&m)) return !cylinder->of_direction;
    return std::holds_alternative<UvMapping>(m) ? is_unturned(m) : !std::holds_alternative<GlobeMapping>(m);
  };
  const std::optional<MappedUvs> mapped = with_mapped_uvs(given, is_kept);
  pbrt::Writer writer(mapped ? mapped->scene : given, out);
  note(writer, mapped);
  writer.line(fmt::format("# pbrt-v4, {}", scene_signature));
  pbrt::write_tints(writer);
  pbrt::write_view(writer);
  pbrt::write_media(writer);
  writer.line("\nWorldBegin\n");
  pbrt::write_textures(writer);
  pbrt::write_coverage(writer);
  pbrt::write_materials(writer);
  pbrt::write_lights(writer);
  pbrt::write_shapes(writer);
  AtomicFile file(out);
  file.write(std::as_bytes(std::span(writer.text)));
  file.commit();
  return writer.take();
}

}  // namespace vitrail
