#!/usr/bin/python3
"""Runs every command that the documentation shows: blocks marked sh and python in *.md, commands in the table of the README,
examples of --help. A block that needs more than the program says so after `sh`: it is run where that is there, and
named where it is not. Also: links lead somewhere, and docs/options.md is what the program says.

usage: docs_test.py PROGRAM SOURCES MODULES PLUGIN.zip   (the program coastmesh, the project, the folder of the Python module)
"""
import glob
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import zipfile

PROGRAM, SOURCES, MODULES, PLUGIN = (os.path.abspath(path) for path in sys.argv[1:5])
PYTHON = sys.executable
FENCE = re.compile(r"^```(?P<info>[^\n]+)?\n(?P<text>.*?)^```$", re.M | re.S)
GUIDE = sorted(glob.glob(os.path.join(SOURCES, "docs", "**", "*.md"), recursive=True))
PAGES = [os.path.join(SOURCES, name)
         for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md", "SECURITY.md", "recipes/README.md")] + GUIDE


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def blocks(path):
    """Language, further words, and text of each fenced block."""
    for found in FENCE.finditer(read(path)):
        language, *words = (found.group("info") or "").split() or [""]
        yield language, words, found.group("text")


# Substitutes for schedulers that are seldom installed, as far as the pages need them: sbatch runs the tasks of the
# array that the script requests; parallel, unless GNU's is installed, runs a command for each word after ":::".
SBATCH = """#!/bin/bash
set -u
script=${!#}
[[ $(sed -n 's/^#SBATCH .*--array=\\([0-9]*\\)-\\([0-9]*\\).*/\\1 \\2/p' "$script") =~ ^([0-9]+)\\ ([0-9]+)$ ]] || exit 2
first=${BASH_REMATCH[1]} last=${BASH_REMATCH[2]}
cpus=$(sed -n 's/^#SBATCH .*--cpus-per-task=\\([0-9]*\\).*/\\1/p' "$script")
for ((task = first; task <= last; ++task)); do
  SLURM_ARRAY_TASK_ID=$task SLURM_ARRAY_TASK_COUNT=$((last - first + 1)) SLURM_CPUS_PER_TASK=$cpus bash "$script" || exit
done
"""
PARALLEL = """#!/bin/bash
command=()
while (($# > 0)) && [[ $1 != ::: ]]; do command+=("$1"); shift; done
for word in "${@:2}"; do "${command[@]//\\{\\}/$word}" || exit; done
"""


def has_gnu_parallel():
    if not shutil.which("parallel"):
        return False
    said = subprocess.run(["parallel", "--version"], stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    return said.stdout.startswith("GNU parallel")


class Folder:
    """Where a page's commands are run: with data/, and with the files that examples speak of."""

    def __init__(self, test, examples=False):
        self.path = tempfile.mkdtemp()
        test.addCleanup(shutil.rmtree, self.path, True)
        os.symlink(os.path.join(SOURCES, "data"), os.path.join(self.path, "data"))
        bin_folder = os.path.join(self.path, ".bin")
        os.mkdir(bin_folder)
        os.symlink(PROGRAM, os.path.join(bin_folder, "coastmesh"))
        stubs = [("sbatch", SBATCH)] if has_gnu_parallel() else [("sbatch", SBATCH), ("parallel", PARALLEL)]
        for name, text in stubs:
            with open(os.path.join(bin_folder, name), "w", encoding="utf-8") as stub:
                stub.write(text)
            os.chmod(stub.name, 0o755)
        self.environment = {
            **os.environ,
            "PATH": bin_folder + os.pathsep + os.environ["PATH"],
            "PYTHONPATH": MODULES,
            "COASTMESH_PROGRAM": PROGRAM,
            "HOME": self.path,
            "XDG_RUNTIME_DIR": self.path,
            "QT_QPA_PLATFORM": "offscreen",
        }
        if examples:
            for name in ("lake.geojson", "sea.geojson"):
                shutil.copy(os.path.join(SOURCES, "data/lake_superior.geojson"), os.path.join(self.path, name))
            for ending in ("shp", "shx", "dbf", "prj"):
                for name in ("lakes", "sea"):
                    shutil.copy(os.path.join(SOURCES, f"data/lake_superior.{ending}"),
                                os.path.join(self.path, f"{name}.{ending}"))
            with open(os.path.join(self.path, "job.toml"), "w", encoding="utf-8") as job:
                job.write('input = ["lake.geojson"]\noutput = ["job.nc"]\nmin-angle = 30\n')
            with open(os.path.join(self.path, "vgrid.in"), "w", encoding="utf-8") as levels:
                levels.write("2 !ivcor\n4 2 100. !nvrt, kz, h_s\nZ levels\n1 -500.\n2 -100.\nS levels\n40. 1. 1.e-4\n"
                             "2 -1.\n3 -0.5\n4 0.\n")
            with open(os.path.join(self.path, "bay.geojson"), "w", encoding="utf-8") as bay:
                bay.write('{"type": "Polygon", "coordinates": [[[-91, 46.5], [-90, 46.5], [-90, 47], [-91, 47], [-91, 46.5]]]}')
            # Depths for the whole lake.
            self.run("gdal_create -q -of GTiff -ot Float32 -outsize 20 20 -a_srs EPSG:4326 -a_ullr -93 50 -83 45 -burn -50 dem.tif")
            self.run("coastmesh clean lake.geojson -o lakes.gpkg && coastmesh mesh lake.geojson -o grid.2dm "
                     "&& coastmesh mesh lake.geojson --target adcirc -o fort.14 "
                     "&& coastmesh mesh lake.geojson --target schism -o hgrid.gr3")
            with open(os.path.join(self.path, "rivers.geojson"), "w", encoding="utf-8") as rivers:
                rivers.write('{"type": "Feature", "properties": {"width": 400, "name": "a"}, "geometry": {"type": "LineString", '
                             '"coordinates": [[-92.05, 46.72], [-92.3, 46.72], [-92.6, 46.72]]}}')
            self.run("ogr2ogr rivers.gpkg rivers.geojson && coastmesh mesh lake.geojson -o sea.nc -o plain.nc")
            self.run("for k in 1 2 3 4 5 6 7; do coastmesh mesh lakes.gpkg --shard $k/7 -o lakes-$k.shard; done")

    def takeMpi(self):
        """Makes coastmesh the one that was built with Open MPI, where there is one: whether there is."""
        program, mpirun = PROGRAM + "_openmpi", shutil.which("mpirun.openmpi")
        if not (os.path.exists(program) and mpirun):
            return False
        for name, target in (("coastmesh", program), ("mpirun", mpirun)):
            link = os.path.join(self.path, ".bin", name)
            if os.path.lexists(link):
                os.remove(link)
            os.symlink(target, link)
        self.environment.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                                OMPI_MCA_rmaps_base_oversubscribe="1")
        return True

    def run(self, script, interpreter=("bash", "-euo", "pipefail", "-c")):
        run = subprocess.run([*interpreter, script], cwd=self.path, env=self.environment, capture_output=True, text=True,
                             timeout=240, check=False)
        if run.returncode != 0:
            raise AssertionError(f"exit code {run.returncode} of\n{script}\n{run.stdout[-2000:]}\n{run.stderr[-4000:]}")
        return run.stdout


class GuideTest(unittest.TestCase):
    def run_page(self, name):
        folder = Folder(self)
        ran = 0
        for language, words, text in blocks(os.path.join(SOURCES, "docs", name)):
            self.assertIn(language, ("sh", "python"), "a block that no test runs")
            if language == "python":
                if words == ["run"]:
                    self.require_module()
                    folder.run(text, (PYTHON, "-c"))
                    ran += 1
                elif words == ["dask"]:
                    ran += self.run_dask(folder, name, text)
                continue
            if words == ["qgis"]:
                if not (shutil.which("qgis_process.bin") or shutil.which("qgis_process")):
                    print(f"{name}: not run, there is no QGIS:\n{text}")
                    continue
                plugins = os.path.join(folder.path, ".local/share/QGIS/QGIS3/profiles/default/python/plugins")
                with zipfile.ZipFile(PLUGIN) as archive:
                    archive.extractall(plugins)
                folder.environment["XDG_DATA_HOME"] = os.path.join(folder.path, ".local/share")
                folder.environment.pop("PYTHONPATH")
            if words == ["mpas-tools"] and not shutil.which("MpasMeshConverter.x"):
                print(f"{name}: not run, there are no MPAS-Tools:\n{text}")
                continue
            if words == ["mpi"] and not folder.takeMpi():
                print(f"{name}: not run, there is no program with Open MPI:\n{text}")
                continue
            folder.run(text)
            ran += 1
        return folder, ran

    def run_dask(self, folder, name, text):
        """As a script, which the processes that Dask starts can read; 1 where it was run."""
        has_dask = subprocess.run([PYTHON, "-c", "import dask, dask.multiprocessing"], capture_output=True, check=False)
        if has_dask.returncode != 0 or not glob.glob(os.path.join(MODULES, "coastmesh", "_coastmesh*")):
            print(f"{name}: not run, there is no Dask, or no Python module:\n{text}")
            return 0
        with open(os.path.join(folder.path, "with_dask.py"), "w", encoding="utf-8") as script:
            script.write(text)
        folder.dask_said = folder.run("with_dask.py", (PYTHON,))
        return 1

    def require_module(self):
        if not glob.glob(os.path.join(MODULES, "coastmesh", "_coastmesh*")):
            self.skipTest("the Python module was not built")

    def test_lake(self):
        folder, ran = self.run_page("lake.md")
        self.assertGreaterEqual(ran, 6)
        self.assertTrue(os.path.exists(os.path.join(folder.path, "lake.png")))

    def test_sea(self):
        folder, ran = self.run_page("sea.md")
        self.assertGreaterEqual(ran, 3)
        info = json.loads(folder.run("coastmesh info --json hispaniola.nc"))
        self.assertIn("open", info["boundaries"])
        self.assertIn("island", info["boundaries"])

    def test_globe(self):
        folder, ran = self.run_page("globe.md")
        self.assertGreaterEqual(ran, 3)
        self.assertTrue(os.path.exists(os.path.join(folder.path, "globe.png")))
        info = json.loads(folder.run("coastmesh info --json even.nc"))
        self.assertAlmostEqual(info["area_m2"] / 5.10065621724e14, 1.0, 9)

    def test_page(self):
        folder, ran = self.run_page("page.md")
        self.assertEqual(ran, 2)
        self.assertIn("</html>", read(os.path.join(folder.path, "lake.html")))

    def test_stable(self):
        folder, ran = self.run_page("stable.md")
        self.assertEqual(ran, 1)
        # The table's codes are those of the program.
        page = dict(re.findall(r"^\| (\d+) \| ([^|,]*)", read(os.path.join(SOURCES, "docs/stable.md")), re.M))
        header = re.findall(r"^  kExit\w+ = (\d+),", read(os.path.join(SOURCES, "apps/process/exit_codes.hpp")), re.M)
        self.assertEqual(sorted(page), sorted(header))

    def test_reference(self):
        """Its table names the folders that installed headers lie in."""
        self.assertEqual(list(blocks(os.path.join(SOURCES, "docs/reference.md"))), [])
        rows = re.findall(r"^\| (`.*?) \|", read(os.path.join(SOURCES, "docs/reference.md")), re.M)
        named = {folder for row in rows for folder in re.findall(r"`([^`]*)`", row)}
        doxyfile = os.path.join(os.path.dirname(MODULES), "Doxyfile")
        if not os.path.exists(doxyfile):
            self.skipTest("there is no Doxygen, and no list of headers for it")
        headers = re.findall(rf'"{re.escape(SOURCES)}/([^" ]*)\.hpp"', read(doxyfile))
        self.assertGreater(len(headers), 50)
        self.assertEqual(named, {os.path.dirname(header) for header in headers} - {"gis"})

    def test_batch(self):
        folder, ran = self.run_page("batch.md")
        self.assertGreaterEqual(ran, 3)
        report = json.loads(read(os.path.join(folder.path, "lakes.json")))
        self.assertGreater(report["mesh"]["triangles"], 0)
        # The gathered result equals that of a single run.
        folder.run("coastmesh mesh data/samples/finnish_lakes.geojson data/samples/english_lakes.geojson -o whole.nc "
                   "&& cmp whole.nc gathered.nc && cmp lakes.gpkg gathered.gpkg "
                   "&& coastmesh mesh data/samples/finnish_lakes.geojson -o whole.nc --overwrite && cmp whole.nc finnish.nc")
        # The file of each lake is the same as for the lake alone.
        each = json.loads(read(os.path.join(folder.path, "each.json")))
        self.assertEqual(each["per_feature"], {"made": 6, "short": 0, "skipped": 0, "refused": 0})
        for lake in each["features"]:
            folder.run(f"coastmesh mesh data/samples/finnish_lakes.geojson --where 'FID = {lake['fid']}' -o one.nc --overwrite "
                       f"&& cmp one.nc '{lake['outputs'][0]}'")
        if hasattr(folder, "dask_said"):
            counts = [json.loads(folder.run(f"coastmesh info --json '{lake['name']}.nc'"))["triangles"] for lake in each["features"]]
            self.assertEqual(folder.dask_said.strip(), str(tuple(counts)))
        # A lost shard is made again, the others are not.
        folder.run("rm lakes-3.shard gathered.nc && touch -d 2000-01-01 lakes-*.shard && sbatch lakes.sbatch "
                   "&& test lakes-3.shard -nt lakes-1.shard && test ! lakes-2.shard -nt lakes-1.shard "
                   "&& coastmesh gather lakes-*.shard -o gathered.nc")

    def test_mpi(self):
        folder, ran = self.run_page("mpi.md")
        self.assertGreaterEqual(ran, 1)
        # The checkpoint is removed, and the mesh is the same as without one.
        self.assertFalse(os.path.exists(os.path.join(folder.path, "kept")))
        self.assertIn("rounds_kept", json.loads(read(os.path.join(folder.path, "lake.json")))["checkpoint"])
        folder.run("coastmesh mesh data/lake_superior.geojson --size-max 400 -o whole.nc && cmp whole.nc lake.nc")
        if ran == 1:
            self.skipTest("nothing was built with MPI")
        report = json.loads(read(os.path.join(folder.path, "superior.json")))
        self.assertEqual(report["cluster"]["ranks"], 4)
        self.assertGreater(report["cluster"]["pieces_dealt"], 0)

    def test_python(self):
        self.require_module()
        folder, ran = self.run_page("python.md")
        self.assertGreaterEqual(ran, 3)
        folder.run(os.path.join(SOURCES, "docs/python_example.py"), (PYTHON,))
        self.assertTrue(os.path.exists(os.path.join(folder.path, "python_example.png")))

    def test_qgis(self):
        self.run_page("qgis.md")

    def run_model(self, model, grid):
        """The page's commands; a grid of ten to a hundred thousand nodes in the files that the model reads."""
        folder, ran = self.run_page(f"models/{model}.md")
        self.assertGreaterEqual(ran, 1)
        info = json.loads(folder.run(f"coastmesh info --json {grid}"))
        self.assertTrue(10_000 <= info["nodes"] <= 100_000, info["nodes"])
        self.assertGreaterEqual(info["step"]["time_step_s"], 5.0)
        return {name for name in os.listdir(folder.path) if not name.startswith(".")} - {"data"}

    def test_models_adcirc(self):
        self.run_model("adcirc", "fort.14")

    def test_models_schism(self):
        self.assertLessEqual({"hgrid.gr3", "hgrid.ll"}, self.run_model("schism", "hgrid.gr3"))

    def test_models_fvcom(self):
        self.assertLessEqual({f"sea_{part}.dat" for part in ("grd", "dep", "obc", "cor", "spg")},
                             self.run_model("fvcom", "sea_grd.dat"))

    def test_models_telemac(self):
        self.assertLessEqual({"sea.slf", "sea.cli"}, self.run_model("telemac", "sea.slf"))

    def test_models_mike(self):
        self.run_model("mike", "sea.mesh")

    def test_models_dflowfm(self):
        self.run_model("dflowfm", "sea_net.nc")

    def test_models_swan(self):
        self.run_model("swan", "fort.14")

    def test_models_ww3(self):
        self.run_model("ww3", "sea_ww3.msh")

    def test_models_fesom(self):
        self.assertLessEqual({"nod2d.out", "elem2d.out", "aux3d.out"}, self.run_model("fesom", "nod2d.out"))

    def test_models_mpas(self):
        self.run_model("mpas", "sea_mpas.nc")

    def test_every_page_has_a_test(self):
        pages = {os.path.relpath(path, os.path.join(SOURCES, "docs"))[:-len(".md")].replace(os.sep, "_") for path in GUIDE}
        tested = {name[len("test_"):] for name in dir(self) if name.startswith("test_")}
        self.assertLessEqual(pages - {"README", "models_README", "options"}, tested)


class CommandsTest(unittest.TestCase):
    def test_the_readme(self):
        folder = Folder(self, examples=True)
        text = read(os.path.join(SOURCES, "README.md"))
        commands = [line for _, _, block in blocks(os.path.join(SOURCES, "README.md")) for line in block.splitlines()
                    if line.startswith("coastmesh ")]
        commands += re.findall(r"^\| `(coastmesh [^`]*)`", text, re.M)
        self.assertGreater(len(commands), 5)
        for command in commands:
            folder.run(command + (" --overwrite" if re.search(r" -o ", command) else ""))

    def test_examples_of_the_help(self):
        folder = Folder(self, examples=True)
        usage = json.loads(subprocess.run([PROGRAM, "--json-usage"], capture_output=True, check=True).stdout)
        for command in usage["commands"]:
            for example in command["examples"]:
                line = example["command"]
                folder.run(line + (" --overwrite" if re.search(r" -o ", line) else ""))

    def test_contributing(self):
        """What builds is run by continuous integration itself; the programs and scripts named have to be there."""
        for language, words, text in blocks(os.path.join(SOURCES, "CONTRIBUTING.md")):
            self.assertEqual(language, "sh")
            self.assertIn(words, (["build"], ["perf"]))
            self.assertEqual(subprocess.run(["bash", "-n", "-c", text], check=False).returncode, 0)
            for script in re.findall(r"scripts/[a-z-]+", text):
                self.assertTrue(os.access(os.path.join(SOURCES, script), os.X_OK), script)
        for script in re.findall(r"`(?:sudo )?(scripts/[a-z-]+)", read(os.path.join(SOURCES, "CONTRIBUTING.md"))):
            self.assertTrue(os.access(os.path.join(SOURCES, script), os.X_OK), script)


class PagesTest(unittest.TestCase):
    def test_links_lead_somewhere(self):
        for page in PAGES:
            for target in re.findall(r"\]\(([^)#:]+)\)", read(page)):
                path = os.path.join(os.path.dirname(page), target)
                self.assertTrue(os.path.exists(path), f"{os.path.relpath(page, SOURCES)}: {target}")

    def test_options_are_what_the_program_says(self):
        said = subprocess.run([PROGRAM, "--usage-as", "markdown"], capture_output=True, text=True, check=True).stdout
        written = read(os.path.join(SOURCES, "docs/options.md"))
        self.assertEqual(written.strip(), said.strip(), "run scripts/update-options")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[5:], verbosity=2)
