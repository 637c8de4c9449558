# Run with -P: configures, builds and runs tests/consumer against Hedgerow by one ROUTE.
#   ROUTE = package: installs BUILD into a prefix of its own and finds it there
#   ROUTE = folder: adds SOURCE as a subdirectory
# Also wants WORK (an own folder), COMPILER, BUILD_TYPE, INDEX_BITS and GENERATOR.
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    list(JOIN ARGV " " command)
    message(FATAL_ERROR "${command}\nended with ${status}:\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE "${WORK}")
if(ROUTE STREQUAL "package")
  run("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${WORK}/prefix")
  set(route -D "CMAKE_PREFIX_PATH=${WORK}/prefix")
else()
  # Several files as one: the tree has to stand what the consumer sets, and it takes half the time.
  set(route -D "HEDGEROW_FOLDER=${SOURCE}" -D "HEDGEROW_INDEX_BITS=${INDEX_BITS}"
    -D "CMAKE_UNITY_BUILD=ON")
endif()
run("${CMAKE_COMMAND}" -S "${SOURCE}/tests/consumer" -B "${WORK}/build" -G "${GENERATOR}"
  -D "CMAKE_CXX_COMPILER=${COMPILER}" -D "CMAKE_BUILD_TYPE=${BUILD_TYPE}" ${route})
run("${CMAKE_COMMAND}" --build "${WORK}/build" --target consumer)
run("${WORK}/build/consumer")
foreach(program consumer_io consumer_ray)
  if(EXISTS "${WORK}/build/${program}")
    run("${WORK}/build/${program}")
  endif()
endforeach()
