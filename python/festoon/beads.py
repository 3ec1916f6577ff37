"""Several beads on one plate."""

from typing import TYPE_CHECKING, Any, Callable, Dict, Iterable, List, Mapping, Optional, Union

import numpy as np

from ._errors import BadInput
from ._given import rows_in, whole_of
from ._keys import key_of, keyword_of
from ._native import call, ffi, lib, text_of
from ._progress import Progress
from ._quantities import value_text
from .bead import Bead, Path

if TYPE_CHECKING:
    from .beads_orbits import BeadsBranch, BeadsLocked, BeadsOrbit
    from .beads_runs import BeadsRun

#: A setup that lists a bead, whose rows are those of any.
_LISTED = ffi.new("fst_params *", lib.fst_default_params())
_LISTED.bead_count = 1
#: Parameters that say nothing of a bead alone.
OF_LISTS = ("contact.pair_rate", "contact.pair_mu", "model.chi", "run.method", "run.step")


def _own_key(keyword: str, bead: int) -> str:
    """The key of a keyword of one bead: start__phi is start.phi, and radius is radius; else the nearest is named."""
    keys = [text_of(lib.fst_param_at(i).key).split("].", 1)[1] for i in range(lib.fst_param_count(), lib.fst_params_row_count(_LISTED))
            if lib.fst_param_bead(i) == 0]
    names = {keyword_of(key.split("[")[0]): key.split("[")[0] for key in keys}
    names.update({key[len("bead.") :]: key for key in keys if key.startswith("bead.")})
    if keyword in names or key_of(keyword) in names.values():
        return names.get(keyword, key_of(keyword))
    nearest = ffi.new("char[]", 64)
    lib.fst_nearest_name(keyword.encode(), "|".join(names).encode(), nearest, 64)
    raise BadInput(f"beads[{bead}]", f'unknown keyword "{keyword}"; the nearest is {text_of(nearest)}')


class Beads(Bead):
    """Several beads on one magnetic stirrer, which attract each other, touch, rub and collide.

    ``beads`` is a list of dictionaries, one a bead, with parameters of ``bead`` (``radius``) and ``start``
    (``start__phi``) alone; what a bead does not say, the other keywords say for all.  A scene with such a list is read
    as by `Bead`.

    >>> pair = Beads(beads=[{"start__phi": 3}, {"start__phi": 183}], frequency="30 Hz", run__periods=4, run__discard=2)
    >>> pair.run().outcome
    'apart'
    """

    def __init__(self, scene: Any = None, *, beads: Optional[Iterable[Mapping[str, Any]]] = None, **keywords: Any) -> None:
        if isinstance(scene, (list, tuple)):
            scene, beads = None, scene
        given: Dict[str, Any] = keywords if beads is None else {**keywords, "beads": beads}
        super().__init__(scene, **given)

    def _set(self, keywords: Mapping[str, Any]) -> None:
        super()._set({keyword: value for keyword, value in keywords.items() if keyword != "beads"})
        if keywords.get("beads") is not None:
            self._set_beads(keywords["beads"])
            self._make()
        if not self._params.bead_count:
            raise BadInput("beads", "it must be a list of dictionaries, one a bead: [{'start__phi': 3}, {'start__phi': 183}]")

    def _set_beads(self, beads: Iterable[Mapping[str, Any]]) -> None:
        self._params.bead_count, self._params.bead_list = 0, ffi.NULL
        for i, bead in enumerate(rows_in(beads, "beads", "one a bead: [{'start__phi': 3}, {'start__phi': 183}]")):
            for keyword, value in bead.items() or [("start__r", self._text("start.r"))]:
                key = f"beads[{i}].{_own_key(keyword, i)}"
                single = isinstance(value, str) or np.ndim(value) == 0
                for name, number in [(key, value)] if single else [(f"{key}[{k}]", v) for k, v in enumerate(value)]:
                    call(lib.fst_params_set, self._params, name.encode(), value_text(number, name).encode())

    def __len__(self) -> int:
        return int(self._params.bead_count)

    @property
    def beads(self) -> List[Dict[str, str]]:
        """What each bead says of its own, as texts."""
        found: List[Dict[str, str]] = [{} for _ in range(len(self))]
        text = ffi.new("char[]", 64)
        for i in range(lib.fst_param_count(), lib.fst_params_row_count(self._params)):
            number = lib.fst_param_bead(i)
            if 0 <= number < len(found):
                lib.fst_params_get(self._params, i, text, 64)
                if text[0] != b"\0":
                    found[number][keyword_of(text_of(lib.fst_param_at(i).key).split("].", 1)[1])] = text_of(text)
        return found

    def alone(self, number: int) -> Bead:
        """One of the beads as if it were alone: what it says of its own, and what is said for all.

        Parameters
        ----------
        number
            From 0.

        Returns
        -------
        Bead
            Of which all can be asked that can be asked of one bead.

        Raises
        ------
        BadInput
            Where there is no such bead.
        """
        params = ffi.new("fst_params *")
        call(lib.fst_params_of_bead, self._params, whole_of(number, "number"), params)
        for key in (*OF_LISTS, *(["impact.restitution"] if self.friction__law != "coulomb" else [])):
            call(lib.fst_params_unset, params, key.encode())
        return Bead._of(params[0], self._map)

    def run(  # type: ignore[override]
        self,
        *,
        periods: Optional[float] = None,
        discard: Optional[float] = None,
        trajectory: Union[bool, Path] = False,
        fps: Optional[float] = None,
        start: Any = None,
        progress: Progress = None,
    ) -> "BeadsRun":
        """Simulate the beads and describe what they do: a :class:`BeadsRun`.

        Parameters
        ----------
        periods, discard
            Length in drive periods, and how many of them are left out of the means.
        trajectory
            True: the result has a `trajectory`; a path (.h5 or .csv): the samples go into that file.
        fps
            Samples a second, as a camera takes them, instead of run.samples in a drive period.
        start
            States instead of start.*, of the shape (beads, 12), scaled.
        progress
            True: a bar; or a function of (fraction, what).

        Returns
        -------
        BeadsRun
            Its numbers are scaled, those of `festoon run --json`.

        Raises
        ------
        BadInput
            Where an argument is wrong, or beads overlap; the sentence says what was expected.
        NoConvergence
            Where no step is small enough for the tolerance.
        Interrupted
            After Ctrl-C; `partial` is the trajectory until then, or None.
        """
        from . import beads_runs

        scene = self.replace(run__periods=periods, run__discard=discard)._asked()
        return beads_runs.run(scene, trajectory, fps, start, progress)  # type: ignore[no-any-return]

    def orbit(self, *, progress: Progress = None) -> "BeadsOrbit":  # type: ignore[override]
        """The periodic orbit by which the motion from the start passes, stable or not: a `BeadsOrbit`.

        Parameters
        ----------
        progress
            True: a bar; or a function of (fraction, what).

        Returns
        -------
        BeadsOrbit
            Its numbers are scaled, those of `festoon orbit --json`.

        Raises
        ------
        NoConvergence
            Where there is none within run.periods, or contacts open and close on it.
        Interrupted
            After Ctrl-C.
        """
        from . import beads_orbits

        return beads_orbits.orbit(self._asked(), progress)  # type: ignore[arg-type]

    def locked(self, *, progress: Progress = None) -> "BeadsLocked":  # type: ignore[override]
        """The state to which the start leads in which the beads turn with the magnet: a `BeadsLocked`.

        Parameters
        ----------
        progress
            True: a bar; or a function of (fraction, what).

        Returns
        -------
        BeadsLocked
            With loads, forces and eigenvalues.

        Raises
        ------
        NoConvergence
            Where the start leads to none within run.periods; the sentence says why.
        Interrupted
            After Ctrl-C.
        """
        from . import beads_orbits

        return beads_orbits.locked(self._asked(), progress)  # type: ignore[arg-type]

    def branch(self, *, progress: Progress = None, **ranges: Any) -> "BeadsBranch":  # type: ignore[override]
        """Follow the locked state to which the start leads over a parameter, ``frequency=(10, 400)``: a `BeadsBranch`.

        Parameters
        ----------
        progress
            True: a bar; or a function of (fraction, what).
        **ranges
            The range of one parameter.

        Returns
        -------
        BeadsBranch
            Its points and special points, to where a contact opens or closes.

        Raises
        ------
        BadInput
            Where an argument is wrong; the sentence says what was expected.
        NoConvergence
            Where the start leads to no locked state.
        Interrupted
            After Ctrl-C.
        """
        from . import beads_orbits

        return beads_orbits.branch(self._asked(map(key_of, ranges)), progress, ranges)  # type: ignore[arg-type]

    def __repr__(self) -> str:
        rest = super().__repr__()[len("Beads(") :]
        return f"Beads(beads={self.beads}{', ' if rest != ')' else ''}{rest}"

    def _repr_html_(self) -> str:
        from html import escape

        return f"<pre>{escape(repr(self))}</pre>"


def _of_one(name: str) -> Callable[..., Any]:
    def refused(self: Beads, *arguments: Any, **keywords: Any) -> None:
        raise BadInput(f"Beads.{name}", f"it is for one bead: Beads.run() simulates several, and Beads.alone(0).{name}() asks the first one")

    refused.__name__, refused.__qualname__ = name, f"Beads.{name}"
    refused.__doc__ = f"""For one bead; :meth:`Beads.alone` gives one: ``beads.alone(0).{name}()``.

        Parameters
        ----------
        *arguments, **keywords
            Those of :meth:`Bead.{name}`.

        Raises
        ------
        BadInput
            Always.
        """
    return refused


for _name in ("sweep", "lyapunov", "critical", "flow", "start_state", "rhs", "jacobian", "observe", "movie", "lab"):
    setattr(Beads, _name, _of_one(_name))
