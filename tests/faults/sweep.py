#!/usr/bin/env python3
"""Lets the n-th allocation or the n-th change of the disk fail, for many n, and looks at what is left.

Every run writes a mesh in several formats over files that stand there already. Whatever fails: the exit code is one of
the program's own and says so, no part of an output is left, the files that stood there are as they were, or all of the
new ones are there where the exit code is 0. A run that is killed may leave its hidden folder, and nothing else.
"""
import argparse
import collections
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile

OUTPUTS = ["m.nc", "m.14", "m.msh", "m.2dm", "m.gpkg", "report.json"]
OLD = b"what stood there\n"
# Exit codes that each fault may lead to, 0 apart.
CODES = {"new": {3, 4}, "malloc": {3, 4}, "short": {4}, "EIO": {4}, "ENOSPC": {4}, "int": {5}, "kill": {-signal.SIGKILL}}


class Sweep:
    def __init__(self, program, shim, input_file, scratch, threads):
        self.scratch = scratch
        self.shim = shim
        self.command = [program, "mesh", input_file, "--overwrite", "--threads", str(threads), "--quiet"]
        for name in OUTPUTS[:-1]:
            self.command += ["-o", name]
        self.command += ["--report", OUTPUTS[-1]]
        self.faults = []
        self.outcomes = collections.Counter()
        self.reference = {}

    def run(self, fault, count_file=None):
        folder = pathlib.Path(tempfile.mkdtemp(dir=self.scratch))
        for name in OUTPUTS:
            (folder / name).write_bytes(OLD)
        environment = dict(os.environ, LD_PRELOAD=str(self.shim))
        if fault:
            environment["COASTMESH_FAULT"] = fault
        if count_file:
            environment["COASTMESH_FAULT_COUNT"] = str(count_file)
        try:
            done = subprocess.run(self.command, cwd=folder, env=environment, capture_output=True, timeout=300)
            code, errors = done.returncode, done.stderr.decode(errors="replace")
        except subprocess.TimeoutExpired:
            code, errors = "does not end", ""
        return folder, code, errors

    def contents(self, folder):
        # Reports tell times.
        return {p.name: b"" if p.name == OUTPUTS[-1] and p.read_bytes() != OLD else p.read_bytes()
                for p in folder.iterdir() if p.is_file()}

    def counts(self):
        file = self.scratch / "counts"
        folder, code, errors = self.run(None, file)
        if code != 0:
            sys.exit(f"the run without a fault fails: {code}: {errors}")
        self.reference = self.contents(folder)
        if set(self.reference) < set(OUTPUTS) or any(p.is_dir() for p in folder.iterdir()):
            sys.exit(f"the run without a fault leaves {sorted(self.reference)}")
        shutil.rmtree(folder)
        return dict(zip(("new", "malloc", "disk"), map(int, file.read_text().split())))

    def judge(self, fault, folder, code, errors):
        what = fault.split(":")[2] if fault.startswith("disk") else fault.split(":")[0]
        left = self.contents(folder)
        hidden = [p.name for p in folder.iterdir() if p.is_dir()]
        if what == "kill" and code == -signal.SIGKILL:
            for name in OUTPUTS:
                if left.get(name) not in (OLD, self.reference[name]):
                    yield f"{name} is neither what stood there nor the new file"
            return
        if hidden:
            yield f"left {hidden}"
        if code == 0:
            if left != self.reference:
                yield "exit code 0, but other files than without a fault"
            return
        if code not in CODES[what]:
            yield f"exit code {code}, not {sorted(CODES[what])}"
        if set(left) != set(OUTPUTS):
            yield f"left {sorted(set(left) ^ set(OUTPUTS))}"
        for name in OUTPUTS:
            if left.get(name) != OLD:
                yield f"{name} is not what stood there"
        if what != "kill" and "coastmesh: error: " not in errors:
            yield "no error is told"

    def check(self, fault):
        folder, code, errors = self.run(fault)
        found = list(self.judge(fault, folder, code, errors))
        shutil.rmtree(folder, ignore_errors=True)
        self.outcomes[fault.split(":")[0] + ":" + fault.split(":")[2], code] += 1
        for sentence in found:
            print(f"{fault}: {sentence}\n    {errors.strip().splitlines()[-1] if errors.strip() else ''}", flush=True)
        if found:
            self.faults.append(fault)


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
    parser.add_argument("--disk", type=int, default=10**9, help="how many changes of the disk are let fail")
    parser.add_argument("--memory", type=int, default=10**9, help="how many allocations by new are let fail")
    parser.add_argument("--malloc", type=int, default=0, help="how many by malloc: many are made in C, which may crash")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--only", help="one fault: KIND:N:WHAT")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        sweep = Sweep(arguments.program.resolve(), arguments.shim.resolve(), arguments.input.resolve(),
                      pathlib.Path(scratch), arguments.threads)
        counts = sweep.counts()
        print(f"{counts['disk']} changes of the disk, {counts['new']} allocations by new, {counts['malloc']} by malloc")
        if arguments.only:
            sweep.check(arguments.only)
        else:
            for what in ("ENOSPC", "EIO", "short", "int", "kill"):
                for n in spread(counts["disk"], arguments.disk):
                    sweep.check(f"disk:{n}:{what}")
            for kind, most in (("new", arguments.memory), ("malloc", arguments.malloc)):
                for n in spread(counts[kind], most):
                    sweep.check(f"{kind}:{n}:fail")
        for (what, code), times in sorted(sweep.outcomes.items(), key=str):
            print(f"{what:12} exit code {code}: {times}")
        if sweep.faults:
            sys.exit(f"{len(sweep.faults)} faults are not taken as they should be")


if __name__ == "__main__":
    main()
