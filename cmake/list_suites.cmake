# Writes a file for ctest with one test for each suite of a GoogleTest program. One for each TEST would start
# the program, which loads some 250 libraries, two thousand times.
#   cmake -DPROGRAM=… -DPREFIX=… -DOUTPUT=… -P list_suites.cmake
execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE listing COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "\n[^ \n][^\n]*\\.(\n|  #)" suites "${listing}")
if(NOT suites)
  message(FATAL_ERROR "${PROGRAM} lists no tests")
endif()
set(tests "")
foreach(suite IN LISTS suites)
  string(REGEX REPLACE "[\n]|  #" "" suite "${suite}")
  # The same properties in every run; another seed explores others. Threads that wait for others sleep: spinning, they
  # take the processor from the tests beside them.
  string(APPEND tests
    "add_test([==[${PREFIX}.${suite}]==] [==[${PROGRAM}]==] [==[--gtest_filter=${suite}*]==])\n"
    "set_tests_properties([==[${PREFIX}.${suite}]==] PROPERTIES TIMEOUT 900 "
    "ENVIRONMENT [==[RC_PARAMS=seed=1;OMP_WAIT_POLICY=passive]==] "
    "SKIP_REGULAR_EXPRESSION [==[\\[  PASSED  \\] 0 tests]==])\n")
endforeach()
string(REPLACE ".]==]" "]==]" tests "${tests}")
file(WRITE ${OUTPUT} "${tests}")
