# How every target of the house is compiled.

# ccache that also hits from another checkout: paths are taken relative to this one.
find_program(CCACHE ccache)
if(CCACHE)
    set(CMAKE_CXX_COMPILER_LAUNCHER
        ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${CMAKE_SOURCE_DIR} CCACHE_NOHASHDIR=1 ${CCACHE})
endif()

# No contraction into fused multiply-adds and no -march: frames are the same bytes on every machine of the
# architecture. Asserts stay on in release (CONVENTIONS, Errors).
set(CMAKE_CXX_FLAGS_RELEASE "-O2")
set(CMAKE_CXX_FLAGS_DEBUG "-O1 -g1")
# Designated initializers that leave defaults unnamed are our way (CONVENTIONS, Types and functions).
add_compile_options(-Wall -Wextra -Wpedantic -Wno-missing-field-initializers -ffp-contract=off)
if(CHIRONOMIA_SANITIZE)
    add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
    add_link_options(-fsanitize=address,undefined)
endif()

# chironomia_room(NAME SOURCES a.cpp ... [LIBRARIES target ...]): one static library per room or folder of a room.
# LIBRARIES are public when they are ours and private when they are somebody else's.
function(chironomia_room name)
    cmake_parse_arguments(room "" "" "SOURCES;LIBRARIES" ${ARGN})
    add_library(chironomia_${name} STATIC ${room_SOURCES})
    target_include_directories(chironomia_${name} PUBLIC ${CMAKE_SOURCE_DIR})
    foreach(library ${room_LIBRARIES})
        if(library MATCHES "^chironomia_")
            target_link_libraries(chironomia_${name} PUBLIC ${library})
        else()
            target_link_libraries(chironomia_${name} PRIVATE ${library})
        endif()
    endforeach()
endfunction()
