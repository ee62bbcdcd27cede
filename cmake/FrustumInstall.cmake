# cmake --install: one static library and one header folder a room, the program, the machine
# definitions, and what find_package(Frustum) reads. tests/install holds it to that.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(FRUSTUM_INSTALL_CMAKE "${CMAKE_INSTALL_LIBDIR}/cmake/Frustum")
set(FRUSTUM_INSTALL_MACHINES "${CMAKE_INSTALL_DATADIR}/frustum/machines")

get_property(rooms GLOBAL PROPERTY FRUSTUM_ROOMS)
list(TRANSFORM rooms PREPEND "frustum::" OUTPUT_VARIABLE FRUSTUM_LIBRARIES)
foreach(room IN LISTS rooms)
  install(TARGETS frustum_${room} EXPORT FrustumTargets ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
endforeach()
foreach(folder IN LISTS FRUSTUM_FOLDERS)
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/${folder}" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/frustum"
          FILES_MATCHING PATTERN "*.hpp" PATTERN "node_modules" EXCLUDE)
endforeach()
if(TARGET frustum)
  install(TARGETS frustum RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
  # Written by the program itself, so that they are those of its commands.
  set(reference "${CMAKE_BINARY_DIR}/reference")
  add_custom_command(
    OUTPUT "${reference}/written"
    COMMAND "${CMAKE_COMMAND}" -E rm -rf "${reference}"
    COMMAND frustum reference --man "${reference}/man1" --completion "${reference}/completion"
    COMMAND "${CMAKE_COMMAND}" -E touch "${reference}/written"
    DEPENDS frustum
    COMMENT "Writing man pages and completion"
    VERBATIM)
  add_custom_target(frustum_reference ALL DEPENDS "${reference}/written")
  install(DIRECTORY "${reference}/man1" DESTINATION "${CMAKE_INSTALL_MANDIR}")
  install(FILES "${reference}/completion/frustum"
          DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions")
  install(FILES "${reference}/completion/_frustum"
          DESTINATION "${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions")
endif()
if(TARGET frustum_mpi) # what the program loads when mpirun has started it
  install(TARGETS frustum_mpi LIBRARY DESTINATION lib/frustum)
endif()
install(DIRECTORY "${PROJECT_SOURCE_DIR}/machines/" DESTINATION "${FRUSTUM_INSTALL_MACHINES}")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/schemas/" DESTINATION "${CMAKE_INSTALL_DATADIR}/frustum/schemas"
        FILES_MATCHING PATTERN "*.json" PATTERN "source" EXCLUDE)
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" "${PROJECT_SOURCE_DIR}/NOTICE"
        DESTINATION "${CMAKE_INSTALL_DOCDIR}")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/docs/" DESTINATION "${CMAKE_INSTALL_DOCDIR}"
        FILES_MATCHING PATTERN "*.md" PATTERN "*.svg" PATTERN "*.png")

install(DIRECTORY "${PROJECT_SOURCE_DIR}/examples" DESTINATION "${CMAKE_INSTALL_DOCDIR}")

install(EXPORT FrustumTargets NAMESPACE frustum:: DESTINATION "${FRUSTUM_INSTALL_CMAKE}")
configure_package_config_file(
  "${PROJECT_SOURCE_DIR}/cmake/FrustumConfig.cmake.in" "${PROJECT_BINARY_DIR}/FrustumConfig.cmake"
  INSTALL_DESTINATION "${FRUSTUM_INSTALL_CMAKE}"
  PATH_VARS FRUSTUM_INSTALL_MACHINES)
# Before 1.0 a minor release may change the interface.
write_basic_package_version_file("${PROJECT_BINARY_DIR}/FrustumConfigVersion.cmake"
                                 COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/FrustumConfig.cmake"
              "${PROJECT_BINARY_DIR}/FrustumConfigVersion.cmake"
        DESTINATION "${FRUSTUM_INSTALL_CMAKE}")
