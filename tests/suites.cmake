# Read by CTest: makes each suite of ${program}, the tests of ${room}, one test. The tests of a suite share one process, so
# that what they all need is made once.
if(NOT EXISTS ${program})
    add_test(${room}_is_not_built ${program})
    return()
endif()
execute_process(COMMAND ${program} --gtest_list_tests OUTPUT_VARIABLE listed COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "(^|\n)[^ \n]+\\." suites "${listed}")
# The longest begin first, so that none of them runs alone at the end.
set(longest BothRenderers Cli Documentation FitCli Forms/BrokenFrames Learning Presets/EveryPreset ShardCli SlurmCli
    StudyOfSamples Style)
foreach(suite ${suites})
    string(REGEX REPLACE "^\n|\\.$" "" suite ${suite})
    add_test(${room}/${suite} ${program} --gtest_filter=${suite}.*)
    set_tests_properties(${room}/${suite} PROPERTIES LABELS ${room} TIMEOUT 1200 ENVIRONMENT "${environment}")
    list(FIND longest ${suite} found)
    if(NOT found EQUAL -1)
        set_tests_properties(${room}/${suite} PROPERTIES COST 1000)
    endif()
endforeach()
