# Installs the build into an empty prefix; then another project includes every public header, builds every
# example of the API and runs them, with nothing of the source tree in reach of the compiler.
# Run by ctest with -D build, consumer, examples, work, generator, build_type, sanitize, program.
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
file(COPY "${consumer}/" DESTINATION "${work}/consumer")
file(COPY "${examples}/" DESTINATION "${work}/consumer/examples")
run("${CMAKE_COMMAND}" -S "${work}/consumer" -B "${work}/built" -G "${generator}"
    "-DCMAKE_BUILD_TYPE=${build_type}" "-DCMAKE_PREFIX_PATH=${work}/prefix" "-DCMAKE_CXX_FLAGS=${flags}")
run("${CMAKE_COMMAND}" --build "${work}/built")
run("${work}/built/quantity" "10 um")
if(NOT output STREQUAL "0.01 mm\n")
  message(FATAL_ERROR "quantity '10 um' should print 0.01 mm, printed: ${output}")
endif()
run("${work}/built/examples/measure_pin")
if(program)
  # A job written by the installed program names its machine, so that it can be moved.
  run("${work}/prefix/bin/${program}" program cone --machine iwf-bc --out "${work}/written")
  file(READ "${work}/written/job.toml" job)
  if(NOT job MATCHES "machine = \"iwf-bc\"")
    message(FATAL_ERROR "the job should name the shipped machine: ${job}")
  endif()
  file(RENAME "${work}/written" "${work}/moved")
  run("${work}/prefix/bin/${program}" check "${work}/moved/cone.nc" --machine iwf-bc)
endif()
