// SPDX-License-Identifier: Apache-2.0
// Shape "plymesh".
#include <fmt/format.h>

#include <functional>
#include <string_view>

#include "importers/pbrt/read/ply_meshes.h"
#include "importers/pbrt/read/shapes.h"
#include "importers/reading/missing_files.h"

namespace vitrail::pbrt {

void ShapeMaker::read_ahead() {
  constexpr std::size_t text_bytes = 1 << 18;
  constexpr std::string_view suffix = ".ply\"";
  if (!context_.upcoming || !ply_reader_.has_room()) return;
  std::string_view text = context_.upcoming(text_bytes);
  const char* const end = text.data() + text.size();
  if (std::less_equal<>()(text.data(), looked_ahead_to_) && std::less_equal<>()(looked_ahead_to_, end))
    text = {looked_ahead_to_, end};
  while (true) {
    looked_ahead_to_ = text.data();
    const std::size_t at = text.find(suffix);
    if (at == text.npos) return;
    const std::size_t quote = text.rfind('"', at), behind = at + suffix.size();
    if (quote != text.npos) {
      const std::filesystem::path path =
          context_.resolve(std::string(text.substr(quote + 1, behind - quote - 2)));
      if (!ply_files_.contains(path.string()) && !ply_reader_.expect(path)) return;
    }
    text.remove_prefix(behind);
  }
}

std::vector<ShapeGeometry> ShapeMaker::ply_mesh(ParameterSet& parameters, bool uvs_show, bool faces_show) {
  const Parameter* filename = parameters.find("filename", {ParameterType::text});
  if (!filename || filename->strings.size() != 1)
    fail("Shape \"plymesh\" needs a parameter \"string filename\"", parameters.place());
  const std::filesystem::path path = context_.resolve(filename->strings.front());
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) {
    const std::string what = fmt::format("cannot find the file \"{}\"", path.string());
    if (!context_.replace_missing) fail(what + how_to_replace_missing, filename->place);
    context_.report.dropped(what + ": the shape is left out", filename->place);
    return {};
  }
  const auto [known, is_new] = ply_files_.try_emplace(path.string());
  PlyFile& file = known->second;
  const std::size_t kind = (uvs_show ? 1u : 0u) + (faces_show ? 2u : 0u);
  std::vector<ShapeGeometry>& shapes = file.shapes[file.differs ? kind : 0];
  if (!is_new && !shapes.empty()) return shapes;
  if (context_.skim) {
    const PlyCounts counts = count_ply(path);
    context_.skim->statement_bytes = std::max(context_.skim->statement_bytes, counts.bytes);
    return file.shapes[0] = {add_skimmed(counts.triangles, counts.bytes, counts.has_normals)};
  }
  read_ahead();
  auto [ply, diagnostics] = ply_reader_.take(path);
  if (is_new)
    for (Diagnostic& diagnostic : diagnostics) context_.report.add(std::move(diagnostic));
  std::vector<PlyMesh> parts = meshes_of(std::move(ply), uvs_show, faces_show, &file.differs);
  std::vector<ShapeGeometry>& made = file.shapes[file.differs ? kind : 0];
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].tessellated) report_patches(parameters.place());
    const auto load = [path, quads = quads_of(context_.version), uvs_show, faces_show, i] {
      return std::move(meshes_of(read_pbrt_ply(path, quads), uvs_show, faces_show)[i].mesh);
    };
    meshes_.push_back(context_.mesh_memory.keep(std::move(parts[i].mesh), load));
    made.push_back({{static_cast<std::uint32_t>(meshes_.size() - 1)}, false, {}, parts[i].parts});
  }
  return made;
}

}  // namespace vitrail::pbrt
