# frustum_module(NAME [COLD] SOURCES a.cpp ... [HOT b.cpp ...] [ALONE c.cpp ...] [USES frustum::core ...]
#                [PRIVATE_USES ...] [PRECOMPILED <header> ...] [BATCH size])
#
# One room: a static library frustum_NAME with alias frustum::NAME. USES are the arrows of the house;
# PRIVATE_USES are libraries that only the room's .cpp files see. HOT sources run in innermost loops and are
# compiled for speed; ALONE sources read headers so large, or are read with definitions of their own, that
# they are compiled one at a time; PRECOMPILED are large headers that several of them read. COLD rooms are made
# to be compiled soon rather than to run fast. At most BATCH sources (10) are compiled together: fewer where
# each takes long, so that a touch of one is built soon.
function(frustum_module name)
  cmake_parse_arguments(ROOM "COLD" "BATCH" "SOURCES;HOT;ALONE;USES;PRIVATE_USES;PRECOMPILED" ${ARGN})
  set(room frustum_${name})
  add_library(${room} STATIC ${ROOM_SOURCES} ${ROOM_ALONE})
  if(NOT ROOM_BATCH)
    set(ROOM_BATCH 10)
  endif()
  frustum_unity(${room} ${ROOM_BATCH} ${ROOM_SOURCES})
  if(ROOM_HOT)
    # Inlined as far as it goes, which what comes out of precompiled headers, made for -O2, is not.
    add_library(${room}_hot OBJECT ${ROOM_HOT})
    frustum_unity(${room}_hot 5 ${ROOM_HOT})
    # Nothing reads errno: roots of several numbers are one instruction then.
    target_compile_options(${room}_hot PRIVATE $<$<CONFIG:Release>:-O3> -fno-math-errno)
    target_include_directories(${room}_hot PRIVATE "${PROJECT_SOURCE_DIR}")
    target_link_libraries(${room}_hot PRIVATE ${ROOM_USES} frustum_flags ${ROOM_PRIVATE_USES})
    target_sources(${room} PRIVATE $<TARGET_OBJECTS:${room}_hot>)
  endif()
  add_library(frustum::${name} ALIAS ${room})
  set_target_properties(${room} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(
    ${room} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:include/frustum>)
  target_compile_features(${room} PUBLIC cxx_std_20)
  target_link_libraries(
    ${room}
    PUBLIC ${ROOM_USES}
    PRIVATE $<BUILD_INTERFACE:frustum_flags> ${ROOM_PRIVATE_USES})
  if(ROOM_COLD)
    frustum_cold(${room})
  endif()
  frustum_precompile(${room} ${ROOM_PRECOMPILED})
  set_property(GLOBAL APPEND PROPERTY FRUSTUM_ROOMS ${name})
endfunction()
