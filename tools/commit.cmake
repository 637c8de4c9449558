# Writes OUTPUT, a header with the commit of SOURCE_DIR; run at every build, rewrites only on change.
set(commit "unknown")
find_package(Git QUIET)
if(Git_FOUND)
  execute_process(COMMAND ${GIT_EXECUTABLE} -C ${SOURCE_DIR} rev-parse --short=12 HEAD
                  OUTPUT_VARIABLE hash OUTPUT_STRIP_TRAILING_WHITESPACE
                  RESULT_VARIABLE status ERROR_QUIET)
  if(status EQUAL 0)
    set(commit ${hash})
    execute_process(COMMAND ${GIT_EXECUTABLE} -C ${SOURCE_DIR} diff --quiet HEAD --
                    RESULT_VARIABLE differs ERROR_QUIET)
    if(NOT differs EQUAL 0)
      string(APPEND commit "-changed")
    endif()
  endif()
endif()
set(text "#pragma once\n\nnamespace hedgerow::tool {\n
inline constexpr const char* kCommit = \"${commit}\";\n\n}  // namespace hedgerow::tool\n")
set(old "")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} old)
endif()
if(NOT old STREQUAL text)
  file(WRITE ${OUTPUT} "${text}")
endif()
