"""Progress with the time that is left: a line on a terminal, a bar in a notebook, or a function of yours."""

import sys
import time
from typing import Any, Callable, Union

#: True: a bar; a function: called with (fraction, what); None or False: nothing is shown.
Progress = Union[None, bool, Callable[[float, str], Any]]


class Silent:
    """Shows nothing."""

    def tell(self, fraction: float, what: str) -> None:
        pass

    def end(self, whole: bool) -> None:
        pass


class Told(Silent):
    """Hands progress on to a function."""

    def __init__(self, function: Callable[[float, str], Any]) -> None:
        self._function = function

    def tell(self, fraction: float, what: str) -> None:
        self._function(fraction, what)


def _left(seconds: float, fraction: float) -> str:
    if fraction <= 0.0 or seconds < 0.5:
        return ""
    left = int(seconds * (1.0 - fraction) / fraction + 0.5)
    minutes, seconds_left = divmod(left, 60)
    hours, minutes = divmod(minutes, 60)
    clock = f"{hours}:{minutes:02d}:{seconds_left:02d}" if hours else f"{minutes}:{seconds_left:02d}"
    return f"{clock} left"


class _Timed(Silent):
    """A bar that is drawn anew ten times a second."""

    def __init__(self, title: str) -> None:
        self._title = title
        self._begin = time.monotonic()
        self._drawn = 0.0

    def tell(self, fraction: float, what: str) -> None:
        now = time.monotonic()
        if now - self._drawn >= 0.1:
            self._drawn = now
            words = "  ".join(word for word in (self._title, what) if word)
            self._draw(fraction, words, _left(now - self._begin, fraction))

    def _draw(self, fraction: float, words: str, left: str) -> None:
        raise NotImplementedError


class TerminalBar(_Timed):
    """A line on standard error, removed at the end."""

    WIDTH = 30

    def _draw(self, fraction: float, words: str, left: str) -> None:
        full = int(self.WIDTH * fraction)
        bar = "#" * full + "." * (self.WIDTH - full)
        sys.stderr.write(f"\r\x1b[K{words[:40]} [{bar}] {100 * fraction:3.0f} % {left}")
        sys.stderr.flush()

    def end(self, whole: bool) -> None:
        if self._drawn:
            sys.stderr.write("\r\x1b[K")
            sys.stderr.flush()


class NotebookBar(_Timed):
    """A bar of HTML in the cell's output, removed at the end."""

    def __init__(self, title: str) -> None:
        super().__init__(title)
        self._shown: Any = None

    def _draw(self, fraction: float, words: str, left: str) -> None:
        from html import escape

        from IPython.display import HTML, display

        bar = HTML(
            f"<progress value='{fraction:.4f}' max='1'></progress> {100 * fraction:.0f} % "
            f"{escape(words)} {escape(left)}"
        )
        if self._shown is None:
            self._shown = display(bar, display_id=True)
        else:
            self._shown.update(bar)

    def end(self, whole: bool) -> None:
        if self._shown is not None:
            from IPython.display import HTML

            self._shown.update(HTML(""))


def in_notebook() -> bool:
    """Whether a Jupyter kernel runs this."""
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython is not None else None
    return shell is not None and hasattr(shell, "kernel")


def bar_for(progress: Progress, title: str = "") -> Silent:
    """The bar that is asked for: of a notebook, of a terminal, or none where nobody would see it."""
    if callable(progress):
        return Told(progress)
    if not progress:
        return Silent()
    if in_notebook():
        return NotebookBar(title)
    return TerminalBar(title) if sys.stderr.isatty() else Silent()
