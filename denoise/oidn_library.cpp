// SPDX-License-Identifier: Apache-2.0
#include "denoise/oidn_library.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <string>

#include "scene/system/diagnostics.h"

namespace vitrail::oidn {

namespace {

namespace fs = std::filesystem;

constexpr const char* library_name = "libOpenImageDenoise.so.2";
constexpr const char* place_variable = "VITRAIL_OIDN";

// Empty where it is not set.
fs::path variable(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

// The prefix that the first python3 on the path is installed under.
fs::path prefix_of_python() {
  std::istringstream folders(variable("PATH").string());
  std::error_code none;
  for (std::string folder; std::getline(folders, folder, ':');)
    if (fs::exists(fs::path(folder) / "python3", none)) return fs::path(folder).parent_path();
  return {};
}

void add_libraries_under(const fs::path& prefix, std::vector<fs::path>& found) {
  std::error_code none;
  std::vector<fs::path> pythons;
  for (const auto& entry : fs::directory_iterator(prefix / "lib", none))
    if (entry.path().filename().string().starts_with("python3")) pythons.push_back(entry.path());
  std::ranges::sort(pythons);
  for (const fs::path& python : pythons)
    for (const char* packages : {"site-packages", "dist-packages"}) {
      const fs::path file = python / packages / "pyoidn/oidn/lib" / library_name;
      if (fs::exists(file, none) && std::ranges::find(found, file) == found.end()) found.push_back(file);
    }
}

[[noreturn]] void fail(const std::string& what) {
  throw MachineError(fmt::format(
      "cannot denoise: {}. `pip install pyoidn` installs Intel Open Image Denoise 2 into a Python "
      "environment, and Vitrail finds it there. {} names the library, or its folder, elsewhere",
      what, place_variable));
}

void* open_library(const fs::path& file) { return ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL); }

void* load_library() {
  fs::path given = variable(place_variable);
  if (!given.empty()) {
    std::error_code none;
    if (fs::is_directory(given, none)) given /= library_name;
    // Without a slash it would be looked for elsewhere.
    if (void* library = open_library(fs::absolute(given))) return library;
    fail(fmt::format("{} is {}: {}", place_variable, given.string(), ::dlerror()));
  }
  if (void* library = open_library(library_name)) return library;
  std::string why = fmt::format("{} is nowhere", library_name);
  for (const fs::path& file : python_libraries()) {
    if (void* library = open_library(file)) return library;
    why = ::dlerror();
  }
  fail(why);
}

template <class Function>
void find(void* library, const char* name, Function*& function) {
  function = reinterpret_cast<Function*>(::dlsym(library, name));
  if (!function) fail(fmt::format("the library is not of version 2: {}", ::dlerror()));
}

Functions load() {
  void* const library = load_library();
  Functions f;
  find(library, "oidnNewDevice", f.NewDevice);
  find(library, "oidnSetDeviceBool", f.SetDeviceBool);
  find(library, "oidnGetDeviceInt", f.GetDeviceInt);
  find(library, "oidnCommitDevice", f.CommitDevice);
  find(library, "oidnGetDeviceError", f.GetDeviceError);
  find(library, "oidnReleaseDevice", f.ReleaseDevice);
  find(library, "oidnNewFilter", f.NewFilter);
  find(library, "oidnSetSharedFilterImage", f.SetSharedFilterImage);
  find(library, "oidnSetFilterBool", f.SetFilterBool);
  find(library, "oidnSetFilterInt", f.SetFilterInt);
  find(library, "oidnCommitFilter", f.CommitFilter);
  find(library, "oidnExecuteFilter", f.ExecuteFilter);
  find(library, "oidnReleaseFilter", f.ReleaseFilter);
  return f;
}

}  // namespace

std::vector<fs::path> python_libraries() {
  std::vector<fs::path> found;
  const fs::path home = variable("HOME");
  for (const fs::path& prefix :
       {variable("VIRTUAL_ENV"), variable("CONDA_PREFIX"), prefix_of_python(),
        home.empty() ? fs::path() : home / ".local", fs::path("/usr/local"), fs::path("/usr")})
    if (!prefix.empty()) add_libraries_under(prefix, found);
  return found;
}

const Functions& functions() {
  static const Functions loaded = load();
  return loaded;
}

}  // namespace vitrail::oidn
