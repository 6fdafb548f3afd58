# SPDX-License-Identifier: Apache-2.0
vitrail_library(mitsuba
  SOURCES
    mitsuba/bsdfs.cpp mitsuba/emitters.cpp mitsuba/film.cpp mitsuba/integrator.cpp mitsuba/load.cpp mitsuba/media.cpp
    mitsuba/mitsuba.cpp mitsuba/object.cpp mitsuba/properties.cpp mitsuba/report.cpp mitsuba/sensor.cpp mitsuba/spectra.cpp
    mitsuba/textures.cpp mitsuba/values.cpp mitsuba/volume_file.cpp
  LIBRARIES vitrail::geometry_importers vitrail::scene pugixml::pugixml FastFloat::fast_float fmt::fmt)
