# What every target compiles with. Contraction of a*b+c is off, so that the same input gives the same
# bits with every compiler and number of threads.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Release, RelWithDebInfo or Debug" FORCE)
endif()

find_program(FRUSTUM_CCACHE ccache)
if(FRUSTUM_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # Else ccache does not keep what starts from precompiled headers.
  set(CMAKE_CXX_COMPILER_LAUNCHER
      "${CMAKE_COMMAND};-E;env;CCACHE_SLOPPINESS=pch_defines,time_macros;${FRUSTUM_CCACHE}")
endif()

add_library(frustum_flags INTERFACE)
target_compile_features(frustum_flags INTERFACE cxx_std_20)
target_compile_options(
  frustum_flags INTERFACE -Wall -Wextra -Wpedantic -Wconversion -ffp-contract=off
                          $<$<BOOL:${FRUSTUM_WARNINGS_AS_ERRORS}>:-Werror>)

# GCC collects its garbage from half a gibibyte on only: every seventh second of a build went there.
target_compile_options(
  frustum_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=524288>)

# Sources that are compiled together see each other's helpers: a local of the same name is no mistake then, and
# a nameless namespace no longer belongs to the main file.
if(FRUSTUM_UNITY)
  target_compile_options(
    frustum_flags INTERFACE $<IF:$<CXX_COMPILER_ID:GNU>,-Wshadow=local;-Wno-subobject-linkage,-Wshadow>)
else()
  target_compile_options(frustum_flags INTERFACE -Wshadow)
endif()

# Our own assertions stay on in optimised builds (a wrong part is worse than a slow one); those of the
# libraries, which sit in inner loops, do not.
if(FRUSTUM_ASSERTIONS)
  target_compile_options(frustum_flags INTERFACE $<$<NOT:$<CONFIG:Debug>>:-UNDEBUG>)
  target_compile_definitions(
    frustum_flags INTERFACE $<$<NOT:$<CONFIG:Debug>>:EIGEN_NO_DEBUG;CGAL_NDEBUG>)
endif()

# FRUSTUM_SANITIZE=address,undefined: the whole build, tests included, runs under the sanitizers.
if(FRUSTUM_SANITIZE)
  add_compile_options(-fsanitize=${FRUSTUM_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${FRUSTUM_SANITIZE})
  # GCC warns of its own instrumentation inside standard headers (GCC bug 105562).
  target_compile_options(frustum_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
endif()
