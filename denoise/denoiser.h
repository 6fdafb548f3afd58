// SPDX-License-Identifier: Apache-2.0
// The Denoiser is Intel Open Image Denoise (Áfra 2019–), a convolutional network trained on path-traced
// pictures, on the cores of this machine. Equal machines give equal images; others may differ in the last
// bits, as instruction sets do: law 1 holds for films, not for estimates made from them.
#pragma once

#include <initializer_list>
#include <memory>
#include <string>

#include "denoise/oidn_functions.h"
#include "scene/records/image.h"

namespace vitrail {

// Guides are albedo and normals of the first surface seen in each pixel, 3 channels; 0 × 0 if not known.
struct DenoiserGuides {
  Image albedo;   // in [0,1]
  Image normals;  // components in [−1,1]; 0 where nothing is seen. Used beside an albedo alone
};

class Denoiser {
 public:
  // Loads the library (oidn_library.h). Throws MachineError where there is none, or none that runs here.
  Denoiser();

  // Returns the name with its version: "Intel Open Image Denoise 2.5.1".
  const std::string& name() const { return name_; }

  // Returns guides without their own noise, which comes of lenses, motion and textures.
  DenoiserGuides denoised(const DenoiserGuides& guides) const;
  // Denoises three channels of linear light without bound; below 0 counts as 0. `guides` are denoised ones.
  // All images are of one size. Throws MachineError.
  Image denoised(const Image& colors, const DenoiserGuides& guides) const;

 private:
  struct Input {
    const char* name;
    const Image* image;
  };
  Image run(std::initializer_list<Input> inputs, bool of_light) const;
  void require_no_error() const;

  const oidn::Functions& oidn_;
  std::unique_ptr<oidn::DeviceObject, void (*)(oidn::Device)> device_;
  std::string name_;
};

}  // namespace vitrail
