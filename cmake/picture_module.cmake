# OpenImageIO and the 250 libraries that it brings, as a module that Espalier's programs load with the first picture
# file (src/image/codecs/codecs.h). Programs of others link the room image/openimageio instead (cmake/install.cmake).
function(espalier_picture_module)
  set(folder ${CMAKE_INSTALL_LIBDIR}/espalier)
  set_target_properties(espalier_image_openimageio PROPERTIES POSITION_INDEPENDENT_CODE ON)
  add_library(espalier_openimageio MODULE $<TARGET_OBJECTS:espalier_image_openimageio>)
  target_link_libraries(espalier_openimageio PRIVATE espalier_options PkgConfig::OpenImageIO Imath::Imath)
  set_target_properties(espalier_openimageio PROPERTIES PREFIX "" LINKER_LANGUAGE CXX
                        LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/${folder})
  install(TARGETS espalier_openimageio DESTINATION ${folder})
  target_compile_definitions(espalier_image_codecs PRIVATE
    ESPALIER_MODULE_FOLDER="${folder}"
    ESPALIER_INSTALLED_MODULE_FOLDER="${CMAKE_INSTALL_FULL_LIBDIR}/espalier"
    ESPALIER_BUILT_MODULE_FOLDER="${PROJECT_BINARY_DIR}/${folder}")
endfunction()
