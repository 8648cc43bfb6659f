#!/usr/bin/env python3
"""Shows of every option of every command that it does something: option_effects.py PROGRAM

The options come from --json-usage. Each is given alone, and where it needs others also with these. It has to change
what the run leaves behind or prints, or to be warned of, or to be refused; an option that is silent fails, and so does
one that this script does not know how to set. Prints a table.
"""

import concurrent.futures
import hashlib
import json
import os
import re
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

PROGRAM = os.path.abspath(sys.argv[1])


@dataclass
class Case:
    """How an option is set, and the run in which it shows."""

    value: str | None = None  # None for a switch
    extra: list = field(default_factory=list)  # further options, also given in the run without this one
    input: str | None = None  # in place of the command's default
    name: str | None = None  # the name to use if it is not the first, such as --no-coarsen
    exists: list = field(default_factory=list)  # files that exist before the run
    report: str | None = None  # the key of the report that shows the effect
    because: str | None = None  # why it may have no effect without `extra`: that depends on the data
    mesh: bool = False  # for check: the mesh is made with the option in one run and without it in the other


def square(west, south, side, properties=None):
    ring = [[west, south], [west + side, south], [west + side, south + side], [west, south + side], [west, south]]
    return feature("Polygon", [ring], properties)


def feature(kind, coordinates, properties=None):
    return {"type": "Feature", "properties": properties or {}, "geometry": {"type": kind, "coordinates": coordinates}}


def collection(*features):
    return json.dumps({"type": "FeatureCollection", "features": list(features)})


def ascii_raster(west, south, columns, rows, cell, value):
    lines = [f"ncols {columns}", f"nrows {rows}", f"xllcorner {west}", f"yllcorner {south}", f"cellsize {cell}"]
    lines.append("NODATA_value -9999")
    for row in range(rows):
        lines.append(" ".join(f"{value(column, row):.3f}" for column in range(columns)))
    return "\n".join(lines) + "\n"


SHORE = [[-87.50, 41.600], [-87.495, 41.5985], [-87.4949, 41.5985], [-87.49, 41.598], [-87.478, 41.601],
         [-87.475, 41.61], [-87.48, 41.617], [-87.49, 41.619], [-87.501, 41.614], [-87.50, 41.600]]
ISLAND = [[-87.49, 41.605], [-87.487, 41.609], [-87.484, 41.606], [-87.49, 41.605]]
WGS84 = ('GEOGCS["GCS_WGS_1984",DATUM["D_WGS_1984",SPHEROID["WGS_1984",6378137.0,298.257223563]],'
         'PRIMEM["Greenwich",0.0],UNIT["Degree",0.0174532925199433]]')


def write_inputs(folder):
    def put(name, text):
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_text(text)

    put("lake.geojson", collection(feature("Polygon", [SHORE, ISLAND], {"name": "a", "type": "land", "other": "open"})))
    put("two.geojson", collection(square(-87.5, 41.6, 0.01, {"name": "a"}), square(-87.4, 41.6, 0.01, {"name": "b"})))
    put("one.geojson", collection(square(-87.5, 41.6, 0.01, {"name": "a"})))
    put("joined.geojson", collection(square(-87.5, 41.6, 0.01), square(-87.49, 41.6, 0.01)))
    # A shore that touches that of an island in a point.
    put("pinch.geojson", collection(feature("Polygon", [
        [[-87.5, 41.6], [-87.48, 41.6], [-87.48, 41.62], [-87.5, 41.62], [-87.5, 41.6]],
        [[-87.5, 41.6], [-87.495, 41.61], [-87.49, 41.605], [-87.5, 41.6]]])))
    put("islands.geojson", collection(square(-87.495, 41.605, 0.004), square(-87.485, 41.612, 0.003)))
    # Two lakes joined by a channel of 40 m.
    put("straits.geojson", collection(feature("Polygon", [
        [[-87.5, 41.6], [-87.485, 41.6], [-87.485, 41.6098], [-87.475, 41.6098], [-87.475, 41.6], [-87.465, 41.6],
         [-87.465, 41.62], [-87.475, 41.62], [-87.475, 41.6102], [-87.485, 41.6102], [-87.485, 41.62], [-87.5, 41.62],
         [-87.5, 41.6]]])))
    # A spit and an inlet, 80 m wide.
    put("notched.geojson", collection(feature("Polygon", [
        [[-87.5, 41.6], [-87.491, 41.6], [-87.491, 41.607], [-87.49, 41.607], [-87.49, 41.6], [-87.48, 41.6],
         [-87.48, 41.61], [-87.473, 41.61], [-87.473, 41.611], [-87.48, 41.611], [-87.48, 41.62], [-87.5, 41.62],
         [-87.5, 41.6]]])))
    # Water on both sides of a point where islands touch.
    put("hourglass.geojson", collection(feature("Polygon", [
        [[-87.5, 41.6], [-87.48, 41.6], [-87.48, 41.62], [-87.5, 41.62], [-87.5, 41.6]],
        [[-87.495, 41.605], [-87.49, 41.61], [-87.495, 41.615], [-87.495, 41.605]],
        [[-87.49, 41.61], [-87.485, 41.605], [-87.485, 41.615], [-87.49, 41.61]]])))
    put("clip.geojson", collection(square(-87.497, 41.602, 0.015)))
    put("passage.geojson", collection(feature("LineString", [[-87.488, 41.61], [-87.472, 41.61]])))
    # Both flow towards the lake from the east; the second ends 100 m short of it.
    put("rivers.geojson", collection(
        feature("LineString", [[-87.481, 41.613], [-87.47, 41.6175], [-87.46, 41.619]],
                {"width": 60, "breadth": 40, "depth": 3, "bed": 2, "name": "a", "other": "b"}),
        feature("LineString", [[-87.4768, 41.601], [-87.46, 41.598]], {"width": 60, "breadth": 40})))
    # The water of the first, 100 m wide.
    put("banks.geojson", collection(feature("Polygon", [
        [[-87.4813, 41.6125], [-87.4697, 41.6170], [-87.46, 41.6185], [-87.46, 41.6195], [-87.4703, 41.6180],
         [-87.4807, 41.6135], [-87.4813, 41.6125]]])))
    # Levels of FESOM2, without a mesh.
    put("aux3d.out", "8\n0\n-2\n-5\n-8\n-12\n-18\n-25\n-60\n")
    put("line.geojson", collection(feature("LineString", [[-87.495, 41.613], [-87.482, 41.614]])))
    put("ridge.asc", ascii_raster(-87.52, 41.58, 60, 60, 0.001, lambda x, y: 3 + 0.1 * y))
    put("region.geojson", collection(square(-87.496, 41.611, 0.004, {"name": "bay"})))
    put("points.geojson", collection(feature("Point", [-87.48, 41.611], {"size": 30.0})))
    put("other_points.geojson", collection(feature("Point", [-87.496, 41.605], {"size": 15.0})))
    put("open.geojson", collection(square(-87.505, 41.596, 0.008, {"type": "open", "other": "river"})))
    put("layers/a.csv", 'WKT,name\n"POLYGON ((0 0, 1000 0, 1000 1000, 0 1000, 0 0))",a\n')
    put("layers/b.csv", 'WKT,name\n"POLYGON ((2000 0, 3000 0, 3000 1000, 2000 1000, 2000 0))",b\n')
    # A diagonal that is not Delaunay.
    put("plain.2dm", "MESH2D\nE3T 1 1 2 3 1\nE3T 2 1 3 4 1\nND 1 0 0 0\nND 2 200 -90 0\nND 3 400 0 0\nND 4 200 90 0\n")
    put("degrees.2dm", "MESH2D\nE3T 1 1 2 3 1\nND 1 10 60 0\nND 2 10.2 60 0\nND 3 10.1 60.0866 0\n")
    # Larger than a cap of 30 degrees: its least angle is 39.8 degrees in the plane, 38.1 on the ellipsoid.
    rim = [(32, 9), (13, 30), (-10, 28), (-33, 5), (-25, -22), (3, -33), (28, -18)]
    put("great.2dm", "MESH2D\n" + "".join(f"E3T {i} 1 {i + 1} {i % 7 + 2} 1\n" for i in range(1, 8)) +
        "".join(f"ND {i} {x} {y} 0\n" for i, (x, y) in enumerate([(0, 0), *rim], 1)))
    put("great.prj", WGS84)
    put("wide.geojson", collection(feature("Polygon", [[[-94, 40], [-80, 40], [-80, 45], [-94, 45], [-94, 40]]])))
    slope = ascii_raster(-87.52, 41.58, 60, 60, 0.001, lambda x, y: -5 - 0.7 * x - 3 * ((x // 7 + y // 5) % 2))
    put("dem.asc", slope)
    put("part.asc", ascii_raster(-87.52, 41.58, 30, 60, 0.001, lambda x, y: -5 - 0.7 * x))
    put("sizes.asc", ascii_raster(-87.52, 41.58, 60, 60, 0.001, lambda x, y: 150))
    for name in ("dem", "part", "sizes", "ridge"):
        put(name + ".prj", WGS84)
    put("angle.toml", "[mesh]\nsize-max = 150\n[check]\nmin-angle = 50\n[plot]\nsize = 300\n[info]\njson = true\n"
        "[convert]\nformat = '2dm'\n[clean]\nsimplify = 300\n[partition]\nformat = 'gmsh'\n[gather]\nformat = '2dm'\n[cut]\nformat = '2dm'\n[remesh]\nformat = '2dm'\n[merge]\nformat = '2dm'\n[rivers]\nformat = '2dm'\n")


def cases():
    depths = ["--bathymetry", "dem.asc"]
    sized = ["--size", "200"]
    stepped = [*depths, "--size", "60"]
    weirs = ["--weirs", "line.geojson", "--target", "adcirc", "--size", "200"]
    box = ["--bbox", "-87.5,41.6,-87.48,41.62"]
    common = {"--config": Case("angle.toml"), "--overwrite": Case(exists=["out.nc"])}
    region = {
        "--layer": Case("a", input="layers"),
        "--where": Case("name = 'a'", input="two.geojson"),
        "--domain": Case("outside", extra=box, input="islands.geojson"),
        "--bbox": Case("-87.495,41.602,-87.48,41.615"),
        "--clip": Case("clip.geojson"),
        "--water-at": Case("-87.487,41.607"),
        "--constraints": Case("line.geojson"),
        "--weirs": Case("line.geojson"),
        "--regions": Case("region.geojson"),
        "--dissolve": Case(input="joined.geojson"),
        "--snap": Case("100"),
        "--simplify": Case("300"),
        "--min-island-area": Case("1e9"),
        "--crs": Case("EPSG:6933"),
        "--surface": Case("ellipsoid"),
        "--edges": Case("lonlat", input="wide.geojson"),
        "--edge-tolerance": Case("10000", extra=["--edges", "lonlat"], input="wide.geojson"),
    }
    finish = {
        "--bathymetry": Case("dem.asc"),
        "--depth-method": Case("average", extra=depths),
        "--depth-sign": Case("down", extra=depths),
        "--water-level": Case("2", extra=depths),
        "--min-depth": Case("30", extra=depths),
        "--depth-fill": Case("none", extra=["--bathymetry", "part.asc"]),
        "--attribute": Case("manning=0.02"),
        "--boundaries": Case("open.geojson"),
        "--boundary-column": Case("other", extra=["--boundaries", "open.geojson"]),
        "--open-deeper": Case("20", extra=depths),
        "--min-boundary": Case("100000", input="framed.gpkg"),
        "--target": Case("adcirc", input="hourglass.geojson"),
    }
    mesh = {
        **common, **region, **finish,
        "--flood-height": Case("5", extra=depths),
        "--weir-heights": Case("ridge.asc", extra=weirs),
        "--weir-search": Case("300", extra=[*weirs, "--weir-heights", "ridge.asc"]),
        "--output": Case("more.2dm"),
        "--format": Case("2dm"),
        "--min-angle": Case("15"),
        "--max-angle": Case("100"),
        "--algorithm": Case("circumcenter"),
        "--coarsen": Case(name="--no-coarsen"),
        "--size": Case("200"),
        "--size-min": Case("300", extra=sized),
        "--size-max": Case("200"),
        "--grade": Case("0.05", extra=["--size-shore", "40", "--shore-rate", "1"]),
        "--size-shore": Case("100"),
        "--shore-rate": Case("0.6", extra=["--size-shore", "40", "--grade", "1"]),
        "--channel-elements": Case("9", extra=["--size-min", "20"]),
        "--size-features": Case("points.geojson"),
        "--size-raster": Case("sizes.asc"),
        "--wave-elements": Case("4000", extra=depths),
        "--wave-period": Case("9000", extra=[*depths, "--wave-elements", "4000"]),
        "--slope-elements": Case("20", extra=[*depths, "--size-min", "50"]),
        "--slope-filter": Case("900", extra=[*depths, "--size-min", "50", "--slope-elements", "20"]),
        "--depth-band": Case("0,30,80", extra=depths),
        "--coast": Case("follow", extra=["--size", "900"]),
        "--channel-min": Case("0", input="notched.geojson", extra=["--size", "150", "--coast", "follow"]),
        "--keep-water": Case("largest", input="straits.geojson", extra=["--size", "250", "--coast", "follow"]),
        "--land-min": Case("0", input="notched.geojson", extra=["--size", "150", "--coast", "follow"]),
        "--passages": Case("passage.geojson", input="straits.geojson", extra=["--size", "150", "--coast", "follow"]),
        "--passage-elements": Case("3", input="straits.geojson",
                                   extra=["--size", "150", "--coast", "follow", "--passages", "passage.geojson"]),
        "--barriers": Case("passage.geojson", input="straits.geojson",
                           extra=["--size", "150", "--coast", "follow", "--channel-min", "0"]),
        "--strait-min": Case("0.9", input="straits.geojson", extra=["--size", "150", "--coast", "follow"]),
        "--time-step": Case("20", extra=stepped),
        "--courant": Case("0.4", extra=[*stepped, "--time-step", "20"]),
        "--courant-min": Case("1", extra=[*stepped, "--time-step", "2", "--courant", "9"]),
        "--smooth": Case(),
        "--quality": Case("centred", extra=["--size", "10"]),
        "--pinches": Case("open", input="hourglass.geojson"),
        "--max-vertices": Case("15"),
        "--cut": Case(name="--no-cut", extra=["--size-max", "11"], because="60,000 vertices are one piece"),
        "--mark-pieces": Case(),
        "--partition": Case("3"),
        "--partition-weight": Case("cost", extra=["--partition", "3", "--attribute", "cost=1", "--size", "100"]),
        "--partition-levels": Case("aux3d.out", extra=[*depths, "--partition", "3", "--size", "100"]),
        "--shard": Case("2/2", input="two.geojson"),
        "--per-feature": Case(extra=["--output", "lake-{}.nc"]),
        "--name-field": Case("name", extra=["--per-feature", "--output", "lake-{}.nc"]),
        "--skip-existing": Case(exists=["out.nc"]),
        "--checkpoint": Case("kept", report="checkpoint"),
        "--threads": Case("1", report="threads"),
        "--report": Case("report2.json"),
        "--edits": Case("edits.gpkg"),
        "--progress": Case("json"),
        "--quiet": Case(),
    }
    check = {
        "--config": Case("angle.toml"),
        "--assume-crs": Case("EPSG:4326", extra=["--min-angle", "33"], input="bare.2dm",
                             because="only angles hang on it"),
        "--input": Case("two.geojson"),
        "--target": Case("adcirc", input="hourglass.nc"),
        "--time-step": Case("1000", extra=["--target", "adcirc"], input="deep.nc"),
        "--min-angle": Case("50"),
        "--max-angle": Case("65"),
        "--surface": Case("plane", extra=["--min-angle", "39"], input="great.2dm", because="only angles hang on it"),
        "--delaunay": Case(input="plain.2dm"),
        "--pinches": Case(input="hourglass.nc"),
        "--input-pinches": Case("open", input="hourglass.geojson", mesh=True),
        "--output": Case("defects.geojson"),
        "--overwrite": Case(extra=["--output", "out.geojson"], exists=["out.geojson"]),
        "--quiet": Case(),
    }
    for name, case in region.items():
        if name == "--surface":  # has an effect without an input too
            continue
        extra = [*case.extra, *(["--min-angle", "33"] if name == "--crs" else [])]
        check[name] = Case(case.value, extra=extra, input=case.input or "lake.geojson", mesh=True)
    convert = {**finish, **common,
               "--output": Case("more.2dm"),
               "--format": Case("2dm"),
               "--quiet": Case(extra=depths, because="there is nothing to print"),
               "--assume-crs": Case("EPSG:4326", input="degrees.2dm")}
    convert["--min-boundary"] = Case("100000", input="framed.nc")
    convert["--target"] = Case("adcirc", input="hourglass.nc")
    clean = {**region,
             "--crs": Case("EPSG:6933", extra=["--output", "out.poly"], because="a layer is in the input's CRS"),
             "--surface": Case("ellipsoid", extra=["--output", "out.poly"], input="wide.geojson",
                               because="a layer is in the input's CRS"),
             "--boundary-column": Case("other"),
             "--config": Case("angle.toml"), "--pinches": Case("open", input="hourglass.geojson"),
             "--overwrite": Case(exists=["out.gpkg"]), "--output": Case("other.gpkg"),
             "--report": Case("report2.json"), "--quiet": Case()}
    plot = {"--config": Case("angle.toml"), "--output": Case("other.svg"), "--size": Case("300"),
            "--bbox": Case("-87.49,41.60,-87.48,41.61"),
            "--color": Case("angle"), "--edges": Case(name="--no-edges"), "--min-angle": Case("50"),
            "--view": Case("orthographic=-87,41"), "--degrees": Case(), "--overwrite": Case(exists=["out.svg"]), "--assume-crs": Case("EPSG:4326", input="degrees.2dm")}
    info = {"--config": Case("angle.toml"), "--surface": Case("plane", input="great.2dm"), "--json": Case(), "--assume-crs": Case("EPSG:4326", input="degrees.2dm")}
    partition = {**common, "--output": Case("more.prop"), "--format": Case("gmsh"), "--quiet": Case(),
                 "--report": Case("report2.json"), "--assume-crs": Case("EPSG:4326", input="bare.2dm")}
    partition["--partition-weight"] = Case("cost", input="deep.nc")
    partition["--partition-levels"] = Case("aux3d.out", input="deep.nc")
    gather = {"--config": Case("angle.toml"), "--output": Case("more.2dm"), "--format": Case("2dm"),
              "--partition": Case("3"), "--partition-weight": Case("cost", extra=["--partition", "3"]),
              "--partition-levels": Case("aux3d.out", extra=["--partition", "3"]),
              "--report": Case("report2.json"), "--edits": Case("edits.gpkg"),
              "--progress": Case("json"), "--overwrite": Case(exists=["out.nc"]),
              "--skip-existing": Case(exists=["out.nc"]), "--quiet": Case(), "--threads": Case("1", report="threads")}
    cut = {**common, "--output": Case("more.2dm"), "--format": Case("2dm"), "--quiet": Case(),
           "--bbox": Case("-87.495,41.602,-87.48,41.615"), "--within": Case("clip.geojson"),
           "--outside": Case("open.geojson"), "--keep-water": Case("largest", input="two.nc"),
           "--cut-boundary": Case("land"), "--target": Case("adcirc", input="hourglass.nc"),
           "--numbers": Case("numbers.csv"), "--assume-crs": Case("EPSG:4326", input="degrees.2dm")}
    remesh = {**common, "--output": Case("more.2dm"), "--format": Case("2dm"), "--quiet": Case(),
              "--bbox": Case("-87.495,41.602,-87.48,41.615"), "--within": Case("clip.geojson"),
              "--outside": Case("open.geojson"), "--target": Case("adcirc", input="hourglass.nc"),
              "--numbers": Case("numbers.csv"), "--assume-crs": Case("EPSG:4326", input="degrees.2dm")}
    for name in ("--min-angle", "--max-angle", "--size", "--size-min", "--size-max", "--grade", "--size-shore", "--shore-rate",
                 "--channel-elements", "--size-features", "--size-raster", "--wave-elements", "--wave-period",
                 "--slope-elements", "--slope-filter", "--depth-band", "--time-step", "--courant", "--courant-min"):
        remesh[name] = Case(mesh[name].value, extra=mesh[name].extra)
    for name in ("--bathymetry", "--depth-method", "--depth-sign", "--water-level", "--min-depth"):
        remesh[name] = Case(mesh[name].value, extra=mesh[name].extra)
    remesh["--size-features"] = Case("other_points.geojson")
    for name in ("--size-min", "--grade"):
        remesh[name] = Case(mesh[name].value, extra=mesh[name].extra, because="points ask for sizes already")
    # The lake is small: sizes of the shore leave little room for others.
    remesh["--slope-filter"] = Case("900", extra=[*depths, "--size-min", "5", "--slope-elements", "60", "--grade", "1"])
    remesh["--courant"] = Case("0.5", extra=[*depths, "--size", "60", "--time-step", "2"])
    merge = {**common, "--output": Case("more.2dm"), "--format": Case("2dm"), "--quiet": Case(),
             "--min-angle": Case("15"), "--max-angle": Case("90"), "--grade": Case("0.02"), "--target": Case("mpas"),
             "--numbers": Case("numbers.csv"), "--assume-crs": Case("EPSG:4326", input="bare.2dm")}
    for name in ("--bathymetry", "--depth-method", "--depth-sign", "--water-level", "--min-depth"):
        merge[name] = Case(mesh[name].value, extra=mesh[name].extra, input="deep.nc")
    rivers = {**common, "--output": Case("more.2dm"), "--format": Case("2dm"), "--quiet": Case(), "--reach": Case("0"),
              "--width-column": Case("breadth"), "--depth-column": Case("bed", input="deep.nc"), 
              "--name-column": Case("other", extra=["--output", "out.gpkg"], because="a .nc has no names"),
              "--width": Case("50", extra=["--width-column", "none"], because="lines have widths of their own"),
              "--banks": Case("banks.geojson"), "--extent": Case("all"), "--elements": Case("4"), "--max-cell-width": Case("20"), "--aspect": Case("1.5"),
              "--min-angle": Case("15"), "--max-angle": Case("90"), "--grade": Case("0.02"), "--target": Case("mpas"),
              "--numbers": Case("numbers.csv"), "--assume-crs": Case("EPSG:4326", input="bare.2dm")}
    for name in ("--bathymetry", "--depth-method", "--depth-sign", "--water-level", "--min-depth"):
        rivers[name] = Case(mesh[name].value, extra=mesh[name].extra, input="deep.nc")
    return {"mesh": mesh, "check": check, "convert": convert, "clean": clean, "plot": plot, "info": info,
            "partition": partition, "gather": gather, "cut": cut, "remesh": remesh, "merge": merge, "rivers": rivers}


INPUT = {"mesh": "lake.geojson", "clean": "lake.geojson", "check": "lake.nc", "convert": "lake.nc", "plot": "lake.nc",
         "info": "lake.nc", "partition": "lake.nc", "gather": "lake.shard", "cut": "lake.nc", "remesh": "lake.nc", "merge": "lake.nc", "rivers": "lake.nc"}
OUTPUT = {"mesh": "out.nc", "clean": "out.gpkg", "convert": "out.nc", "plot": "out.svg", "partition": "out.nc", "gather": "out.nc",
          "cut": "out.nc", "remesh": "out.nc", "merge": "out.nc", "rivers": "out.nc"}
# What has to be given after the file.
ARGUMENTS = {"partition": ["4"], "cut": ["--outside", "region.geojson"],
             "remesh": ["--outside", "region.geojson", "--size-features", "points.geojson"], "merge": ["west.nc"],
             "rivers": ["rivers.geojson"]}


class Runs:
    def __init__(self, inputs, work):
        self.inputs, self.work, self.known = inputs, work, {}

    def resolved(self, arguments):
        return [str(self.inputs / a) if (self.inputs / a).exists() else a for a in arguments]

    def run(self, command, source, options, exists=()):
        """Exit code, errors, report, and a digest of all that the run printed and left."""
        folder = Path(tempfile.mkdtemp(dir=self.work))
        for name in exists:
            (folder / name).write_text("precious")
        words = [PROGRAM, command, source, *ARGUMENTS.get(command, []), *options]
        if command in OUTPUT and "--output" not in options:
            words += ["-o", OUTPUT[command]]
        if command in ("mesh", "clean", "gather") and "--report" not in options:
            words += ["--report", "report.json"]
        done = subprocess.run(self.resolved(words), cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, text=True,
                              check=False, timeout=300)
        report = json.loads((folder / "report.json").read_text()) if (folder / "report.json").exists() else {}
        printed = re.sub(r"[\d.]+ s, \d+ MiB", "", done.stdout).replace("report2.json", "report.json")
        shown = [done.returncode, printed, sorted(p.name for p in folder.iterdir())]
        left = [p for p in sorted(folder.iterdir()) if not p.name.startswith("report")]
        shown += [hashlib.sha256(p.read_bytes()).hexdigest() for p in left]
        return done.returncode, done.stderr, report, shown


def outcome(option, without, given, key=None):
    """What the option did: changes, warns, refused, or None where it is silent."""
    code, errors, report, shown = given
    names = "|".join(map(re.escape, option["names"]))
    warnings = [line for line in errors.splitlines() if "warning: " in line and "no effect" in line]
    if any(re.search(rf"(?<![\w-])({names})(?![\w-])", line) for line in warnings):
        return "warns"
    if code >= 2 and without[0] < 2:
        return "refused" if code in (2, 3, 4) else None
    if key is not None:
        return "changes" if report.get(key) != without[2].get(key) else None
    return "changes" if shown != without[3] else None


def words_of(case, option):
    name = case.name or option["name"]
    return [name] if case.value is None else [name, case.value]


def judge(runs, command, option, case):
    """Rows of the table: how it was given, what came of it; and whether that is right."""
    given = words_of(case, option)
    source = case.input or INPUT[command]
    needed = list(case.extra)
    rows = []
    if case.mesh:
        # Meshes made with and without the option: the check sees the difference in one of them.
        seen = set()
        for made_with in ([], given):
            made_with = ["--pinches" if w == "--input-pinches" else w for w in made_with]
            mesh = f"made{len(made_with)}{option['name']}.nc"
            others = [word for word in needed if word not in ("--min-angle", "33")]
            code, errors, _, _ = runs.run("mesh", source, [*others, *made_with, "--output", str(runs.inputs / mesh)])
            if code > 1:
                return [("making a mesh", errors.strip())], False
            against = ["--input", source, *needed]
            without = runs.run("check", mesh, against)
            seen.add(outcome(option, without, runs.run("check", mesh, [*against, *given])))
        effect = next((s for s in ("changes", "warns", "refused") if s in seen), None)
        rows.append(("with --input " + " ".join(needed), effect))
        alone = outcome(option, runs.run("check", INPUT["check"], []), runs.run("check", INPUT["check"], given))
        rows.append(("alone", alone))
        return rows, effect == "changes" and alone in ("warns", "refused")
    without = runs.run(command, source, needed, case.exists)
    effect = outcome(option, without, runs.run(command, source, [*needed, *given], case.exists), case.report)
    rows.append(("with " + " ".join(needed) if needed else "alone", effect))
    good = effect == "changes"
    if needed and case.because is not None:
        rows.append(("alone, may be silent: " + case.because, "-"))
    elif needed:
        bare = runs.run(command, source, [], case.exists)
        alone = outcome(option, bare, runs.run(command, source, given, case.exists), case.report)
        rows.append(("alone", alone))
        good = good and alone is not None and (alone != "changes" if option.get("needs") else True)
    return rows, good


def main():
    usage = json.loads(subprocess.run([PROGRAM, "--json-usage"], capture_output=True, text=True, check=True).stdout)
    known, failed = cases(), 0
    with tempfile.TemporaryDirectory(prefix="coastmesh-options-") as folder:
        inputs, work = Path(folder) / "inputs", Path(folder) / "work"
        inputs.mkdir()
        work.mkdir()
        write_inputs(inputs)
        runs = Runs(inputs, work)
        frame = ["--bbox", "-87.51,41.603,-87.48,41.63"]
        for name, options in {"lake.nc": ["lake.geojson"], "two.nc": ["two.geojson"], "hourglass.nc": ["hourglass.geojson"],
                              "deep.nc": ["lake.geojson", "--bathymetry", "dem.asc", "--attribute", "cost=1"],
                              "bare.2dm": ["lake.geojson"], "lake.shard": [str(inputs / "lake.geojson"), "--attribute", "cost=1"],
                              "framed.nc": ["lake.geojson", *frame]}.items():
            made = runs.run("mesh", options[0], [*options[1:], "--output", str(inputs / name)])
            if made[0] != 0:
                sys.exit(f"cannot make {name}: {made[1]}")
        (inputs / "bare.prj").unlink()
        runs.run("mesh", "lake.geojson", ["--size", "100", "--output", str(inputs / "fine.nc")])
        made = runs.run("cut", "fine.nc", ["--bbox", "-88,41,-87.4865,42", "--output", str(inputs / "west.nc")])
        if made[0] != 0:
            sys.exit(f"cannot make west.nc: {made[1]}")
        made = runs.run("clean", "lake.geojson", [*frame, "--output", str(inputs / "framed.gpkg")])
        if made[0] != 0:
            sys.exit(f"cannot make framed.gpkg: {made[1]}")
        jobs = []
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            for command in usage["commands"]:
                verb = command["command"]
                stale = set(known.get(verb, {})) - {option["name"] for option in command["options"]}
                for name in sorted(stale):
                    print(f"{verb:8} {name:18} is no option: take it out of this script")
                    failed += 1
                for option in command["options"]:
                    case = known.get(verb, {}).get(option["name"])
                    jobs.append((verb, option, case, pool.submit(judge, runs, verb, option, case) if case else None))
            for verb, option, case, job in jobs:
                if case is None:
                    print(f"{verb:8} {option['name']:18} UNKNOWN: say in this script how it is set and where it shows")
                    failed += 1
                    continue
                rows, good = job.result()
                for how, effect in rows:
                    mark = "" if good else "   <-- not as it should be"
                    print(f"{verb:8} {option['name']:18} {effect or 'SILENT':8} {how}{mark}")
                failed += not good
    print(f"{len(jobs)} options, {failed} of them not as they should be")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
