#!/usr/bin/python3
"""Runs what runs.txt declares and compares what came out with golden.tsv, line by line.

usage: tests/golden/golden.py PROGRAM [--section NAME] [--without-slow] [--update]

Exit code 1 where a line differs: both are shown. --update writes the table anew: its diff is what a change did. Every
column has to be equal, bytes of the outputs included. Only runs on the Earth depend on the machine: another C library, or
a processor without fused multiply-adds, rounds a few of their sines otherwise. golden.tsv notes whose sines it was made
with; with others, exit codes have to be equal there, and counts to within 2 %.
"""
import argparse
import hashlib
import json
import math
import pathlib
import re
import shlex
import struct
import subprocess
import sys
import tempfile

import inputs

HERE = pathlib.Path(__file__).resolve().parent
TABLE = HERE / "golden.tsv"
COLUMNS = ["section", "run", "exit", "digest", "vertices", "triangles", "steiner", "min_angle", "unresolved", "repairs", "files"]
# Libraries store their own version in these files, so they are compared by content.
BY_FEATURES = {".gpkg", ".shp", ".fgb"}
PARTS_OF_SHAPEFILES = {".shx", ".dbf", ".prj", ".cpg"}


class Run:
    def __init__(self, section, name, command, slow, earth):
        self.section, self.name, self.command, self.slow, self.earth = section, name, command, slow, earth
        self.key = (section, name)


def expanded(name, command):
    """One pair for each of the values in the name's braces."""
    found = re.search(r"\{(.*?)\}", name)
    if not found:
        return [(name, command)]
    return [(name.replace(found[0], value).strip("_"), command.replace("{}", value)) for value in found[1].split(",")]


def declared():
    text = re.sub(r"\n  +", " ", (HERE / "runs.txt").read_text())
    runs = []
    for line in text.splitlines():
        if line.startswith("["):
            section, earth = line[1 : line.index("]")], line.endswith("] earth")
        elif line and not line.startswith("#"):
            slow = line.startswith("slow ")
            name, command = line.removeprefix("slow ").split(maxsplit=1)
            runs += [Run(section, *pair, slow, earth) for pair in expanded(name, command)]
    keys = [run.key for run in runs]
    for key in keys:
        if keys.count(key) > 1:
            sys.exit(f"runs.txt: two runs of a section are called {key[1]}")
    return runs


def features_of(path):
    """All that a vector file holds, without how it is stored."""
    from osgeo import gdal, ogr

    gdal.UseExceptions()
    source = ogr.Open(str(path))
    for layer in (source.GetLayer(i) for i in range(source.GetLayerCount())):
        crs = layer.GetSpatialRef()
        yield f"{layer.GetName()} {crs and crs.GetAuthorityCode(None)} {layer.GetGeomType()}"
        for feature in layer:
            geometry = feature.GetGeometryRef()
            yield f"{feature.items()} {bytes(geometry.ExportToIsoWkb()).hex() if geometry else None}"


def digest_of_files(folder):
    digest = hashlib.sha256()
    for path in sorted(folder.iterdir()):
        if path.suffix in PARTS_OF_SHAPEFILES and path.with_suffix(".shp").exists():
            continue
        digest.update(path.name.encode() + b"\0")
        if path.suffix in BY_FEATURES:
            for text in features_of(path):
                digest.update(text.encode() + b"\n")
        else:
            digest.update(path.read_bytes())
    return digest.hexdigest()[:12]


def columns_of(report):
    """Those of a report of `mesh`, or of `clean`."""
    if "graph" in report:
        graph = report["graph"]
        edits = sum(report["clean"].values())
        return {"vertices": graph["points"], "triangles": f"{graph['segments']} segments", "repairs": f"{edits} edits"}
    mesh, refine, repairs = report["mesh"], report["refine"], report["repairs"]
    return {
        "digest": mesh["digest"],
        "vertices": mesh["vertices"],
        "triangles": mesh["triangles"],
        "steiner": refine["steiner_points"],
        "min_angle": "-" if mesh["min_angle_deg"] is None else f"{mesh['min_angle_deg']:.6f}",
        "unresolved": refine["unresolved"]["count"],
        "repairs": f"{len(repairs['done'])}+{len(repairs['left'])}" if repairs else "-",
    }


def columns_of_info(info):
    return {"vertices": info["nodes"], "triangles": info["triangles"], "min_angle": f"{info['min_angle_deg']:.6f}"}


def perform(run, program, folder):
    """The run's line of the table."""
    out = folder / run.section / run.name
    out.mkdir(parents=True)
    words = shlex.split(run.command)
    if "-o" not in words:
        words += ["-o", "mesh.node"]
    if words[0] == "mesh" and "--threads" not in words:
        words += ["--threads", "2"]
    words = [re.sub("^@", f"{out.parent}/", word) for word in words]
    words = [str(out / word) if before == "-o" else word for before, word in zip(["", *words], words)]
    report = out.parent / f"{run.name}.json"
    if words[0] in ("mesh", "clean"):
        words += ["--report", str(report)]
    done = subprocess.run([program, *words, "--quiet"], cwd=folder, capture_output=True, text=True, check=False)
    row = dict.fromkeys(COLUMNS, "-") | {"section": run.section, "run": run.name, "exit": done.returncode}
    if done.returncode not in (0, 1):
        print(f"{run.name}: {done.stderr.strip()}", file=sys.stderr)
    if report.exists():
        row |= columns_of(json.loads(report.read_text()))
    elif words[0] == "convert" and done.returncode == 0:
        written = words[words.index("-o") + 1]
        about = subprocess.run([program, "info", written, "--json"], capture_output=True, text=True, check=True)
        row |= columns_of_info(json.loads(about.stdout))
    row["files"] = digest_of_files(out)
    return [str(row[column]) for column in COLUMNS]


def sines():
    """What projections depend on, beside the program: changes where a function of the C library rounds otherwise."""
    from osgeo import gdal, osr

    functions = [math.sin, math.cos, math.tan, math.atan, math.sinh, math.asinh, math.exp, math.expm1, math.tanh]
    values = [f(0.001 * i) for f in functions for i in range(1, 3000)]
    values += [f(0.001 * i, 0.7) for f in (math.atan2, math.hypot, math.pow) for i in range(1, 3000)]
    values += [f(0.001 * i) for f in (math.log, math.log1p, math.cbrt if hasattr(math, "cbrt") else math.sqrt)
               for i in range(1, 3000)]
    digest = hashlib.sha256(b"".join(map(struct.Struct("<d").pack, values))).hexdigest()[:12]
    proj = f"{osr.GetPROJVersionMajor()}.{osr.GetPROJVersionMinor()}.{osr.GetPROJVersionMicro()}"
    return f"# sines {digest}, GDAL {gdal.VersionInfo('RELEASE_NAME')}, PROJ {proj}"


def near(got, want):
    """Whether two rows are the same but for what rounding may do."""
    got, want = dict(zip(COLUMNS, got)), dict(zip(COLUMNS, want))
    if got["exit"] != want["exit"]:
        return False
    for column in ("vertices", "triangles"):
        counts = [int(row[column].split()[0]) for row in (got, want) if row[column] != "-"]
        if len(counts) == 1 or len(counts) == 2 and abs(counts[0] - counts[1]) > 0.02 * counts[1]:
            return False
    return True


def compare(got, want, may_round):
    """Prints the lines that differ; whether all are the same. Of the runs in `may_round` they need only be near."""
    same = True
    for key in [*got, *(key for key in want if key not in got)]:
        if got.get(key) == want.get(key) or key in may_round and key in want and near(got[key], want[key]):
            continue
        same = False
        print("- " + "\t".join(want.get(key, [*key, "is not in golden.tsv"])))
        print("+ " + "\t".join(got.get(key, [*key, "is not in runs.txt"])))
    return same


def read_table():
    """Whose sines it was made with, and its rows."""
    note, heads, *lines = TABLE.read_text().splitlines()
    if heads.split("\t") != COLUMNS:
        sys.exit("golden.tsv has other columns: run scripts/update-golden")
    return note, {(row[0], row[1]): row for row in (line.split("\t") for line in lines)}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=lambda path: str(pathlib.Path(path).resolve()))
    parser.add_argument("--section", help="only this one")
    parser.add_argument("--without-slow", action="store_true")
    parser.add_argument("--update", action="store_true", help="write the table")
    options = parser.parse_args()
    if options.update and (options.section or options.without_slow):
        parser.error("--update writes the whole table")

    all_runs = declared()
    runs = [run for run in all_runs
            if options.section in (None, run.section) and not (options.without_slow and run.slow)]
    if not runs:
        sys.exit(f"runs.txt has no section {options.section}")
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        (folder / "data").symlink_to(HERE.parent.parent / "data")
        (folder / "made").mkdir()
        inputs.make(folder / "made")
        rows = {run.key: perform(run, options.program, folder) for run in runs}
    if options.update:
        TABLE.write_text("\n".join([sines(), *map("\t".join, [COLUMNS, *rows.values()])]) + "\n")
        return 0
    note, table = read_table()
    left_out = {run.key for run in all_runs} - set(rows)
    may_round = {run.key for run in runs if run.earth} if note != sines() else set()
    same = compare(rows, {key: row for key, row in table.items() if key not in left_out}, may_round)
    if may_round:
        print(f"{len(may_round)} runs on the Earth were not compared bit for bit: here it is {sines()}, there {note}")
    print(f"{len(rows)} runs" if same else "Results have changed. Where that is meant: scripts/update-golden, and say why.")
    return 0 if same else 1


if __name__ == "__main__":
    sys.exit(main())
