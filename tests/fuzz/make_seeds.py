#!/usr/bin/env python3
"""Seeds for the fuzzing of readers, made by the program itself.

Writes small files of each kind to FOLDER/READER/; where a reader takes several, one after another, as reader_cases.hpp
says. With --replay, each has to be read again.
"""
import argparse
import json
import pathlib
import shutil
import subprocess
import tempfile

NEXT_FILE = b"\n%%%%\n"

# By reader: the files of an output with the first of these names, and its format.
GRIDS = {
    "adcirc": (["s.14"], "adcirc"),
    "schism": (["s.gr3"], "schism"),
    "telemac": (["s.slf", "s.cli"], "telemac"),
    "2dm": (["s.2dm"], "2dm"),
    "mike": (["s.mesh"], "mike"),
    "ugrid": (["s.nc"], "ugrid"),
    "mpas": (["s_mpas.nc"], "mpas"),
    "vtu": (["s.vtu"], "vtu"),
    "triangle": (["s.ele", "s.node", "s.poly"], "triangle"),
    "fvcom": (["s_grd.dat", "s_dep.dat", "s_obc.dat", "s_cor.dat"], "fvcom"),
    "fesom": (["nod2d.out", "elem2d.out", "aux3d.out"], "fesom"),
    "jigsaw": (["s_jigsaw.msh"], "jigsaw"),
    "geojson_mesh": (["s.geojson", "s_nodes.geojson", "s_boundaries.geojson", "s_lines.geojson"], "geojson"),
    "gpkg_mesh": (["s.gpkg"], "gpkg"),
}
GMSH = {"gmsh": "s.msh", "gmsh22": "s_22.msh", "ww3": "s_ww3.msh"}


def polygon(*rings, **properties):
    closed = [ring + ring[:1] for ring in rings]
    return {"type": "Feature", "properties": properties, "geometry": {"type": "Polygon", "coordinates": closed}}


def line(points, **properties):
    return {"type": "Feature", "properties": properties, "geometry": {"type": "LineString", "coordinates": points}}


def point(place, **properties):
    return {"type": "Feature", "properties": properties, "geometry": {"type": "Point", "coordinates": place}}


LAKE = [polygon([[0, 0], [4, 0], [4, 3], [0, 3]], [[1, 1], [1, 2], [2, 2], [2, 1]], name="lake")]
ACROSS = [polygon([[178, -18], [-178, -18], [-178, -15], [180, -14], [178, -15]]),
          polygon([[-180, -20], [180, -20.5], [179.5, -21]])]
CROSSED = [polygon([[0, 0], [2, 2], [2, 0], [0, 2]]), polygon([[1, 0], [3, 0], [3, 3], [1, 3]]),
           polygon([[5, 0], [6, 0], [7, 0], [6, 0], [6, 1]])]
COAST = [line([[-1, 1.5], [2, 1], [5, 1.5]]), line([[1, 2], [2, 2], [2, 2.5], [1, 2]])]
KINDS = [line([[-0.1, 0], [4.1, 0]], type="open"), polygon([[3.9, -1], [5, -1], [5, 4], [3.9, 4]], type="river"),
         line([[0, -0.1], [0, 3.1]], type="52")]
SIZES = [point([1, 1], size=500, rate=0.1), line([[0, 0], [3, 2]], size=1000), polygon([[0, 0], [1, 0], [1, 1]], size=9)]
OTHERS = [{"type": "Feature", "properties": None, "geometry": None},
          {"type": "Feature", "id": 7, "properties": {"a": None, "b": [1]}, "geometry": {
              "type": "GeometryCollection", "geometries": [
                  {"type": "MultiPolygon", "coordinates": [[[[0, 0, 5], [1, 0, 5], [1, 1, 5], [0, 0, 5]]]]},
                  {"type": "MultiLineString", "coordinates": [[[0.3, 0.1], [0.4, 0.2]], [[0.5, 0.1], [0.8, 0.3], [0.9, 0.1]]]},
                  {"type": "MultiPoint", "coordinates": [[0, 0]]}]}}]

RASTER = """ncols 6
nrows 5
xllcorner -1
yllcorner -1
cellsize 1
NODATA_value -9999
""" + "\n".join(" ".join(str(-10 - i - j) if i != j else "-9999" for i in range(6)) for j in range(5)) + "\n"

TOML = """# a job
size = 500
size-max = 2e4
bbox = "0,0,4,3"
min-angle = 30.5
dissolve = true
clip = "a.geojson"
bathymetry = ["a.tif", 'b.tif']

[mesh]
domain = "outside"
constraints = [
  "a.gpkg", "b.gpkg" ] # two
[clean]
snap = 0.01
"""
CONFIG = {"size": 500, "bathymetry": ["a.tif"], "min-angle": 30.5, "bbox": "0,0,4,3",
          "mesh": {"domain": "outside", "dissolve": True, "constraints": ["a.gpkg", "b.gpkg"]}, "clean": {"snap": 0.01}}


REFUSED = {("geojson", "coast"), ("geojson", "none")}  # lines alone close nothing


# Coasts as tools of models write them.
LINE_FILES = {
    "ldb": "* a lake, another one in two parts, and a place\nL1\n4 2\n0 0\n3 0\n3 3\n0 0\nL2\n6 3\n5 0 -1\n6 0 -2.5\n"
           "999.999 999.999\n6 0\n6 1D0 label\n5 0\nP\n1 2\n4 4\n",
    "i2s": "# a lake\n:FileType i2s ASCII EnSim 1.0\n:Projection LatLong\n:EndHeader\n4 1.5\n0 0\n3 0\n3 3\n0 0\n4 0\n5 0\n6 0\n6 1\n5 0\n",
    "bln": '4,1,"a lake"\n0,0\n3,0\n3,3\n0,0\n4 0\n5 0\n6 0\n6 1\n5 0\n',
}


def collection(features):
    return json.dumps({"type": "FeatureCollection", "features": features}).encode()


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--replay", type=pathlib.Path, help="the program coastmesh_reader_replay")
    arguments = parser.parse_args()
    program, folder = arguments.program.resolve(), arguments.folder.resolve()
    shutil.rmtree(folder, ignore_errors=True)

    def keep(reader, name, *contents):
        target = folder / reader
        target.mkdir(parents=True, exist_ok=True)
        (target / name).write_bytes(NEXT_FILE.join(contents))

    with tempfile.TemporaryDirectory() as scratch:
        at = pathlib.Path(scratch)

        def run(*arguments):
            subprocess.run([program, *map(str, arguments)], check=True, cwd=at, stdout=subprocess.DEVNULL,
                           stderr=subprocess.DEVNULL)

        (at / "lake.geojson").write_bytes(collection(LAKE))
        (at / "kinds.geojson").write_bytes(collection(KINDS))
        (at / "weir.geojson").write_bytes(collection([line([[2.5, 0.5], [3.5, 2.5]], name="North")]))
        (at / "depths.asc").write_text(RASTER)
        run("mesh", "lake.geojson", "-o", "mesh.gpkg", "--bathymetry", "depths.asc", "--boundaries", "kinds.geojson",
            "--constraints", "weir.geojson", "--size-max", "200000")
        run("mesh", "lake.geojson", "-o", "bare.gpkg", "--crs", "plane")
        for mesh in ("mesh", "bare"):
            for reader, (files, fmt) in GRIDS.items():
                target = at / mesh / reader
                target.mkdir(parents=True)
                try:
                    run("convert", f"{mesh}.gpkg", "-o", target / files[0], "--format", fmt)
                except subprocess.CalledProcessError:
                    continue  # formats for the whole Earth refuse a plane
                keep(reader, mesh, *(p.read_bytes() if (p := target / f).exists() else b"" for f in files))
            for fmt, name in GMSH.items():
                run("convert", f"{mesh}.gpkg", "-o", at / mesh / name, "--format", fmt)
                keep("gmsh", f"{mesh}_{fmt}", (at / mesh / name).read_bytes())
            keep("poly", mesh, (at / mesh / "triangle" / "s.poly").read_bytes(),
                 (at / mesh / "triangle" / "s.node").read_bytes())
        run("clean", "lake.geojson", "-o", "clean.poly")
        keep("poly", "clean", (at / "clean.poly").read_bytes())
        (at / "crossed.geojson").write_bytes(collection(CROSSED))
        for name in ("lake", "crossed"):
            run("clean", f"{name}.geojson", "-o", f"{name}_clean.gpkg")
            keep("cleaned_gpkg", name, (at / f"{name}_clean.gpkg").read_bytes())

        run("mesh", "lake.geojson", "--shard", "1/1", "-o", "lake.shard")
        keep("shard", "lake", (at / "lake.shard").read_bytes()[:-8])  # without the checksum, which reader_cases adds

    for name, features in {"lake": LAKE, "across": ACROSS, "crossed": CROSSED, "coast": COAST, "others": OTHERS,
                           "none": []}.items():
        keep("geojson", name, collection(features))
    keep("geojson", "geometry", json.dumps(LAKE[0]["geometry"]).encode())
    keep("boundaries", "kinds", collection(KINDS))
    keep("sizes", "sizes", collection(SIZES))
    for reader, text in LINE_FILES.items():
        keep(reader, "coast", text.encode())
    keep("raster", "depths", RASTER.encode())
    keep("toml", "job", TOML.encode())
    keep("json", "job", json.dumps(CONFIG, indent=1).encode())

    if arguments.replay is None:
        return
    refused = []
    for reader in sorted(p for p in folder.iterdir()):
        files = sorted(reader.iterdir())
        told = subprocess.run([arguments.replay.resolve(), reader.name, *files], stdout=subprocess.PIPE, text=True)
        lines = told.stdout.splitlines()
        if told.returncode != 0 or len(lines) != len(files):
            refused.append(f"{reader.name}: exit code {told.returncode}")
        refused += [line for file, line in zip(files, lines)
                    if line.endswith(": read") == ((reader.name, file.name) in REFUSED)]
    print(*refused, sep="\n")
    raise SystemExit(1 if refused else 0)


if __name__ == "__main__":
    main()
