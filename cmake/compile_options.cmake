# Options shared by every target. No -march here: one binary serves all machines, and objects that use
# Eigen must all be built with the same vector flags (docs/architecture.md).
add_library(espalier_options INTERFACE)
# Neither errno nor traps of floating point are looked at: square roots are then one instruction. Same bits.
# Every field of our structs has a default: naming only some of them is the style, not an oversight.
target_compile_options(espalier_options INTERFACE -Wall -Wextra -Wno-missing-field-initializers -ffp-contract=off
                       -fno-math-errno -fno-trapping-math)
if(ESPALIER_WERROR)
  target_compile_options(espalier_options INTERFACE -Werror)
endif()
if(ESPALIER_SANITIZE)
  target_compile_options(espalier_options INTERFACE -fsanitize=${ESPALIER_SANITIZE}
                         -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(espalier_options INTERFACE -fsanitize=${ESPALIER_SANITIZE})
endif()

# For sources in which nothing is hot, tests and what parses the command line: they compile in a third less time, and
# with sanitizers in two fifths of it.
set(ESPALIER_COLD_OPTIONS $<$<CONFIG:Release>:-O1>)
if(ESPALIER_SANITIZE)
  set(ESPALIER_COLD_OPTIONS -O0)
endif()

# All presets but debug compile each room, and each test program, as one file (CMAKE_UNITY_BUILD): two fifths of the
# time. Not part of that are sources with a local name that another file of the room has too, and those that Highway
# compiles once for each instruction set. Where such a build says 'redefinition', give one of the two another name, or
# name its file here.
set(ESPALIER_KEPT_APART
  fitting/record/view_record.cpp
  fitting/starts/start_points.cpp
  src/app/options/record_options.cpp
  src/environment/closed_mesh.cpp
  src/environment/volume_tree.cpp
  src/image/reading/clean.cpp
  src/render/embree/blossom_triangles.cpp
  src/render/embree/leaf_polygons.cpp
  tests/app/commands/space_command_test.cpp
  tests/environment/volume_tree_test.cpp
  tests/experiments/runner/csv_test.cpp
  tests/fitting/optimizers/cma_distribution_test.cpp
  tests/fitting/optimizers/ga_test.cpp
  tests/fitting/run/staged_fit_test.cpp
  tests/overrides/reshape_test.cpp
  tests/weber_penn/branch_overrides_test.cpp
  tests/weber_penn/scalar/helix_test.cpp
  tests/weber_penn/scalar/radius_test.cpp
  tests/weber_penn/scalar/split_test.cpp
  tests/weber_penn/simd/stem_batch_test.cpp)

# espalier_keep_apart(SOURCES...): marks those of them that are not compiled with their room.
function(espalier_keep_apart)
  foreach(source IN LISTS ARGN)
    file(RELATIVE_PATH name ${PROJECT_SOURCE_DIR} ${source})
    file(STRINGS ${source} compiled_often REGEX "include.*hwy/foreach_target\\.h" LIMIT_COUNT 1)
    if(compiled_often OR name IN_LIST ESPALIER_KEPT_APART)
      set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    endif()
  endforeach()
endfunction()
