# SPDX-License-Identifier: Apache-2.0
vitrail_library(spectrum_files
  SOURCES spectra/measured_sheet.cpp spectra/spectrum_file.cpp spectra/spectrum_text.cpp spectra/spectrum_xml.cpp
  LIBRARIES vitrail::geometry_importers vitrail::scene pugixml::pugixml FastFloat::fast_float fmt::fmt)
