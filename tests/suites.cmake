# Read by CTest: makes each suite of ${program}, the tests of ${room}, one test. The tests of a suite share one process, so
# that what they all need is made once.
if(NOT EXISTS ${program})
    add_test(${room}_is_not_built ${program})
    return()
endif()
execute_process(COMMAND ${program} --gtest_list_tests OUTPUT_VARIABLE listed COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "(^|\n)[^ \n]+\\." suites "${listed}")
foreach(suite ${suites})
    string(REGEX REPLACE "^\n|\\.$" "" suite ${suite})
    add_test(${room}/${suite} ${program} --gtest_filter=${suite}.*)
    set_tests_properties(${room}/${suite} PROPERTIES LABELS ${room} TIMEOUT 1200 ENVIRONMENT "${environment}")
    # The longest begin first, so that none of them runs alone at the end.
    if(suite MATCHES "^(Documentation|Learning|Forms/BrokenFrames|StudyOfSamples|Cli|ShardCli|BothRenderers|Style|FitCli)$")
        set_tests_properties(${room}/${suite} PROPERTIES COST 1000)
    endif()
endforeach()
