# Every third-party library, found in one place. All come from Debian 12 or 13 (cmake/packages.txt).
find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)

find_package(glm CONFIG REQUIRED)
find_package(nlohmann_json CONFIG REQUIRED)
if(nlohmann_json_VERSION VERSION_GREATER 3.11.2)
    # With operator<=> g++ 13 and later find no comparison of a text on the left with a value on the right. Here, since
    # core/files/json.h comes too late where headers are precompiled.
    set_property(TARGET nlohmann_json::nlohmann_json APPEND PROPERTY INTERFACE_COMPILE_DEFINITIONS
        JSON_HAS_THREE_WAY_COMPARISON=0)
endif()
find_package(fmt CONFIG REQUIRED)
find_package(OpenSSL 3 REQUIRED COMPONENTS Crypto)

find_package(TinyGLTF CONFIG REQUIRED)
# Both its libraries hold a tinygltf of their own, of another layout: link the shared one, and always behind ours.
find_package(draco CONFIG REQUIRED)
find_package(meshoptimizer CONFIG REQUIRED)
pkg_check_modules(WEBP REQUIRED IMPORTED_TARGET libwebp)
find_package(HDF5 REQUIRED COMPONENTS C)
find_package(ZLIB REQUIRED)
pkg_check_modules(ZIP REQUIRED IMPORTED_TARGET libzip)

find_package(OpenGL REQUIRED COMPONENTS EGL)
find_package(TBB CONFIG REQUIRED)  # Embree's own
find_package(embree CONFIG REQUIRED)  # 3.13 or 4; what differs is in raster/embree/embree.h
pkg_check_modules(HWY REQUIRED IMPORTED_TARGET libhwy)
pkg_check_modules(ESPEAK REQUIRED IMPORTED_TARGET espeak-ng)
find_package(pugixml CONFIG REQUIRED)
pkg_check_modules(MD4C REQUIRED IMPORTED_TARGET md4c)
find_package(Eigen3 3.4 CONFIG REQUIRED)  # headers alone: its Fourier transform, its decompositions of matrices
pkg_check_modules(UTF8PROC REQUIRED IMPORTED_TARGET libutf8proc)
pkg_check_modules(EBUR128 REQUIRED IMPORTED_TARGET libebur128)
pkg_check_modules(FFMPEG REQUIRED IMPORTED_TARGET libavformat libavcodec libavutil libswscale libswresample)

find_package(OpenImageIO 2.4 CONFIG REQUIRED)
# Debian's exported target names the folder of OpenCV's headers, which no package of ours installs.
set_target_properties(OpenImageIO::OpenImageIO PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${OpenImageIO_INCLUDE_DIR}")

if(CHIRONOMIA_LEARNING)
    find_package(Torch 1.13 REQUIRED)
    # Its flag repeats g++'s default, and would keep precompiled headers from being used.
    set_target_properties(torch PROPERTIES INTERFACE_COMPILE_OPTIONS "")
    # Debian's default BLAS is the reference, 30 times slower in training than libopenblas0-pthread.
    file(REAL_PATH /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/libblas.so.3 CHIRONOMIA_BLAS)
    if(NOT CHIRONOMIA_BLAS MATCHES "openblas")
        message(WARNING "BLAS is ${CHIRONOMIA_BLAS}: training is slow; install libopenblas0-pthread")
    endif()
endif()

find_package(Freetype REQUIRED)

find_package(CLI11 CONFIG REQUIRED)
find_package(Boost 1.74 CONFIG REQUIRED)  # headers alone, of Boost.Math

pkg_check_modules(HTTPLIB REQUIRED IMPORTED_TARGET cpp-httplib)
find_package(SQLite3 REQUIRED)

find_package(GTest CONFIG REQUIRED)
find_package(benchmark CONFIG REQUIRED)
