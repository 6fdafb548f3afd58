// SPDX-License-Identifier: Apache-2.0
#include "importers/spectra/sheet_file.h"
#include "importers/spectra/spectrum_file.h"
#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vitrail;
  const std::filesystem::path file = fuzz::write("spectrum.spd", data, size);
  return fuzz::run([&] {
    if (is_measured_sheet(file)) {
      const MeasuredSheet sheet = read_measured_sheet(file).sheet;
      const std::size_t values = sheet.wavelengths_nm.size() * sheet.cosines.size();
      fuzz::require(sheet.reflectance.size() == values && sheet.transmittance.size() == values);
      return;
    }
    const SpectrumFile read = read_spectrum_file(file);
    for (const SpectrumPart part : {SpectrumPart::n, SpectrumPart::k}) spectrum_of(read, part, false);
  });
}
