#!/usr/bin/python3
"""The module as a wheel: made by pip from a build that is there, installed into a fresh environment, and used.

usage: wheel_test.py BUILD SOURCES
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest
import zipfile

BUILD, SOURCES = (pathlib.Path(path).resolve() for path in sys.argv[1:3])
for module in ("pip", "venv", "ensurepip"):
    if subprocess.run([sys.executable, "-c", f"import {module}"], capture_output=True, check=False).returncode != 0:
        print(f"skipped: there is no {module}")
        sys.exit(77)
sys.path.insert(0, str(SOURCES / "apps/python"))
import build_backend  # noqa: E402

SCRIPT = """
import sys
import coastmesh
assert coastmesh.__file__.startswith(sys.prefix), coastmesh.__file__
mesh = coastmesh.mesh(sys.argv[1], min_angle=34)
assert len(mesh.triangles) > 1000 and mesh.min_angle.shape == (len(mesh.triangles),)
mesh.write("lake.nc")
print(len(mesh.triangles))
"""


def run(*command, cwd):
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    done = subprocess.run([str(word) for word in command], cwd=cwd, env=environment, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise AssertionError(f"exit code {done.returncode} of {command}\n{done.stdout}\n{done.stderr}")
    return done.stdout


class WheelTest(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder, True)

    def wheel(self, *options):
        """pip, without any index, in the usual way and without isolation."""
        out = self.folder / f"wheel{len(options)}"
        run(sys.executable, "-m", "pip", "wheel", SOURCES, "--no-deps", "--no-index", "--disable-pip-version-check", "-w", out,
            f"--config-settings=build-dir={BUILD}", *options, cwd=self.folder)
        (wheel,) = out.glob("*.whl")
        return wheel

    def test_a_wheel_installs_and_meshes(self):
        wheel, again = self.wheel(), self.wheel("--no-build-isolation")
        self.assertEqual(wheel.name, again.name)
        self.assertEqual(wheel.read_bytes(), again.read_bytes())
        # numpy comes from the system. `run` removes PYTHONPATH, so that the installed module is used.
        run(sys.executable, "-m", "venv", "--system-site-packages", "fresh", cwd=self.folder)
        python = self.folder / "fresh/bin/python"
        run(python, "-m", "pip", "install", "--no-index", "--no-deps", "--disable-pip-version-check", wheel, cwd=self.folder)
        self.assertGreater(int(run(python, "-c", SCRIPT, SOURCES / "data/lake_superior.geojson", cwd=self.folder)), 1000)
        self.assertTrue((self.folder / "lake.nc").exists())

    def test_it_says_what_it_links(self):
        wheel = self.wheel()
        with zipfile.ZipFile(wheel) as archive:
            names = archive.namelist()
            (info,) = [name for name in names if name.endswith("/METADATA")]
            said = archive.read(info).decode()
        self.assertEqual(len([name for name in names if ".so" in name]), 1)
        self.assertIn("Requires-Dist: numpy", said)
        external = [line.split(": ")[1] for line in said.splitlines() if line.startswith("Requires-External: ")]
        self.assertTrue(any(name.startswith("libgdal.so") for name in external), external)
        self.assertFalse(any(name.startswith("libpython") for name in external), external)

    def test_strange_libraries_are_refused(self):
        cc = shutil.which("cc")
        self.assertIsNotNone(cc)
        (self.folder / "strange.c").write_text("int strange(void) { return 1; }\n")
        (self.folder / "user.c").write_text("int strange(void); int user(void) { return strange(); }\n")
        run(cc, "-shared", "-fPIC", "strange.c", "-o", "libstrange.so", cwd=self.folder)
        run(cc, "-shared", "-fPIC", "user.c", "-L.", "-lstrange", "-o", "user.so", cwd=self.folder)
        with self.assertRaisesRegex(build_backend.BuildError, "links libstrange.so"):
            build_backend.audit(self.folder / "user.so")
        run(cc, "-shared", "-fPIC", "strange.c", "-Wl,-rpath,/opt/somewhere", "-o", "rpath.so", cwd=self.folder)
        with self.assertRaisesRegex(build_backend.BuildError, "/opt/somewhere"):
            build_backend.audit(self.folder / "rpath.so")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2)
