#!/usr/bin/python3
"""cut, remesh, merge and rivers of the Python module, against the commands of these names. PYTHONPATH finds coastmesh.

usage: edit_test.py PROGRAM DATA   (the program coastmesh, the folder data/)
"""
import copy
import csv
import json
import math
import os
import pickle
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import unittest
import warnings

import numpy as np

import coastmesh

PROGRAM, DATA = sys.argv[1:3]
LAKE = os.path.join(DATA, "lake_superior.geojson")
BOX = (-91, 46.5, -90, 47)
RING = [[-91, 46.5], [-90, 46.5], [-90, 47], [-91, 47], [-91, 46.5]]
POLYGON = {"type": "Polygon", "coordinates": [RING]}
# A river out of the lake's west, one that flows into it, and one far away.
RIVERS = [([[-92.05, 46.72], [-92.3, 46.72], [-92.6, 46.72]], {"width": 400, "name": "Long"}),
          ([[-92.3, 46.72], [-92.4, 46.85]], {"width": 200, "depth": 3, "name": "Short"}),
          ([[-100, 40], [-100, 41]], {"width": 200, "name": "Apart"})]
DEPTHS = "ncols 2\nnrows 2\nxllcorner -93\nyllcorner 45\ncellsize 5\n-50 -300\n-50 -300\n"


class Shape:
    def __init__(self, ring, crs=None):
        self.__geo_interface__ = {"type": "Polygon", "coordinates": [ring]}
        self.crs = crs


class Line:
    def __init__(self, points, properties, crs=None):
        self.__geo_interface__ = line(points, properties)
        self.crs = crs


def line(points, properties):
    return {"type": "Feature", "properties": properties, "geometry": {"type": "LineString", "coordinates": points}}


class EditTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        with open(cls.path("depths.asc"), "w", encoding="utf-8") as file:
            file.write(DEPTHS)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            cls.coarse = coastmesh.mesh(LAKE, size=6000, coast="follow", bathymetry=cls.path("depths.asc"))
            cls.fine = coastmesh.mesh(LAKE, size=2000, coast="follow", bathymetry=cls.path("depths.asc"), bbox=BOX)
        cls.coarse.write(cls.path("coarse.nc"))
        cls.fine.write(cls.path("fine.nc"))
        with open(cls.path("part.geojson"), "w", encoding="utf-8") as file:
            json.dump(POLYGON, file)
        with open(cls.path("rivers.geojson"), "w", encoding="utf-8") as file:
            json.dump({"type": "FeatureCollection", "features": [line(*river) for river in RIVERS]}, file)

    @classmethod
    def path(cls, name):
        return os.path.join(cls.folder, name)

    def run_program(self, command, *arguments):
        """What the command prints, its warnings, and the mesh and the numbers that it writes."""
        out, numbers = self.path("out.nc"), self.path("numbers.csv")
        done = subprocess.run([PROGRAM, command, *arguments, "-o", out, "--numbers", numbers, "--overwrite"],
                              capture_output=True, text=True, check=True)
        with open(numbers, encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        warned = [line.split("warning: ", 1)[1] for line in done.stderr.splitlines()]
        return done.stdout, warned, coastmesh.read(out), rows

    def caught(self, function, *arguments, **options):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            made = function(*arguments, **options)
        self.assertTrue(all(one.category is coastmesh.CoastmeshWarning for one in caught))
        self.assertTrue(all(one.filename == __file__ for one in caught))
        self.assertEqual(made.report["warnings"], [str(one.message) for one in caught])
        return made, made.report["warnings"]

    def assert_same(self, mesh, other):
        for name in ("points", "triangles", "z", "min_angle", "area"):
            np.testing.assert_array_equal(getattr(mesh, name), getattr(other, name), name)
        fids, other_fids = (np.array([f["fid"] for f in one.features])[one.feature] for one in (mesh, other))
        np.testing.assert_array_equal(fids, other_fids)
        self.assertEqual(mesh.crs, other.crs)
        self.assertEqual(len(mesh.boundaries), len(other.boundaries))
        for one, two in zip(mesh.boundaries, other.boundaries):
            self.assertEqual((one["role"], one["closed"]), (two["role"], two["closed"]))
            np.testing.assert_array_equal(one["nodes"], two["nodes"])

    def assert_numbers(self, mesh, rows):
        """`rows` are those that the command writes, counted from 1, with nothing for new ones."""
        for item in ("node", "triangle"):
            for array, column in ((f"{item}_source", "source"), (f"{item}_mesh", "mesh")):
                expected = [int(row[column] or 0) - 1 for row in rows if row["item"] == item and column in row]
                found = getattr(mesh, array)
                if expected:
                    self.assertEqual(found.dtype, np.int64)
                    np.testing.assert_array_equal(found, expected)
                else:
                    self.assertIsNone(found)


class CommandsTest(EditTest):
    """Each function makes of meshes at hand, and of files, what the command makes of the files."""

    def test_cut(self):
        for options, arguments in (({"bbox": BOX}, ["--bbox=-91,46.5,-90,47"]),
                                   ({"outside": self.path("part.geojson"), "cut_boundary": "land", "keep_water": "largest"},
                                    ["--outside", self.path("part.geojson"), "--cut-boundary", "land", "--keep-water",
                                     "largest"])):
            text, warned, expected, rows = self.run_program("cut", self.path("coarse.nc"), *arguments)
            self.assertEqual(warned, [])
            for given in (self.coarse, self.path("coarse.nc")):
                part, said = self.caught(coastmesh.cut, given, **options)
                self.assert_same(part, expected)
                self.assert_numbers(part, rows)
                self.assertEqual((part.summary.replace("keep_water='largest'", "--keep-water largest"), said), (text, []))
            np.testing.assert_array_equal(part.points, self.coarse.points[part.node_source])
            np.testing.assert_array_equal(part.node_source[part.triangles], self.coarse.triangles[part.triangle_source])
            self.assertTrue(part.complete)

    def test_remesh(self):
        text, warned, expected, rows = self.run_program(
            "remesh", self.path("coarse.nc"), "--bbox=-91,46.5,-90,47", "--size", "1000", "--size-max", "900", "--bathymetry",
            self.path("depths.asc"), "--depth-sign", "down", "--min-angle", "30")
        self.assertIn("--size 1000 is more than --size-max 900, which overrides it", warned)
        for given in (self.coarse, self.path("coarse.nc")):
            finer, said = self.caught(coastmesh.remesh, given, bbox=BOX, size=1000, size_max=np.float32(900),
                                      bathymetry=self.path("depths.asc"), depth_sign="down", min_angle=30)
            self.assert_same(finer, expected)
            self.assert_numbers(finer, rows)
            self.assertEqual(finer.summary, text)
            self.assertEqual(said, [re.sub("--([a-z-]+)", lambda name: name[1].replace("-", "_"), line) for line in warned])
        kept = finer.node_source >= 0
        self.assertTrue(kept.any() and not kept.all())
        np.testing.assert_array_equal(finer.points[kept], self.coarse.points[finer.node_source[kept]])
        self.assertTrue((finer.z[~kept] > 0).all())

    def test_merge(self):
        with self.assertWarns(coastmesh.CoastmeshWarning):
            small = coastmesh.remesh(self.fine, bbox=(-90.6, 46.8, -90.5, 46.9), size=800)
        small = coastmesh.cut(small, bbox=(-90.62, 46.78, -90.48, 46.92), keep_water="largest")
        small.write(self.path("small.nc"), overwrite=True)
        files = [self.path(name) for name in ("coarse.nc", "fine.nc", "small.nc")]
        for count in (1, 2):
            text, warned, expected, rows = self.run_program("merge", *files[:1 + count], "--grade", "0.3")
            inserted = [self.fine, small][:count]
            both, said = self.caught(coastmesh.merge, self.coarse, inserted if count > 1 else self.fine, grade=0.3)
            self.assert_same(both, expected)
            self.assert_numbers(both, rows)
            names = ["inserted"] if count == 1 else ["inserted[0]", "inserted[1]"]
            for name, path in zip(names, files[1:]):
                text = text.replace(path, name)
                warned = [line.replace(path, name) for line in warned]
            self.assertEqual((both.summary, said), (text, warned))
            self.assertEqual(set(both.node_mesh), set(range(-1, 1 + count)))
            for mesh, source in enumerate([self.coarse, self.fine, small][:1 + count]):
                own = both.node_mesh == mesh
                np.testing.assert_array_equal(both.points[own], source.points[both.node_source[own]])
            both, _ = self.caught(coastmesh.merge, files[0], files[1:1 + count], grade=0.3)
            self.assert_same(both, expected)

    def test_banks(self):
        """Widths of rivers from polygons, as files and as shapes."""
        path = self.path("banks.geojson")
        (x0, y0), (x1, y1) = RIVERS[0][0][0], RIVERS[0][0][-1]
        banks = {"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": [
            [[x0, y0 - 0.01], [x1, y1 - 0.01], [x1, y1 + 0.01], [x0, y0 + 0.01], [x0, y0 - 0.01]]]}}
        with open(path, "w", encoding="utf-8") as file:
            json.dump({"type": "FeatureCollection", "features": [banks]}, file)
        lines = [line(*RIVERS[0])]
        of_column, _ = self.caught(coastmesh.rivers, self.coarse, lines)
        meshes = [self.caught(coastmesh.rivers, self.coarse, lines, banks=given)[0] for given in (path, [path], banks)]
        self.assertIn("widths from banks along", meshes[0].summary)
        self.assertNotIn("widths from banks", of_column.summary)
        for mesh in meshes:
            np.testing.assert_array_equal(mesh.points, meshes[0].points)
        self.assertNotEqual(len(of_column.points), len(meshes[0].points))

    def test_rivers(self):
        path = self.path("rivers.geojson")
        text, warned, expected, rows = self.run_program("rivers", self.path("coarse.nc"), path, "--elements", "3", "--grade", "0.3")
        self.assertTrue(any("'Apart' near" in line for line in warned), warned)
        lines = [line(*river) for river in RIVERS]
        for mesh, given in ((self.coarse, path), (self.path("coarse.nc"), [path]), (self.coarse, lines),
                            (self.coarse, {"type": "FeatureCollection", "features": lines})):
            both, said = self.caught(coastmesh.rivers, mesh, given, elements=3, grade=0.3)
            self.assert_same(both, expected)
            np.testing.assert_array_equal(both.quadrilaterals, expected.quadrilaterals)
            self.assert_sources_of_elements(both, rows)
            # The program warns of what its file cannot hold, too.
            expected_warnings = [line.replace("--reach", "reach") for line in warned if "cannot hold" not in line]
            self.assertEqual((both.summary, said), (text, expected_warnings))
            self.assertFalse([one for one in both.features if "vsimem" in one["source"]])
        self.assertGreater(len(both.quadrilaterals), 50)
        self.assertEqual([one["role"] for one in both.boundaries].count("river"), 2)
        self.assertEqual(set(both.node_source[both.quadrilaterals].ravel()), {-1})
        kept = both.node_source >= 0
        self.assertTrue(kept.any() and not kept.all())
        np.testing.assert_array_equal(both.points[kept], self.coarse.points[both.node_source[kept]])
        kept = both.triangle_source >= 0
        np.testing.assert_array_equal(both.node_source[both.triangles[kept]], self.coarse.triangles[both.triangle_source[kept]])
        self.assertIsNone(both.node_mesh)

    def assert_sources_of_elements(self, mesh, rows):
        """As assert_numbers, for meshes with quadrilaterals, which the table counts as elements."""
        nodes = [int(row["source"] or 0) - 1 for row in rows if row["item"] == "node"]
        np.testing.assert_array_equal(mesh.node_source, nodes)
        kept = [int(row["source"]) - 1 for row in rows if row["item"] == "triangle" and row["source"]]
        np.testing.assert_array_equal(mesh.triangle_source[mesh.triangle_source >= 0], kept)
        self.assertFalse([row for row in rows if row["item"] == "quadrilateral" and row["source"]])

    def test_repairs_are_reported_and_leave_no_numbers(self):
        part, said = self.caught(coastmesh.cut, self.coarse, bbox=BOX, target=["adcirc", "schism"])
        whole = coastmesh.cut(self.coarse, bbox=BOX)
        for name in ("node_source", "triangle_source", "node_mesh", "triangle_mesh"):
            self.assertIsNone(getattr(part, name))
        self.assertIsNone(whole.report["repairs"])
        self.assertEqual(part.report["repairs"]["left"], [])
        done = subprocess.run([PROGRAM, "cut", self.path("coarse.nc"), "--bbox=-91,46.5,-90,47", "--target", "adcirc", "--target",
                               "schism", "-o", self.path("out.nc"), "--overwrite"], capture_output=True, text=True, check=True)
        self.assertEqual(part.summary.replace("keep_water='largest'", "--keep-water largest"), done.stdout)
        self.assert_same(part, coastmesh.read(self.path("out.nc")))
        self.assertEqual(said, [])

    def test_options_are_those_of_the_commands(self):
        with open(os.path.join(os.path.dirname(coastmesh.__file__), "__init__.pyi"), encoding="utf-8") as file:
            stubs = file.read()
        for name in ("cut", "remesh", "merge", "rivers"):
            usage = json.loads(subprocess.run([PROGRAM, name, "--json-usage"], capture_output=True, check=True).stdout)
            written = {"output", "format", "numbers", "overwrite", "quiet", "config"}
            keywords = {option["name"][2:].replace("-", "_") for option in usage["options"]} - written
            self.assertEqual(set(coastmesh.options(name)), keywords)
            function = getattr(coastmesh, name)
            stub = stubs[stubs.index(f"def {name}("):].split(") -> Mesh")[0]
            for keyword in keywords:
                self.assertIn(f"        {keyword}: ", function.__doc__)
                self.assertIn(f"    {keyword}: Optional[", stub)
        with self.assertRaisesRegex(coastmesh.OptionError, "function: 'plot' is none of mesh, cut, remesh, merge, rivers"):
            coastmesh.options("plot")


class ArgumentsTest(EditTest):
    def test_polygons_of_any_kind_that_say_the_same_are_the_same(self):
        expected = coastmesh.cut(self.coarse, within=self.path("part.geojson")).triangle_source
        self.assertTrue(len(expected))
        feature = {"type": "Feature", "properties": {"day": np.int64(3)}, "geometry": POLYGON}
        radius = 6378137.0
        mercator = [[radius * math.radians(x), radius * math.log(math.tan(math.pi / 4 + math.radians(y) / 2))] for x, y in RING]
        halves = [[[-91, 46.5], [-90.5, 46.5], [-90.5, 47], [-91, 47], [-91, 46.5]],
                  [[-90.5, 46.5], [-90, 46.5], [-90, 47], [-90.5, 47], [-90.5, 46.5]]]
        with open(self.path("half.geojson"), "w", encoding="utf-8") as file:
            json.dump({"type": "Polygon", "coordinates": halves[:1]}, file)
        for given in (POLYGON, json.dumps(POLYGON), feature, {"type": "FeatureCollection", "features": [feature]}, Shape(RING),
                      Shape(mercator, "EPSG:3857"), [Shape(half) for half in halves],
                      np.array([Shape(half) for half in halves], dtype=object),
                      [self.path("half.geojson"), Shape(halves[1])], (self.path("half.geojson"), self.path("part.geojson"))):
            np.testing.assert_array_equal(coastmesh.cut(self.coarse, within=given).triangle_source, expected)
        rest = coastmesh.cut(self.coarse, outside=POLYGON)
        np.testing.assert_array_equal(rest.triangle_source,
                                      coastmesh.cut(self.coarse, outside=self.path("part.geojson")).triangle_source)
        self.assertFalse(set(rest.triangle_source) & set(expected))
        # The part in a polygon and out of another one, which is at hand as well.
        east = coastmesh.cut(self.coarse, within=POLYGON, outside=Shape(halves[0])).triangle_source
        self.assertTrue(0 < len(east) < len(expected) and set(east) <= set(expected))

    def test_lines_of_any_kind_that_say_the_same_are_the_same(self):
        points, properties = RIVERS[0]
        expected = coastmesh.rivers(self.coarse, line(points, properties))
        self.assertTrue(len(expected.quadrilaterals))
        radius = 6378137.0
        mercator = [[radius * math.radians(x), radius * math.log(math.tan(math.pi / 4 + math.radians(y) / 2))] for x, y in points]
        with open(self.path("long.geojson"), "w", encoding="utf-8") as file:
            json.dump(line(points, properties), file)
        for given in (json.dumps(line(points, properties)), Line(points, properties), [Line(points, properties)],
                      np.array([Line(points, properties)], dtype=object), Line(points, {"width": np.float64(400)}),
                      self.path("long.geojson"), (self.path("long.geojson"),)):
            self.assert_same(coastmesh.rivers(self.coarse, given), expected)
        bare = {"type": "LineString", "coordinates": points}
        self.assert_same(coastmesh.rivers(self.coarse, bare, width=400), expected)
        self.assert_same(coastmesh.rivers(self.coarse, line(points, {"breadth": 400}), width_column="breadth"), expected)
        projected = coastmesh.rivers(self.coarse, Line(mercator, properties, "EPSG:3857"))
        np.testing.assert_allclose(projected.points, expected.points, atol=1e-9)
        # Paths and lines at hand in one list.
        mixed = coastmesh.rivers(self.coarse, [self.path("long.geojson"), Line(*RIVERS[1])])
        at_hand = coastmesh.rivers(self.coarse, [line(*RIVERS[0]), line(*RIVERS[1])])
        for name in ("points", "triangles", "quadrilaterals", "z"):
            np.testing.assert_array_equal(getattr(mixed, name), getattr(at_hand, name))

    def test_what_is_given_stays_as_it_was(self):
        before = [pickle.dumps(mesh._made) for mesh in (self.coarse, self.fine)]
        view, first = self.coarse.points, self.coarse.points.copy()
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            for made in (coastmesh.cut(self.coarse, bbox=BOX), coastmesh.remesh(self.coarse, bbox=BOX, size=3000),
                         coastmesh.merge(self.coarse, self.fine), coastmesh.cut(self.coarse, bbox=BOX, target="adcirc"),
                         coastmesh.rivers(self.coarse, line(*RIVERS[0]))):
                self.assertFalse(np.shares_memory(made.points, self.coarse.points))
        self.assertEqual([pickle.dumps(mesh._made) for mesh in (self.coarse, self.fine)], before)
        np.testing.assert_array_equal(view, first)

    def test_wrong_arguments_raise_with_evidence(self):
        def refused(kind, pattern, function, *arguments, **options):
            with self.assertRaisesRegex(kind, pattern) as caught, warnings.catch_warnings():
                warnings.simplefilter("ignore")
                function(*arguments, **options)
            self.assertNotIn("--", str(caught.exception))

        cut, remesh, merge, rivers = coastmesh.cut, coastmesh.remesh, coastmesh.merge, coastmesh.rivers
        bare = {"type": "LineString", "coordinates": RIVERS[0][0]}
        refused(TypeError, r"^cut\(\) has no option 'withn'; did you mean 'within'", cut, self.coarse, withn=POLYGON)
        refused(TypeError, r"^remesh\(\) has no option 'numbers'", remesh, self.coarse, numbers="n.csv")
        refused(TypeError, r"^merge\(\) has no option 'bbox'", merge, self.coarse, self.fine, bbox=BOX)
        refused(TypeError, r"^cut\(\) cannot change a dict", cut, POLYGON, bbox=BOX)
        refused(TypeError, r"^merge\(\) cannot change a int", merge, self.coarse, [self.fine, 3])
        refused(TypeError, "not callable", cut, self.coarse, bbox=BOX, progress=3)
        refused(coastmesh.InputError, "^there is no mesh to put in$", merge, self.coarse, [])
        refused(coastmesh.OptionError, "the mesh to cut out: give bbox, within or outside$", cut, self.coarse)
        refused(coastmesh.OptionError, "the mesh to mesh anew: give bbox, within or outside$", remesh, self.coarse, size=9)
        refused(coastmesh.OptionError, "give size, or others$", remesh, self.coarse, bbox=BOX)
        refused(coastmesh.OptionError, "^min_angle: '50' is not a number in the range 0 to 45$", merge, self.coarse, self.fine,
                min_angle=50)
        refused(coastmesh.OptionError, "^within: a float is neither a path nor GeoJSON, and has no __geo_interface__$", cut, self.coarse, within=3.5)
        refused(coastmesh.OptionError, "^within: a int is neither a path nor GeoJSON, and has no __geo_interface__$", cut, self.coarse, within=[POLYGON, 3])
        refused(coastmesh.OptionError, "^assume_crs: ", cut, self.coarse, bbox=BOX, assume_crs="nowhere")
        refused(coastmesh.OptionError, "fortran", cut, self.coarse, bbox=BOX, target="fortran")
        refused(coastmesh.InputError, "^'within'.*points only", cut, self.coarse, within={"type": "Point", "coordinates": [0, 0]})
        refused(coastmesh.InputError, "^within: GeoJSON: ", cut, self.coarse, within='{"type":')
        refused(coastmesh.InputError, r"^no triangle of 'mesh' has its middle.* over -92\.\d+,46", cut, self.coarse,
                bbox=(0, 0, 1, 1))
        refused(coastmesh.InputError, "no triangle of '.*coarse.nc' has its middle", remesh, self.path("coarse.nc"),
                bbox=(0, 0, 1, 1), size=9)
        refused(coastmesh.InputError, "^'inserted' cannot be put into 'mesh': ", merge, self.coarse, self.coarse)
        refused(coastmesh.InputError, "nowhere.nc", merge, self.coarse, [self.fine, "nowhere.nc"])
        refused(coastmesh.InputError, "nowhere.nc", cut, "nowhere.nc", bbox=BOX)
        refused(TypeError, r"^rivers\(\) has no option 'size'", rivers, self.coarse, bare, size=3)
        refused(TypeError, r"^rivers\(\) cannot change a dict", rivers, bare, bare, width=3)
        refused(TypeError, "^lines: a int is neither a path nor GeoJSON, and has no __geo_interface__$", rivers, self.coarse, [bare, 3], width=3)
        refused(TypeError, "^lines: a NoneType is neither a path", rivers, self.coarse, None)
        refused(coastmesh.InputError, "^there is no line of a river$", rivers, self.coarse, [])
        refused(coastmesh.InputError, "^'lines'.* has no attribute 'width' .*name another with width_column, or give one width ",
                rivers, self.coarse, bare)
        refused(coastmesh.InputError, "^'lines', feature 0: is a polygon", rivers, self.coarse, POLYGON, width=3)
        refused(coastmesh.InputError, "^no river can be added to 'mesh': .*'Apart' near", rivers, self.coarse, line(*RIVERS[2]))
        refused(coastmesh.InputError, "nowhere.gpkg", rivers, self.coarse, "nowhere.gpkg", width=3)
        refused(coastmesh.OptionError, "^elements: ", rivers, self.coarse, bare, elements=0)
        refused(coastmesh.OptionError, "^extent: ", rivers, self.coarse, bare, extent="some")

    def test_a_crs_is_assumed_of_meshes_without(self):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            self.coarse.write(self.path("coarse.14"), overwrite=True)
            self.fine.write(self.path("fine.14"), overwrite=True)
        for name in ("coarse.prj", "fine.prj"):
            os.remove(self.path(name))
        with self.assertWarnsRegex(coastmesh.CoastmeshWarning, "does not say its CRS.* give assume_crs EPSG:4326"):
            plane = coastmesh.read(self.path("coarse.14"))
        self.assertEqual(plane.crs, "")
        known, said = self.caught(coastmesh.cut, plane, bbox=BOX, assume_crs="EPSG:4326")
        self.assertEqual((known.crs, said), ("EPSG:4326", []))
        expected = coastmesh.cut(coastmesh.read(self.path("coarse.14"), assume_crs="EPSG:4326"), bbox=BOX)
        self.assert_same(known, expected)
        self.assertEqual(plane.crs, "")
        both, _ = self.caught(coastmesh.merge, plane, self.path("fine.14"), assume_crs="EPSG:4326")
        self.assertEqual(both.crs, "EPSG:4326")
        with self.assertRaisesRegex(coastmesh.InputError, "'inserted' is in EPSG:4326.*: give assume_crs$"):
            coastmesh.merge(plane, self.fine)
        _, said = self.caught(coastmesh.cut, self.coarse, bbox=BOX, assume_crs="EPSG:32616")
        self.assertEqual(said, ["assume_crs has no effect: 'mesh' says its CRS"])
        # What was measured in a plane is not known on the ground.
        square = coastmesh.mesh([[5, 45], [6, 45], [6, 46], [5, 46]], [[0, 1], [1, 2], [2, 3], [3, 0]], size_max=0.2)
        box = (5, 45, 5.5, 46)
        self.assertIsNotNone(coastmesh.cut(square, bbox=box).area)
        self.assertIsNone(coastmesh.cut(square, bbox=box, assume_crs="EPSG:4326").area)

    def test_options_without_effect_are_warned_of(self):
        _, said = self.caught(coastmesh.merge, self.coarse, self.fine, min_depth=2)
        self.assertEqual(said[0], "min_depth has no effect without bathymetry")

    def test_results_are_pickled_and_copied(self):
        both, _ = self.caught(coastmesh.merge, self.coarse, self.fine)
        for twin in (pickle.loads(pickle.dumps(both)), copy.deepcopy(both)):
            self.assert_same(twin, both)
            for name in ("node_source", "triangle_source", "node_mesh", "triangle_mesh"):
                np.testing.assert_array_equal(getattr(twin, name), getattr(both, name))
            self.assertEqual((twin.summary, twin.report), (both.summary, both.report))
        self.assertIsNone(self.coarse.summary)
        self.assertIsNone(self.coarse.node_source)


class RunTest(EditTest):
    LONG = {"bbox": (-93, 46, -84, 50), "size": 400}  # takes some seconds

    def test_progress_is_told_in_this_thread_and_what_it_raises_ends_the_run(self):
        told = []

        def tell(phase, share):
            told.append((phase, share, threading.get_ident()))

        coastmesh.remesh(self.coarse, progress=tell, **{**self.LONG, "size": 900})
        self.assertIn("remesh", {phase for phase, _, _ in told})
        self.assertLessEqual({phase for phase, _, _ in told}, {"read", "remesh", "finish"})
        self.assertEqual({thread for _, _, thread in told}, {threading.get_ident()})
        shares = [share for phase, share, _ in told if phase == "remesh"]
        self.assertEqual(shares, sorted(shares))
        self.assertTrue(all(0 <= share <= 1 for share in shares))
        told.clear()
        coastmesh.cut(self.coarse, bbox=BOX, target="adcirc", progress=tell)
        self.caught(coastmesh.merge, self.coarse, self.fine, progress=tell)
        self.assertTrue(told)

        def stop(phase, share):
            raise RuntimeError("enough")

        with self.assertRaisesRegex(RuntimeError, "enough"):
            coastmesh.remesh(self.coarse, progress=stop, **self.LONG)

    def test_ctrl_c_ends_a_long_run(self):
        killer = threading.Thread(target=os.kill, args=(os.getpid(), signal.SIGINT))

        def begun(phase, share):
            if phase == "remesh" and not killer.ident:
                killer.start()

        with self.assertRaises(KeyboardInterrupt):
            coastmesh.remesh(self.coarse, progress=begun, **self.LONG)
        killer.join()
        self.assertTrue(len(coastmesh.cut(self.coarse, bbox=BOX).triangles))

    def test_other_threads_run_meanwhile(self):
        counted, done = 0, threading.Event()

        def work():
            coastmesh.remesh(self.coarse, **{**self.LONG, "size": 900})
            done.set()

        thread = threading.Thread(target=work)
        thread.start()
        while not done.wait(0.001):
            counted += 1
        thread.join()
        self.assertGreater(counted, 5)

    def test_several_runs_on_one_mesh_give_the_same(self):
        expected = coastmesh.remesh(self.coarse, bbox=BOX, size=3000)
        meshes = [None] * 4

        def work(i):
            meshes[i] = coastmesh.remesh(self.coarse, bbox=BOX, size=3000)

        threads = [threading.Thread(target=work, args=(i,)) for i in range(len(meshes))]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for mesh in meshes:
            self.assert_same(mesh, expected)

    def test_quadrilaterals(self):
        with open(self.path("quads.gr3"), "w", encoding="utf-8") as file:
            file.write("quads\n6 9\n")
            for i in range(9):
                file.write(f"{i + 1} {10 * (i % 3)} {10 * (i // 3)} 5\n")
            file.write("1 4 1 2 5 4\n2 3 2 3 6\n3 3 2 6 5\n4 4 5 8 7 4\n5 3 5 6 9\n6 3 5 9 8\n")
        mesh = coastmesh.read(self.path("quads.gr3"), assume_crs="plane")
        self.assertEqual(mesh.quadrilaterals.tolist(), [[0, 1, 4, 3], [4, 7, 6, 3]])
        self.assertEqual(len(mesh.triangles), 8)
        part = coastmesh.cut(mesh, bbox=(0, 0, 10, 20))
        self.assertEqual(len(part.quadrilaterals), 2)
        self.assertEqual(len(part.triangles), 4)
        self.assertIn("0 of 4 triangles, 2 of 2 quadrilaterals", part.summary)
        self.assertEqual(coastmesh.mesh(LAKE, size=20000, coast="follow").quadrilaterals.shape, (0, 4))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2)
