# build/frustum: a link to the program, so that scripts find it without knowing the preset. One preset
# owns the link (FRUSTUM_LINK_PROGRAM, set by `release`); the others leave it alone.
if(FRUSTUM_LINK_PROGRAM AND TARGET frustum)
  set(link_folder "${PROJECT_SOURCE_DIR}/build")
  add_custom_target(
    frustum_link ALL
    COMMAND "${CMAKE_COMMAND}" -E make_directory "${link_folder}"
    COMMAND "${CMAKE_COMMAND}" -E create_symlink
            "$<PATH:RELATIVE_PATH,$<TARGET_FILE:frustum>,${link_folder}>" "${link_folder}/frustum"
    COMMENT "Linking build/frustum"
    VERBATIM)
  add_dependencies(frustum_link frustum)
endif()
