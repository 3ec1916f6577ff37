"""pip installs the module from the repository, from a wheel and from a source distribution, without a network."""

import os
import pathlib
import shutil
import subprocess
import sys
import tarfile
import zipfile

import pytest

SOURCE = pathlib.Path(os.environ.get("SOURCE_DIR", pathlib.Path(__file__).resolve().parents[2]))
SAY = "import festoon as fs; print(fs.Bead().run(periods=20).mean_r.hex(), fs.__file__, fs.components)"
PIP = ("-m", "pip", "--disable-pip-version-check", "--no-cache-dir")
#: Without optimisation it compiles in a fifth of the time and computes the same bits.
SOON = ("--config-settings", "cmake=-DCMAKE_BUILD_TYPE=Debug")


def quiet(*words, **keywords):
    made = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False, **keywords)
    assert made.returncode == 0, made.stdout
    return made.stdout


@pytest.fixture()
def venv(tmp_path):
    quiet("/usr/bin/python3", "-m", "venv", "--system-site-packages", str(tmp_path / "venv"))
    return tmp_path / "venv/bin/python"


def expect(python, folder, tmp_path):
    """The installed module computes the bits of the one beside the tests, with every component that it has."""
    import festoon

    run = festoon.Bead().run(periods=20)
    number, path, components = quiet(str(python), "-c", SAY, cwd=tmp_path).strip().split(" ", 2)
    assert number == run.mean_r.hex() and components == festoon.components
    assert str(folder) in path


def test_source_distribution_editable_and_wheel(venv, tmp_path):
    """A source distribution, which pip reads, holds all that the build needs.  One build of it serves both: an
    edited module is at work at once; and the wheel needs neither it nor a compiler."""
    code = f"import sys; sys.path.insert(0, 'python'); import build_backend as b; print(b.build_sdist({str(tmp_path)!r}))"
    sources = tmp_path / quiet(str(venv), "-B", "-c", code, cwd=SOURCE).strip()
    quiet(str(venv), *PIP, "install", "--dry-run", "--no-index", "--no-deps", str(sources))
    with tarfile.open(sources) as content:
        assert f"{sources.name[:-7]}/PKG-INFO" in content.getnames()
        content.extractall(tmp_path)
    repository = tmp_path / sources.name[:-7]
    sources.unlink()

    quiet(str(venv), *PIP, "install", *SOON, "--no-index", "-e", str(repository))
    expect(venv, repository, tmp_path)
    module = repository / "python/festoon/__init__.py"
    text = module.read_text(encoding="utf-8")
    module.write_text(text + "\nEDITED = True\n", encoding="utf-8")
    assert quiet(str(venv), "-c", "import festoon; print(festoon.EDITED)", cwd=tmp_path) == "True\n"
    module.write_text(text, encoding="utf-8")
    quiet(str(venv), *PIP, "uninstall", "-y", "festoon")

    quiet(str(venv), *PIP, "wheel", *SOON, "--no-index", "--no-deps", "-w", str(tmp_path), str(repository))
    shutil.rmtree(repository)
    wheel = next(tmp_path.glob("festoon-*-abi3-*.whl"))
    with zipfile.ZipFile(wheel) as content:
        names = content.namelist()
    assert "festoon/py.typed" in names and "festoon/_tables.py" in names and "festoon/_festoon.abi3.so" in names
    quiet(str(venv), *PIP, "install", "--no-index", str(wheel))
    expect(venv, tmp_path / "venv", tmp_path)
    quiet(str(venv), *PIP, "uninstall", "-y", "festoon")
    left = list((tmp_path / "venv").rglob("*festoon*"))
    assert not left


@pytest.mark.skipif(pathlib.Path(os.environ.get("BUILD_DIR", "")) != SOURCE / "build", reason="pip looks for a finished build in build alone")
def test_what_make_has_built_is_not_built_again(venv, tmp_path):
    """Where `make` has built these sources pip only packs them."""
    said = quiet(str(venv), *PIP, "-v", "wheel", "--no-index", "--no-deps", "-w", str(tmp_path), str(SOURCE))
    assert "no work to do" in said or "Building C object" not in said
    quiet(str(venv), *PIP, "install", "--no-index", str(next(tmp_path.glob("festoon-*-abi3-*.whl"))))
    expect(venv, tmp_path / "venv", tmp_path)


def backend(code, **environment):
    """What the backend says, called as pip calls it."""
    return subprocess.run(
        [sys.executable, "-B", "-c", f"import build_backend as b; {code}"],
        cwd=SOURCE / "python", env={**os.environ, **environment}, stderr=subprocess.PIPE, text=True, check=False,
    )


def test_a_missing_package_is_named_in_one_sentence(tmp_path):
    """Without programs on the PATH, and without a library that pkg-config knows."""
    bare = backend("b.prepare_metadata_for_build_wheel('.')", PATH=str(tmp_path))
    assert bare.returncode == 1 and bare.stderr.count("\n") == 1
    assert "type  apt-get install --no-install-recommends cmake gcc pkg-config" in bare.stderr
    lacking = backend("b.prepare_metadata_for_build_wheel('.')", PKG_CONFIG_LIBDIR=str(tmp_path))
    assert lacking.returncode == 1 and "apt-get install" in lacking.stderr and "libyaml-dev" in lacking.stderr


def test_a_venv_that_does_not_see_the_system(tmp_path):
    quiet("/usr/bin/python3", "-m", "venv", "--without-pip", str(tmp_path / "venv"))
    made = subprocess.run(
        [tmp_path / "venv/bin/python", "-B", "-c", "import build_backend as b; b.build_wheel('.')"],
        cwd=SOURCE / "python", stderr=subprocess.PIPE, text=True, check=False,
    )
    assert made.returncode == 1 and "python3-cffi" in made.stderr and "--system-site-packages" in made.stderr
