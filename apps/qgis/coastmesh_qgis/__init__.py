"""coastmesh in QGIS Processing: coastlines and lakes to triangle meshes."""


def classFactory(iface):
    from .plugin import CoastmeshPlugin

    return CoastmeshPlugin(iface)
