// SPDX-License-Identifier: Apache-2.0
// These functions return what `vitrail inspect` finds, as JSON; its text form is the same, laid out.
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

// Returns what scenes and bundles share: bounds, requirements and reasons, materials, lights, camera, film.
Report describe(const Manifest& manifest);

// They return what a scene has in its own terms: materials, textures (images with their pixels), media. The
// last returns what it needs of a renderer beyond the requirements of the partitioned scene.
Report describe_materials(const Scene& scene);
Report describe_textures(const Scene& scene);
Report describe_media(const Scene& scene);
Report describe_needs(const Scene& scene);
// Returns panes of measured glass, whether they switch or not: "set" is "" where they do
// not. Reads their files again.
Report describe_panes(const Scene& scene);
// Returns parts of solid glass meshes that enclose nothing: open, folded, or a pane's face without its rim.
Report describe_open_glass(const Scene& scene);
// Returns the bytes of all meshes, each once.
std::uint64_t mesh_bytes(const Scene& scene);

// Returns what it takes to render it, and how large it is: "summary" of a scene or a bundle (summary.cpp).
// `scene_bytes` are those of its shapes and images in memory. The time is a guess: that of a scene of its
// size among those measured.
Report summary_of(const Manifest& manifest, std::uint64_t scene_bytes);
// Returns sentences for people, a line each.
std::string summary_text(const Report& summary);

// Returns {"needed": …, "why": …}: "yes: why" in text. An empty `why` means that it is not needed.
Report need(const std::string& why);

// Returns the summary, if there is one, then "key: value" lines, nested by indentation, with lists of records
// as tables. It leaves `folder` out of paths.
std::string to_text(const Report& report, const std::filesystem::path& folder = {});

}  // namespace vitrail
