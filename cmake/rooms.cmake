# Rooms: a folder of sources is a static library, and tests/<the same path>/*_test.cpp its test program.
# CMake finds the files by itself; CMakeLists.txt says which lower rooms each one uses.
#
# All headers are included as <espalier/room/file.h>. They lie beside their sources, so the build folder holds
# links that lead there, and an installed Espalier has the headers themselves in the same places.
set(ESPALIER_INCLUDE_ROOT ${PROJECT_BINARY_DIR}/include)
file(MAKE_DIRECTORY ${ESPALIER_INCLUDE_ROOT}/espalier)

# espalier_header_links(FOLDERS...): each becomes <espalier/NAME/…>.
function(espalier_header_links)
  foreach(folder IN LISTS ARGN)
    get_filename_component(name ${folder} NAME)
    file(CREATE_LINK ${PROJECT_SOURCE_DIR}/${folder} ${ESPALIER_INCLUDE_ROOT}/espalier/${name} SYMBOLIC)
  endforeach()
endfunction()

# image/masks → espalier_image_masks
function(espalier_room_targets output)
  set(targets "")
  foreach(room IN LISTS ARGN)
    string(REPLACE "/" "_" name ${room})
    list(APPEND targets espalier_${name})
  endforeach()
  set(${output} ${targets} PARENT_SCOPE)
endfunction()

# espalier_room(FOLDER [USES rooms...] [LIBRARIES targets...]): the folder's library, which may include headers
# of the rooms that it uses, and of no other (tests/structure/rooms_test.py compares both lists).
function(espalier_room folder)
  cmake_parse_arguments(PARSE_ARGV 1 room "" "" "USES;LIBRARIES")
  string(REGEX REPLACE "^src/" "" path ${folder})
  espalier_room_targets(target ${path})
  espalier_room_targets(used ${room_USES})
  file(GLOB sources CONFIGURE_DEPENDS ${folder}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "/main\\.cpp$")  # of the program; test programs have one of their own
  espalier_keep_apart(${sources})
  add_library(${target} STATIC ${sources})
  string(REPLACE "/" "_" name ${path})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} FOLDER ${folder})
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${ESPALIER_INCLUDE_ROOT}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:espalier_options> PUBLIC ${used} ${room_LIBRARIES})
  set_property(GLOBAL APPEND PROPERTY ESPALIER_ROOMS ${path})
endfunction()
