"""Periodic orbits, locked states, Lyapunov spectra."""

import json
import os
from typing import Any, Dict, List, Optional, Sequence, Tuple, Union

import numpy as np

from ._errors import BadInput
from ._native import Watch, ffi, lent, lib, state_of, take_text, text_of
from ._pickled import Told, image_of, struct_of
from ._progress import Progress
from ._quantities import units_of
from ._tabled import NUMBERS, OF_PLATE, Column, Shown, Table, about, numbers_of, scaled_columns, scales_of
from .bead import Bead
from .runs import SYMMETRIES, Run

Path = Union[str, "os.PathLike[str]"]


def _names(function: Any, count: int) -> List[str]:
    return [text_of(function(i)) for i in range(count)]


def _choose(word: str, names: Sequence[str], where: str) -> int:
    if word in names:
        return names.index(word)
    nearest = ffi.new("char[]", 64)
    lib.fst_nearest_name(str(word).encode(), "|".join(names).encode(), nearest, 64)
    raise BadInput(where, f'unknown name "{word}"; did you mean {text_of(nearest)}? (names: {", ".join(names)})')


def _complex(re: Any, im: Any) -> Any:
    return lent(np.array(list(re)) + 1j * np.array(list(im)))


# ---------------------------------------------------------------------------------------- orbits


class Orbit(Run):
    """A periodic orbit of the turning frame; its numbers are those of a run over one period."""

    #: Further stable patterns with the same number of festoons.
    others: "List[Orbit]"

    def __init__(self, bead: Bead, orbit: Any) -> None:
        super().__init__(bead, ffi.new("fst_run_result *", orbit.means))
        self._orbit = orbit
        self.others = []

    def __reduce__(self) -> Any:
        return _orbit_again, (self.bead, image_of(self._orbit), self.others)

    @property
    def symmetry(self) -> Optional[str]:
        """S1, S2 or None."""
        return SYMMETRIES[int(self._orbit.symmetry)]

    @property
    def turns(self) -> int:
        """Turns of Phi in the period: -1 for counter-rotation, 0 for a libration."""
        return int(self._orbit.turns)

    @property
    def stable(self) -> bool:
        """Whether all multipliers lie inside the unit circle."""
        return bool(self._orbit.stable)

    @property
    def multipliers(self) -> Any:
        """Floquet multipliers, of the half map for S2, otherwise of the full one."""
        return _complex(self._orbit.multiplier_re, self._orbit.multiplier_im)

    @property
    def relaxation_time(self) -> float:
        """In which a small disturbance falls by a factor e [1/gamma]; NaN: unstable."""
        return float(self._orbit.relaxation_time)

    @property
    def swing_ratio(self) -> float:
        """The paper's p [1]; NaN where r does not fall twice in a turn."""
        return float(self._orbit.swing_ratio)

    @property
    def residual(self) -> float:
        """The greatest component of the residual of Newton's equations [scaled]."""
        return float(self._orbit.residual)

    @property
    def state(self) -> Any:
        """The state on Phi = pi/2, passed downward."""
        return state_of(self._orbit.state)

    def to_dict(self) -> Dict[str, Any]:
        """What `festoon orbit --json` prints.

        Returns
        -------
        dict
            Keys and numbers as the program prints them; None where a number is undefined.

        Raises
        ------
        OutOfMemory
            Where there is no memory for it.
        """
        others, _ = _orbit_array([other._orbit for other in self.others])
        text: Dict[str, Any] = json.loads(
            take_text(lib.fst_orbit_json(self.bead._params, self._orbit, others, len(self.others), units_of("scaled")))
        )
        return text

    def plot(self, colour: str = "n_z", **options: Any) -> Any:
        """Draw the orbit with matplotlib; returns its Axes: see `festoon.plots.orbit`.

        Parameters
        ----------
        colour
            The column that colours the path.
        **options
            Those of the function that is named above.

        Returns
        -------
        matplotlib.axes.Axes
            The Axes with the picture, in which all can still be changed.

        Raises
        ------
        BadInput
            Where a name is unknown; the sentence has the nearest.
        Unavailable
            Where matplotlib is missing.
        """
        from . import plots

        return plots.orbit(self, colour, **options)

    def __repr__(self) -> str:
        stable = "stable" if self.stable else "unstable"
        return f"Orbit: {stable}, {self.symmetry}, period {self.period:.9g}, <r> {self.mean_r:.9g}"


def _orbit_again(bead: Bead, image: Any, others: List[Orbit]) -> Orbit:
    """An orbit from another process, which must have the same build."""
    made = Orbit(bead, struct_of(image))
    made.others = others
    return made


def _orbit_array(orbits: List[Any]) -> Tuple[Any, Any]:
    if not orbits:
        return ffi.NULL, None
    made = ffi.new("fst_orbit[]", len(orbits))
    for i, orbit in enumerate(orbits):
        made[i] = orbit[0]
    return made, made


def orbit(bead: Bead, festoons: Optional[float], progress: Progress) -> Orbit:
    """See Bead.orbit()."""
    if festoons is None:
        found = ffi.new("fst_orbit *")
        with Watch(progress, title="orbit") as watch:
            watch.call(lib.fst_orbit_find, bead._params, watch.told, found)
        return Orbit(bead, found)
    patterns = ffi.new("fst_festoon_list *")
    with Watch(progress, title="orbit") as watch:
        watch.call(lib.fst_festoons_find, bead._params, festoons, watch.told, patterns)
    patterns = ffi.gc(patterns, lib.fst_festoons_free)
    orbits = [
        Orbit(bead.replace(omega=patterns.omegas[i]), ffi.new("fst_orbit *", patterns.orbits[i]))
        for i in range(patterns.count)
    ]
    orbits[0].others = orbits[1:]
    return orbits[0]


# ---------------------------------------------------------------------------------------- locked states


class _Single:
    """A struct of a list, which keeps the list alive; pickled, it is alone."""

    _struct: Any

    def __reduce__(self) -> Any:
        return _single_again, (type(self), image_of(self._struct))

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        return bool(image_of(self._struct) == image_of(other._struct))  # type: ignore[attr-defined]

    def __hash__(self) -> int:
        return hash(image_of(self._struct)[1])


def _single_again(kind: Any, image: Any) -> Any:
    return kind(struct_of(image), None)


class Locked(_Single):
    """A state in which the bead goes round with the magnet."""

    def __init__(self, state: Any, owner: Any) -> None:
        self._struct = self._state = state
        self._owner = owner

    @property
    def r(self) -> float:
        """Distance from the axis [l]."""
        return float(self._state.r)

    @property
    def phi_deg(self) -> float:
        """Phi [degrees]; NaN on the axis."""
        return float(self._state.bead_angle_deg)

    @property
    def stable(self) -> bool:
        """Whether all eigenvalues have negative real parts."""
        return bool(self._state.stable)

    @property
    def slip(self) -> float:
        """Speed of the contact point [l gamma]."""
        return float(self._state.slip)

    @property
    def friction_power(self) -> float:
        """<f.V> per mass [l^2 gamma^3]."""
        return float(self._state.friction_power)

    @property
    def eigenvalues(self) -> Any:
        """Of the linearised motion, gamma."""
        return _complex(self._state.eigenvalue_re, self._state.eigenvalue_im)

    @property
    def state(self) -> Any:
        """X Y vX vY nX nY nZ WX WY WZ."""
        return state_of(self._state.state)

    @property
    def n(self) -> Any:
        """Direction of the moment in the turning frame."""
        return self.state[lib.FST_NX : lib.FST_NZ + 1]

    @property
    def w(self) -> Any:
        """Angular velocity in the turning frame."""
        return self.state[lib.FST_WX : lib.FST_WZ + 1]

    def __repr__(self) -> str:
        stable = "stable" if self.stable else "unstable"
        return f"Locked: r {self.r:.6g}, Phi {self.phi_deg:.6g} deg, {stable}"


class RollingLock(_Single):
    """An end of a family of locked states that roll without slipping."""

    def __init__(self, lock: Any, owner: Any) -> None:
        self._struct, self._owner = lock, owner
        self.r = float(lock.r)
        self.phi_deg = float(lock.bead_angle_deg)
        #: |f|/(mu_s N)
        self.use = float(lock.use)
        #: Why the family ends here: cone, lifted, spin, radius, closed or lost.
        self.end = text_of(lib.fst_rolling_end_name(lock.end))
        self.state = state_of(lock.state)

    def __repr__(self) -> str:
        return f"RollingLock: r {self.r:.6g}, Phi {self.phi_deg:.6g} deg, {self.end}"


class LockedStates(Shown, Told, Sequence[Locked]):
    """Every locked state at one drive, stable ones first."""

    def __init__(self, bead: Bead, states: Any) -> None:
        self.bead, self._list = bead, states
        #: Families of states that roll, under dry friction, as pairs of ends.
        self.families = [
            (RollingLock(getattr(family, "from"), states), RollingLock(family.to, states))
            for family in (states.families[i] for i in range(states.family_count))
        ]
        self.starts = int(states.starts)
        self.index_sum = int(states.index_sum)
        self.truncated = bool(states.truncated)

    def __reduce__(self) -> Any:
        return _states_again, (self.bead, image_of(self._list))

    def __len__(self) -> int:
        return int(self._list.count)

    def __getitem__(self, index: Any) -> Any:
        if isinstance(index, slice):
            return [self[i] for i in range(*index.indices(len(self)))]
        place = index + len(self) if index < 0 else index
        if not 0 <= place < len(self):
            raise IndexError(index)
        return Locked(self._list.states[place], self._list)

    def _table(self, units: Optional[str]) -> Table:
        names = ("r", "phi_deg", "stable", "slip", "friction_power", "eigenvalues")
        values = {name: np.array([getattr(state, name) for state in self]) for name in names}
        values.update(numbers_of(np.array([state.state for state in self]).reshape(len(self), len(OF_PLATE)), OF_PLATE))
        values["eigenvalues"] = values["eigenvalues"].reshape(len(self), lib.FST_EIGENVALUE_COUNT)
        known = {**NUMBERS, "r": "l", "phi_deg": "deg", "slip": "l gamma", "friction_power": "l^2 gamma^3", "eigenvalues": "gamma"}
        columns = scaled_columns(("state",), values, known, scales_of(self.bead._params, units))
        return Table(("state",), {"state": Column(("state",), np.arange(len(self)))}, columns, about(self.bead.scene()))

    @property
    def stable(self) -> List[Locked]:
        """The stable ones."""
        return [state for state in self if state.stable]

    def to_dict(self) -> Dict[str, Any]:
        """What `festoon locked --json` prints.

        Returns
        -------
        dict
            Keys and numbers as the program prints them; None where a number is undefined.

        Raises
        ------
        OutOfMemory
            Where there is no memory for it.
        """
        text: Dict[str, Any] = json.loads(
            take_text(lib.fst_locked_json(self.bead._params, self.bead.omega, self._list, units_of("scaled")))
        )
        return text

    def __repr__(self) -> str:
        return "\n".join(repr(state) for state in self) or "no locked states"


def _states_again(bead: Bead, image: Any) -> LockedStates:
    return LockedStates(bead, struct_of(image))


def locked(bead: Bead, progress: Progress) -> LockedStates:
    """See Bead.locked()."""
    found = ffi.new("fst_locked_list *")
    with Watch(progress, title="locked") as watch:
        watch.call(lib.fst_locked_find, bead._params, watch.told, found)
    return LockedStates(bead, ffi.gc(found, lib.fst_locked_free))


# ---------------------------------------------------------------------------------------- Lyapunov exponents


class Lyapunov(Shown, Told):
    """The spectrum of Lyapunov exponents, falling, in gamma."""

    def __init__(self, bead: Bead, found: Any) -> None:
        self.bead, self._found = bead, found
        self.exponents = state_of(found.exponents)
        self.errors = state_of(found.errors)
        #: The greatest of the errors.
        self.error = float(found.error)
        self.converged = bool(found.converged)
        #: The index of the exponent of the flow; None at an equilibrium.
        self.flow_direction = int(found.flow_direction) if found.flow_direction >= 0 else None
        #: The mean divergence of the flow, which equals the sum of the exponents; NaN where the bead flew, because impacts contract too.
        self.divergence = float(found.divergence)
        self.time = float(found.time)
        count = found.trace_count
        #: Running means of the exponents at the times `trace_time`.
        self.trace_time = state_of(list(found.trace_time)[:count])
        self.trace = lent(np.array([list(row) for row in found.trace][:count]))

    def _table(self, units: Optional[str]) -> Table:
        scales = scales_of(self.bead._params, units)
        values = {"exponents": self.exponents, "errors": self.errors}
        columns = scaled_columns(("exponent",), values, {"exponents": "gamma", "errors": "gamma"}, scales)
        time = scaled_columns(("trace_time",), {"trace_time": self.trace_time}, {"trace_time": "1/gamma"}, scales)["trace_time"]
        factor, unit = scales.factor("trace", "gamma")
        trace = self.trace.reshape(len(self.trace_time), len(self.exponents)).T * factor
        columns["trace"] = Column(("exponent", "trace_time"), trace, unit, "running means of the exponents")
        coords = {"exponent": Column(("exponent",), np.arange(len(self.exponents))), "trace_time": time}
        return Table(("exponent",), coords, columns, about(self.bead.scene()))

    def to_dict(self) -> Dict[str, Any]:
        """What `festoon lyapunov --json` prints.

        Returns
        -------
        dict
            Keys and numbers as the program prints them; None where a number is undefined.

        Raises
        ------
        OutOfMemory
            Where there is no memory for it.
        """
        text: Dict[str, Any] = json.loads(take_text(lib.fst_lyapunov_json(self.bead._params, self._found)))
        return text

    def __reduce__(self) -> Any:
        return _lyapunov_again, (self.bead, image_of(self._found))

    def __repr__(self) -> str:
        pairs = ", ".join(f"{x:.4g}+-{e:.2g}" for x, e in zip(self.exponents, self.errors))
        return f"Lyapunov: {pairs}" + ("" if self.converged else " (not converged)")


def _lyapunov_again(bead: Bead, image: Any) -> Lyapunov:
    return Lyapunov(bead, struct_of(image))


def lyapunov(bead: Bead, progress: Progress) -> Lyapunov:
    """See Bead.lyapunov()."""
    found = ffi.new("fst_lyapunov *")
    with Watch(progress, title="lyapunov") as watch:
        watch.call(lib.fst_lyapunov_find, bead._params, watch.told, found)
    return Lyapunov(bead, found)
