#!/usr/bin/python3
"""The provider in a real QGIS window on a virtual screen: the dialog, a run from it, the mesh on the map. Keeps pictures
of both. 77: no QGIS or no Xvfb here.

usage: window_test.py PROGRAM PLUGIN.zip DATA PICTURES
"""
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import zipfile

# Run by QGIS's own Python, once its window is open.
INSIDE = '''
import json, os, traceback
from qgis.core import Qgis, QgsApplication, QgsMeshLayer, QgsProject, QgsRectangle, QgsVectorLayer
from qgis.PyQt.QtCore import QTimer
from qgis.PyQt.QtWidgets import QWidget
from qgis.utils import iface

told = {"layers": []}
pictures = os.environ["COASTMESH_PICTURES"]


def finish():
    with open(os.path.join(pictures, "told.json"), "w") as file:
        json.dump(told, file)
    QgsProject.instance().clear()
    os._exit(0)


def guarded(step):
    def run(*arguments):
        try:
            step(*arguments)
        except Exception:
            told["error"] = traceback.format_exc()
            finish()
    return run


@guarded
def begin():
    global dialog, lake
    import processing
    lake = QgsVectorLayer(os.environ["COASTMESH_LAKE"], "Lake Superior", "ogr")
    QgsProject.instance().addMapLayer(lake)
    window = iface.mainWindow()
    window.resize(1280, 800)
    told["provider"] = QgsApplication.processingRegistry().providerById("coastmesh") is not None
    parameters = {"INPUT": lake.id(), "MIN_ANGLE": 34, "SIZE_MAX": 12000}
    dialog = processing.createAlgorithmDialog("coastmesh:mesh", parameters)
    dialog.resize(980, 720)
    dialog.show()
    QTimer.singleShot(1500, picture_of_dialog)


@guarded
def picture_of_dialog():
    dialog.grab().save(os.path.join(pictures, "qgis_dialog.png"))
    dialog.algorithmFinished.connect(ran)
    dialog.runButton().click()


@guarded
def ran(successful, results):
    told["successful"] = successful
    told["log"] = dialog.findChild(QWidget, "txtLog").toPlainText()
    QTimer.singleShot(3000, show_map)


@guarded
def show_map():
    dialog.close()
    told["layers"] = [[l.name(), isinstance(l, QgsMeshLayer), l.isValid()] for l in QgsProject.instance().mapLayers().values()]
    root = QgsProject.instance().layerTreeRoot()
    root.findLayer(lake.id()).setItemVisibilityChecked(False)
    for layer in QgsProject.instance().mapLayersByName("Triangles"):
        root.findLayer(layer.id()).setItemVisibilityChecked(False)
    iface.mapCanvas().setExtent(QgsRectangle(-91.6, 46.3, -88.9, 48.0))
    iface.mapCanvas().refresh()
    QTimer.singleShot(4000, picture_of_window)


@guarded
def picture_of_window():
    iface.mainWindow().grab().save(os.path.join(pictures, "qgis_mesh.png"))
    finish()


QTimer.singleShot(3000, begin)
QTimer.singleShot(100000, finish)
'''


def main():
    program, archive, data, pictures = (os.path.abspath(path) for path in sys.argv[1:5])
    qgis = shutil.which("qgis.bin") or shutil.which("qgis")
    if not qgis or not shutil.which("Xvfb"):
        print("skipped: there is no QGIS, or no Xvfb")
        return 77
    os.makedirs(pictures, exist_ok=True)
    home = tempfile.mkdtemp()
    read, write = os.pipe()
    # Xvfb chooses a free display and prints its number.
    screen = subprocess.Popen(
        ["Xvfb", "-displayfd", str(write), "-screen", "0", "1400x900x24", "-nolisten", "tcp"],
        pass_fds=[write], stderr=subprocess.DEVNULL,
    )
    try:
        os.close(write)
        display = os.read(read, 20).decode().strip()
        profile = os.path.join(home, "profiles", "default")
        with zipfile.ZipFile(archive) as plugin:
            plugin.extractall(os.path.join(profile, "python", "plugins"))
        os.makedirs(os.path.join(profile, "QGIS"))
        with open(os.path.join(profile, "QGIS", "QGIS3.ini"), "w", encoding="utf-8") as file:
            file.write("[PythonPlugins]\ncoastmesh_qgis=true\nprocessing=true\n[qgis]\ncheckVersion=false\n"
                       "showTips=false\nnewsFeed/httpsfeedqgisorg/disabled=true\n")
        inside = os.path.join(home, "inside.py")
        with open(inside, "w", encoding="utf-8") as file:
            file.write(INSIDE)
        environment = {
            **os.environ, "DISPLAY": f":{display}", "HOME": home, "XDG_RUNTIME_DIR": home, "QT_QPA_PLATFORM": "xcb",
            "LANG": "C.UTF-8", "COASTMESH_PROGRAM": program, "COASTMESH_PICTURES": pictures,
            "COASTMESH_LAKE": os.path.join(data, "lake_superior.geojson"),
        }
        command = [qgis, "--noversioncheck", "--nologo", "--nocustomization", "--profiles-path", home, "--code", inside]
        run = subprocess.Popen(command, env=environment, start_new_session=True)
        try:
            run.wait(timeout=150)
        except subprocess.TimeoutExpired:
            os.killpg(run.pid, signal.SIGKILL)
            run.wait()
            print("QGIS did not come to an end")
            return 1
        with open(os.path.join(pictures, "told.json"), encoding="utf-8") as file:
            told = json.load(file)
    finally:
        screen.terminate()
        screen.wait()
        shutil.rmtree(home, ignore_errors=True)
    print(json.dumps(told, indent=1))
    loaded = {name: (is_mesh, valid) for name, is_mesh, valid in told["layers"]}
    sound = (
        "error" not in told and told["provider"] and told.get("successful")
        and loaded.get("Mesh") == (True, True) and loaded.get("Triangles") == (False, True)
        and loaded.get("Boundaries") == (False, True) and "vertices" in told["log"]
    )
    for name in ("qgis_dialog.png", "qgis_mesh.png"):
        sound = sound and os.path.getsize(os.path.join(pictures, name)) > 10000
    return 0 if sound else 1


if __name__ == "__main__":
    sys.exit(main())
