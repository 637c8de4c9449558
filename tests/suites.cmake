# hedgerow_add_suites(TARGET [COST cost] [LABELS label...]): one ctest entry for each suite of a
# GoogleTest executable, found by asking the executable after it is built. One process per suite
# instead of one per test keeps a run of thousands of tests quick; a suite whose tests were all
# skipped is reported as skipped. The suites of a higher cost start first.
function(hedgerow_add_suites target)
  cmake_parse_arguments(PARSE_ARGV 1 option "" "COST" LABELS)
  if(NOT option_COST)
    set(option_COST 0)
  endif()
  set(list "${CMAKE_CURRENT_BINARY_DIR}/${target}_suites.cmake")
  add_custom_command(TARGET ${target} POST_BUILD
    COMMAND ${CMAKE_COMMAND} -D "PROGRAM=$<TARGET_FILE:${target}>" -D "LIST=${list}"
            -D "LABELS=${option_LABELS}" -D "COST=${option_COST}"
            -P "${CMAKE_CURRENT_FUNCTION_LIST_DIR}/list_suites.cmake"
    BYPRODUCTS "${list}"
    VERBATIM)
  set(include "${CMAKE_CURRENT_BINARY_DIR}/${target}_include.cmake")
  file(WRITE "${include}"
    "if(EXISTS \"${list}\")\n"
    "  include(\"${list}\")\n"
    "else()\n"
    "  add_test(${target}_is_not_built ${target}_is_not_built)\n"
    "endif()\n")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES "${include}")
endfunction()
