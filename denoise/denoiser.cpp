// SPDX-License-Identifier: Apache-2.0
#include "denoise/denoiser.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "denoise/oidn_library.h"
#include "scene/system/diagnostics.h"
#include "scene/system/memory_guard.h"

namespace vitrail {

namespace {

// The network takes at most this, or cuts the picture into tiles, which give the same picture.
std::uint64_t scratch_bytes(int mib, std::size_t pixels) {
  constexpr std::uint64_t a_pixel = 800;
  return std::min(static_cast<std::uint64_t>(mib) << 20, a_pixel * pixels);
}

// Returns the most that --memory leaves. With 1000 a picture of 3840 × 2160 takes 1.2 times the processor's
// time that it takes with 3000; below 500 more, and hardly less memory.
int scratch_mib(std::size_t pixels) {
  for (const int mib : {3000, 1000})
    if (memory_allows(scratch_bytes(mib, pixels))) return mib;
  return 500;
}

}  // namespace

Denoiser::Denoiser()
    : oidn_(oidn::functions()), device_(oidn_.NewDevice(oidn::device_cpu), oidn_.ReleaseDevice) {
  require_no_error();
  if (!device_) throw MachineError("cannot denoise: Open Image Denoise does not run on this processor");
  oidn_.SetDeviceBool(device_.get(), "setAffinity", false);  // other programs work here, too
  oidn_.CommitDevice(device_.get());
  require_no_error();
  const auto version = [&](const char* part) { return oidn_.GetDeviceInt(device_.get(), part); };
  name_ = fmt::format("Intel Open Image Denoise {}.{}.{}", version("versionMajor"), version("versionMinor"),
                      version("versionPatch"));
}

void Denoiser::require_no_error() const {
  const char* message = nullptr;
  if (oidn_.GetDeviceError(device_.get(), &message) != oidn::no_error)
    throw MachineError(
        fmt::format("cannot denoise: Open Image Denoise: {}", message ? message : "it failed"));
}

Image Denoiser::run(std::initializer_list<Input> inputs, bool of_light) const {
  const std::unique_ptr<oidn::FilterObject, void (*)(oidn::Filter)> filter(
      oidn_.NewFilter(device_.get(), "RT"), oidn_.ReleaseFilter);
  require_no_error();
  Image output = *inputs.begin()->image;
  const auto width = static_cast<std::size_t>(output.width), height = static_cast<std::size_t>(output.height);
  const auto set = [&](const char* name, const float* pixels) {
    oidn_.SetSharedFilterImage(filter.get(), name, const_cast<float*>(pixels), oidn::format_float3, width,
                               height, 0, 0, 0);
  };
  for (const Input& input : inputs)
    if (input.image->pixels() > 0) set(input.name, input.image->values.data());
  set("output", output.values.data());
  oidn_.SetFilterBool(filter.get(), "hdr", of_light);
  oidn_.SetFilterBool(filter.get(), "cleanAux", of_light);
  const int scratch = scratch_mib(output.pixels());
  oidn_.SetFilterInt(filter.get(), "maxMemoryMB", scratch);
  const GrantedMemory library(scratch_bytes(scratch, output.pixels()));
  oidn_.CommitFilter(filter.get());
  oidn_.ExecuteFilter(filter.get());
  require_no_error();
  return output;
}

DenoiserGuides Denoiser::denoised(const DenoiserGuides& guides) const {
  DenoiserGuides clean;
  if (guides.albedo.pixels() == 0) return clean;
  clean.albedo = run({{"albedo", &guides.albedo}}, false);
  if (guides.normals.pixels() > 0) clean.normals = run({{"normal", &guides.normals}}, false);
  return clean;
}

Image Denoiser::denoised(const Image& colors, const DenoiserGuides& guides) const {
  return run({{"color", &colors}, {"albedo", &guides.albedo}, {"normal", &guides.normals}}, true);
}

}  // namespace vitrail
