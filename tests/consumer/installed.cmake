# SPDX-License-Identifier: Apache-2.0
# Installs the programs of BUILD into FOLDER, and makes a picture of SCENE there: the first program finds the others by a link, and
# one of them what reads .exr.
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)
file(REMOVE_RECURSE ${FOLDER})
set(prefix "${FOLDER}/some where")
foreach(component programs images)
  run(${CMAKE_COMMAND} --install ${BUILD} --component ${component} --prefix ${prefix})
endforeach()
run(${prefix}/bin/vitrail render ${SCENE} -o ${FOLDER}/picture.film --spp 1 --scale 0.1 --quiet)
run(${prefix}/bin/vitrail develop ${FOLDER}/picture.film -o ${FOLDER}/picture.exr)
run(${prefix}/bin/vitrail compare ${FOLDER}/picture.exr ${FOLDER}/picture.film --metric bitwise)
foreach(file share/man/man1/vitrail-render.1.gz share/bash-completion/completions/vitrail share/doc/vitrail/examples/cornell-box.pbrt)
  if(NOT EXISTS ${prefix}/${file})
    message(FATAL_ERROR "${file} is not installed")
  endif()
endforeach()
file(REMOVE_RECURSE ${FOLDER})
