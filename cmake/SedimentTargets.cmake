# Compile rules of our own targets, and the functions that declare a library, a stage, a tool and a test.
add_library(sediment_rules INTERFACE)
target_include_directories(sediment_rules INTERFACE ${CMAKE_SOURCE_DIR})
# -ffp-contract=off: the same bytes whether or not a clone of a function may use fused multiply-add.
# Never -march=native: Debian's PCL is built for baseline x86-64 and Eigen's alignment would differ.
target_compile_options(sediment_rules INTERFACE -Wall -Wextra -Wpedantic -Wshadow -ffp-contract=off
                       $<$<BOOL:${SEDIMENT_WARNINGS_AS_ERRORS}>:-Werror>)

if(CMAKE_CXX_FLAGS_DEBUG MATCHES "sanitize=address" AND CMAKE_BUILD_TYPE STREQUAL "Debug")
  add_library(sediment_leak_suppressions STATIC ${CMAKE_CURRENT_LIST_DIR}/leak_suppressions.c)
  target_link_libraries(sediment_rules INTERFACE sediment_leak_suppressions)
  target_link_options(sediment_rules INTERFACE LINKER:-u,__lsan_default_suppressions)
endif()

# sediment_compile_together(TARGET): with SEDIMENT_TOGETHER its headers, not its own code, being what takes the time, eight
# files are compiled as one. Not for what computes: the compiler inlines less in large files (synthesize became a quarter
# slower).
function(sediment_compile_together target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${SEDIMENT_TOGETHER} UNITY_BUILD_BATCH_SIZE 8)
endfunction()

# sediment_precompile(TARGET [_lightly]): with SEDIMENT_TOGETHER the headers that most files include are read once for all
# targets. What is optimised lightly needs a copy of its own, with the library of tests. CLI11 is in neither: its header
# defines objects, which are then compiled anew in every file (2.7 s each).
set(sediment_common_headers
    <algorithm> <array> <cmath> <cstdint> <filesystem> <fstream> <functional> <limits> <map> <memory> <numeric> <optional>
    <random> <set> <span> <sstream> <stdexcept> <string> <unordered_map> <vector> <nlohmann/json.hpp> <opencv2/core.hpp>
    <opencv2/imgproc.hpp>)
function(sediment_precompile target)
  if(NOT SEDIMENT_TOGETHER)
    return()
  endif()
  set(headers sediment_headers${ARGN})
  if(NOT TARGET ${headers})
    file(GENERATE OUTPUT ${CMAKE_BINARY_DIR}/${headers}.cpp CONTENT "// Stands for precompiled headers.\n")
    add_library(${headers} STATIC ${CMAKE_BINARY_DIR}/${headers}.cpp)
    target_link_libraries(${headers} PRIVATE sediment_rules sediment_cv_imgproc nlohmann_json::nlohmann_json)
    target_precompile_headers(${headers} PRIVATE ${sediment_common_headers})
    if(ARGN)
      target_precompile_headers(${headers} PRIVATE <catch2/catch.hpp>)
      sediment_optimise_lightly(${headers})
    endif()
  endif()
  target_precompile_headers(${target} REUSE_FROM ${headers})
endfunction()

# sediment_optimise_lightly(TARGET): for code whose compilation takes longer than its work: tests, and the flags of tools,
# which are mostly templates of the library that parses them.
function(sediment_optimise_lightly target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# sediment_library(NAME LINKS target... SOURCES file...)
function(sediment_library name)
  cmake_parse_arguments(arg "" "" "SOURCES;LINKS;PRIVATE_LINKS" ${ARGN})
  add_library(${name} STATIC ${arg_SOURCES})
  target_link_libraries(${name} PUBLIC sediment_rules ${arg_LINKS} PRIVATE ${arg_PRIVATE_LINKS})
  sediment_precompile(${name})
endfunction()

# sediment_stage(NAME SOURCES file... LINKS target...): the library `stage_NAME` of the pure algorithm, and the
# executable NAME from main.cpp that puts the contract and the artifacts around it.
function(sediment_stage name)
  cmake_parse_arguments(arg "" "" "SOURCES;LINKS;PRIVATE_LINKS" ${ARGN})
  sediment_library(stage_${name} SOURCES ${arg_SOURCES} LINKS sediment_scene ${arg_LINKS}
                   PRIVATE_LINKS ${arg_PRIVATE_LINKS})
  add_executable(${name} main.cpp)
  target_link_libraries(${name} PRIVATE stage_${name} sediment_artifacts sediment_contract)
  sediment_precompile(${name})
endfunction()

# sediment_tool(NAME [COMPUTES] SOURCES file... LINKS target...): the library `tool_NAME` and the executable NAME.
function(sediment_tool name)
  cmake_parse_arguments(arg "COMPUTES" "" "SOURCES;LINKS;PRIVATE_LINKS" ${ARGN})
  if(arg_SOURCES)
    sediment_library(tool_${name} SOURCES ${arg_SOURCES} LINKS sediment_scene sediment_artifacts ${arg_LINKS}
                     PRIVATE_LINKS ${arg_PRIVATE_LINKS})
    if(NOT arg_COMPUTES)
      sediment_compile_together(tool_${name})
    endif()
  endif()
  add_executable(${name} main.cpp)
  target_link_libraries(${name} PRIVATE sediment_rules sediment_artifacts CLI11::CLI11)
  sediment_optimise_lightly(${name})  # main.cpp alone
  sediment_precompile(${name} _lightly)
  if(arg_SOURCES)
    target_link_libraries(${name} PRIVATE tool_${name})
  endif()
endfunction()

# sediment_test(NAME SOURCES file... LINKS target...): one Catch2 program `test_NAME`, each TEST_CASE a ctest entry.
# A test that cannot run prints a line "skipped: needs ..." and ctest reports it as skipped.
function(sediment_test name)
  cmake_parse_arguments(arg "" "" "SOURCES;LINKS" ${ARGN})
  add_executable(test_${name} ${arg_SOURCES})
  target_link_libraries(test_${name} PRIVATE sediment_rules test_support ${arg_LINKS})
  sediment_compile_together(test_${name})
  sediment_optimise_lightly(test_${name})
  sediment_precompile(test_${name} _lightly)
  catch_discover_tests(test_${name} TEST_PREFIX "${name}: " DISCOVERY_MODE PRE_TEST
                       PROPERTIES SKIP_REGULAR_EXPRESSION "skipped: needs" TIMEOUT 600)
endfunction()

# sediment_add_subdirectories(): every subfolder that has a CMakeLists.txt, in alphabetical order.
function(sediment_add_subdirectories)
  file(GLOB lists CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} */CMakeLists.txt)
  list(SORT lists)
  foreach(list ${lists})
    get_filename_component(folder ${list} DIRECTORY)
    add_subdirectory(${folder})
  endforeach()
endfunction()

# sediment_script_test(SENTENCE SCRIPT argument...): a test in bash (tests/support/script_test.sh). The programs are in
# the folder named by SEDIMENT_BIN.
function(sediment_script_test sentence script)
  add_test(NAME ${sentence} COMMAND bash ${CMAKE_CURRENT_SOURCE_DIR}/${script} ${ARGN})
  set_tests_properties(${sentence} PROPERTIES SKIP_REGULAR_EXPRESSION "skipped: needs" TIMEOUT 900
                       ENVIRONMENT SEDIMENT_BIN=${CMAKE_RUNTIME_OUTPUT_DIRECTORY})
endfunction()
