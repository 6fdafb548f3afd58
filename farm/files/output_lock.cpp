// SPDX-License-Identifier: Apache-2.0
#include "farm/files/output_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "scene/system/diagnostics.h"
#include "scene/system/underway.h"

namespace vitrail {

namespace {

// The holder of a lock removes its file: what was opened before that is no lock any more.
bool is_still_named(int descriptor, const std::filesystem::path& file) {
  struct stat opened = {}, named = {};
  return ::fstat(descriptor, &opened) == 0 && ::stat(file.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

std::string holder(int descriptor) {
  std::array<char, 256> text{};
  const ssize_t bytes = ::pread(descriptor, text.data(), text.size(), 0);
  return bytes > 0 ? std::string(text.data(), static_cast<std::size_t>(bytes)) : "another process";
}

std::string this_process() {
  std::array<char, 128> host{};
  ::gethostname(host.data(), host.size() - 1);
  return fmt::format("process {} on {}", ::getpid(), host.data());
}

// The letter of /proc; 0 where there is no such process.
char state_of(int process) {
  std::ifstream status(fmt::format("/proc/{}/stat", process));
  std::string text;
  std::getline(status, text);
  const std::size_t name_end = text.rfind(')');
  return name_end != std::string::npos && text.size() > name_end + 2 ? text[name_end + 2] : '\0';
}

// What has ended and is not waited for by its parent has given its locks back.
bool lives(int process) {
  const char state = state_of(process);
  return state != '\0' && state != 'Z';
}

struct Holder {
  int process = 0;
  bool is_here = false;  // on this host
};

std::optional<Holder> parse_holder(const std::string& who) {
  Holder found;
  std::array<char, 128> host{}, own{};
  ::gethostname(own.data(), own.size() - 1);
  if (std::sscanf(who.c_str(), "process %d on %127s", &found.process, host.data()) != 2) return std::nullopt;
  found.is_here = std::strcmp(host.data(), own.data()) == 0;
  return found;
}

// Where the file system has no locks there is only what the file says: of this host's processes it is known
// whether they live, others are believed to.
bool holder_may_live(const std::string& who) {
  const std::optional<Holder> found = parse_holder(who);
  return found && (!found->is_here || (found->process != ::getpid() && lives(found->process)));
}

enum class Taken { by_us, by_another, not_known };

Taken try_to_lock(int descriptor) {
  if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return Taken::by_us;
  return errno == EWOULDBLOCK ? Taken::by_another : Taken::not_known;
}

}  // namespace

std::filesystem::path lock_path(std::filesystem::path output) { return output += ".lock"; }

OutputLock::OutputLock(const std::filesystem::path& output) : file_(lock_path(output)) {
  const Underway underway("locking", file_);
  while (descriptor_ < 0) {
    descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (descriptor_ < 0)
      throw MachineError(fmt::format("cannot write {}: {}", file_.string(), std::strerror(errno)));
    const Taken taken = try_to_lock(descriptor_);
    const std::string who = holder(descriptor_);
    if (taken == Taken::not_known && holder_may_live(who)) {
      ::close(std::exchange(descriptor_, -1));
      throw BeingWritten(
          fmt::format("{} belongs to another render ({}), which runs or was killed: this file system has no "
                      "locks; remove {} if that process is gone",
                      output.string(), who, file_.string()),
          who, /*may_be_gone=*/true);
    }
    if (taken != Taken::by_another && is_still_named(descriptor_, file_)) break;
    ::close(std::exchange(descriptor_, -1));
    if (taken == Taken::by_another)
      throw BeingWritten(
          fmt::format("{} is being written by another render ({}): wait for it, or give another "
                      "output",
                      output.string(), who),
          who, /*may_be_gone=*/false);
  }
  const std::string who = this_process();
  if (::ftruncate(descriptor_, 0) != 0 || ::pwrite(descriptor_, who.data(), who.size(), 0) < 0) {
    // A full disk: the lock holds all the same.
  }
}

OutputLock::~OutputLock() {
  ::unlink(file_.c_str());
  ::close(descriptor_);
}

std::unique_ptr<OutputLock> wait_for_lock(const std::filesystem::path& output,
                                          std::chrono::milliseconds longest,
                                          const std::function<void(const BeingWritten&)>& before_waiting) {
  using namespace std::chrono_literals;
  const auto end = std::chrono::steady_clock::now() + longest;
  for (bool waits = false;;) {
    try {
      return std::make_unique<OutputLock>(output);
    } catch (const BeingWritten& refused) {
      if (refused.is_only_named || std::chrono::steady_clock::now() > end) throw;
      if (!std::exchange(waits, true) && before_waiting) before_waiting(refused);
    }
    std::this_thread::sleep_for(20ms);
  }
}

namespace {

// What the lock's file says; "" where there is none.
std::string written_holder(const std::filesystem::path& output) {
  const int descriptor = ::open(lock_path(output).c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return {};
  std::string who = holder(descriptor);
  ::close(descriptor);
  return who;
}

}  // namespace

bool is_being_written(const std::filesystem::path& output) { return holder_may_live(written_holder(output)); }

std::optional<int> stopped_writer(const std::filesystem::path& output) {
  const std::optional<Holder> found = parse_holder(written_holder(output));
  if (!found || !found->is_here) return std::nullopt;
  const char state = state_of(found->process);
  return state == 'T' || state == 't' ? std::optional(found->process) : std::nullopt;
}

}  // namespace vitrail
