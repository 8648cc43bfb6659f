"""What functions of coastmesh are given to work on: files, GeoJSON, whatever has a __geo_interface__, arrays."""
import json
import os

import numpy as np

from ._errors import InputError


def split(source, segments, holes):
    """What to mesh as (files, GeoJSON text or None, plane graph or None)."""
    if segments is not None or holes is not None:
        return [], None, (source, segments, holes)
    if isinstance(source, str):
        return ([], _geojson_text(_geojson_of(source)), None) if _is_geojson(source) else ([source], None, None)
    if isinstance(source, os.PathLike):
        return [os.fspath(source)], None, None
    if isinstance(source, dict):
        if "vertices" in source:
            return [], None, (source["vertices"], source.get("segments"), source.get("holes"))
        return [], _geojson_text(source), None
    if hasattr(source, "__geo_interface__"):
        return [], _geojson_text(_geojson_of(source), getattr(source, "crs", None)), None
    if isinstance(source, np.ndarray) and source.dtype == object and source.ndim == 1:
        source = source.tolist()  # as shapely's functions return shapes
    if isinstance(source, (list, tuple)):
        if not source:
            raise InputError("there is nothing to mesh")
        if any(_is_geojson(part) for part in source):
            return [], _list_text(source), None
        if all(isinstance(part, (str, os.PathLike)) for part in source):
            return [os.fspath(part) for part in source], None, None
        if isinstance(source, tuple) and len(source) in (2, 3) and np.ndim(source[0]) == 2:
            return [], None, (*source, None)[:3]
        return [], None, (source, None, None)
    if isinstance(source, np.ndarray):
        return [], None, (source, None, None)
    raise TypeError(f"cannot mesh a {type(source).__name__}: give a path, GeoJSON, or points and segments")


def split_polygons(keywords):
    """Options as keywords without shapes, and the GeoJSON texts of those that are polygons, by keyword."""
    texts = {}
    for name in ("within", "outside"):
        shapes, others = _split_shapes(keywords.get(name))
        if shapes is not None:
            texts[name] = [shapes]
            keywords = {**keywords, name: others}
    return keywords, texts


def split_lines(lines):
    """The lines of `rivers` as a list of paths and one of GeoJSON texts."""
    shapes, others = _split_shapes(lines)
    if shapes is not None and others is None:
        others = []
    elif not isinstance(others, (list, tuple)):
        others = [others]
    for part in others:
        if not isinstance(part, (str, os.PathLike)):
            raise TypeError(f"rivers() cannot read lines from a {type(part).__name__}: give a path, or GeoJSON")
    if shapes is None and not others:
        raise InputError("there is no line of a river")
    return [os.fsencode(part) for part in others], [] if shapes is None else [shapes]


def _split_shapes(given):
    """The shapes of what may be paths, shapes or a list of both as one GeoJSON text, and what else is there; each None if
    there is none."""
    if isinstance(given, np.ndarray) and given.dtype == object:
        given = given.tolist()
    if _is_geojson(given):
        return _geojson_text(_geojson_of(given), getattr(given, "crs", None)), None
    if isinstance(given, (list, tuple)) and any(_is_geojson(part) for part in given):
        shapes = _list_text([part for part in given if _is_geojson(part)])
        return shapes, [part for part in given if not _is_geojson(part)]
    return None, given


def _is_geojson(part):
    return isinstance(part, dict) or hasattr(part, "__geo_interface__") or (
        isinstance(part, str) and part.lstrip().startswith("{"))


def _geojson_of(part):
    """GeoJSON as a dict, of anything that _is_geojson."""
    if isinstance(part, dict):
        return part
    if not isinstance(part, str):
        if not isinstance(part.__geo_interface__, dict):
            raise TypeError(f"the __geo_interface__ of a {type(part).__name__} is no dict")
        return part.__geo_interface__
    try:
        return json.loads(part)
    except json.JSONDecodeError as error:
        raise InputError(f"GeoJSON: {error}") from None


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
            features.extend(geojson["features"])
        else:
            features.append(geojson if geojson.get("type") == "Feature" else _feature(geojson))
    return _geojson_text({"type": "FeatureCollection", "features": features}, crs)


def _feature(geometry):
    return {"type": "Feature", "properties": {}, "geometry": geometry}


def _geojson_text(geojson, crs=None):
    """GeoJSON as text. `crs`: of pyproj, the name of one, or the "crs" of GeoJSON; None leaves what `geojson` says."""
    crs = geojson.get("crs") if crs is None else crs
    if geojson.get("type") not in ("Feature", "FeatureCollection"):
        geojson = _feature(geojson)
    if crs is not None:
        geojson = {**geojson, "crs": crs if isinstance(crs, dict) and "type" in crs else _named_crs(crs)}
    try:
        return json.dumps(geojson, default=_plain)
    except (TypeError, ValueError) as error:
        raise InputError(f"GeoJSON: {error}") from None


def _named_crs(crs):
    if isinstance(crs, str):
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
