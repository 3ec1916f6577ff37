"""All of docs/tutorial.md is true: every command runs and prints what the page says.

Environment: FESTOON is the program, SOURCE_DIR the source tree.
"""

import unittest

import test_tutorial
import tutorial


class WholePage(test_tutorial.Page):
    titles = list(tutorial.sections())


if __name__ == "__main__":
    unittest.main(defaultTest="WholePage")
