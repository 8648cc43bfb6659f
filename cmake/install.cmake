# Installs the program, a static library and the headers of each room, and the package that find_package(coastmesh)
# reads. Each room is an export of its own, so that who asks for core alone needs no GDAL.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# The interface of each room; its other headers are its own affair.
set(core_headers delaunay ids item_loop linked_triangles metric point pslg quality run_control size_function tri_mesh
  refine/check refine/mesh_defect refine/refine refine/refine_options)
set(gis_headers error clean/clean clean/clean_options clean/clean_report clean/domain coast/coastline crs/crs
  crs/crs_definition crs/resolution file/output_files file/staged_files format/grid_format format/grid_io format/poly_io
  grid/grid grid/grid_parts projection/projection read/read_coastline read/read_report read/source)
set(parallel_headers mesh_regions work_log workers)

set(coastmesh_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/coastmesh)
foreach(room core gis parallel)
  set_target_properties(coastmesh_${room} PROPERTIES EXPORT_NAME ${room})
  target_compile_features(coastmesh_${room} PUBLIC cxx_std_20)
  install(TARGETS coastmesh_${room} EXPORT coastmesh-${room}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
    INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/coastmesh)
  foreach(header ${${room}_headers})
    cmake_path(GET header PARENT_PATH folder)
    install(FILES ${PROJECT_SOURCE_DIR}/${room}/${header}.hpp
      DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/coastmesh/${room}/${folder})
  endforeach()
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
