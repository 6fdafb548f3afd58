# SPDX-License-Identifier: Apache-2.0
# Pictures of the corpus against those of the renderers that its scenes were written for.
vitrail_library(corpus_render SOURCES corpus_render.cpp
  LIBRARIES vitrail::test_support nlohmann_json::nlohmann_json fmt::fmt GTest::gtest)
vitrail_library(nori_scene SOURCES nori_scene.cpp LIBRARIES pugixml::pugixml fmt::fmt)

function(vitrail_appearance_test name)
  vitrail_test(${name} LABEL conformance-appearance TIMEOUT 600 SOURCES ${name}_test.cpp
    LIBRARIES vitrail::corpus_render vitrail::image ${ARGN})
  add_dependencies(test_${name} vitrail vitrail-partition vitrail-render vitrail-develop vitrail-compare)
endfunction()

vitrail_appearance_test(mitsuba_reference)
vitrail_appearance_test(picture_reference vitrail::nori_scene)
vitrail_appearance_test(docs_picture)
vitrail_appearance_test(nori_radiance vitrail::nori_scene vitrail::importers)
vitrail_test(spectral_picture LABEL conformance SOURCES spectral_picture_test.cpp
  LIBRARIES vitrail::corpus_render vitrail::image)
add_dependencies(test_spectral_picture vitrail vitrail-partition vitrail-render vitrail-develop)
