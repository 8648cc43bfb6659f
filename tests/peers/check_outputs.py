#!/usr/bin/python3
"""Opens what coastmesh writes with independent programs and compares it, number by number.

  check_outputs.py --program build/release/bin/coastmesh [--require-all]
  check_outputs.py --folder DIR --stem lake --crs EPSG:4326 [--require-all]

The first form meshes a lake with an island in geographic and in projected coordinates and in a plane; the second checks
files that are there. What is compared with is Triangle's .node and .ele, read here. A peer that is not installed is
skipped with a line on standard error; the exit code is 1 for a difference, else 77 if something was skipped (1 with
--require-all), else 0.
"""

import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

FORMATS = ["nc", "2dm", "msh", "gpkg", "geojson", "shp", "fgb", "node", "vtu"]
MSH22 = "_22.msh"

SHORE = [(-87.50, 43.10), (-87.30, 43.08), (-87.20, 43.20), (-87.25, 43.33), (-87.45, 43.30), (-87.52, 43.20)]
ISLAND = [(-87.40, 43.18), (-87.42, 43.22), (-87.36, 43.24), (-87.33, 43.20)]
WEIR, WEIR_NAME = [(-87.48, 43.20), (-87.46, 43.17), (-87.45, 43.13)], "Old dam"
REGION, REGION_NAME = [(-87.31, 43.25), (-87.25, 43.25), (-87.25, 43.29), (-87.31, 43.29)], "deep water"
LINE_NAMES = [f"region border {REGION_NAME}", f"weir {WEIR_NAME}"]

skipped, failed = set(), []


class Skip(Exception):
    """A peer is not there."""


def need(module):
    try:
        return __import__(module)
    except ImportError:
        raise Skip(f"the Python module {module}") from None


def expect(what, got, want):
    if got != want:
        failed.append(what)
        print(f"FAILED {what}: {str(got)[:200]} where {str(want)[:200]} is expected", file=sys.stderr)


class Mesh:
    """Nodes and triangles as Triangle's files have them, numbered from 0."""

    def __init__(self, folder, stem):
        def rows(ending):
            with open(folder / (stem + ending)) as file:
                lines = [line.split() for line in file]
            return lines[1 : 1 + int(lines[0][0])]

        self.nodes = [(float(row[1]), float(row[2])) for row in rows(".node")]
        self.triangles = [tuple(int(n) - 1 for n in row[1:4]) for row in rows(".ele")]
        segments = [line.split() for line in open(folder / (stem + ".poly"))][2:]
        edges = [(int(row[1]) - 1, int(row[2]) - 1, int(row[3]) % 10) for row in segments if len(row) == 4]
        self.boundary = sorted((a, b) for a, b, kind in edges if kind <= 4)
        self.lines = sorted(tuple(sorted((a, b))) for a, b, kind in edges if kind > 4)

    def corners(self):
        return sorted(sorted(self.nodes[n] for n in triangle) for triangle in self.triangles)


def check_netcdf4(path, mesh, crs):
    netcdf4 = need("netCDF4")
    data = netcdf4.Dataset(path)
    data.set_auto_mask(False)
    topology = data["mesh2d"]
    expect("netCDF4: cf_role", topology.cf_role, "mesh_topology")
    x, y = (data[name][:].tolist() for name in topology.node_coordinates.split())
    expect("netCDF4: nodes", list(zip(x, y)), mesh.nodes)
    faces = data[topology.face_node_connectivity]
    expect("netCDF4: triangles", [tuple(row - faces.start_index) for row in faces[:]], mesh.triangles)
    edges = data[topology.edge_node_connectivity]
    want = {tuple(sorted((t[i], t[i - 1]))) for t in mesh.triangles for i in range(3)}
    expect("netCDF4: edges", [tuple(row - edges.start_index) for row in edges[:]], sorted(want))
    boundary = data[topology.boundary_node_connectivity]
    expect("netCDF4: boundary", sorted(tuple(row - boundary.start_index) for row in boundary[:]), mesh.boundary)
    if mesh.lines:
        number = data["mesh2d_edge_line"]
        inside = [tuple(row - edges.start_index) for row, line in zip(edges[:], number[:]) if line > 0]
        expect("netCDF4: lines", sorted(tuple(map(int, edge)) for edge in inside), mesh.lines)
        names = [str(name).rstrip("\0") for name in data["mesh2d_line_name"][:]]  # decoded by netCDF4
        expect("netCDF4: names of lines", sorted(names), sorted([WEIR_NAME, REGION_NAME]))
        expect("netCDF4: meanings", len(number.flag_meanings.split()), len(number.flag_values))
        regions = [str(name).rstrip("\0") for name in data["mesh2d_region_name"][:]]
        expect("netCDF4: regions", regions, [REGION_NAME])
        expect("netCDF4: triangles of regions", sorted(set(data["mesh2d_region"][:].tolist())), [0, 1])
    mapping = getattr(data["mesh2d_node_x"], "grid_mapping", None)
    expect("netCDF4: CRS", data[mapping].EPSG_code if mapping else "", crs)


def check_xarray_names(path, mesh, crs):
    """What xugrid and CF readers look for, without them."""
    netcdf4 = need("netCDF4")
    data = netcdf4.Dataset(path)
    expect("UGRID: conventions", "UGRID-1.0" in data.Conventions and "CF-1.8" in data.Conventions, True)
    names = {"EPSG:4326": ("longitude", "latitude")}.get(crs, ("projection_x_coordinate", "projection_y_coordinate"))
    got = tuple(data[name].standard_name for name in data["mesh2d"].node_coordinates.split())
    expect("UGRID: standard names", got, names)


def check_meshio(path, mesh, _):
    meshio = need("meshio")
    read = meshio.read(path)
    points = [tuple(point[:2]) for point in read.points.tolist()]
    triangles = [tuple(row) for block in read.cells if block.type == "triangle" for row in block.data.tolist()]
    if path.suffix == ".vtu" or path.name.endswith(MSH22):
        expect(f"meshio {path.name}: nodes", points, mesh.nodes)
        expect(f"meshio {path.name}: triangles", triangles, mesh.triangles)
    corners = sorted(sorted(points[n] for n in triangle) for triangle in triangles)
    expect(f"meshio {path.name}: corners", corners, mesh.corners())
    if path.suffix == ".msh":
        names = sorted(name for name, (_, dimension) in read.field_data.items() if dimension == 1)
        expect(f"meshio {path.name}: curves", names, ["island 2", "land 1"] + (LINE_NAMES if mesh.lines else []))
        surfaces = [name for name, (_, dimension) in read.field_data.items() if dimension == 2]
        named = any(name.endswith(f" in {REGION_NAME}") for name in surfaces)
        expect(f"meshio {path.name}: a surface named by its region", named, bool(mesh.lines))
        lines = [tuple(row) for block in read.cells if block.type == "line" for row in block.data.tolist()]
        ends = sorted(tuple(sorted((points[a], points[b]))) for a, b in lines)
        wanted = sorted(tuple(sorted((mesh.nodes[a], mesh.nodes[b]))) for a, b in mesh.boundary + mesh.lines)
        expect(f"meshio {path.name}: lines", ends, wanted)
        groups = [row for block in read.cell_data["gmsh:physical"] for row in block.tolist()]
        expect(f"meshio {path.name}: every element in a group", min(groups) > 0, True)


def check_gmsh(path, mesh, _):
    if not shutil.which("gmsh"):
        raise Skip("the program gmsh")
    run = subprocess.run(["gmsh", "-check", str(path)], capture_output=True, text=True)
    complaints = [line for line in (run.stdout + run.stderr).splitlines() if re.match(r"(Error|Warning)", line)]
    expect(f"gmsh -check {path.name}", (run.returncode, complaints), (0, []))
    found = re.search(r"(\d+) nodes", run.stdout)
    expect(f"gmsh {path.name}: nodes", found and int(found[1]), len(mesh.nodes))


def check_qgis(path, mesh, crs):
    need("qgis")
    from qgis.core import QgsMeshLayer

    layer = QgsMeshLayer(str(path), "mesh", "mdal")
    expect(f"QGIS {path.name}: valid", layer.isValid(), True)
    if not layer.isValid():
        return
    provider = layer.dataProvider()
    counts = (provider.vertexCount(), provider.faceCount())
    expect(f"QGIS {path.name}: counts", counts, (len(mesh.nodes), len(mesh.triangles)))
    # MDAL finds no CRS for .2dm, even with a .prj.
    expect(f"QGIS {path.name}: CRS", layer.crs().authid(), crs if path.suffix == ".nc" else "")
    extent = layer.extent()
    x, y = [p[0] for p in mesh.nodes], [p[1] for p in mesh.nodes]
    got = (extent.xMinimum(), extent.yMinimum(), extent.xMaximum(), extent.yMaximum())
    expect(f"QGIS {path.name}: extent", got, (min(x), min(y), max(x), max(y)))


def open_layer(ogr, path, name):
    if path.suffix != ".gpkg":
        path = path if name == "triangles" else path.with_name(f"{path.stem}_{name}{path.suffix}")
    dataset = ogr.Open(str(path))
    if dataset is None:
        failed.append(str(path))
        print(f"FAILED GDAL: {path.name} does not open", file=sys.stderr)
        return None, None
    return dataset, dataset.GetLayerByName(name) if path.suffix == ".gpkg" else dataset.GetLayer(0)


def check_gdal(path, mesh, crs):
    need("osgeo")
    from osgeo import ogr

    ogr.UseExceptions()
    counts = {"triangles": len(mesh.triangles), "nodes": len(mesh.nodes), "boundaries": 2}
    if mesh.lines:
        counts["lines"] = 2
    for name, count in counts.items():
        dataset, layer = open_layer(ogr, path, name)
        if layer is None:
            continue
        expect(f"GDAL {path.name} {name}: count", layer.GetFeatureCount(), count)
        reference = layer.GetSpatialRef()
        # GDAL assumes WGS 84 for GeoJSON without a CRS, with three dimensions if there is a third coordinate.
        if crs:
            code = f"{reference.GetAuthorityName(None)}:{reference.GetAuthorityCode(None)}"
            if path.suffix == ".geojson":
                code = code.replace("4979", "4326")
            expect(f"GDAL {path.name} {name}: CRS", code, crs)
        fields = [field.GetName() for field in layer.schema]
        wanted = {
            "triangles": ["min_angle", "area_m2"] + (["region"] if mesh.lines else []),
            "nodes": [],
            "boundaries": ["role", "closed", "length_m"],
            "lines": ["kind", "name", "closed", "length_m"],
        }[name]
        expect(f"GDAL {path.name} {name}: fields", [field for field in wanted if field not in fields], [])
        if name == "triangles":
            rings = [feature.GetGeometryRef().GetGeometryRef(0) for feature in layer_features(layer)]
            corners = sorted(sorted((r.GetX(i), r.GetY(i)) for i in range(3)) for r in rings)
            expect(f"GDAL {path.name}: corners", corners, mesh.corners())
        if name == "nodes":
            places = sorted((f.GetGeometryRef().GetX(), f.GetGeometryRef().GetY()) for f in layer_features(layer))
            expect(f"GDAL {path.name}: nodes", places, sorted(mesh.nodes))
        if name == "lines":
            found = sorted(f"{feature.GetField('kind')} {feature.GetField('name')}" for feature in layer_features(layer))
            expect(f"GDAL {path.name}: lines", found, LINE_NAMES)
        if name == "boundaries":
            roles = sorted(feature.GetField("role") for feature in layer_features(layer))
            expect(f"GDAL {path.name}: roles", roles, ["island", "land"])
        del dataset


kept = []


def layer_features(layer):
    """All features, kept alive: their geometries are borrowed."""
    kept[:] = list(layer)
    return kept


def check_spatial_index(path, *_):
    import sqlite3

    with sqlite3.connect(path) as database:
        for name in ("triangles", "nodes", "boundaries"):
            try:
                answer = database.execute(f"SELECT rtreecheck('rtree_{name}_geom')").fetchone()[0]
            except sqlite3.OperationalError as error:
                if "no such function" in str(error):
                    raise Skip("SQLite with rtreecheck") from None
                raise
            expect(f"SQLite {path.name}: index of {name}", answer, "ok")


def checks_for(path):
    if path.suffix == ".nc":
        return [check_netcdf4, check_xarray_names, check_qgis]
    if path.suffix == ".2dm":
        return [check_qgis]
    if path.suffix == ".msh":
        return [check_meshio, check_gmsh]
    if path.suffix == ".vtu":
        return [check_meshio]
    if path.suffix == ".gpkg":
        return [check_gdal, check_spatial_index]
    if path.suffix in (".geojson", ".shp", ".fgb"):
        return [check_gdal]
    return []


def check_folder(folder, stem, crs):
    mesh = Mesh(folder, stem)
    print(f"{folder}: {len(mesh.nodes)} nodes, {len(mesh.triangles)} triangles, {crs or 'plane'}")
    for name in [f"{stem}.{ending}" for ending in FORMATS] + [stem + MSH22]:
        path = folder / name
        if not path.exists():
            expect(f"{name}: written", False, True)
            continue
        for check in checks_for(path):
            before = len(failed)
            try:
                check(path, mesh, crs)
            except Skip as missing:
                if str(missing) not in skipped:
                    print(f"SKIPPED all that needs {missing}", file=sys.stderr)
                skipped.add(str(missing))
                continue
            print(f"  {'ok    ' if len(failed) == before else 'FAILED'} {check.__name__[6:]} {name}")


def utm16(longitude, latitude):
    """Metres near enough to those of EPSG:32616 for a lake somewhere there."""
    return (500000 + (longitude + 87) * 81500, 4772000 + (latitude - 43.1) * 111100)


def write_geojson(path, place, crs):
    rings = [[place(*p) for p in ring + ring[:1]] for ring in (SHORE, ISLAND)]
    feature = {"type": "Feature", "properties": {"name": "Lake"}, "geometry": {"type": "Polygon", "coordinates": rings}}
    collection = {"type": "FeatureCollection", "features": [feature]}
    if crs:
        collection["crs"] = {"type": "name", "properties": {"name": crs}}
    path.write_text(json.dumps(collection))


def write_named(path, kind, coordinates, name, place, crs):
    """A layer with one line or polygon and its name."""
    points = [place(*p) for p in coordinates]
    geometry = {"type": kind, "coordinates": points if kind == "LineString" else [points + points[:1]]}
    collection = {"type": "FeatureCollection", "features": []}
    collection["features"].append({"type": "Feature", "properties": {"name": name}, "geometry": geometry})
    if crs:
        collection["crs"] = {"type": "name", "properties": {"name": crs}}
    path.write_text(json.dumps(collection))


def write_poly(path):
    points = SHORE + ISLAND
    segments = [(i, (i + 1) % 6) for i in range(6)] + [(6 + i, 6 + (i + 1) % 4) for i in range(4)]
    lines = [f"{len(points)} 2 0 0"] + [f"{i} {x} {y}" for i, (x, y) in enumerate(points)]
    lines += [f"{len(segments)} 0"] + [f"{i} {a} {b}" for i, (a, b) in enumerate(segments)]
    path.write_text("\n".join(lines + ["1", "0 -87.38 43.21", ""]))


def mesh_and_check(program, folder):
    inputs = {"geographic": "EPSG:4326", "projected": "EPSG:32616", "plane": ""}
    for name, crs in inputs.items():
        out = folder / name
        out.mkdir()
        lines = []
        source = folder / f"{name}.{'geojson' if crs else 'poly'}"
        if name == "plane":
            write_poly(source)
        else:
            place, given = (utm16, crs) if name == "projected" else (lambda *p: p, None)
            write_geojson(source, place, given)
            write_named(folder / f"{name}_weir.geojson", "LineString", WEIR, WEIR_NAME, place, given)
            write_named(folder / f"{name}_region.geojson", "Polygon", REGION, REGION_NAME, place, given)
            lines = ["--weirs", str(folder / f"{name}_weir.geojson")]
            lines += ["--regions", str(folder / f"{name}_region.geojson")]
        outputs = [arg for ending in FORMATS for arg in ("-o", str(out / f"lake.{ending}"))]
        subprocess.run([program, "mesh", str(source), *lines, "--quiet", *outputs], check=True)
        convert = [program, "convert", str(out / "lake.msh"), "--format", "gmsh22", "-o", str(out / ("lake" + MSH22))]
        subprocess.run(convert, check=True)
        check_folder(out, "lake", crs)


def start_qgis():
    """One application for all checks; kept until the end."""
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    try:
        from qgis.core import QgsApplication
    except ImportError:
        return None  # the first check that needs it reports this
    QgsApplication.setPrefixPath("/usr", True)
    application = QgsApplication([], False)
    application.initQgis()
    return application


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("--program", help="the coastmesh program")
    what.add_argument("--folder", type=pathlib.Path, help="files that are there")
    parser.add_argument("--stem", default="lake", help="name of the files in the folder")
    parser.add_argument("--crs", default="", help="the CRS that they have to have; none means a plane")
    parser.add_argument("--require-all", action="store_true", help="a peer that is missing is a failure")
    options = parser.parse_args()
    application = start_qgis()
    if options.folder:
        check_folder(options.folder, options.stem, options.crs)
    else:
        with tempfile.TemporaryDirectory() as folder:
            mesh_and_check(options.program, pathlib.Path(folder))
    if application:
        application.exitQgis()
    if skipped:
        print(f"SKIPPED for want of: {', '.join(sorted(skipped))}", file=sys.stderr)
    print(f"{len(failed)} differences")
    return 1 if failed or (skipped and options.require_all) else 77 if skipped else 0


if __name__ == "__main__":
    sys.exit(main())
