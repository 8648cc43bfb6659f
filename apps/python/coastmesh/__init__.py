"""Triangle meshes for ocean and lake models from coastlines and lakes.

>>> import coastmesh
>>> mesh = coastmesh.mesh("lake.geojson", min_angle=35, size_max=500)
>>> mesh.points.shape, mesh.triangles.shape
>>> mesh.write("lake.nc")
"""
import contextlib
import difflib
import json
import os
import warnings as _warnings

import numpy as np

from . import _coastmesh

__all__ = ["Error", "InputError", "OptionError", "OutputError", "CoastmeshWarning", "Mesh", "mesh", "options", "read"]
__version__ = _coastmesh.version


class Error(Exception):
    """Whatever coastmesh raises, but for KeyboardInterrupt and MemoryError."""


class OptionError(Error, ValueError):
    """An option's value is outside its range, or of the wrong kind."""


class InputError(Error, ValueError):
    """The input cannot be read or meshed.

    Attributes:
        refusals: a dict for each part that could not be meshed, with "source", "fids" (numbers of the features),
            "reason", and "place": (x, y) in the input's CRS, or None.
    """

    def __init__(self, message, refusals=()):
        super().__init__(message)
        self.refusals = list(refusals)


class OutputError(Error, OSError):
    """A file cannot be written; none was left in part."""


class CoastmeshWarning(UserWarning):
    """An option without effect, or something about the input that was mended, left out or cannot be had."""


@contextlib.contextmanager
def _own_errors():
    try:
        yield
    except _coastmesh.UsageError as error:
        raise OptionError(str(error).replace("--mark-pieces", "mark_pieces=True")) from None
    except _coastmesh.InputError as error:
        raise InputError(str(error)) from None
    except _coastmesh.OutputError as error:
        raise OutputError(str(error).replace("--overwrite", "overwrite=True")) from None


class Mesh:
    """A triangle mesh. Arrays are views of the mesh's own memory: free to make, not to be written to."""

    def __init__(self, made):
        self._made = made
        self._parsed_report = None

    @property
    def points(self):
        """float64 array (n, 2): x or longitude, y or latitude, in the CRS of the input."""
        return self._made.points

    @property
    def triangles(self):
        """uint32 array (m, 3): indices of points, counter-clockwise."""
        return self._made.triangles

    @property
    def z(self):
        """float64 array (n,): metres, positive up, NaN where unknown; None where there is no depth."""
        return self._made.z

    @property
    def min_angle(self):
        """float64 array (m,): the smallest angle of each triangle on the ground, degrees; None where not known."""
        return self._made.min_angle

    @property
    def area(self):
        """float64 array (m,): square metres on the ellipsoid; None where not known."""
        return self._made.area

    @property
    def feature(self):
        """uint32 array (m,): for each triangle the index in `features` that it lies in; None where not known."""
        return self._made.feature

    @property
    def features(self):
        """The features that were meshed: dicts with "fid", "source", "attributes"."""
        return self._made.features

    @property
    def boundaries(self):
        """Chains of points on the boundary, the mesh to their left: dicts with "role" ("land", "island", "open", "river"),
        "closed" (the first point is not repeated) and "nodes" (uint32 array of indices of points)."""
        return self._made.boundaries

    @property
    def crs(self):
        """"EPSG:4326" or the like, else WKT, or "" for a plane without a place on Earth."""
        return self._made.crs

    @property
    def complete(self):
        """Whether all that was asked was reached: angles wherever the input allows them, budget, every feature."""
        return self._made._complete

    @property
    def report(self):
        """The report as a dict, its keys as in `coastmesh mesh --report`; None for a mesh that was read."""
        if self._parsed_report is None and self._made._report:
            self._parsed_report = json.loads(self._made._report)
        return self._parsed_report

    def write(self, path, format=None, overwrite=False):
        """Writes the mesh in the format that the ending of `path`, or `format`, names. What the file cannot hold, and
        numbers that models would misread, are a CoastmeshWarning. Raises OutputError."""
        with _own_errors():
            warnings = self._made._write(os.fsencode(path), format or "", overwrite)
        for warning in warnings:
            _warnings.warn(warning, CoastmeshWarning, stacklevel=2)

    def plot(self, path, color="angle", size=1600, edges=True, overwrite=False):
        """Draws the mesh as .png or .svg, `size` pixels on its longer side, or as a page for a browser, .html, as large
        as its window; `color` as in `coastmesh plot --color`."""
        if isinstance(size, (bool, np.bool_)) or not isinstance(size, (int, np.integer)) or abs(size) >= 2**63:
            raise OptionError(f"size: {size!r} is not a number of pixels")
        with _own_errors():
            note = self._made._plot(os.fsencode(path), color, int(size), edges, overwrite)
        if note:
            _warnings.warn(note, CoastmeshWarning, stacklevel=2)

    def __repr__(self):
        return f"<coastmesh.Mesh: {len(self.points)} points, {len(self.triangles)} triangles>"


def options():
    """The options of `mesh`: name as a keyword, and what `coastmesh mesh --json-usage` says of it."""
    return {_keyword(option["name"]): option for option in json.loads(_coastmesh.usage())["options"]}


def _keyword(name):
    return name.lstrip("-").replace("-", "_")


def mesh(source, segments=None, holes=None, *, progress=None, **keywords):
    """Meshes polygons, closed lines or a plane graph; returns a Mesh.

    Args:
        source: what to mesh, one of
            - the path of a vector file that GDAL reads or of a .poly, or a list of paths,
            - GeoJSON as a dict or a str, or whatever has a __geo_interface__ (shapely, geopandas), or a list or array of
              such,
            - points in a plane as an array (n, 2), with `segments` and `holes`; also as a tuple of two or three
              arrays, or as a dict with "vertices", "segments" and perhaps "holes".
        segments: array (m, 2) of indices into the points; none: the convex hull is meshed.
        holes: array (k, 2) of points, each of which empties the face that it lies in.
        progress: called as progress(phase, share) with a str and a number from 0 to 1, in this thread. What it raises
            ends the run and is raised here.
        **keywords: the options listed below. Lengths are metres on the ground, or the plane's units.

    Raises:
        OptionError, InputError, KeyboardInterrupt (on Ctrl-C; nothing is left), TypeError for an unknown option.

    Where angles cannot be reached, the best mesh is returned: `complete` is False and `report["refine"]["unresolved"]`
    has the places. Features that cannot be meshed are left out with a CoastmeshWarning.
    """
    files, text, graph = _split(source, segments, holes)
    if progress is not None and not callable(progress):
        raise TypeError("progress is not callable")
    _require_known(keywords)
    with _own_errors():
        made = _coastmesh.run(keywords, [*map(os.fsencode, files)], text, graph, progress)
    for warning in made._warnings:
        _warnings.warn(warning, CoastmeshWarning, stacklevel=2)
    refusals = made._refusals
    if len(made.triangles) == 0:
        reasons = refusals[0]["reason"] if len(refusals) == 1 else f"none of the {len(refusals)} parts can be meshed"
        raise InputError(reasons, refusals)
    return Mesh(made)


def read(path):
    """Reads a mesh from a file in any format that coastmesh reads; returns a Mesh. Raises InputError."""
    with _own_errors():
        return Mesh(_coastmesh.read(os.fsencode(path)))


def _split(source, segments, holes):
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


def _require_known(keywords):
    """Refuses what is no option, now or by its former name."""
    known = options()
    former = {_keyword(name) for option in known.values() for name in list(option.get("former_names", {}))[:1]}
    for name in keywords:
        if name not in known and name not in former:
            near = difflib.get_close_matches(name, known, 1)
            raise TypeError(f"mesh() has no option '{name}'" + (f"; did you mean '{near[0]}'?" if near else ""))


def _describe(option):
    label, said = option["label"], option["help"]
    said = label + said[len(label):] if said.lower().startswith(label.lower()) else f"{label}: {said}"
    unit = option.get("unit")
    default = option.get("default")
    bounds = [f"from {option['minimum']:g}" if "minimum" in option else "",
              f"above {option['exclusive_minimum']:g}" if "exclusive_minimum" in option else "",
              f"to {option['maximum']:g}" if "maximum" in option else ""]
    facts = [unit or "", *bounds, f"default {default}" if default is not None else ""]
    if "choices" in option:
        facts.insert(0, " | ".join(option["choices"]))
    facts = ", ".join(fact for fact in facts if fact)
    return f"{said} ({facts})" if facts else said


def _options_text():
    text, section = "", None
    for name, option in options().items():
        if option["section"] != section:
            section = option["section"]
            text += f"\n    {section}:\n"
        text += f"        {name}: {_describe(option)}\n"
    return text


if mesh.__doc__:  # python -OO drops docstrings
    mesh.__doc__ += _options_text()
