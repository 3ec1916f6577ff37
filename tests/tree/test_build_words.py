"""What a build says where something is missing: the library with its Debian package, or what is about to be installed.

labels: slow tree"""

import os
import pathlib
import shutil
import stat
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["SOURCE_DIR"])


class Folder(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="festoon-words-")
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    def program(self, name, *lines):
        path = self.folder / name
        path.write_text("\n".join(["#!/bin/sh", *lines]) + "\n", encoding="utf-8")
        path.chmod(path.stat().st_mode | stat.S_IXUSR)
        return path


@unittest.skipUnless(shutil.which("cmake") and shutil.which("pkg-config"), "cmake or pkg-config is missing")
class Libraries(Folder):
    """A pkg-config that does not know a library stands for a machine without it."""

    def configure(self, lacks, *options):
        fake = self.program("lacking", f'case "$*" in *{lacks}*) exit 1;; esac', f'exec {shutil.which("pkg-config")} "$@"')
        tree = self.folder / "tree"
        shutil.rmtree(tree, ignore_errors=True)
        done = subprocess.run(["cmake", "-S", SOURCE, "-B", tree, f"-DPKG_CONFIG_EXECUTABLE={fake}", "-DFESTOON_PYTHON=OFF",
                               *options], capture_output=True, text=True, check=False)
        return done.returncode, " ".join((done.stdout + done.stderr).split())

    def test_required(self):
        for module, name, package in (("yaml-0.1", "libyaml", "libyaml-dev"), ("jansson", "jansson", "libjansson-dev"),
                                      ("sqlite3", "SQLite", "libsqlite3-dev")):
            status, said = self.configure(module)
            self.assertNotEqual(status, 0)
            self.assertIn(f"festoon's tools need {name}", said)
            self.assertIn(f"it is missing. On Debian: apt-get install {package}", said)

    def test_optional(self):
        status, said = self.configure("ompi-c", "-DFESTOON_MPI=ON")
        self.assertNotEqual(status, 0)
        self.assertIn("FESTOON_MPI is ON, but Open MPI is missing. On Debian: apt-get install libopenmpi-dev.", said)
        status, said = self.configure("ompi-c")
        self.assertEqual(status, 0, said)
        self.assertIn("Open MPI not found (libopenmpi-dev): festoon sweep will run as one process only", said)

    def test_left_out(self):
        every = [f"-DFESTOON_{name}=OFF" for name in ("LAPACK", "HDF5", "CAIRO", "MPI", "CMINPACK", "EXPAT")]
        status, said = self.configure("nothing", *every)
        self.assertEqual(status, 0, said)
        self.assertNotIn("not found (lib", said)
        rules = [path for path in (self.folder / "tree").rglob("*") if path.is_dir() and "_module.dir" in path.name]
        self.assertEqual(rules, [])


@unittest.skipUnless(os.path.exists("/etc/debian_version"), "no Debian system")
class Packages(Folder):
    def test_they_are_named_before_they_are_installed(self):
        """In one line, whoever installs them; without the right to, the command to type has the same names."""
        log = self.folder / "log"
        self.program("dpkg-query", "exit 1")
        self.program("apt-get", f'echo "apt-get $*" >>{log}', 'echo "apt-get $*"')
        for user, sudo in (("0", "exit 1"), ("1000", 'shift; exec "$@"'), ("1000", "exit 1")):
            self.program("id", f"echo {user}")
            self.program("sudo", sudo)
            where = {**os.environ, "PATH": f"{self.folder}:{os.environ['PATH']}"}
            log.unlink(missing_ok=True)
            done = subprocess.run([SOURCE / "tools" / "install-packages.sh", "format"], env=where, capture_output=True,
                                  text=True, check=False)
            if (user, sudo) == ("1000", "exit 1"):
                self.assertEqual(done.returncode, 1)
                self.assertIn("install them and try again", done.stderr.lower())
                self.assertFalse(log.exists())
            else:
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(done.stdout.splitlines()[0], "Installing the missing Debian packages: clang-format")
                self.assertIn("install -y -q --no-install-recommends clang-format", log.read_text(encoding="utf-8"))


if __name__ == "__main__":
    unittest.main()
