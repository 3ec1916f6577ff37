"""docs/design.md is true: it describes every room, and names only files that are there; tools/rooms has a sentence for
every file.  Each file of the source is named by the head of a test.  All pages of the documentation, and the comments
of the code, name only files, functions, types, tests and faults that exist.  Nothing in the tree was generated, hangs,
or belongs to one machine.

labels: tree"""

import importlib.machinery
import importlib.util
import os
import pathlib
import re
import subprocess
import sys
import unittest

import heads

SOURCE = pathlib.Path(os.environ["SOURCE_DIR"])
PAGE = (SOURCE / "docs" / "design.md").read_text(encoding="utf-8")
ROOMS = ("src", "paper", "include", "tests", "tools", "bench", "examples", "docs")


class Design(unittest.TestCase):
    def files(self, *folders):
        return [path for folder in folders for path in (SOURCE / folder).rglob("*") if path.is_file()]

    def test_every_file_named_is_there(self):
        """NAME, COMMAND, FOLDER and * stand for any name."""
        there = {path.relative_to(SOURCE).as_posix() for path in self.files(*ROOMS)} | {"README.md"}
        named = re.findall(r"`([\w./*]+\.(?:c|h|inl|def|py|md|sh|db))`", PAGE)
        self.assertGreater(len(named), 20)
        for name in named:
            pattern = re.sub(r"NAME|COMMAND|FOLDER|\*", "[a-z0-9_]*", name.replace(".", r"\."))
            if not name.endswith(".db"):
                self.assertTrue(any(re.search(rf"(^|/){pattern}$", path) for path in there), f"{name} is not there")

    def test_rooms_are_described_and_files_say_what_they_are(self):
        """The list of files is made of their first sentences: NAME - what it is."""
        loader = importlib.machinery.SourceFileLoader("rooms", str(SOURCE / "tools" / "rooms"))
        rooms = importlib.util.module_from_spec(importlib.util.spec_from_loader("rooms", loader))
        loader.exec_module(rooms)
        found = list(rooms.rooms())
        self.assertGreater(len(found), 10)
        for _, name, text, files in found:
            self.assertTrue(text, f"docs/design.md has no row for {name} in its table of rooms")
            for path in files:
                self.assertTrue(rooms.first_sentence(path), f'{path} does not open with "{path.name} - what it is."')


class Heads(unittest.TestCase):
    """The comments at the heads of tests: "tests:" and the files of the source, "labels:" and what tests/CMakeLists.txt
    says of them."""

    TESTS = heads.tests(SOURCE)

    def test_every_file_of_the_source_is_named_by_a_test(self):
        files = {path.relative_to(SOURCE / "src").as_posix() for path in (SOURCE / "src").rglob("*")}
        files |= {path.relative_to(SOURCE).as_posix() for path in (SOURCE / "paper").rglob("*")}
        named = {name: path for path in self.TESTS for name in heads.behind("tests", path)}
        for name in named.keys() - files:
            self.fail(f'{named[name]} has behind "tests:" {name}, which is not there')
        unnamed = sorted(name for name in files - named.keys() if name.endswith((".c", ".inl")))
        self.assertEqual(unnamed, [], 'no test names these files behind "tests:" in the comment at its head')

    def test_no_test_stands_behind_the_end(self):
        """unittest.main() ends the program: what stands behind it would never run."""
        for path in self.TESTS:
            behind = path.read_text(encoding="utf-8").partition('if __name__ == "__main__":\n')[2]
            self.assertNotIn("def test", behind, path)

    def test_labels_are_known_and_tests_lie_in_rooms(self):
        known = re.findall(r"^# {3}([a-z-]+)(?:, ([a-z]+))? {2,}", (SOURCE / "tests/CMakeLists.txt").read_text(), re.M)
        known = {word for words in known for word in words} | {"siconos"}
        for path in self.TESTS:
            self.assertEqual(path.parent.parent, SOURCE / "tests", f"{path} does not lie in the folder of a room")
            self.assertLessEqual(set(heads.behind("labels", path)), known, path)


class Tree(unittest.TestCase):
    """What git tracks, or would track; without git, what is there."""

    GENERATED = re.compile(r"\.(o|so|a|pyc|log|gcda|gcno|wasm|deb|whl|tmp|orig|rej|part|db-wal)$|(^|/)(CMakeCache\.txt|"
                           r"CMakeFiles|compile_commands\.json|build\.ninja|__pycache__|node_modules|core)(/|$)")
    OF_A_MACHINE = re.compile(r"(?<![\w.~/)}>*-])/(home|root|work|Users|mnt|media|tmp)/(?!festoon-)[\w.]")

    @classmethod
    def setUpClass(cls):
        command = ["git", "-C", str(SOURCE), "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
        done = subprocess.run(command, capture_output=True, check=False) if (SOURCE / ".git").exists() else None
        if done and done.returncode == 0:
            names = [SOURCE / name for name in done.stdout.decode().split("\0") if name]
        else:
            names = [path for path in SOURCE.rglob("*")
                     if not re.match(r"build|demo-results|dist|\.", path.relative_to(SOURCE).parts[0])
                     and not {"__pycache__", "node_modules"} & set(path.parts)]
        cls.paths = [path for path in names if path.is_symlink() or path.is_file()]

    def test_links_lead_into_the_tree(self):
        for path in self.paths:
            if path.is_symlink():
                self.assertFalse(os.path.isabs(os.readlink(path)), f"{path} is a link with a path of this machine")
                self.assertTrue(path.exists(), f"{path} leads nowhere")

    def test_nothing_was_generated(self):
        for path in self.paths:
            self.assertIsNone(self.GENERATED.search(path.relative_to(SOURCE).as_posix()), f"{path} was generated")

    def test_no_path_of_one_machine(self):
        """But for names of temporary files, /tmp/festoon-..., in tests and what a test itself forbids."""
        for path in self.paths:
            if path.is_file() and path.suffix not in (".png", ".db", ".h5"):
                for line in path.read_text(encoding="utf-8", errors="replace").splitlines():
                    self.assertIsNone(self.OF_A_MACHINE.search(line), f"{path}: {line}")


class Pages(unittest.TestCase):
    """README, CHANGELOG, docs/, and what the comments of the code name."""

    CODE = ("c", "h", "inl", "def", "cpp", "py")
    FOREIGN = {"my.c", "os_unix.c"}  # a reader's own program; SQLite's source

    @classmethod
    def setUpClass(cls):
        cls.paths = [path for room in ROOMS for path in (SOURCE / room).rglob("*")
                     if path.is_file() and "__pycache__" not in path.parts]
        cls.there = {path.relative_to(SOURCE).as_posix() for path in cls.paths}
        cls.there |= {path.name for path in SOURCE.iterdir()}
        cls.pages = [SOURCE / "README.md", SOURCE / "CHANGELOG.md"] + \
            [path for path in cls.paths if path.parent == SOURCE / "docs" and path.suffix in (".md", ".dox", ".in")]
        texts = [path.read_text(encoding="utf-8") for path in cls.paths
                 if path.suffix[1:] in cls.CODE and path.relative_to(SOURCE).parts[0] in ("src", "paper", "include", "examples")]
        code = " ".join(re.sub(r"/\*.*?\*/", " ", text, flags=re.S) for text in texts)
        cls.words = set(re.findall(r"\w+", code))
        cls.prefixes = set(re.findall(r"\b((?:fst|FST)_\w+_) ?##", code))

    def is_name(self, name):
        """A word of the code, a prefix of words, or made by a macro: FST_FRICTION_##name with the word none."""
        made = [name[len(prefix):] for prefix in self.prefixes if name.startswith(prefix)]
        return name in self.words or any(rest == "NAME" or rest.lower() in self.words for rest in made) or \
            (name.endswith("_") and any(word.startswith(name) for word in self.words))

    def is_there(self, name):
        """NAME, COMMAND, FOLDER, * and name.inl stand for any name."""
        pattern = re.sub(r"NAME|COMMAND|FOLDER|\\\*|\bname(?=\\\.inl)", "[a-z0-9_]*", re.escape(name))
        return any(re.search(rf"(^|/){pattern}$", path) for path in self.there)

    def test_files_and_tests_named_in_pages_are_there(self):
        """A name in backticks, or a path into a folder of the source."""
        for page in self.pages:
            text = page.read_text(encoding="utf-8")
            named = set(re.findall(r"`([\w./*-]+\.(?:c|h|inl|def|py|sh|sbatch|md|dox))`", text))
            named |= set(re.findall(r"\b((?:src|paper|include|tests|tools|bench|examples|docs)/[\w./*-]*\w)", text))
            for name in named:
                self.assertTrue(self.is_there(name) or (SOURCE / name).is_dir(), f"{page.name}: {name} is not there")
            for name in set(re.findall(r"\b(test_\w*[a-z0-9])\b(?!\*)", text)):
                self.assertTrue(self.is_there(name + ".c") or self.is_there(name + ".py"),
                                f"{page.name}: there is no test {name}")

    def test_names_of_the_library_in_pages_are_there(self):
        for page in self.pages:
            for name in set(re.findall(r"\b(?:fst|FST)_\w+", page.read_text(encoding="utf-8"))):
                self.assertTrue(self.is_name(name), f"{page.name} names {name}, which is not in src/ or include/")

    def test_functions_named_in_pages_are_there(self):
        """Functions in backticks, as `look_for_tasks()`, stand in the code; NAME stands for any name."""
        for page in self.pages:
            for name in re.findall(r"`(\w+)\(\)`", page.read_text(encoding="utf-8")):
                stem = name.replace("NAME", "")
                self.assertTrue(name in self.words or stem != name and any(stem in word for word in self.words),
                                f"{page.name}: {name}() is nowhere")

    def test_links_lead_somewhere(self):
        """Relative links of pages in Markdown, and the headings behind "#"."""
        for page in self.pages:
            for link in re.findall(r"\]\(([^)\s]+)\)", page.read_text(encoding="utf-8")):
                if "://" in link or page.suffix != ".md":
                    continue
                path, _, heading = link.partition("#")
                target = page.parent / path if path else page
                self.assertTrue(target.exists(), f"{page.name}: {link}")
                if heading:
                    heads = re.findall(r"^#+ (.*)$", target.read_text(encoding="utf-8"), re.M)
                    names = [re.sub(r"[^\w\- ]", "", head.lower()).strip().replace(" ", "-") for head in heads]
                    self.assertIn(heading, names, f"{page.name}: {link}")

    def test_names_in_comments_are_there(self):
        """Files, and names of the library, in the comments of C."""
        for path in self.paths:
            if path.suffix[1:] not in ("c", "h", "inl", "def"):
                continue
            for comment in re.findall(r"/\*.*?\*/", path.read_text(encoding="utf-8"), re.S):
                for name in set(re.findall(r"\b((?:[a-z_]+/)*[a-z]\w*\.(?:inl|def|py|md|h|c))\b", comment)):
                    self.assertTrue(self.is_there(name) or name in self.FOREIGN, f"{path}: {name} is not there")
                for name in set(re.findall(r"\b(?:fst|FST)_\w+", comment)):
                    self.assertTrue(self.is_name(name), f"{path} names {name}, which is not in src/ or include/")

    def test_faults_named_are_there(self):
        """docs/inside/reliability.md names faults of tests/mutants, each with its file."""
        text = (SOURCE / "docs" / "inside" / "reliability.md").read_text(encoding="utf-8")
        section = re.search(r"<!-- begin mutants -->(.*?)<!-- end mutants -->", text, re.S)[1]
        sys.path.insert(0, str(SOURCE / "tests" / "mutants"))
        import entries as listed  # noqa: E402
        entries = listed.read_all()
        listed.stale(entries, SOURCE)
        faults = {entry.name: entry.path for entry in entries}
        for name, path in re.findall(r"^- `([\w-]+)` in `([\w./]+)`", section, re.M):
            self.assertEqual(faults.get(name), path, f"docs/inside/reliability.md: {name} in {path}")


if __name__ == "__main__":
    unittest.main()
