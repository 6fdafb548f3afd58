# SPDX-License-Identifier: Apache-2.0
# What find_package(vitrail) finds after `cmake --install BUILD --component development`: the libraries that are there when
# this file is read, with their headers.
get_property(libraries GLOBAL PROPERTY VITRAIL_LIBRARIES)
set(vitrail_cmake ${CMAKE_INSTALL_LIBDIR}/cmake/vitrail)
install(TARGETS ${libraries} vitrail_options vitrail_portable_math EXPORT vitrail
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
install(EXPORT vitrail NAMESPACE vitrail:: FILE vitrailTargets.cmake DESTINATION ${vitrail_cmake} COMPONENT development)
install(DIRECTORY scene glazing images importers bundle partitioner film tracer farm compare measure
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/vitrail COMPONENT development
  FILES_MATCHING PATTERN "*.h" PATTERN "*.inl")

include(CMakePackageConfigHelpers)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/vitrailConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES cmake/vitrailConfig.cmake ${CMAKE_BINARY_DIR}/vitrailConfigVersion.cmake
  DESTINATION ${vitrail_cmake} COMPONENT development)
add_custom_target(libraries DEPENDS ${libraries})
