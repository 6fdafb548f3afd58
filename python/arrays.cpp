// SPDX-License-Identifier: Apache-2.0
#include "python/arrays.h"

#include <memory>

namespace vitrail::python {

Array<double> owned(std::vector<double> values) {
  auto kept = std::make_unique<std::vector<double>>(std::move(values));
  const double* first = kept->data();
  const std::size_t count = kept->size();
  const nanobind::capsule owner(
      kept.release(), [](void* memory) noexcept { delete static_cast<std::vector<double>*>(memory); });
  return view(first, {count}, owner);
}

}  // namespace vitrail::python
