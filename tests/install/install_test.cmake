# Run by ctest with -D build, consumer, work, generator, build_type, sanitize, program.
cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE complained)
  if(NOT status EQUAL 0)
    string(REPLACE ";" " " command "${ARGV}")
    message(FATAL_ERROR "failed (${status}): ${command}\n${said}\n${complained}")
  endif()
  set(output "${said}" PARENT_SCOPE)
endfunction()

set(flags "")
if(sanitize)
  set(flags "-fsanitize=${sanitize}")
endif()

file(REMOVE_RECURSE "${work}")
run("${CMAKE_COMMAND}" --install "${build}" --prefix "${work}/prefix")
run("${CMAKE_COMMAND}" -S "${consumer}" -B "${work}/consumer" -G "${generator}"
    "-DCMAKE_BUILD_TYPE=${build_type}" "-DCMAKE_PREFIX_PATH=${work}/prefix" "-DCMAKE_CXX_FLAGS=${flags}")
run("${CMAKE_COMMAND}" --build "${work}/consumer")
run("${work}/consumer/quantity" "10 um")
if(NOT output STREQUAL "0.01 mm\n")
  message(FATAL_ERROR "quantity '10 um' should print 0.01 mm, printed: ${output}")
endif()
if(program)
  run("${work}/prefix/bin/${program}" --help)
endif()
