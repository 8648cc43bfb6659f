# The Debian package: scripts/build release package, or cpack in the build folder.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME coastmesh)
set(CPACK_PACKAGE_VENDOR "the coastmesh authors")
# dpkg requires a maintainer, but no address; there is none that anybody reads.
set(CPACK_PACKAGE_CONTACT "the coastmesh authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "triangle meshes from coastlines and lakes, for ocean and lake models")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
"Reads coastlines and lakes from any GIS source, cleans and projects them, fills
them with triangles whose angles are 33 degrees or more, and writes GIS layers
and the grids of ocean models. With the program come its C++ libraries and
headers, the Python module coastmesh and a plugin for QGIS.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# The compiled module is for one version of Python.
find_package(Python3 COMPONENTS Interpreter QUIET)
math(EXPR next_python "${Python3_VERSION_MINOR} + 1")
string(PREPEND next_python "${Python3_VERSION_MAJOR}.")
set(CPACK_DEBIAN_PACKAGE_DEPENDS
  "python3 (>= ${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR}), python3 (<< ${next_python}), python3-numpy, proj-data")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "fonts-dejavu-core")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS
  "qgis (>= 3.22), libgdal-dev, libgeographiclib-dev, libnetcdf-dev, libscotch-dev, libtbb-dev, libcgal-dev, \
pkg-config")
# postinst compiles the Python modules, and prerm removes the compiled files.
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA
  ${PROJECT_SOURCE_DIR}/cmake/debian/postinst ${PROJECT_SOURCE_DIR}/cmake/debian/prerm)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
include(CPack)
