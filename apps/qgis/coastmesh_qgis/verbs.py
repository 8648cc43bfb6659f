"""What usage does not say of a verb: what Processing shows first, and which layers lie in its outputs."""
from dataclasses import dataclass, field


@dataclass
class Verb:
    title: str
    reads_mesh: bool = False  # the argument is a mesh; else vector layers
    progress: bool = False  # the program reports its progress
    tags: list = field(default_factory=list)
    # Options that do not become parameters, besides those that no verb shows.
    hidden: tuple = ()


VERBS = {
    "mesh": Verb("Mesh polygons or closed lines", progress=True, hidden=("--format",),
                 tags=["triangulate", "triangulation", "delaunay", "grid", "coast", "lake", "sea", "ugrid", "adcirc"]),
    "clean": Verb("Clean polygons or lines for meshing", tags=["fix", "repair", "pslg", "coast"]),
    "check": Verb("Check a mesh", reads_mesh=True, tags=["validate", "quality", "defects", "grid"]),
    "convert": Verb("Convert a mesh", reads_mesh=True, tags=["export", "grid", "ugrid", "adcirc", "gmsh", "2dm"]),
    "cut": Verb("Cut out a part of a mesh", reads_mesh=True, tags=["clip", "extract", "subset", "grid"]),
    "remesh": Verb("Mesh a part of a mesh anew", reads_mesh=True, tags=["refine", "coarsen", "resolution", "grid"]),
    "merge": Verb("Put meshes into another one", reads_mesh=True, tags=["combine", "join", "insert", "nest", "grid"]),
    "rivers": Verb("Add rivers to a mesh", reads_mesh=True, tags=["channel", "estuary", "quadrilaterals", "grid"]),
}

# Options that the provider sets, and options that QGIS covers itself: layers and filters of features.
NEVER_SHOWN = ("--output", "--overwrite", "--progress", "--quiet", "--assume-crs", "--layer", "--where", "--shard",
               "--skip-existing", "--checkpoint", "--per-feature", "--name-field")

# What most users look for; the others are under "Advanced parameters".
BASIC = (
    "--min-angle", "--domain", "--bbox", "--clip", "--within", "--outside", "--water-at", "--size", "--size-shore", "--size-min", "--size-max", "--grade", "--size-raster",
    "--bathymetry", "--simplify", "--min-island-area", "--input", "--target", "--delaunay", "--pinches",
    "--format", "--width-column", "--width", "--extent", "--elements",
)
