#!/usr/bin/env python3
"""Runs coastmesh on several ranks: the same bytes as one process writes, errors of rank 0 said once, and nothing left
where a rank is killed.

usage: cluster_test.py PROGRAM MPIRUN ALONE DATA   (the program with an MPI, that one's mpirun, the program that is
used without ranks, the project's data)
"""
import array
import json
import math
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

PROGRAM, MPIRUN, ALONE, DATA = (os.path.abspath(path) for path in sys.argv[1:5])
IS_OPEN_MPI = "openmpi" in os.path.basename(MPIRUN)
LAKE = os.path.join(DATA, "lake_superior.geojson")
ENVIRONMENT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
INTERRUPTED = 5


def on_ranks(ranks, *command):
    options = ["--oversubscribe"] if IS_OPEN_MPI else []
    return [MPIRUN, *options, "-n", str(ranks), *command]


def run(command, folder):
    return subprocess.run(command, cwd=folder, env=ENVIRONMENT, capture_output=True, text=True, timeout=300)


def own_lines(text):
    """What the program printed, less what mpirun says besides."""
    return [line for line in text.splitlines() if line.startswith("coastmesh: ")]


def hidden(folder):
    return [path.name for path in Path(folder).iterdir() if path.name.startswith(".")]


def workers(folder):
    """The working process of each rank of the run in a folder: rank -> process."""
    found = {}
    for path in Path("/proc").glob("[0-9]*"):
        try:
            if os.readlink(path / "exe") != os.path.realpath(PROGRAM):
                continue
            if os.readlink(path / "cwd") != os.path.realpath(folder):
                continue
            if (path / "comm").read_text().strip() in ("coastmesh-keep", "coastmesh-sweep"):
                continue
            variables = dict(entry.split("=", 1) for entry in (path / "environ").read_text().split("\0") if "=" in entry)
        except OSError:
            continue
        found[int(variables.get("OMPI_COMM_WORLD_RANK", variables.get("PMI_RANK", -1)))] = int(path.name)
    return found


def phases(started):
    """The phases that a run with `--progress json` comes to."""
    for line in started.stdout:
        if line.startswith("{"):
            yield json.loads(line)["phase"]


def has_pending(process, number):
    """Whether a signal waits for a process that is stopped."""
    try:
        status = Path(f"/proc/{process}/status").read_text()
    except FileNotFoundError:
        return False
    masks = [int(line.split()[1], 16) for line in status.splitlines() if line.startswith(("SigPnd:", "ShdPnd:"))]
    return any(mask >> (number - 1) & 1 for mask in masks)


def kill(found, rank):
    """Kills a rank, of which rank 0 learns while it is stopped: however fast it is, it does nothing more until its own
    end is asked for."""
    os.kill(found[0], signal.SIGSTOP)
    os.kill(found[rank], signal.SIGKILL)
    if rank == 0:
        return
    deadline = time.monotonic() + 60
    while not has_pending(found[0], signal.SIGTERM) and time.monotonic() < deadline:
        time.sleep(0.01)
    os.kill(found[0], signal.SIGCONT)


def workers_in(started, folder, phase):
    """The working processes, as soon as rank 0 has come to a phase: rank -> process."""
    found = {}
    for at in phases(started):
        found = found or workers(folder)
        if at == phase:
            return found
    raise AssertionError(f"the run ended before it came to {phase}")


def kill_in(started, folder, rank, phase):
    kill(workers_in(started, folder, phase), rank)


class Folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)


class SameBytes(Folder):
    def compare(self, *options):
        options = ("mesh", *options, "--threads", "2", "--quiet")
        outputs = lambda name: ("-o", name + ".nc", "-o", name + ".2dm", "--report", name + ".json")
        done = run([ALONE, *options, *outputs("one")], self.folder)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        for ranks in (1, 2, 3):
            with self.subTest(ranks=ranks):
                done = run(on_ranks(ranks, PROGRAM, *options, *outputs("many"), "--overwrite"), self.folder)
                self.assertEqual((done.returncode, own_lines(done.stderr)), (0, []))
                for ending in (".nc", ".2dm"):
                    self.assertEqual(Path(self.path("many" + ending)).read_bytes(),
                                     Path(self.path("one" + ending)).read_bytes(), ending)
                report = json.loads(Path(self.path("many.json")).read_text())
                use = report["cluster"]
                self.assertEqual(use["ranks"], ranks)
                # Other ranks get some pieces, and all of these come back.
                (self.assertGreater if ranks > 1 else self.assertEqual)(use["pieces_dealt"], 0)
                (self.assertGreater if ranks > 1 else self.assertEqual)(use["bytes_moved"], 0)
        self.assertEqual(hidden(self.folder), [])

    def test_by_angles_alone(self):
        self.compare(LAKE, "--min-angle", "36", "--size-max", "900")

    def test_graded(self):
        self.compare(LAKE, "--size-shore", "400", "--shore-rate", "0.1", "--size-max", "3000")

    def test_one_length(self):
        self.compare(LAKE, "--size", "600")

    def test_on_the_sphere(self):
        self.compare(LAKE, "--surface", "sphere", "--size-shore", "400", "--shore-rate", "0.1", "--size-max", "3000")


class Rasters(Folder):
    """Depths in 64 tiles, joined by a VRT: each is read by one rank alone."""
    ACROSS, SIDE = 8, 160  # tiles a row, pixels a side
    WEST, NORTH, EAST, SOUTH = -92.3, 50.4, -84.3, 45.0
    OPTIONS = ("mesh", LAKE, "--bathymetry", "dem.vrt", "--wave-elements", "60", "--slope-elements", "20",
               "--time-step", "4", "--size-min", "500", "--size-max", "8000", "--threads", "1", "--quiet")

    def setUp(self):
        super().setUp()
        self.tiles = [f"t{j}{i}.bil" for j in range(self.ACROSS) for i in range(self.ACROSS)]
        pixels = self.ACROSS * self.SIDE
        step_x, step_y = (self.EAST - self.WEST) / pixels, (self.NORTH - self.SOUTH) / pixels
        waves = [math.sin(0.02 * x) + 0.3 * math.sin(0.2 * x) for x in range(pixels)]
        sources = ""
        for number, name in enumerate(self.tiles):
            j, i = divmod(number, self.ACROSS)
            values = array.array("f")
            for y in range(j * self.SIDE, (j + 1) * self.SIDE):
                height = math.cos(0.03 * y)
                values.extend(-150 - 60 * height * wave for wave in waves[i * self.SIDE:(i + 1) * self.SIDE])
            Path(self.path(name)).write_bytes(values.tobytes())
            Path(self.path(name[:-4] + ".hdr")).write_text(
                f"NROWS {self.SIDE}\nNCOLS {self.SIDE}\nNBANDS 1\nNBITS 32\nPIXELTYPE FLOAT\n"
                f"BYTEORDER {'I' if sys.byteorder == 'little' else 'M'}\nLAYOUT BIL\n"
                f"ULXMAP {self.WEST + (i * self.SIDE + 0.5) * step_x!r}\n"
                f"ULYMAP {self.NORTH - (j * self.SIDE + 0.5) * step_y!r}\nXDIM {step_x!r}\nYDIM {step_y!r}\n")
            rect = f'xSize="{self.SIDE}" ySize="{self.SIDE}"'
            sources += (f'<SimpleSource><SourceFilename relativeToVRT="1">{name}</SourceFilename>'
                        f'<SourceBand>1</SourceBand><SourceProperties RasterXSize="{self.SIDE}" '
                        f'RasterYSize="{self.SIDE}" DataType="Float32" BlockXSize="{self.SIDE}" BlockYSize="1"/>'
                        f'<SrcRect xOff="0" yOff="0" {rect}/>'
                        f'<DstRect xOff="{i * self.SIDE}" yOff="{j * self.SIDE}" {rect}/></SimpleSource>')
        Path(self.path("dem.vrt")).write_text(
            f'<VRTDataset rasterXSize="{pixels}" rasterYSize="{pixels}"><SRS>EPSG:4326</SRS>'
            f"<GeoTransform>{self.WEST!r}, {step_x!r}, 0, {self.NORTH!r}, 0, {-step_y!r}</GeoTransform>"
            f'<VRTRasterBand dataType="Float32" band="1">{sources}</VRTRasterBand></VRTDataset>')
        self.once(ALONE, "one.nc")

    def once(self, program, name, ranks=0, *more):
        command = (program, *self.OPTIONS, "-o", name, "--report", name + ".json", *more)
        done = run(on_ranks(ranks, *command) if ranks else command, self.folder)
        # The time step may be violated in places.
        self.assertIn(done.returncode, (0, 1), done.stderr)

    def read_by(self, name):
        """What each rank read, from the report."""
        return json.loads(Path(self.path(name + ".json")).read_text())["cluster"]["by_rank"]

    def expect_apart(self, by_rank, files):
        read = [file for rank in by_rank for file in rank["raster_files"]]
        self.assertEqual(sorted(read), sorted(files))
        for rank in by_rank:
            self.assertGreater(rank["raster_bytes"], 0)
            self.assertGreater(rank["peak_memory_mib"], 1)
            self.assertAlmostEqual(len(rank["raster_files"]), len(files) / len(by_rank), delta=2)

    def test_each_tile_by_one_rank(self):
        self.assertEqual(self.read_by("one.nc"), [])
        for ranks in (1, 2, 3, 4, 8):
            with self.subTest(ranks=ranks):
                self.once(PROGRAM, "many.nc", ranks, "--overwrite")
                self.assertEqual(Path(self.path("many.nc")).read_bytes(), Path(self.path("one.nc")).read_bytes())
                if ranks > 1:
                    self.expect_apart(self.read_by("many.nc"), self.tiles)

    def test_slopes_filtered_across_tiles(self):
        self.once(ALONE, "one.nc", 0, "--slope-filter", "20000", "--overwrite")
        self.once(PROGRAM, "many.nc", 3, "--slope-filter", "20000")
        self.assertEqual(Path(self.path("many.nc")).read_bytes(), Path(self.path("one.nc")).read_bytes())
        self.expect_apart(self.read_by("many.nc"), self.tiles)

    def test_several_rasters(self):
        files = [name for number, name in enumerate(self.tiles) if number % 8 in (2, 3, 4) and number // 8 in (3, 4)]
        for name in files:
            os.symlink(self.path("wgs84.prj"), self.path(name[:-4] + ".prj"))
        Path(self.path("wgs84.prj")).write_text(
            'GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],PRIMEM["Greenwich",0],'
            'UNIT["degree",0.0174532925199433]]')
        more = [part for name in files for part in ("--bathymetry", name)]
        self.once(ALONE, "one.nc", 0, *more, "--overwrite")
        self.once(PROGRAM, "many.nc", 2, *more)
        self.assertEqual(Path(self.path("many.nc")).read_bytes(), Path(self.path("one.nc")).read_bytes())

    def apart(self, ranks):
        """A folder for each rank, which holds the tiles that it read and no others."""
        self.once(PROGRAM, "many.nc", ranks)
        for rank, read in enumerate(self.read_by("many.nc")):
            folder = Path(self.path(f"rank{rank}"))
            folder.mkdir()
            for name in (*read["raster_files"], *(tile[:-4] + ".hdr" for tile in read["raster_files"])):
                os.symlink(self.path(name), folder / name)
            # Not a link, because GDAL would look for tiles beside the link's target.
            (folder / "dem.vrt").write_text(Path(self.path("dem.vrt")).read_text())

    def run_apart(self, ranks):
        script = 'cd "rank$OMPI_COMM_WORLD_RANK$PMI_RANK" && exec "$@"'
        return run(on_ranks(ranks, "sh", "-c", script, "sh", PROGRAM, *self.OPTIONS, "-o", "out.nc"), self.folder)

    def test_no_rank_needs_the_tiles_of_another(self):
        self.apart(4)
        done = self.run_apart(4)
        self.assertIn(done.returncode, (0, 1), done.stderr)
        self.assertEqual(Path(self.path("rank0/out.nc")).read_bytes(), Path(self.path("one.nc")).read_bytes())

    def test_what_a_rank_cannot_read_is_named(self):
        self.apart(3)
        missing = self.read_by("many.nc")[2]["raster_files"][0]
        os.unlink(self.path(f"rank2/{missing}"))
        for what in (missing, "dem.vrt"):
            done = self.run_apart(3)
            self.assertEqual(done.returncode, 3, done.stderr)
            self.assertEqual(len(own_lines(done.stderr)), 1, done.stderr)
            self.assertRegex(done.stderr, r"rank 2 on [^ ]+: cannot read 'dem\.vrt'")
            self.assertIn(what, done.stderr)
            self.assertIn("where each of them reaches them", done.stderr)
            self.assertFalse(os.path.exists(self.path("rank0/out.nc")))
            if what == missing:
                os.unlink(self.path("rank2/dem.vrt"))

    def test_another_raster_of_that_name(self):
        self.apart(2)
        vrt = Path(self.path("dem.vrt")).read_text()
        Path(self.path("rank1/dem.vrt")).write_text(vrt.replace('rasterYSize="1280"', 'rasterYSize="1279"'))
        done = self.run_apart(2)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertRegex(done.stderr, r"rank 1 on [^ ]+: 'dem\.vrt' is another raster than it was")


class Refusals(Folder):
    def test_an_error_is_said_once(self):
        done = run(on_ranks(3, PROGRAM, "mesh", "nothing.shp", "-o", "out.nc"), self.folder)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertEqual(len(own_lines(done.stderr)), 1, done.stderr)
        self.assertEqual(os.listdir(self.folder), [])

    def test_wrong_usage_is_said_once(self):
        done = run(on_ranks(3, PROGRAM, "mesh", LAKE, "-o", "out.nc", "--min-angle", "99"), self.folder)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(len(own_lines(done.stderr)), 1, done.stderr)

    def test_ranks_of_different_commands(self):
        script = 'exec "$@" -o "rank$OMPI_COMM_WORLD_RANK$PMI_RANK.nc"'
        done = run(on_ranks(2, "sh", "-c", script, "sh", PROGRAM, "mesh", LAKE), self.folder)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("started with different commands", done.stderr)
        self.assertEqual(os.listdir(self.folder), [])

    def test_shards_are_no_ranks(self):
        script = 'exec "$@" -o "$OMPI_COMM_WORLD_RANK$PMI_RANK.shard" --shard "$((OMPI_COMM_WORLD_RANK+PMI_RANK+1))/2"'
        done = run(on_ranks(2, "sh", "-c", script, "sh", PROGRAM, "mesh", LAKE, "--quiet"), self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(sorted(os.listdir(self.folder)), ["0.shard", "1.shard"])

    def test_one_shard_for_all_ranks_is_refused(self):
        done = run(on_ranks(2, PROGRAM, "mesh", LAKE, "-o", "s.shard", "--shard", "1/2", "--quiet"), self.folder)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("of 2 ranks it is rank 0 that makes it", done.stderr)

    def test_without_mpi_ranks_are_refused(self):
        done = run(on_ranks(2, ALONE, "mesh", LAKE, "-o", "out.nc"), self.folder)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("built without MPI", done.stderr)
        self.assertEqual(os.listdir(self.folder), [])


class Killed(Folder):
    OLD = b"what stood there\n"

    def begin(self):
        Path(self.path("out.nc")).write_bytes(self.OLD)
        started = subprocess.Popen(
            on_ranks(3, PROGRAM, "mesh", LAKE, "--size-max", "300", "--threads", "1", "--overwrite", "-o", "out.nc", "-o",
                     "new.gpkg", "--progress", "json"),
            cwd=self.folder, env=ENVIRONMENT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(started.stdout.close)
        self.addCleanup(started.stderr.close)
        return started

    def expect_nothing_left(self, started, code):
        errors = started.stderr.read()
        started.wait(timeout=60)
        deadline = time.monotonic() + 10
        while (hidden(self.folder) or workers(self.folder)) and time.monotonic() < deadline:
            time.sleep(0.05)
        self.assertEqual(hidden(self.folder), [], errors)
        self.assertEqual(workers(self.folder), {}, errors)
        self.assertEqual(os.listdir(self.folder), ["out.nc"])
        self.assertEqual(Path(self.path("out.nc")).read_bytes(), self.OLD)
        self.assertEqual(started.returncode, code, errors)
        return errors

    def kill(self, rank, phase):
        started = self.begin()
        kill_in(started, self.folder, rank, phase)
        errors = self.expect_nothing_left(started, INTERRUPTED)
        self.assertIn(f"coastmesh: error: rank {rank} was ended by signal 9 (Killed)", errors)

    def test_rank_0_in_refine(self):
        self.kill(0, "refine")

    def test_another_rank_in_refine(self):
        self.kill(2, "refine")

    # MPI may abort a rank that reads from one just killed, before the end of the latter is known.
    def test_the_cause_of_a_crash_of_another_rank(self):
        started = self.begin()
        found = workers_in(started, self.folder, "refine")
        os.kill(found[1], signal.SIGABRT)
        os.kill(found[0], signal.SIGKILL)
        errors = self.expect_nothing_left(started, INTERRUPTED)
        self.assertIn("coastmesh: error: rank 0 was ended by signal 9 (Killed)", errors)

    def test_rank_0_in_write(self):
        self.kill(0, "write")

    def test_another_rank_in_write(self):
        self.kill(1, "write")

    def test_an_interrupt_of_mpirun(self):
        started = self.begin()
        self.assertIn("refine", phases(started))
        started.send_signal(signal.SIGTERM)
        # MPICH's mpirun kills the remaining ranks and returns a code of its own, on a busy machine even 0.
        started.wait(timeout=60)
        self.expect_nothing_left(started, started.returncode)


class GoesOn(Folder):
    """A run that lost a rank, begun again with what --checkpoint kept."""
    COMMAND = ("mesh", LAKE, "--size-max", "400", "--threads", "1", "--progress", "json")
    KEEPING = (*COMMAND, "--checkpoint", "kept", "--report", "kept.json", "-o", "out.nc")

    def begin(self, end):
        """Begins a run of three ranks, and lets `end(started)` kill one of them."""
        done = run([ALONE, *self.COMMAND, "-o", "whole.nc"], self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        started = subprocess.Popen(on_ranks(3, PROGRAM, *self.KEEPING), cwd=self.folder, env=ENVIRONMENT,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(started.stdout.close)
        self.addCleanup(started.stderr.close)
        end(started)
        errors = started.communicate(timeout=60)[1]
        self.assertEqual(started.returncode, INTERRUPTED, errors)
        deadline = time.monotonic() + 10
        while (hidden(self.folder) or workers(self.folder)) and time.monotonic() < deadline:
            time.sleep(0.05)
        self.assertEqual(workers(self.folder), {}, errors)
        self.assertEqual(sorted(os.listdir(self.folder)), ["kept", "whole.nc"], errors)

    def expect_rest(self, command):
        """What the next run says of what it went on from."""
        done = run(command, self.folder)
        self.assertEqual((done.returncode, own_lines(done.stderr)), (0, []))
        self.assertEqual(Path(self.path("out.nc")).read_bytes(), Path(self.path("whole.nc")).read_bytes())
        self.assertEqual(sorted(os.listdir(self.folder)), ["kept.json", "out.nc", "whole.nc"])
        return json.loads(Path(self.path("kept.json")).read_text())["checkpoint"]

    def kill_when_kept(self, rank, reached):
        """Kills a rank once a mesh is kept whose stage and rounds are as wanted: they stand behind eight bytes."""
        def end(started):
            found = {}
            while started.poll() is None:
                try:
                    with open(self.path("kept/rounds-0"), "rb") as file:
                        head = file.read(17)
                except FileNotFoundError:
                    head = b""
                found = found or (workers(self.folder) if head else {})
                if len(head) == 17 and reached(head[8], int.from_bytes(head[13:17], "little")):
                    kill(found, rank)
                    return
                time.sleep(0.001)
            self.fail("the run ended before")
        return end

    def test_killed_in_refine(self):
        self.begin(self.kill_when_kept(2, lambda stage, rounds: True))
        use = self.expect_rest(on_ranks(2, PROGRAM, *self.KEEPING))
        self.assertEqual((use["regions_gone_on"], use["groups_taken"]), (1, 0))
        self.assertGreater(use["rounds_kept"], 0)

    def test_killed_in_stitch(self):
        # The third round is the last one.
        self.begin(self.kill_when_kept(0, lambda stage, rounds: (stage, rounds) == (1, 3)))
        use = self.expect_rest(on_ranks(3, PROGRAM, *self.KEEPING))
        self.assertEqual((use["regions_gone_on"], use["groups_taken"], use["rounds_kept"]), (1, 0, 0))

    def test_killed_in_write(self):
        self.begin(lambda started: kill_in(started, self.folder, 1, "write"))
        use = self.expect_rest([ALONE, *self.KEEPING])
        self.assertEqual((use["regions_gone_on"], use["groups_taken"], use["rounds_kept"]), (0, 1, 0))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[5:]], verbosity=2)
