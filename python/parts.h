// SPDX-License-Identifier: Apache-2.0
// These functions each add one file's classes and functions to the module.
#pragma once

#include <nanobind/nanobind.h>

namespace vitrail::python {

void add_films(nanobind::module_& module);
void add_manifests(nanobind::module_& module);
void add_spectra(nanobind::module_& module);

}  // namespace vitrail::python
