# What the library needs, for who builds it and who uses it: an installed Espalier has this file beside its
# EspalierConfig.cmake. The Debian packages are listed in packages.txt.
find_package(OpenMP REQUIRED COMPONENTS CXX)
find_package(fmt REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(Eigen3 REQUIRED NO_MODULE)
# Debian's CMake files of OpenImageIO also demand its tools and OpenCV's headers, those of Assimp zlib's
# development files; pkg-config asks for none of them.
find_package(PkgConfig REQUIRED)
find_package(Imath REQUIRED)
pkg_check_modules(OpenImageIO REQUIRED IMPORTED_TARGET OpenImageIO)
pkg_check_modules(assimp REQUIRED IMPORTED_TARGET GLOBAL assimp)
if(NOT TARGET assimp::assimp)
  add_library(assimp::assimp ALIAS PkgConfig::assimp)
endif()
pkg_check_modules(sleef REQUIRED IMPORTED_TARGET sleef)
pkg_check_modules(libseccomp REQUIRED IMPORTED_TARGET libseccomp)
pkg_check_modules(luajit REQUIRED IMPORTED_TARGET luajit)
find_package(embree 3 REQUIRED)
find_package(HWY REQUIRED)
# Two Debian packages share the name NLopt; the C++ build holds every algorithm, AGS too.
set(NLopt_DIR /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/nlopt_cxx CACHE PATH "NLopt built with its C++ algorithms")
find_package(NLopt REQUIRED)
