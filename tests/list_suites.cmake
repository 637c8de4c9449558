# Run with -P: writes LIST, a ctest include file with one entry for each suite of PROGRAM.
execute_process(COMMAND "${PROGRAM}" --gtest_list_tests
  OUTPUT_VARIABLE output RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${PROGRAM} --gtest_list_tests ended with ${status}")
endif()
# Suites are the lines that are not indented: "Suite." or "Prefix/Suite/0.  # TypeParam = int".
string(REGEX MATCHALL "\n[A-Za-z0-9_][A-Za-z0-9_/]*\\." lines "\n${output}")
set(content "")
# Only when the very last lines say that nothing ran but skipped tests; a failure comes after them.
set(all_skipped "PASSED  \\\\] 0 tests\\\\.\n\\\\[  SKIPPED \\\\] [0-9]+ tests?, listed below:\n(\\\\[  SKIPPED \\\\] [^\n]*\n)+$")
foreach(line IN LISTS lines)
  string(REGEX REPLACE "^\n(.*)\\.$" "\\1" suite "${line}")
  string(APPEND content
    "add_test(\"${suite}\" \"${PROGRAM}\" \"--gtest_filter=${suite}.*\")\n"
    "set_tests_properties(\"${suite}\" PROPERTIES\n"
    "  SKIP_REGULAR_EXPRESSION \"${all_skipped}\"\n"
    "  LABELS \"${LABELS}\"\n"
    "  COST ${COST}\n"
    "  TIMEOUT 900)\n")
endforeach()
file(WRITE "${LIST}" "${content}")
