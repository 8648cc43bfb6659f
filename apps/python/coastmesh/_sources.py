"""What functions of coastmesh are given to work on: files, GeoJSON, whatever has a __geo_interface__, arrays."""
import contextlib
import datetime
import itertools
import json
import math
import numbers
import os

import numpy as np

from ._errors import InputError, OptionError


def split(source, segments, holes, memory):
    """What to mesh as (paths, plane graph or None). GeoJSON becomes a file in `memory`."""
    def shapes(text):
        return [memory.add(text, "GeoJSON")], None

    if segments is not None or holes is not None:
        return [], (source, segments, holes)
    if isinstance(source, str):
        return shapes(_geojson_text(_geojson_of(source))) if _is_geojson(source) else ([source], None)
    if isinstance(source, os.PathLike):
        return [source], None
    if isinstance(source, dict):
        if "vertices" in source:
            return [], (source["vertices"], source.get("segments"), source.get("holes"))
        return shapes(_geojson_text(source))
    if hasattr(source, "__geo_interface__"):
        return shapes(_shapes_text(source))
    if isinstance(source, np.ndarray) and source.dtype == object and source.ndim == 1:
        source = source.tolist()  # as shapely's functions return shapes
    if isinstance(source, (list, tuple)):
        if not source:
            raise InputError("there is nothing to mesh")
        if any(_is_geojson(part) for part in source):
            return shapes(_list_text(source))
        if all(isinstance(part, (str, os.PathLike)) for part in source):
            return list(source), None
        if isinstance(source, tuple) and len(source) in (2, 3) and np.ndim(source[0]) == 2:
            return [], (*source, None)[:3]
        return [], (source, None, None)
    if isinstance(source, np.ndarray):
        return [], (source, None, None)
    raise TypeError(f"cannot mesh a {type(source).__name__}: give a path, GeoJSON, or points and segments")


def with_paths(keywords, options, memory):
    """Options as keywords, with paths of files in `memory` in place of shapes. `options`: those that name vector files, by
    keyword, with what their usage says of each."""
    given = {}
    for name in options.keys() & keywords.keys():
        if keywords[name] is None:
            continue
        paths = _paths(keywords[name], name, memory)
        if options[name].get("multiple"):
            given[name] = paths
        elif len(paths) == 1:
            given[name] = paths[0]
        else:
            raise OptionError(f"{name}: takes one path, or shapes, not {len(paths)} paths")
    return {**keywords, **given}


def lines_of(lines, memory):
    """The paths of the lines of `rivers`."""
    paths = _paths(lines, "lines", memory, TypeError)
    if not paths:
        raise InputError("there is no line of a river")
    return paths


def _paths(given, name, memory, wrong=OptionError):
    """The paths of what may be paths, shapes, or a list of both, in its order: shapes in a row become one file in `memory`.
    `name` is in messages; if the list has paths as well, followed by the index of the first shape of the row. What is
    neither raises `wrong`."""
    # Arrays, as shapely's functions return shapes; those of geopandas would lose their CRS.
    if not _is_geojson(given) and hasattr(given, "tolist") and not hasattr(given, "crs"):
        given = given.tolist()
    parts = list(given) if isinstance(given, (list, tuple)) else [given]
    paths, at = [], 0
    for are_shapes, row in itertools.groupby(parts, _is_geojson):
        row = list(row)
        if are_shapes:
            named = name if len(row) == len(parts) else f"{name}[{at}]"
            with _naming(named):
                text = _list_text(row) if isinstance(given, (list, tuple)) else _shapes_text(given)
            paths.append(memory.add(text, named))
        else:
            paths.extend(_path(part, name, wrong) for part in row)
        at += len(row)
    return paths


def _path(part, name, wrong):
    if isinstance(part, (str, bytes, os.PathLike)):
        return part
    raise wrong(f"{name}: a {type(part).__name__} is neither a path nor GeoJSON, and has no __geo_interface__")


@contextlib.contextmanager
def _naming(name):
    """Puts the name before what is wrong with shapes."""
    try:
        yield
    except (InputError, TypeError) as error:
        raise type(error)(f"{name}: {error}") from None


def _is_geojson(part):
    return isinstance(part, dict) or hasattr(part, "__geo_interface__") or (
        isinstance(part, str) and part.lstrip().startswith("{"))


def _geojson_of(part):
    """GeoJSON as a dict, of anything that _is_geojson."""
    if isinstance(part, dict):
        return part
    if not isinstance(part, str):
        geojson = part.__geo_interface__
        if not isinstance(geojson, dict):
            raise TypeError(f"the __geo_interface__ of a {type(part).__name__} is no dict")
        # The outline of a polygon in shapely, which GeoJSON does not know.
        return {**geojson, "type": "LineString"} if geojson.get("type") == "LinearRing" else geojson
    try:
        return json.loads(part)
    except json.JSONDecodeError as error:
        raise InputError(f"GeoJSON: {error}") from None


def _shapes_text(shapes):
    """What has a __geo_interface__, or is GeoJSON, as GeoJSON."""
    return _geojson_text(_geojson_of(shapes), getattr(shapes, "crs", None))


def _list_text(shapes):
    """A list of GeoJSON as one."""
    features, crs = [], None
    for i, shape in enumerate(shapes):
        if not _is_geojson(shape):
            raise TypeError(f"number {i} of the list is a {type(shape).__name__}, which is no GeoJSON and has no "
                            "__geo_interface__")
        geojson = _geojson_of(shape)
        own = getattr(shape, "crs", None)
        own = geojson.get("crs") if own is None else own
        if i > 0 and own != crs:
            raise InputError(f"number {i} of the list is in another CRS than those before it")
        crs = own
        if geojson.get("type") == "FeatureCollection":
            if not isinstance(geojson.get("features"), (list, tuple)):
                raise InputError(f"number {i} of the list is a FeatureCollection without a list of features")
            features.extend(geojson["features"])
        else:
            features.append(geojson if geojson.get("type") == "Feature" else _feature(geojson))
    return _geojson_text({"type": "FeatureCollection", "features": features}, crs)


def _feature(geometry):
    return {"type": "Feature", "properties": {}, "geometry": geometry}


def _geojson_text(geojson, crs=None):
    """GeoJSON as text. `crs`: of pyproj, the name or EPSG's code of one, or the "crs" of GeoJSON; None leaves what `geojson`
    says."""
    crs = geojson.get("crs") if crs is None else crs
    if geojson.get("type") == "FeatureCollection" and isinstance(geojson.get("features"), (list, tuple)):
        geojson = {**geojson, "features": [_with_attributes(part, i) for i, part in enumerate(geojson["features"])]}
    elif geojson.get("type") != "FeatureCollection":
        geojson = _with_attributes(geojson, 0) if geojson.get("type") == "Feature" else _feature(geojson)
    if crs is not None:
        geojson = {**geojson, "crs": crs if isinstance(crs, dict) and "type" in crs else _named_crs(crs)}
    try:
        return json.dumps(geojson, default=_plain)
    except (TypeError, ValueError) as error:
        raise InputError(f"GeoJSON: {error}") from None


_SAME_IN_JSON = {str, int, bool, type(None)}


def _with_attributes(feature, number):
    """A feature, the `number`-th, with attributes that JSON has."""
    if hasattr(feature, "__geo_interface__"):
        feature = _geojson_of(feature)
    properties = feature.get("properties") if isinstance(feature, dict) else None
    if not isinstance(properties, dict):
        return feature
    return {**feature, "properties": {
        str(name): value if type(value) in _SAME_IN_JSON else _attribute(value, name, number)
        for name, value in properties.items()}}


def _attribute(value, name, number):
    """Numbers of any kind as Python's, dates and whatever else has a text as text, what stands for a missing value in numpy
    and pandas as None."""
    if isinstance(value, (np.datetime64, np.timedelta64)):  # their tolist() makes a number of nanoseconds
        return None if np.isnat(value) else str(value)
    value = value.tolist() if isinstance(value, (np.generic, np.ndarray)) else value
    kind = type(value)
    if kind in _SAME_IN_JSON or isinstance(value, (str, list, tuple, dict)):
        return value
    if kind.__name__ in ("NAType", "NaTType"):
        return None
    is_complex = isinstance(value, numbers.Complex) and not isinstance(value, numbers.Real)
    if isinstance(value, numbers.Number) and not is_complex:
        value = int(value) if isinstance(value, numbers.Integral) else float(value)
        if math.isinf(value):
            raise InputError(f"attribute {name!r} of feature {number} is infinite")
        return None if math.isnan(value) else value
    has_text = kind.__str__ is not object.__str__ or kind.__repr__ is not object.__repr__
    if is_complex or isinstance(value, bytes) or not has_text:
        raise InputError(f"attribute {name!r} of feature {number} is a {kind.__name__}, neither a number nor a date nor a text")
    return str(value)


def _named_crs(crs):
    if isinstance(crs, (int, np.integer)) and not isinstance(crs, bool):
        authority = ["EPSG", str(crs)]
    elif isinstance(crs, str):
        authority = crs.split(":")
    else:
        authority = crs.to_authority() if hasattr(crs, "to_authority") else None
    if not authority or len(authority) != 2:
        raise InputError("the CRS of the shapes has no code such as EPSG:32633, and GeoJSON can name no other: "
                         "give them in a CRS that has one, with to_crs()")
    return {"type": "name", "properties": {"name": f"urn:ogc:def:crs:{authority[0]}::{authority[1]}"}}


def _plain(value):
    """Shapes as GeoJSON, numbers and arrays of numpy as Python's, dates and other attributes as text."""
    if hasattr(value, "__geo_interface__"):
        return value.__geo_interface__
    return value.tolist() if isinstance(value, (np.generic, np.ndarray)) else str(value)
