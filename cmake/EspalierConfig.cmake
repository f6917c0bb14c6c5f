# find_package(Espalier 0.2 REQUIRED) gives the target espalier::espalier (models, renderers, fits) and one a room,
# such as espalier::core; everything here moves with the installed folder.
include(${CMAKE_CURRENT_LIST_DIR}/EspalierDependencies.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/EspalierTargets.cmake)
# What a program that is not installed beside Espalier may be told by the environment variable ESPALIER_DATA_DIR.
get_filename_component(Espalier_DATA_DIR ${CMAKE_CURRENT_LIST_DIR}/../../../share/espalier ABSOLUTE)
