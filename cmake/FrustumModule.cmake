# frustum_module(NAME SOURCES a.cpp ... [USES frustum::core ...] [PRIVATE_USES ...])
#
# One room: a static library frustum_NAME with alias frustum::NAME. USES are the arrows of the house;
# PRIVATE_USES are libraries that only the room's .cpp files see.
function(frustum_module name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;USES;PRIVATE_USES" ${ARGN})
  add_library(frustum_${name} STATIC ${ROOM_SOURCES})
  add_library(frustum::${name} ALIAS frustum_${name})
  set_target_properties(frustum_${name} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(
    frustum_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                           $<INSTALL_INTERFACE:include/frustum>)
  target_compile_features(frustum_${name} PUBLIC cxx_std_20)
  target_link_libraries(
    frustum_${name}
    PUBLIC ${ROOM_USES}
    PRIVATE $<BUILD_INTERFACE:frustum_flags> ${ROOM_PRIVATE_USES})
  frustum_precompile(frustum_${name})
  set_property(GLOBAL APPEND PROPERTY FRUSTUM_ROOMS ${name})
endfunction()
