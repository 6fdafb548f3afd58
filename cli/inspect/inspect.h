// SPDX-License-Identifier: Apache-2.0
// What `vitrail inspect` finds, as JSON; its text form is the same, laid out.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "bundle/manifest.h"
#include "importers/reading/import_options.h"

namespace vitrail {

using Report = nlohmann::ordered_json;

// Each reads and verifies everything of its file, and throws Error where something is wrong.
Report inspect_scene(const std::filesystem::path& file, const ImportOptions& options = {});
Report inspect_bundle(const std::filesystem::path& bundle);
Report inspect_domain(const Stored& stored);
Report inspect_pack(const std::filesystem::path& file);
Report inspect_texture(const std::filesystem::path& file);
Report inspect_film(const std::filesystem::path& file);

// Shared by scenes and bundles: bounds, requirements and their reasons, materials, lights, camera and film.
Report describe(const Manifest& manifest);

// What a scene says in its own terms: materials, textures (images with their pixels), media; and what it
// needs of a renderer beyond the requirements of what is partitioned.
Report describe_materials(const Scene& scene);
Report describe_textures(const Scene& scene);
Report describe_media(const Scene& scene);
Report describe_needs(const Scene& scene);
// Panes of measured glass, whether they switch or not: "set" is "" where they do not. Reads their files
// again.
Report describe_panes(const Scene& scene);
// Parts of solid glass, of meshes, that enclose nothing: open, folded, or the face of a pane without its rim.
Report describe_open_glass(const Scene& scene);
// Of all meshes, each once.
std::uint64_t mesh_bytes(const Scene& scene);

// What it takes to render it, and how large it is: "summary" of a scene or a bundle (summary.cpp).
// `scene_bytes`: of its shapes and images in memory. The time is that of a scene of its size among those
// measured: a guess.
Report summary_of(const Manifest& manifest, std::uint64_t scene_bytes);
// Sentences for people, a line each.
std::string summary_text(const Report& summary);

// {"needed": …, "why": …}: "yes: why" in text. Empty: not needed.
Report need(const std::string& why);

// The summary, if there is one, then "key: value" lines, nested by indentation; lists of records as tables.
// Paths of `folder` without that.
std::string to_text(const Report& report, const std::filesystem::path& folder = {});

}  // namespace vitrail
