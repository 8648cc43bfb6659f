#!/usr/bin/env python3
"""Runs coastmesh on several ranks: the same bytes as one process writes, errors of rank 0 said once, and nothing left
where a rank is killed.

usage: cluster_test.py PROGRAM MPIRUN ALONE DATA   (the program with an MPI, that one's mpirun, the program that is
used without ranks, the project's data)
"""
import json
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
                # The others get some pieces, and all of these come back.
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

    def wait_for(self, started, phase):
        for line in started.stdout:
            if line.startswith("{") and json.loads(line)["phase"] == phase:
                return
        self.fail(f"the run ended before it came to {phase}")

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
        self.wait_for(started, phase)
        os.kill(workers(self.folder)[rank], signal.SIGKILL)
        errors = self.expect_nothing_left(started, INTERRUPTED)
        self.assertIn(f"coastmesh: error: rank {rank} was ended by signal 9 (Killed)", errors)

    def test_rank_0_in_refine(self):
        self.kill(0, "refine")

    def test_another_rank_in_refine(self):
        self.kill(2, "refine")

    def test_rank_0_in_write(self):
        self.kill(0, "write")

    def test_another_rank_in_write(self):
        self.kill(1, "write")

    def test_an_interrupt_of_mpirun(self):
        started = self.begin()
        self.wait_for(started, "refine")
        started.send_signal(signal.SIGTERM)
        # MPICH's mpirun kills what is left, and has a code of its own.
        started.wait(timeout=60)
        self.expect_nothing_left(started, started.returncode)
        self.assertNotEqual(started.returncode, 0)


class GoesOn(Folder):
    """A run that lost a rank, begun again with what --checkpoint kept."""
    COMMAND = ("mesh", LAKE, "--size-max", "400", "--threads", "1", "--progress", "json")
    KEEPING = (*COMMAND, "--checkpoint", "kept", "--report", "kept.json", "-o", "out.nc")

    def begin(self, due, rank, *outputs):
        """Kills that rank of three as soon as `due(started)` comes back; `outputs` are written besides."""
        done = run([ALONE, *self.COMMAND, "-o", "whole.nc"], self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        started = subprocess.Popen(on_ranks(3, PROGRAM, *self.KEEPING, *outputs), cwd=self.folder, env=ENVIRONMENT,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(started.stdout.close)
        self.addCleanup(started.stderr.close)
        due(started)
        os.kill(workers(self.folder)[rank], signal.SIGKILL)
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

    def until_kept(self, reached):
        """Waits for a mesh whose stage and rounds are as wanted: they stand behind eight bytes."""
        def due(started):
            while started.poll() is None:
                try:
                    with open(self.path("kept/rounds-0"), "rb") as file:
                        head = file.read(17)
                except FileNotFoundError:
                    head = b""
                if len(head) == 17 and reached(head[8], int.from_bytes(head[13:17], "little")):
                    return
                time.sleep(0.001)
            self.fail("the run ended before")
        return due

    def test_killed_in_refine(self):
        self.begin(self.until_kept(lambda stage, rounds: True), 2)
        use = self.expect_rest(on_ranks(2, PROGRAM, *self.KEEPING))
        self.assertEqual((use["regions_gone_on"], use["groups_taken"]), (1, 0))
        self.assertGreater(use["rounds_kept"], 0)

    def test_killed_in_stitch(self):
        # There is no third round but the last.
        self.begin(self.until_kept(lambda stage, rounds: (stage, rounds) == (1, 3)), 0)
        use = self.expect_rest(on_ranks(3, PROGRAM, *self.KEEPING))
        self.assertEqual((use["regions_gone_on"], use["groups_taken"], use["rounds_kept"]), (1, 0, 0))

    def test_killed_in_write(self):
        def due(started):
            for line in started.stdout:
                if line.startswith("{") and json.loads(line)["phase"] == "write":
                    return
            self.fail("the run ended before")
        # One that takes long enough to be killed in.
        self.begin(due, 1, "-o", "new.gpkg")
        use = self.expect_rest([ALONE, *self.KEEPING])
        self.assertEqual((use["regions_gone_on"], use["groups_taken"], use["rounds_kept"]), (0, 1, 0))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
