#!/usr/bin/python3
"""Meshes of arrays, and depths from arrays. PYTHONPATH finds coastmesh.

usage: from_arrays_test.py DATA   (the folder data/)
"""
import os
import pickle
import shutil
import sys
import tempfile
import unittest
import warnings

import numpy as np

import coastmesh

DATA = sys.argv[1]
LAKE = os.path.join(DATA, "lake_superior.geojson")
BOX = (-91, 46.5, -90, 47)
POINTS = np.array([[0, 0], [80, 0], [80, 80], [0, 80], [40, 40]], float)
TRIANGLES = np.array([[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
made = coastmesh.Mesh.from_arrays


class FromArraysTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)

    def path(self, name):
        return os.path.join(self.folder, name)

    def assert_same(self, mesh, other):
        for name in ("points", "triangles", "z"):
            np.testing.assert_array_equal(getattr(mesh, name), getattr(other, name), name)
        self.assertEqual(mesh.crs, other.crs)
        self.assertEqual([(one["role"], one["closed"], one["nodes"].tolist()) for one in mesh.boundaries],
                         [(one["role"], one["closed"], one["nodes"].tolist()) for one in other.boundaries])

    def refused(self, kind, pattern, *arguments, **options):
        with self.assertRaisesRegex(kind, pattern):
            made(*arguments, **options)

    def warned(self, *arguments, **options):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            mesh = made(*arguments, **options)
        self.assertTrue(all(one.category is coastmesh.CoastmeshWarning and one.filename == __file__ for one in caught))
        return mesh, [str(one.message) for one in caught]

    def test_what_is_given_comes_back(self):
        z = [-1, -2.5, 0, 3, np.nan]
        mesh, said = self.warned(POINTS, TRIANGLES, z, "plane")
        self.assertEqual(said, [])
        np.testing.assert_array_equal(mesh.points, POINTS)
        np.testing.assert_array_equal(mesh.triangles, TRIANGLES)
        np.testing.assert_array_equal(mesh.z, z)
        self.assertEqual((mesh.points.dtype, mesh.triangles.dtype, mesh.z.dtype), (np.float64, np.uint32, np.float64))
        self.assertEqual([(one["role"], one["closed"]) for one in mesh.boundaries], [("land", True)])
        self.assertEqual(sorted(mesh.boundaries[0]["nodes"]), [0, 1, 2, 3])
        self.assertEqual((mesh.crs, mesh.features, mesh.report, mesh.summary, mesh.complete), ("", [], None, None, True))
        for points, triangles in ((POINTS.tolist(), TRIANGLES.tolist()), (np.asfortranarray(POINTS), TRIANGLES.astype(np.uint8)),
                                  (POINTS.astype(np.float32), np.asfortranarray(TRIANGLES))):
            self.assert_same(made(points, triangles, np.array(z, np.float32), "plane"), mesh)
        self.assert_same(pickle.loads(pickle.dumps(mesh)), mesh)
        self.assertIsNone(made(POINTS, TRIANGLES).z)

    def test_arrays_of_a_mesh_make_the_same_mesh(self):
        lake = coastmesh.mesh(LAKE, size=6000, coast="follow")
        twin, said = self.warned(lake.points, lake.triangles, crs=lake.crs)
        self.assertEqual(said, [])
        self.assertFalse(np.shares_memory(twin.points, lake.points))
        self.assert_same(twin, lake)
        self.assertIn("island", {boundary["role"] for boundary in twin.boundaries})
        part, other = (coastmesh.cut(mesh, bbox=BOX) for mesh in (twin, lake))
        self.assert_same(part, other)
        np.testing.assert_array_equal(part.triangle_source, other.triangle_source)
        finer = coastmesh.remesh(twin, bbox=BOX, size=2000)
        self.assert_same(finer, coastmesh.remesh(lake, bbox=BOX, size=2000))
        river = {"type": "LineString", "coordinates": [[-92.05, 46.72], [-92.3, 46.72], [-92.6, 46.72]]}
        self.assert_same(*(coastmesh.rivers(mesh, river, width=400) for mesh in (twin, lake)))
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            fine = coastmesh.cut(finer, bbox=BOX)
            put = made(fine.points, fine.triangles, crs=fine.crs)
            self.assertEqual(set(coastmesh.merge(twin, put).node_mesh) - {-1}, {0, 1})

    def test_they_are_written_and_drawn(self):
        mesh = made(POINTS, TRIANGLES, [1, 2, 3, 4, 5.5], crs="EPSG:32633")
        for name in ("mesh.nc", "mesh.2dm", "mesh.gpkg"):
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                mesh.write(self.path(name))
            read = coastmesh.read(self.path(name))
            for array in ("points", "triangles", "z"):
                np.testing.assert_array_equal(getattr(read, array), getattr(mesh, array))
            self.assertEqual(read.crs, "EPSG:32633")
        for color in ("angle", "depth"):
            mesh.plot(self.path(color + ".png"), color=color, size=100)
            self.assertTrue(os.path.getsize(self.path(color + ".png")))

    def test_what_is_odd_is_warned_of(self):
        degrees = POINTS / 80 + [5, 45]
        mesh, said = self.warned(degrees, TRIANGLES)
        self.assertEqual(mesh.crs, "")
        self.assertRegex(said[0], "^no crs is given, .*if they are degrees, give crs='EPSG:4326', otherwise crs='plane'$")
        for crs in ("plane", "EPSG:4326"):
            self.assertEqual(self.warned(degrees, TRIANGLES, crs=crs)[1], [])
        turned = TRIANGLES.copy()
        turned[1] = turned[1][::-1]
        mesh, said = self.warned(POINTS, turned, crs="plane")
        np.testing.assert_array_equal(mesh.triangles, turned)
        self.assertEqual(said[0], "2 edges belong to more than two triangles, or to two of opposite direction, the first between "
                         "points 1 and 4: the triangles are not joined there")
        self.assertRegex(said[1], "^1 of 4 triangles is clockwise or flat, the first at .*; target turns clockwise triangles$")
        self.assertEqual(len(said), 2)
        self.assertRegex(self.warned(POINTS, np.vstack([TRIANGLES, TRIANGLES[:1]]), crs="plane")[1][0], "^3 edges belong to more")

    def test_wrong_arrays_raise_with_evidence(self):
        wrong = coastmesh.InputError
        self.refused(wrong, "^triangles: row 3 names point 5, but there are 5, counted from 0$", POINTS,
                     TRIANGLES + [[0], [0], [0], [1]])
        self.refused(wrong, "^triangles: row 0 names point -1, but there are 5", POINTS, TRIANGLES - 1)
        self.refused(wrong, "^triangles: row 1 names point 4 more than once$", POINTS, [[0, 1, 2], [3, 4, 4]])
        self.refused(wrong, "^triangles: has elements of type float64, should have whole numbers", POINTS, TRIANGLES * 1.0)
        self.refused(wrong, r"^triangles: has the shape \(1, 4\), should have \(n, 3\)$", POINTS, [[0, 1, 2, 3]])
        self.refused(wrong, "^triangles: there are none$", POINTS, [])
        self.refused(wrong, r"^points: has the shape \(5, 3\), should have \(n, 2\)$", np.zeros((5, 3)), TRIANGLES)
        self.refused(wrong, "^points: is not an array of numbers$", "points", TRIANGLES)
        self.refused(wrong, "^points: is not an array of real numbers but of complex ones$", POINTS * 1j, TRIANGLES)
        for value in (np.nan, np.inf, 1e99, 1e-99):
            self.refused(wrong, "^points: row 1 is not two numbers that coordinates can have",
                         np.where(POINTS == [80, 100], value, POINTS), TRIANGLES)
            if not np.isnan(value):
                self.refused(wrong, "^z: row 4 is neither a number of metres nor NaN", POINTS, TRIANGLES, [1, 2, 3, 4, value])
        self.refused(wrong, "^z: has 2 numbers, should have 5, one for each point$", POINTS, TRIANGLES, [1, 2])
        self.refused(wrong, r"^z: has the shape \(5, 1\), should have \(n,\)$", POINTS, TRIANGLES, np.zeros((5, 1)))
        self.refused(wrong, "^z: has masked elements", POINTS, TRIANGLES, np.ma.masked_equal(np.arange(5), 3))
        self.refused(wrong, "^'points': node 1 at .* has no longitude and latitude in EPSG:4326", POINTS + 400, TRIANGLES,
                     crs="EPSG:4326")
        self.refused(coastmesh.OptionError, '^crs: "nowhere" is not a CRS', POINTS, TRIANGLES, crs="nowhere")
        for crs in (32633, np.int64(32633)):
            self.assertEqual(self.warned(POINTS, TRIANGLES, crs=crs)[0].crs, "EPSG:32633")
        self.refused(coastmesh.OptionError, '^crs: "EPSG:-1" is not a CRS', POINTS, TRIANGLES, crs=-1)
        for crs in (4326.0, True, [4326]):
            self.refused(coastmesh.OptionError, r"^crs: .* is neither a text nor a code of EPSG$", POINTS, TRIANGLES, crs=crs)


class DepthsTest(unittest.TestCase):
    def test_other_depths_make_another_mesh_with_all_else(self):
        lake = coastmesh.mesh(LAKE, size=6000, coast="follow")
        part = coastmesh.cut(lake, bbox=BOX)
        z = -1.0 - np.arange(len(part.points))
        z[3] = np.nan
        deep = part.with_z(z)
        np.testing.assert_array_equal(deep.z, z)
        self.assertIsNone(part.z)
        for name in ("points", "triangles", "min_angle", "area", "feature", "node_source", "triangle_source"):
            np.testing.assert_array_equal(getattr(deep, name), getattr(part, name))
        for name in ("crs", "features", "report", "summary"):
            self.assertEqual(getattr(deep, name), getattr(part, name))
        self.assertEqual({one["role"] for one in deep.boundaries}, {one["role"] for one in part.boundaries})
        view = deep.z
        deeper = deep.with_z(z - 1)
        np.testing.assert_array_equal(view, z)
        np.testing.assert_array_equal(deeper.z, z - 1)
        self.assertIsNone(deeper.with_z(None).z)
        west = coastmesh.cut(deep, bbox=(-91, 46.5, -90.5, 47))
        np.testing.assert_array_equal(west.z, z[west.node_source])
        with self.assertRaisesRegex(coastmesh.InputError, f"^z: has 1 number, should have {len(z)}, one for each point$"):
            part.with_z([1])
        with self.assertRaises(AttributeError):
            part.z = z


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:], verbosity=2)
