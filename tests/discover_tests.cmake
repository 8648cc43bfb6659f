# coastmesh_discover_tests(TARGET [PROPERTIES NAME VALUE…]): makes tests of ctest of what a GoogleTest program holds.
#
# Each suite is a process of its own: starting one loads GDAL, which takes longer than most tests do. With sanitizers
# several suites share a process. The output of a suite that fails names the test.
function(coastmesh_discover_tests target)
  cmake_parse_arguments(discover "" "" PROPERTIES ${ARGN})
  set(suites ${CMAKE_CURRENT_BINARY_DIR}/${target}_suites.cmake)
  set(script ${PROJECT_SOURCE_DIR}/tests/list_suites.cmake)
  set_property(TARGET ${target} APPEND PROPERTY LINK_DEPENDS ${script})
  add_custom_command(TARGET ${target} POST_BUILD
    COMMAND ${CMAKE_COMMAND} -DPROGRAM=$<TARGET_FILE:${target}> -DOUT=${suites} "-DPROPERTIES=${discover_PROPERTIES}"
      "-DGROUP=${COASTMESH_SANITIZE}" -P ${script}
    BYPRODUCTS ${suites} VERBATIM)
  # A program that was not built fails.
  set(included ${CMAKE_CURRENT_BINARY_DIR}/${target}_include.cmake)
  set(labelled)
  if(discover_PROPERTIES)
    list(JOIN discover_PROPERTIES " " properties)
    set(labelled "  set_tests_properties(${target}_NOT_BUILT PROPERTIES ${properties})\n")
  endif()
  file(WRITE ${included}
    "if(EXISTS [=[${suites}]=])\n  include([=[${suites}]=])\nelse()\n  add_test(${target}_NOT_BUILT ${target}_NOT_BUILT)\n${labelled}endif()\n")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${included})
endfunction()
