"""docs/design.md is true: every file that it names is there, and every file of the source is named.

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

    def test_every_function_named_is_there(self):
        """Functions in backticks, as `look_for_tasks()`, stand in some file of src/ or include/."""
        text = "\n".join(path.read_text(encoding="utf-8") for path in self.files("src", "include"))
        for name in re.findall(r"`(\w+)\(\)`", PAGE):
            stem = name.replace("NAME", "")
            self.assertIn(stem, text, f"{name}() is nowhere")


if __name__ == "__main__":
    unittest.main()
