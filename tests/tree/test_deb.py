"""The Debian packages of `make deb`: lintian has no complaint, and installed into a scratch root they can be used.

Status 77 where Debian's tools for packages are missing.

labels: long slow"""

import importlib.util
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["SOURCE_DIR"])
NAMES = ("festoon", "libfestoon-dev", "libfestoon0", "python3-festoon")


def run(*words, **options):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False, **options)
    assert done.returncode == 0, f"{words}: status {done.returncode}\n{done.stdout}{done.stderr}"
    return done.stdout


class Packages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory(prefix="festoon-deb-")
        cls.addClassCleanup(holder.cleanup)
        cls.out = pathlib.Path(holder.name)
        # A proxy that nobody serves: the build asks nothing of a network.  Not optimised, it takes a third of the time.
        nowhere = {"DEB_BUILD_OPTIONS": "noopt", "http_proxy": "http://127.0.0.1:9", "https_proxy": "http://127.0.0.1:9"}
        cls.told = run(SOURCE / "tools" / "make-deb", cls.out, env={**os.environ, **nowhere})
        cls.page = SOURCE / "build" / "festoon-lab.html"
        cls.packages = {path.name.split("_")[0]: path for path in cls.out.glob("*.deb")}
        cls.root = cls.out / "root"
        for path in cls.packages.values():
            run("dpkg-deb", "-x", path, cls.root)
        cls.program = cls.root / "usr/bin/festoon"

    def field(self, name, field):
        return run("dpkg-deb", "-f", self.packages[name], field).strip()

    def test_the_four(self):
        self.assertEqual(sorted(self.packages), sorted(NAMES))
        self.assertEqual(sorted(line.split("/")[-1].split("_")[0] for line in self.told.splitlines()), sorted(NAMES))
        version = run(self.program, "--version").split()[1]
        for name in NAMES:
            self.assertEqual(self.field(name, "Version"), version)
        self.assertIn(f"libfestoon0 (= {version})", self.field("festoon", "Depends"))
        self.assertIn(f"libfestoon0 (= {version})", self.field("libfestoon-dev", "Depends"))
        self.assertIn(f"libfestoon0 (= {version})", self.field("python3-festoon", "Depends"))
        for package in ("python3-numpy", "python3-cffi-backend", "python3:any"):
            self.assertIn(package, self.field("python3-festoon", "Depends"))
        self.assertIn("python3-matplotlib", self.field("python3-festoon", "Recommends"))
        self.assertIn("libhdf5", self.field("libfestoon0", "Depends"))
        self.assertNotIn("openmpi", self.field("libfestoon0", "Depends"))
        self.assertIn("openmpi", self.field("libfestoon0", "Recommends"))

    @unittest.skipUnless(shutil.which("lintian"), "lintian is not installed")
    def test_lintian(self):
        changes = next(self.out.glob("*.changes"))
        done = subprocess.run(["lintian", "--tag-display-limit", "0", changes], capture_output=True, text=True, check=False)
        self.assertEqual((done.stdout, done.returncode), ("", 0), done.stderr)

    def test_the_program(self):
        """It runs, finds its module for HDF5, and its page, its completion and its examples are in Debian's places."""
        scene = self.root / "usr/share/doc/festoon/examples/paper-19.9Hz.yaml"
        trajectory = self.out / "bead.h5"
        told = run(self.program, "run", scene, "--set", "run.periods=3", "--json", "-o", trajectory)
        self.assertEqual(json.loads(told)["dynamics"], "farago2020")
        self.assertGreater(trajectory.stat().st_size, 1000)
        self.assertIn("reproduced", run(self.program, "paper", "--statements"))
        for place in ("share/man/man1/festoon.1.gz", "share/bash-completion/completions/festoon",
                      "share/zsh/vendor-completions/_festoon", "share/fish/vendor_completions.d/festoon.fish",
                      "share/doc/festoon/tutorial.md", "share/doc/festoon/copyright"):
            self.assertTrue((self.root / "usr" / place).exists(), place)

    def test_the_page(self):
        """The package holds the page of the lab where it was built; else festoon lab says how it is had."""
        page = self.root / "usr/share/festoon/festoon-lab.html"
        self.assertEqual(page.exists(), self.page.exists())
        if page.exists():
            self.assertEqual(page.read_bytes(), self.page.read_bytes())
            return
        done = subprocess.run([self.program, "lab", "--print"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertIn("make lab builds it, and make install or make deb after that installs it", done.stderr)

    @unittest.skipUnless(shutil.which("cc") and shutil.which("pkg-config"), "there is no compiler")
    def test_the_libraries(self):
        """An example is built by pkg-config, by the line that stands in it, and runs on the packaged library."""
        library = next(self.root.glob("usr/lib/*/libfestoon.so")).parent
        example = self.root / "usr/share/doc/libfestoon-dev/examples/c/run.c"
        line = re.search(r"^ \*     (cc .* -o \w+)$", example.read_text(encoding="utf-8"), re.M).group(1)
        shutil.copy(example, self.out)
        run("sh", "-c", line, cwd=self.out, env={**os.environ, "PKG_CONFIG_PATH": str(library / "pkgconfig")})
        run("./" + line.split()[-1], cwd=self.out, env={**os.environ, "LD_LIBRARY_PATH": str(library)})

    @unittest.skipUnless(importlib.util.find_spec("numpy") and importlib.util.find_spec("_cffi_backend"), "numpy is missing")
    def test_the_module(self):
        """The packaged module finds the packaged library, and says what the packaged program says."""
        library = next(self.root.glob("usr/lib/*/libfestoon.so")).parent
        modules = self.root / "usr/lib/python3/dist-packages"
        where = {**os.environ, "PYTHONPATH": str(modules), "LD_LIBRARY_PATH": str(library)}
        lines = "import festoon, json; print(json.dumps(festoon.Bead(run__periods=3).run().to_dict()))"
        ours = json.loads(run(sys.executable, "-B", "-c", lines, env=where))
        self.assertEqual(ours, json.loads(run(self.program, "run", "--set", "run.periods=3", "--json")))
        self.assertTrue(list((self.root / "usr/share/doc/python3-festoon/examples").rglob("plot_1_five_lines.py*")))
        self.assertTrue((modules / "festoon/py.typed").exists())

    @unittest.skipUnless(os.geteuid() == 0, "dpkg installs as root only")
    def test_dpkg_installs_and_removes(self):
        """dpkg takes them into a root of their own, without their dependencies, and leaves nothing when it removes them.

        Without the Python module's: its scripts compile modules of the machine's own root.
        """
        root = self.out / "dpkg"
        for folder in ("updates", "info"):
            (root / "var/lib/dpkg" / folder).mkdir(parents=True)
        (root / "var/lib/dpkg/status").touch()
        dpkg = ["dpkg", f"--root={root}", "--force-depends", "--force-script-chrootless", "--no-triggers", f"--log={root}/log"]
        names = [name for name in NAMES if not name.startswith("python3-")]
        run(*dpkg, "-i", *[self.packages[name] for name in names])
        self.assertTrue(run(root / "usr/bin/festoon", "--version").startswith("festoon "))
        run(*dpkg, "--purge", *names)
        left = [path for path in root.rglob("*festoon*") if "var/lib/dpkg" not in path.as_posix()]
        self.assertEqual(left, [])


if __name__ == "__main__":
    for tool in ("dpkg-buildpackage", "dh", "dpkg-shlibdeps"):
        if not shutil.which(tool):
            print(f"skipped: {tool} is missing (make deb installs it)")
            sys.exit(77)
    unittest.main()
