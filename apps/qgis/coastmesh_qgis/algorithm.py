"""One algorithm for every verb: parameters from the verb's usage, a run of the program, results as layers."""
import json
import os

from qgis.core import (
    QgsCoordinateReferenceSystem,
    QgsProcessing,
    QgsProcessingAlgorithm,
    QgsProcessingContext,
    QgsProcessingException,
    QgsProcessingOutputNumber,
    QgsProcessingOutputVectorLayer,
    QgsProcessingParameterBoolean,
    QgsProcessingParameterFeatureSource,
    QgsProcessingParameterFileDestination,
    QgsProcessingParameterMapLayer,
    QgsProcessingParameterMultipleLayers,
    QgsProcessingParameterVectorDestination,
    QgsProcessingUtils,
)

from .parameters import arguments_of, by_present_names, crs_text, help_of, how_to_give_several, make_parameter
from .program import ProgramError, find_program
from .running import SHORT, run_program
from .sources import Sources, takes_selection
from .styles import style_for
from .verbs import NEVER_SHOWN, VERBS

NOTES_SHOWN = 20  # as many as the program prints
MESH_ENDINGS = (".nc", ".2dm")  # formats that QGIS opens as a mesh layer
LAYER_FILE = "GeoPackage (*.gpkg)"

# Layers inside the GeoPackages that verbs write, top one first: output, layer, title.
MESH_LAYERS = [("BOUNDARIES", "boundaries", "Boundaries"), ("TRIANGLES", "triangles", "Triangles"),
               ("NODES", "nodes", "Nodes")]
LAYERS = {
    "mesh": MESH_LAYERS,
    "convert": MESH_LAYERS,
    "cut": MESH_LAYERS,
    "remesh": MESH_LAYERS,
    "merge": MESH_LAYERS,
    "rivers": MESH_LAYERS,
    "clean": [("EDITS", "edits", "Edits"), ("PSLG", "pslg", "Plane graph")],
}
SHOWN_LAYERS = ("BOUNDARIES", "TRIANGLES", "EDITS", "PSLG")  # nodes are too many to show
FIGURES = {"TRIANGLE_COUNT": "triangles", "VERTEX_COUNT": "vertices", "MIN_ANGLE_REACHED": "min_angle_deg"}


class CoastmeshAlgorithm(QgsProcessingAlgorithm):
    def __init__(self, command, formats):
        super().__init__()
        self.command = command
        self.formats = formats
        self.verb = VERBS[command["command"]]
        hidden = NEVER_SHOWN + self.verb.hidden
        self.shown_options = [o for o in command["options"] if o["name"] not in hidden]

    # What it is ---------------------------------------------------------------------------------------------------
    def createInstance(self):
        return CoastmeshAlgorithm(self.command, self.formats)

    def name(self):
        return self.command["command"]

    def displayName(self):
        return self.verb.title

    def tags(self):
        return ["coastmesh", "mesh", *self.verb.tags]

    def icon(self):
        return self.provider().icon() if self.provider() else super().icon()

    def shortDescription(self):
        return self.command["help"]

    def shortHelpString(self):
        lines = [f"<p>{_html(self.command['help'])}.</p>"]
        if self.name() == "mesh":
            lines.append("<p>Takes polygons, or lines that close. The mesh comes as a mesh layer (.nc, .2dm) and as vector "
                         "layers, coloured by the smallest angle of each triangle. Lengths are metres on the ground, "
                         "whatever the layer's CRS.</p>")
        section = None
        for option in self.shown_options:
            if option["section"] != section:
                section = option["section"]
                lines.append(f"<h3>{_html(section)}</h3>")
            label, said = option["label"], help_of(option)
            rest = said[len(label):] if said.lower().startswith(label.lower()) else ": " + said
            lines.append(f"<p><b>{_html(label)}</b>{_html(rest)}</p>")
        return "".join(lines)

    def flags(self):
        return super().flags() | QgsProcessingAlgorithm.FlagCanCancel

    # Parameters ---------------------------------------------------------------------------------------------------
    def initAlgorithm(self, configuration=None):
        if self.verb.reads_mesh:
            kinds = [QgsProcessing.TypeMesh, QgsProcessing.TypeVectorPolygon]
            mesh = QgsProcessingParameterMapLayer("INPUT", "Mesh: a layer, or any mesh file", None, False, kinds)
            mesh.setHelp("a mesh layer, a layer of triangles, or the path of a file in any format that coastmesh reads")
            self.addParameter(mesh)
            if self.name() == "merge":
                inserted = QgsProcessingParameterMultipleLayers("INSERTED", "Meshes to put in", QgsProcessing.TypeMesh)
                inserted.setHelp("in this order, in place of the triangles that they cover; each joins the mesh along "
                                 "its open boundaries, or all around if it has none")
                self.addParameter(inserted)
            if self.name() == "rivers":
                lines = QgsProcessingParameterMultipleLayers("LINES", "Centre lines of rivers",
                                                             QgsProcessing.TypeVectorLine)
                lines.setHelp("with their widths; lines that meet, or end in one another, are joined")
                self.addParameter(lines)
        else:
            kinds = [QgsProcessing.TypeVectorPolygon, QgsProcessing.TypeVectorLine]
            self.addParameter(QgsProcessingParameterFeatureSource("INPUT", "Polygons or closed lines", kinds))
            more = QgsProcessingParameterMultipleLayers(
                "MORE_INPUTS", "More layers of the same place", QgsProcessing.TypeVectorAnyGeometry, None, True
            )
            more.setFlags(more.flags() | more.FlagAdvanced)
            self.addParameter(more)
        for option in self.shown_options:
            if option.get("role") != "output":
                self.addParameter(make_parameter(option))
        getattr(self, "_outputs_of_" + self.name())()
        for option in self.shown_options:
            if option.get("role") == "output":
                self.addParameter(make_parameter(option))

    def _outputs_of_mesh(self):
        self._add_file("OUTPUT", "Mesh", self._filters(first="ugrid"))
        self._add_file("OUTPUT_LAYERS", "Triangles, nodes and boundaries", LAYER_FILE, optional=True)
        self._add_file("OUTPUT_GRID", "Model grid", self._filters(), optional=True, by_default=False)
        self._add_load()
        self._add_layer_outputs()
        for name, key in FIGURES.items():
            self.addOutput(QgsProcessingOutputNumber(name, key.replace("_", " ").capitalize()))

    def _outputs_of_clean(self):
        self._add_file("OUTPUT", "Plane graph and edits", LAYER_FILE + ";;Triangle's plane graph (*.poly)")
        self._add_load()
        self._add_layer_outputs()

    def _outputs_of_check(self):
        self.addParameter(
            QgsProcessingParameterVectorDestination("OUTPUT", "Defects", QgsProcessing.TypeVectorPoint, None, True)
        )
        self.addOutput(QgsProcessingOutputNumber("SOUND", "1 where there is no defect, else 0"))

    def _outputs_of_convert(self):
        self._add_mesh_file("Converted mesh")

    def _outputs_of_cut(self):
        self._add_mesh_file("Part of the mesh")

    def _outputs_of_remesh(self):
        self._add_mesh_file("Mesh with a new part")

    def _outputs_of_merge(self):
        self._add_mesh_file("Merged mesh")

    def _outputs_of_rivers(self):
        self._add_mesh_file("Mesh with rivers")

    def _add_mesh_file(self, title):
        self._add_file("OUTPUT", title, self._filters(first="ugrid"))
        self._add_load()
        self._add_layer_outputs()

    def _add_file(self, name, title, filters, optional=False, by_default=True):
        self.addParameter(QgsProcessingParameterFileDestination(name, title, filters, None, optional, by_default))

    def _add_load(self):
        self.addParameter(QgsProcessingParameterBoolean("LOAD", "Load the results into the project", True))

    def _add_layer_outputs(self):
        for name, _, title in LAYERS[self.name()]:
            self.addOutput(QgsProcessingOutputVectorLayer(name, title))

    def _filters(self, first=None):
        """The formats that the program writes, as a file dialog has them; the first one is the default."""
        formats = [f for f in self.formats if f["writable"] and f["endings"] and not f.get("beside_grid")]
        formats.sort(key=lambda f: f["name"] != first)
        return ";;".join(
            "{} ({})".format(f["description"].replace("(", "").replace(")", ""), " ".join("*" + e for e in f["endings"]))
            for f in formats
        )

    def checkParameterValues(self, parameters, context):
        """As Processing does it, but for meshes that QGIS cannot open as layers: a path will do."""
        if not self._mesh_file(parameters):
            return super().checkParameterValues(parameters, context)
        for parameter in self.parameterDefinitions():
            if parameter.name() == "INPUT":
                continue
            if not parameter.checkValueIsAcceptable(parameters.get(parameter.name()), context):
                return False, f"{parameter.description()}: the value cannot be used"
        return True, ""

    def _mesh_file(self, parameters):
        """The path of a mesh given as such, or None."""
        value = parameters.get("INPUT")
        return value if self.verb.reads_mesh and isinstance(value, str) and os.path.isfile(value) else None

    # The run ------------------------------------------------------------------------------------------------------
    def processAlgorithm(self, parameters, context, feedback):
        try:
            program = find_program()
        except ProgramError as error:
            raise QgsProcessingException(str(error)) from error
        parameters, former_names = by_present_names(self.shown_options, parameters)
        for sentence in former_names:
            feedback.pushWarning(sentence)
        sources = Sources(context, feedback)
        report, made = None, False
        try:
            arguments, crs = self._inputs(parameters, context, sources)
            for option in self.shown_options:
                arguments += arguments_of(option, self, parameters, context, sources.path_of_layer, crs)
            outputs = self._output_paths(parameters, context)
            for path in outputs.values():
                arguments += ["--output", path]
            if outputs:
                arguments.append("--overwrite")
            if self.verb.progress:
                # A quiet run says on standard error what its result misses; with progress as JSON no other does.
                arguments += ["--progress=json", "--quiet"]
            report, made = self._report(arguments)
            if made:
                arguments.append(f"--report={report}")
            try:
                code = run_program(program, [self.name(), *arguments], feedback, sources.in_words)
            except QgsProcessingException as error:
                several = how_to_give_several(self.shown_options, parameters, str(error))
                raise QgsProcessingException(str(error) + several) from error
            if code is None:
                return {}
            said = self._said(report, feedback, sources.in_words) if report else {}
            return self._results(parameters, context, feedback, outputs, code, said)
        finally:
            sources.close()
            if report and made and os.path.exists(report):
                os.remove(report)

    def _inputs(self, parameters, context, sources):
        """The program's arguments for what it reads, and the CRS that it is in."""
        if self.verb.reads_mesh:
            # Extents and points are in the CRS of what the mesh was made from.
            made_from = self.parameterAsLayerList(parameters, "MADE_FROM", context) if self.name() == "check" else []
            added = []  # to the mesh
            if self.name() == "merge":
                added = [sources.path_of_mesh(each)
                         for each in self.parameterAsLayerList(parameters, "INSERTED", context) or []]
            if self.name() == "rivers":
                added = [sources.path_of_layer(each)
                         for each in self.parameterAsLayerList(parameters, "LINES", context) or []]
            path = self._mesh_file(parameters)
            if path:
                return [path, *added], made_from[0].crs() if made_from else QgsCoordinateReferenceSystem()
            layer = self.parameterAsLayer(parameters, "INPUT", context)
            if layer is None:
                raise QgsProcessingException(f"'{parameters.get('INPUT')}' is neither a mesh layer nor a mesh file")
            arguments = [sources.path_of_mesh(layer), *added]
            if layer.crs().isValid():
                arguments.append(f"--assume-crs={crs_text(layer.crs())}")
            return arguments, made_from[0].crs() if made_from else layer.crs()
        source = self.parameterAsSource(parameters, "INPUT", context)
        if source is None:
            raise QgsProcessingException(self.invalidSourceError(parameters, "INPUT"))
        layer = self.parameterAsVectorLayer(parameters, "INPUT", context)
        arguments = [sources.path_of_source(source, layer, takes_selection(parameters, "INPUT"))]
        for more in self.parameterAsLayerList(parameters, "MORE_INPUTS", context) or []:
            arguments.append(sources.path_of_layer(more))
        return arguments, source.sourceCrs()

    def _output_paths(self, parameters, context):
        if self.name() == "check":
            path = self.parameterAsOutputLayer(parameters, "OUTPUT", context)
            return {"OUTPUT": path} if path else {}
        paths = {}
        for name in ("OUTPUT", "OUTPUT_LAYERS", "OUTPUT_GRID"):
            if self.parameterDefinition(name) is not None:
                path = self.parameterAsFileOutput(parameters, name, context)
                if path:
                    paths[name] = path
        return paths

    def _report(self, arguments):
        """Where the report on a mesh goes, and whether it is for us alone."""
        if self.name() != "mesh":
            return None, False
        for word in arguments:
            if word.startswith("--report="):
                return word[len("--report="):], False
        return QgsProcessingUtils.generateTempFilename("report.json"), True

    # Results ------------------------------------------------------------------------------------------------------
    def _results(self, parameters, context, feedback, outputs, code, figures):
        results = {**outputs, **figures}
        if self.name() == "check":
            results["SOUND"] = int(code != SHORT)
        elif code == SHORT:
            feedback.pushWarning("The result misses a requirement; the lines above, and a report, say where.")
        if self.name() == "check":
            path = outputs.get("OUTPUT")
            if path and context.willLoadLayerOnCompletion(path):
                context.layerToLoadOnCompletionDetails(path).setPostProcessor(style_for("OUTPUT", context))
            return results
        written = [outputs.get(name, "") for name in ("OUTPUT_LAYERS", "OUTPUT")]
        package = next((path for path in written if path.lower().endswith(".gpkg")), None)
        for name, layer, _ in LAYERS.get(self.name(), []) if package else []:
            results[name] = f"{package}|layername={layer}"
        if self.parameterAsBoolean(parameters, "LOAD", context):
            self._load(context, feedback, outputs, results)
        return results

    def _said(self, report, feedback, in_words):
        """Tells the user what the report says; returns its figures."""
        with open(report, encoding="utf-8") as file:
            said = json.load(file)
        notes = said["input"]["notes"]
        for note in notes[:NOTES_SHOWN]:
            feedback.pushInfo(in_words(note))
        if len(notes) > NOTES_SHOWN:
            feedback.pushInfo(f"{len(notes) - NOTES_SHOWN} more notes, which a report lists")
        mesh, refine = said["mesh"], said["refine"]
        feedback.pushInfo(f"{mesh['vertices']} vertices, {mesh['triangles']} triangles; angles {mesh['min_angle_deg']:.2f} "
                          f"to {mesh['max_angle_deg']:.2f} degrees; {said['time_s']['total']:.1f} s")
        unresolved = refine["unresolved"]
        if unresolved["count"]:
            feedback.pushWarning(f"{unresolved['count']} triangles are short of the bounds, the first of them at:")
            for place in unresolved["places"][:5]:
                x, y = (place.get("lon", place.get("x")), place.get("lat", place.get("y")))
                feedback.pushWarning(f"  {x:.8g} {y:.8g}: {place['min_angle_deg']:.2f} degrees")
        return {name: mesh[key] for name, key in FIGURES.items()}

    def _load(self, context, feedback, outputs, results):
        """Has QGIS open the results, last one on top."""
        mesh = outputs.get("OUTPUT", "")
        if mesh.lower().endswith(MESH_ENDINGS):
            self._load_layer(context, mesh, "Mesh", "OUTPUT", QgsProcessingUtils.LayerHint.Mesh)
        elif LAYERS.get(self.name()) == MESH_LAYERS and results.get("TRIANGLES", "").split("|")[0] != mesh:
            feedback.pushInfo(f"QGIS opens {' and '.join(MESH_ENDINGS)} as mesh layers; '{mesh}' was only written.")
        for name, _, title in reversed(LAYERS.get(self.name(), [])):
            if name in SHOWN_LAYERS and name in results:
                self._load_layer(context, results[name], title, name, QgsProcessingUtils.LayerHint.Vector)

    def _load_layer(self, context, path, title, output, hint):
        details = QgsProcessingContext.LayerDetails(title, context.project(), output, hint)
        details.setPostProcessor(style_for(output, context))
        context.addLayerToLoadOnCompletion(path, details)


def _html(text):
    return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
