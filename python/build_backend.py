"""The backend by which pip builds festoon (PEP 517, PEP 660): CMake makes the package, zipfile packs it.

It needs the standard library alone.  What the build needs beside it are Debian packages; where one is missing, a
sentence names it and the line to type.
"""

import base64
import contextlib
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
import tempfile
import tomllib
import zipfile

ROOT = pathlib.Path(__file__).resolve().parent.parent

#: What the build calls, and the Debian package that has it.
PROGRAMS = {"cmake": "cmake", "cc": "gcc", "pkg-config": "pkg-config"}
LIBRARIES = {"yaml-0.1": "libyaml-dev", "jansson": "libjansson-dev", "sqlite3": "libsqlite3-dev"}
MODULES = {"cffi": "python3-cffi", "numpy": "python3-numpy"}

#: Folders and files of the source distribution.
SOURCES = (
    "CMakeLists.txt",
    "CMakePresets.json",
    "LICENSE",
    "README.md",
    "CHANGELOG.md",
    "pyproject.toml",
    "cmake",
    "docs",
    "examples",
    "include",
    "paper",
    "python",
    "src",
    "tools",
)


class CannotBuild(SystemExit):
    """Ends the build with a sentence."""

    def __init__(self, sentence):
        print(f"festoon: {sentence}", file=sys.stderr, flush=True)
        super().__init__(1)


# ---------------------------------------------------------------------------------------- what is missing


def _python_says(code):
    """Whether a line of Python succeeds; -I steps over pip's isolation, so that the system's modules are seen."""
    return subprocess.run([sys.executable, "-I", "-c", code], capture_output=True, check=False).returncode == 0


def _missing():
    lacks = [package for program, package in PROGRAMS.items() if not shutil.which(program)]
    if shutil.which("pkg-config"):
        for library, package in LIBRARIES.items():
            if subprocess.run(["pkg-config", "--exists", library], check=False).returncode:
                lacks.append(package)
    if not os.path.exists(os.path.join(sysconfig.get_path("include"), "Python.h")):
        lacks.append("python3-dev")
    lacks += [package for module, package in MODULES.items() if not _python_says(f"import {module}")]
    return lacks


def _check():
    if sys.version_info < (3, 11):
        raise CannotBuild("it needs Python 3.11 or later")
    lacks = _missing()
    if not lacks:
        return
    line = f"apt-get install --no-install-recommends {' '.join(lacks)}"
    outside = [package for package in lacks if package in (*MODULES.values(), "python3-dev")]
    hint = ""
    if outside and sys.base_prefix != "/usr":
        hint = f" (this is {sys.base_prefix}'s python; Debian's packages serve /usr/bin/python3)"
    elif outside and os.path.isdir("/usr/lib/python3/dist-packages/numpy"):
        hint = " (a virtual environment sees them if it is made with --system-site-packages)"
    raise CannotBuild(f"the build lacks {', '.join(lacks)}: type  {line}{hint}")


# ---------------------------------------------------------------------------------------- building


def _project():
    with open(ROOT / "pyproject.toml", "rb") as file:
        return tomllib.load(file)["project"]


def _version():
    numbers = {}
    for line in (ROOT / "include/festoon/festoon.h").read_text(encoding="utf-8").splitlines():
        words = line.split()
        if len(words) == 3 and words[0] == "#define" and words[1].startswith("FST_VERSION_"):
            numbers[words[1]] = words[2]
    return ".".join(numbers[f"FST_VERSION_{part}"] for part in ("MAJOR", "MINOR", "PATCH"))


def _is_finished(folder):
    """Whether `make` has built the package of these sources there, with its own settings.  The module is of Python's
    stable interface, so that it serves every Python that gets this far."""
    try:
        cache = dict(re.findall(r"^(\w+):\w+=(.*)$", (folder / "CMakeCache.txt").read_text(encoding="utf-8"), re.M))
    except OSError:
        return False
    wanted = {"CMAKE_HOME_DIRECTORY": str(ROOT), "CMAKE_BUILD_TYPE": "Release", "FESTOON_SANITIZE": "", "CMAKE_C_FLAGS": ""}
    module = folder / "python/festoon/_festoon.abi3.so"
    return all(cache.get(key, "") == value for key, value in wanted.items()) and os.access(module, os.W_OK)


@contextlib.contextmanager
def _build_folder(settings):
    """Where the package is built: what `make` has left in build; else build-python among the sources, so that building
    again is quick; a folder that goes again where the sources cannot be written to."""
    if not settings and _is_finished(ROOT / "build"):
        yield ROOT / "build"
    elif os.access(ROOT, os.W_OK):
        yield ROOT / "build-python"
    else:
        with tempfile.TemporaryDirectory(prefix="festoon-build-") as folder:
            yield pathlib.Path(folder)


def _cmake(folder, settings):
    """Configure and build the package in `folder`; returns the package's folder."""
    _check()
    options = ["-DCMAKE_BUILD_TYPE=Release", "-DFESTOON_PYTHON=ON", f"-DFESTOON_PYTHON_PROGRAM={sys.executable}"]
    given = (settings or {}).get("cmake", [])
    options += [given] if isinstance(given, str) else given
    if shutil.which("ninja") and not (folder / "CMakeCache.txt").exists():
        options += ["-G", "Ninja"]
    configure = ["cmake", "-S", str(ROOT), "-B", str(folder), "--log-level=WARNING", *options]
    build = ["cmake", "--build", str(folder), "--target", "festoon_python_package", "-j", str(os.cpu_count() or 1)]
    for command in [build] if folder == ROOT / "build" else [configure, build]:
        if subprocess.run(command, stdout=sys.stderr, check=False).returncode:
            raise CannotBuild(f"{' '.join(command[:2])} failed: its words are above")
    return folder / "python" / "festoon"


def _libraries(folder):
    """The shared libraries of the build, under the names by which they are loaded."""
    for path in sorted(folder.glob("*.so*")):
        name = path.name
        if name.startswith("libfestoon"):
            numbers = name.split(".so.")[-1] if ".so." in name else ""
            if numbers.count(".") == 1:  # the name that the linker noted
                yield name, path
        else:
            yield name, path


def _metadata():
    project = _project()
    lines = [
        "Metadata-Version: 2.1",
        f"Name: {project['name']}",
        f"Version: {_version()}",
        f"Summary: {project['description']}",
        "License: MIT",
        f"Requires-Python: {project['requires-python']}",
    ]
    lines += [f"Requires-Dist: {package}" for package in project["dependencies"]]
    for extra, packages in project["optional-dependencies"].items():
        lines.append(f"Provides-Extra: {extra}")
        lines += [f"Requires-Dist: {package}; extra == '{extra}'" for package in packages]
    lines.append("Description-Content-Type: text/markdown")
    text = (ROOT / project["readme"]).read_text(encoding="utf-8")
    return "\n".join(lines) + "\n\n" + text


def _tag():
    platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    return f"cp311-abi3-{platform}"


def _dist_info():
    return f"festoon-{_version()}.dist-info"


class _Wheel:
    """A wheel that is written file by file, with its record."""

    def __init__(self, directory):
        self.name = f"festoon-{_version()}-{_tag()}.whl"
        self._path = pathlib.Path(directory) / self.name
        self._zip = zipfile.ZipFile(self._path, "w", zipfile.ZIP_DEFLATED)
        self._record = []

    def add(self, name, data, mode=0o644):
        info = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
        info.compress_type = zipfile.ZIP_DEFLATED
        info.external_attr = (0o100000 | mode) << 16
        self._zip.writestr(info, data)
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        self._record.append(f"{name},sha256={digest},{len(data)}")

    def close(self):
        info = _dist_info()
        self.add(f"{info}/METADATA", _metadata().encode())
        wheel = f"Wheel-Version: 1.0\nGenerator: festoon\nRoot-Is-Purelib: false\nTag: {_tag()}\n"
        self.add(f"{info}/WHEEL", wheel.encode())
        self.add(f"{info}/LICENSE", (ROOT / "LICENSE").read_bytes())
        record = "\n".join([*self._record, f"{info}/RECORD,,"]) + "\n"
        self._zip.writestr(f"{info}/RECORD", record)
        self._zip.close()


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    with _build_folder(config_settings) as build:
        package = _cmake(build, config_settings)
        wheel = _Wheel(wheel_directory)
        for path in sorted(package.iterdir()):
            if path.is_file():
                wheel.add(f"festoon/{path.name}", path.read_bytes(), 0o755 if path.suffix == ".so" else 0o644)
        for name, path in _libraries(build):
            wheel.add(f"festoon/{name}", path.read_bytes(), 0o755)
        wheel.add("festoon/festoon-paper", (build / "festoon-paper").read_bytes(), 0o755)
        page = ROOT / "build" / "festoon-lab.html"  # where `make lab` has made it
        if page.exists():
            wheel.add("festoon/festoon-lab.html", page.read_bytes())
        wheel.close()
    return wheel.name


def build_editable(wheel_directory, config_settings=None, metadata_directory=None):
    """A wheel that points at build-python/python, whose modules are links to the sources."""
    package = _cmake(ROOT / "build-python", config_settings)
    wheel = _Wheel(wheel_directory)
    wheel.add("festoon.pth", f"{package.parent}\n".encode())
    wheel.close()
    return wheel.name


def _prepare(directory):
    info = pathlib.Path(directory) / _dist_info()
    info.mkdir(parents=True)
    (info / "METADATA").write_text(_metadata(), encoding="utf-8")
    return info.name


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    _check()
    return _prepare(metadata_directory)


def prepare_metadata_for_build_editable(metadata_directory, config_settings=None):
    _check()
    return _prepare(metadata_directory)


def _source_files():
    for name in SOURCES:
        top = ROOT / name
        if top.is_file():
            yield top
        elif top.is_dir():
            for path in sorted(top.rglob("*")):
                if path.is_file() and "__pycache__" not in path.parts:
                    yield path


def build_sdist(sdist_directory, config_settings=None):
    base = f"festoon-{_version()}"
    with tarfile.open(pathlib.Path(sdist_directory) / f"{base}.tar.gz", "w:gz", format=tarfile.PAX_FORMAT) as tar:
        for path in _source_files():
            tar.add(path, f"{base}/{path.relative_to(ROOT)}", recursive=False)
        data = _metadata().encode()
        info = tarfile.TarInfo(f"{base}/PKG-INFO")
        info.size = len(data)
        tar.addfile(info, io.BytesIO(data))
    return f"{base}.tar.gz"
