#!/usr/bin/python3
"""Meshes a lake and a sea with a synthetic DEM, in one command each into the formats of all models, and reads them with
readers of its own and with netCDF4: sound grids, right depths, boundaries as drawn. Exit code 1 for a difference, else 77
where a Python module that is needed is not installed.

  check_models.py --program build/release/bin/coastmesh --lake data/lake_superior.geojson [--keep DIR] [--dem-mib 64]

The DEM is written as a GeoTIFF of that size; with some thousand MiB it shows that memory does not grow with it.
"""

import argparse
import importlib.util
import json
import math
import pathlib
import subprocess
import sys
import tempfile

import strict_readers as readers

OUTPUTS = ["fort.14", "hgrid.gr3", "mesh.nc", "mesh.msh", "mesh.slf", "mesh_grd.dat", "mesh.2dm", "mesh.mesh", "mesh.vtu",
           "mesh_ww3.msh"]
failed, missing = [], set()


def expect(what, condition, detail=""):
    print(f"  {'ok    ' if condition else 'FAILED'} {what} {'' if condition else detail}")
    if not condition:
        failed.append(what)


def elevation(x, y):
    """Smooth, and deep everywhere."""
    return -120.0 - 60.0 * math.sin(x / 2.0) * math.cos(y / 3.0) - 2.0 * (x % 360.0 - 180.0) / 100.0


def write_dem(path, west, south, east, north, mib):
    import numpy
    from osgeo import gdal, osr

    gdal.UseExceptions()
    gdal.SetCacheMax(64 * 2**20)  # the memory of this process would count for the program that it starts
    side = int(math.sqrt(mib * 2**20 / 4))
    dem = gdal.GetDriverByName("GTiff").Create(str(path), side, side, 1, gdal.GDT_Float32, ["TILED=YES", "BIGTIFF=YES"])
    dx, dy = (east - west) / side, (north - south) / side
    dem.SetGeoTransform((west, dx, 0, north, 0, -dy))
    srs = osr.SpatialReference()
    srs.ImportFromEPSG(4326)
    dem.SetProjection(srs.ExportToWkt())
    x = west + (numpy.arange(side) + 0.5) * dx
    for first in range(0, side, 256):
        rows = min(256, side - first)
        y = north - (numpy.arange(first, first + rows) + 0.5) * dy
        z = -120.0 - 60.0 * numpy.sin(x / 2.0)[None, :] * numpy.cos(y / 3.0)[:, None]
        z -= (2.0 * (x % 360.0 - 180.0) / 100.0)[None, :]
        dem.GetRasterBand(1).WriteArray(z.astype(numpy.float32), 0, first)
    dem = None
    return max(dx, dy)


def check_depths(name, grid, tolerance):
    worst = max(abs(-d - elevation(x, y)) for (x, y), d in zip(grid["nodes"], grid["depth"]))
    expect(f"{name}: depths within {tolerance:.2g} m", worst <= tolerance, f"{worst} m")


def run(program, arguments, report):
    done = subprocess.run([program, *arguments, "--report", str(report), "--overwrite", "--quiet"], check=False)
    expect("exit code", done.returncode in (0, 1), str(done.returncode))
    return json.loads(report.read_text())


def check_case(name, program, folder, arguments, targets, dem, tolerance, is_open):
    print(name)
    outputs = [arg for output in OUTPUTS for arg in ("-o", str(folder / output))]
    models = [arg for target in targets for arg in ("--target", target)]
    report = run(program, ["mesh", *arguments, "--bathymetry", str(dem), *models, *outputs], folder / "report.json")
    print(f"  {report['mesh']['vertices']} vertices, {report['peak_memory_mib']:.0f} MiB at most")
    grids = {}
    for output, read in [
        ("fort.14", readers.read_fort14),
        ("hgrid.gr3", lambda path: readers.read_fort14(path, schism=True)),
        ("hgrid.ll", lambda path: readers.read_fort14(path, schism=True)),
        ("mesh.slf", readers.read_selafin),
        ("mesh_grd.dat", readers.read_fvcom),
        ("mesh.2dm", readers.read_2dm),
        ("mesh.mesh", readers.read_mike),
    ]:
        try:
            grids[output] = read(folder / output)
            expect(f"{output}: accepted", True)
        except readers.Refused as refusal:
            expect(f"{output}: accepted", False, str(refusal))
    for output, grid in grids.items():
        expect(f"{output}: same nodes", grid["nodes"] == grids["fort.14"]["nodes"])
        expect(f"{output}: same triangles", grid["triangles"] == grids["fort.14"]["triangles"])
        check_depths(output, grid, tolerance)
        if "open" in grid:
            middles = [
                ((grid["nodes"][a][0] + grid["nodes"][b][0]) / 2, (grid["nodes"][a][1] + grid["nodes"][b][1]) / 2, True)
                for s in grid["open"]
                for a, b in zip(s, s[1:])
            ] + [
                ((grid["nodes"][a][0] + grid["nodes"][b][0]) / 2, (grid["nodes"][a][1] + grid["nodes"][b][1]) / 2, False)
                for s in grid["land"]
                for a, b in zip(s, s[1:])
            ]
            expect(f"{output}: boundaries as drawn", all(is_open(x, y) == o for x, y, o in middles))
        if "open_nodes" in grid and "fort.14" in grids:
            nodes = {n for s in grids["fort.14"]["open"] for n in s}
            expect(f"{output}: open nodes", grid["open_nodes"] == nodes)
    mesh = grids["fort.14"]["nodes"], grids["fort.14"]["triangles"]
    for model, check in [
        ("swan", lambda: readers.check_swan(*mesh, readers.check_mesh(*mesh))),
        ("dflowfm", lambda: readers.check_dflowfm(*mesh)),
    ]:
        try:
            check()
            expect(f"{model}: shapes accepted", True)
        except readers.Refused as refusal:
            expect(f"{model}: shapes accepted", False, str(refusal))
    try:
        import netCDF4

        data = netCDF4.Dataset(folder / "mesh.nc")
        expect("mesh.nc: z positive up", data["mesh2d_node_z"].positive == "up")
        expect("mesh.nc: z", [-z for z in data["mesh2d_node_z"][:].tolist()] == grids["fort.14"]["depth"])
    except ImportError:
        missing.add("netCDF4")
    for target in targets:
        for output in OUTPUTS[:-1]:
            code = subprocess.run([program, "check", str(folder / output), "--target", target, "--quiet"]).returncode
            expect(f"{output}: nothing that {target} refuses", code == 0)
    for output in OUTPUTS:
        again = folder / "again"
        again.mkdir(exist_ok=True)
        subprocess.run([program, "convert", str(folder / output), "-o", str(again / output), "--overwrite"], check=True)
        same = (again / output).read_bytes() == (folder / output).read_bytes()
        expect(f"{output}: the same bytes when it is read and written", same)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", required=True)
    parser.add_argument("--lake", required=True, help="a lake in longitudes and latitudes")
    parser.add_argument("--keep", type=pathlib.Path, help="folder for the files; else a temporary one")
    parser.add_argument("--dem-mib", type=int, default=16)
    options = parser.parse_args()
    if not (importlib.util.find_spec("numpy") and importlib.util.find_spec("osgeo")):
        print("SKIPPED for want of numpy and GDAL's Python module", file=sys.stderr)
        return 77
    with tempfile.TemporaryDirectory() as temporary:
        folder = options.keep or pathlib.Path(temporary)
        folder.mkdir(exist_ok=True)
        targets = ["adcirc", "schism", "fvcom", "telemac", "mike", "dflowfm", "swan"]
        pixel = write_dem(folder / "lake_dem.tif", -93.0, 46.0, -84.0, 50.0, options.dem_mib)
        lake = folder / "lake"
        lake.mkdir(exist_ok=True)
        check_case("Lake", options.program, lake, [options.lake], targets, folder / "lake_dem.tif",
                   60 * pixel**2 / 4 + 1e-3, lambda x, y: False)
        pixel = write_dem(folder / "sea_dem.tif", -1.0, 49.0, 11.0, 61.0, options.dem_mib)
        land = folder / "land.geojson"
        rings = [
            [[-2, 49], [3, 49], [4, 51.3], [2.2, 53.1], [5.5, 55.0], [3.1, 57.3], [1.5, 62], [-2, 62], [-2, 49]],
            [[6, 56], [6.5, 56.2], [6.3, 56.6], [5.9, 56.5], [6, 56]],
        ]
        land.write_text(json.dumps({"type": "FeatureCollection", "features": [
            {"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": [ring]}} for ring in rings]}))
        sea = folder / "sea"
        sea.mkdir(exist_ok=True)
        frame = ["--domain", "outside", "--bbox", "0,50,10,60", "--size-max", "30000"]
        on_frame = lambda x, y: abs(x) < 1e-3 or abs(x - 10) < 1e-3 or abs(y - 50) < 1e-3 or abs(y - 60) < 1e-3
        check_case("Sea", options.program, sea, [str(land), *frame], targets, folder / "sea_dem.tif",
                   60 * pixel**2 / 4 + 1e-3, on_frame)
    if missing:
        print(f"SKIPPED for want of: {', '.join(sorted(missing))}", file=sys.stderr)
    print(f"{len(failed)} failures")
    return 1 if failed else 77 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
