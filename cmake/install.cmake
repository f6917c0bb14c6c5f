# What `cmake --install` leaves in a prefix, which may be moved afterwards:
#   bin/espalier                 the program
#   include/espalier/…           the headers of all rooms but the program's own, and espalier.h, which includes most
#   lib/libespalier_*.a          a library a room
#   lib/espalier                 the module of the program that reads and writes pictures
#   lib/cmake/Espalier           for find_package(Espalier): espalier::espalier, and one target a room
#   share/espalier               what the program reads while it runs (src/core/data_path.h), laid out as in the source
include(CMakePackageConfigHelpers)

get_property(installed_rooms GLOBAL PROPERTY ESPALIER_ROOMS)
list(FILTER installed_rooms EXCLUDE REGEX "^app(/|$)")
set(library_rooms ${installed_rooms})
list(FILTER library_rooms EXCLUDE REGEX "^experiments/")  # there for who links them by name

# espalier_install_room(ROOM): its library and its headers. Files *-inl.h are parts of sources, not headers.
function(espalier_install_room room)
  espalier_room_targets(target ${room})
  get_target_property(folder ${target} FOLDER)
  file(GLOB headers CONFIGURE_DEPENDS ${folder}/*.h)
  list(FILTER headers EXCLUDE REGEX "-inl\\.h$")
  target_compile_features(${target} PUBLIC cxx_std_20)
  install(TARGETS ${target} EXPORT EspalierTargets)
  install(FILES ${headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/espalier/${room})
endfunction()

foreach(room IN LISTS installed_rooms)
  espalier_install_room(${room})
endforeach()
add_library(espalier_library INTERFACE)
add_library(espalier::espalier ALIAS espalier_library)
set_target_properties(espalier_library PROPERTIES EXPORT_NAME espalier)
espalier_room_targets(libraries ${library_rooms})
target_link_libraries(espalier_library INTERFACE ${libraries})
target_link_options(espalier_library INTERFACE LINKER:-u,espalier_openimageio_codecs)  # not from a module
install(TARGETS espalier_library EXPORT EspalierTargets)
install(FILES src/espalier.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/espalier)

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/Espalier)
install(EXPORT EspalierTargets NAMESPACE espalier:: DESTINATION ${package})
install(FILES cmake/EspalierConfig.cmake DESTINATION ${package})
install(FILES cmake/library_dependencies.cmake DESTINATION ${package} RENAME EspalierDependencies.cmake)
# Before 1.0, a minor version may break who was built for the one before.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/generated/EspalierConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/generated/EspalierConfigVersion.cmake DESTINATION ${package})

set(data ${CMAKE_INSTALL_DATADIR}/espalier)
install(TARGETS espalier_program)
install(DIRECTORY targets DESTINATION ${data})
install(DIRECTORY src/lsystem/models DESTINATION ${data}/lsystem)
file(GLOB experiments CONFIGURE_DEPENDS experiments/*.toml)
install(FILES ${experiments} DESTINATION ${data}/experiments)
install(DIRECTORY experiments/report experiments/volumes experiments/presets DESTINATION ${data}/experiments
        PATTERN __pycache__ EXCLUDE)
install(FILES README.md CHANGELOG.md CITATION.cff LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

# A build folder has its data in the same places, so that an Espalier installed elsewhere is never asked for it.
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/share/espalier)
foreach(folder targets experiments src/lsystem)
  get_filename_component(name ${folder} NAME)
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/${folder} ${PROJECT_BINARY_DIR}/share/espalier/${name} SYMBOLIC)
endforeach()
