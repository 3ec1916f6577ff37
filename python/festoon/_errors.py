"""What can go wrong, as exceptions with the library's own sentences."""

from typing import Any, Dict, Tuple, Type

from ._festoon import lib


def _rebuild(kind: Type["FestoonError"], where: str, sentence: str) -> "FestoonError":
    return kind(where, sentence)


class FestoonError(Exception):
    """An error of the library: `where` it lies, and a `sentence` that says what it is and what to try."""

    def __init__(self, where: str, sentence: str) -> None:
        super().__init__(f"{where}: {sentence}" if where else sentence)
        self.where = where
        self.sentence = sentence

    def __reduce__(self) -> Tuple[Any, ...]:
        return _rebuild, (type(self), self.where, self.sentence)


class BadInput(FestoonError, ValueError):
    """A parameter, a file or an argument is wrong; the sentence says what was expected."""


class StepUnderflow(FestoonError, ArithmeticError):
    """The step size underflowed."""


class NotFinite(FestoonError, ArithmeticError):
    """A number stopped being finite."""


class NoConvergence(FestoonError):
    """No solution was found; the sentence says what became of the search."""


class InputOutput(FestoonError, OSError):
    """A file could not be read or written."""


class OutOfMemory(FestoonError, MemoryError):
    """There was no memory."""


class Unavailable(FestoonError):
    """This build or machine lacks a component; the sentence names it."""


class Interrupted(KeyboardInterrupt):
    """Ctrl-C ended a call; `partial` is what it had done by then, or None."""

    def __init__(self, partial: Any = None) -> None:
        super().__init__("interrupted")
        self.partial = partial


ERRORS: Dict[int, Type[FestoonError]] = {
    lib.FST_BAD_INPUT: BadInput,
    lib.FST_STEP_UNDERFLOW: StepUnderflow,
    lib.FST_NOT_FINITE: NotFinite,
    lib.FST_NO_CONVERGENCE: NoConvergence,
    lib.FST_IO: InputOutput,
    lib.FST_NO_MEMORY: OutOfMemory,
    lib.FST_UNAVAILABLE: Unavailable,
}
