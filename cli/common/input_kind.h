// SPDX-License-Identifier: Apache-2.0
// An InputKind is the kind of file that a verb was given, for a message where it takes another.
#pragma once

#include <filesystem>
#include <initializer_list>

namespace vitrail {

// `other` is a missing file, or one whose name does not tell its kind.
enum class InputKind { bundle, film, picture, scene, other };

// Returns the kind by the file's name; a folder with manifest.json is a bundle. Files are not opened.
InputKind kind_of_input(const std::filesystem::path& file);

// Throws Error, which names the kind of `file` and the verbs that take it, unless its kind is wanted or
// other. For example require_input("room.vit", {InputKind::scene}): "this is a bundle, not a scene: …".
void require_input(const std::filesystem::path& file, std::initializer_list<InputKind> wanted);

}  // namespace vitrail
