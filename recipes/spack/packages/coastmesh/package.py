"""Spack recipe, in a repository of one package: see recipes/README.md. There is no address to fetch sources from, so
`spack develop` names the clone."""
from spack_repo.builtin.build_systems.cmake import CMakePackage

from spack.package import *


class Coastmesh(CMakePackage):
    """Triangle meshes from GIS coastlines and lakes, for ocean and lake models."""

    license("GPL-3.0-or-later")

    version("0.1.0")

    variant("python", default=False, description="Build the Python module")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("cairo")
    depends_on("cgal")
    depends_on("cli11")
    depends_on("gdal+geos")
    depends_on("geographiclib")
    depends_on("gmp")
    depends_on("mpfr")
    depends_on("netcdf-c")
    depends_on("nlohmann-json")
    depends_on("scotch@7:")
    depends_on("tbb")
    depends_on("tomlplusplus")
    with when("+python"):
        extends("python")
        depends_on("py-numpy", type=("build", "run"))
        depends_on("py-pybind11", type="build")

    # Concepts and ranges of C++20.
    conflicts("%gcc@:11")

    def cmake_args(self):
        args = [self.define("COASTMESH_TESTS", False)]
        # Otherwise CMake builds the module for the system's Python.
        if self.spec.satisfies("+python"):
            args += [self.define("COASTMESH_PYTHON", self.spec["python"].command.path),
                     self.define("Python3_EXECUTABLE", self.spec["python"].command.path)]
        else:
            args.append(self.define("CMAKE_DISABLE_FIND_PACKAGE_pybind11", True))
        return args

    def setup_run_environment(self, env):
        if self.spec.satisfies("+python"):
            version = self.spec["python"].version.up_to(2)
            env.prepend_path("PYTHONPATH", join_path(self.prefix.lib, f"python{version}", "dist-packages"))
