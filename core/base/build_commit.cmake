# Writes OUTPUT, which names the commit of SOURCE, at every build; touched only when it changes, so that
# an unchanged tree compiles and links nothing. "-dirty": something that is built was changed since.
find_package(Git QUIET)
set(commit "unknown")
if(Git_FOUND)
  execute_process(COMMAND ${GIT_EXECUTABLE} describe --always
    WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE described OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  execute_process(COMMAND ${GIT_EXECUTABLE} --no-optional-locks status --porcelain -- CMakeLists.txt core mc analysis
    WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE changes ERROR_QUIET)
  if(described)
    set(commit "${described}")
    if(changes)
      string(APPEND commit "-dirty")
    endif()
  endif()
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#define DRIFT_COMMIT \"${commit}\"\n")
