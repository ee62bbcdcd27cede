# Headers that nearly every file reads, compiled once for the rooms, once for those where nobody waits for the
# arithmetic, and once for the programs (whose code is position-independent in another way). Every file still includes what it uses: FRUSTUM_PRECOMPILE=OFF
# builds without them.
option(FRUSTUM_PRECOMPILE "Compile the headers that nearly every file reads only once" ON)

set(FRUSTUM_COMMON_HEADERS
    <Eigen/Core> <Eigen/Geometry> <fmt/format.h> <algorithm> <array> <cmath> <filesystem> <functional>
    <limits> <map> <memory> <numbers> <optional> <span> <sstream> <string> <string_view> <utility>
    <variant> <vector>)
set(FRUSTUM_TEST_HEADERS <gmock/gmock.h> <gtest/gtest.h> <rapidcheck.h> <rapidcheck/gtest.h>)

# Test sources are compiled in a third less time so, and what they call is in libraries made for speed.
set(FRUSTUM_TEST_OPTIMISATION $<$<CONFIG:Release>:-O1>)

# TARGET reads and writes files and pages: optimised less, it is compiled in a fifth less time. Before
# frustum_precompile().
function(frustum_cold target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  set_target_properties(${target} PROPERTIES FRUSTUM_COLD ON)
endfunction()

# The files of TARGET, a library or a test program, start from them, or from them and further headers that are
# named.
function(frustum_precompile target)
  if(NOT FRUSTUM_PRECOMPILE)
    return()
  endif()
  if(ARGN)
    target_precompile_headers(${target} PRIVATE ${FRUSTUM_COMMON_HEADERS} ${ARGN})
    return()
  endif()
  get_target_property(type ${target} TYPE)
  get_target_property(cold ${target} FRUSTUM_COLD)
  if(cold)
    target_precompile_headers(${target} REUSE_FROM frustum_precompiled_cold)
  elseif(type STREQUAL EXECUTABLE)
    target_precompile_headers(${target} REUSE_FROM frustum_precompiled_test)
  else()
    target_precompile_headers(${target} REUSE_FROM frustum_precompiled)
  endif()
endfunction()

if(FRUSTUM_PRECOMPILE)
  # Out of precompiled headers GCC no longer knows the standard library's code for such, and warns of what
  # it inlines from there; FRUSTUM_PRECOMPILE=OFF warns of ours.
  target_compile_options(
    frustum_flags
    INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds;-Wno-stringop-overread;-Wno-stringop-overflow;-Wno-restrict;-Wno-maybe-uninitialized>)
  # So that ccache can keep what starts from them.
  target_compile_options(frustum_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
  set(source "${CMAKE_BINARY_DIR}/precompiled.cpp")
  file(CONFIGURE OUTPUT "${source}" CONTENT "int main() { return 0; }\n")
  add_library(frustum_precompiled STATIC "${source}")
  target_link_libraries(frustum_precompiled PRIVATE frustum_flags Eigen3::Eigen fmt::fmt)
  target_precompile_headers(frustum_precompiled PRIVATE ${FRUSTUM_COMMON_HEADERS})
  add_library(frustum_precompiled_cold STATIC "${source}")
  target_link_libraries(frustum_precompiled_cold PRIVATE frustum_flags Eigen3::Eigen fmt::fmt)
  frustum_cold(frustum_precompiled_cold)
  target_precompile_headers(frustum_precompiled_cold PRIVATE ${FRUSTUM_COMMON_HEADERS})
  if(FRUSTUM_BUILD_TESTS)
    find_package(GTest 1.12 REQUIRED)
    find_package(rapidcheck REQUIRED)
    add_executable(frustum_precompiled_test "${source}")
    target_link_libraries(
      frustum_precompiled_test PRIVATE frustum_flags Eigen3::Eigen fmt::fmt GTest::gmock GTest::gtest
                                       rapidcheck rapidcheck_gtest)
    target_compile_options(frustum_precompiled_test PRIVATE ${FRUSTUM_TEST_OPTIMISATION})
    target_precompile_headers(frustum_precompiled_test PRIVATE ${FRUSTUM_COMMON_HEADERS}
                                                               ${FRUSTUM_TEST_HEADERS})
  endif()
endif()
