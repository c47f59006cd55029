# Every filter of tests/tiers.cmake selects a test: one that was renamed would slip into tier fast.
include(${TIERS})
set(bad "")
foreach(filter IN LISTS DRIFT_FULL_TESTS DRIFT_NIGHTLY_TESTS)
  execute_process(COMMAND ${TESTS} --gtest_list_tests --gtest_filter=${filter}
                  OUTPUT_VARIABLE selected COMMAND_ERROR_IS_FATAL ANY)
  if(NOT selected MATCHES "\n  ")
    string(APPEND bad "tests/tiers.cmake: no test is called ${filter}\n")
  endif()
endforeach()
if(bad)
  message(FATAL_ERROR "${bad}")
endif()
