# SPDX-License-Identifier: Apache-2.0
# What every model of scattering obeys; links GoogleTest's macros.
add_library(vitrail_bsdf_laws STATIC ${CMAKE_CURRENT_LIST_DIR}/bsdf_laws.cpp ${CMAKE_CURRENT_LIST_DIR}/sphere_cells.cpp)
target_link_libraries(vitrail_bsdf_laws PUBLIC vitrail::options vitrail::bsdf GTest::gtest)

foreach(model diffuse microfacet conductor dielectric plastic)
  vitrail_test(${model}_laws LABEL law SOURCES ${CMAKE_CURRENT_LIST_DIR}/${model}_laws_test.cpp
    LIBRARIES vitrail_bsdf_laws fmt::fmt)
endforeach()
vitrail_test(fresnel LABEL law SOURCES ${CMAKE_CURRENT_LIST_DIR}/fresnel_test.cpp LIBRARIES vitrail::bsdf)
vitrail_test(mitsuba_bsdf LABEL conformance TIMEOUT 300 SOURCES ${CMAKE_CURRENT_LIST_DIR}/mitsuba_bsdf_test.cpp
  LIBRARIES vitrail_bsdf_laws vitrail::mitsuba_exporter nlohmann_json::nlohmann_json)
vitrail_test(quick_math LABEL unit SOURCES ${CMAKE_CURRENT_LIST_DIR}/../tracer/quick_math_test.cpp LIBRARIES vitrail::bsdf)
