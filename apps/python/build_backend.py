"""Makes the wheel of the module with CMake and Python's own library (PEP 517), so that no package index is needed.

    pip wheel . --no-deps [--config-settings=build-dir=build/release]

`build-dir` is a build that is there already, or build/wheel, which is then configured. The wheel links libraries of the
system; it says which (Requires-External), and is refused where one is not in LINKED, or where it would look for them in a
folder of the machine that built it.
"""
import base64
import hashlib
import io
import os
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import time
import tomllib
import zipfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
# Libraries that the module may link, without versions: those of the project, and those of every C++ program.
LINKED = {"libgdal", "libGeographicLib", "libnetcdf", "libscotch", "libscotcherr", "libgmp", "libtbb", "libcairo",
          "libstdc++", "libm", "libgcc_s", "libc", "libpthread", "libdl", "ld-linux-x86-64", "ld-linux-aarch64"}


class BuildError(RuntimeError):
    """No wheel can be made, and why."""


def project():
    return tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]


def version():
    return re.search(r"^project\(coastmesh VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"), re.M)[1]


def run(*command, **how):
    # In an isolated build pip hides the interpreter's own modules from the processes it starts; numpy is one of them.
    environment = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "PYTHONHOME")}
    return subprocess.run([str(word) for word in command], cwd=ROOT, env=environment, check=True, **how).stdout


def built(build):
    """The folder of the module in `build`, brought up to date."""
    if not shutil.which("cmake"):
        raise BuildError("there is no cmake: scripts/install-packages --tests installs what the module is built with")
    if not (build / "CMakeCache.txt").exists():
        generator = ["-G", "Ninja"] if shutil.which("ninja") else []
        launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
        run("cmake", "-S", ROOT, "-B", build, *generator, *launcher, "-DCMAKE_BUILD_TYPE=Release", "-DCOASTMESH_TESTS=OFF",
            f"-DPython3_EXECUTABLE={sys.executable}")
    targets = run("cmake", "--build", build, "--target", "help", stdout=subprocess.PIPE, text=True)
    if "coastmesh_python_stubs" not in targets:
        raise BuildError(f"{build} was configured without the module: that needs pybind11, and numpy in {sys.executable}")
    run("cmake", "--build", build, "--target", "coastmesh_python_stubs", "-j", os.cpu_count() or 1)
    folder = build / "python/coastmesh"
    if not (folder / ("_coastmesh" + sysconfig.get_config_var("EXT_SUFFIX"))).exists():
        raise BuildError(f"{build} is for another Python than {sys.executable}")
    return folder


def audit(library):
    """The libraries that a compiled module links; BuildError where one is not among LINKED, or is looked for elsewhere."""
    listed = subprocess.run(["readelf", "--dynamic", "--wide", str(library)], capture_output=True, text=True, check=True).stdout
    needed = re.findall(r"\(NEEDED\)\s+Shared library: \[(.*)\]", listed)
    strange = [name for name in needed if re.sub(r"(-[0-9]+\.[0-9]+)?\.so.*$", "", name) not in LINKED]
    if strange:
        raise BuildError(f"{library} links {', '.join(strange)}: no wheel may (apps/python/build_backend.py)")
    folders = re.findall(r"\((?:RPATH|RUNPATH)\).*\[(.*)\]", listed)
    if folders:
        raise BuildError(f"{library} looks for libraries in {', '.join(folders)}, a folder of this machine")
    return needed


def metadata(linked):
    said = project()
    lines = ["Metadata-Version: 2.1", f"Name: {said['name']}", f"Version: {version()}", f"Summary: {said['description']}",
             f"License: {said['license']['text']}", f"Requires-Python: {said['requires-python']}",
             *(f"Requires-Dist: {name}" for name in said["dependencies"]),
             *(f"Requires-External: {name}" for name in linked), "Description-Content-Type: text/markdown", ""]
    return "\n".join(lines) + "\n" + (ROOT / said["readme"]).read_text(encoding="utf-8")


def tag():
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{re.sub('[-.]', '_', sysconfig.get_platform())}"


def epoch():
    # A zip archive cannot hold times before 1980.
    return max(int(os.environ.get("SOURCE_DATE_EPOCH", "0")), 315619200)


def write_wheel(path, files):
    """The same files make the same archive."""
    name = f"coastmesh-{version()}.dist-info/RECORD"
    record = ""
    for file, content in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        record += f"{file},sha256={digest},{len(content)}\n"
    files = {**files, name: (record + f"{name},,\n").encode()}
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for file, content in files.items():
            entry = zipfile.ZipInfo(file, time.gmtime(epoch())[:6])
            entry.external_attr = (0o100755 if ".so" in file else 0o100644) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, content)


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    build = ROOT / (config_settings or {}).get("build-dir", "build/wheel")
    folder = built(build)
    compiled = "_coastmesh" + sysconfig.get_config_var("EXT_SUFFIX")
    linked = audit(folder / compiled)
    print("links", *linked)
    names = ["__init__.py", "__init__.pyi", "_errors.py", "_sources.py", "_usage.py", compiled, "py.typed"]
    files = {f"coastmesh/{name}": (folder / name).read_bytes() for name in names}
    info = f"coastmesh-{version()}.dist-info"
    files[f"{info}/LICENSE"] = (ROOT / "LICENSE").read_bytes()
    files[f"{info}/METADATA"] = metadata(linked).encode()
    files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: coastmesh {version()}\nRoot-Is-Purelib: false\nTag: {tag()}\n".encode()
    name = f"coastmesh-{version()}-{tag()}.whl"
    write_wheel(pathlib.Path(wheel_directory) / name, files)
    return name


def build_sdist(sdist_directory, config_settings=None):
    base = f"coastmesh-{version()}"
    listed = subprocess.run([ROOT / "scripts/list-files"], capture_output=True, text=True, check=True).stdout.splitlines()
    with tarfile.open(pathlib.Path(sdist_directory) / f"{base}.tar.gz", "w:gz", format=tarfile.PAX_FORMAT) as archive:
        for file in listed:
            archive.add(ROOT / file, f"{base}/{file}", recursive=False)
        said = metadata([]).encode()
        entry = tarfile.TarInfo(f"{base}/PKG-INFO")
        entry.size, entry.mtime = len(said), epoch()
        archive.addfile(entry, io.BytesIO(said))
    return f"{base}.tar.gz"
