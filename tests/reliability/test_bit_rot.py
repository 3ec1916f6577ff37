"""A few of the bits that tests/reliability/rot.py turns over: none is exported as a result.

tests: sweep/columns.c sweep/rows.c"""

import os
import random
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.environ["SOURCE_DIR"], "tests", "reliability"))

import rot  # noqa: E402


class Rot(unittest.TestCase):
    def test_a_handful(self):
        counts, wrong = rot.campaign(16, 5, 24)
        self.assertEqual(wrong, [])
        self.assertGreater(sum(entry["detected"] for entry in counts.values()), 0)

    def test_the_last_page(self):
        """Whatever stands on the last page of the file, each command ends, and says why where it ends otherwise."""
        with tempfile.TemporaryDirectory(prefix="festoon-rot-") as folder:
            path = os.path.join(folder, "a.db")
            words = [*rot.words_of(40), path]
            rot.good(*words)
            whole, rows = rot.content_of(path), rot.good("export", path, "--csv")
            page = int.from_bytes(whole[16:18], "big")
            for last in (bytes(page), b"\xff" * page, random.Random(1).randbytes(page), whole[:page], whole[-page:-page // 2], b""):
                for command in (["export", path, "--csv"], words, ["plot", path, "-o", os.path.join(folder, "f.svg")]):
                    for old in os.listdir(folder):
                        os.remove(os.path.join(folder, old))
                    with open(path, "wb") as out:
                        out.write(whole[:-page] + last)
                    status, said, err = rot.festoon(*command)
                    self.assertIn(status, (0, 1, 2), (command, err))
                    self.assertTrue(status == 0 or (said == "" and err.startswith("festoon: ") and err.count("\n") == 1), err)
                    if status == 0 and command is words:
                        self.assertEqual(rot.good("export", path, "--csv"), rows)
                    elif status == 0 and command[0] == "export":
                        self.assertEqual(said, rows)


if __name__ == "__main__":
    unittest.main()
