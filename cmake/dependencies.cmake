# Every dependency is found here: those of the library, which its users need too, and those of the build alone.
include(cmake/library_dependencies.cmake)

find_package(spdlog REQUIRED)
find_package(CLI11 REQUIRED)
find_package(Boost 1.74 REQUIRED)  # headers only: Boost.Math, Boost.Geometry

# Optional ones: what is off is named by cmake/summary.cmake.
find_package(GTest QUIET)
find_package(rapidcheck QUIET)
find_package(benchmark QUIET)
