# The pages of all headers: ninja docs leaves them as HTML in the build folder. A warning fails the target;
# that something has no comment is none.
find_package(Doxygen QUIET)
if(NOT DOXYGEN_FOUND)
  return()
endif()

set(DOXYGEN_PROJECT_NAME Espalier)
set(DOXYGEN_PROJECT_BRIEF "Inverse modelling of trees")
set(DOXYGEN_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/docs)
set(DOXYGEN_USE_MDFILE_AS_MAINPAGE docs/architecture.md)
set(DOXYGEN_FILE_PATTERNS *.h *.md)
set(DOXYGEN_EXCLUDE_PATTERNS *-inl.h */src/app/* */experiments/*.md)
set(DOXYGEN_FULL_PATH_NAMES YES)
set(DOXYGEN_STRIP_FROM_PATH ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR})
set(DOXYGEN_JAVADOC_AUTOBRIEF YES)  # the first sentence stands in the lists
set(DOXYGEN_EXTRACT_ALL YES)
set(DOXYGEN_HIDE_SCOPE_NAMES YES)
set(DOXYGEN_SORT_MEMBER_DOCS NO)
set(DOXYGEN_SHOW_INCLUDE_FILES NO)
set(DOXYGEN_HAVE_DOT NO)
set(DOXYGEN_QUIET YES)
set(DOXYGEN_WARN_AS_ERROR FAIL_ON_WARNINGS)
set(DOXYGEN_FILTER_PATTERNS "*.h=sed -f ${PROJECT_SOURCE_DIR}/docs/doxygen/header.sed"
                            "*.md=sed -f ${PROJECT_SOURCE_DIR}/docs/doxygen/page.sed")
doxygen_add_docs(docs src fitting experiments docs COMMENT "Pages of all headers: ${PROJECT_BINARY_DIR}/docs/html")
