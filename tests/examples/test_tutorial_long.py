"""docs/tutorial.md and the first minutes of README.md are true: every command runs and prints what the page says.

labels: long"""

import unittest

import test_tutorial
import tutorial


class WholePages(test_tutorial.Commands):
    def test_the_tutorial(self):
        self.do([step for steps in tutorial.sections().values() for step in steps])

    def test_the_readme(self):
        self.do(tutorial.sections(tutorial.README)["First minutes"])


if __name__ == "__main__":
    unittest.main()
