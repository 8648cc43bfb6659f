"""The plugin: nothing but its Processing provider, so that qgis_process needs no window."""
from qgis.core import QgsApplication

from .provider import CoastmeshProvider


class CoastmeshPlugin:
    def __init__(self, iface):
        self.provider = None

    def initProcessing(self):
        """Called by qgis_process in place of initGui()."""
        self.provider = CoastmeshProvider()
        QgsApplication.processingRegistry().addProvider(self.provider)

    def initGui(self):
        self.initProcessing()

    def unload(self):
        if self.provider is not None:
            QgsApplication.processingRegistry().removeProvider(self.provider)
            self.provider = None
