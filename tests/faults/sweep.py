#!/usr/bin/env python3
"""Lets the n-th allocation or the n-th change of the disk fail, for many n, and looks at what is left.

Every run writes its outputs over files that stand there already. Whatever fails: the exit code is one of the program's
own and says so, no part of an output is left, the files that stood there are as they were, or all of the new ones are
there where the exit code is that of a run without a fault. A run that is killed may leave its hidden folder, and nothing
else. And before a file comes into its place, it has been waited for until it is on the disk.
"""
import argparse
import collections
import concurrent.futures
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading

VARYING = 200  # allocations that may differ from run to run
OLD = b"what stood there\n"
REPORT = "report.json"
# Exit codes that each fault may lead to, besides that of a run without a fault.
CODES = {"fail": {3, 4}, "gone": {3, 4}, "short": {4}, "EIO": {4}, "ENOSPC": {4}, "int": {5},
         "kill": {-signal.SIGKILL}}
MESH = ["mesh", "INPUT", "--overwrite", "--threads", "THREADS", "--quiet"]
WRITE = ["--overwrite", "--quiet"]
SOURCE = [["mesh", "INPUT", "-o", "source.nc", "--quiet"]]
RIVERS = pathlib.Path(__file__).resolve().parent / "river.geojson"  # into the lake of lake.geojson
WEIRS = pathlib.Path(__file__).resolve().parent / "weir.geojson"  # in that lake
CRESTS = pathlib.Path(__file__).resolve().parent / "crest.asc"  # terrain there
LEVELS = pathlib.Path(__file__).resolve().parent / "aux3d.out"  # of FESOM2
KEPT = "kept"  # the folder of --checkpoint
# For each case: the outputs, the command without them, and commands to run before it. INPUT is the file to mesh. KEPT
# remains if a run ends early; a run that resumes from it must make the same files. The case `resumed` starts with the
# folder of a run that was killed half-way.
CASES = {
    "mesh": (["m.nc", "m.14", "m.msh", "m.2dm", "m.gpkg"], MESH + ["--report", REPORT], []),
    "formats": (["a.geojson", "b.shp", "c.fgb", "d.gr3", "e.slf", "f_grd.dat", "nod2d.out", "g_jigsaw.msh",
                 "h_mpas.nc", "i_22.msh", "j_ww3.msh", "k.node", "l.vtu", "m_globe.vtu", "n.ply", "o.mesh",
                 "partition.prop", "partmesh.txt"], MESH + ["--edits", "edits.gpkg", "--partition", "3"], []),
    "sized": (["m.nc", "m.14"], MESH + ["--size-shore", "4000", "--shore-rate", "0.2", "--size-max", "20000", "--coast",
                                        "follow", "--target", "adcirc"], []),
    "weirs": (["m.14"], MESH + ["--size-max", "20000", "--weirs", "WEIRS", "--weir-heights", "CRESTS", "--target", "adcirc"],
              []),
    "globe": (["m.nc"], ["mesh", "--domain", "globe", "--size", "2000000"] + MESH[2:], []),
    "png": (["m.png"], ["plot", "../source.nc", "--overwrite"], SOURCE),
    "svg": (["m.svg"], ["plot", "../source.nc", "--color", "angle", "--overwrite"], SOURCE),
    "convert": (["m.gpkg", "m.14"], ["convert", "../source.nc", "--target", "adcirc"] + WRITE, SOURCE),
    "cut": (["m.gpkg", "m.14"], ["cut", "../source.nc", "--bbox=-180,-90,180,90"] + WRITE, SOURCE),
    "remesh": (["m.gpkg", "m.14"], ["remesh", "../source.nc", "--bbox=-180,-90,180,90", "--size", "4000"] + WRITE, SOURCE),
    "merge": (["m.gpkg", "m.14"], ["merge", "../source.nc", "../part.nc"] + WRITE,
              SOURCE + [["mesh", "INPUT", "--size-max", "3000", "-o", "fine.nc", "--quiet"],
                        ["cut", "fine.nc", "--bbox=-180,-90,2.000,90", "-o", "part.nc", "--quiet"]]),
    "rivers": (["m.gpkg", "m.14"], ["rivers", "../source.nc", "RIVERS"] + WRITE, SOURCE),
    "partition": (["partition.prop"], ["partition", "../source.nc", "3", "--partition-levels", "LEVELS"] + WRITE, SOURCE),
    "check": (["m.gpkg"], ["check", "../source.nc", "--input", "INPUT", "--min-angle", "40"] + WRITE, SOURCE),
    "clean": (["m.gpkg"], ["clean", "INPUT", "--report", REPORT] + WRITE, []),
    "ranks": (["m.nc", "m.14"], MESH + ["--size-max", "3000"], []),
    "shard": (["m.shard"], MESH + ["--shard", "1/1"], []),
    "checkpoint": (["m.nc", "m.14"], MESH + ["--checkpoint", KEPT, "--report", REPORT], []),
    "resumed": (["m.nc"], MESH + ["--checkpoint", KEPT], []),
    "per_feature": (["m-{}.nc", "m-{}.14"], MESH + ["--per-feature", "--report", REPORT], []),
    "gather": (["m.nc"], ["gather", "../m.shard", "--report", REPORT] + WRITE,
               [["mesh", "INPUT", "--shard", "1/1", "-o", "m.shard", "--quiet"]]),
}


WATCHED = re.compile(r"\((?:malloc|calloc|realloc|memalign|aligned_alloc|posix_memalign)\+")  # apps/watch_memory
BUG = "exit code 70, not 3 or 4"


# Only the rank under test loads the shim; mpirun is not under test.
ON_RANK = """if [ "${OMPI_COMM_WORLD_RANK:-$PMI_RANK}" = "$FAULTY_RANK" ]; then
  LD_PRELOAD=$FAULTY_SHIM; export LD_PRELOAD
fi
exec "$@"
"""


class Sweep:
    def __init__(self, program, shim, input_file, scratch, threads, case, launcher=(), rank=0):
        self.scratch = scratch
        self.shim = shim
        self.writes = rank == 0 or not launcher  # other ranks send their results
        self.preload = {"LD_PRELOAD": str(shim)}
        if launcher:
            self.preload = {"FAULTY_SHIM": str(shim), "FAULTY_RANK": str(rank), "OMPI_ALLOW_RUN_AS_ROOT": "1",
                            "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
        self.program = program
        self.lock = threading.Lock()
        self.outcomes = collections.Counter()
        self.found = collections.defaultdict(list)
        self.libraries = collections.Counter()
        outputs, command, before = CASES[case]
        given = {"INPUT": str(input_file), "RIVERS": str(RIVERS), "WEIRS": str(WEIRS), "CRESTS": str(CRESTS), "LEVELS": str(LEVELS),
                 "THREADS": str(threads)}
        for each in before:
            subprocess.run([program] + [given.get(word, word) for word in each], cwd=scratch, check=True)
        self.command = [*launcher, program] + [given.get(word, word) for word in command]
        for name in outputs:
            self.command += ["-o", name]
        self.keeps = KEPT in command
        self.apart = any("{}" in name for name in outputs)
        self.begun = None
        if case == "resumed":
            self.begun = self.killed_half_way()
        self.learn()

    # Returns the checkpoint of a run that was killed at the middle one of its changes of the disk, or later.
    def killed_half_way(self):
        self.outputs = []
        count_file = self.scratch / "counts"
        self.run(None, COASTMESH_FAULT_COUNT=count_file)
        changes = int(count_file.read_text().split()[2])
        for n in range(changes // 2, changes):
            folder, code, errors = self.run(f"disk:{n}:kill")
            if code != -signal.SIGKILL:
                sys.exit(f"the run that is killed half-way: {code}: {errors}")
            if (folder / KEPT).is_dir() and any(path.stat().st_size > 0 for path in (folder / KEPT).iterdir()):
                (folder / KEPT).rename(self.scratch / KEPT)
                return self.scratch / KEPT
        sys.exit("nothing is kept of a run that is killed")

    # Runs without a fault: learns the outputs, the exit code and the number of calls.
    def learn(self):
        self.outputs, self.done = [], None
        folder, code, errors = self.run(None)
        if code not in (0, 1):
            sys.exit(f"the run without a fault fails: {code}: {errors}")
        self.outputs, self.done = sorted(self.contents(folder)), code
        count_file, log_file = self.scratch / "counts", self.scratch / "log"
        folder, code, errors = self.run(None, COASTMESH_FAULT_COUNT=count_file, COASTMESH_FAULT_LOG=log_file)
        if code != self.done or self.hidden(folder, False):
            sys.exit(f"the run without a fault leaves {sorted(folder.iterdir())}: {code}: {errors}")
        self.reference = self.contents(folder)
        if OLD in self.reference.values():
            sys.exit("the run without a fault replaces nothing")
        self.counts = dict(zip(("new", "malloc", "disk"), map(int, count_file.read_text().split())))
        self.needed = 0
        if self.writes:
            self.look_at_order(log_file.read_text().splitlines())

    # A file is synced before it is moved into place, and not written to in between. If an allocation before the first
    # sync fails, outputs may be incomplete.
    def look_at_order(self, lines):
        waited, moved = set(), set()
        for line in lines:
            what, path, allocations = line.split("\t")
            if what == "fsync" and not waited:
                self.needed = int(allocations) - VARYING
            name = "/".join(pathlib.PurePath(path).parts[-2:])
            if what == "fsync":
                waited.add(name)
            elif what == "write":
                waited.discard(name)
            elif ".part-" in name:
                moved.add(name)
                if name not in waited:
                    self.note("disk:0:fsync", f"{name.split('/')[1]} is moved into place before it is on the disk", "")
        if len(moved) != len(self.outputs):
            self.note("disk:0:fsync", f"{len(moved)} files are moved into place, of {len(self.outputs)}", "")

    def folder(self):
        folder = pathlib.Path(tempfile.mkdtemp(dir=self.scratch))
        for name in self.outputs:
            (folder / name).write_bytes(OLD)
        if self.begun:
            shutil.copytree(self.begun, folder / KEPT)
        return folder

    def run(self, fault, **environment):
        return self.run_in(self.folder(), fault, **environment)

    def run_in(self, folder, fault, **environment):
        if "COASTMESH_FAULT_COUNT" in environment:
            environment["COASTMESH_FAULT_COUNT"].unlink(missing_ok=True)
        environment = dict(os.environ, **self.preload, **{k: str(v) for k, v in environment.items()})
        if fault:
            environment["COASTMESH_FAULT"] = fault
        try:
            done = subprocess.run(self.command, cwd=folder, env=environment, capture_output=True, timeout=300)
            return folder, done.returncode, done.stderr.decode(errors="replace")
        except subprocess.TimeoutExpired:
            return folder, "does not end", ""

    def contents(self, folder):
        return {p.name: self.content(p) for p in folder.iterdir() if p.is_file()}

    # Remaining folders, without the one that may remain if a run ends early.
    def hidden(self, folder, early):
        return [path.name for path in folder.iterdir() if path.is_dir() and not (early and self.keeps and path.name == KEPT)]

    # Checks that a checkpoint is usable, or at least does no harm.
    def judge_going_on(self, folder):
        _, code, errors = self.run_in(folder, None)
        if code != self.done:
            yield f"going on: exit code {code}: {errors.strip()[-200:]}"
        elif self.contents(folder) != self.reference:
            yield "going on makes other files"
        elif (folder / KEPT).exists():
            yield "what was kept stays where all is done"

    # Reports and shards contain times.
    def content(self, path):
        content = path.read_bytes()
        if content == OLD or path.name not in (REPORT, "m.shard"):
            return content
        return b"a report" if path.name == REPORT else b"%d bytes" % len(content)

    def judge(self, fault, folder, code, errors):
        kind, number, what = fault.split(":")
        left = self.contents(folder)
        hidden = self.hidden(folder, code != self.done)
        if self.keeps and code != self.done:
            yield from self.judge_going_on(folder)
        if what == "kill" and code == -signal.SIGKILL:
            for name in self.outputs:
                if left.get(name) not in (OLD, self.reference[name]):
                    yield f"{name} is neither what stood there nor the new file"
            return
        if hidden:
            yield "left " + " ".join(sorted(name.split(".part-")[0] + ".part" for name in hidden))
        if code == self.done:
            if kind == "malloc" and what in ("fail", "gone") and int(number) <= self.needed:
                yield f"exit code {code}, though memory lacked"
            if left != self.reference:
                yield f"exit code {code}, but other files than without a fault"
            return
        if code not in CODES[what]:
            yield f"exit code {code}, not {' or '.join(map(str, sorted(CODES[what])))}"
        elif what != "kill" and "coastmesh: error: " not in errors:
            yield "no error is told"
        if set(left) != set(self.outputs):
            yield f"left {sorted(set(left) ^ set(self.outputs))}"
        new = {name for name in self.outputs if name in left and left[name] != OLD}
        if self.apart:  # files of one feature are moved into place together, independently of other features
            new -= self.whole_features(left)
        for name in sorted(new):
            yield f"{name} is not what stood there"

    # The files of features all of whose files are in place.
    def whole_features(self, left):
        features = collections.defaultdict(set)
        for name in self.outputs:
            if name != REPORT:
                features[pathlib.PurePath(name).stem].add(name)
        whole = [names for names in features.values() if all(left.get(name) == self.reference[name] for name in names)]
        return set().union(*whole)

    def note(self, fault, sentence, errors, stack=""):
        with self.lock:
            seen = self.found[sentence, stack]
            seen.append(fault)
            if len(seen) == 1:
                print(f"{fault}: {sentence}\n    {errors.strip().splitlines()[-1] if errors.strip() else ''}{stack}",
                      flush=True)

    def check(self, fault):
        folder, code, errors = self.run(fault)
        for sentence in list(self.judge(fault, folder, code, errors)):
            self.note(fault, sentence, errors)
        shutil.rmtree(folder, ignore_errors=True)
        self.count(fault, code)

    def count(self, fault, code):
        kind, _, what = fault.split(":")
        with self.lock:
            self.outcomes[f"{kind}:{what}", code] += 1
            tried = sum(self.outcomes.values())
        if tried % 1000 == 0:
            print(f"{tried} faults, the last {fault}", flush=True)

    # Every STEP-th allocation from FIRST on, in a single run; see fault_shim.c.
    def check_every(self, kind, what, first, step, most):
        around = pathlib.Path(tempfile.mkdtemp(dir=self.scratch))
        for name in self.scratch.iterdir():
            if name.is_file():
                shutil.copy(name, around)
        folder, kept, copy = around / "run", around / "run.kept", around / "copy"
        self.folder().rename(folder)
        out_read, out_write = os.pipe()
        in_read, in_write = os.pipe()
        environment = dict(os.environ, **self.preload,
                           COASTMESH_FAULT_EVERY=f"{kind}:{what}:{first}:{step}:{most}:{out_write}:{in_read}")
        process = subprocess.Popen(self.command, cwd=folder, env=environment, pass_fds=(out_write, in_read),
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        os.close(out_write)
        os.close(in_read)
        with os.fdopen(out_read, "rb") as told, os.fdopen(in_write, "wb", buffering=0) as answer:
            for line in told:
                word, value = line.split()
                if word == b"at":
                    fault = f"{kind}:{value.decode()}:{what}"
                    shutil.copytree(folder, copy, symlinks=True)
                    folder.rename(kept)
                    copy.rename(folder)
                    answer.write(b"g")
                    continue
                code = int(value)
                if code == -signal.SIGALRM:
                    code = "does not end"
                errors = (around / "errors").read_text(errors="replace")
                found = list(self.judge(fault, folder, code, errors))
                if found:  # a library may behave differently in a forked process, so a new run decides
                    anew, code, errors = self.run(fault)
                    found = list(self.judge(fault, anew, code, errors))
                    shutil.rmtree(anew)
                stack = ""
                in_library = False
                if found:
                    answer.write(b"t")
                    lines = []
                    while (frame := told.readline()) != b"told\n":
                        lines.append(frame.decode())
                    stack = self.named(lines)
                    in_library = found == [BUG] and self.note_library(lines, stack)
                shutil.rmtree(folder)
                kept.rename(folder)
                for sentence in [] if in_library else found:
                    self.note(fault, sentence, errors, stack)
                self.count(fault, code)
                answer.write(b"g")
        errors = process.stderr.read().decode(errors="replace")
        if process.wait() != self.done or self.contents(folder) != self.reference:
            self.note(f"{kind}:{first}:{what}", f"the run that was split came to exit code {process.returncode}", errors)
        shutil.rmtree(around)

    # True if a C library, or GDAL, crashed for lack of memory: everything is removed and reported as a bug, which is
    # all that the program can do.
    def note_library(self, lines, stack):
        for line in lines:
            place = os.path.basename(line.split("(")[0])
            if line.startswith(str(self.shim)) or re.match(r"libc\.so|libstdc\+\+|ld-linux", place) or WATCHED.search(line):
                continue
            if line.startswith(str(self.program)):
                return False
            named = [frame.strip() for frame in stack.splitlines() if place in frame and ": 0x" not in frame]
            with self.lock:
                self.libraries[named[0] if named else place] += 1
            return True
        return False

    # The functions on a call stack, innermost first, without details that vary between runs.
    def named(self, lines):
        places = [re.match(r"(.*?)\(([^+)]*)(?:\+(0x[0-9a-f]+))?\)", line) for line in lines]
        ours = [place[3] for place in places if place and place[1] == str(self.program) and place[3]]
        names = subprocess.run(["addr2line", "-f", "-C", "-e", self.program] + ours, capture_output=True,
                               text=True).stdout.splitlines()[::2]
        names = dict(zip(ours, names))
        text = []
        for place in places:
            if place and place[1] != str(self.shim):
                name = place[2] or names.get(place[3]) or place[3] or "?"
                text.append(f"{os.path.basename(place[1])}: {name}")
        shown = subprocess.run(["c++filt"], input="\n".join(text), capture_output=True, text=True).stdout.splitlines()
        return "".join(f"\n      {line[:150]}" for line in shown[:24])


def spread(count, most):
    """Up to `most` numbers from 1 to `count`, the first ones and the last among them."""
    if count <= most:
        return list(range(1, count + 1))
    if most < 2:
        return [count][:most]
    return sorted({1 + round(k * (count - 1) / (most - 1)) for k in range(most)})


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("shim", type=pathlib.Path)
    parser.add_argument("input", type=pathlib.Path)
    parser.add_argument("--case", choices=list(CASES) + ["all"], nargs="+", default=["mesh"], help="what is run")
    parser.add_argument("--every", action="store_true", help="every change of the disk, and every allocation, by malloc "
                        "too, in runs that split in two at each")
    parser.add_argument("--what", choices=["fail", "gone"], default="fail", help="of --every: one allocation fails, or "
                        "from it on all of 1 KiB and more")
    parser.add_argument("--each", type=int, default=10**9, help="of --every: so many allocations from each place at most")
    parser.add_argument("--first", type=int, default=1, help="of --every: allocations from this one on")
    parser.add_argument("--step", type=int, default=1, help="of --every: one in so many allocations")
    parser.add_argument("--disk", type=int, default=10**9, help="how many changes of the disk are let fail")
    parser.add_argument("--memory", type=int, default=10**9, help="how many allocations by new are let fail")
    parser.add_argument("--malloc", type=int, default=0, help="how many by malloc, which libraries in C ask too")
    parser.add_argument("--signals", type=int, default=0, help="how many allocations, at random, are interrupted")
    parser.add_argument("--seed", type=int, default=1, help="of --signals")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=1, help="how many runs at a time")
    parser.add_argument("--mpirun", help="runs it on two ranks: mpirun, and what it is to be given besides")
    parser.add_argument("--rank", type=int, default=1, help="of --mpirun: the one that faults are for")
    parser.add_argument("--scratch", help="folder to work in, on a disk in memory at best")
    parser.add_argument("--only", help="one fault: KIND:N:WHAT")
    arguments = parser.parse_args()
    failed = 0
    for case in list(CASES) if "all" in arguments.case else arguments.case:
        with tempfile.TemporaryDirectory(dir=arguments.scratch) as scratch:
            failed += sweep_case(case, arguments, pathlib.Path(scratch).resolve())
    if failed:
        sys.exit(f"{failed} faults are not taken as they should be")


def sweep_case(case, arguments, scratch):
    launcher = []
    if arguments.mpirun:
        launcher = [*arguments.mpirun.split(), "-n", "2", "sh", "-c", ON_RANK, "sh"]
    sweep = Sweep(arguments.program.resolve(), arguments.shim.resolve(), arguments.input.resolve(), scratch,
                  arguments.threads, case, launcher, arguments.rank)
    counts = sweep.counts
    print(f"{case}: {counts['disk']} changes of the disk, {counts['new']} allocations by new, {counts['malloc']} by malloc",
          flush=True)
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        work = []
        if arguments.only:
            work.append(pool.submit(sweep.check, arguments.only))
        else:
            for what in ("ENOSPC", "EIO", "short", "int", "kill"):
                for n in spread(counts["disk"], arguments.disk):
                    work.append(pool.submit(sweep.check, f"disk:{n}:{what}"))
            numbers = random.Random(arguments.seed)
            for _ in range(arguments.signals):
                work.append(pool.submit(sweep.check, f"malloc:{numbers.randint(1, counts['malloc'])}:int"))
            if arguments.every:
                for job in range(arguments.jobs):
                    work.append(pool.submit(sweep.check_every, "malloc", arguments.what, arguments.first + job * arguments.step,
                                            arguments.jobs * arguments.step, arguments.each))
            else:
                for kind, most in (("new", arguments.memory), ("malloc", arguments.malloc)):
                    for n in spread(counts[kind], most):
                        work.append(pool.submit(sweep.check, f"{kind}:{n}:fail"))
        for each in work:
            each.result()
    for (what, code), times in sorted(sweep.outcomes.items(), key=str):
        print(f"{what:12} exit code {code}: {times}")
    for name, times in sorted(sweep.libraries.items()):
        print(f"{times} times exit code 70, no part of a file left: {name}")
    for (sentence, stack), seen in sweep.found.items():
        print(f"{len(seen)} times, first {seen[0]}: {sentence}")
    return len({fault for seen in sweep.found.values() for fault in seen})


if __name__ == "__main__":
    main()
