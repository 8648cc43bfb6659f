# Self-tests of the checks, and tests of packages and releases.
add_test(NAME scripts.check-rooms COMMAND ${PROJECT_SOURCE_DIR}/scripts/check-rooms --self-test)
add_test(NAME scripts.check-includes COMMAND ${PROJECT_SOURCE_DIR}/scripts/check-includes --self-test)
add_test(NAME scripts.draw-rooms COMMAND ${PROJECT_SOURCE_DIR}/scripts/draw-rooms --check)
add_test(NAME scripts.check-words COMMAND ${PROJECT_SOURCE_DIR}/scripts/check-words --self-test)
add_test(NAME scripts.check-format COMMAND ${PROJECT_SOURCE_DIR}/scripts/check-format --self-test)
# With sanitizers, compiling a consumer would test nothing new.
if(NOT COASTMESH_SANITIZE)
  add_test(NAME package.consumer COMMAND ${CMAKE_COMMAND}
    -DBUILD_DIR=${PROJECT_BINARY_DIR} -DSOURCE_DIR=${PROJECT_SOURCE_DIR} -DGENERATOR=${CMAKE_GENERATOR}
    -DCXX=${CMAKE_CXX_COMPILER} -DBUILD_TYPE=${CMAKE_BUILD_TYPE}
    -P ${PROJECT_SOURCE_DIR}/tests/package/run.cmake)
  set_tests_properties(package.consumer PROPERTIES TIMEOUT 1200)
endif()
if(NOT COASTMESH_SANITIZE)
  add_test(NAME package.deb COMMAND ${COASTMESH_PYTHON} ${PROJECT_SOURCE_DIR}/tests/package/deb_test.py
    ${PROJECT_BINARY_DIR} ${CMAKE_CPACK_COMMAND})
  # Both install the same build.
  set_tests_properties(package.deb PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 600 RESOURCE_LOCK install)
  set_tests_properties(package.consumer PROPERTIES RESOURCE_LOCK install)
  # Consistency of a release, reports against their schema, recipes and the Debian source package.
  foreach(about release report_schema recipes source)
    add_test(NAME package.${about} COMMAND ${COASTMESH_PYTHON} ${PROJECT_SOURCE_DIR}/tests/package/${about}_test.py
      $<TARGET_FILE:coastmesh>)
    set_tests_properties(package.${about} PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 1200)
  endforeach()
endif()
