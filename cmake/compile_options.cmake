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

# The presets of the sanitizers compile each room as one file (CMAKE_UNITY_BUILD), which takes a third of the time.
# espalier_keep_apart(SOURCES...): not those that Highway compiles once for each instruction set.
function(espalier_keep_apart)
  foreach(source IN LISTS ARGN)
    file(STRINGS ${source} compiled_often REGEX "include.*hwy/foreach_target\\.h" LIMIT_COUNT 1)
    if(compiled_often)
      set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    endif()
  endforeach()
endfunction()
