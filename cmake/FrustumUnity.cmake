# Several sources of one folder are compiled together, so that the headers they share are read once.
# FRUSTUM_UNITY=OFF compiles each by itself: clang-tidy wants that (preset `files`), and who works on one file.
option(FRUSTUM_UNITY "Compile several sources of a folder together" ON)

# Sources that are compiled together share their nameless namespaces: two helpers of one folder have two names.
# frustum_unity(TARGET SIZE source ...): at most SIZE sources of a folder, in the order of the list.
function(frustum_unity target size)
  if(NOT FRUSTUM_UNITY)
    return()
  endif()
  foreach(source IN LISTS ARGN)
    get_filename_component(folder "${source}" DIRECTORY)
    string(MAKE_C_IDENTIFIER "group_${folder}" group)
    list(APPEND groups ${group})
    list(APPEND ${group} "${source}")
  endforeach()
  list(REMOVE_DUPLICATES groups)
  foreach(group IN LISTS groups)
    set(index 0)
    foreach(source IN LISTS ${group})
      math(EXPR batch "${index} / ${size}")
      set_property(SOURCE "${source}" PROPERTY UNITY_GROUP "${group}_${batch}")
      math(EXPR index "${index} + 1")
    endforeach()
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()
