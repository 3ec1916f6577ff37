"""docs/design.md is true: every file that it names is there, and every file of the source is named.  All pages of the
documentation, and the comments of the code, name only files, functions, types, tests and faults that exist.

Environment: SOURCE_DIR the source tree.
"""

import os
import pathlib
import re
import unittest

SOURCE = pathlib.Path(os.environ["SOURCE_DIR"])
PAGE = (SOURCE / "docs" / "design.md").read_text(encoding="utf-8")
ENDINGS = ("c", "h", "inl", "def")
ROOMS = ("src", "include", "tests", "tools", "bench", "examples", "docs")


class Design(unittest.TestCase):
    def files(self, *folders):
        return [path for folder in folders for path in (SOURCE / folder).rglob("*") if path.is_file()]

    def test_every_file_named_is_there(self):
        """NAME, COMMAND, FOLDER and * stand for any name."""
        there = {path.relative_to(SOURCE).as_posix() for path in self.files(*ROOMS)} | {"README.md"}
        named = re.findall(r"`([\w./*]+\.(?:c|h|inl|def|py|md|sh|db))`", PAGE)
        self.assertGreater(len(named), 150)
        for name in named:
            pattern = re.sub(r"NAME|COMMAND|FOLDER|\*", "[a-z0-9_]*", name.replace(".", r"\."))
            if not name.endswith(".db"):
                self.assertTrue(any(re.search(rf"(^|/){pattern}$", path) for path in there), f"{name} is not there")

    def test_every_file_of_the_source_is_named(self):
        """A header and its .c file share an entry; an entry may end in * for a family of files."""
        words = set(re.findall(r"[\w*]+(?=\.(?:c|h|inl|def)\b)", PAGE))
        families = [word.replace("*", r"\w*") for word in words if "*" in word]
        unnamed = [
            path.relative_to(SOURCE).as_posix()
            for path in self.files("src", "include")
            if path.suffix[1:] in ENDINGS and path.stem not in words
            and not any(re.fullmatch(family, path.stem) for family in families)
        ]
        self.assertEqual(unnamed, [])

    def test_every_folder_of_the_source_is_a_room(self):
        for folder in (SOURCE / "src").iterdir():
            if folder.is_dir():
                self.assertIn(f"| `src/{folder.name}/` |", PAGE)


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
                 if path.suffix[1:] in cls.CODE and path.relative_to(SOURCE).parts[0] in ("src", "include", "examples")]
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
            named |= set(re.findall(r"\b((?:src|include|tests|tools|bench|examples|docs)/[\w./*-]*\w)", text))
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
        """docs/reliability.md names faults of tests/mutants, each with its file."""
        text = (SOURCE / "docs" / "reliability.md").read_text(encoding="utf-8")
        section = re.search(r"<!-- begin mutants -->(.*?)<!-- end mutants -->", text, re.S)[1]
        faults = dict(line[1:].split("] ", 1) for path in self.paths if path.suffix == ".mutants"
                      for line in path.read_text(encoding="utf-8").splitlines() if re.match(r"\[[a-z0-9-]+\] ", line))
        for name, path in re.findall(r"^- `([\w-]+)` in `([\w./]+)`", section, re.M):
            self.assertEqual(faults.get(name), path, f"docs/reliability.md: {name} in {path}")


if __name__ == "__main__":
    unittest.main()
