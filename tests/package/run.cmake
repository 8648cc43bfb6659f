# Installs the build into an empty folder, builds the consumer against it there and runs it.
# Called with -DBUILD_DIR -DSOURCE_DIR -DGENERATOR -DCXX -DBUILD_TYPE.
set(work ${BUILD_DIR}/package-test)
file(REMOVE_RECURSE ${work})
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "Failed with ${result}: ${command}")
  endif()
endfunction()
run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${work}/installed)
# Moved after the installation: nothing in it may hold its own place.
file(RENAME ${work}/installed ${work}/moved)
run(${CMAKE_COMMAND} -S ${SOURCE_DIR}/tests/package -B ${work}/consumer -G ${GENERATOR}
  -DCMAKE_CXX_COMPILER=${CXX} -DCMAKE_BUILD_TYPE=${BUILD_TYPE} -DCMAKE_PREFIX_PATH=${work}/moved
  -DLAKE=${SOURCE_DIR}/data/lake_superior.geojson -DDEM=${SOURCE_DIR}/tests/package/depths.asc)
run(${CMAKE_COMMAND} --build ${work}/consumer)
run(${CMAKE_CTEST_COMMAND} --test-dir ${work}/consumer --output-on-failure)
