// SPDX-License-Identifier: Apache-2.0
#include "partitioner/caching/file_cache.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <thread>
#include <utility>
#include <vector>

#include "partitioner/caching/content_hash.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::file_cache_test {

namespace {

namespace fs = std::filesystem;

std::string content_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

struct Caches {
  test::TemporaryDirectory directory;
  fs::path folder = directory / "cache", source = directory / "source", target = directory / "target";
  FileCache cache{folder};

  void keep(const std::string& key, const std::string& content) {
    std::ofstream(source, std::ios::binary) << content;
    cache.keep(key, source, {content.size(), 7, 0, 1});
  }
  void change_byte(const std::string& key, std::streamoff at) {
    std::fstream entry(folder / key, std::ios::binary | std::ios::in | std::ios::out);
    entry.seekg(at);
    const int byte = entry.get();
    entry.seekp(at);
    entry.put(static_cast<char>(byte ^ 1));
  }
};

TEST(FileCache, GivesBackWhatWasKept) {
  Caches c;
  EXPECT_FALSE(c.cache.take("a", c.target));
  const std::string content(3'000'000, 'x');
  c.keep("a", content);
  c.keep("empty", "");
  EXPECT_EQ(c.cache.note("a"), (FileCache::Note{content.size(), 7, 0, 1}));
  EXPECT_EQ(c.cache.take("a", c.target), (FileCache::Note{content.size(), 7, 0, 1}));
  EXPECT_EQ(content_of(c.target), content);
  EXPECT_TRUE(c.cache.take("empty", c.target));
  EXPECT_EQ(content_of(c.target), "");
  EXPECT_FALSE(c.cache.take("b", c.target));
}

TEST(FileCache, NoticesDamage) {
  for (const std::streamoff at : {0, 20, 40, 66, 4096, 4100}) {
    Caches c;
    c.keep("a", "content");
    c.change_byte("a", at);
    EXPECT_FALSE(c.cache.take("a", c.target)) << at;
    EXPECT_FALSE(fs::exists(c.folder / "a")) << at;
    EXPECT_FALSE(fs::exists(c.target)) << at;
    c.keep("a", "content");
    EXPECT_TRUE(c.cache.take("a", c.target)) << at;
  }
  Caches c;
  c.keep("a", "content");
  fs::resize_file(c.folder / "a", 4100);
  EXPECT_FALSE(c.cache.note("a"));
  EXPECT_FALSE(c.cache.take("a", c.target));
}

TEST(FileCache, RemovesWhatWasUsedLongestAgo) {
  Caches c;
  c.cache = FileCache(c.folder, 3 * (4096 + 1000));
  const auto now = fs::file_time_type::clock::now();
  int age = 10;
  for (const char* key : {"a", "b", "c"}) {
    c.keep(key, std::string(1000, 'x'));
    fs::last_write_time(c.folder / key, now - std::chrono::hours(age--));
  }
  EXPECT_TRUE(c.cache.take("a", c.target));
  c.keep("d", std::string(1000, 'x'));
  EXPECT_TRUE(c.cache.note("a"));
  EXPECT_FALSE(c.cache.note("b"));
  EXPECT_TRUE(c.cache.note("c"));
  EXPECT_TRUE(c.cache.note("d"));
  c.keep("large", std::string(20'000, 'x'));
  EXPECT_FALSE(c.cache.note("large"));
  EXPECT_TRUE(c.cache.note("a"));
}

TEST(FileCache, RemovesWhatWasLeftHalfMade) {
  Caches c;
  c.keep("a", "x");
  const auto now = fs::file_time_type::clock::now();
  for (const auto& [name, hours] : {std::pair{"b.AAAAAA", 25}, std::pair{"b.BBBBBB", 1}}) {
    std::ofstream(c.folder / name) << 'x';
    fs::last_write_time(c.folder / name, now - std::chrono::hours(hours));
  }
  c.keep("c", "x");
  EXPECT_FALSE(fs::exists(c.folder / "b.AAAAAA"));
  EXPECT_TRUE(fs::exists(c.folder / "b.BBBBBB"));
  EXPECT_TRUE(c.cache.note("a"));
}

TEST(FileCache, ServesManyAtOnce) {
  Caches c;
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      const fs::path own = c.directory / std::to_string(t);
      const std::string content(200'000, 'y');
      std::ofstream(own, std::ios::binary) << content;
      for (int i = 0; i < 20; ++i) {
        c.cache.keep("same", own, {});
        const fs::path target = c.directory / (std::to_string(t) + ".target");
        if (c.cache.take("same", target)) {
          EXPECT_EQ(content_of(target), content);
        }
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_TRUE(c.cache.take("same", c.target));
  EXPECT_EQ(std::distance(fs::directory_iterator(c.folder), fs::directory_iterator()), 1);
}

TEST(FileCache, KeepsNothingWhereItCannot) {
  Caches c;
  const FileCache off{fs::path()};
  std::ofstream(c.source) << "content";
  off.keep("a", c.source, {});
  EXPECT_FALSE(off.take("a", c.target));
  const FileCache nowhere(c.source / "no folder");
  nowhere.keep("a", c.source, {});
  EXPECT_FALSE(nowhere.take("a", c.target));
}

TEST(CacheFolder, IsThatOfTheUser) {
  const char* const home = std::getenv("HOME");
  const char* const caches = std::getenv("XDG_CACHE_HOME");
  const std::string home_before = home ? home : "", caches_before = caches ? caches : "";
  ::setenv("HOME", "/h", 1);
  ::setenv("XDG_CACHE_HOME", "/c", 1);
  EXPECT_EQ(cache_folder(), "/c/vitrail");
  ::setenv("XDG_CACHE_HOME", "relative", 1);
  EXPECT_EQ(cache_folder(), "/h/.cache/vitrail");
  ::unsetenv("XDG_CACHE_HOME");
  EXPECT_EQ(cache_folder(), "/h/.cache/vitrail");
  ::setenv("HOME", "", 1);
  EXPECT_EQ(cache_folder(), "");
  ::setenv("HOME", home_before.c_str(), 1);
  if (caches) ::setenv("XDG_CACHE_HOME", caches_before.c_str(), 1);
}

TEST(ContentHash, TellsContentsAndTextsApart) {
  test::TemporaryDirectory directory;
  const auto hash = [&](const std::vector<std::string>& texts, const std::string& content) {
    std::ofstream(directory / "f", std::ios::binary) << content;
    ContentHash h;
    for (const std::string& text : texts) h.add(text);
    h.add_content(directory / "f");
    return h.hex();
  };
  const std::string large(3'000'000, 'x');
  EXPECT_EQ(hash({"a"}, large).size(), 32u);
  EXPECT_EQ(hash({"a"}, large), hash({"a"}, large));
  EXPECT_NE(hash({"a"}, large), hash({"b"}, large));
  EXPECT_NE(hash({"a"}, large), hash({"a"}, large + "x"));
  EXPECT_NE(hash({"a", "b"}, ""), hash({"ab", ""}, ""));
}

}  // namespace

}  // namespace vitrail::file_cache_test
