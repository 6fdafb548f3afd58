// SPDX-License-Identifier: Apache-2.0
// These functions read and write the binary records of a bundle. materials.bin has surfaces, materials,
// textures and media. lights.bin has area lights, the triangles that emit and other lights. domains.bin has
// the kd-tree, domains and objects. See docs/reference/bundle-format.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "bundle/byte_stream.h"
#include "bundle/manifest.h"

namespace vitrail {

// Each function writes the payload of its file to `sink`.
void encode_materials(const Manifest& manifest, const ByteSink& sink);
void encode_lights(const Manifest& manifest, const ByteSink& sink);
void encode_domains(const Manifest& manifest, const ByteSink& sink);

// These functions do the inverse: they fill the manifest's records from the payload of `file`. They throw
// Error for whatever cannot be decoded.
void decode_materials(std::vector<std::byte> payload, const std::filesystem::path& file, Manifest& manifest);
void decode_lights(std::vector<std::byte> payload, const std::filesystem::path& file, Manifest& manifest);
void decode_domains(std::vector<std::byte> payload, const std::filesystem::path& file, Manifest& manifest);

// Returns the checksum of a file's payload as its header has it: read_manifest has compared it.
std::uint64_t checksum_of_records(const std::filesystem::path& file);

// Throws Error (with `file`) unless every index in the manifest is in range, every number finite and the
// kd-tree a tree.
void check_manifest(const Manifest& manifest, const std::filesystem::path& file);

// Returns what is wrong with a kd-tree of so many leaves, or null. In a right one every node and every leaf
// hangs in exactly one place, and children follow their parents.
const char* fault_of_kd_tree(std::span<const KdNode> nodes, std::size_t leaves);

// Returns the hash of all that decides the picture besides the triangles: records, camera and film.
std::uint64_t hash_of_records(const Manifest& manifest);

}  // namespace vitrail
