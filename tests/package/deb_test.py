#!/usr/bin/python3
"""Makes the Debian package of a build and tries what lies in it, unpacked. scripts/test-package installs it.

usage: deb_test.py BUILD CPACK
"""
import glob
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

BUILD, CPACK = sys.argv[1:3]
if not shutil.which("dpkg-deb"):
    print("skipped: there is no dpkg-deb")
    sys.exit(77)
PLUGIN = "usr/share/qgis/python/plugins/coastmesh_qgis"
PARTS = [
    "usr/bin/coastmesh", "usr/lib/libcoastmesh_core.a", "usr/lib/cmake/coastmesh/coastmeshConfig.cmake",
    "usr/include/coastmesh/core/pslg.hpp", "usr/share/man/man1/coastmesh-mesh.1",
    "usr/share/bash-completion/completions/coastmesh", "usr/share/zsh/vendor-completions/_coastmesh",
    "usr/share/fish/vendor_completions.d/coastmesh.fish", "usr/share/doc/coastmesh/copyright",
    "usr/share/doc/coastmesh/report.schema.json", PLUGIN + "/metadata.txt", PLUGIN + "/__init__.py",
]


class PackageTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        made = subprocess.run([CPACK, "-G", "DEB", "-B", cls.folder], cwd=BUILD, capture_output=True, text=True, check=False)
        assert made.returncode == 0, made.stdout + made.stderr
        (cls.package,) = glob.glob(os.path.join(cls.folder, "*.deb"))
        cls.root = os.path.join(cls.folder, "root")
        subprocess.run(["dpkg-deb", "-x", cls.package, cls.root], check=True)

    def test_everything_is_in_it_and_nothing_outside_usr(self):
        for part in PARTS:
            self.assertTrue(os.path.exists(os.path.join(self.root, part)), part)
        self.assertEqual(os.listdir(self.root), ["usr"])
        self.assertFalse(glob.glob(os.path.join(self.root, "**/__pycache__"), recursive=True))

    def test_it_says_what_it_needs(self):
        needs = subprocess.run(["dpkg-deb", "-f", self.package, "Depends"], capture_output=True, text=True, check=True).stdout
        for library in ("libgdal", "libtbb", "libnetcdf", "python3-numpy"):
            self.assertIn(library, needs)

    def test_program_and_module_work_where_they_lie(self):
        subprocess.run([os.path.join(self.root, "usr/bin/coastmesh"), "--version"], check=True, stdout=subprocess.DEVNULL)
        modules = os.path.join(self.root, "usr/lib/python3/dist-packages")
        if not glob.glob(os.path.join(BUILD, "python/coastmesh/_coastmesh*")):
            self.assertFalse(os.path.exists(modules))
            self.skipTest("the Python module was not built")
        script = ("import coastmesh; m = coastmesh.mesh([[0, 0], [1, 0], [0, 1]], [[0, 1], [1, 2], [2, 0]]);"
                  f"assert len(m.triangles) and coastmesh.__file__.startswith({modules!r})")
        subprocess.run([sys.executable, "-B", "-c", script], check=True, env={**os.environ, "PYTHONPATH": modules})


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2)
