"""What can go wrong, as exceptions with the library's own sentences."""

import errno
import os
import re
import sys
import warnings
from typing import Any, Dict, Tuple, Type

from ._festoon import lib


def _rebuild(kind: Type["FestoonError"], where: str, sentence: str) -> "FestoonError":
    return kind(where, sentence)


class FestoonError(Exception):
    """An error of the library: `where` it lies, and a `sentence` that says what it is and what to try."""

    def __init__(self, where: str, sentence: str) -> None:
        super().__init__(f"{where}: {sentence}" if where and not sentence.startswith(where) else sentence)
        self.where = where
        self.sentence = sentence

    def __str__(self) -> str:
        return str(self.args[0])  # not the "[Errno 2]" of an OSError

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


class MissingFile(BadInput, InputOutput, FileNotFoundError):
    """A file, or the folder into which one is to go, is not there."""

    def __init__(self, where: str, sentence: str) -> None:
        super().__init__(where, sentence)
        self.errno, self.strerror, self.filename = errno.ENOENT, os.strerror(errno.ENOENT), where


class OutOfMemory(FestoonError, MemoryError):
    """There was no memory."""


class Unavailable(FestoonError):
    """This build or machine lacks a component; the sentence names it."""


class SceneWarning(UserWarning):
    """What was said can be computed, but hardly be meant: parts of a magnet that overlap, an axis that changes only units."""


class MaterialWarning(SceneWarning):
    """Mass, radius and magnetic strength of a bead contradict any material."""


def warn(sentence: str, kind: Type[Warning] = UserWarning) -> None:
    """A warning at the line of the user's that has called the module."""
    frame, level = sys._getframe(1), 2
    while frame.f_back is not None and str(frame.f_globals.get("__name__")).startswith("festoon."):
        frame, level = frame.f_back, level + 1
    warnings.warn(sentence, kind, stacklevel=level)


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

#: What the library's sentences call by names of C, and the same in Python.
CALLS = {
    "fst_param_at()": "festoon.schema()",
    "fst_orbit_find()": "Bead.orbit()",
    "fst_lyapunov_find()": "Bead.lyapunov()",
    "fst_critical_find": "Bead.critical()",
    "fst_locked_find()": "Bead.locked()",
    "fst_branch_follow()": "Bead.branch()",
    "fst_sweep_export()": "festoon.export()",
    "fst_sweep()": "festoon.sweep()",
    "fst_branch_write()": "Branch.save()",
    "fst_run_json()": "Run.to_dict()",
    "fst_track_options.scale": "scale",
    "fst_track_options.from": "frames",
    "fst_track_options.to": "frames",
    "fst_measure_options.drive": "drive",
    "fst_sweep_figure.at": "at={KEY: VALUE}",
}

#: Arguments that have another name in Python than in C.
ARGUMENTS = {
    "from": "begin",
    "to": "end",
    "axes": "sweep",
    "key": "branch",
    "second_key": "branch",
    "second_from": "branch",
    "longest_step": "step",
}


#: Calls that have another name in Python than in C.
PLACES = {"sweep_merge": "merge", "field_map_smooth": "smooth", "describe_orbit": "orbit", "beads_run": "run", "camera_film": "film"}


def place_in_python(where: str) -> str:
    """Where an error lies: an argument of a call, or the call, by its name in Python."""
    if not where.startswith("fst_"):
        return where
    call, _, argument = where[len("fst_") :].partition(".")
    if argument:
        return "branch" if call == "branch_options" and argument in ("from", "to") else ARGUMENTS.get(argument, argument)
    return PLACES.get(call, re.sub("_(options|new|find|of|follow|near)$", "", call))


def sentence_in_python(sentence: str) -> str:
    """A sentence of the library with names of Python in the place of those of C."""
    for name, ours in CALLS.items():
        sentence = sentence.replace(name, ours)
    return sentence


def exception_of(code: int, where: str, sentence: str) -> FestoonError:
    """The exception of a status of the library."""
    kind = ERRORS.get(code, FestoonError)
    if kind in (BadInput, InputOutput) and sentence.endswith(os.strerror(errno.ENOENT)):
        kind = MissingFile
    elif kind is InputOutput and sentence.endswith(os.strerror(errno.ENOMEM)):
        kind = OutOfMemory
    return kind(place_in_python(where), sentence_in_python(sentence))
