// SPDX-License-Identifier: Apache-2.0
// These are the functions that Vitrail calls of Intel Open Image Denoise 2.x, as its C interface defines them
// (openimagedenoise.org/documentation). They are declared here because the library is loaded at run time, and
// its packages that are easy to have come without headers.
#pragma once

#include <cstddef>

namespace vitrail::oidn {

using Device = struct DeviceObject*;
using Filter = struct FilterObject*;

inline constexpr int device_cpu = 1;     // OIDN_DEVICE_TYPE_CPU: reads and writes the memory of programs
inline constexpr int format_float3 = 3;  // OIDN_FORMAT_FLOAT3
inline constexpr int no_error = 0;       // OIDN_ERROR_NONE

// A member is the function "oidn" + its name.
struct Functions {
  Device (*NewDevice)(int type);
  void (*SetDeviceBool)(Device, const char* name, bool value);
  int (*GetDeviceInt)(Device, const char* name);
  void (*CommitDevice)(Device);
  // Returns the first error since the last call, and its message, which stays valid until the next call. Of
  // no device, it says why there is none.
  int (*GetDeviceError)(Device, const char** message);
  void (*ReleaseDevice)(Device);
  Filter (*NewFilter)(Device, const char* type);
  // Sets pixels that stay the caller's. Strides are in bytes; 0 means without gaps.
  void (*SetSharedFilterImage)(Filter, const char* name, void* pixels, int format, std::size_t width,
                               std::size_t height, std::size_t offset, std::size_t pixel_stride,
                               std::size_t row_stride);
  void (*SetFilterBool)(Filter, const char* name, bool value);
  void (*SetFilterInt)(Filter, const char* name, int value);
  void (*CommitFilter)(Filter);
  void (*ExecuteFilter)(Filter);
  void (*ReleaseFilter)(Filter);
};

}  // namespace vitrail::oidn
