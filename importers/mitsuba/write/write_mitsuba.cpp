// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/write/write_mitsuba.h"

#include <string_view>

#include "importers/mitsuba/write/rgb_variants.h"
#include "importers/mitsuba/write/write_camera.h"
#include "importers/mitsuba/write/write_lights.h"
#include "importers/mitsuba/write/write_materials.h"
#include "importers/mitsuba/write/write_media.h"
#include "importers/mitsuba/write/write_shapes.h"
#include "importers/reading/guarded_xml.h"
#include "importers/writing/mapped_uvs.h"
#include "importers/writing/text_sink.h"
#include "scene/system/atomic_file.h"

namespace vitrail {

namespace {

struct SinkWriter : pugi::xml_writer {
  TextSink& sink;
  explicit SinkWriter(TextSink& to) : sink(to) {}
  void write(const void* data, std::size_t size) override {
    sink.put(FMT_COMPILE("{}"), std::string_view(static_cast<const char*>(data), size));
  }
};

}  // namespace

Diagnostics write_mitsuba(const Scene& given, const std::filesystem::path& out) {
  using namespace mitsuba_writer;
  const auto by_uv = [](const TextureMapping& m) { return std::holds_alternative<UvMapping>(m); };
  const std::optional<MappedUvs> mapped = with_mapped_uvs(given, by_uv);
  const Scene& scene = mapped ? mapped->scene : given;
  Context context(scene, out);
  note(context, mapped);
  guard_xml();
  pugi::xml_document document;
  document.append_child(pugi::node_comment)
      .set_value(fmt::format(" For Mitsuba 3, written by Vitrail {} ", VITRAIL_VERSION).c_str());
  Element root = document.append_child("scene");
  root.append_attribute("version") = "3.0.0";

  // The integrator and the camera come first for readers, and know what follows them.
  Element integrator = root.append_child("integrator"), sensor = root.append_child("sensor");
  write_textures(context, root);
  write_materials(context, root);
  write_media(context, root);
  write_lights(context, root);
  write_shapes(context, root);
  write_integrator(context, root);
  write_camera(context, root);
  report_products_in_rgb_variants(context);
  root.insert_move_before(root.last_child(), sensor);
  root.insert_move_before(root.last_child(), integrator);
  root.remove_child(integrator);
  root.remove_child(sensor);

  AtomicFile file(out);
  TextSink sink(&file);
  SinkWriter writer(sink);
  document.save(writer, "  ", pugi::format_indent, pugi::encoding_utf8);
  sink.flush();
  file.commit();
  return context.take();
}

}  // namespace vitrail
