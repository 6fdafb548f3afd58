# SPDX-License-Identifier: Apache-2.0
vitrail_library(mitsuba
  SOURCES
    mitsuba/bsdfs.cpp mitsuba/load.cpp mitsuba/mitsuba.cpp mitsuba/object.cpp mitsuba/report.cpp mitsuba/spectra.cpp
    mitsuba/textures.cpp mitsuba/values.cpp
  LIBRARIES vitrail::geometry_importers vitrail::scene pugixml::pugixml FastFloat::fast_float fmt::fmt)
