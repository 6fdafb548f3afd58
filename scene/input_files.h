// SPDX-License-Identifier: Apache-2.0
// What a program has read, it must not write over.
#pragma once

#include <filesystem>

namespace vitrail {

// A program asks for it before it reads anything; until then nothing is noted.
void protect_inputs();

// Every reader of a user's file tells of it here, from any thread. A file is known by device and inode, not
// by its name. What does not exist is ignored.
void note_input(const std::filesystem::path& file);

// Whether a file of this name, itself or behind a link, is one of them.
bool is_input(const std::filesystem::path& file);

}  // namespace vitrail
