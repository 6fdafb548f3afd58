// SPDX-License-Identifier: Apache-2.0
#include "bundle/ray_profile.h"
#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vitrail;
  return fuzz::run([&] {
    const RayProfile p = read_ray_profile(fuzz::write("profile.json", data, size));
    fuzz::require(p.domain_at({0, 0, 0}) < p.domains.size());
  });
}
