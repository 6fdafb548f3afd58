// SPDX-License-Identifier: Apache-2.0
#include "scene/system/resource_usage.h"

#include <fcntl.h>
#include <link.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <fstream>
#include <span>
#include <string>

namespace vitrail {

namespace {

double seconds(clockid_t clock) {
  timespec t{};
  ::clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace

double cpu_seconds() { return seconds(CLOCK_PROCESS_CPUTIME_ID); }
double thread_cpu_seconds() { return seconds(CLOCK_THREAD_CPUTIME_ID); }

// Not ru_maxrss, which begins with what the process that started this one had taken.
std::uint64_t peak_resident_bytes() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    std::uint64_t kib = 0;
    if (word == "VmHWM:" && status >> kib) return kib * 1024;
  }
  rusage u{};
  ::getrusage(RUSAGE_SELF, &u);
  return static_cast<std::uint64_t>(u.ru_maxrss) * 1024;
}

// Segments that are run are never written: nothing is lost.
void forget_code_pages() {
  ::dl_iterate_phdr(
      [](dl_phdr_info* object, std::size_t, void*) {
        static const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
        for (const ElfW(Phdr) & segment : std::span(object->dlpi_phdr, object->dlpi_phnum))
          if (segment.p_type == PT_LOAD && (segment.p_flags & PF_X) && !(segment.p_flags & PF_W)) {
            const std::uintptr_t begin = object->dlpi_addr + segment.p_vaddr, first = begin / page * page;
            ::madvise(reinterpret_cast<void*>(first), begin + segment.p_memsz - first, MADV_DONTNEED);
          }
        return 0;
      },
      nullptr);
}

// The second number of the file is pages. Asked for often, and where nothing may be allocated.
std::uint64_t resident_bytes() {
  static const int file = ::open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  static const auto page = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  std::array<char, 128> text;
  const ssize_t length = file < 0 ? -1 : ::pread(file, text.data(), text.size(), 0);
  if (length <= 0) return peak_resident_bytes();
  const char *const begin = text.data(), *const end = begin + length;
  std::uint64_t pages = 0;
  std::from_chars(std::find(begin, end, ' ') + 1, end, pages);
  return pages * page;
}

}  // namespace vitrail
