// SPDX-License-Identifier: Apache-2.0
// A domain file whose checksums are put right, read, and hit by rays.
#include "tests/fuzz/fuzz_reader.h"
#include "tests/fuzz/repair.h"
#include "tracer/intersect/intersector.h"

namespace {

using namespace vitrail;

// Without its objects.
void hit(DomainView view) {
  if (!view.instances.empty()) view.instances = {}, view.instance_nodes = {};
  for (const Vector3f direction : {Vector3f{1, 1, 1}, {-1, 0.5f, 0}, {0, 0, -1}, {1e-30f, 1, 0}}) {
    const RayConstants ray = prepare({{0.1f, 0.2f, 0.3f}, direction});
    for (const Kernel kernel : available_kernels()) {
      Hit found;
      kernel_functions(kernel).closest(view, ray, found);
      static_cast<void>(kernel_functions(kernel).occluded(view, ray, 100.0f));
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::run([&] {
    const auto* first = reinterpret_cast<const std::byte*>(data);
    std::vector<std::byte> bytes(first, first + size);
    fuzz::repair_domain(bytes);
    const auto* repaired = reinterpret_cast<const std::uint8_t*>(bytes.data());
    const MappedDomain domain(fuzz::write("a.dom", repaired, bytes.size()));
    hit(domain.view());
    domain.check_cold();
    static_cast<void>(domain.pieces());
  });
}
