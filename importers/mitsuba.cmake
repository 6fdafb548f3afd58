# SPDX-License-Identifier: Apache-2.0
vitrail_library(mitsuba
  SOURCES
    mitsuba/analytic.cpp mitsuba/bsdfs.cpp mitsuba/curves.cpp mitsuba/emitters.cpp mitsuba/film.cpp mitsuba/integrator.cpp mitsuba/load.cpp mitsuba/media.cpp
    mitsuba/mitsuba.cpp mitsuba/object.cpp mitsuba/properties.cpp mitsuba/report.cpp mitsuba/sensor.cpp mitsuba/serialized.cpp mitsuba/shape_files.cpp
    mitsuba/shape_geometry.cpp mitsuba/shapes.cpp mitsuba/spectra.cpp
    mitsuba/textures.cpp mitsuba/values.cpp mitsuba/volume_file.cpp
  LIBRARIES vitrail::default_view vitrail::geometry_importers vitrail::spectrum_files vitrail::scene pugixml::pugixml ZLIB::ZLIB FastFloat::fast_float fmt::fmt)
