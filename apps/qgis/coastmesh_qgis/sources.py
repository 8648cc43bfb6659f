"""Layers of QGIS as files that the program reads."""
import codecs
import os
import re

from osgeo import gdal, ogr
from qgis.core import (
    QgsCoordinateReferenceSystem,
    QgsFeature,
    QgsFeatureRequest,
    QgsField,
    QgsFields,
    QgsMeshLayer,
    QgsProcessingException,
    QgsProcessingFeatureSourceDefinition,
    QgsProcessingUtils,
    QgsProviderRegistry,
    QgsRasterLayer,
    QgsVectorFileWriter,
    QgsVectorLayer,
)
from qgis.PyQt.QtCore import QVariant

MESH_URI = re.compile(r'^(?:[A-Za-z0-9_]+:)?"(?P<path>[^"]+)"')  # Ugrid:"folder/lake.nc":mesh2d


class Sources:
    """Gives the file of each layer, and knows how to name them for people. `close` removes the files it made."""

    def __init__(self, context, feedback):
        self.context = context
        self.feedback = feedback
        self.made = {}  # path: the layer's name

    def close(self):
        for path in self.made:
            for name in (path, path + "-wal", path + "-shm"):
                if os.path.exists(name):
                    os.remove(name)

    def in_words(self, text):
        """`text` with the names of layers in place of those of temporary files."""
        for path, name in self.made.items():
            text = text.replace(path, name)
        return text

    def path_of_source(self, source, layer, selected):
        """The file of a feature source: the layer's own where it holds just these features, else one made of them."""
        if isinstance(layer, QgsVectorLayer) and not selected:
            path = _own_file(layer)
            if path:
                return path
        name = layer.name() if layer is not None else source.sourceName()
        if selected and source.featureCount() == 0:
            raise QgsProcessingException(f"no feature of '{name}' is selected")
        return self._write(source, name)

    def path_of_layer(self, layer):
        """The file of a map layer: vector, raster or mesh."""
        if layer is None:
            raise QgsProcessingException("a layer that was asked for cannot be loaded")
        if isinstance(layer, QgsVectorLayer):
            return _own_file(layer) or self._write(layer, layer.name())
        if isinstance(layer, QgsMeshLayer):
            if layer.isModified():
                raise QgsProcessingException(f"the mesh layer '{layer.name()}' has edits: save them first")
            return mesh_path(layer.source())
        if isinstance(layer, QgsRasterLayer):
            name = self._raster(layer)
            if name:
                return name
        raise QgsProcessingException(f"the layer '{layer.name()}' lies in no file: save it as one first")

    def path_of_mesh(self, layer):
        """The file of a mesh. For the triangles that `mesh` wrote it is their GeoPackage: other layers of it hold the
        depths of nodes and the types of boundaries."""
        path = _mesh_of_triangles(layer)
        if path:
            self._require_saved(path, layer)
            if _file_of(layer):
                return path
            self.feedback.pushWarning(
                f"'{layer.name()}' shows something else than its file, by a filter or another property: its triangles are "
                "read alone, without the depths, types of boundaries and attributes of nodes in other layers of the file")
        return self.path_of_layer(layer)

    def _require_saved(self, path, layer):
        """Refuses a mesh of which a layer has edits that are not in its file."""
        project = self.context.project()
        layers = [layer, *(project.mapLayers().values() if project else [])]
        for each in layers:
            if isinstance(each, QgsVectorLayer) and each.isModified() and _path_of(each) == path:
                raise QgsProcessingException(f"the layer '{each.name()}' has edits: save them first")

    def _raster(self, layer):
        """GDAL's name of a raster: a file, a part of one, or a VRT file aside with what was set in QGIS: the CRS, and
        the value of pixels without data."""
        if layer.providerType() != "gdal":
            return None
        name = layer.source().split("|")[0]
        changes = {}
        if layer.crs() != layer.dataProvider().crs() and layer.crs().isValid():
            changes["outputSRS"] = layer.crs().toWkt(QgsCoordinateReferenceSystem.WKT_PREFERRED)
        no_data = self._no_data(layer)
        if no_data is not None:
            changes["noData"] = no_data
        if not changes:
            return name
        path = QgsProcessingUtils.generateTempFilename("raster.vrt")
        self.made[path] = layer.name()
        gdal.Translate(path, name, format="VRT", **changes)
        if not os.path.exists(path):
            raise QgsProcessingException(f"cannot pass on the settings of '{layer.name()}': {gdal.GetLastErrorMsg()}")
        return path

    def _no_data(self, layer):
        """The value of pixels without data where it is not the file's own: a number, "none", or None."""
        provider = layer.dataProvider()
        in_file = provider.sourceHasNoDataValue(1) and provider.useSourceNoDataValue(1)
        values = {end for each in provider.userNoDataValues(1) for end in (each.min(), each.max())}
        if in_file:
            values.add(provider.sourceNoDataValue(1))
        if len(values) > 1:
            raise QgsProcessingException(f"the layer '{layer.name()}' has several values for pixels without data in "
                                         "its properties: save it as a file with one")
        if values and not in_file:
            return values.pop()
        return "none" if provider.sourceHasNoDataValue(1) and not in_file else None

    def _write(self, source, name):
        """Writes features to a GeoPackage, with their ids, so that messages can name them."""
        # Results keep the name of the file as the source of their features.
        stem = re.sub(r"[^A-Za-z0-9_ -]", "_", name).strip()[:100] or "input"
        path = QgsProcessingUtils.generateTempFilename(stem + ".gpkg")
        crs = source.crs() if isinstance(source, QgsVectorLayer) else source.sourceCrs()
        fields = QgsFields()
        fields.append(QgsField("fid", QVariant.LongLong))
        kept = []  # indices of the source's fields
        taken = {"fid", "geom"}  # a GeoPackage does not distinguish names by case
        for i, each in enumerate(source.fields()):
            if each.name().lower() not in taken and each.type() in PLAIN_TYPES:
                taken.add(each.name().lower())
                kept.append(i)
                fields.append(each)
        options = QgsVectorFileWriter.SaveVectorOptions()
        options.driverName = "GPKG"
        options.layerName = "input"
        options.fileEncoding = "UTF-8"
        options.layerOptions = ["FID=fid", "GEOMETRY_NAME=geom", "SPATIAL_INDEX=NO"]
        writer = QgsVectorFileWriter.create(
            path, fields, source.wkbType(), crs, self.context.transformContext(), options
        )
        self.made[path] = name
        if writer.hasError() != QgsVectorFileWriter.NoError:
            raise QgsProcessingException(f"cannot write '{name}' aside: {writer.errorMessage()}")
        for feature in self._features(source):
            if self.feedback.isCanceled():
                break
            copy = QgsFeature(fields)
            copy.setGeometry(feature.geometry())
            values = feature.attributes()
            copy.setAttributes([feature.id()] + [values[i] for i in kept])
            if not writer.addFeature(copy):
                raise QgsProcessingException(f"cannot write '{name}' aside: {writer.errorMessage()}")
        del writer
        return path

    @staticmethod
    def _features(source):
        if isinstance(source, QgsVectorLayer):
            return source.getFeatures()
        # The program repairs and reports invalid geometries.
        from qgis.core import QgsProcessingFeatureSource

        return source.getFeatures(QgsFeatureRequest(), QgsProcessingFeatureSource.FlagSkipGeometryValidityChecks)


PLAIN_TYPES = (QVariant.Int, QVariant.LongLong, QVariant.Double, QVariant.String, QVariant.Bool, QVariant.Date,
               QVariant.DateTime)


def takes_selection(parameters, name):
    """Whether the value of a feature-source parameter is more than a whole layer: a selection, a limit, a filter."""
    value = parameters.get(name)
    if not isinstance(value, QgsProcessingFeatureSourceDefinition):
        return False
    limited = value.featureLimit != -1 or bool(getattr(value, "filterExpression", ""))
    return value.selectedFeaturesOnly or limited


def mesh_path(uri):
    """The file in the source of a mesh layer."""
    found = MESH_URI.match(uri)
    return found.group("path") if found else uri


def _own_file(layer):
    """The file that holds what the layer shows and nothing else, or None."""
    path = _file_of(layer)
    return path if path and len(_layers_in(path)) == 1 else None


def _mesh_of_triangles(layer):
    """The GeoPackage of a mesh, if the layer is that of its triangles, however it is shown; otherwise None."""
    path = _path_of(layer) if isinstance(layer, QgsVectorLayer) else None
    if not path or _parts_of(layer).get("layerName") != "triangles":
        return None
    return path if {"triangles", "nodes"} <= _layers_in(path) else None


def _parts_of(layer):
    return QgsProviderRegistry.instance().decodeUri("ogr", layer.source()) if layer.providerType() == "ogr" else {}


def _path_of(layer):
    """The file that a vector layer lies in, or None."""
    path = _parts_of(layer).get("path", "")
    return path if os.path.isfile(path) else None


def _file_of(layer):
    """The file that holds the layer as QGIS shows it, perhaps beside others, or None."""
    provider = layer.dataProvider()
    path = _path_of(layer)
    if not path or layer.subsetString() or layer.isModified():
        return None
    # Other parts are a type of geometry, which selects features, or options of the driver.
    if any(value for part, value in _parts_of(layer).items() if part not in ("path", "layerName", "layerId")):
        return None
    if path.lower().endswith((".zip", ".gz", ".tar", ".tgz")):
        return None
    # Joined and virtual fields are in no file, nor is a CRS that was assigned to the layer in QGIS.
    if layer.fields().names() != provider.fields().names() or layer.crs() != provider.crs():
        return None
    return path if _has_texts_of_file(layer, path) else None


def _has_texts_of_file(layer, path):
    """Whether QGIS decodes texts as the file says, not as chosen in the layer's properties."""
    shown = layer.dataProvider().encoding()
    data = ogr.Open(path)
    of_file = "UTF-8"
    if data is not None and data.GetDriver().GetName() == "ESRI Shapefile":
        said = data.GetLayer(0).GetMetadata("SHAPEFILE")
        of_file = said.get("ENCODING_FROM_CPG") or said.get("ENCODING_FROM_LDID", "")
    # QGIS shows UTF-8, or what the system uses, if a file says nothing.
    if not of_file:
        return shown in ("", "System", "UTF-8")
    try:
        return shown in ("", "System") or codecs.lookup(shown).name == codecs.lookup(of_file).name
    except LookupError:
        return False


def _layers_in(path):
    data = ogr.Open(path)
    return {data.GetLayer(i).GetName() for i in range(data.GetLayerCount())} if data is not None else set()
