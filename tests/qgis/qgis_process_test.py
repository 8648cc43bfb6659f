#!/usr/bin/python3
"""The plugin as qgis_process loads it, from the zip that users install. 77: no qgis_process here.

usage: qgis_process_test.py PROGRAM PLUGIN.zip
"""
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import zipfile

PROGRAM, ZIP = sys.argv[1:3]
LAKE = {"type": "Polygon", "coordinates": [[[0, 0], [0.2, 0], [0.2, 0.2], [0, 0.2], [0, 0]]]}
# Debian 12's wrapper passes on an option of QGIS that qgis_process does not know.
QGIS_PROCESS = shutil.which("qgis_process.bin") or shutil.which("qgis_process")
if not QGIS_PROCESS:
    print("skipped: there is no qgis_process")
    sys.exit(77)


class QgisProcessTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.home = tempfile.mkdtemp()
        plugins = os.path.join(cls.home, ".local/share/QGIS/QGIS3/profiles/default/python/plugins")
        with zipfile.ZipFile(ZIP) as archive:
            archive.extractall(plugins)
        cls.environment = {
            **os.environ,
            "HOME": cls.home,
            "XDG_DATA_HOME": os.path.join(cls.home, ".local/share"),
            "XDG_CONFIG_HOME": os.path.join(cls.home, ".config"),
            "XDG_RUNTIME_DIR": cls.home,
            "QT_QPA_PLATFORM": "offscreen",
            "COASTMESH_PROGRAM": PROGRAM,
        }
        enabled = cls.call("plugins", "enable", "coastmesh_qgis")
        assert enabled.returncode == 0, enabled.stdout + enabled.stderr

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.home, ignore_errors=True)

    @classmethod
    def call(cls, *arguments):
        return subprocess.run(
            [QGIS_PROCESS, *arguments], env=cls.environment, capture_output=True, text=True, timeout=120
        )

    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)
        self.lake = self.path("lake.geojson")
        with open(self.lake, "w", encoding="utf-8") as file:
            json.dump(LAKE, file)

    def path(self, name):
        return os.path.join(self.folder, name)

    def test_meshes_and_tells_its_results(self):
        mesh = self.path("lake.nc")
        run = self.call("run", "--json", "coastmesh:mesh", "--", f"INPUT={self.lake}", f"OUTPUT={mesh}", "SIZE_MAX=5000")
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        results = json.loads(run.stdout)["results"]
        self.assertEqual(results["OUTPUT"], mesh)
        said = json.loads(subprocess.run([PROGRAM, "info", "--json", mesh], capture_output=True, check=True).stdout)
        self.assertEqual(said["triangles"], results["TRIANGLE_COUNT"])
        self.assertLess(said["longest_edge_m"], 5000 * 1.01)

    def test_help_shows_the_programs_own_options(self):
        run = self.call("help", "coastmesh:mesh")
        self.assertEqual(run.returncode, 0)
        self.assertIn("minimum angle of the triangles", run.stdout)

    def test_a_parameter_given_twice_has_both_values(self):
        run = self.call("run", "coastmesh:mesh", "--", f"INPUT={self.lake}", f"OUTPUT={self.path('a.nc')}", "SIZE_MAX=5000",
                        "TARGET=adcirc", "TARGET=schism")
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        self.assertIn("--target=adcirc --target=schism", run.stdout)
        self.assertIn("one value per line, or a list", self.call("help", "coastmesh:mesh").stdout)

    def test_an_error_is_shown_and_fails(self):
        empty = self.path("empty.geojson")
        with open(empty, "w", encoding="utf-8") as file:
            json.dump({"type": "Polygon", "coordinates": [[[0, 0], [1, 1], [2, 2], [0, 0]]]}, file)
        run = self.call("run", "coastmesh:mesh", "--", f"INPUT={empty}", f"OUTPUT={self.path('a.nc')}")
        self.assertNotEqual(run.returncode, 0)
        self.assertIn("empty.geojson", run.stdout + run.stderr)
        self.assertFalse(os.path.exists(self.path("a.nc")))

    def test_killed_the_program_goes_too_and_leaves_nothing(self):
        command = [QGIS_PROCESS, "run", "coastmesh:mesh", "--", f"INPUT={self.lake}", f"OUTPUT={self.path('a.nc')}",
                   "SIZE_MAX=40", "OUTPUT_LAYERS=" + self.path("a.gpkg")]
        run = subprocess.Popen(command, env=self.environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(run.wait)
        for _ in range(600):
            if any(name.startswith(".") for name in os.listdir(self.folder)):
                break
            self.assertIsNone(run.poll(), "the run ended before it could be killed")
            time.sleep(0.05)
        else:
            self.fail("the program did not begin")
        run.send_signal(signal.SIGKILL)
        for _ in range(400):
            if os.listdir(self.folder) == ["lake.geojson"]:
                return
            time.sleep(0.05)
        self.fail(f"left: {os.listdir(self.folder)}")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2)
