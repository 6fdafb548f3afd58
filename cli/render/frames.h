// SPDX-License-Identifier: Apache-2.0
// Frames are many pictures of one bundle, each with a camera, a light or a state of its own.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vitrail {

// A ListedFrame is a line of the file: options of render that change the picture.
struct ListedFrame {
  struct Word {
    std::string text;
    int column = 0;  // in the line, from 1
  };
  std::size_t number = 0;  // in the list, from 1
  int line = 0;            // in the file, from 1
  std::vector<Word> words;
  std::string text;  // the line
};

// Reads words with blanks between them; # and what follows is a comment, and a line without words is no
// frame. Throws Error where there is no frame.
std::vector<ListedFrame> read_frames(const std::filesystem::path& file);

// Returns whether a word begins an option: "--seed" and "-o", but not "-1".
bool is_option(const std::string& word);

// Throws Error with the line and column where an option is not one that a frame may have.
void require_options_of_frames(const ListedFrame& frame, const std::filesystem::path& file);

// Puts the number in place of "%04d" in the name. Throws UsageError where there is not one such place.
std::filesystem::path numbered(const std::filesystem::path& name, std::size_t number);

// Returns where the pictures' record is kept (frame_record.h): "dayframes.png.json" of "day%04d.png".
std::filesystem::path record_path(const std::filesystem::path& name);

}  // namespace vitrail
