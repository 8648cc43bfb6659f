#!/usr/bin/python3
"""Meshes random dirty polygons with random options, and judges what was written by other means than coastmesh's.

usage: tests/dirty/random_runs.py PROGRAM [--runs N] [--seed S] [--only NUMBER] [--keep DIR]

Run k of seed S is case S + k, always the same. Each ends with exit code 0, 1 or 3, the last two with a reason, or with 2
where an option's number is larger or smaller than coordinates and distances can be; each format
holds the same mesh, whose triangles run counter-clockwise on the ground, share their edges in pairs, and cover the area of
the input where no option changes it; the same bytes come out again, with 1, 2, 3 and 8 threads. What fails is printed and
kept, with its command, in DIR/NUMBER (default: random_failures).
"""
import argparse
import hashlib
import json
import math
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import tempfile

from mesh_judge import Failure, area_in_plane, as_places, check_layer, check_mesh, even_odd_union, require
from mesh_readers import read_grid, read_layer
from random_inputs import Case

GRIDS = ["m.nc", "m.2dm", "m.14", "m.gr3", "m.msh", "m_22.msh", "m.node", "m.slf", "m.vtu", "m_grd.dat", "m.mesh"]
LAYERS = ["m.gpkg", "m.geojson", "m.shp"]
# Part of the refusal by TELEMAC's format, which cannot hold every mesh.
PINCHED = "which TELEMAC's files cannot hold"
SECONDS, BYTES = 120, 6 << 30
LARGEST_COORDINATE, LEAST_DISTANCE = 1e70, 1e-70


def limit():
    resource.setrlimit(resource.RLIMIT_AS, (BYTES, BYTES))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def run(program, arguments, folder):
    try:
        return subprocess.run([program, *arguments], capture_output=True, text=True, timeout=SECONDS, cwd=folder,
                              preexec_fn=limit)
    except subprocess.TimeoutExpired as error:
        raise Failure(f"does not end in {SECONDS} s") from error


def arguments_of(case, folder, threads, outputs):
    outs = [word for name in outputs for word in ("-o", f"{folder}/{name}")]
    return ["mesh", case.input, *case.options, *outs, "--report", f"{folder}/report.json", "--threads", str(threads)]


def asks_beyond_range(options):
    numbers = [float(n) for option in options for n in re.findall(r"\d+(?:\.\d*)?(?:e[-+]?\d+)?", option)]
    return any(n > LARGEST_COORDINATE or 0.0 < n < LEAST_DISTANCE for n in numbers)


def digests(folder):
    """Of all files but the report, which has times in it."""
    return {p.name: hashlib.sha256(p.read_bytes()).hexdigest() for p in sorted(folder.iterdir())
            if p.name != "report.json"}


def judge_refusal(ran, folder):
    lines = ran.stderr.strip().split("\n")
    errors = [line for line in lines if line.startswith("coastmesh: error:")]
    require(len(errors) == 1 and len(errors[0]) > 30, f"exit code {ran.returncode} without a reason: {ran.stderr}")
    files = [p.name for p in folder.iterdir() if p.name != "report.json"]
    require(not files, f"exit code {ran.returncode}, but files: {files}")


def judge_area(case, nodes, triangles, report):
    """In a plane alone: elsewhere straight lines are others on the ground."""
    if not case.keeps_area or case.world.kind not in ("plane", "poly") or report["input"]["refused"]:
        return
    expected, got = even_odd_union(case.features), area_in_plane(nodes, triangles)
    # Crossings and points on edges are rounded to the resolution of coordinates.
    points = [p for rings in case.features for ring in rings for p in ring]
    largest = max(abs(v) for p in points for v in p)
    length = sum(math.dist(a, b) for rings in case.features for ring in rings for a, b in zip(ring, ring[1:] + ring[:1]))
    room = 1e-9 * expected + largest * length * 2**-42
    require(abs(got - expected) <= room, f"area {got!r}, not {expected!r}")


def judge_outputs(case, folder, outputs):
    report = json.loads((folder / "report.json").read_text())
    nodes, triangles = read_grid(folder / outputs[0])
    geographic = case.world.geographic and outputs[0] == "m.nc"
    # The program reports turned triangles, with exit code 1: the input has gaps as narrow as its coordinates'
    # resolution.
    check_mesh(nodes, triangles, geographic, report["mesh"]["turned"], "--crs" in case.options,
               case.world.kind == "utm")
    require(len(triangles) == report["mesh"]["triangles"], "the report counts other triangles")
    places = as_places(nodes, triangles)
    for name in outputs[1:]:
        if name in LAYERS:
            check_layer(read_layer(folder / name), nodes, triangles, geographic, name)
        else:
            require(as_places(*read_grid(folder / name)) == places, f"{name} holds another mesh than {outputs[0]}")
    judge_area(case, nodes, triangles, report)
    return report["mesh"]["turned"]["count"]


def check_case(program, case, folder):
    for name, text in case.files.items():
        (folder / name).write_text(text)
    outputs = GRIDS + LAYERS
    (folder / "command").write_text("coastmesh " + " ".join(arguments_of(case, ".", 1, outputs)) + "\n")
    seen = None
    for turn, threads in enumerate([1, 1, 2, 3, 8]):
        out = folder / f"out{turn}"
        out.mkdir()
        ran = run(program, arguments_of(case, out.name, threads, outputs), folder)
        if ran.returncode == 4 and PINCHED in ran.stderr:
            outputs = [name for name in outputs if name != "m.slf"]
            ran = run(program, arguments_of(case, out.name, threads, outputs), folder)
        said = ran.stdout + ran.stderr
        allowed = (0, 1, 2, 3) if asks_beyond_range(case.options) else (0, 1, 3)
        require(ran.returncode in allowed, f"exit code {ran.returncode}: {ran.stderr.strip()}")
        found = (ran.returncode, digests(out))
        require(seen in (None, found), f"other bytes with {threads} threads than with 1: " +
                ", ".join(n for n in found[1] if seen and seen[1].get(n) != found[1][n]))
        if seen is None:
            # Exit code 1 with an error: sizes require far more than --max-vertices.
            if ran.returncode in (2, 3) or "coastmesh: error: " in ran.stderr:
                judge_refusal(ran, out)
            else:
                require(ran.returncode == 0 or said.strip(), "exit code 1 without a reason")
                turned = judge_outputs(case, out, outputs)
                require(not turned or ran.returncode == 1, f"{turned} triangles turned over, but exit code 0")
        seen = found
        if turn > 0:
            shutil.rmtree(out)
    return seen[0]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=os.path.abspath)
    parser.add_argument("--runs", type=int, default=40)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", type=int)
    parser.add_argument("--keep", type=pathlib.Path, default=pathlib.Path("random_failures"))
    given = parser.parse_args()
    numbers = [given.only] if given.only is not None else range(given.seed, given.seed + given.runs)
    codes, failed = {0: 0, 1: 0, 2: 0, 3: 0}, 0
    for number in numbers:
        case = Case(number)
        with tempfile.TemporaryDirectory() as scratch:
            try:
                codes[check_case(given.program, case, pathlib.Path(scratch))] += 1
            except Failure as failure:
                failed += 1
                shutil.copytree(scratch, given.keep / str(number), dirs_exist_ok=True)
                (given.keep / str(number) / "failure").write_text(f"{failure}\n")
                print(f"case {number} ({case.world.kind}; {' '.join(case.options)}): {failure}", flush=True)
    print(f"{len(numbers)} runs from {numbers[0]} on: {codes[0]} done, {codes[1]} missing a requirement, "
          f"{codes[2] + codes[3]} refused, {failed} failed")
    # If all inputs are refused, the test finds nothing.
    sys.exit(failed > 0 or (len(numbers) >= 40 and codes[0] + codes[1] < len(numbers) / 2))


if __name__ == "__main__":
    main()
