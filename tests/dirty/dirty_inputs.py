#!/usr/bin/python3
"""Writes some 200 dirty inputs, each with the outcome it must have, and runs coastmesh on them.

usage: tests/dirty/dirty_inputs.py PROGRAM [--keep DIR] [--mesh-alone]

For each: `mesh` ends in time with the exit code expected, says what it must, its mesh passes `check`, has the area and the
islands expected, and the report counts the edits expected. Then `clean` is run twice: the second changes no byte. Fails
with one line a case. With --keep the inputs stay in DIR. With --mesh-alone each input is meshed once, and neither the mesh
nor `clean` is looked at: enough for a program with sanitizers, which is slow.
"""
import argparse
import json
import math
import os
import pathlib
import random
import subprocess
import sys
import tempfile

UTM = "EPSG:32631"  # in the middle of its zone, where the scale is 0.9996
X0, Y0 = 500000.0, 5000000.0
GROUND = 1 / 0.9996**2  # area on the ground over area in the plane


def circle(x, y, radius, n=20, clockwise=False):
    ring = [(x + radius * math.cos(2 * math.pi * i / n), y + radius * math.sin(2 * math.pi * i / n)) for i in range(n)]
    return ring[::-1] if clockwise else ring


def box(x0, y0, x1, y1):
    return [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]


def area(ring):
    return abs(sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(ring, ring[1:] + ring[:1]))) / 2


LAKE = circle(0, 0, 1000)
LAKE_AREA = area(LAKE)


class Case:
    """An input in the plane round 0, 0; transformed before it is written."""

    def __init__(self, name, geometries, *, exit=0, area=None, islands=None, edits=(), says="", options=(), text=None,
                 ending=".geojson", crs=UTM, fixed=False, tolerance=2e-3):
        self.tolerance = tolerance
        self.name, self.geometries, self.exit, self.area, self.islands = name, geometries, exit, area, islands
        self.edits, self.says, self.options, self.text, self.ending = edits, says, list(options), text, ending
        self.crs, self.fixed = crs, fixed


def polygon(*rings, close=True):
    return {"type": "Polygon", "coordinates": [list(r) + [r[0]] if close and r else list(r) for r in rings]}


def line(points):
    return {"type": "LineString", "coordinates": list(points)}


def multi(*polygons):
    return {"type": "MultiPolygon", "coordinates": [p["coordinates"] for p in polygons]}


def spike_at(ring, i, tip):
    return ring[: i + 1] + [tip, ring[i]] + ring[i + 1 :]


def cases():
    island, other = circle(300, 0, 100, 8), circle(-300, 0, 100, 8)
    island_area = area(island)
    lake = [polygon(LAKE)]
    yield Case("lake", lake, area=LAKE_AREA, islands=0)
    yield Case("lake_with_islands", [polygon(LAKE, island, other)], area=LAKE_AREA - 2 * island_area, islands=2)
    yield Case("wrong_winding", [polygon(LAKE[::-1], island)], area=LAKE_AREA - island_area, islands=1)
    yield Case("repeated_points", [polygon([p for p in LAKE for _ in range(3)])], area=LAKE_AREA, edits=["repeated_point"])
    yield Case("nearly_repeated", [polygon([q for p in LAKE for q in (p, (p[0] + 1e-4, p[1]))])], area=LAKE_AREA,
               edits=["repeated_point"])
    yield Case("unclosed_ring", [polygon(LAKE, close=False)], area=LAKE_AREA, says="not closed")
    yield Case("spike_outwards", [polygon(spike_at(LAKE, 3, (3000, 3000)))], area=LAKE_AREA, edits=["spike"])
    yield Case("spike_inwards", [polygon(spike_at(LAKE, 3, (0, 0)))], area=LAKE_AREA, edits=["spike"])
    yield Case("spike_of_spikes", [polygon(LAKE[:4] + [(2000, 2000), (3000, 2500), (2000, 2000)] + LAKE[3:])],
               area=LAKE_AREA, edits=["spike"])
    yield Case("spike_at_the_end", [polygon(LAKE + [(2000, -3000)] + [LAKE[-1]])], area=LAKE_AREA, edits=["spike"])
    yield Case("bow_tie", [polygon([(0, 0), (1000, 1000), (1000, 0), (0, 1000)])], area=5e5, edits=["self_crossing"])
    yield Case("loop_in_the_shore", [polygon(box(0, 0, 1000, 1000)[:2] + [(1000, 600), (1100, 500), (1000, 500), (950, 700),
               (1000, 1000), (0, 1000)])], exit=None)
    yield Case("overlapping_edge_out_and_back", [polygon([(0, 0), (1000, 0), (1000, 500), (1400, 500), (1000, 500),
               (1000, 1000), (0, 1000)])], area=1e6, edits=["spike"])
    yield Case("island_twice", [polygon(LAKE, island, island)], area=LAKE_AREA - area(island), edits=["repeated_ring"], islands=1)
    yield Case("island_in_island", [polygon(LAKE, circle(0, 0, 500, 12), circle(0, 0, 200, 9))],
               area=LAKE_AREA - area(circle(0, 0, 500, 12)) + area(circle(0, 0, 200, 9)), edits=["misplaced_ring"])
    yield Case("island_outside", [polygon(LAKE, circle(3000, 0, 100, 8))], area=LAKE_AREA + island_area,
               edits=["misplaced_ring"])
    yield Case("islands_touch_in_a_point", [polygon(LAKE, box(0, 0, 100, 100), box(100, 100, 200, 200))],
               area=LAKE_AREA - 2e4, edits=["touching_ring"])
    opened = ["--pinches", "open"]
    yield Case("touching_islands_opened", [polygon(LAKE, box(0, 0, 100, 100), box(100, 100, 200, 200))],
               area=LAKE_AREA - 2e4, edits=["opened_pinch"], options=opened, islands=2)
    yield Case("three_islands_opened", [polygon(LAKE, [(0, 0), (100, -30), (100, 30)], [(0, 0), (0, 100), (-60, 100)],
               [(0, 0), (-100, 0), (-60, -100)])], area=LAKE_AREA - 1.1e4, edits=["opened_pinch"], options=opened, islands=3)
    yield Case("island_at_the_shore_opened", [polygon(box(0, 0, 1000, 1000), [(0, 500), (200, 400), (200, 600)])],
               area=1e6 - 2e4, edits=["overlapping_edge", "opened_pinch"], options=opened, islands=1)
    yield Case("island_of_two_lobes_opened", [polygon(LAKE, [(0, 0), (100, -100), (200, 0), (100, 100), (0, 0), (-100, 100),
               (-200, 0), (-100, -100)])], area=LAKE_AREA - 4e4, edits=["opened_pinch"], options=opened, islands=2)
    yield Case("lake_of_two_lobes_opened", [polygon([(0, 0), (400, 0), (400, 400), (800, 400), (800, 800), (400, 800), (400, 400),
               (0, 400)])], area=3.2e5, tolerance=0.01, edits=["opened_pinch"], options=opened, islands=0)
    yield Case("bow_tie_opened", [polygon([(0, 0), (1000, 1000), (1000, 0), (0, 1000)])], area=5e5, tolerance=0.01,
               edits=["self_crossing", "opened_pinch"], options=opened, islands=0)
    yield Case("touching_lakes_opened", [polygon(box(0, 0, 500, 500)), polygon(box(500, 500, 900, 900))], area=4.1e5,
               tolerance=0.01, edits=["opened_pinch"], options=opened)
    chequered = [box(x, y, x + 100, y + 100) for x in range(0, 800, 100) for y in range(0, 800, 100) if (x + y) % 200]
    yield Case("chequered_opened", [polygon(box(-100, -100, 900, 900), *chequered)], area=6.8e5, tolerance=0.01,
               edits=["opened_pinch"], options=opened, islands=32)
    yield Case("islands_share_an_edge_opened", [polygon(LAKE, box(0, 0, 100, 100), box(100, 0, 200, 100))],
               area=LAKE_AREA - 2e4, options=opened, islands=1)
    yield Case("islands_share_an_edge", [polygon(LAKE, box(0, 0, 100, 100), box(100, 0, 200, 100))], area=LAKE_AREA - 2e4,
               edits=["overlapping_edge"], islands=1)
    yield Case("islands_share_part_of_an_edge", [polygon(LAKE, box(0, 0, 100, 100), box(100, 20, 200, 80))],
               area=LAKE_AREA - 1.6e4, edits=["overlapping_edge"], islands=1)
    yield Case("islands_overlap", [polygon(LAKE, box(0, 0, 100, 100), box(50, 50, 150, 150))],
               area=LAKE_AREA - 2e4 + 2 * 2500, edits=["self_crossing"])
    square = box(0, 0, 1000, 1000)
    yield Case("island_touches_the_shore", [polygon(square, [(0, 500), (200, 400), (200, 600)])], area=1e6 - 2e4,
               edits=["overlapping_edge"])
    yield Case("island_on_the_shore", [polygon(square, box(0, 400, 200, 600))], area=1e6 - 4e4, islands=0,
               edits=["overlapping_edge"])
    yield Case("island_across_the_shore", [polygon(square, box(900, 400, 1100, 600))], area=1e6, edits=["self_crossing"])
    yield Case("island_fills_the_lake", [polygon(square, square)], exit=3, says="enclose no area")
    yield Case("island_cuts_the_lake", [polygon(square, box(400, 0, 600, 1000))], area=8e5)
    yield Case("island_of_two_points", [polygon(LAKE, [(0, 0), (100, 0)])], area=LAKE_AREA, edits=["degenerate_ring"])
    yield Case("island_of_one_point", [polygon(LAKE, [(0, 0)])], area=LAKE_AREA, edits=["degenerate_ring"])
    yield Case("island_on_a_line", [polygon(LAKE, [(0, 0), (100, 0), (200, 0)])], area=LAKE_AREA)
    yield Case("small_islands", [polygon(LAKE, island, box(0, 0, 10, 10), box(-50, 0, -45, 5))],
               area=LAKE_AREA - island_area, islands=1, edits=["small_island"], options=["--min-island-area", "1000"])
    yield Case("thin_channel", [polygon([(0, 0), (1000, 0), (1000, 500), (1000.05, 500), (1000.05, 0), (2000, 0), (2000, 1000),
               (0, 1000)])], exit=None)
    yield Case("needle", [polygon([(0, 0), (10000, 0.5), (10000, 0)])], exit=None)
    yield Case("hair", [polygon([(0, 0), (1000, 0), (1000, 1e-5), (0, 1e-5)])], exit=None)
    yield Case("collinear", [polygon([(i, 0) for i in range(0, 1000, 50)] + [(1000, 0), (1000, 1000), (0, 1000)])], area=1e6)
    yield Case("flat_polygon", [polygon([(0, 0), (500, 0), (1000, 0)])], exit=3, says="enclose no area")
    yield Case("all_points_equal", [polygon([(0, 0), (0, 0), (0, 0), (0, 0)])], exit=3)
    yield Case("same_lake_twice", [polygon(LAKE), polygon(LAKE)], area=LAKE_AREA, edits=["features_overlap"])
    yield Case("lakes_overlap", [polygon(square), polygon(box(500, 500, 1500, 1500))], area=1.75e6,
               edits=["features_cross", "features_overlap"])
    yield Case("lake_in_lake", [polygon(square), polygon(box(300, 300, 600, 600))], area=1e6, edits=["features_overlap"])
    yield Case("lake_in_the_hole", [polygon(square, box(300, 300, 600, 600)), polygon(box(300, 300, 600, 600))], area=1e6)
    yield Case("lakes_side_by_side", [polygon(square), polygon(box(1000, 0, 2000, 1000))], area=2e6)
    yield Case("lakes_side_by_side_dissolved", [polygon(square), polygon(box(1000, 0, 2000, 1000))], area=2e6,
               options=["--dissolve"], edits=["dissolved_edge"])
    yield Case("lakes_apart", [polygon(square), polygon(box(3000, 0, 4000, 1000))], area=2e6)
    yield Case("multipolygon", [multi(polygon(square), polygon(box(3000, 0, 4000, 1000)))], area=2e6)
    yield Case("parts_overlap", [multi(polygon(square), polygon(box(500, 0, 1500, 1000)))], area=1.5e6, exit=0)
    yield Case("collection", [{"type": "GeometryCollection", "geometries": [polygon(LAKE), {"type": "Point",
               "coordinates": (5000, 0)}]}], area=LAKE_AREA)
    yield Case("with_null_geometry", [None, polygon(LAKE)], area=LAKE_AREA)
    yield Case("with_empty_geometry", [{"type": "Polygon", "coordinates": []}, polygon(LAKE)], area=LAKE_AREA)
    yield Case("with_a_point", [{"type": "Point", "coordinates": (0, 0)}, polygon(LAKE)], area=LAKE_AREA)
    yield Case("points_only", [{"type": "Point", "coordinates": (0, 0)}], exit=3, says="points only")
    yield Case("heights", [{"type": "Polygon", "coordinates": [[(x, y, 5.5) for x, y in LAKE + LAKE[:1]]]}], area=LAKE_AREA)
    yield Case("closed_line", [line(LAKE + LAKE[:1])], area=LAKE_AREA)
    yield Case("line_in_two", [line(LAKE[:11]), line(LAKE[10:] + LAKE[:1])], area=LAKE_AREA)
    yield Case("line_in_two_directions", [line(LAKE[:11]), line((LAKE[10:] + LAKE[:1])[::-1])], area=LAKE_AREA)
    pieces = [line([a, b]) for a, b in zip(LAKE, LAKE[1:] + LAKE[:1])]
    random.Random(5).shuffle(pieces)
    yield Case("line_in_shuffled_pieces", pieces, area=LAKE_AREA)
    yield Case("lines_with_an_island", pieces + [line(island + island[:1])], area=LAKE_AREA - island_area, islands=1)
    yield Case("line_given_twice", [line(LAKE + LAKE[:1]), line(LAKE + LAKE[:1])], exit=None)
    yield Case("line_with_a_wharf", [line(LAKE + LAKE[:1]), line([LAKE[10], (-500, 0)])], area=LAKE_AREA)
    yield Case("open_line", [line(LAKE)], exit=3, says="close no ring")
    yield Case("shore_and_wharf", [polygon(LAKE), line([(0, 0), (100, 50)])], area=LAKE_AREA)
    yield Case("wharf_on_land", [polygon(LAKE), line([(2000, 0), (2100, 50)])], area=LAKE_AREA, exit=None)
    yield Case("grid_of_crossings", [polygon([(x, y) for i in range(10) for x, y in ((i * 100, 0), (i * 100 + 50, 1000))])],
               exit=None)
    # Coasts and frames.
    frame = ["--bbox", "{0},{1},{2},{3}"]
    coast = [(0, -1500), (50, 0), (0, 1500)]
    yield Case("coast_in_a_box", [line(coast)], options=frame, exit=0, says="right of the coastlines", fixed=True)
    yield Case("coast_in_pieces", [line(coast[:2]), line(coast[1:][::-1])], options=frame, exit=0, fixed=True)
    yield Case("coast_with_a_gap", [line(coast[:2]), line([(50, 20), (0, 1500)])], options=frame, exit=3,
               says="the coastline ends at", fixed=True)
    yield Case("island_in_a_box", [polygon(circle(0, 0, 500, 16))], options=frame + ["--domain", "outside"],
               area=4e6 - area(circle(0, 0, 500, 16)), islands=1, fixed=True)
    yield Case("land_across_a_box", [polygon(box(-3000, -3000, 0, 3000))], options=frame + ["--domain", "outside"], area=2e6,
               fixed=True)
    yield Case("lake_across_a_box", [polygon(box(-3000, -500, 0, 500))], options=frame, area=1e6, fixed=True)
    yield Case("all_land", [polygon(box(-3000, -3000, 3000, 3000))], options=frame + ["--domain", "outside"], exit=3,
               says="no water", fixed=True)
    yield Case("beside_the_box", [polygon(box(9000, 9000, 9900, 9900))], options=frame, exit=3, says="nothing of the input",
               fixed=True)
    yield Case("box_turned_round", lake, options=["--bbox", "{0},{3},{2},{1}"], exit=2, says="S below N", fixed=True)
    yield Case("outside_of_what", lake, options=["--domain", "outside"], exit=2, says="--bbox", fixed=True)
    # Files.
    yield Case("empty_file", None, text="", exit=3, says="empty", fixed=True)
    yield Case("no_json", None, text="{\"type\": \"FeatureCollection\", \"feat", exit=3, fixed=True)
    yield Case("no_features", [], exit=3, fixed=True)
    yield Case("not_a_map", None, text="hello\n", exit=3, fixed=True)
    yield Case("infinite", None, exit=3, fixed=True, says="not a place",
               text='{"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[[[0,0],[1e999,0],[1,1],[0,0]]]}}')
    degrees = "urn:ogc:def:crs:OGC:1.3:CRS84"
    yield Case("latitude_95", [polygon([(0, 80), (10, 80), (5, 95)])], crs=degrees, exit=3, says="not a place on Earth",
               fixed=True)
    yield Case("metres_called_degrees", [polygon(box(500000, 5000000, 501000, 5001000))], crs=degrees, exit=3,
               says="not a place on Earth", fixed=True)
    yield Case("degrees_called_metres", [polygon([(5, 50), (6, 50), (6, 51), (5, 51)])], crs=UTM, exit=None,
               says="if they are degrees", fixed=True)
    yield Case("at_the_antimeridian", [polygon([(179, 10), (180, 10), (180, 11), (179, 11)]),
               polygon([(-180, 10), (-179, 10), (-179, 11), (-180, 11)])], crs=degrees, exit=None, fixed=True)
    west = polygon([(179.5, -17.5), (180, -17), (179.5, -16.5)])
    east = polygon([(-180, -17), (-179.5, -17.5), (-179.5, -16.5)])
    for name, pinches in ("kept", []), ("opened", opened):
        yield Case(f"touching_at_the_antimeridian_{name}", [west, east], crs=degrees, exit=0, fixed=True, islands=2 if pinches else 1,
                   options=["--domain", "outside", "--bbox=177,-20,-178,-15"] + pinches,
                   edits=["opened_pinch" if pinches else "touching_ring"])
    yield Case("past_the_antimeridian", [polygon([(179, 10), (181, 10), (181, 11), (179, 11)])], crs=degrees, exit=None,
               fixed=True)
    yield Case("round_the_pole", [polygon([(-180, 80), (-90, 80), (0, 80), (90, 80), (180, 80), (180, 90), (-180, 90)])],
               crs=degrees, exit=None, fixed=True)
    yield Case("the_pole_as_a_ring", [polygon([(-180, 80), (-90, 82), (0, 80), (90, 81)])], crs=degrees, exit=None, fixed=True)
    yield Case("curves", None, ending=".csv", fixed=True, exit=0, area=math.pi * 500**2,
               text='id,WKT\n1,"CURVEPOLYGON(CIRCULARSTRING(1000 0,2000 0,1000 0))"\n')
    yield Case("measures", None, ending=".csv", fixed=True, exit=0, area=1e6,
               text='id,WKT\n1,"POLYGON ZM((0 0 1 2,1000 0 1 2,1000 1000 1 2,0 1000 1 2,0 0 1 2))"\n')
    for seed in range(40):
        rng = random.Random(seed)
        n = rng.randint(4, 40)
        if seed % 2:
            ring = [(rng.uniform(0, 1000), rng.uniform(0, 1000)) for _ in range(n)]
        else:
            ring = [(100 * rng.randint(0, 6), 100 * rng.randint(0, 6)) for _ in range(n)]
        holes = [[(100 * rng.randint(0, 6), 100 * rng.randint(0, 6)) for _ in range(5)] for _ in range(rng.randint(0, 4))]
        yield Case(f"tangle_{seed}", [polygon(ring, *holes)], exit=None, fixed=seed >= 10)
        if seed < 20:
            yield Case(f"tangle_{seed}_opened", [polygon(ring, *holes)], exit=None, fixed=True, options=opened)


TRANSFORMS = {
    "": lambda ring: ring,
    "_backwards": lambda ring: ring[::-1],
    "_turned": lambda ring: [(-y, x, *z) for x, y, *z in ring],
}


def moved(geometry, change, shift):
    if geometry is None:
        return None
    if geometry["type"] == "GeometryCollection":
        return {**geometry, "geometries": [moved(g, change, shift) for g in geometry["geometries"]]}

    def walk(node):
        if node and isinstance(node[0], (int, float)):
            return change([tuple(node)])[0]
        if node and node[0] and isinstance(node[0], (list, tuple)) and isinstance(node[0][0], (int, float)):
            return [[p[0] + shift[0], p[1] + shift[1], *p[2:]] for p in change([tuple(p) for p in node])]
        return [walk(child) for child in node]

    moved_coordinates = walk(geometry["coordinates"])
    if geometry["type"] == "Point":
        moved_coordinates = [moved_coordinates[0] + shift[0], moved_coordinates[1] + shift[1]]
    return {**geometry, "coordinates": moved_coordinates}


def text_of(case, change):
    if case.text is not None:
        return case.text
    shift = (X0, Y0) if case.crs == UTM and case.name != "degrees_called_metres" else (0, 0)
    features = [{"type": "Feature", "id": i, "properties": {}, "geometry": moved(g, change, shift)}
                for i, g in enumerate(case.geometries)]
    return json.dumps({"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": case.crs}},
                       "features": features})


class Failure(Exception):
    pass


def run(program, *arguments):
    try:
        return subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, timeout=60)
    except subprocess.TimeoutExpired as error:
        raise Failure(f"{arguments[0]} does not end") from error


def require(condition, text):
    if not condition:
        raise Failure(text)


def check_case(program, case, suffix, change, folder, mesh_alone):
    file, mesh = folder / f"{case.name}{suffix}{case.ending}", folder / f"{case.name}{suffix}.nc"
    report = folder / f"{case.name}{suffix}.json"
    file.write_text(text_of(case, change))
    options = [o.format(X0 - 1000, Y0 - 1000, X0 + 1000, Y0 + 1000) for o in case.options]
    ran = run(program, "mesh", file, "-o", mesh, "--report", report, "--overwrite", *options)
    said = ran.stdout + ran.stderr
    wanted = [0, 1, 3] if case.exit is None else [0, 1] if case.exit == 0 else [case.exit]
    require(ran.returncode in wanted, f"mesh: exit code {ran.returncode}, not of {wanted}: {ran.stderr.strip()}")
    require(case.says in said, f"does not say '{case.says}': {said.strip()}")
    if ran.returncode in (2, 3):
        require(ran.stderr.startswith("coastmesh: ") and not mesh.exists(), f"refuses oddly: {ran.stderr}")
        return
    if mesh_alone:
        return
    checked = run(program, "check", mesh)
    require(checked.returncode == 0, f"check: {checked.stdout} {checked.stderr}")
    if "open" in case.options:
        opened = run(program, "check", mesh, "--pinches", "--target", "adcirc")
        require(opened.returncode == 0, f"check --pinches --target adcirc: {opened.stdout} {opened.stderr}")
        others = [o for o in options if o not in ("--pinches", "open")]
        same = run(program, "check", mesh, "--input", file, "--input-pinches", "open", *others)
        require(same.returncode == 0, f"check --input: {same.stdout} {same.stderr}")
    result = json.loads(report.read_text())
    require(result["refine"]["unresolved"]["count"] == 0 or case.exit is None, "angles fall short")
    if case.area is not None:
        wanted_area = case.area * (GROUND if case.ending == ".geojson" else 1)
        got = result["mesh"]["area_m2"]
        require(abs(got - wanted_area) < case.tolerance * wanted_area, f"area {got:.1f}, not {wanted_area:.1f}")
    for kind in case.edits:
        require(result["clean"][kind] > 0, f"counts no {kind}: {result['clean']}")
    if case.islands is not None:
        told = json.loads(run(program, "info", mesh, "--json").stdout)
        islands = told["boundaries"].get("island", 0)
        require(islands == case.islands, f"{islands} islands, not {case.islands}")
    if suffix:
        return
    once, twice = folder / f"{case.name}{suffix}_1.gpkg", folder / f"{case.name}{suffix}_2.gpkg"
    first = run(program, "clean", file, "-o", once, "--overwrite", *options)
    require(first.returncode in (0, 1), f"clean: {first.stderr}")
    for again in [[], ["--pinches", "open"]] if "open" in case.options else [[]]:
        second = run(program, "clean", once, "-o", twice, "--overwrite", *again)
        require(second.returncode == 0, f"clean again: {second.stderr}")
        require(once.read_bytes() == twice.read_bytes(), f"cleaned again, the file is another: {second.stdout}")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--keep", metavar="DIR")
    parser.add_argument("--mesh-alone", action="store_true")
    arguments = parser.parse_args()
    program = os.path.abspath(arguments.program)
    transforms = {"": TRANSFORMS[""]} if arguments.mesh_alone else TRANSFORMS
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(arguments.keep or scratch)
        folder.mkdir(parents=True, exist_ok=True)
        count = failed = 0
        for case in cases():
            for suffix, change in transforms.items():
                if case.fixed and suffix:
                    continue
                count += 1
                try:
                    check_case(program, case, suffix, change, folder, arguments.mesh_alone)
                except Failure as failure:
                    failed += 1
                    print(f"{case.name}{suffix}: {failure}", flush=True)
        print(f"{count} dirty inputs, {failed} with another outcome than expected")
        sys.exit(failed > 0 or count < (150 if arguments.mesh_alone else 200))


if __name__ == "__main__":
    main()
