# What every target compiles with. Contraction of a*b+c is off, so that the same input gives the same
# bits with every compiler and number of threads.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

find_program(FRUSTUM_CCACHE ccache)
if(FRUSTUM_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${FRUSTUM_CCACHE}")
endif()

add_library(frustum_flags INTERFACE)
target_compile_features(frustum_flags INTERFACE cxx_std_20)
target_compile_options(
  frustum_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -ffp-contract=off
                          $<$<BOOL:${FRUSTUM_WARNINGS_AS_ERRORS}>:-Werror>)
