"""Options of the program as parameters of Processing, and back."""
import re

from qgis.core import (
    QgsCoordinateReferenceSystem,
    QgsCoordinateTransform,
    QgsPointXY,
    QgsProcessing,
    QgsProcessingException,
    QgsProcessingParameterBoolean,
    QgsProcessingParameterCrs,
    QgsProcessingParameterDefinition,
    QgsProcessingParameterDistance,
    QgsProcessingParameterEnum,
    QgsProcessingParameterExtent,
    QgsProcessingParameterFile,
    QgsProcessingParameterFileDestination,
    QgsProcessingParameterMapLayer,
    QgsProcessingParameterMultipleLayers,
    QgsProcessingParameterNumber,
    QgsProcessingParameterPoint,
    QgsProcessingParameterString,
    QgsRectangle,
    QgsReferencedRectangle,
    QgsUnitTypes,
)
from qgis.PyQt.QtCore import QVariant

from .verbs import BASIC

EXTENT_UNIT = "W,S,E,N"
POINT_UNIT = "LON,LAT"
WORKING_PLANES = ("auto", "plane")  # what --crs takes besides a CRS
LISTS = (list, tuple)  # what scripts, and qgis_process for a parameter given twice, have for several values
NUMBER = r"\s*([-+0-9.eE]+)\s*"
# XMIN,XMAX,YMIN,YMAX [CRS]
BOX = re.compile(f"^{NUMBER},{NUMBER},{NUMBER},{NUMBER}(?:\\[(?P<crs>.*)\\])?\\s*$")


def parameter_name(option):
    """"--min-angle" is MIN_ANGLE; INPUT is what every algorithm reads, so that the option --input is MADE_FROM."""
    if option["name"] == "--input":
        return "MADE_FROM"
    return option["name"].lstrip("-").replace("-", "_").upper()


def by_present_names(options, parameters):
    """Values by the names that parameters have now, and a sentence for each that came by a former one."""
    values, warnings = dict(parameters), []
    for option in options:
        for former in list(option.get("former_names", {}))[:1]:
            old, new = parameter_name({"name": former}), parameter_name(option)
            if old in values:
                values.setdefault(new, values.pop(old))
                warnings.append(f"{old} is called {new} now; the next version will not accept the former name")
    return values, warnings


def make_parameter(option):
    """The parameter that stands for an option; its default is the program's own."""
    parameter = _make(option, parameter_name(option), _title(option))
    parameter.setHelp(help_of(option))
    if option["name"] not in BASIC and not option.get("required"):
        parameter.setFlags(parameter.flags() | QgsProcessingParameterDefinition.FlagAdvanced)
    return parameter


def help_of(option):
    """What the program says of the option, and how a parameter of text takes several values."""
    return f"{option['help']}; one value per line, or a list" if _takes_lines(option) else option["help"]


def _takes_lines(option):
    """Whether each line of the parameter's text is a value: Processing has lists of layers, but none of text."""
    return option.get("multiple", False) and option["type"] != "file"


def _title(option):
    unit = {"DEG": "degrees", "M": "metres", "M2": "square metres", "S": "seconds"}.get(option.get("unit"))
    return f"{option['label']} [{unit}]" if unit else option["label"]


def _make(option, name, title):
    default = option.get("default")
    optional = default is None and not option.get("required", False)
    kind, unit = option["type"], option.get("unit")
    if _takes_lines(option):
        return QgsProcessingParameterString(name, title, default, multiLine=True, optional=optional)
    if kind == "flag":
        return QgsProcessingParameterBoolean(name, title, default, optional)
    if kind == "choice":
        return QgsProcessingParameterEnum(
            name, title, option["choices"], defaultValue=default, optional=optional, usesStaticStrings=True
        )
    if kind in ("number", "integer"):
        return _number(option, name, title, optional)
    if kind == "file":
        return _file(option, name, title, optional)
    if unit == "CRS":
        return QgsProcessingParameterCrs(name, title, None, True)
    if unit == EXTENT_UNIT:
        return QgsProcessingParameterExtent(name, title, default, optional)
    if unit == POINT_UNIT:
        return QgsProcessingParameterPoint(name, title, default, optional)
    return QgsProcessingParameterString(name, title, default, optional=optional)


def _number(option, name, title, optional):
    low, high = option.get("minimum", option.get("exclusive_minimum")), option.get("maximum")
    default = option.get("default")
    if option["type"] == "number" and option.get("unit") == "M":
        parameter = QgsProcessingParameterDistance(name, title, default, "", optional)
        parameter.setDefaultUnit(QgsUnitTypes.DistanceMeters)
    else:
        whole = option["type"] == "integer"
        type_ = QgsProcessingParameterNumber.Integer if whole else QgsProcessingParameterNumber.Double
        parameter = QgsProcessingParameterNumber(name, title, type_, default, optional)
    # Processing's boxes have six decimals and no open ranges: the program rejects an excluded bound.
    if low is not None:
        parameter.setMinimum(low)
    if high is not None:
        parameter.setMaximum(high)
    return parameter


def _file(option, name, title, optional):
    if option.get("role") == "output":
        # Without a path, the file is not written.
        return QgsProcessingParameterFileDestination(name, title, _filter_of(option), None, True, False)
    if option.get("role") == "input":  # of the program's own: no layer
        return QgsProcessingParameterFile(name, title, optional=optional)
    kinds = {"vector": QgsProcessing.TypeVector, "raster": QgsProcessing.TypeRaster}
    kind = kinds.get(option.get("role"), QgsProcessing.TypeMapLayer)
    if option.get("multiple"):
        return QgsProcessingParameterMultipleLayers(name, title, kind, None, optional)
    return QgsProcessingParameterMapLayer(name, title, None, optional, [] if kind == QgsProcessing.TypeMapLayer else [kind])


def _filter_of(option):
    filters = {"--report": "JSON (*.json)", "--numbers": "CSV (*.csv)",
               "--edits": "GeoPackage (*.gpkg);;GeoJSON (*.geojson);;FlatGeobuf (*.fgb)"}
    return filters.get(option["name"], "All files (*)")


def arguments_of(option, algorithm, parameters, context, path_of_layer, crs):
    """The program's arguments for one option; none where its value is the default.

    `path_of_layer` gives the file of a map layer; extents and points are brought into `crs`.
    """
    name = parameter_name(option)
    value = parameters.get(name)
    if value is None or value == "" or (isinstance(value, QVariant) and value.isNull()):
        return []
    flag, kind, unit = option["name"], option["type"], option.get("unit")
    if _takes_lines(option):
        return [f"{flag}={each}" for each in _lines(algorithm, parameters, name, context)]
    if isinstance(value, LISTS) and not option.get("multiple"):
        raise QgsProcessingException(f"{name} takes one value, not {len(value)} in a list")
    if kind == "flag":
        return _flag(option, algorithm.parameterAsBoolean(parameters, name, context))
    if kind == "choice":
        values = [algorithm.parameterAsEnumString(parameters, name, context)]
    elif kind == "number":
        values = [repr(algorithm.parameterAsDouble(parameters, name, context))]
    elif kind == "integer":
        values = [str(_integer(algorithm, parameters, name, context))]
    elif kind == "file":
        values = _files(option, algorithm, parameters, context, path_of_layer)
    elif unit == "CRS":
        values = [_crs(algorithm, parameters, name, context)]
    elif unit == EXTENT_UNIT:
        values = [",".join(repr(side) for side in _box(algorithm, parameters, name, context, crs))]
    elif unit == POINT_UNIT:
        point = algorithm.parameterAsPoint(parameters, name, context, crs)
        values = [f"{point.x()!r},{point.y()!r}"]
    else:
        values = [algorithm.parameterAsString(parameters, name, context)]
    if not option.get("multiple") and _is_default(option, values[0]):
        return []
    # One word, so that a value that begins with a dash is not taken for an option.
    return [f"{flag}={value}" for value in values]


def how_to_give_several(options, parameters, refused):
    """A sentence for each parameter of which the program's message `refused` names a value that may be meant as several;
    empty if there is none."""
    sentences = ""
    for option in filter(_takes_lines, options):
        name = parameter_name(option)
        values = parameters.get(name)
        values = [values] if isinstance(values, str) else values if isinstance(values, LISTS) else []
        if any(re.search(r"\S[,;|\s]+\S", str(value)) and f"'{value}'" in refused for value in values):
            sentences += f"; several values of {name} are given one per line, or as a list"
    return sentences


def _lines(algorithm, parameters, name, context):
    """The values of a parameter that takes several: the items of a list, or the lines of a text."""
    value = parameters[name]
    if not isinstance(value, LISTS):
        if isinstance(value, (dict, set, bytes)):
            raise QgsProcessingException(f"{name} takes a text with one value per line, or a list: {value!r} is neither")
        value = algorithm.parameterAsString(parameters, name, context).splitlines()
    for each in value:
        if not isinstance(each, (str, int, float)) or isinstance(each, bool):
            raise QgsProcessingException(f"each item of the list {name} is one value, a text: {each!r} is none")
    return [str(each) for each in value if str(each).strip()]


def _is_default(option, text):
    default = option.get("default")
    if default is None:
        return False
    return float(text) == default if option["type"] in ("number", "integer") else text == default


def _integer(algorithm, parameters, name, context):
    # parameterAsInt stops at 32 bits.
    return int(round(algorithm.parameterAsDouble(parameters, name, context)))


def _flag(option, on):
    if on == option["default"]:
        return []
    if on:
        return [option["name"]]
    return [next(name for name in option["names"] if name.startswith("--no-"))]


def _box(algorithm, parameters, name, context, crs):
    """West, south, east and north in `crs`. East is less than west if the box crosses the antimeridian; from
    parameterAsExtent it would reach around the rest of the Earth."""
    (west, south, east, north), own = _own_box(algorithm, parameters, name, context)
    south, north = min(south, north), max(south, north)
    if not (own if own.isValid() else crs).isGeographic():
        west, east = min(west, east), max(west, east)
    if not own.isValid() or not crs.isValid() or own == crs:
        return west, south, east, north
    to_crs = QgsCoordinateTransform(own, crs, context.transformContext())
    own_box = QgsRectangle(west, south, east + 360 if east < west else east, north)
    box = to_crs.transformBoundingBox(own_box)
    west, south, east, north = box.xMinimum(), box.yMinimum(), box.xMaximum(), box.yMaximum()
    if crs.isGeographic() and east - west > 180:
        around = _longitudes_around(own_box, to_crs)
        if abs(around[-1] - around[0]) > 180:  # it encloses a pole
            west, east = -180.0, 180.0
            south, north = (south, 90.0) if south + north > 0 else (-90.0, north)
        elif max(around) - min(around) < 359:
            west, east = (lon - 360 * round(lon / 360) for lon in (min(around), max(around)))
    return west, south, east, north


def _own_box(algorithm, parameters, name, context):
    """West, south, east and north as the value of an extent states them, and its CRS, invalid if it states none."""
    value = parameters[name]
    stated = BOX.match(value) if isinstance(value, str) else None
    if stated:
        west, east, south, north = (float(stated[i]) for i in range(1, 5))
        return (west, south, east, north), QgsCoordinateReferenceSystem(stated["crs"] or "")
    box = algorithm.parameterAsExtent(parameters, name, context)
    plain = isinstance(value, QgsRectangle) and not isinstance(value, QgsReferencedRectangle)
    own = QgsCoordinateReferenceSystem() if plain else algorithm.parameterAsExtentCrs(parameters, name, context)
    return (box.xMinimum(), box.yMinimum(), box.xMaximum(), box.yMaximum()), own


def _longitudes_around(box, to_crs):
    """Longitudes of places along the sides of a box and back to the first, without jumps at the antimeridian."""
    corners = [(box.xMinimum(), box.yMinimum()), (box.xMaximum(), box.yMinimum()),
               (box.xMaximum(), box.yMaximum()), (box.xMinimum(), box.yMaximum())]
    steps = 20  # per side
    longitudes = []
    for (x, y), (next_x, next_y) in zip(corners, corners[1:] + corners[:1]):
        for i in range(steps + 1):
            share = i / steps
            lon = to_crs.transform(QgsPointXY(x + share * (next_x - x), y + share * (next_y - y))).x()
            longitudes.append(lon - 360 * round((lon - longitudes[-1]) / 360) if longitudes else lon)
    return longitudes


def crs_text(crs):
    """A CRS as the program reads it; codes of the user's own are known to QGIS only."""
    known = crs.authid() and not crs.authid().startswith("USER:")
    return crs.authid() if known else crs.toWkt(QgsCoordinateReferenceSystem.WKT_PREFERRED)


def _crs(algorithm, parameters, name, context):
    value = parameters[name]
    if value in WORKING_PLANES:
        return value
    crs = algorithm.parameterAsCrs(parameters, name, context)
    if not crs.isValid():
        return str(value)  # the program reports what is wrong
    return crs_text(crs)


def _files(option, algorithm, parameters, context, path_of_layer):
    name = parameter_name(option)
    if option.get("role") == "output":
        return [algorithm.parameterAsFileOutput(parameters, name, context)]
    if option.get("role") == "input":
        return [algorithm.parameterAsFile(parameters, name, context)]
    if option.get("multiple"):
        layers = algorithm.parameterAsLayerList(parameters, name, context)
    else:
        layers = [algorithm.parameterAsLayer(parameters, name, context)]
    return [path_of_layer(layer) for layer in layers]
