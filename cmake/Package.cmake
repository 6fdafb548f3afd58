# SPDX-License-Identifier: Apache-2.0
# The packages vitrail and vitrail-images (*_VERSION_ARCHITECTURE.deb), of what is installed as programs and images.
# scripts/package makes them.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)
set(debian ${CMAKE_BINARY_DIR}/debian)
file(MAKE_DIRECTORY ${debian})
configure_file(cmake/debian/changelog.in ${debian}/changelog @ONLY)
execute_process(COMMAND gzip -9nc ${debian}/changelog OUTPUT_FILE ${debian}/changelog.gz COMMAND_ERROR_IS_FATAL ANY)
foreach(package vitrail vitrail-images)
  string(REPLACE vitrail-images images component ${package})
  string(REPLACE vitrail programs component ${component})
  install(FILES cmake/debian/copyright ${debian}/changelog.gz DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${component})
endforeach()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL programs images)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_PACKAGE_NAME vitrail)
set(CPACK_PACKAGE_CONTACT "Vitrail maintainers <maintainers@users.noreply.github.com>")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "converts scenes and renders them spectrally on clusters")

set(CPACK_DEBIAN_PROGRAMS_PACKAGE_NAME vitrail)
# Images in scenes; mpirun, which one process renders without; generators of examples.
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SUGGESTS "vitrail-images, openmpi-bin, python3, libfreetype6, povray-includes, fonts-povray")
set(CPACK_COMPONENT_PROGRAMS_DESCRIPTION
"Vitrail converts scenes between PBRT, Mitsuba, glTF, OBJ, PLY and POV-Ray. It renders
scenes that are larger than a machine's memory, spectrally, on one machine or
under MPI, and gives the same film bit for bit on any number of ranks. Pictures
are written as OpenEXR and PNG. Scenes with images need vitrail-images.")

set(CPACK_DEBIAN_IMAGES_PACKAGE_NAME vitrail-images)
set(CPACK_DEBIAN_IMAGES_PACKAGE_DEPENDS "vitrail (= ${PROJECT_VERSION})")
set(CPACK_COMPONENT_IMAGES_DESCRIPTION
"What Vitrail needs where scenes have images or are FBX, COLLADA or 3DS, and
where pictures are not OpenEXR or PNG, or PNG is compared: OpenImageIO, OpenColorIO
and assimp.")
include(CPack)
