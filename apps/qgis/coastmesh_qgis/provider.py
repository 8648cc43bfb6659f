"""The provider: one algorithm a verb of the program, made from what the program says of itself."""
import os

from processing.core.ProcessingConfig import ProcessingConfig, Setting
from qgis.core import Qgis, QgsMessageLog, QgsProcessingProvider
from qgis.PyQt.QtGui import QIcon

from .algorithm import CoastmeshAlgorithm
from .program import PROGRAM_SETTING, ProgramError, find_program, read_usage
from .verbs import VERBS


class CoastmeshProvider(QgsProcessingProvider):
    def __init__(self):
        super().__init__()
        self.problem = ""

    def id(self):
        return "coastmesh"

    def name(self):
        return "coastmesh"

    def longName(self):
        return "coastmesh: triangle meshes from coastlines and lakes"

    def icon(self):
        return QIcon(os.path.join(os.path.dirname(__file__), "icon.svg"))

    def warningMessage(self):
        return self.problem

    def supportedOutputVectorLayerExtensions(self):
        return ["gpkg", "geojson", "fgb"]

    def defaultVectorFileExtension(self, hasGeometry=True):
        return "gpkg"

    def supportsNonFileBasedOutput(self):
        return False

    def load(self):
        ProcessingConfig.settingIcons[self.name()] = self.icon()
        ProcessingConfig.addSetting(
            Setting(
                self.name(),
                PROGRAM_SETTING,
                "Program coastmesh (empty: the one on the PATH)",
                "",
                valuetype=Setting.FILE,
            )
        )
        ProcessingConfig.readSettings()
        self.refreshAlgorithms()
        return True

    def unload(self):
        ProcessingConfig.removeSetting(PROGRAM_SETTING)

    def loadAlgorithms(self):
        self.problem = ""
        try:
            usage = read_usage(find_program())
        except ProgramError as error:
            self.problem = str(error)
            QgsMessageLog.logMessage(self.problem, "coastmesh", Qgis.Warning)
            return
        for command in usage["commands"]:
            if command["command"] in VERBS:
                self.addAlgorithm(CoastmeshAlgorithm(command, usage["formats"]))
