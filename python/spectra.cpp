// SPDX-License-Identifier: Apache-2.0
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "python/arrays.h"
#include "python/parts.h"
#include "scene/spectra/named_spectra.h"
#include "scene/system/diagnostics.h"

namespace nb = nanobind;

namespace vitrail::python {

namespace {

Array<double> values_of(const std::string& name) {
  const std::optional<Spectrum> spectrum = named_spectrum(name);
  if (!spectrum) {
    const std::string meant = closest_word(name, spectrum_names());
    throw Error("there is no spectrum \"" + name + "\"" +
                (meant.empty() ? "" : "; did you mean " + meant + "?"));
  }
  const Spectrum cheap = resolved(*spectrum);
  std::vector<double> values;
  for (int i = 0; i < table_size; ++i) values.push_back(evaluate(cheap, lambda_min_nm + i));
  return owned(std::move(values));
}

}  // namespace

void add_spectra(nb::module_& module) {
  module.attr("table_size") = table_size;
  module.def("spectrum_names", &spectrum_names, "Glasses, metals and illuminants that scenes name.");
  module.def("spectrum", &values_of, nb::arg("name"), "float64, 471 values at 360, 361 … 830 nm.");
}

}  // namespace vitrail::python
