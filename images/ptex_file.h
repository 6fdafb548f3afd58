// SPDX-License-Identifier: Apache-2.0
// A Ptex file has a texture for every face of a mesh (Ptex File Format Specification 1.3).
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <vector>

namespace vitrail {

// Its numbers are as the file stores them; integers are taken to [0,1]. Throws Error with the file's name
// where the file cannot be read.
class PtexFile {
 public:
  struct Face {
    std::uint32_t width = 1, height = 1;  // texels along u and v, powers of two
    bool constant = false;
    std::uint64_t at = 0;     // of its texels in the file
    std::uint32_t block = 0;  // their size and encoding as the file has them
  };

  explicit PtexFile(const std::filesystem::path& file);

  std::size_t channels() const { return channels_; }
  // Returns whether the file is for a mesh of triangles, whose texels are packed in another way.
  bool is_of_triangles() const { return of_triangles_; }
  const std::vector<Face>& faces() const { return faces_; }
  const std::vector<float>& means() const { return means_; }  // [face][channel]
  // Returns [v][u][channel], from (u,v) = (0,0) on.
  std::vector<float> texels(std::size_t face);

 private:
  struct Header;
  Header read_header();
  void read_means(std::uint64_t at, const Header& header);
  // Returns the word of each face's texels in the finest level, or nothing where no face has any.
  std::vector<std::uint32_t> read_blocks(std::uint64_t& at, const Header& header);
  void place_faces(const std::vector<unsigned char>& infos, const std::vector<std::uint32_t>& blocks,
                   std::uint64_t at);
  [[noreturn]] void fail(const char* why) const;
  std::vector<unsigned char> bytes(std::uint64_t at, std::uint64_t count);
  std::vector<unsigned char> unzipped(std::uint64_t at, std::uint64_t zipped, std::uint64_t size);
  std::vector<float> block(std::uint64_t at, std::uint32_t block, std::size_t texels);
  std::vector<float> tiles(const Face& face);

  std::filesystem::path file_;
  std::ifstream in_;
  std::uint64_t file_bytes_ = 0;
  std::uint32_t type_ = 0;
  std::size_t channels_ = 0;
  bool of_triangles_ = false;
  std::vector<Face> faces_;
  std::vector<float> means_;
};

}  // namespace vitrail
