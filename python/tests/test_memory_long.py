"""Memory that runs out, at ten times as many places as in test_memory.py."""

import pytest

from test_memory import CALLS, walk


@pytest.mark.parametrize("name", CALLS)
def test_many_places(name, tmp_path):
    walk(name, tmp_path, 10)
