"""Triangle meshes for ocean and lake models from coastlines and lakes.

>>> import coastmesh
>>> mesh = coastmesh.mesh("lake.geojson", min_angle=35, size_max=500)
>>> mesh.points.shape, mesh.triangles.shape
>>> mesh.write("lake.nc")
"""
import json
import os
import warnings as _warnings

import numpy as np

from . import _coastmesh
from ._errors import CoastmeshWarning, Error, InputError, OptionError, OutputError, own_errors as _own_errors
from ._sources import lines_of as _lines_of, split as _split, with_paths as _with_paths
from ._usage import (options, options_text as _options_text, require_known as _require_known,
                     vector_options as _vector_options)

__all__ = ["Error", "InputError", "OptionError", "OutputError", "CoastmeshWarning", "Mesh", "cut", "merge", "mesh", "options",
           "read", "remesh", "rivers"]
__version__ = _coastmesh.version


class Mesh:
    """A triangle mesh. Arrays are views of the mesh's own memory: free to make, not to be written to."""

    def __init__(self, made):
        self._made = made
        self._parsed_report = None

    @classmethod
    def from_arrays(cls, points, triangles, z=None, crs=None):
        """A mesh of arrays, for `cut`, `remesh`, `merge`, `rivers`, `write` and `plot`.

        Args:
            points: array (n, 2): x or longitude, y or latitude.
            triangles: array (m, 3): indices of points, counter-clockwise.
            z: array (n,): metres, positive up, NaN where unknown.
            crs: of the points, such as "EPSG:4326" or a pyproj CRS; otherwise they lie in a plane.

        Its boundaries are the loops around it: "land" and "island". Triangles stay as they are; a CoastmeshWarning says how
        many are not counter-clockwise. Raises InputError, OptionError.
        """
        with _own_errors():
            made = _coastmesh.from_arrays(points, triangles, z, crs)
        return _warned(made)

    def with_z(self, z):
        """The same mesh, with its report, and with other depths: array (n,) as `z` of `from_arrays`, None for none. A Mesh
        itself does not change, as arrays may be views of it. Raises InputError."""
        with _own_errors():
            return Mesh(_coastmesh.with_z(self._made, z))

    @property
    def points(self):
        """float64 array (n, 2): x or longitude, y or latitude, in the CRS of the input."""
        return self._made.points

    @property
    def triangles(self):
        """uint32 array (m, 3): indices of points, counter-clockwise."""
        return self._made.triangles

    @property
    def quadrilaterals(self):
        """uint32 array (q, 4): the points around each quadrilateral, of `rivers` or of a mesh that was read; both halves of
        it are among the triangles."""
        return self._made.quadrilaterals

    @property
    def z(self):
        """float64 array (n,): metres, positive up, NaN where unknown; None where there is no depth."""
        return self._made.z

    @property
    def attributes(self):
        """dict of float64 arrays (n,) by name: values of models at the points, such as mannings_n_at_sea_floor; NaN where
        unknown. Attributes with several values for a point have a number behind each name."""
        return self._made.attributes

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
    def node_source(self):
        """int64 array (n,): the index of each point in the mesh that was changed by `cut`, `remesh` or `rivers`, or in that of
        `node_mesh`; -1 for new ones. None for other meshes, and after repairs for a target, which change points and triangles."""
        return self._made.node_source

    @property
    def triangle_source(self):
        """int64 array (m,): the same for triangles."""
        return self._made.triangle_source

    @property
    def node_mesh(self):
        """int64 array (n,): of those that `merge` put together, the mesh that each point comes from: 0 the first, 1 the first
        inserted one; -1 for new ones. None as for `node_source`."""
        return self._made.node_mesh

    @property
    def triangle_mesh(self):
        """int64 array (m,): the same for triangles."""
        return self._made.triangle_mesh

    @property
    def complete(self):
        """Whether all that was asked was reached: angles wherever the input allows them, budget, every feature, repairs."""
        return self._made._complete

    @property
    def summary(self):
        """What `cut`, `remesh`, `merge` or `rivers` did, as lines of text; None for other meshes."""
        return self._made.summary or None

    @property
    def report(self):
        """The report as a dict, its keys as in `coastmesh mesh --report`; "coastmesh", "warnings" and "repairs" for a mesh that
        was changed; None for one that was read."""
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
        **keywords: the options listed below. Lengths are metres on the ground, or the plane's units. "FILE or shapes": the path
            of a vector file, or shapes as in `source`, with their attributes, or for options that can be repeated a list of
            both. GeoJSON is in longitude and latitude unless it, or the `crs` of the object, says otherwise.

    Raises:
        OptionError, InputError, KeyboardInterrupt (on Ctrl-C; nothing is left), TypeError for an unknown option.

    Where angles cannot be reached, the best mesh is returned: `complete` is False and `report["refine"]["unresolved"]`
    has the places. Features that cannot be meshed are left out with a CoastmeshWarning.
    """
    memory = _coastmesh.MemoryFiles()
    paths, graph = _split(source, segments, holes, memory)
    keywords = _checked("mesh", progress, keywords, memory)
    with _own_errors():
        made = _coastmesh.run(keywords, memory, [*map(os.fsencode, paths)], graph, progress)
    meshed = _warned(made)
    refusals = made._refusals
    if len(made.triangles) == 0:
        reasons = refusals[0]["reason"] if len(refusals) == 1 else f"none of the {len(refusals)} parts can be meshed"
        raise InputError(reasons, refusals)
    return meshed


def cut(mesh, *, progress=None, **keywords):
    """Cuts a part out of a mesh, with its boundaries; returns a new Mesh.

    Args:
        mesh: a Mesh, or the path of one.
        progress: as for `mesh`; the phases are "read", "cut" and "finish".
        **keywords: the options listed below, files and shapes as for `mesh`; bbox, within or outside says which part.

    Raises:
        OptionError, InputError, KeyboardInterrupt (on Ctrl-C), TypeError for an unknown option.

    `node_source` and `triangle_source` of the result are indices in the given mesh.
    """
    return _edited("cut", mesh, progress, keywords, _coastmesh.MemoryFiles())


def remesh(mesh, *, progress=None, **keywords):
    """Meshes a part of a mesh anew, with other sizes; all else stays bit for bit. Returns a new Mesh.

    Args:
        mesh: a Mesh, or the path of one.
        progress: as for `mesh`; the phases are "read", "remesh" and "finish".
        **keywords: the options listed below; bbox, within or outside says which part, as for `cut`, and size, size_shore or
            another size how large the new triangles should be. Lengths are metres on the ground, or the plane's units.

    Raises:
        OptionError, InputError, KeyboardInterrupt (on Ctrl-C), TypeError for an unknown option.

    `node_source` and `triangle_source` of the result are indices in the given mesh, -1 for new ones.
    """
    return _edited("remesh", mesh, progress, keywords, _coastmesh.MemoryFiles())


def merge(mesh, inserted, *, progress=None, **keywords):
    """Puts meshes into another one, in place of the triangles that they cover, with a graded transition; returns a new Mesh.

    Args:
        mesh: the Mesh to put the others into, or its path.
        inserted: a Mesh or a path, or a list of such: they are put in in this order. Each joins the mesh along its open
            boundaries, or all around if it has none.
        progress: as for `mesh`; the phases are "read", "merge" and "finish".
        **keywords: the options listed below.

    Raises:
        OptionError, InputError, KeyboardInterrupt (on Ctrl-C), TypeError for an unknown option.

    `node_mesh` and `triangle_mesh` of the result say which mesh each comes from: 0 is `mesh`, 1 the first inserted one, -1 none:
    it is new. `node_source` and `triangle_source` are indices there.
    """
    if isinstance(inserted, (list, tuple)):
        named = [(_given("merge", one), f"inserted[{i}]") for i, one in enumerate(inserted)]
    else:
        named = [(_given("merge", inserted), "inserted")]
    if not named:
        raise InputError("there is no mesh to put in")
    return _edited("merge", mesh, progress, keywords, _coastmesh.MemoryFiles(), named)


def rivers(mesh, lines, *, progress=None, **keywords):
    """Adds rivers to a mesh: rows of quadrilaterals along centre lines, joined with it; returns a new Mesh.

    Args:
        mesh: the Mesh to add rivers to, or its path.
        lines: centre lines, paths or shapes as for options of `mesh`. Widths are attributes, or `width`. Lines that meet, or
            end in one another, are joined.
        progress: as for `mesh`; the phases are "read", "rivers" and "finish".
        **keywords: the options listed below. Lengths are metres on the ground, or the plane's units.

    Raises:
        OptionError, InputError, KeyboardInterrupt (on Ctrl-C), TypeError for an unknown option.

    Rivers, or parts of them, that cannot be added are a CoastmeshWarning; InputError if none can. `quadrilaterals` of the result
    has the rows. `node_source` and `triangle_source` are indices in the given mesh, -1 for new ones.
    """
    memory = _coastmesh.MemoryFiles()
    paths = [*map(os.fsencode, _lines_of(lines, memory))]
    return _edited("rivers", mesh, progress, keywords, memory, paths)


def read(path, assume_crs=None):
    """Reads a mesh from a file in any format that coastmesh reads; returns a Mesh. Raises InputError.

    Args:
        assume_crs: the CRS of the mesh if its file has none, such as "EPSG:4326"; otherwise it lies in a plane.

    What is odd in the file is a CoastmeshWarning.
    """
    with _own_errors():
        made = _coastmesh.read(os.fsencode(path), assume_crs)
    return _warned(made)


def _edited(function, mesh, progress, keywords, memory, *more):
    """What `function`, one of those that change a mesh, makes of `mesh`. `memory` has files that `more` names."""
    keywords = _checked(function, progress, keywords, memory)
    given = _given(function, mesh)
    with _own_errors():
        made = getattr(_coastmesh, function)(keywords, memory, given, progress, *more)
    return _warned(made, 4)


def _checked(function, progress, keywords, memory):
    """The keywords of a function, with paths of files in `memory` in place of shapes."""
    if progress is not None and not callable(progress):
        raise TypeError("progress is not callable")
    _require_known(function, keywords)
    return _with_paths(keywords, _vector_options(function), memory)


def _given(function, mesh):
    """A Mesh or a path, for the compiled half."""
    if isinstance(mesh, Mesh):
        return mesh._made
    if isinstance(mesh, (str, os.PathLike)):
        return os.fsencode(mesh)
    raise TypeError(f"{function}() cannot change a {type(mesh).__name__}: give a Mesh or the path of one")


def _warned(made, stacklevel=3):
    for warning in made._warnings:
        _warnings.warn(warning, CoastmeshWarning, stacklevel=stacklevel)
    return Mesh(made)


for _function in (mesh, cut, remesh, merge, rivers):
    if _function.__doc__:  # python -OO drops docstrings
        _function.__doc__ += _options_text(_function.__name__)
