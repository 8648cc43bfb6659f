"""How results look: triangles from red to blue by their smallest angle, boundaries by their role, edits as dots."""
from qgis.core import (
    QgsCategorizedSymbolRenderer,
    QgsColorRampShader,
    QgsFillSymbol,
    QgsGraduatedSymbolRenderer,
    QgsLineSymbol,
    QgsMarkerSymbol,
    QgsMeshDatasetIndex,
    QgsMeshLayer,
    QgsMeshRendererScalarSettings,
    QgsProcessingLayerPostProcessorInterface,
    QgsRendererCategory,
    QgsRendererRange,
    QgsSingleSymbolRenderer,
    QgsVectorLayer,
)
from qgis.PyQt.QtGui import QColor

# Degrees of a triangle's smallest angle, and the colour from there on.
ANGLES = [(0, "#b2182b"), (20, "#ef8a62"), (25, "#fddbc7"), (30, "#d1e5f0"), (35, "#92c5de"), (40, "#4393c3"),
          (50, "#2166ac")]
LARGEST = 60  # no smallest angle is larger
ROLES = {"land": "#1b3a57", "island": "#b8860b", "open": "#d6278f"}
OTHER_ROLE = "#6b6b6b"
EDGE = QColor(30, 50, 70, 160)


class _Style(QgsProcessingLayerPostProcessorInterface):
    """Hands a layer to the function `paint`, if there is one. Kept alive here: Processing does not own it."""

    alive = []

    def __init__(self, paint, project):
        super().__init__()
        self.paint = paint
        self.shown_before = set(project.mapLayers()) if project else set()
        _Style.alive.append(self)

    def postProcessLayer(self, layer, context, feedback):
        try:
            # Processing adds no second layer of a file: the one that is there still shows the file's former content.
            if layer.id() in self.shown_before:
                layer.reload()
                if isinstance(layer, QgsVectorLayer):
                    layer.updateExtents()
            if self.paint:
                self.paint(layer)
            layer.triggerRepaint()
        finally:
            _Style.alive.remove(self)


def style_for(output, context):
    """What brings the layer of that output up to date and paints it."""
    paint = {
        "OUTPUT": paint_mesh,
        "TRIANGLES": paint_triangles,
        "BOUNDARIES": paint_boundaries,
        "EDITS": paint_edits,
        "PSLG": paint_plane_graph,
    }.get(output)
    return _Style(paint, context.project())


def paint_mesh(layer):
    """The mesh's edges over its smallest angles, where the file has them."""
    if not isinstance(layer, QgsMeshLayer):
        return
    settings = layer.rendererSettings()
    edges = settings.nativeMeshSettings()
    edges.setEnabled(True)
    edges.setLineWidth(0.15)
    edges.setColor(EDGE)
    settings.setNativeMeshSettings(edges)
    for group in layer.datasetGroupsIndexes():
        if layer.datasetGroupMetadata(QgsMeshDatasetIndex(group)).name() == "smallest angle":
            scalar = settings.scalarSettings(group)
            scalar.setColorRampShader(_angle_shader())
            scalar.setClassificationMinimumMaximum(0, LARGEST)
            # One colour per triangle: averaging over neighbours would hide the bad ones. (None is a keyword of Python.)
            scalar.setDataResamplingMethod(getattr(QgsMeshRendererScalarSettings, "None", 0))
            settings.setScalarSettings(group, scalar)
            settings.setActiveScalarDatasetGroup(group)
    layer.setRendererSettings(settings)


def _angle_shader():
    shader = QgsColorRampShader(0, LARGEST, None, QgsColorRampShader.Discrete)
    uppers = [low for low, _ in ANGLES[1:]] + [float("inf")]
    shader.setColorRampItemList(
        [
            QgsColorRampShader.ColorRampItem(upper, QColor(color), _range_text(low, upper))
            for (low, color), upper in zip(ANGLES, uppers)
        ]
    )
    return shader


def _range_text(low, upper):
    return f"{low}° and more" if upper == float("inf") else f"{low}° to {upper}°"


def paint_triangles(layer):
    if not isinstance(layer, QgsVectorLayer) or layer.fields().indexOf("min_angle") < 0:
        return
    ranges = []
    uppers = [low for low, _ in ANGLES[1:]] + [LARGEST + 1]
    for (low, color), upper in zip(ANGLES, uppers):
        symbol = QgsFillSymbol.createSimple(
            {"color": color, "outline_color": "60,80,100,110", "outline_width": "0.1"}
        )
        label = _range_text(low, upper if upper <= LARGEST else float("inf"))
        ranges.append(QgsRendererRange(low, upper, symbol, label))
    layer.setRenderer(QgsGraduatedSymbolRenderer("min_angle", ranges))


def paint_boundaries(layer):
    categories = []
    for role, color in ROLES.items():
        symbol = QgsLineSymbol.createSimple({"color": color, "width": "0.5"})
        categories.append(QgsRendererCategory(role, symbol, role))
    other = QgsLineSymbol.createSimple({"color": OTHER_ROLE, "width": "0.5"})
    categories.append(QgsRendererCategory(None, other, "other"))
    layer.setRenderer(QgsCategorizedSymbolRenderer("role", categories))


def paint_edits(layer):
    symbol = QgsMarkerSymbol.createSimple({"name": "circle", "color": "#d6278f", "size": "2", "outline_style": "no"})
    layer.setRenderer(QgsSingleSymbolRenderer(symbol))


def paint_plane_graph(layer):
    layer.setRenderer(QgsSingleSymbolRenderer(QgsLineSymbol.createSimple({"color": "#1b3a57", "width": "0.3"})))
