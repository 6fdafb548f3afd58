// SPDX-License-Identifier: Apache-2.0
// BSDFs that stand in files of measurements.
#include <fmt/format.h>

#include "importers/mitsuba/read/bsdf_models.h"
#include "importers/reading/glazing_material.h"
#include "importers/spectra/sheet_file.h"

namespace vitrail::mitsuba {

MaterialModel glazing_system(Builder& b, const Object& o, std::string file) {
  for (const char* name : {"state", "temperature"})
    if (o.has(name)) file += fmt::format("#{}={}", name, o.number(name, 0, b.report));
  GlazingModel made = glazing_model(file, [&](Material side) { return append(b, std::move(side)); });
  for (const std::string& note : made.notes) b.report.approximated(note, o.origin);
  return std::move(made.model);
}

MaterialModel measured(Builder& b, const Object& o) {
  const std::string filename = o.text("filename", "", b.report);
  if (filename.empty()) b.report.fail("a measured material needs a \"filename\"", o.origin);
  o.ignore({"alpha_sample", "wavelength"});
  if (is_glazing(filename)) return glazing_system(b, o, filename);
  if (is_measured_sheet(filename)) {
    MeasuredSheetFile file = read_measured_sheet(filename);
    for (const std::string& repair : file.repairs) b.report.approximated(repair, o.origin);
    return MeasuredMaterial{filename, std::move(file.sheet)};
  }
  if (o.type == "measured_polarized") {
    b.report.approximated("what it does to polarisation is left out", o.origin);
    return MeasuredMaterial{filename};  // of another format
  }
  return TabulatedMaterial{TabulatedMaterial::Format::adaptive, filename};
}

}  // namespace vitrail::mitsuba
