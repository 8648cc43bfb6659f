"""Layers of QGIS as files that the program reads."""
import os
import re

from osgeo import ogr
from qgis.core import (
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
        return self._write(source, layer.name() if layer is not None else source.sourceName())

    def path_of_layer(self, layer):
        """The file of a map layer: vector, raster or mesh."""
        if layer is None:
            raise QgsProcessingException("a layer that was asked for cannot be loaded")
        if isinstance(layer, QgsVectorLayer):
            return _own_file(layer) or self._write(layer, layer.name())
        if isinstance(layer, QgsMeshLayer):
            return mesh_path(layer.source())
        if isinstance(layer, QgsRasterLayer):
            parts = QgsProviderRegistry.instance().decodeUri(layer.providerType(), layer.source())
            path = parts.get("path", "")
            if path and os.path.exists(path):
                return path
        raise QgsProcessingException(f"the layer '{layer.name()}' lies in no file: save it as one first")

    def _write(self, source, name):
        """Writes features to a GeoPackage, with their ids, so that messages can name them."""
        path = QgsProcessingUtils.generateTempFilename("input.gpkg")
        crs = source.crs() if isinstance(source, QgsVectorLayer) else source.sourceCrs()
        fields = QgsFields()
        fields.append(QgsField("fid", QVariant.LongLong))
        kept = []  # indices of the source's fields
        for i, each in enumerate(source.fields()):
            if each.name().lower() not in ("fid", "geom") and each.type() in PLAIN_TYPES:
                kept.append(i)
                fields.append(each)
        options = QgsVectorFileWriter.SaveVectorOptions()
        options.driverName = "GPKG"
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
    if layer.providerType() != "ogr" or layer.subsetString() or layer.isEditable():
        return None
    parts = QgsProviderRegistry.instance().decodeUri("ogr", layer.source())
    path = parts.get("path", "")
    if not os.path.isfile(path) or path.lower().endswith((".zip", ".gz", ".tar", ".tgz")):
        return None
    data = ogr.Open(path)
    if data is None or data.GetLayerCount() != 1:
        return None
    # A CRS that was assigned to the layer in QGIS is in no file.
    return path if QgsVectorLayer(layer.source(), "", "ogr").crs() == layer.crs() else None
