// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "python/parts.h"
#include "scene/system/diagnostics.h"

namespace {

// Bad input is a ValueError, with the place; the machine's failures are OSErrors.
void translate(const std::exception_ptr& thrown, void*) {
  try {
    std::rethrow_exception(thrown);
  } catch (const vitrail::Error& e) {
    const std::string place = to_string(e.location);
    PyErr_SetString(PyExc_ValueError,
                    fmt::format("{}{}{}", place, place.empty() ? "" : ": ", e.what()).c_str());
  } catch (const vitrail::MachineError& e) {
    PyErr_SetString(PyExc_OSError, e.what());
  }
}

}  // namespace

NB_MODULE(_vitrail, module) {
  nanobind::register_exception_translator(translate);
  vitrail::python::add_films(module);
  vitrail::python::add_manifests(module);
  vitrail::python::add_spectra(module);
}
