# The API reference, if Doxygen is installed: cmake --build build/release --target reference. Any warning is an error.
find_program(COASTMESH_DOXYGEN NAMES doxygen)
if(NOT COASTMESH_DOXYGEN OR NOT COASTMESH_PYTHON)
  message(STATUS "No API reference: it needs doxygen and python3")
  if(COASTMESH_TESTS)
    # ctest then lists the test as skipped.
    add_test(NAME reference.doxygen COMMAND ${CMAKE_COMMAND} -E echo "skipped: there is no Doxygen")
    set_tests_properties(reference.doxygen PROPERTIES LABELS reference SKIP_REGULAR_EXPRESSION "^skipped")
  endif()
  return()
endif()
set(reference_dir ${PROJECT_BINARY_DIR}/reference)
set(reference_files ${installed_headers})
list(TRANSFORM reference_files APPEND "\"")
list(TRANSFORM reference_files PREPEND "\"${PROJECT_SOURCE_DIR}/")
list(APPEND reference_files "\"${PROJECT_SOURCE_DIR}/docs/reference.md\"")
list(JOIN reference_files " " reference_input)
configure_file(${PROJECT_SOURCE_DIR}/docs/Doxyfile.in ${PROJECT_BINARY_DIR}/Doxyfile @ONLY)
add_custom_target(reference
  COMMAND ${CMAKE_COMMAND} -E rm -rf ${reference_dir}
  COMMAND ${CMAKE_COMMAND} -E make_directory ${reference_dir}
  COMMAND ${COASTMESH_DOXYGEN} ${PROJECT_BINARY_DIR}/Doxyfile
  COMMENT "API reference ${reference_dir}/html/index.html" VERBATIM)
if(COASTMESH_TESTS AND NOT COASTMESH_SANITIZE)
  add_test(NAME reference.doxygen COMMAND ${CMAKE_COMMAND} --build ${PROJECT_BINARY_DIR} --target reference)
  # As python.wheel does, it runs Ninja in the build folder, which must be one process at a time.
  set_tests_properties(reference.doxygen PROPERTIES LABELS reference TIMEOUT 600 RESOURCE_LOCK build)
endif()
