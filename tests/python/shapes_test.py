#!/usr/bin/python3
"""Options of the Python module that name vector files take shapes as well. PYTHONPATH finds coastmesh.

usage: shapes_test.py
"""
import datetime
import decimal
import hashlib
import json
import math
import os
import re
import shutil
import tempfile
import unittest
import warnings

import numpy as np

import coastmesh
from coastmesh._usage import FUNCTIONS

# Two waters, and a strait between them that is closed where the coast follows sizes of 3 km.
LAKE = {"type": "Polygon", "coordinates": [[[5, 45], [5.2, 45], [5.2, 45.096], [5.25, 45.096], [5.25, 45], [5.45, 45],
                                            [5.45, 45.2], [5.25, 45.2], [5.25, 45.1], [5.2, 45.1], [5.2, 45.2], [5, 45.2],
                                            [5, 45]]]}


def feature(kind, coordinates, **properties):
    return {"type": "Feature", "properties": properties, "geometry": {"type": kind, "coordinates": coordinates}}


def polygon(west, south, east, north, **properties):
    ring = [[west, south], [east, south], [east, north], [west, north], [west, south]]
    return feature("Polygon", [ring], **properties)


# Two features for each option, of which the mesh tells the attributes.
SHAPES = {
    "clip": [polygon(4.9, 44.9, 5.1, 45.3), polygon(5.35, 44.9, 5.5, 45.3)],
    "constraints": [feature("LineString", [[5.05, 45.05], [5.15, 45.05]], name="sill"), feature("Point", [5.1, 45.15])],
    "weirs": [feature("LineString", [[5.05, 45.05], [5.15, 45.05]], name="north weir"),
              feature("LineString", [[5.3, 45.05], [5.4, 45.05]], name="south weir")],
    "regions": [polygon(5.04, 45.04, 5.1, 45.1, name="reef"), polygon(5.3, 45.04, 5.4, 45.1, name="bank")],
    "size_features": [feature("Point", [5.1, 45.1], size=500, rate=0.3), feature("Point", [5.35, 45.1], size=np.float32(800))],
    "passages": [feature("LineString", [[5.15, 45.098], [5.22, 45.098]], name="west"),
                 feature("LineString", [[5.22, 45.098], [5.3, 45.098]], name="east")],
    "barriers": [feature("LineString", [[5.1, 44.9], [5.1, 45.3]]), feature("LineString", [[5.35, 44.9], [5.35, 45.3]])],
    "boundaries": [polygon(4.99, 45.05, 5.01, 45.15, type="open"), polygon(5.44, 45.05, 5.46, 45.15, type="river")],
    "within": [polygon(5, 45, 5.1, 45.1), polygon(5.35, 45, 5.45, 45.1)],
    "outside": [polygon(5, 45, 5.1, 45.1), polygon(5.35, 45, 5.45, 45.1)],
    "banks": [polygon(5.44, 45.095, 5.8, 45.105), polygon(4.6, 45.096, 5.01, 45.104)],
}
# From both ends of the lake.
RIVERS = [feature("LineString", [[5.44, 45.1], [5.8, 45.1]], width=500), feature("LineString", [[5.01, 45.1], [4.6, 45.1]], width=500)]


class Shape:
    def __init__(self, geojson, crs=None):
        self.__geo_interface__ = geojson
        self.crs = crs


def collection(features, **more):
    return {"type": "FeatureCollection", **more, "features": features}


class ShapesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.coarse = cls.quietly(coastmesh.mesh, LAKE, size=4000)

    @staticmethod
    def quietly(function, *arguments, **options):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return function(*arguments, **options)

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, geojson):
        with open(self.path(name), "w", encoding="utf-8") as file:
            json.dump(geojson, file, default=float)
        return self.path(name)

    def made(self, function, **options):
        """A digest of the mesh that a function makes, as a file has it; None for a function that needs an option."""
        base = {"mesh": {"size": 3000, "coast": "follow"}, "remesh": {"size": 2000}}.get(function, {})
        if function == "remesh" and not {"within", "outside"} & options.keys():
            base["bbox"] = (5, 45, 5.45, 45.2)
        if function == "cut" and not options:
            return None
        given = {"mesh": [LAKE], "rivers": [self.coarse, RIVERS]}.get(function, [self.coarse])
        mesh = self.quietly(getattr(coastmesh, function), *given, **base, **options)
        self.quietly(mesh.write, self.path("made.nc"), overwrite=True)
        with open(self.path("made.nc"), "rb") as file:
            return hashlib.sha256(file.read()).hexdigest()

    def caught(self, **options):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            mesh = coastmesh.mesh(LAKE, size=3000, coast="follow", **options)
        return [str(one.message) for one in caught], mesh

    def refused(self, kind, pattern, function="mesh", **options):
        with self.assertRaisesRegex(kind, pattern) as caught:
            self.made(function, **options)
        self.assertNotIn("vsimem", str(caught.exception))


class FormsTest(ShapesTest):
    def assert_takes_shapes(self, function, name, multiple):
        self.assertIn(name, SHAPES, f"{name} names a vector file: say in SHAPES what it reads")
        one, two = SHAPES[name]
        both = collection([one, two])
        expected = self.made(function, **{name: self.write("both.geojson", both)})
        self.assertNotEqual(expected, self.made(function))
        same = {"a dict": both, "a text": json.dumps(both, default=float), "an interface": Shape(both, "EPSG:4326"),
                "a list": [one, two], "a tuple": (Shape(one), two), "an array": np.array([Shape(one), Shape(two)], dtype=object)}
        if multiple:
            paths = [self.write("one.geojson", one), self.write("two.geojson", two)]
            same.update({"paths": paths, "a path and a shape": [paths[0], two], "a shape and a path": (Shape(one), paths[1])})
        for kind, given in same.items():
            self.assertEqual(self.made(function, **{name: given}), expected, f"{function}, {name}, {kind}")
        self.assertNotEqual(self.made(function, **{name: one}), expected)
        self.refused(coastmesh.OptionError, rf"^{name}: a float is neither a path nor GeoJSON", function, **{name: 3.5})
        self.refused(coastmesh.InputError, rf"^{name}: GeoJSON: ", function, **{name: '{"type":'})
        self.refused(coastmesh.InputError, rf"^'{name}', feature 0: ", function, **{name: feature("Heap", [])})
        self.assertRegex(getattr(coastmesh, function).__doc__, rf"\n        {name}: .*\(FILE or shapes\)\n")

    def test_every_option_that_names_vector_files_takes_shapes(self):
        taken = set()
        for function in FUNCTIONS:
            for name, option in coastmesh.options(function).items():
                if option["type"] != "file":
                    continue
                self.assertIn(option["role"], ("vector", "raster"), f"{function}, {name}: of which kind are its files?")
                if option["role"] == "vector":
                    taken.add(name)
                    with self.subTest(function=function, option=name):
                        self.assert_takes_shapes(function, name, option.get("multiple"))
        self.assertEqual(taken, set(SHAPES))

    def test_shapes_in_a_crs_of_their_own(self):
        radius, (x, y) = 6378137.0, (5.1, 45.15)
        mercator = [radius * math.radians(x), radius * math.log(math.tan(math.pi / 4 + math.radians(y) / 2))]
        named = {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::3857"}}
        point = {"type": "Point", "coordinates": mercator}
        for given in (Shape(point, "EPSG:3857"), Shape(point, 3857), Shape(point, np.int32(3857)), [Shape(point, "EPSG:3857")], collection([feature(**{
                "kind": "Point", "coordinates": mercator})], crs=named)):
            mesh = self.quietly(coastmesh.mesh, LAKE, size=3000, constraints=given)
            self.assertLess(np.hypot(*(mesh.points - (x, y)).T).min(), 1e-9)
        self.refused(coastmesh.InputError, "^constraints: number 1 of the list is in another CRS", constraints=[
            Shape(point, "EPSG:3857"), SHAPES["constraints"][1]])
        self.refused(coastmesh.InputError, "^clip: the CRS of the shapes has no code", clip=Shape(LAKE, "my own"))

    def test_layers_of_files_beside_shapes(self):
        named = self.write("named.geojson", collection(SHAPES["weirs"][:1], name="dikes"))
        expected = self.made("mesh", weirs=SHAPES["weirs"])
        for path in (named + "|dikes", named + "|layername=dikes"):
            self.assertEqual(self.made("mesh", weirs=[path, SHAPES["weirs"][1]]), expected)
        self.refused(coastmesh.InputError, "has no layer 'piers'", weirs=[named + "|piers", SHAPES["weirs"][1]])

    def test_the_last_one_counts_in_the_order_that_is_given(self):
        opened, closed = polygon(4.99, 45.05, 5.01, 45.15, type="open"), polygon(4.99, 45.05, 5.01, 45.15, type="land")
        path = self.write("closed.geojson", closed)
        for given, roles in (([opened, path], {"land"}), ([path, opened], {"land", "open"}),
                             ([opened, path, opened], {"land", "open"})):
            mesh = self.quietly(coastmesh.mesh, LAKE, boundaries=given)
            self.assertEqual({boundary["role"] for boundary in mesh.boundaries}, roles)
            self.assertNotIn("vsimem", json.dumps(mesh.report))

    def test_attributes_of_any_type(self):
        size = {"when": datetime.date(2024, 2, 29), "none": None, "rate": np.float64(0.3), "size": np.int64(500)}
        self.assertEqual(self.made("mesh", size_features=feature("Point", [5.1, 45.1], **size)),
                         self.made("mesh", size_features=feature("Point", [5.1, 45.1], size=500, rate=0.3)))
        opened = self.quietly(coastmesh.mesh, LAKE, boundary_column="shore",
                              boundaries=polygon(4.99, 45.05, 5.01, 45.15, type="land", shore="open"))
        self.assertIn("open", {boundary["role"] for boundary in opened.boundaries})
        passed = self.quietly(coastmesh.mesh, LAKE, size=3000, coast="follow", passages=SHAPES["passages"])
        self.assertIn("passage 'west'", " ".join(passed.report["input"]["notes"]))


    def test_missing_attributes_of_tables(self):
        class NAType:  # as of pandas: it is equal to nothing, and has no truth
            def __eq__(self, other):
                return self

            def __bool__(self):
                raise TypeError("boolean value of NA is ambiguous")

        without = self.made("mesh", size_features=feature("Point", [5.1, 45.1], size=500))
        for missing in (None, math.nan, np.float32("nan"), np.datetime64("NaT"), NAType(), decimal.Decimal("nan")):
            self.assertEqual(self.made("mesh", size_features=feature("Point", [5.1, 45.1], size=500, rate=missing)), without)

    def test_attributes_come_back_as_text(self):
        values = {"flag": np.bool_(True), "day": np.datetime64("2024-02-29T12:00:00", "ns"), "name": np.str_("Eider"),
                  "rank": np.int8(3), "width": decimal.Decimal("2.5"), 7: "seven", "none": np.ma.masked, "old": False,
                  "path": os.PathLike}
        for lake in ({"type": "Feature", "properties": values, "geometry": LAKE},
                     collection([Shape({"type": "Feature", "properties": values, "geometry": LAKE})])):
            attributes = self.quietly(coastmesh.mesh, lake).features[0]["attributes"]
            self.assertTrue(attributes.pop("day").startswith("2024"))
            self.assertEqual(attributes, {"flag": "1", "name": "Eider", "rank": "3", "width": "2.5", "7": "seven", "old": "0",
                                          "path": str(os.PathLike)})

    def test_attributes_that_no_file_holds_are_named(self):
        point = SHAPES["size_features"][0]
        for value, what in ((object(), "is a object, neither"), (b"x", "is a bytes, neither"), (1j, "is a complex, neither"),
                            (math.inf, "is infinite"), (np.float32("-inf"), "is infinite")):
            odd = feature("Point", [5.1, 45.1], size=500, note=value)
            self.refused(coastmesh.InputError, f"^size_features: attribute 'note' of feature 1 {what}", size_features=[point, odd])
            self.refused(coastmesh.InputError, f"^size_features: attribute 'note' of feature 0 {what}", size_features=odd)


class MessagesTest(ShapesTest):
    def test_errors_name_the_option_and_the_feature(self):
        point, far = feature("Point", [5.1, 45.1]), feature("LineString", [[50, 5], [51, 5]])
        path, sized = self.write("far.geojson", far), self.write("sized.geojson", SHAPES["size_features"][0])
        for pattern, options in (
                ("^'size_features': has no attribute 'size'", {"size_features": point}),
                ("^'size_features', feature 1: ", {
                    "size_features": [SHAPES["size_features"][0], feature("Point", [5.1, 45.1], size=-1)]}),
                (r"^'size_features\[1\]': has no attribute 'size'", {"size_features": [sized, point]}),
                ("^'boundaries', feature 0: \"opn\" is not a type", {"boundaries": polygon(4.9, 45, 5.1, 46, type="opn")}),
                ("^'clip': holds points only", {"clip": point}),
                ("^'passages': holds no lines", {"passages": polygon(5, 45, 5.1, 45.1)}),
                ("^'constraints': holds no feature", {"constraints": collection([])}),
                (r"^regions\[1\]: number 1 of the list is a FeatureCollection without", {
                    "regions": [path, point, {"type": "FeatureCollection"}]}),
                ("nowhere.shp': no such file", {"weirs": [far, "nowhere.shp"]})):
            self.refused(coastmesh.InputError, pattern, **options)
        for pattern, options in (
                ("^clip: takes one path, or shapes, not 2 paths$", {"clip": [LAKE, path]}),
                ("^constraints: a list is neither a path nor GeoJSON, and has no __geo_interface__$", {
                    "constraints": np.array([[5.1, 45.1]])}),
                ("^weirs: a NoneType is neither", {"weirs": [far, None]})):
            self.refused(coastmesh.OptionError, pattern, **options)
        self.refused(TypeError, "^barriers: the __geo_interface__ of a Shape is no dict$", barriers=Shape(7))

        class Values:  # of geopandas, whose shapes do not say its CRS
            crs = "EPSG:3857"

            def tolist(self):
                return [Shape(point)]

        self.refused(coastmesh.OptionError, "^constraints: a Values is neither", constraints=Values())

    def test_warnings_name_the_option(self):
        far = feature("LineString", [[50, 5], [51, 5]])
        path = self.write("beyond.geojson", far)
        said = ["constraints: nothing of it lies in the water; is its CRS right?"]
        self.assertEqual(self.caught(constraints=far)[0], said)
        warned, mesh = self.caught(constraints=[path, far, path], passages=far)
        self.assertEqual(warned, ["passages: no line of it lies in the mesh, or near it; is its CRS right?",
                                  said[0].replace("constraints", "constraints " + path),
                                  said[0].replace("constraints", "constraints[1]"),
                                  said[0].replace("constraints", "constraints " + path)])
        self.assertEqual(mesh.report["warnings"], warned)
        self.assertTrue(re.search("polygons are left out", self.caught(weirs=polygon(5.01, 45.01, 5.02, 45.02))[0][0]))

    def test_no_shapes_are_none(self):
        self.assertEqual(self.made("mesh", constraints=[], weirs=(), clip=None), self.made("mesh"))

    def test_what_needs_another_option_is_warned_of_for_shapes_as_well(self):
        with self.assertWarnsRegex(coastmesh.CoastmeshWarning, "^passages has no effect without coast='follow'$"):
            coastmesh.mesh(LAKE, passages=SHAPES["passages"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
