# SPDX-License-Identifier: Apache-2.0
# find_package(vitrail): the libraries vitrail::scene, vitrail::importers, vitrail::partitioner, vitrail::tracer …
include(CMakeFindDependencyMacro)
foreach(package Threads TBB fmt nlohmann_json FastFloat pugixml ZLIB PNG JPEG OpenEXR OpenMesh)
  find_dependency(${package})
endforeach()
# Of single libraries: vitrail::tracer needs Embree, vitrail::farm MPI (and the language C), vitrail::meshes and vitrail::solids CGAL.
find_package(embree 3 QUIET)
find_package(CGAL QUIET)
get_property(vitrail_languages GLOBAL PROPERTY ENABLED_LANGUAGES)
if(C IN_LIST vitrail_languages)
  find_package(MPI QUIET COMPONENTS C)
endif()
include(${CMAKE_CURRENT_LIST_DIR}/vitrailTargets.cmake)
