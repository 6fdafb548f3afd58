# SPDX-License-Identifier: Apache-2.0
# How every target of the project is compiled.

add_library(vitrail_options INTERFACE)
add_library(vitrail::options ALIAS vitrail_options)
target_compile_features(vitrail_options INTERFACE cxx_std_20)
set_target_properties(vitrail_options PROPERTIES EXPORT_NAME options)
target_include_directories(vitrail_options INTERFACE
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/vitrail>)
target_compile_options(vitrail_options INTERFACE
  $<BUILD_INTERFACE:-Wall> $<BUILD_INTERFACE:-Wextra> $<BUILD_INTERFACE:-Wno-missing-field-initializers>
  $<BUILD_INTERFACE:-Wconversion> $<BUILD_INTERFACE:-Wshadow>
  # The picture has to have the same bits on every machine and in every build: a fused multiply-add rounds once where
  # a multiply and an add round twice, and the compiler would choose.
  -ffp-contract=off
  # __FILE__ is the path in the project: the same program, and the same entry of a compiler cache, whichever folder it is built in.
  $<BUILD_INTERFACE:-ffile-prefix-map=${PROJECT_SOURCE_DIR}/=>
  # Nothing reads errno of mathematics: square roots and roundings are instructions, not calls.
  -fno-math-errno
  # GCC 12 loses the rounding of double → float → double where it vectorises straight-line code (a select between such a
  # vector and zero, from -O2 on): tests/scene/geometry/rounding_test.cpp.
  $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize>
  # GCC 12 warns of what std::string does in its own headers (its bug 105651) where these are precompiled; clang and
  # sanitizers still look.
  # It also takes what an empty std::optional or another alternative of a std::variant holds for a value that is read, where it has inlined
  # their moves (its bug 80635): what was looked at was so. -Wuninitialized stays; scripts/tidy and valgrind look for the true ones.
  $<BUILD_INTERFACE:$<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>>
  $<BUILD_INTERFACE:$<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds -Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread>>)
target_link_libraries(vitrail_options INTERFACE fmt::fmt)

# vitrail_precompile(NAME HEADER …): headers that are read once for all targets that reuse them. Reading them is a third of what
# compiling a file takes. A file includes what it uses all the same: the preset debug has no precompiled headers.
function(vitrail_precompile name)
  add_library(${name} OBJECT ${PROJECT_SOURCE_DIR}/cmake/precompiled.cpp)
  target_link_libraries(${name} PRIVATE vitrail::options)
  target_precompile_headers(${name} PRIVATE ${PROJECT_SOURCE_DIR}/cmake/precompiled.h ${ARGN})
endfunction()
vitrail_precompile(vitrail_precompiled)
vitrail_precompile(vitrail_precompiled_cli <CLI/CLI.hpp> <nlohmann/json.hpp>)

# What is compiled with -frounding-math, CGAL's flag, cannot use headers precompiled without it. Its files are long as they are: no
# batches of them.
function(vitrail_without_precompiled_headers)
  set_target_properties(${ARGN} PROPERTIES DISABLE_PRECOMPILE_HEADERS ON UNITY_BUILD OFF)
endfunction()

# vitrail_library(NAME SOURCES … LIBRARIES …): the library vitrail::NAME. The global property VITRAIL_LIBRARIES lists all targets.
function(vitrail_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;LIBRARIES")
  add_library(vitrail_${name} STATIC ${arg_SOURCES})
  add_library(vitrail::${name} ALIAS vitrail_${name})
  target_link_libraries(vitrail_${name} PUBLIC vitrail::options ${arg_LIBRARIES})
  target_precompile_headers(vitrail_${name} REUSE_FROM vitrail_precompiled)
  set_target_properties(vitrail_${name} PROPERTIES EXPORT_NAME ${name})
  set_property(GLOBAL APPEND PROPERTY VITRAIL_LIBRARIES vitrail_${name})
endfunction()

# vitrail_embed(TARGET FILE NAME): the file's text as `vitrail::NAME` in the header FOLDER/NAME.h, FOLDER being the file's.
function(vitrail_embed target file name)
  cmake_path(ABSOLUTE_PATH file NORMALIZE)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  file(READ ${file} text)
  file(RELATIVE_PATH file ${PROJECT_SOURCE_DIR} ${file})
  cmake_path(GET file PARENT_PATH folder)
  set(root ${CMAKE_BINARY_DIR}/embedded)
  file(CONFIGURE OUTPUT ${root}/${folder}/${name}.h @ONLY CONTENT
    "// Made of @file@.\n#pragma once\n\nnamespace vitrail {\ninline constexpr char @name@[] = R\"page~(@text@)page~\";\n}\n")
  target_include_directories(${target} PRIVATE ${root})
endfunction()

# vitrail_program(VERB SOURCES … LIBRARIES …): the program vitrail-VERB. The target `programs` builds all of them, the
# global property VITRAIL_VERBS names them.
add_custom_target(programs)
function(vitrail_program verb)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;LIBRARIES")
  add_executable(vitrail-${verb} ${arg_SOURCES})
  target_link_libraries(vitrail-${verb} PRIVATE ${arg_LIBRARIES})
  target_precompile_headers(vitrail-${verb} REUSE_FROM vitrail_precompiled_cli)
  add_dependencies(programs vitrail-${verb})
  set_property(GLOBAL APPEND PROPERTY VITRAIL_VERBS ${verb})
endfunction()

# vitrail_test(NAME LABEL l SOURCES … LIBRARIES … [TIMEOUT s] [COST s] [ALONE]): tests of these sources, registered with ctest, and the
# program test_NAME that runs them. All tests of a folder of tests/ are linked into one program, test_in_FOLDER, of which
# test_NAME is a link: it looks up which files are NAME's. ALONE: a program of its own. The limit of time is one that only
# a hang reaches. COST: about how many seconds the test takes, where it is ten or more; the longest begin first, so that none is left
# alone at the end.
function(vitrail_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "ALONE" "LABEL;TIMEOUT;COST" "SOURCES;LIBRARIES")
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 600)
  endif()
  if(arg_ALONE)
    set(program test_${name})
    vitrail_test_program(${program})
  else()
    file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR}/tests ${CMAKE_CURRENT_SOURCE_DIR})
    string(REGEX REPLACE "/.*" "" folder ${folder})
    set(program test_in_${folder})
    if(NOT TARGET ${program})
      vitrail_test_program(${program})
    endif()
    add_custom_target(test_${name} DEPENDS ${program})
    file(CREATE_LINK ${program} ${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/test_${name} SYMBOLIC)
  endif()
  get_target_property(known ${program} SOURCES)
  foreach(source ${arg_SOURCES})
    cmake_path(ABSOLUTE_PATH source NORMALIZE)
    if(NOT source IN_LIST known)
      target_sources(${program} PRIVATE ${source})
    endif()
    file(RELATIVE_PATH source ${PROJECT_SOURCE_DIR} ${source})
    set_property(TARGET ${program} APPEND PROPERTY VITRAIL_TEST_FILES "{\"test_${name}\", \"${source}\"},")
  endforeach()
  target_link_libraries(${program} PRIVATE ${arg_LIBRARIES})
  add_test(NAME ${name} COMMAND ${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/test_${name})
  set_tests_properties(${name} PROPERTIES LABELS ${arg_LABEL} TIMEOUT ${arg_TIMEOUT})
  if(arg_COST)
    set_tests_properties(${name} PROPERTIES COST ${arg_COST})
  endif()
  # Each picture is a small bundle, written to the disk for certain: into memory, where that costs nothing.
  if(arg_LABEL MATCHES "furnace|stat" AND EXISTS /dev/shm)
    set_tests_properties(${name} PROPERTIES ENVIRONMENT TMPDIR=/dev/shm)
  endif()
endfunction()

# Release tests release's libraries; the tests' own lines compile in five sixths of the time without the dearest passes.
set(vitrail_test_options $<$<CONFIG:Release>:-O1>)

# vitrail_test_program(PROGRAM): a program of tests, as yet without any.
function(vitrail_test_program program)
  set(files ${CMAKE_BINARY_DIR}/written/tests/${program}.cpp)
  file(GENERATE OUTPUT ${files} CONTENT "#include \"tests/support/test_files.h\"\n
namespace vitrail::test {\nnamespace {\nconstexpr TestFile files[] = {\n$<JOIN:$<TARGET_PROPERTY:${program},VITRAIL_TEST_FILES>,\n>};\n}
const std::span<const TestFile> test_files(files);\n}\n")
  add_executable(${program} ${files})
  set_source_files_properties(${files} PROPERTIES SKIP_PRECOMPILE_HEADERS ON SKIP_UNITY_BUILD_INCLUSION ON)
  target_link_libraries(${program} PRIVATE vitrail::options vitrail::test_main vitrail::test_paths GTest::gmock)
  target_compile_options(${program} PRIVATE ${vitrail_test_options})
  target_precompile_headers(${program} REUSE_FROM vitrail_precompiled_tests)
endfunction()

# vitrail_lanes(FILE FLAG …): how a file of tracer/lanes is compiled, for an instruction set: no comparison traps, so
# that lanes need no branches, and the C++ ABI of wider vectors does not matter, as all functions are inlined. & of plain
# bools is meant. GCC 12 takes registers of its own header for uninitialized. Tests of them are optimised as they are.
function(vitrail_lanes file)
  set_source_files_properties(${file} PROPERTIES SKIP_PRECOMPILE_HEADERS ON
    COMPILE_OPTIONS "$<$<CONFIG:Release>:-O3>;-fno-trapping-math;-Wno-psabi;-Wno-uninitialized;$<$<CXX_COMPILER_ID:Clang>:-Wno-bitwise-instead-of-logical>;${ARGN}")
endfunction()

# vitrail_stays_inside(TARGET): a test that the TARGET's objects named *_avx* define no weak function. The linker keeps
# one of each name, whichever instruction set it is compiled for. Only optimised builds inline all that they should.
function(vitrail_stays_inside target)
  if(CMAKE_BUILD_TYPE STREQUAL "Release" AND VITRAIL_TESTS)
    add_test(NAME ${target}_stays_inside COMMAND ${CMAKE_COMMAND} -DNM=${CMAKE_NM}
      "-DOBJECTS=$<JOIN:$<FILTER:$<TARGET_OBJECTS:${target}>,INCLUDE,_avx>,|>" -P ${PROJECT_SOURCE_DIR}/cmake/stays_inside.cmake)
    set_tests_properties(${target}_stays_inside PROPERTIES LABELS unit)
  endif()
endfunction()
