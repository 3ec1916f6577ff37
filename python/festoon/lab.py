"""The browser page with a bead, in a notebook."""

import html
import json
import pathlib
import sys
import urllib.parse
from typing import Any, List, Optional

from ._errors import Unavailable

PAGE = "festoon-lab.html"


def places() -> List[pathlib.Path]:
    """Where the page may be: beside the module, in the build tree, installed."""
    here = pathlib.Path(__file__).absolute().parent
    sources = pathlib.Path(__file__).resolve().parents[2]  # modules of a build tree are links to the sources
    shares = [pathlib.Path(prefix) / "share" / "festoon" for prefix in (sys.prefix, "/usr/local", "/usr")]
    return [folder / PAGE for folder in (here, *here.parents[:2], sources / "build", *shares)]


def page() -> Optional[pathlib.Path]:
    """The page, or None where it was not built."""
    return next((place for place in places() if place.is_file()), None)


def fragment(bead: Any) -> str:
    """The part of the page's address that tells it the bead."""
    given = bead._given()
    if "drive.omega" not in given:
        given.setdefault("drive.frequency", repr(bead.frequency))
    return urllib.parse.urlencode({"v": "1", **given})


class Lab:
    """The browser page with a bead; a notebook shows it, open() opens it in a browser."""

    def __init__(self, bead: Any, height: int = 720) -> None:
        found = page()
        if found is None:
            raise Unavailable("lab", f"the browser page {PAGE} was not built: `make lab` makes it")
        self.page = found
        self.height = height
        self.fragment = fragment(bead)

    @property
    def url(self) -> str:
        """The address of the page with this bead."""
        return f"{self.page.as_uri()}#{self.fragment}"

    def open(self) -> None:
        """Open the page in a browser."""
        import webbrowser

        webbrowser.open(self.url)

    def __repr__(self) -> str:
        return f"Lab: {self.url}"

    def _repr_html_(self) -> str:
        # The page lies in the notebook itself; the scene comes by the fragment, set before its scripts run.
        scene = json.dumps("#" + self.fragment).replace("<", "\\u003c")
        text = self.page.read_text(encoding="utf-8")
        first = f"<script>window.location.hash = {scene};</script>"
        head = text.find("<head>")
        text = text[: head + 6] + first + text[head + 6 :] if head >= 0 else first + text
        source = html.escape(text, quote=True)
        return f'<iframe srcdoc="{source}" width="100%" height="{int(self.height)}" style="border: 0"></iframe>'
