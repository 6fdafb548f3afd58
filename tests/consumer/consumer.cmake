# SPDX-License-Identifier: Apache-2.0
# Installs the libraries of BUILD into FOLDER, builds the project beside this file with them, and reads SCENE.
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)

file(REMOVE_RECURSE ${FOLDER})
run(${CMAKE_COMMAND} --install ${BUILD} --component development --prefix ${FOLDER}/prefix)
run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${FOLDER}/build -G Ninja -DCMAKE_BUILD_TYPE=Release
  -DCMAKE_PREFIX_PATH=${FOLDER}/prefix -DCMAKE_CXX_FLAGS=-Werror)
run(${CMAKE_COMMAND} --build ${FOLDER}/build)
run(${FOLDER}/build/count_triangles ${SCENE})
if(NOT said MATCHES "${EXPECTED}")
  message(FATAL_ERROR "the consumer says ${said}and not ${EXPECTED}")
endif()
file(REMOVE_RECURSE ${FOLDER})
