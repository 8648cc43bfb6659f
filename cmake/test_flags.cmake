# coastmesh_test_flags(TARGET LIBRARY…): compiles the sources of TARGET, a program of tests, with COASTMESH_TEST_FLAGS
# behind all other flags. LIBRARY… are the project's libraries that it links.
#
# Without optimisation, tests compile three times faster. But linkers keep the first copy of an inline function that they
# meet, and with the tests' unoptimised copies the libraries are two to three times slower. Hence the libraries come
# before the tests' objects, whole, as nothing is known yet to be needed of them.
set(COASTMESH_TEST_FLAGS "" CACHE STRING "Flags for the sources of tests, behind all others")
function(coastmesh_test_flags target)
  if(COASTMESH_TEST_FLAGS)
    separate_arguments(flags NATIVE_COMMAND ${COASTMESH_TEST_FLAGS})
    target_compile_options(${target} PRIVATE ${flags})
    list(TRANSFORM ARGN REPLACE "(.+)" "$<TARGET_FILE:\\1>" OUTPUT_VARIABLE files)
    list(JOIN files "," files)
    target_link_options(${target} PRIVATE LINKER:--whole-archive,${files},--no-whole-archive)
  endif()
endfunction()
