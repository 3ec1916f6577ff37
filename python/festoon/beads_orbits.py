"""What several beads do for ever: periodic orbits, locked states with eigenvalues, and their branches."""

import json
from typing import TYPE_CHECKING, Any, Dict, List, Mapping, Optional, Tuple

import numpy as np

from ._errors import BadInput
from ._keys import known_key, row_of
from ._native import Watch, ffi, lent, lib, options_of, take_text
from ._pickled import Printed
from ._progress import Progress
from ._tabled import NUMBERS, Column, Shown, Table, about, numbers_of, scaled_columns, scales_of
from .branches import range_of

if TYPE_CHECKING:
    from .beads import Beads


def _numbers(pairs: Any) -> Any:
    return lent(np.array([complex(*pair) for pair in pairs]))


#: Units of what is told of beads and of all together.
UNITS = {"r": "l", "mean_r": "l", "mean_alpha_dot": "gamma", "phi_deg": "deg", "load_weights": "m g", "period": "1/gamma", "omega": "gamma",
         "power": "l^2 gamma^3", "eigenvalues": "gamma", "multipliers": "1", "residual": "1"}


class _Found(Shown, Printed):
    """What was found of several beads.  Its numbers are scaled (l, 1/gamma); the program prints the same with --json."""

    #: The beads that were asked.
    setup: "Beads"

    def __init__(self, setup: "Beads", told: Dict[str, Any]) -> None:
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


class BeadsOrbit(_Found):
    """A periodic orbit of several beads in the magnet's frame, with the same contacts all the way."""

    @property
    def period(self) -> float:
        """Of the orbit [1/gamma]."""
        return float(self._told["period"])

    @property
    def symmetry(self) -> str:
        """exchange: two beads change places in half a period; S2: the image of one is the orbit itself; or none."""
        return str(self._told["symmetry"])

    @property
    def stable(self) -> bool:
        """Whether every multiplier is inside the unit circle."""
        return bool(self._told["stable"])

    @property
    def multipliers(self) -> Any:
        """The largest first; of half a period where that exchanges beads."""
        return _numbers(self._told["multipliers"])

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
        return f"BeadsLocked: {len(self._state['beads'])} beads, {words}, power {self.power:.6g} l^2 gamma^3"


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
    def specials(self) -> List[Dict[str, Any]]:
        """Where it bends, sways or breaks: type (fold, hopf, contact, ...) and value, and the state there."""
        return [dict(special) for special in self._told["specials"]]

    def _table(self, units: Optional[str]) -> Table:
        points = self._told["points"]
        of_all: Dict[str, Any] = {name: np.array([point[name] for point in points]) for name in ("value", "omega", "power", "residual")}
        most = max(len(point["eigenvalues"]) for point in points)
        of_all["eigenvalues"] = np.full((len(points), most), np.nan * 1j)
        for i, point in enumerate(points):
            of_all["eigenvalues"][i, : len(point["eigenvalues"])] = _numbers(point["eigenvalues"])
        made = self._of_beads(("point",), [point["beads"] for point in points], units, stable=self.stable, **of_all)
        _, unit, doc = row_of(self.parameter)
        made.columns["value"] = made.columns["value"]._replace(unit=unit, doc=doc, title=self.parameter)
        return made

    def __repr__(self) -> str:
        specials = ", ".join(f"{special['type']} at {special['value']:.6g}" for special in self.specials)
        return f"BeadsBranch: {len(self.values)} points over {self.parameter}; {specials or 'no special point'}"


def _ask(setup: "Beads", progress: Progress, title: str, find: Any, found: Any, to_json: Any) -> Dict[str, Any]:
    options = options_of(lib.fst_default_beads_options())
    with Watch(progress, title=title) as watch:
        options.progress = watch.told
        watch.call(find, setup._params, options, *found)
    told: Dict[str, Any] = json.loads(take_text(to_json(setup._params, found[-1])))
    return told


def orbit(setup: "Beads", progress: Progress) -> BeadsOrbit:
    """See Beads.orbit()."""
    found = ffi.new("fst_beads_orbit *")
    return BeadsOrbit(setup, _ask(setup, progress, "orbit", lib.fst_beads_orbit_scene, (found,), lib.fst_beads_orbit_json))


def locked(setup: "Beads", progress: Progress) -> BeadsLocked:
    """See Beads.locked()."""
    found = ffi.new("fst_beads_locked *")
    return BeadsLocked(setup, _ask(setup, progress, "locked", lib.fst_beads_locked_scene, (found,), lib.fst_beads_locked_json))


def branch(setup: "Beads", progress: Progress, ranges: Mapping[str, Any]) -> BeadsBranch:
    """See Beads.branch()."""
    if len(ranges) != 1:
        raise BadInput("branch", 'give the range of one parameter, as in frequency=("20 Hz", "400 Hz")')
    key, (low, high) = next((known_key(name), range_of(known_key(name), value)) for name, value in ranges.items())
    found = ffi.gc(ffi.new("fst_beads_branch *"), lib.fst_beads_branch_free)
    asked = (key.encode(), low, high, found)
    return BeadsBranch(setup, _ask(setup, progress, "branch", lib.fst_beads_branch_scene, asked, lib.fst_beads_branch_json))
