#!/usr/bin/python3
"""Recipes for package managers: each parses, has the project's version, and names every library that CMake asks for."""
import ast
import pathlib
import re
import shlex
import sys
import unittest

import yaml

SOURCES = pathlib.Path(__file__).resolve().parent.parent.parent
ROOMS = ["CMakeLists.txt", "core/CMakeLists.txt", "gis/CMakeLists.txt", "parallel/CMakeLists.txt", "apps/CMakeLists.txt",
         "apps/python/CMakeLists.txt"]
# The libraries that CMake requires, and their packages in Debian, conda-forge and Spack; None if another package
# includes them.
LIBRARIES = {
    "CGAL": ("libcgal-dev", "cgal-cpp", "cgal"),
    "GDAL": ("libgdal-dev", "libgdal", "gdal"),
    "TBB": ("libtbb-dev", "tbb-devel", "tbb"),
    "CLI11": ("libcli11-dev", "cli11", "cli11"),
    "nlohmann_json": ("nlohmann-json3-dev", "nlohmann_json", "nlohmann-json"),
    "PkgConfig": ("pkg-config", "pkg-config", "pkgconfig"),
    "geographiclib": ("libgeographiclib-dev", "geographiclib-cpp", "geographiclib"),
    "netcdf": ("libnetcdf-dev", "libnetcdf", "netcdf-c"),
    "cairo": ("libcairo2-dev", "cairo", "cairo"),
    "scotch": ("libscotch-dev", "scotch", "scotch"),
    "scotcherr": (None, None, None),
    "toml++": ("libtomlplusplus-dev", "tomlplusplus", "tomlplusplus"),
    "Python3": ("python3-dev", "python", "python"),
    "pybind11": ("pybind11-dev", "pybind11", "py-pybind11"),
}


def read(path):
    return (SOURCES / path).read_text(encoding="utf-8")


def version():
    return re.search(r"project\(coastmesh VERSION ([0-9.]+)", read("CMakeLists.txt"))[1]


def names(place):
    return {where[place] for where in LIBRARIES.values()} - {None}


class RecipesTest(unittest.TestCase):
    def test_the_table_is_what_cmake_asks_for(self):
        asked = set()
        for path in ROOMS:
            text = read(path)
            asked |= set(re.findall(r"find_package\((\w+)", text)) | set(re.findall(r"pkg_check_modules\((\w+)", text))
            asked |= set(re.findall(r"find_library\(\w+ (\w+)\)", text))
        # A header-only library, which no CMake file names.
        self.assertIn("#include <toml++/", read("apps/usage/config_entries.cpp"))
        self.assertEqual(asked | {"toml++"}, set(LIBRARIES))

    def test_scotch_is_found_with_and_without_a_folder_of_its_headers(self):
        """Debian has scotch/scotch.h, conda-forge and Spack scotch.h."""
        self.assertIn("find_path(SCOTCH_HEADER_DIR scotch.h PATH_SUFFIXES scotch)", read("gis/CMakeLists.txt"))
        self.assertIn("#include <scotch.h>", read("gis/solver/partition_graph.cpp"))

    def test_debian(self):
        source, *packages = [dict(re.findall(r"^([\w-]+): ?((?:.*)(?:\n .*)*)", paragraph, re.M))
                             for paragraph in read("debian/control").strip().split("\n\n")]
        needs = {word.split()[0] for word in source["Build-Depends"].replace("\n", " ").split(",")}
        self.assertLessEqual(names(0), needs)
        self.assertNotIn("Maintainer", source)  # scripts/make-deb takes it from the environment of the caller
        for package in packages:
            self.assertTrue((SOURCES / f"debian/{package['Package']}.install").exists(), package["Package"])
        self.assertFalse((SOURCES / "debian/changelog").exists())
        tests = read("debian/tests/control")
        for name in re.findall(r"^Tests: (\w+)", tests, re.M):
            self.assertTrue((SOURCES / "debian/tests" / name).stat().st_mode & 0o100, name)
        built = {package["Package"] for package in packages}
        for needed in re.findall(r"^Depends: ([\w-]+)", tests, re.M):
            self.assertIn(needed, built)

    def test_install_packages(self):
        listed = set(re.findall(r"[\w+.-]+", read("scripts/install-packages")))
        self.assertLessEqual(names(0), listed)
        for path in ("README.md", "CONTRIBUTING.md", "Containerfile", "scripts/quickstart", "scripts/test"):
            for option in re.findall(r"scripts/install-packages (--[a-z]+)", read(path)):
                self.assertIn(f"{option}) packages+=", read("scripts/install-packages"), path)
        # The package is only complete with the Python module, which is left out if something is missing for it.
        before = read("README.md").split("scripts/build release package")[0]
        self.assertIn("scripts/install-packages --package", before)

    def test_conda(self):
        recipe = yaml.safe_load(read("recipes/conda/recipe.yaml"))
        self.assertEqual(recipe["context"]["version"], version())
        needs = [word.split()[0] for place in ("build", "host") for word in recipe["requirements"][place]]
        self.assertLessEqual(names(1), set(needs))
        self.assertEqual(len(needs), len(set(need for need in needs if not need.startswith("$"))) + 3)  # three compilers
        tested = recipe["tests"][0]
        for file in tested["files"]["source"] + [recipe["about"]["license_file"]]:
            self.assertTrue((SOURCES / file).exists(), file)
        # The files of a test keep their folders.
        self.assertLessEqual(set(re.findall(r"\S+\.geojson", " ".join(tested["script"]))), set(tested["files"]["source"]))
        # In conda's lib, python3.1 is a link to the folder of the version.
        self.assertNotIn("python*", " ".join(recipe["build"]["script"]))
        for option in re.findall(r"-D(COASTMESH_\w+)", " ".join(recipe["build"]["script"])):
            self.assertIn(option, read("CMakeLists.txt"))

    def test_spack(self):
        tree = ast.parse(read("recipes/spack/packages/coastmesh/package.py"))
        (package,) = [node for node in tree.body if isinstance(node, ast.ClassDef)]
        self.assertEqual(package.name, "Coastmesh")
        calls = [node for node in ast.walk(package) if isinstance(node, ast.Call) and isinstance(node.func, ast.Name)]
        said = {}
        for call in calls:
            if call.args and isinstance(call.args[0], ast.Constant):
                said.setdefault(call.func.id, []).append(re.split(r"[@+~]", call.args[0].value)[0])
        self.assertEqual(said["version"], [version()])
        self.assertLessEqual(names(2), set(said["depends_on"]) | set(said["extends"]))
        self.assertIn("namespace", yaml.safe_load(read("recipes/spack/repo.yaml"))["repo"])

    def test_container(self):
        lines = re.sub(r"\\\n", " ", re.sub(r"^#.*\n", "", read("Containerfile"), flags=re.M)).split("\n")
        stages = []
        for words in map(shlex.split, filter(None, lines)):
            self.assertIn(words[0], {"FROM", "WORKDIR", "COPY", "RUN", "ENTRYPOINT", "CMD"})
            if words[0] == "FROM":
                stages.append(words[3] if len(words) > 2 else None)
                self.assertEqual(words[1].split(":")[1], "bookworm-slim")
            if words[0] == "COPY" and words[1].startswith("--from="):
                self.assertIn(words[1].removeprefix("--from="), stages)
            elif words[0] == "COPY":
                self.assertTrue((SOURCES / words[1]).exists(), words[1])
        self.assertEqual(len(stages), 2)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
