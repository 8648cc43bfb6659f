# Installs the program, a static library and the headers of each room, and the package that find_package(coastmesh)
# reads. Each room is an export of its own, so that who asks for core alone needs no GDAL.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# The interface of each room; its other headers are its own affair.
set(core_headers check delaunay ids item_loop metric point pslg quality refine run_control size_function tri_mesh)
set(gis_headers clean coastline crs error grid grid_io grid_parts output_files poly_io projection read_coastline resolution staged_files)
set(parallel_headers mesh_regions work_log workers)

set(coastmesh_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/coastmesh)
foreach(room core gis parallel)
  set_target_properties(coastmesh_${room} PROPERTIES EXPORT_NAME ${room})
  target_compile_features(coastmesh_${room} PUBLIC cxx_std_20)
  install(TARGETS coastmesh_${room} EXPORT coastmesh-${room}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
    INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/coastmesh)
  list(TRANSFORM ${room}_headers REPLACE "(.+)" "${PROJECT_SOURCE_DIR}/${room}/\\1.hpp" OUTPUT_VARIABLE headers)
  install(FILES ${headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/coastmesh/${room})
endforeach()
install(TARGETS coastmesh EXPORT coastmesh-program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
foreach(part core gis parallel program)
  install(EXPORT coastmesh-${part} NAMESPACE coastmesh:: DESTINATION ${coastmesh_package_dir})
endforeach()

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/coastmeshConfig.cmake.in
  ${PROJECT_BINARY_DIR}/coastmeshConfig.cmake INSTALL_DESTINATION ${coastmesh_package_dir})
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/coastmeshConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/coastmeshConfig.cmake ${PROJECT_BINARY_DIR}/coastmeshConfigVersion.cmake
  DESTINATION ${coastmesh_package_dir})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/cmake/debian/copyright
  DESTINATION ${CMAKE_INSTALL_DOCDIR})
