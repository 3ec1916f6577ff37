"""What several beads do for ever: periodic orbits, locked states with eigenvalues, and their branches."""

import json
from typing import TYPE_CHECKING, Any, Dict, List, Mapping, Optional, Tuple

import numpy as np

from ._errors import BadInput
from ._keys import known_key, row_of
from ._native import Watch, ffi, lent, lib, options_of, take_text
from ._pickled import Printed
from ._progress import Progress
from ._quantities import units_of
from ._tabled import NUMBERS, Column, Shown, Table, about, numbers_of, scaled_columns, scales_of
from .branches import SpecialPoint, range_of

if TYPE_CHECKING:
    from .bead import Bead


def _numbers(pairs: Any) -> Any:
    return lent(np.array([complex(*pair) for pair in pairs]))


#: Units of what is told of beads and of all together.
UNITS = {"r": "l", "mean_r": "l", "mean_alpha_dot": "gamma", "phi_deg": "deg", "load_weights": "m g", "period": "1/gamma", "omega": "gamma",
         "power": "l^2 gamma^3", "eigenvalues": "gamma", "multipliers": "1", "residual": "1"}


class _Found(Shown, Printed):
    """What was found of several beads.  Its numbers are scaled (l, 1/gamma); the program prints the same with --json."""

    #: What was asked: `Beads`, or a bead in a world.
    setup: "Bead"

    def __init__(self, setup: "Bead", told: Dict[str, Any]) -> None:
        self.setup, self._told = setup, told

    def __reduce__(self) -> Any:
        return type(self), (self.setup, self._told)

    def _of_beads(self, rows: Tuple[str, ...], beads: Any, units: Optional[str], **of_all: Any) -> Table:
        """A table of lists of beads, one for each of the further rows, and of what all beads of a row share."""
        shape = np.shape(beads)
        dims, flat = (*rows, "bead"), [bead for row in (beads if rows else [beads]) for bead in row]
        names = [name for name in flat[0] if name not in ("state", "n", "w", "z")]  # which the state has too
        values = {name: np.array([bead[name] for bead in flat]).reshape(shape) for name in names}
        values.update(numbers_of(np.array([bead["state"] for bead in flat]).reshape(*shape, len(NUMBERS))))
        scales = scales_of(self.setup._params, units)
        columns = scaled_columns(rows, of_all, UNITS, scales)
        columns.update(scaled_columns(dims, values, {**UNITS, **NUMBERS}, scales))
        coords = {name: Column((name,), np.arange(count)) for name, count in zip(dims, shape)}
        return Table(dims, coords, columns, about(self.setup.scene()))


class _Orbit(_Found):
    """What motions that repeat themselves have in common."""

    @property
    def period(self) -> float:
        """After which the motion repeats itself [1/gamma]: of a world that of the drive."""
        return float(self._told["period"])

    @property
    def stable(self) -> bool:
        """Whether every multiplier is inside the unit circle."""
        return bool(self._told["stable"])

    @property
    def multipliers(self) -> Any:
        """Of the directions in which beads can move, the largest first; of half a period where that exchanges beads."""
        return _numbers(self._told["multipliers"])


class BeadsOrbit(_Orbit):
    """A periodic orbit of several beads in the magnet's frame, with the same contacts all the way."""

    @property
    def symmetry(self) -> str:
        """exchange: two beads change places in half a period; S2: the image of one is the orbit itself; or none."""
        return str(self._told["symmetry"])

    @property
    def beads(self) -> List[Dict[str, Any]]:
        """Of each bead mean_r [l], mean_alpha_dot [gamma] and the twelve numbers of a state on the orbit."""
        return [{**bead, "state": lent(np.array(bead["state"]))} for bead in self._told["beads"]]

    def _table(self, units: Optional[str]) -> Table:
        return self._of_beads((), self._told["beads"], units, period=self.period, multipliers=self.multipliers)

    def __repr__(self) -> str:
        beads = ", ".join(f"<r> {bead['mean_r']:.6g} l, <alpha'> {bead['mean_alpha_dot']:.6g} gamma" for bead in self.beads)
        return f"BeadsOrbit: {'stable' if self.stable else 'unstable'}, period {self.period:.6g} 1/gamma; {beads}"


class BeadsLocked(_Found):
    """A state in which several beads turn with the magnet."""

    @property
    def _state(self) -> Dict[str, Any]:
        return self._told["states"][0]  # type: ignore[no-any-return]

    @property
    def stable(self) -> bool:
        """Whether no eigenvalue is on the right."""
        return bool(self._state["stable"])

    @property
    def eigenvalues(self) -> Any:
        """Of the linearised motion [gamma], by falling real part."""
        return _numbers(self._state["eigenvalues"])

    @property
    def power(self) -> float:
        """Of the drive, per mass of the first bead [l^2 gamma^3]."""
        return float(self._state["power"])

    @property
    def beads(self) -> List[Dict[str, Any]]:
        """Of each bead r and z [l], phi_deg, n, w [gamma], load_weights and the twelve numbers of its state."""
        return [{**bead, "state": lent(np.array(bead["state"]))} for bead in self._state["beads"]]

    @property
    def pair_forces(self) -> List[Dict[str, Any]]:
        """Contacts between beads: a and b (numbers from 0) and force [l gamma^2]."""
        return [dict(pair) for pair in self._state["pair_forces"]]

    def _table(self, units: Optional[str]) -> Table:
        state = self._state
        of_all = {"power": self.power, "residual": state["residual"], "eigenvalues": self.eigenvalues}
        return self._of_beads((), state["beads"], units, stable=self.stable, **of_all)

    def __repr__(self) -> str:
        words = "stable" if self.stable else "unstable"
        count = len(self._state["beads"])
        return f"BeadsLocked: {count} bead{'s' if count > 1 else ''}, {words}, power {self.power:.6g} l^2 gamma^3"


class BeadsSpecial(Dict[str, Any], SpecialPoint):
    """A special point of such a branch: what the program prints of it, as items and attributes."""

    #: fold, hopf, contact, ...
    type: str
    #: The key of the parameter, and its value in the unit of the key.
    parameter: str
    value: float
    #: The drive [gamma].
    omega: float
    #: The locked state there, as one of `BeadsBranch.points`.
    at: Dict[str, Any]

    def __getattr__(self, name: str) -> Any:
        if name not in self:
            raise AttributeError(f"a special point has no {name}; it has {', '.join(self)}")
        return self[name]

    def __repr__(self) -> str:
        return f"BeadsSpecial: {self.type} at {self.parameter} = {self.value:.9g}"


class BeadsBranch(_Found):
    """Locked states of several beads over one parameter."""

    @property
    def parameter(self) -> str:
        """Its key."""
        return str(self._told["parameter"])

    @property
    def values(self) -> Any:
        """The parameter along the branch, in the unit of the key."""
        return lent(np.array([point["value"] for point in self._told["points"]]))

    @property
    def stable(self) -> Any:
        """Of each point, whether no eigenvalue is on the right."""
        return lent(np.array([point["stable"] for point in self._told["points"]]))

    @property
    def points(self) -> List[Dict[str, Any]]:
        """As the program prints them."""
        return [dict(point) for point in self._told["points"]]

    @property
    def specials(self) -> List[BeadsSpecial]:
        """Where it bends, sways or breaks: type (fold, hopf, contact, ...) and value, and the state there."""
        return [BeadsSpecial(special) for special in self._told["specials"]]

    def _table(self, units: Optional[str]) -> Table:
        points = self._told["points"]
        of_all: Dict[str, Any] = {name: np.array([point[name] for point in points]) for name in ("value", "omega", "power", "residual")}
        most = max(len(point["eigenvalues"]) for point in points)
        of_all["eigenvalues"] = np.full((len(points), most), np.nan * 1j)
        for i, point in enumerate(points):
            of_all["eigenvalues"][i, : len(point["eigenvalues"])] = _numbers(point["eigenvalues"])
        made = self._of_beads(("point",), [point["beads"] for point in points], units, stable=self.stable, **of_all)
        value, unit = scales_of(self.setup._params, units).of_parameter(self.parameter, of_all["value"])
        made.columns["value"] = Column(("point",), value, unit, row_of(self.parameter)[2], self.parameter)
        return made

    def __repr__(self) -> str:
        specials = ", ".join(f"{special.type} at {special.value:.6g}" for special in self.specials)
        return f"BeadsBranch: {len(self.values)} points over {self.parameter}; {specials or 'no special point'}"


class WorldOrbit(_Orbit):
    """A motion of one bead that repeats itself with the drive, in fields of the laboratory or under an unsteady magnet."""

    @property
    def frame(self) -> str:
        """Whose axes the state is on: turning or laboratory."""
        return str(self._told["frame"])

    @property
    def state(self) -> Any:
        """Twelve numbers at the start of a period: X Y Z vX vY vZ nX nY nZ WX WY WZ."""
        return lent(np.array(self._told["state"]))

    @property
    def residual(self) -> float:
        """Greatest difference of the state after a period [scaled]."""
        return float(self._told["residual"])

    def _table(self, units: Optional[str]) -> Table:
        """One row."""
        values = {name: getattr(self, name) for name in ("period", "stable", "multipliers", "residual")}
        values.update(numbers_of(self.state))
        columns = scaled_columns((), values, {**UNITS, **NUMBERS}, scales_of(self.setup._params, units))
        return Table((), {}, {"frame": Column((), self.frame), **columns}, about(self.setup.scene()))

    def __repr__(self) -> str:
        return f"WorldOrbit: {'stable' if self.stable else 'unstable'}, period {self.period:.6g} 1/gamma, {self.frame} frame"


class FloatingStates(_Found):
    """Places where a bead without a plate floats, at rest in the turning frame; stable ones first, then by height."""

    @property
    def states(self) -> List[Dict[str, Any]]:
        """Of each place position_m, n, w (1/s), height_mm, tilt_deg, circle_mm, gap_mm, stable, family and eigenvalues_per_s."""
        return [{**place, "eigenvalues_per_s": _numbers(place["eigenvalues_per_s"])} for place in self._told["states"]]

    def __len__(self) -> int:
        return len(self._told["states"])

    def _table(self, units: Optional[str]) -> Table:
        """Where a name says the unit it is that one, whatever is asked for."""
        known = {"height_mm": "mm", "circle_mm": "mm", "gap_mm": "mm", "tilt_deg": "deg", "position_m": "m", "w": "1/s",
                 "residual": "1", "eigenvalues_per_s": "1/s"}
        columns = {}
        for name in [key for key in self._told["states"][0] if key not in ("n", "state")] if len(self) else ():
            values = np.array([place[name] for place in self.states])
            columns[name] = Column(("place", *([f"number_of_{name}"] if values.ndim > 1 else [])), values, known.get(name, ""))
        state = numbers_of(np.array([place["state"] for place in self.states]).reshape(len(self), len(NUMBERS)))
        columns.update(scaled_columns(("place",), state, NUMBERS, scales_of(self.setup._params, units)))
        return Table(("place",), {"place": Column(("place",), np.arange(len(self)))}, columns, about(self.setup.scene()))

    def __repr__(self) -> str:
        lines = [f"  height {one['height_mm']:.6g} mm, {'stable' if one['stable'] else 'unstable'}" for one in self.states]
        return "\n".join([f"FloatingStates: {len(self)} places", *lines])


def _ask(setup: "Bead", progress: Progress, title: str, find: Any, found: Any, to_json: Any, *more: int) -> Dict[str, Any]:
    options = options_of(lib.fst_default_beads_options())
    with Watch(progress, title=title) as watch:
        options.progress = watch.told
        watch.call(find, setup._params, options, *found)
    told: Dict[str, Any] = json.loads(take_text(to_json(setup._params, found[-1], *more)))
    return told


def orbit(setup: "Bead", progress: Progress) -> BeadsOrbit:
    """See Beads.orbit()."""
    found = ffi.new("fst_beads_orbit *")
    return BeadsOrbit(setup, _ask(setup, progress, "orbit", lib.fst_beads_orbit_scene, (found,), lib.fst_beads_orbit_json, units_of("scaled")))


def locked(setup: "Bead", progress: Progress) -> BeadsLocked:
    """See Beads.locked()."""
    found = ffi.new("fst_beads_locked *")
    return BeadsLocked(setup, _ask(setup, progress, "locked", lib.fst_beads_locked_scene, (found,), lib.fst_beads_locked_json, units_of("scaled")))


def world_orbit(setup: "Bead", progress: Progress) -> WorldOrbit:
    """See Bead.orbit()."""
    found = ffi.new("fst_world_orbit *")
    return WorldOrbit(setup, _ask(setup, progress, "orbit", lib.fst_world_orbit_find, (found,), lib.fst_world_orbit_json, units_of("scaled")))


def floating(setup: "Bead", progress: Progress) -> FloatingStates:
    """See Bead.locked()."""
    found = ffi.gc(ffi.new("fst_levitation_list *"), lib.fst_levitation_free)
    with Watch(progress, title="locked") as watch:
        watch.call(lib.fst_levitation_find, setup._params, watch.told, found)
    return FloatingStates(setup, json.loads(take_text(lib.fst_levitation_json(setup._params, found))))


def branch(setup: "Bead", progress: Progress, ranges: Mapping[str, Any]) -> BeadsBranch:
    """See Beads.branch()."""
    if len(ranges) != 1:
        raise BadInput("branch", 'give the range of one parameter, as in frequency=("20 Hz", "400 Hz")')
    key, (low, high) = next((known_key(name), range_of(known_key(name), value)) for name, value in ranges.items())
    found = ffi.gc(ffi.new("fst_beads_branch *"), lib.fst_beads_branch_free)
    asked = (key.encode(), low, high, found)
    return BeadsBranch(setup, _ask(setup, progress, "branch", lib.fst_beads_branch_scene, asked, lib.fst_beads_branch_json, units_of("scaled")))
