#!/usr/bin/python3
"""The Python module: arrays in and out, files, GeoJSON, errors, interruption. PYTHONPATH finds coastmesh.

usage: module_test.py PROGRAM DATA   (the program coastmesh, the folder data/)
"""
import copy
import datetime
import gc
import json
import os
import pickle
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import warnings
import weakref

import numpy as np

import coastmesh

PROGRAM, DATA = sys.argv[1:3]
LAKE = os.path.join(DATA, "lake_superior.geojson")
SQUARE = np.array([[0.0, 0], [4, 0], [4, 4], [0, 4]])
BOUNDARY = np.array([[0, 1], [1, 2], [2, 3], [3, 0]])
SPIKES = {"type": "Polygon", "coordinates": [[[0, 47.5], [-87.07, 47.25], [-87.25, 0], [-88, 47.5], [0, 47.75],
                                              [-87.5, 48], [0, 47.93], [-87, 47.5], [0, 47.5]]]}
POLYGON = {"type": "Polygon", "coordinates": [[[0, 0], [0.2, 0], [0.2, 0.2], [0, 0.2], [0, 0]]]}


def areas(mesh):
    a, b, c = (mesh.points[mesh.triangles[:, i]] for i in range(3))
    return ((b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])) / 2


def smallest_angles(mesh):
    corners = mesh.points[mesh.triangles]
    found = np.full(len(mesh.triangles), 180.0)
    for i in range(3):
        u, v = corners[:, i - 1] - corners[:, i], corners[:, i - 2] - corners[:, i]
        cross = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
        found = np.minimum(found, np.degrees(np.arctan2(np.abs(cross), (u * v).sum(axis=1))))
    return found


class ArraysTest(unittest.TestCase):
    def test_a_square_is_filled_and_its_points_come_back(self):
        mesh = coastmesh.mesh(SQUARE, BOUNDARY, min_angle=30, size_max=0.5)
        self.assertEqual((mesh.points.dtype, mesh.triangles.dtype), (np.float64, np.uint32))
        np.testing.assert_array_equal(mesh.points[:4], SQUARE)
        self.assertTrue((areas(mesh) > 0).all())
        self.assertAlmostEqual(areas(mesh).sum(), 16)
        self.assertGreaterEqual(smallest_angles(mesh).min(), 30 - 1e-9)
        np.testing.assert_allclose(smallest_angles(mesh), mesh.min_angle, atol=1e-6)
        self.assertEqual(mesh.crs, "")
        self.assertTrue(mesh.complete)

    def test_forms_of_a_plane_graph_give_the_same(self):
        hole = [[2.0, 2.0]]
        points = np.vstack([SQUARE, SQUARE / 4 + 1.5])
        segments = np.vstack([BOUNDARY, BOUNDARY + 4])
        expected = coastmesh.mesh(points, segments, hole)
        self.assertAlmostEqual(areas(expected).sum(), 15)
        for given in ((points, segments, hole), {"vertices": points, "segments": segments, "holes": hole}):
            np.testing.assert_array_equal(coastmesh.mesh(given).triangles, expected.triangles)
        # Arrays of another memory layout and type with the same numbers.
        same = coastmesh.mesh(np.asfortranarray(points), segments.astype(np.uint8), hole)
        np.testing.assert_array_equal(same.points, expected.points)
        listed = coastmesh.mesh(points.tolist(), segments.tolist(), hole)
        np.testing.assert_array_equal(listed.triangles, expected.triangles)

    def test_arrays_are_views_that_keep_the_mesh_and_cannot_be_written(self):
        mesh = coastmesh.mesh(SQUARE, BOUNDARY)
        first, second = mesh.points, mesh.points
        self.assertEqual(first.__array_interface__["data"][0], second.__array_interface__["data"][0])
        with self.assertRaises(ValueError):
            first[0, 0] = 1
        copy = first.copy()
        gone = weakref.ref(mesh)
        del mesh, second
        gc.collect()
        self.assertIsNone(gone())
        np.testing.assert_array_equal(first, copy)

    def test_wrong_input_raises_with_evidence(self):
        def refused(kind, pattern, *arguments, **options):
            with self.assertRaisesRegex(kind, pattern) as caught:
                coastmesh.mesh(*arguments, **options)
            return caught.exception

        refused(coastmesh.InputError, "names point 9", SQUARE, [[0, 9]])
        refused(coastmesh.InputError, "names point -1", SQUARE, [[0, -1]])
        refused(coastmesh.InputError, "whole numbers", SQUARE, [[0.5, 1]])
        refused(coastmesh.InputError, r"shape \(4, 3\)", np.zeros((4, 3)), BOUNDARY)
        refused(coastmesh.InputError, "not an array of numbers", [["a", "b"]] * 4, BOUNDARY)
        refused(coastmesh.InputError, "three or more", [], [])
        refused(coastmesh.InputError, "segments", SQUARE, "segments")
        refused(coastmesh.InputError, "holes", SQUARE, BOUNDARY, [[1, 2, 3]])
        crossing = refused(coastmesh.InputError, "cross", SQUARE, [[0, 2], [1, 3]])
        self.assertEqual(crossing.refusals[0]["place"], (2.0, 2.0))
        refused(coastmesh.InputError, "finite", np.where(SQUARE == 4, np.nan, SQUARE), BOUNDARY)
        refused(coastmesh.InputError, "finite", SQUARE, BOUNDARY, [[np.nan, 1]])
        refused(coastmesh.InputError, "beyond -1e70 to 1e70", SQUARE * 1e307, BOUNDARY)
        refused(coastmesh.InputError, "nearer to one another than 1e-70", SQUARE * 1e-200, BOUNDARY)
        refused(coastmesh.InputError, "finite", np.where(SQUARE == 4, np.inf, SQUARE), BOUNDARY)
        for wrong in (np.nan, np.inf):
            refused(coastmesh.InputError, "finite", SQUARE, BOUNDARY, holes=[[wrong, 1]])
        masked = np.ma.array(SQUARE, mask=np.zeros((4, 2), bool))
        self.assertEqual(len(coastmesh.mesh(masked, BOUNDARY).triangles), 2)
        masked[1, 0] = np.ma.masked
        refused(coastmesh.InputError, "points.*masked", masked, BOUNDARY)
        refused(coastmesh.InputError, "segments.*masked", SQUARE, np.ma.array(BOUNDARY, mask=BOUNDARY == 2))
        refused(coastmesh.InputError, "points.*complex", SQUARE + 1j, BOUNDARY)
        refused(coastmesh.InputError, "holes.*complex", SQUARE, BOUNDARY, np.array([[1 + 1j, 1]]))
        refused(TypeError, "config", SQUARE, BOUNDARY, config="nope.toml")
        refused(coastmesh.InputError, "same place", np.zeros((4, 2)), BOUNDARY)
        refused(coastmesh.InputError, "nowhere.shp", "nowhere.shp")
        refused(coastmesh.InputError, "GeoJSON", '{"type":')
        refused(coastmesh.InputError, "GeoJSON", {"type": "Point", "coordinates": [0, 0]})
        refused(coastmesh.InputError, "GeoJSON", {"type": "Polygon", "coordinates": [[[0, 0], [1, 1], [2, 2], [0, 0]]]})
        refused(coastmesh.InputError, "nothing to mesh", [])
        refused(coastmesh.OptionError, "^min_angle: '50' is not a number in the range 0 to 45$", SQUARE, BOUNDARY, min_angle=50)
        refused(coastmesh.OptionError, "min_angle", SQUARE, BOUNDARY, min_angle=True)
        for options in ({"bbox": (0, 0, 1, 1)}, {"clip": "nowhere.shp"}, {"crs": "EPSG:4326"}, {"layer": "a"},
                        {"dissolve": True}, {"snap": 1.0}, {"constraints": "nowhere.shp"}, {"edges": "geodesic"}):
            refused(coastmesh.OptionError, "the plane graph given", SQUARE, BOUNDARY, **options)
        refused(coastmesh.OptionError, "coarsen", SQUARE, BOUNDARY, coarsen="yes")
        refused(coastmesh.OptionError, "^size_max: 'nan'", SQUARE, BOUNDARY, size_max=float("nan"))
        refused(TypeError, "did you mean 'min_angle'", SQUARE, BOUNDARY, min_angel=30)
        refused(TypeError, "NoneType", None)
        refused(TypeError, "not callable", SQUARE, BOUNDARY, progress=3)
        self.assertTrue(issubclass(coastmesh.InputError, ValueError))


class OptionsTest(unittest.TestCase):
    def digest(self, source=POLYGON, **options):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return coastmesh.mesh(source, **options).report["mesh"]["digest"]

    def test_values_of_any_type_that_say_the_same_are_the_same(self):
        for forms in ({"size": [4000, 4000.0, "4000", np.float32(4000), np.int64(4000), np.array(4000)]},
                      {"threads": [1, "1", np.uint8(1)]},
                      {"smooth": [True, np.bool_(True)]},
                      {"bbox": [(0.05, 0, 0.2, 0.1), [0.05, 0, np.float64(0.2), 0.1], "0.05,0,0.2,0.1",
                                np.array([0.05, 0, 0.2, 0.1])]},
                      {"water_at": [(0.1, 0.1), "0.1,0.1", np.array([0.1, 0.1])]}):
            (name, values), = forms.items()
            self.assertEqual(len({self.digest(**{name: value}) for value in values}), 1, name)
        self.assertNotEqual(self.digest(size=4000), self.digest())
        self.assertEqual(self.digest(size=None, bbox=None), self.digest())
        self.assertEqual(self.digest(coarsen=True), self.digest())

    def test_lists_of_what_may_be_repeated(self):
        with tempfile.TemporaryDirectory() as folder:
            depths = os.path.join(folder, "depths.asc")
            with open(depths, "w", encoding="utf-8") as file:
                file.write("ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 0.1\n-5 -50\n-5 -50\n")
            given = {"bathymetry": os.path.join(folder, "depths.asc"), "size_max": 8000}
            bands = [self.digest(depth_band=band, **given) for band in (
                [(0, 10, 1000), (10, float("inf"), 3000)], ["0,10,1000", "10,inf,3000"], [[0, 10, 1000], "10,inf,3000"],
                np.array([[0, 10, 1000], [10, np.inf, 3000]]))]
            self.assertEqual(len(set(bands)), 1)
            one = [self.digest(depth_band=band, **given) for band in ((0, 10, 1000), [(0, 10, 1000)], "0,10,1000")]
            self.assertEqual(len(set(one)), 1)
            self.assertNotEqual(one[0], bands[0])
            self.assertEqual(self.digest(bathymetry=[depths]), self.digest(bathymetry=depths))

    def test_attributes(self):
        mesh = coastmesh.mesh(LAKE, attribute=["manning=0.02", "a=7"], size_max=8000)
        self.assertEqual(list(mesh.attributes), ["mannings_n_at_sea_floor", "a"])
        self.assertTrue((mesh.attributes["a"] == 7.0).all())
        self.assertEqual(len(mesh.attributes["mannings_n_at_sea_floor"]), len(mesh.points))
        again = pickle.loads(pickle.dumps(mesh))
        self.assertTrue((again.attributes["mannings_n_at_sea_floor"] == 0.02).all())
        self.assertEqual(coastmesh.mesh(LAKE).attributes, {})

    def test_what_is_no_value_is_refused_by_its_keyword(self):
        for options, said in (({"size": "4 km"}, "size: '4 km' is not a number in the range above 0"),
                              ({"size": 10**400}, "size: '1000"),
                              ({"size": [3]}, "size: [3] is not a number"),
                              ({"size": True}, "size: True is not a number"),
                              ({"threads": 1.5}, "threads: '1.5' is not a whole number in the range 0 to 1024"),
                              ({"threads": -1}, "threads: '-1' is not a whole number"),
                              ({"threads": 2**70}, "threads: '1180591620717411303424' is not a whole number"),
                              ({"coast": "melt"}, "coast: 'melt' is none of keep, follow"),
                              ({"coast": 3}, "coast: 3 is not a text"),
                              ({"clip": 3.5}, "clip: a float is neither a path nor GeoJSON"),
                              ({"bathymetry": 3.5}, "bathymetry: 3.5 is not the path of a file"),
                              ({"bbox": (1, 2, 3)}, "bbox: '(1, 2, 3)' is not W,S,E,N"),
                              ({"bbox": (1, 2, 3, "x")}, "bbox: (1, 2, 3, 'x') is not a list of numbers"),
                              ({"bbox": (1, 2, 3, float("inf"))}, "bbox: '(1, 2, 3, inf)' is not"),
                              ({"depth_band": (10, 5, 100)}, "depth_band: '(10, 5, 100)' ends before it begins"),
                              ({"coarsen": 1}, "coarsen: 1 is neither True nor False")):
            with self.assertRaises(coastmesh.OptionError) as caught:
                coastmesh.mesh(POLYGON, **options)
            self.assertTrue(str(caught.exception).startswith(said), str(caught.exception))

    def test_no_message_names_an_option_of_the_command_line(self):
        for options, said in (({"size_min": 9, "size_max": 8}, "size_min is more than size_max"),
                              ({"wave_elements": 50}, "give a raster with bathymetry"),
                              ({"coast": "follow"}, "coast='follow' needs sizes"),
                              ({"domain": "outside"}, "domain='outside': the water needs a limit"),
                              ({"crs": "nowhere"}, "crs: ")):
            with self.assertRaises(coastmesh.Error) as caught, warnings.catch_warnings():
                warnings.simplefilter("ignore")
                coastmesh.mesh(POLYGON, **options)
            self.assertIn(said, str(caught.exception))
            self.assertNotIn("--", str(caught.exception))

    def test_why_there_is_nothing_to_mesh(self):
        with self.assertRaises(coastmesh.InputError) as caught:
            coastmesh.mesh(POLYGON, bbox=(-1, -1, 1, 1), water_at=(8, 8))
        self.assertIn("water_at 8.000000,8.000000: lies outside", str(caught.exception))
        self.assertEqual(caught.exception.refusals, [])

    def test_a_column_of_the_input_says_its_boundaries(self):
        with tempfile.TemporaryDirectory() as folder:
            lake = os.path.join(folder, "lake.geojson")
            with open(lake, "w", encoding="utf-8") as file:
                json.dump({"type": "Feature", "properties": {"shore": "open"}, "geometry": POLYGON}, file)
            mesh = coastmesh.mesh(lake, boundary_column="shore")
            self.assertEqual({boundary["role"] for boundary in mesh.boundaries}, {"open"})


class FilesTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)

    def path(self, name):
        return os.path.join(self.folder, name)

    def test_a_file_gives_what_the_program_makes_of_it(self):
        mesh = coastmesh.mesh(LAKE, min_angle=34, threads=1)
        report = self.path("report.json")
        command = [PROGRAM, "mesh", LAKE, "-o", self.path("lake.nc"), "--min-angle", "34", "--report", report, "--quiet"]
        subprocess.run(command, check=True)
        with open(report, encoding="utf-8") as file:
            said = json.load(file)
        self.assertEqual(mesh.report["mesh"]["digest"], said["mesh"]["digest"])
        self.assertEqual(mesh.report["refine"], said["refine"])
        self.assertEqual(len(mesh.triangles), said["mesh"]["triangles"])
        self.assertEqual(mesh.crs, "EPSG:4326")
        self.assertEqual(mesh.features[0]["attributes"]["name"], "Lake Superior")
        self.assertEqual({b["role"] for b in mesh.boundaries}, {"land", "island"})
        read = coastmesh.read(self.path("lake.nc"))
        np.testing.assert_array_equal(read.points, mesh.points)
        np.testing.assert_array_equal(read.triangles, mesh.triangles)
        self.assertIsNone(read.report)

    def test_meshes_the_outline_of_a_shape(self):
        line = {"type": "LineString", "coordinates": POLYGON["coordinates"][0]}

        class Ring:
            __geo_interface__ = {**line, "type": "LinearRing"}  # of shapely

        np.testing.assert_array_equal(coastmesh.mesh(Ring()).points, coastmesh.mesh(line).points)

    def test_geojson_as_dict_text_and_interface(self):
        expected = coastmesh.mesh(POLYGON)
        self.assertEqual(expected.crs, "EPSG:4326")

        class Shape:
            __geo_interface__ = POLYGON

        for given in (json.dumps(POLYGON), {"type": "Feature", "properties": {}, "geometry": POLYGON}, Shape()):
            np.testing.assert_array_equal(coastmesh.mesh(given).points, expected.points)
        self.assertEqual(expected.features[0]["source"], "GeoJSON")

    def test_a_geo_interface_that_is_no_geojson_is_refused(self):
        class Shape:
            __geo_interface__ = 7

        for given in (Shape(), [Shape()]):
            with self.assertRaisesRegex(TypeError, "the __geo_interface__ of a Shape is no dict"):
                coastmesh.mesh(given)

    def test_lists_of_shapes_are_meshed_together(self):
        class Shape:
            crs = None

            def __init__(self, east):
                ring = [[x + east, y] for x, y in POLYGON["coordinates"][0]]
                self.__geo_interface__ = {"type": "Polygon", "coordinates": [ring]}

        mesh = coastmesh.mesh([Shape(0), Shape(1)])
        self.assertEqual(len(mesh.features), 2)
        self.assertAlmostEqual(areas(mesh).sum(), 0.08)
        # GeoJSON as dicts and as texts, and arrays of shapes.
        shapes = [Shape(0).__geo_interface__, Shape(1).__geo_interface__]
        for given in (shapes, tuple(shapes), [json.dumps(shape) for shape in shapes], [Shape(0), shapes[1]],
                      np.array([Shape(0), Shape(1)], dtype=object)):
            np.testing.assert_array_equal(coastmesh.mesh(given).points, mesh.points)
        with self.assertRaisesRegex(TypeError, "number 1 of the list is a int"):
            coastmesh.mesh([Shape(0), 3])
        other = Shape(1)
        other.crs = "EPSG:3067"
        with self.assertRaisesRegex(coastmesh.InputError, "another CRS"):
            coastmesh.mesh([Shape(0), other])

    def test_a_crs_without_a_code_is_refused(self):
        class Crs:
            def to_authority(self):
                return None

        class Shape:
            __geo_interface__ = POLYGON
            crs = Crs()

        with self.assertRaisesRegex(coastmesh.InputError, "no code"):
            coastmesh.mesh([Shape()])

    def test_a_crs_is_that_of_the_shapes_however_they_name_it(self):
        class Crs:
            def to_authority(self):
                return ("EPSG", "32633")

        class Shape:
            __geo_interface__ = {"type": "Polygon", "coordinates": [[[0, 0], [80, 0], [80, 80], [0, 80], [0, 0]]]}

        named = {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::32633"}}
        shape = Shape()
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # so few metres could be degrees
            for crs in (Crs(), "EPSG:32633", named):
                shape.crs = crs
                self.assertEqual(coastmesh.mesh(shape).crs, "EPSG:32633")
                self.assertEqual(coastmesh.mesh([shape, shape], dissolve=True).crs, "EPSG:32633")
            self.assertEqual(coastmesh.mesh({**Shape.__geo_interface__, "crs": named}).crs, "EPSG:32633")
            self.assertEqual(coastmesh.mesh([{**Shape.__geo_interface__, "crs": named}]).crs, "EPSG:32633")
        shape.crs = {"init": "epsg:32633"}
        with self.assertRaisesRegex(coastmesh.InputError, "no code"):
            coastmesh.mesh(shape)

    def test_attributes_and_coordinates_of_any_type(self):
        class Shape:
            __geo_interface__ = POLYGON

        ring = np.array(POLYGON["coordinates"][0])
        properties = {"day": datetime.date(2024, 2, 29), "count": np.int64(3), "share": np.float32(0.5), "none": None}
        feature = {"type": "Feature", "properties": properties, "geometry": {"type": "Polygon", "coordinates": [ring]}}
        mesh = coastmesh.mesh(feature)
        np.testing.assert_array_equal(mesh.points, coastmesh.mesh(POLYGON).points)
        attributes = mesh.features[0]["attributes"]
        self.assertEqual((attributes["count"], attributes["share"]), ("3", "0.5"))
        self.assertIn("29", attributes["day"])
        np.testing.assert_array_equal(coastmesh.mesh({**feature, "geometry": Shape()}).points, mesh.points)

    def test_files_that_models_would_misread_are_warned_of(self):
        mesh = coastmesh.mesh(POLYGON)
        with self.assertWarnsRegex(coastmesh.CoastmeshWarning, "says 0 everywhere; give bathymetry"):
            mesh.write(self.path("fort.14"))

    def test_meshes_are_pickled_and_copied(self):
        mesh = coastmesh.mesh(LAKE, min_angle=30, threads=1)
        twins = [pickle.loads(pickle.dumps(mesh, protocol)) for protocol in range(pickle.HIGHEST_PROTOCOL + 1)]
        for twin in (*twins, copy.deepcopy(mesh)):
            for name in ("points", "triangles", "min_angle", "area", "feature"):
                np.testing.assert_array_equal(getattr(twin, name), getattr(mesh, name))
            self.assertEqual((twin.crs, twin.report, twin.features), (mesh.crs, mesh.report, mesh.features))
            self.assertEqual(len(twin.boundaries), len(mesh.boundaries))
            for own, other in zip(twin.boundaries, mesh.boundaries):
                np.testing.assert_array_equal(own["nodes"], other["nodes"])
            for got, name in ((twin, "twin.nc"), (mesh, "mesh.nc")):
                got.write(self.path(name), overwrite=True)
        with open(self.path("twin.nc"), "rb") as one, open(self.path("mesh.nc"), "rb") as two:
            self.assertEqual(one.read(), two.read())
            self.assertTrue(two.tell())
        made = coastmesh.mesh(SQUARE, BOUNDARY)._made
        whole = made.__getstate__()
        for damaged in (whole[:-1], whole + b"x", b"", whole.replace(whole[8:13], b"0.0.x", 1)):
            with self.assertRaisesRegex(Exception, "pickled"):
                type(made).__new__(type(made)).__setstate__(damaged)

    def test_names_of_files_that_are_no_text(self):
        name = os.fsdecode(os.path.join(os.fsencode(self.folder), b"lake-\xff.geojson"))
        with open(name, "w", encoding="utf-8") as file:
            json.dump(POLYGON, file)
        mesh = coastmesh.mesh(name)
        self.assertEqual(mesh.features[0]["source"], name)
        mesh.write(name + ".2dm")
        self.assertEqual(len(coastmesh.read(name + ".2dm").points), len(mesh.points))
        mesh.plot(name + ".png", size=100)
        self.assertTrue(os.path.exists(name + ".png"))
        with self.assertRaises(coastmesh.OutputError) as caught:
            mesh.write(name + ".2dm")
        self.assertIn("\udcff", str(caught.exception))
        with self.assertRaises(coastmesh.InputError) as caught:
            coastmesh.mesh(name + ".missing")
        self.assertIn("\udcff", str(caught.exception))

    def test_what_is_left_out_is_warned_of(self):
        flat = {"type": "Polygon", "coordinates": [[[5, 5], [6, 6], [7, 7], [5, 5]]]}
        features = [{"type": "Feature", "properties": {}, "geometry": g} for g in (POLYGON, flat)]
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            mesh = coastmesh.mesh({"type": "FeatureCollection", "features": features})
        self.assertFalse(mesh.complete)
        self.assertTrue(any("left out" in str(w.message) for w in caught))

    def test_former_names_of_options_are_taken_with_a_warning(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            former = coastmesh.mesh(SQUARE, BOUNDARY, size_max=0.3, shrink=False)
        self.assertEqual([str(w.message) for w in caught],
                         ["shrink is called coarsen now; the next version will not accept the former name"])
        present = coastmesh.mesh(SQUARE, BOUNDARY, size_max=0.3, coarsen=False)
        self.assertFalse(former.report["refine"]["coarsen"])
        self.assertEqual(former.report["mesh"]["digest"], present.report["mesh"]["digest"])

    def test_options_without_effect_are_warned_of(self):
        def said(**options):
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                mesh = coastmesh.mesh(POLYGON, **options)
            texts = [str(w.message) for w in caught if w.category is coastmesh.CoastmeshWarning]
            self.assertEqual(mesh.report["warnings"], texts)
            return texts

        self.assertEqual(said(courant=0.5, min_depth=2), ["courant has no effect without time_step",
                                                          "min_depth has no effect without bathymetry"])
        self.assertEqual(said(coast="keep", land_min=2), ["land_min has no effect without coast='follow'"])
        self.assertEqual(said(size=5000, coast="follow", land_min=2), [])
        self.assertEqual(said(mark_pieces=True), [])

    def test_what_is_odd_in_the_result_is_warned_of_as_the_program_does(self):
        with open(self.path("spike.geojson"), "w", encoding="utf-8") as file:
            json.dump(SPIKES, file)
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            coastmesh.mesh(self.path("spike.geojson"))
        run = subprocess.run([PROGRAM, "mesh", self.path("spike.geojson"), "-o", self.path("spike.nc")],
                             capture_output=True, text=True, check=False)
        expected = [line.split("warning: ", 1)[1] for line in run.stderr.splitlines() if "warning: " in line]
        self.assertTrue(any("not counter-clockwise on the ground" in line for line in expected))
        self.assertEqual([str(w.message) for w in caught], expected)

    def test_a_picture_on_a_globe_instead_of_a_plane_is_warned_of(self):
        mesh = coastmesh.mesh(POLYGON, domain="globe", size=2e6)
        with self.assertWarnsRegex(coastmesh.CoastmeshWarning, "too large for a plane"):
            mesh.plot(self.path("globe.png"), size=100)

    def test_pictures_come_into_place_as_other_files_do(self):
        mesh = coastmesh.mesh(POLYGON)
        os.mkfifo(self.path("pipe.png"))
        os.symlink("elsewhere.png", self.path("link.png"))
        for name in ("pipe.png", "link.png"):
            with self.assertRaisesRegex(coastmesh.OutputError, name):
                mesh.plot(self.path(name), overwrite=True)
        mesh.plot(self.path("lake.svg"))
        with self.assertRaisesRegex(coastmesh.OutputError, "overwrite=True"):
            mesh.plot(self.path("lake.svg"))
        # An existing file with the name of a temporary one is not removed.
        with open(self.path(".part-lake.png"), "w", encoding="utf-8") as file:
            file.write("precious")
        mesh.plot(self.path("lake.png"))
        with open(self.path(".part-lake.png"), encoding="utf-8") as file:
            self.assertEqual(file.read(), "precious")
        with self.assertRaisesRegex(coastmesh.OptionError, "pieces.* mark_pieces=True"):
            mesh.plot(self.path("other.png"), color="piece")
        with self.assertRaisesRegex(coastmesh.InputError, "depth"):
            mesh.plot(self.path("other.png"), color="depth")
        pieces = coastmesh.mesh(POLYGON, mark_pieces=True)
        pieces.plot(self.path("pieces.png"), color="piece")
        self.assertEqual(sorted(os.listdir(self.folder)),
                         [".part-lake.png", "lake.png", "lake.svg", "link.png", "pieces.png", "pipe.png"])

    def test_writes_and_draws_whole_files(self):
        mesh = coastmesh.mesh(POLYGON)
        mesh.write(self.path("lake.2dm"))
        with self.assertRaises(coastmesh.OutputError):
            mesh.write(self.path("lake.2dm"))
        mesh.write(self.path("lake.2dm"), overwrite=True)
        with self.assertRaises(coastmesh.OutputError):
            mesh.write(self.path("lake.unheard-of"))
        mesh.plot(self.path("lake.png"), size=200)
        with open(self.path("lake.png"), "rb") as file:
            self.assertEqual(file.read(8), b"\x89PNG\r\n\x1a\n")
        mesh.plot(self.path("lake.html"), color="size", edges=False)
        with open(self.path("lake.html"), encoding="utf-8") as file:
            page = file.read()
        self.assertTrue(page.startswith("<!doctype html>"))
        self.assertIn('"color":"size","edges":false', page)
        self.assertIn(f'"triangles":{len(mesh.triangles)},', page)
        with self.assertRaises(coastmesh.OptionError):
            mesh.plot(self.path("other.png"), color="pink")
        with self.assertRaises(coastmesh.OutputError) as caught:
            mesh.plot(self.path("missing/lake.png"))
        self.assertIn(self.path("missing/lake.png"), str(caught.exception))
        os.mkdir(self.path("folder.png"))
        with self.assertRaises(coastmesh.OutputError) as caught:
            mesh.plot(self.path("folder.png"), overwrite=True)
        self.assertIn("'" + self.path("folder.png"), str(caught.exception))
        os.rmdir(self.path("folder.png"))
        for size in (0, 15, -1, 20001, 10**9, 10**30, 3.5, True):
            with self.assertRaisesRegex(coastmesh.OptionError, "size"):
                mesh.plot(self.path("other.png"), size=size)
        left = sorted(name for name in os.listdir(self.folder) if not name.endswith(".prj"))
        self.assertEqual(left, ["lake.2dm", "lake.html", "lake.png"])


class RunTest(unittest.TestCase):
    LONG = {"size_max": 0.004}  # takes some seconds

    def test_progress_is_told_in_this_thread_and_what_it_raises_ends_the_run(self):
        told = []
        coastmesh.mesh(SQUARE, BOUNDARY, size_max=0.02, progress=lambda p, s: told.append((p, s, threading.get_ident())))
        self.assertTrue(told)
        self.assertEqual({thread for _, _, thread in told}, {threading.get_ident()})
        self.assertTrue(all(0 <= share <= 1 for _, share, _ in told))

        def stop(phase, share):
            raise RuntimeError("enough")

        with self.assertRaisesRegex(RuntimeError, "enough"):
            coastmesh.mesh(SQUARE, BOUNDARY, progress=stop, **self.LONG)

    def test_ctrl_c_ends_a_long_run(self):
        timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            coastmesh.mesh(SQUARE, BOUNDARY, **self.LONG)
        self.assertEqual(len(coastmesh.mesh(SQUARE, BOUNDARY).triangles), 2)

    def test_other_threads_run_meanwhile(self):
        counted = 0
        done = threading.Event()

        def work():
            coastmesh.mesh(SQUARE, BOUNDARY, size_max=0.02)
            done.set()

        thread = threading.Thread(target=work)
        thread.start()
        while not done.is_set():
            counted += 1
            time.sleep(0.001)
        thread.join()
        self.assertGreater(counted, 5)

    def test_several_runs_at_once_give_the_same(self):
        meshes = [None] * 4

        def work(i):
            meshes[i] = coastmesh.mesh(SQUARE, BOUNDARY, size_max=0.1)

        threads = [threading.Thread(target=work, args=(i,)) for i in range(len(meshes))]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for mesh in meshes[1:]:
            np.testing.assert_array_equal(mesh.points, meshes[0].points)


class DocumentationTest(unittest.TestCase):
    def test_without_docstrings_the_module_can_be_imported(self):
        run = subprocess.run([sys.executable, "-OO", "-c", "import coastmesh; print(coastmesh.mesh.__doc__)"],
                             capture_output=True, text=True, check=False)
        self.assertEqual(run.stdout, "None\n", run.stderr)

    def test_every_option_is_in_docstring_and_stubs(self):
        usage = json.loads(subprocess.run([PROGRAM, "mesh", "--json-usage"], capture_output=True, check=True).stdout)
        with open(os.path.join(os.path.dirname(coastmesh.__file__), "__init__.pyi"), encoding="utf-8") as file:
            stubs = file.read()
        self.assertTrue(set(coastmesh.options()) <= {o["name"][2:].replace("-", "_") for o in usage["options"]})
        self.assertIn("min_angle", coastmesh.options())
        for name in coastmesh.options():
            self.assertIn(f"{name}: ", coastmesh.mesh.__doc__)
            self.assertIn(f"    {name}: Optional[", stubs)
        compile(stubs, "stubs", "exec")
        for name in coastmesh.__all__:
            self.assertTrue(getattr(coastmesh, name).__doc__, name)
            self.assertIn(name, stubs)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2)
