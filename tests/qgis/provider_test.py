#!/usr/bin/python3
"""The provider in PyQGIS, without a window: from layers to loaded layers, cancelled runs, errors. 77: no QGIS here.

usage: provider_test.py PROGRAM PLUGINS   (the program coastmesh, the folder that holds coastmesh_qgis)
"""
import json
import os
import shlex
import shutil
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import zipfile

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
try:
    from osgeo import gdal, ogr
    from qgis.core import (
        QgsApplication,
        QgsCoordinateReferenceSystem,
        QgsCoordinateTransform,
        QgsFeature,
        QgsField,
        QgsGeometry,
        QgsGraduatedSymbolRenderer,
        QgsMeshLayer,
        QgsPointXY,
        QgsProcessingContext,
        QgsProcessingException,
        QgsProcessingFeatureSourceDefinition,
        QgsProcessingFeedback,
        QgsProcessingModelAlgorithm,
        QgsProcessingModelChildAlgorithm,
        QgsProcessingModelChildParameterSource,
        QgsProcessingModelParameter,
        QgsProcessingParameterFeatureSource,
        QgsProject,
        QgsRasterLayer,
        QgsRasterRange,
        QgsRectangle,
        QgsReferencedRectangle,
        QgsVectorLayer,
    )
    from qgis.PyQt.QtCore import QVariant
except ImportError as error:
    print(f"skipped: no QGIS for {sys.executable}: {error}")
    sys.exit(77)

PROGRAM, PLUGINS = sys.argv[1:3]
LAKE = "POLYGON((0 0, 0.2 0, 0.2 0.2, 0 0.2, 0 0), (0.05 0.05, 0.05 0.1, 0.1 0.1, 0.1 0.05, 0.05 0.05))"
POND = "POLYGON((1 0, 1.1 0, 1.1 0.1, 1 0.1, 1 0))"


class Log(QgsProcessingFeedback):
    """Remembers what the user would read."""

    def __init__(self):
        super().__init__(False)
        self.lines = []

    def pushInfo(self, text):
        self.lines.append("info: " + text)

    def pushWarning(self, text):
        self.lines.append("warning: " + text)

    def reportError(self, text, fatalError=False):
        self.lines.append("error: " + text)

    def pushCommandInfo(self, text):
        self.lines.append("command: " + text)

    def text(self):
        return "\n".join(self.lines)


def memory_layer(*shapes, crs="EPSG:4326", kind="Polygon"):
    layer = QgsVectorLayer(f"{kind}?crs={crs}&field=name:string", "my lakes", "memory")
    for i, shape in enumerate(shapes):
        feature = QgsFeature(layer.fields())
        feature.setGeometry(QgsGeometry.fromWkt(shape))
        feature.setAttributes([f"lake {i}"])
        layer.dataProvider().addFeature(feature)
    return layer


class ProviderTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.log = Log()

    def tearDown(self):
        QgsProject.instance().clear()
        shutil.rmtree(self.folder)

    def path(self, name):
        return os.path.join(self.folder, name)

    def run_algorithm(self, name, **parameters):
        return processing.run("coastmesh:" + name, parameters, feedback=self.log)

    def mesh(self, layer, **parameters):
        return self.run_algorithm("mesh", INPUT=layer, OUTPUT=self.path("lake.nc"), **parameters)

    def test_every_verb_is_an_algorithm_and_every_option_of_theirs_a_parameter(self):
        provider = QgsApplication.processingRegistry().providerById("coastmesh")
        self.assertEqual(provider.warningMessage(), "")
        self.assertEqual({a.name() for a in provider.algorithms()},
                         {"mesh", "clean", "check", "convert", "cut", "remesh", "merge", "rivers"})
        mesh = provider.algorithm("mesh")
        angle = mesh.parameterDefinition("MIN_ANGLE")
        self.assertEqual((angle.defaultValue(), angle.minimum(), angle.maximum()), (33.0, 0.0, 45.0))
        self.assertEqual(mesh.parameterDefinition("SIZE_MAX").type(), "distance")
        self.assertEqual(mesh.parameterDefinition("ALGORITHM").type(), "enum")
        self.assertEqual(mesh.parameterDefinition("CRS").type(), "crs")
        for algorithm in provider.algorithms():
            self.assertTrue(algorithm.shortHelpString())
            for parameter in algorithm.parameterDefinitions():
                self.assertTrue(parameter.description(), parameter.name())

    def test_parameters_are_called_by_the_labels_of_the_options_in_their_order(self):
        usage = json.loads(subprocess.run([PROGRAM, "--json-usage"], capture_output=True, check=True).stdout)
        units = {"DEG": " [degrees]", "M": " [metres]", "M2": " [square metres]", "S": " [seconds]"}
        provider = QgsApplication.processingRegistry().providerById("coastmesh")
        compared = 0
        for command in usage["commands"]:
            algorithm = provider.algorithm(command["command"])
            if algorithm is None:
                continue
            shown = algorithm.parameterDefinitions()
            descriptions = [parameter.description() for parameter in shown]
            self.assertEqual(len(descriptions), len(set(descriptions)), descriptions)
            at = {parameter.name(): i for i, parameter in enumerate(shown)}
            before = -1
            for option in command["options"]:
                # Names of parameters do not depend on labels.
                name = {"--input": "MADE_FROM"}.get(option["name"], option["name"][2:].replace("-", "_").upper())
                if name not in at or name == "OUTPUT":
                    continue
                parameter = shown[at[name]]
                self.assertEqual(parameter.description(), option["label"] + units.get(option.get("unit"), ""))
                self.assertIn(f"<b>{option['label']}</b>", algorithm.shortHelpString())
                self.assertIn(f"<h3>{option['section']}</h3>", algorithm.shortHelpString())
                if option.get("role") != "output":
                    self.assertGreater(at[name], before, "options are not in the order of their sections")
                    before = at[name]
                compared += 1
        self.assertGreater(compared, 90)
        mesh = provider.algorithm("mesh")
        self.assertEqual(mesh.parameterDefinition("BBOX").description(), "Bounding box")
        self.assertEqual(mesh.parameterDefinition("WATER_AT").description(), "Point in the water")
        advanced = {p.name() for p in mesh.parameterDefinitions() if p.flags() & p.FlagAdvanced}
        self.assertLessEqual({"SLOPE_FILTER", "ALGORITHM", "THREADS", "SNAP", "REPORT"}, advanced)
        self.assertFalse({"INPUT", "OUTPUT", "BBOX", "WATER_AT", "SIZE_MAX", "MIN_ANGLE", "BATHYMETRY"} & advanced)

    def test_from_a_layer_to_loaded_and_styled_layers(self):
        layer = memory_layer(LAKE)
        QgsProject.instance().addMapLayer(layer)
        results = processing.runAndLoadResults(
            "coastmesh:mesh",
            {"INPUT": layer, "MIN_ANGLE": 30, "OUTPUT": self.path("a.nc"), "OUTPUT_LAYERS": self.path("a.gpkg")},
            feedback=self.log,
        )
        loaded = {l.name(): l for l in QgsProject.instance().mapLayers().values()}
        self.assertEqual(set(loaded), {"my lakes", "Mesh", "Triangles", "Boundaries"})
        mesh = loaded["Mesh"]
        self.assertIsInstance(mesh, QgsMeshLayer)
        self.assertTrue(mesh.isValid())
        self.assertEqual(mesh.crs().authid(), "EPSG:4326")
        self.assertEqual(mesh.dataProvider().faceCount(), results["TRIANGLE_COUNT"])
        active = mesh.rendererSettings().activeScalarDatasetGroup()
        self.assertGreaterEqual(active, 0)
        self.assertTrue(mesh.rendererSettings().nativeMeshSettings().isEnabled())
        triangles = loaded["Triangles"]
        self.assertIsInstance(triangles.renderer(), QgsGraduatedSymbolRenderer)
        self.assertEqual(triangles.featureCount(), results["TRIANGLE_COUNT"])
        angles = [f["min_angle"] for f in triangles.getFeatures()]
        self.assertGreaterEqual(min(angles), 30)
        # Each triangle has a class of the style.
        ranges = triangles.renderer().ranges()
        for angle in angles:
            self.assertTrue(any(r.lowerValue() <= angle <= r.upperValue() for r in ranges), angle)
        area = sum(f.geometry().area() for f in triangles.getFeatures())
        self.assertAlmostEqual(area, 0.2 * 0.2 - 0.05 * 0.05, places=9)
        self.assertEqual({f["role"] for f in loaded["Boundaries"].getFeatures()}, {"land", "island"})

    def test_a_mesh_that_is_a_geopackage_itself_is_loaded(self):
        parameters = {"INPUT": memory_layer(LAKE), "OUTPUT": self.path("lake.gpkg")}
        results = processing.runAndLoadResults("coastmesh:mesh", parameters, feedback=self.log)
        self.assertEqual(results["TRIANGLES"], self.path("lake.gpkg") + "|layername=triangles")
        names = {layer.name() for layer in QgsProject.instance().mapLayers().values()}
        self.assertEqual(names, {"Triangles", "Boundaries"})
        self.assertNotIn("only written", self.log.text())
        # Layers of their own take precedence.
        results = self.run_algorithm("mesh", **parameters, OUTPUT_LAYERS=self.path("layers.gpkg"))
        self.assertEqual(results["TRIANGLES"], self.path("layers.gpkg") + "|layername=triangles")
        self.assertIn("lake.gpkg' was only written", self.log.text())

    def test_without_load_nothing_is_loaded(self):
        parameters = {"INPUT": memory_layer(LAKE), "OUTPUT": self.path("a.nc"), "LOAD": False}
        processing.runAndLoadResults("coastmesh:mesh", parameters, feedback=self.log)
        self.assertEqual(len(QgsProject.instance().mapLayers()), 0)
        self.assertTrue(os.path.exists(self.path("a.nc")))

    def test_selected_features_alone(self):
        layer = memory_layer(LAKE, POND)
        QgsProject.instance().addMapLayer(layer)
        layer.selectByIds([f.id() for f in layer.getFeatures() if f["name"] == "lake 1"])
        source = QgsProcessingFeatureSourceDefinition(layer.id(), True)
        results = self.mesh(source, OUTPUT_LAYERS=self.path("a.gpkg"))
        triangles = QgsVectorLayer(results["TRIANGLES"], "", "ogr")
        box = triangles.extent()
        self.assertGreaterEqual(box.xMinimum(), 1.0)
        chosen = layer.selectedFeatureIds()[0]
        self.assertEqual({f["src_fid"] for f in triangles.getFeatures()}, {chosen})
        self.assertEqual({os.path.basename(f["source"]) for f in triangles.getFeatures()}, {"my lakes.gpkg"})
        layer.removeSelection()
        with self.assertRaisesRegex(QgsProcessingException, "no feature of 'my lakes' is selected"):
            self.mesh(source)

    def test_lines_a_subset_and_a_crs_given_in_qgis(self):
        ring = "LINESTRING(0 0, 1000 0, 1000 1000, 0 1000, 0 0)"
        layer = memory_layer(ring, ring.replace("1000", "77"), crs="EPSG:32631", kind="LineString")
        layer.setSubsetString("\"name\" = 'lake 0'") if layer.dataProvider().supportsSubsetString() else None
        results = self.mesh(layer)
        mesh = QgsMeshLayer(results["OUTPUT"], "", "mdal")
        self.assertEqual(mesh.crs().authid(), "EPSG:32631")
        self.assertAlmostEqual(mesh.extent().width(), 1000)
        # The file's CRS differs from the one set by the user.
        results = self.run_algorithm("clean", INPUT=memory_layer(LAKE), OUTPUT=self.path("lake.gpkg"))
        wrong = QgsVectorLayer(results["PSLG"], "", "ogr")
        wrong.setCrs(QgsCoordinateReferenceSystem("EPSG:4258"))
        mesh = QgsMeshLayer(self.mesh(wrong)["OUTPUT"], "", "mdal")
        self.assertEqual(mesh.crs().authid(), "EPSG:4258")

    def test_one_layer_of_a_file_with_many(self):
        cleaned = self.run_algorithm("clean", INPUT=memory_layer(LAKE), OUTPUT=self.path("two.gpkg"))
        self.assertTrue(QgsVectorLayer(cleaned["EDITS"], "", "ogr").isValid())
        results = self.mesh(cleaned["PSLG"])
        self.assertGreater(results["TRIANGLE_COUNT"], 2)

    def command(self):
        """The last command in the log."""
        return [line for line in self.log.lines if line.startswith("command: ")][-1]

    def test_a_layer_of_one_type_of_geometry_is_meshed_without_the_rest_of_its_file(self):
        line = {"type": "LineString", "coordinates": [[0.3, 0.1], [0.5, 0.1], [0.5, 0.3], [0.3, 0.1]]}
        square = {"type": "Polygon", "coordinates": [[[0, 0], [0.2, 0], [0.2, 0.2], [0, 0.2], [0, 0]]]}
        features = [{"type": "Feature", "properties": {}, "geometry": each} for each in (square, line)]
        with open(self.path("mixed.geojson"), "w", encoding="utf-8") as file:
            json.dump({"type": "FeatureCollection", "features": features}, file)
        layer = QgsVectorLayer(self.path("mixed.geojson") + "|geometrytype=Polygon", "mixed", "ogr")
        self.assertEqual(layer.featureCount(), 1)
        results = self.mesh(layer, OUTPUT_LAYERS=self.path("a.gpkg"))
        self.assertAlmostEqual(QgsVectorLayer(results["TRIANGLES"], "", "ogr").extent().xMaximum(), 0.2)

    def test_a_field_of_the_project_is_a_column_like_those_of_the_file(self):
        file = self.run_algorithm("clean", INPUT=memory_layer(LAKE), OUTPUT=self.path("lake.gpkg"))["PSLG"]
        with open(self.path("lake.geojson"), "w", encoding="utf-8") as geojson:
            geojson.write(json.dumps({"type": "Feature", "properties": {"name": "a"},
                                      "geometry": json.loads(QgsGeometry.fromWkt(POND).asJson())}))
        for source in (file, self.path("lake.geojson")):
            layer = QgsVectorLayer(source, "lake", "ogr")
            layer.addExpressionField("'open'", QgsField("shore", QVariant.String))
            results = self.mesh(layer, BOUNDARY_COLUMN="shore", OUTPUT_LAYERS=self.path("a.gpkg"))
            boundaries = QgsVectorLayer(results["BOUNDARIES"], "", "ogr")
            self.assertEqual({f["role"] for f in boundaries.getFeatures()}, {"open"})

    def test_texts_in_the_encoding_of_the_layers_properties(self):
        within_qgis = gdal.GetConfigOption("SHAPE_ENCODING")  # "": GDAL leaves the encoding to QGIS
        gdal.SetConfigOption("SHAPE_ENCODING", None)
        data = ogr.GetDriverByName("ESRI Shapefile").CreateDataSource(self.path("lake.shp"))
        table = data.CreateLayer("lake", None, ogr.wkbPolygon, ["ENCODING=CP1251"])
        table.CreateField(ogr.FieldDefn("name", ogr.OFTString))
        lake = ogr.Feature(table.GetLayerDefn())
        lake.SetField("name", "Озеро")
        lake.SetGeometry(ogr.CreateGeometryFromWkt(LAKE))
        table.CreateFeature(lake)
        del lake, table, data
        gdal.SetConfigOption("SHAPE_ENCODING", within_qgis)

        def name_with(encoding):
            layer = QgsVectorLayer(self.path("lake.shp"), "lake", "ogr")
            if encoding:
                layer.setProviderEncoding(encoding)
            results = self.mesh(layer, OUTPUT_LAYERS=self.path("a.gpkg"))
            return {f["name"] for f in QgsVectorLayer(results["TRIANGLES"], "", "ogr").getFeatures()}

        self.assertEqual(name_with(None), {"Озеро"})
        self.assertIn(self.path("lake.shp"), self.command())
        self.assertEqual(name_with("KOI8-R"), {"Озеро".encode("cp1251").decode("koi8-r")})
        os.remove(self.path("lake.cpg"))
        self.assertEqual(name_with("windows-1251"), {"Озеро"})

    def test_fields_whose_names_differ_by_case_alone(self):
        layer = QgsVectorLayer("Polygon?crs=EPSG:4326&field=name:string&field=Name:string", "my lakes", "memory")
        feature = QgsFeature(layer.fields())
        feature.setGeometry(QgsGeometry.fromWkt(LAKE))
        feature.setAttributes(["first", "second"])
        layer.dataProvider().addFeature(feature)
        results = self.mesh(layer, OUTPUT_LAYERS=self.path("a.gpkg"))
        triangles = QgsVectorLayer(results["TRIANGLES"], "", "ogr")
        self.assertEqual({f["name"] for f in triangles.getFeatures()}, {"first"})

    def depths_of(self, raster, layer):
        """The least and the greatest z of the nodes of a mesh with that raster of depths."""
        results = self.mesh(layer, BATHYMETRY=[raster], OUTPUT_LAYERS=self.path("a.gpkg"))
        z = [f["z"] for f in QgsVectorLayer(results["NODES"], "", "ogr").getFeatures()]
        return min(z), max(z)

    def test_a_raster_with_a_crs_given_in_qgis(self):
        with open(self.path("depths.asc"), "w", encoding="utf-8") as file:
            rows = "\n".join(" ".join(["-30"] * 40) for _ in range(40))
            file.write(f"ncols 40\nnrows 40\nxllcorner 490000\nyllcorner -10000\ncellsize 1000\n{rows}\n")
        raster = QgsRasterLayer(self.path("depths.asc"), "depths")
        raster.setCrs(QgsCoordinateReferenceSystem("EPSG:32631"))
        # Longitude 3 is at 500000 m.
        lake = memory_layer("POLYGON((3 0, 3.1 0, 3.1 0.1, 3 0.1, 3 0))")
        self.assertEqual(self.depths_of(raster, lake), (-30, -30))
        self.assertIn("--bathymetry=depths", self.command())
        self.assertNotIn("no CRS", self.log.text())

    def test_a_raster_that_is_a_part_of_a_file(self):
        for name, depth in (("shallow", -5), ("deep", -50)):
            grid = gdal.GetDriverByName("GTiff").Create(self.path(name + ".tif"), 30, 30, 1, gdal.GDT_Float32)
            grid.SetGeoTransform((-1, 0.1, 0, 2, 0, -0.1))
            grid.SetProjection(QgsCoordinateReferenceSystem("EPSG:4326").toWkt())
            grid.GetRasterBand(1).Fill(depth)
            gdal.Translate(self.path("both.gpkg"), grid, format="GPKG",
                           creationOptions=["APPEND_SUBDATASET=YES", f"RASTER_TABLE={name}"])
            del grid
        with zipfile.ZipFile(self.path("deep.zip"), "w") as archive:
            archive.write(self.path("deep.tif"), "deep.tif")
        both, archive = self.path("both.gpkg"), self.path("deep.zip")
        for source, depth in ((f"GPKG:{both}:shallow", -5), (f"GPKG:{both}:deep", -50),
                              (f"/vsizip/{archive}/deep.tif", -50), (self.path("shallow.tif"), -5)):
            raster = QgsRasterLayer(source, "depths")
            self.assertTrue(raster.isValid(), source)
            self.assertEqual(self.depths_of(raster, memory_layer(LAKE)), (depth, depth), source)

    def test_pixels_that_have_no_data_by_the_properties_of_the_layer(self):
        grid = gdal.GetDriverByName("GTiff").Create(self.path("d.tif"), 30, 30, 1, gdal.GDT_Float32)
        grid.SetGeoTransform((-1, 0.1, 0, 2, 0, -0.1))
        grid.SetProjection(QgsCoordinateReferenceSystem("EPSG:4326").toWkt())
        grid.GetRasterBand(1).Fill(-9999)
        grid.GetRasterBand(1).WriteRaster(0, 10, 12, 20, b"\x00\x00\x00\xc1" * 240, buf_type=gdal.GDT_Float32)  # -8
        del grid
        raster = QgsRasterLayer(self.path("d.tif"), "depths")
        lake = memory_layer("POLYGON((0 0, 0.6 0, 0.6 0.6, 0 0.6, 0 0))")
        self.assertEqual(self.depths_of(raster, lake)[0], -9999)
        raster.dataProvider().setUserNoDataValue(1, [QgsRasterRange(-9999, -9999)])
        self.assertEqual(self.depths_of(raster, lake), (-8, -8))
        raster.dataProvider().setUserNoDataValue(1, [QgsRasterRange(-9999, -9000)])
        with self.assertRaisesRegex(QgsProcessingException, "'depths' has several values"):
            self.depths_of(raster, lake)
        gdal.Translate(self.path("marked.tif"), self.path("d.tif"), noData=-9999)
        marked = QgsRasterLayer(self.path("marked.tif"), "depths")
        for values in ([], [QgsRasterRange(-9999, -9999)]):
            marked.dataProvider().setUserNoDataValue(1, values)
            self.assertEqual(self.depths_of(marked, lake), (-8, -8))
        self.assertIn("marked.tif", self.command())
        marked.dataProvider().setUserNoDataValue(1, [])
        marked.dataProvider().setUseSourceNoDataValue(1, False)
        self.assertEqual(self.depths_of(marked, lake)[0], -9999)

    def test_edits_of_a_mesh_that_are_not_saved(self):
        self.mesh(memory_layer(LAKE))
        self.run_algorithm("convert", INPUT=self.path("lake.nc"), OUTPUT=self.path("lake.2dm"))
        layer = QgsMeshLayer(self.path("lake.2dm"), "lake", "mdal")
        self.assertTrue(layer.startFrameEditing(QgsCoordinateTransform()))
        self.assertEqual(self.run_algorithm("check", INPUT=layer)["SOUND"], 1)
        layer.meshEditor().changeZValues([0], [5.0])
        with self.assertRaisesRegex(QgsProcessingException, "'lake' has edits"):
            self.run_algorithm("check", INPUT=layer)

    def test_options_from_a_file(self):
        with open(self.path("options.toml"), "w", encoding="utf-8") as file:
            file.write("size-max = 5000\n")
        parameter = QgsApplication.processingRegistry().algorithmById("coastmesh:mesh").parameterDefinition("CONFIG")
        self.assertEqual(parameter.type(), "file")
        coarse = self.mesh(memory_layer(LAKE))
        fine = self.mesh(memory_layer(LAKE), CONFIG=self.path("options.toml"))
        self.assertGreater(fine["TRIANGLE_COUNT"], 2 * coarse["TRIANGLE_COUNT"])

    def test_a_null_is_no_value(self):
        null = QVariant(QVariant.String)
        self.mesh(memory_layer(LAKE), BBOX=null, CRS=null, SIZE_MAX=QVariant(QVariant.Double), WATER_AT=null)
        for option in ("bbox", "crs", "size-max", "water-at"):
            self.assertNotIn(option, self.command())

    def test_the_command_in_the_log_can_be_run(self):
        odd = self.path("a|b>c#d`e`*é")
        os.mkdir(odd)
        with open(os.path.join(odd, "lake.geojson"), "w", encoding="utf-8") as file:
            file.write(QgsGeometry.fromWkt(LAKE).asJson())
        with open(os.path.join(odd, "c.toml"), "w", encoding="utf-8") as file:
            file.write("min-angle = 30\n")
        mesh = self.run_algorithm("mesh", INPUT=os.path.join(odd, "lake.geojson"), OUTPUT=os.path.join(odd, "a.nc"),
                                  CONFIG=os.path.join(odd, "c.toml"))["OUTPUT"]
        os.remove(mesh)
        command = self.command().replace("command: coastmesh", shlex.quote(PROGRAM), 1)
        subprocess.run(["bash", "-c", command], check=True, capture_output=True)
        self.assertTrue(os.path.exists(mesh))

    def test_names_of_files_in_capitals(self):
        parameters = {"INPUT": memory_layer(LAKE), "OUTPUT": self.path("A.NC"), "OUTPUT_LAYERS": self.path("A.GPKG")}
        processing.runAndLoadResults("coastmesh:mesh", parameters, feedback=self.log)
        loaded = {layer.name() for layer in QgsProject.instance().mapLayers().values()}
        self.assertEqual(loaded, {"Mesh", "Triangles", "Boundaries"})

    def test_layers_in_the_project_show_the_files_of_the_last_run(self):
        for size, min_angle in ((8000, 0), (2000, 59)):
            parameters = {"INPUT": memory_layer(LAKE), "SIZE_MAX": size, "OUTPUT": self.path("lake.nc"),
                          "OUTPUT_LAYERS": self.path("lake.gpkg")}
            results = processing.runAndLoadResults("coastmesh:mesh", parameters, feedback=self.log)
            processing.runAndLoadResults("coastmesh:check", {"INPUT": results["OUTPUT"], "MIN_ANGLE": min_angle,
                                                             "OUTPUT": self.path("defects.gpkg")}, feedback=self.log)
            loaded = {layer.name(): layer for layer in QgsProject.instance().mapLayers().values()}
            self.assertEqual(len(QgsProject.instance().mapLayers()), 4)
            self.assertEqual(loaded["Triangles"].featureCount(), results["TRIANGLE_COUNT"])
            self.assertEqual(len(list(loaded["Triangles"].getFeatures())), results["TRIANGLE_COUNT"])
            self.assertEqual(loaded["Mesh"].dataProvider().faceCount(), results["TRIANGLE_COUNT"])
            self.assertEqual(loaded["Defects"].featureCount() > 0, min_angle > 0)

    def test_a_cancelled_run_leaves_nothing(self):
        layer = memory_layer("POLYGON((0 0, 8 0, 8 8, 0 8, 0 0))")
        stopped = []

        def cancel_once_it_writes_aside():
            # The program is running once its temporary folder exists.
            for _ in range(600):
                if any(name.startswith(".") for name in os.listdir(self.folder)):
                    stopped.append(time.monotonic())
                    self.log.cancel()
                    return
                time.sleep(0.05)

        thread = threading.Thread(target=cancel_once_it_writes_aside)
        thread.start()
        results = self.mesh(layer, SIZE_MAX=300, OUTPUT_LAYERS=self.path("lake.gpkg"), REPORT=self.path("r.json"))
        ended = time.monotonic()
        thread.join()
        self.assertTrue(stopped, "the run ended before it could be cancelled")
        self.assertLess(ended - stopped[0], 10)
        self.assertEqual(results, {})
        self.assertEqual(os.listdir(self.folder), [])
        self.assertIn("Cancelled", self.log.text())

    def test_an_error_reaches_the_log_and_names_layer_and_feature(self):
        layer = memory_layer("POLYGON((0 0, 1 1, 2 2, 0 0))")
        with self.assertRaises(QgsProcessingException) as caught:
            self.mesh(layer)
        self.assertIn("my lakes", str(caught.exception))
        self.assertNotIn(".gpkg", str(caught.exception))
        self.assertEqual(os.listdir(self.folder), [])

    def test_what_falls_short_is_told_and_written(self):
        results = self.mesh(memory_layer(LAKE), SIZE_MAX=200, MAX_VERTICES=500)
        self.assertIn("warning: short of what was asked: ", self.log.text())
        self.assertIn("the budget of points is used up", self.log.text())
        self.assertTrue(os.path.exists(results["OUTPUT"]))

    def test_notes_are_told(self):
        self.mesh(memory_layer(LAKE), BBOX="0,0.1,0,0.1")
        self.assertIn("info: meshed inside the polygons; --domain outside meshes the water", self.log.text())

    def test_sizes_that_require_too_many_vertices_are_an_error(self):
        with self.assertRaises(QgsProcessingException) as caught:
            self.mesh(memory_layer(LAKE), SIZE=1, MAX_VERTICES=500)
        self.assertIn("--max-vertices", str(caught.exception))
        self.assertEqual(os.listdir(self.folder), [])

    def test_a_crs_given_by_hand_and_a_flag(self):
        self.mesh(memory_layer(LAKE), CRS="EPSG:32631", COARSEN=False)
        self.assertIn("--crs=EPSG:32631 --no-coarsen", self.log.text().replace("--no-coarsen --crs=EPSG:32631",
                                                                           "--crs=EPSG:32631 --no-coarsen"))

    def given(self, **parameters):
        """The words of the command that give those parameters, whether or not the program takes their values."""
        self.log.lines.clear()
        try:
            self.mesh(memory_layer(LAKE), **parameters)
        except QgsProcessingException as error:
            self.log.lines.append(str(error))
        words = shlex.split(self.command())
        return [word for word in words for name in parameters if word.startswith(f"--{name.lower().replace('_', '-')}=")]

    def test_each_item_of_a_list_and_each_line_is_a_value_of_a_repeatable_option(self):
        usage = json.loads(subprocess.run([PROGRAM, "--json-usage"], capture_output=True, check=True).stdout)
        provider = QgsApplication.processingRegistry().providerById("coastmesh")
        tried = set()
        for command in usage["commands"]:
            algorithm = provider.algorithm(command["command"])
            for option in command["options"] if algorithm else []:
                name = option["name"][2:].replace("-", "_").upper()
                parameter = algorithm.parameterDefinition(name)
                if not option.get("multiple") or option["type"] == "file" or parameter is None:
                    continue
                self.assertTrue(parameter.multiLine(), name)
                self.assertIn("one value per line, or a list", parameter.help())
                self.assertIn("one value per line, or a list", algorithm.shortHelpString())
                if command["command"] != "mesh":
                    continue
                tried.add(name)
                words = [f"{option['name']}=one, 1", f"{option['name']}=two"]
                for value in (["one, 1", "two"], ("one, 1", "two"), ["one, 1", "", "two"], "one, 1\n\ntwo\n"):
                    self.assertEqual(self.given(**{name: value}), words, value)
                self.assertEqual(self.given(**{name: ["two"]}), words[1:])
                self.assertEqual(self.given(**{name: "two"}), words[1:])
                self.assertEqual(self.given(**{name: []}), [])
        self.assertLessEqual({"TARGET", "DEPTH_BAND"}, tried)

    def test_a_list_of_models_makes_a_grid_with_their_repairs(self):
        # Two squares that meet in a corner: ADCIRC rejects the node there.
        pinched = memory_layer("MULTIPOLYGON(((0 0, 1 0, 1 1, 0 1, 0 0)), ((1 1, 2 1, 2 2, 1 2, 1 1)))")
        self.mesh(pinched, TARGET=["adcirc", "schism"], REPORT=self.path("r.json"))
        with open(self.path("r.json"), encoding="utf-8") as file:
            repairs = json.load(file)["repairs"]
        self.assertEqual({each["target"] for each in repairs["done"]}, {"adcirc"})

    def test_values_that_cannot_be_taken_are_refused_and_told_how_to_give_several(self):
        for value in ("adcirc,schism", "adcirc;schism", "adcirc schism", ["swan", "adcirc,schism"]):
            with self.assertRaisesRegex(QgsProcessingException, "several values of TARGET are given one per line"):
                self.mesh(memory_layer(LAKE), TARGET=value)
        with self.assertRaisesRegex(QgsProcessingException, "several values of DEPTH_BAND are given one per line"):
            self.mesh(memory_layer(LAKE), DEPTH_BAND="0,10,50;10,20,100", TARGET=["adcirc"])
        with self.assertRaises(QgsProcessingException) as caught:
            self.mesh(memory_layer(LAKE), TARGET="adcirk")
        self.assertNotIn("per line", str(caught.exception))
        for value in ([["adcirc"]], [None], [True], {"adcirc": "schism"}):
            with self.assertRaisesRegex(QgsProcessingException, "TARGET", msg=str(value)):
                self.mesh(memory_layer(LAKE), TARGET=value)
        for name, value in (("BOUNDARY_COLUMN", ["a", "b"]), ("COARSEN", [False])):
            with self.assertRaisesRegex(QgsProcessingException, f"{name} takes one value, not {len(value)} in a list"):
                self.mesh(memory_layer(LAKE), **{name: value})
        self.assertEqual(os.listdir(self.folder), [])

    def test_former_names_of_parameters_are_taken_with_a_warning(self):
        self.mesh(memory_layer(LAKE), SHRINK=False)
        self.assertIn("--no-coarsen", self.log.text())
        self.assertIn("SHRINK is called COARSEN now", self.log.text())

    def test_a_frame_and_a_place_in_another_crs(self):
        island = memory_layer("POLYGON((0.4 0.4, 0.6 0.4, 0.6 0.6, 0.4 0.6, 0.4 0.4))")
        # About 0 to 1 degree, in metres of web Mercator.
        box = "0,111319.4907932,0,111325.1428664 [EPSG:3857]"
        results = self.mesh(island, DOMAIN="outside", BBOX=box, OUTPUT_LAYERS=self.path("a.gpkg"))
        boundaries = QgsVectorLayer(results["BOUNDARIES"], "", "ogr")
        self.assertIn("open", {f["role"] for f in boundaries.getFeatures()})
        extent = QgsVectorLayer(results["TRIANGLES"], "", "ogr").extent()
        self.assertAlmostEqual(extent.xMaximum(), 1.0, places=6)
        self.assertAlmostEqual(extent.yMaximum(), 1.0, places=6)
        # The same with a point in the water.
        results = self.mesh(island, WATER_AT="11131.9,11131.9 [EPSG:3857]", BBOX=box, OUTPUT_LAYERS=self.path("a.gpkg"))
        self.assertAlmostEqual(QgsVectorLayer(results["TRIANGLES"], "", "ogr").extent().xMaximum(), 1.0, places=6)

    def test_a_frame_across_the_antimeridian(self):
        fiji = memory_layer("POLYGON((179.5 -17, 179.8 -17, 179.8 -16.5, 179.5 -16.5, 179.5 -17))")
        pacific = QgsRectangle(3228265.233, -2024351.426, 3450904.214, -1792951.697)  # of the same box
        for box in ("179,-179,-18,-16 [EPSG:4326]", "179,-179,-18,-16", "179,181,-18,-16 [EPSG:4326]",
                    QgsReferencedRectangle(pacific, QgsCoordinateReferenceSystem("EPSG:3832"))):
            self.run_algorithm("clean", INPUT=fiji, BBOX=box, DOMAIN="outside", OUTPUT=self.path("a.gpkg"))
            sides = self.command().split("--bbox=")[1].split()[0].split(",")
            west, south, east, north = map(float, sides)
            self.assertAlmostEqual(west, 179, places=6)
            self.assertAlmostEqual(south, -18, places=6)
            self.assertAlmostEqual(east % 360, 181, places=6)
            self.assertAlmostEqual(north, -16, places=6)

    def test_frames_as_wide_as_the_earth_and_around_a_pole(self):
        square = memory_layer("POLYGON((0 -80, 20 -80, 20 -70, 0 -70, 0 -80))")
        for box, expected in (("-20037508,20037508,-20037508,0 [EPSG:3857]", [-180, -85.05, 180, 0]),
                              ("-5e6,5e6,-5e6,5e6 [EPSG:3031]", [-180, -90, 180, -30.65]),
                              ("0,5e6,1000,5e6 [EPSG:3031]", [0, -89.99, 90, -30.65])):
            self.run_algorithm("clean", INPUT=square, BBOX=box, OUTPUT=self.path("a.gpkg"))
            sides = [float(side) for side in self.command().split("--bbox=")[1].split()[0].split(",")]
            for side, wanted in zip(sides, expected):
                self.assertAlmostEqual(side, wanted, delta=0.02, msg=box)

    def test_triangles_are_converted_with_the_depths_and_boundaries_of_their_file(self):
        grid = gdal.GetDriverByName("GTiff").Create(self.path("d.tif"), 30, 30, 1, gdal.GDT_Float32)
        grid.SetGeoTransform((-1, 0.1, 0, 2, 0, -0.1))
        grid.SetProjection(QgsCoordinateReferenceSystem("EPSG:4326").toWkt())
        grid.GetRasterBand(1).Fill(-12)
        del grid
        island = memory_layer("POLYGON((0.4 0.4, 0.6 0.4, 0.6 0.6, 0.4 0.6, 0.4 0.4))")
        results = self.mesh(island, DOMAIN="outside", BBOX="0,1,0,1", BATHYMETRY=[self.path("d.tif")],
                            OUTPUT_LAYERS=self.path("a.gpkg"), OUTPUT_GRID=self.path("a.14"))
        triangles = QgsVectorLayer(results["TRIANGLES"], "triangles", "ogr")
        self.run_algorithm("convert", INPUT=triangles, OUTPUT=self.path("b.14"))
        with open(self.path("a.14"), encoding="utf-8") as one, open(self.path("b.14"), encoding="utf-8") as other:
            self.assertEqual(one.read(), other.read())
        # Being edited, but not changed, it is still that of its file.
        triangles.startEditing()
        self.run_algorithm("convert", INPUT=triangles, OUTPUT=self.path("d.14"))
        with open(self.path("a.14"), encoding="utf-8") as one, open(self.path("d.14"), encoding="utf-8") as other:
            self.assertEqual(one.read(), other.read())
        triangles.deleteFeature(1)
        self.assertRaisesRegex(QgsProcessingException, "'triangles' has edits: save them first", self.run_algorithm,
                               "convert", INPUT=triangles, OUTPUT=self.path("d.14"))
        triangles.rollBack()
        nodes = QgsVectorLayer(results["NODES"], "depths by hand", "ogr")
        QgsProject.instance().addMapLayer(nodes)
        nodes.startEditing()
        nodes.changeAttributeValue(1, nodes.fields().indexOf("z"), -7.0)
        self.assertRaisesRegex(QgsProcessingException, "'depths by hand' has edits: save them first", self.run_algorithm,
                               "convert", INPUT=triangles, OUTPUT=self.path("d.14"))
        nodes.rollBack()
        # With a filter the layer has another mesh than its file.
        self.assertNotIn("alone", self.log.text())
        triangles.setSubsetString("fid <= 3")
        self.run_algorithm("convert", INPUT=triangles, OUTPUT=self.path("c.14"))
        with open(self.path("c.14"), encoding="utf-8") as file:
            self.assertEqual(file.read().split()[1], "3")
        self.assertIn("'triangles' shows something else than its file", self.log.text())
        self.assertIn("read alone, without the depths", self.log.text())

    def test_a_mesh_converted_to_a_geopackage_is_loaded(self):
        self.mesh(memory_layer(LAKE))
        self.run_algorithm("convert", INPUT=self.path("lake.nc"), OUTPUT=self.path("bare.2dm"))
        for source in ("lake.nc", "bare.2dm"):
            self.log.lines.clear()
            results = processing.runAndLoadResults("coastmesh:convert", {"INPUT": self.path(source),
                                                                         "OUTPUT": self.path(source + ".gpkg")},
                                                   feedback=self.log)
            layers = {layer.name(): layer for layer in QgsProject.instance().mapLayers().values()}
            self.assertEqual(set(layers), {"Triangles", "Boundaries"}, source)
            self.assertEqual(layers["Triangles"].source(), results["TRIANGLES"])
            self.assertNotIn("only written", self.log.text())
            QgsProject.instance().clear()

    def test_a_part_of_a_mesh_in_polygons_of_a_layer(self):
        self.mesh(memory_layer(LAKE))
        box = QgsMeshLayer(self.path("lake.nc"), "lake", "mdal").extent()
        west = QgsRectangle(box.xMinimum(), box.yMinimum(), box.center().x(), box.yMaximum())
        results = self.run_algorithm("cut", INPUT=self.path("lake.nc"), WITHIN=[memory_layer(west.asWktPolygon())],
                                     NUMBERS=self.path("numbers.csv"), OUTPUT=self.path("west.gpkg"))
        whole = self.run_algorithm("convert", INPUT=self.path("lake.nc"), OUTPUT=self.path("whole.gpkg"))
        part = QgsVectorLayer(results["TRIANGLES"], "", "ogr").featureCount()
        self.assertGreater(part, 0)
        self.assertLess(part, QgsVectorLayer(whole["TRIANGLES"], "", "ogr").featureCount())
        with open(self.path("numbers.csv"), encoding="utf-8") as file:
            self.assertEqual(sum(line.startswith("triangle,") for line in file), part)

    def test_a_part_of_a_mesh_anew(self):
        self.mesh(memory_layer(LAKE))
        box = QgsMeshLayer(self.path("lake.nc"), "lake", "mdal").extent()
        west = QgsRectangle(box.xMinimum(), box.yMinimum(), box.center().x(), box.yMaximum())
        before = self.run_algorithm("convert", INPUT=self.path("lake.nc"), OUTPUT=self.path("before.gpkg"))
        results = self.run_algorithm("remesh", INPUT=self.path("lake.nc"), WITHIN=[memory_layer(west.asWktPolygon())],
                                     SIZE=box.width() * 1000, OUTPUT=self.path("finer.gpkg"))
        self.assertGreater(QgsVectorLayer(results["TRIANGLES"], "", "ogr").featureCount(),
                           QgsVectorLayer(before["TRIANGLES"], "", "ogr").featureCount())

    def test_a_finer_part_put_into_a_mesh(self):
        self.mesh(memory_layer(LAKE))
        box = QgsMeshLayer(self.path("lake.nc"), "lake", "mdal").extent()
        self.run_algorithm("remesh", INPUT=self.path("lake.nc"), BBOX=box, SIZE=box.width() * 2000,
                           OUTPUT=self.path("fine.nc"))
        west = QgsRectangle(box.xMinimum(), box.yMinimum(), box.center().x(), box.yMaximum())
        self.run_algorithm("cut", INPUT=self.path("fine.nc"), BBOX=west, OUTPUT=self.path("west.nc"))
        parts = [QgsMeshLayer(self.path("west.nc"), "west", "mdal")]
        QgsProject.instance().addMapLayers(parts)
        results = self.run_algorithm("merge", INPUT=self.path("lake.nc"), INSERTED=parts,
                                     OUTPUT=self.path("both.gpkg"))
        west_only = self.run_algorithm("convert", INPUT=self.path("west.nc"), OUTPUT=self.path("west.gpkg"))
        self.assertGreater(QgsVectorLayer(results["TRIANGLES"], "", "ogr").featureCount(),
                           QgsVectorLayer(west_only["TRIANGLES"], "", "ogr").featureCount())
        QgsProject.instance().clear()

    def test_rivers_of_a_layer_added_to_a_mesh(self):
        self.mesh(memory_layer(LAKE))
        box = QgsMeshLayer(self.path("lake.nc"), "lake", "mdal").extent()
        x, y, length = box.xMaximum(), box.center().y(), box.width()
        width = length * 111000 / 40
        joined = memory_layer(f"LINESTRING({x - length / 20} {y}, {x + length} {y})", kind="LineString")
        apart = memory_layer(f"LINESTRING({x + 3 * length} {y}, {x + 4 * length} {y})", kind="LineString")
        joined.setName("joined river")
        apart.setName("river apart")
        before = self.run_algorithm("convert", INPUT=self.path("lake.nc"), OUTPUT=self.path("before.gpkg"))
        for source in (self.path("lake.nc"), QgsMeshLayer(self.path("lake.nc"), "lake", "mdal")):
            self.log.lines.clear()
            results = self.run_algorithm("rivers", INPUT=source, LINES=[joined, apart], WIDTH=width, ELEMENTS=3,
                                         OUTPUT=self.path("both.gpkg"))
            self.assertIn("--elements=3", self.log.text())
            self.assertRegex(self.log.text(), "1 reach is left out, not connected with the water of the mesh.*: 'lake 0' near")
            triangles = QgsVectorLayer(results["TRIANGLES"], "", "ogr")
            self.assertGreater(triangles.featureCount(), QgsVectorLayer(before["TRIANGLES"], "", "ogr").featureCount())
            self.assertAlmostEqual(triangles.extent().xMaximum(), x + length, delta=length / 1000)
            roles = {feature["role"] for feature in QgsVectorLayer(results["BOUNDARIES"], "", "ogr").getFeatures()}
            self.assertEqual(roles, {"land", "island", "river"})
        with self.assertRaisesRegex(QgsProcessingException, "river apart.*has no attribute 'width'"):
            self.run_algorithm("rivers", INPUT=self.path("lake.nc"), LINES=[apart], OUTPUT=self.path("none.gpkg"))
        self.assertFalse(os.path.exists(self.path("none.gpkg")))

    def test_a_mesh_in_a_crs_without_a_code(self):
        self.mesh(memory_layer(LAKE))
        self.run_algorithm("convert", INPUT=self.path("lake.nc"), OUTPUT=self.path("lake.2dm"))
        for name in os.listdir(self.folder):
            if name.endswith(".prj"):
                os.remove(self.path(name))
        layer = QgsMeshLayer(self.path("lake.2dm"), "lake", "mdal")
        layer.setCrs(QgsCoordinateReferenceSystem.fromProj("+proj=longlat +R=6371000 +no_defs"))
        self.run_algorithm("convert", INPUT=layer, OUTPUT=self.path("back.nc"))
        with open(self.path("back.nc"), "rb") as file:
            self.assertIn(b'ELLIPSOID["unknown",6371000,0', file.read())

    def test_checks_with_a_frame_in_another_crs_than_the_mesh(self):
        island = memory_layer("POLYGON((0.4 0.4, 0.6 0.4, 0.6 0.6, 0.4 0.6, 0.4 0.4))")
        box = "0,111319.4907932,0,111325.1428664 [EPSG:3857]"
        mesh = self.mesh(island, DOMAIN="outside", BBOX=box)["OUTPUT"]
        self.log.lines.clear()
        checked = self.run_algorithm("check", INPUT=mesh, MADE_FROM=[island], DOMAIN="outside", BBOX=box)
        self.assertEqual(checked["SOUND"], 1, self.log.text())
        self.assertNotIn("warning: ", self.log.text())

    def test_check_and_convert_take_layers_and_files_that_qgis_cannot_open(self):
        layer = memory_layer(LAKE)
        mesh = self.mesh(layer)["OUTPUT"]
        other = self.run_algorithm("convert", INPUT=QgsMeshLayer(mesh, "", "mdal"), OUTPUT=self.path("b.msh"))["OUTPUT"]
        sound = self.run_algorithm("check", INPUT=other, MADE_FROM=[], OUTPUT=self.path("defects.gpkg"))
        self.assertEqual(sound["SOUND"], 1)
        short = self.run_algorithm("check", INPUT=mesh, MADE_FROM=[layer], MIN_ANGLE=59, OUTPUT=self.path("d.gpkg"))
        self.assertEqual(short["SOUND"], 0)
        defects = QgsVectorLayer(short["OUTPUT"], "", "ogr")
        self.assertGreater(defects.featureCount(), 0)
        self.assertTrue(all("angle" in f["kind"] for f in defects.getFeatures()))

    def test_in_a_model(self):
        model = QgsProcessingModelAlgorithm("two steps", "tests")
        model.addModelParameter(
            QgsProcessingParameterFeatureSource("LAKES", "lakes"), QgsProcessingModelParameter("LAKES")
        )
        clean = QgsProcessingModelChildAlgorithm("coastmesh:clean")
        clean.setChildId("clean")
        clean.addParameterSources("INPUT", [QgsProcessingModelChildParameterSource.fromModelParameter("LAKES")])
        clean.addParameterSources("LOAD", [QgsProcessingModelChildParameterSource.fromStaticValue(False)])
        model.addChildAlgorithm(clean)
        mesh = QgsProcessingModelChildAlgorithm("coastmesh:mesh")
        mesh.setChildId("mesh")
        mesh.addParameterSources("INPUT", [QgsProcessingModelChildParameterSource.fromChildOutput("clean", "PSLG")])
        mesh.addParameterSources("LOAD", [QgsProcessingModelChildParameterSource.fromStaticValue(False)])
        model.addChildAlgorithm(mesh)
        results, ok = model.run({"LAKES": memory_layer(LAKE)}, QgsProcessingContext(), self.log)
        self.assertTrue(ok, self.log.text())
        self.assertGreater(results["CHILD_RESULTS"]["mesh"]["TRIANGLE_COUNT"], 2)

    def test_without_the_program_the_provider_says_so(self):
        os.environ["COASTMESH_PROGRAM"] = "/nowhere/coastmesh"
        provider = QgsApplication.processingRegistry().providerById("coastmesh")
        try:
            provider.refreshAlgorithms()
            self.assertEqual(provider.algorithms(), [])
            self.assertIn("/nowhere/coastmesh", provider.warningMessage())
        finally:
            os.environ["COASTMESH_PROGRAM"] = PROGRAM
            provider.refreshAlgorithms()


os.environ["COASTMESH_PROGRAM"] = PROGRAM
settings = tempfile.mkdtemp()  # so that the user's settings do not matter
QgsApplication.setPrefixPath("/usr", True)
application = QgsApplication([], False, settings)
application.initQgis()
sys.path[:0] = [os.path.join(QgsApplication.pkgDataPath(), "python", "plugins"), PLUGINS]
import processing  # noqa: E402
from processing.core.Processing import Processing  # noqa: E402

import coastmesh_qgis  # noqa: E402

Processing.initialize()
plugin = coastmesh_qgis.classFactory(None)
plugin.initProcessing()
try:
    outcome = unittest.main(argv=sys.argv[:1] + sys.argv[3:], exit=False, verbosity=2).result
finally:
    plugin.unload()
    application.exitQgis()
    shutil.rmtree(settings, ignore_errors=True)
sys.stdout.flush()
os._exit(not outcome.wasSuccessful())  # QGIS may crash when it exits
