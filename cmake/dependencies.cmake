# Every dependency, found here and nowhere else. The Debian packages are listed in packages.txt.
find_package(OpenMP REQUIRED)
find_package(fmt REQUIRED)
find_package(spdlog REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(Eigen3 REQUIRED NO_MODULE)
# Debian's CMake files of OpenImageIO also demand its tools and OpenCV's headers, those of Assimp zlib's
# development files; pkg-config asks for none of them.
find_package(PkgConfig REQUIRED)
find_package(Imath REQUIRED)
pkg_check_modules(OpenImageIO REQUIRED IMPORTED_TARGET OpenImageIO)
pkg_check_modules(assimp REQUIRED IMPORTED_TARGET GLOBAL assimp)
add_library(assimp::assimp ALIAS PkgConfig::assimp)
pkg_check_modules(luajit REQUIRED IMPORTED_TARGET luajit)
find_package(embree 3 REQUIRED)
find_package(HWY REQUIRED)
find_package(Boost 1.74 REQUIRED)  # headers only: Boost.Math, Boost.Geometry
# Two Debian packages share the name NLopt; the C++ build holds every algorithm, AGS too.
set(NLopt_DIR /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/nlopt_cxx CACHE PATH "NLopt built with its C++ algorithms")
find_package(NLopt REQUIRED)

# Optional ones: what is off is named by cmake/summary.cmake.
find_package(GTest QUIET)
find_package(rapidcheck QUIET)
find_package(benchmark QUIET)
