# Installs the program, a static library and the headers of each part, and the package for find_package(coastmesh). Each
# part is an export of its own, so that users of core alone need no GDAL.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# The public headers of each part. The headers that they include are installed too; all others are internal.
set(core_headers core/triangulate/delaunay core/quality core/refine/check core/refine/refine)
set(gis_headers gis/clean/clean gis/coast/frame gis/format/grid_io gis/format/poly_io gis/read/read_coastline)
set(parallel_headers parallel/mesh_regions parallel/workers)
set(job_headers apps/job/mesh_job)

set(coastmesh_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/coastmesh)
foreach(part core gis parallel job)
  set_target_properties(coastmesh_${part} PROPERTIES EXPORT_NAME ${part})
  target_compile_features(coastmesh_${part} PUBLIC cxx_std_20)
  install(TARGETS coastmesh_${part} EXPORT coastmesh-${part}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
    INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/coastmesh)
  list(TRANSFORM ${part}_headers APPEND .hpp)
  list(APPEND due_headers ${${part}_headers})
endforeach()
set(known_headers ${due_headers})
while(due_headers)
  list(POP_FRONT due_headers header)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${header})
  cmake_path(GET header PARENT_PATH folder)
  install(FILES ${PROJECT_SOURCE_DIR}/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/coastmesh/${folder})
  file(STRINGS ${PROJECT_SOURCE_DIR}/${header} includes REGEX "^#include \"")
  foreach(line ${includes})
    string(REGEX REPLACE "^#include \"(.*)\".*" "\\1" included "${line}")
    if(NOT included IN_LIST known_headers)
      list(APPEND known_headers ${included})
      list(APPEND due_headers ${included})
    endif()
  endforeach()
endwhile()
# reference.cmake documents these headers.
set(installed_headers ${known_headers})
list(SORT installed_headers)
install(TARGETS coastmesh EXPORT coastmesh-program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
foreach(part core gis parallel job program)
  install(EXPORT coastmesh-${part} NAMESPACE coastmesh:: DESTINATION ${coastmesh_package_dir})
endforeach()

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/coastmeshConfig.cmake.in
  ${PROJECT_BINARY_DIR}/coastmeshConfig.cmake INSTALL_DESTINATION ${coastmesh_package_dir})
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/coastmeshConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/coastmeshConfig.cmake ${PROJECT_BINARY_DIR}/coastmeshConfigVersion.cmake
  DESTINATION ${coastmesh_package_dir})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/debian/copyright
  ${PROJECT_SOURCE_DIR}/docs/report.schema.json
  DESTINATION ${CMAKE_INSTALL_DOCDIR})
