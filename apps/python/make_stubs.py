#!/usr/bin/python3
"""Writes the type stubs of the module, with every option of its functions: make_stubs.py OUT.pyi (PYTHONPATH finds coastmesh)."""
import sys

del sys.path[0]  # has the sources, without the compiled half
import coastmesh  # noqa: E402

HEAD = '''from os import PathLike
from typing import Any, Callable, Optional, Sequence, Union

from numpy import float64, int64, uint32
from numpy.typing import ArrayLike, NDArray

__version__: str

class Error(Exception): ...
class OptionError(Error, ValueError): ...

class InputError(Error, ValueError):
    refusals: list[dict[str, Any]]

class OutputError(Error, OSError): ...
class CoastmeshWarning(UserWarning): ...

class Mesh:
    @classmethod
    def from_arrays(
        cls, points: ArrayLike, triangles: ArrayLike, z: Optional[ArrayLike] = None, crs: Any = None
    ) -> Mesh: ...
    def with_z(self, z: Optional[ArrayLike]) -> Mesh: ...
    @property
    def points(self) -> NDArray[float64]: ...
    @property
    def triangles(self) -> NDArray[uint32]: ...
    @property
    def quadrilaterals(self) -> NDArray[uint32]: ...
    @property
    def z(self) -> Optional[NDArray[float64]]: ...
    @property
    def attributes(self) -> dict[str, NDArray[float64]]: ...
    @property
    def min_angle(self) -> Optional[NDArray[float64]]: ...
    @property
    def area(self) -> Optional[NDArray[float64]]: ...
    @property
    def feature(self) -> Optional[NDArray[uint32]]: ...
    @property
    def features(self) -> list[dict[str, Any]]: ...
    @property
    def boundaries(self) -> list[dict[str, Any]]: ...
    @property
    def crs(self) -> str: ...
    @property
    def node_source(self) -> Optional[NDArray[int64]]: ...
    @property
    def triangle_source(self) -> Optional[NDArray[int64]]: ...
    @property
    def node_mesh(self) -> Optional[NDArray[int64]]: ...
    @property
    def triangle_mesh(self) -> Optional[NDArray[int64]]: ...
    @property
    def complete(self) -> bool: ...
    @property
    def summary(self) -> Optional[str]: ...
    @property
    def report(self) -> Optional[dict[str, Any]]: ...
    def write(self, path: Union[str, PathLike[str]], format: Optional[str] = None, overwrite: bool = False) -> None: ...
    def plot(
        self,
        path: Union[str, PathLike[str]],
        color: str = "angle",
        size: int = 1600,
        edges: bool = True,
        overwrite: bool = False,
    ) -> None: ...

def options(function: str = "mesh") -> dict[str, dict[str, Any]]: ...
def read(path: Union[str, PathLike[str]], assume_crs: Any = None) -> Mesh: ...
'''
PATH = "Union[str, PathLike[str]]"
MESH = "Union[Mesh, str, PathLike[str]]"
# The arguments of each function besides its options.
ARGUMENTS = {
    "mesh": ["source: Any", "segments: Optional[ArrayLike] = None", "holes: Optional[ArrayLike] = None"],
    "cut": [f"mesh: {MESH}"],
    "remesh": [f"mesh: {MESH}"],
    "merge": [f"mesh: {MESH}", f"inserted: Union[{MESH}, Sequence[{MESH}]]"],
    "rivers": [f"mesh: {MESH}", "lines: Any"],
}
PROGRESS = "progress: Optional[Callable[[str, float], object]] = None"


def type_of(option):
    if option.get("role") == "vector":
        return "Any"  # paths and shapes
    kind = {"number": "float", "integer": "int", "flag": "bool", "file": PATH}.get(option["type"], "Any")
    if option["type"] == "choice":
        kind = "str"
    return f"Union[{kind}, Sequence[{kind}]]" if option.get("multiple") and kind != "Any" else kind


def main():
    with open(sys.argv[1], "w", encoding="utf-8") as file:
        file.write(HEAD)
        for function, arguments in ARGUMENTS.items():
            options = [f"{name}: Optional[{type_of(option)}] = None"
                       for name, option in coastmesh.options(function).items()]
            file.write(f"def {function}(\n")
            file.writelines(f"    {line},\n" for line in [*arguments, "*", PROGRESS, *options])
            file.write(") -> Mesh: ...\n")


if __name__ == "__main__":
    main()
