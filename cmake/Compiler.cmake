# How every target of the house is compiled.

# ccache that also hits from another checkout: paths are taken relative to this one. The sloppiness is what it asks for
# where headers are precompiled.
find_program(CCACHE ccache)
if(CCACHE)
    set(CMAKE_CXX_COMPILER_LAUNCHER
        ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${CMAKE_SOURCE_DIR} CCACHE_NOHASHDIR=1
        CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime ${CCACHE})
endif()

# What every target is compiled with. No contraction into fused multiply-adds and no -march: frames are the same bytes on
# every machine of the architecture. Asserts stay on in release (CONVENTIONS, Errors). Designated initializers that leave
# defaults unnamed are our way (CONVENTIONS, Types and functions). g++ collects its garbage often by default; not
# doing so saves one second of compiling in six, and takes at most 200 MB more.
set(CHIRONOMIA_COMMON_OPTIONS -Wall -Wextra -Wpedantic -Wno-missing-field-initializers -ffp-contract=off)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    list(APPEND CHIRONOMIA_COMMON_OPTIONS --param=ggc-min-heapsize=1048576)
    if(CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 13)
        # It takes a key that is made for a look-up for the owner of what is found.
        list(APPEND CHIRONOMIA_COMMON_OPTIONS -Wno-dangling-reference)
    endif()
endif()
# Optimisation is not in CMAKE_CXX_FLAGS_*, so that tests can be compiled alike in both presets (tests/CMakeLists.txt).
set(CMAKE_CXX_FLAGS_RELEASE "")
set(CMAKE_CXX_FLAGS_DEBUG "")
add_compile_options(${CHIRONOMIA_COMMON_OPTIONS})
if(CHIRONOMIA_FUZZ)
    # Compiled by clang alone, to look for faults; warnings are what g++ gives. Coverage is counted in our own code.
    add_compile_options(-w -O1 -g1 -fsanitize=address,undefined,fuzzer-no-link -fno-sanitize-recover=undefined
        -fno-omit-frame-pointer)
    add_link_options(-fsanitize=address,undefined)
elseif(CHIRONOMIA_SANITIZE)
    add_compile_options(-O1 -g1 -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
    # At fixed addresses: the sanitizers' tables are 80 MB of pointers, and to move them takes a third of each start.
    add_link_options(-fsanitize=address,undefined -no-pie)
else()
    add_compile_options(-O2)
endif()

# Headers that most files include, precompiled once for all rooms and once for all tests: a quarter of a compile. The
# angle brackets keep the path of this checkout out of what the compiler cache compares.
set(CHIRONOMIA_PRECOMPILED_HEADERS
    <algorithm> <array> <cmath> <filesystem> <functional> <map> <optional> <set> <span> <string> <vector>
    <fmt/format.h> <glm/glm.hpp> <glm/gtc/quaternion.hpp> <glm/gtc/type_ptr.hpp> <nlohmann/json.hpp>)

# chironomia_precompile(TARGET HEADERS <a> ... LIBRARIES target ...): compiles headers for the targets that reuse those of
# TARGET, which must define what the libraries define.
function(chironomia_precompile target)
    cmake_parse_arguments(precompiled "" "" "HEADERS;LIBRARIES" ${ARGN})
    file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/${target}.cpp "")
    add_library(${target} OBJECT ${CMAKE_CURRENT_BINARY_DIR}/${target}.cpp)
    target_link_libraries(${target} PRIVATE glm::glm nlohmann_json::nlohmann_json fmt::fmt ${precompiled_LIBRARIES})
    target_precompile_headers(${target} PRIVATE ${CHIRONOMIA_PRECOMPILED_HEADERS} ${precompiled_HEADERS})
endfunction()

# chironomia_room(NAME SOURCES a.cpp ... [ALONE b.cpp ...] [LIBRARIES target ...]): one static library per room or folder
# of a room. LIBRARIES are public when they are ours and private when they are somebody else's. Up to sixteen SOURCES of one
# folder are compiled at once: reading headers is most of a compile, and is done once for all of them. So names that are
# private to a file must be the only ones in its folder. ALONE are files with options of their own. CMake's unity builds
# name files by absolute paths, which the compiler cache would not find again from another checkout.
function(chironomia_room name)
    cmake_parse_arguments(room "" "" "SOURCES;ALONE;LIBRARIES" ${ARGN})
    file(RELATIVE_PATH room_folder ${CMAKE_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
    set(unit 0)
    set(files 0)
    set(last "")
    set(includes "")
    set(units "")
    foreach(source ${room_SOURCES} end)
        get_filename_component(folder ${source} DIRECTORY)
        if(files GREATER 0 AND (source STREQUAL end OR files EQUAL 16 OR NOT folder STREQUAL last))
            set(file ${CMAKE_CURRENT_BINARY_DIR}/${name}_${unit}.cpp)
            file(CONFIGURE OUTPUT ${file} CONTENT "${includes}" @ONLY)
            list(APPEND units ${file})
            math(EXPR unit "${unit} + 1")
            set(files 0)
            set(includes "")
        endif()
        math(EXPR files "${files} + 1")
        set(last ${folder})
        string(APPEND includes "#include \"${room_folder}/${source}\"\n")
    endforeach()
    add_library(chironomia_${name} STATIC ${units} ${room_ALONE})
    target_include_directories(chironomia_${name} PUBLIC ${CMAKE_SOURCE_DIR})
    target_precompile_headers(chironomia_${name} REUSE_FROM chironomia_precompiled)
    # It takes a file that is compiled with others for a header, whose types everybody may see.
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        target_compile_options(chironomia_${name} PRIVATE -Wno-subobject-linkage)
    endif()
    foreach(library ${room_LIBRARIES})
        if(library MATCHES "^chironomia_")
            target_link_libraries(chironomia_${name} PUBLIC ${library})
        else()
            target_link_libraries(chironomia_${name} PRIVATE ${library})
        endif()
    endforeach()
endfunction()
