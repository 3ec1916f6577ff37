"""Branches of orbits and of locked states."""

import json
import math
from typing import Any, Dict, Iterator, List, Mapping, Optional, Tuple

import numpy as np

from ._errors import BadInput, FestoonError, MaterialWarning, warn
from ._given import number_of, whole_of
from ._keys import keyword_of, known_key, row_of
from ._native import (
    Watch,
    call,
    dtype_of,
    ffi,
    lent,
    lib,
    options_of,
    owned_array,
    path_bytes,
    state_of,
    strings,
    take_text,
    text_of,
)
from ._pickled import Told, image_of, struct_of
from ._progress import Progress
from ._quantities import Scales, quantity, units_of
from ._tabled import OF_PLATE, NUMBERS, Column, Shown, Table, Tabled, about, numbers_of, scaled_columns
from .bead import Bead
from .orbits import Path, _choose, _names, _Single
from .runs import SYMMETRIES
from .sweeps import grid_of



def _observables() -> Iterator[Any]:
    number = 0
    while lib.fst_branch_observable_at(number):
        yield lib.fst_branch_observable_at(number)
        number += 1


KINDS = _names(lib.fst_branch_kind_name, lib.FST_BRANCH_COUNT)
SPECIALS = _names(lib.fst_special_name, lib.FST_SPECIAL_COUNT)
ENDS = _names(lib.fst_end_name, lib.FST_END_COUNT)


#: Units of the numbers of a point; those of the parameters follow from their keys.
UNITS = {text_of(row.name).replace("phi_deg", "bead_angle_deg"): text_of(row.unit) for row in _observables()}
UNITS.update(omega="gamma", height_mm="mm", circle_mm="mm", gap_mm="mm", position_m="m", w_per_s="1/s")


class SpecialPoint(Tabled):
    """What special points have in common: items that are attributes too, and a table of one row."""

    def _table(self, units: Optional[str]) -> Table:
        """The numbers and words, as the attributes have them."""
        if units not in (None, "scaled"):
            raise BadInput("units", "a special point is told in scaled units, its value in that of the parameter")
        told = {name: self[name] for name in self.keys()}  # type: ignore[attr-defined, index]
        return Table((), {}, {name: Column((), value, UNITS.get(name, "")) for name, value in told.items() if name not in ("at", "state")}, {})


class Special(_Single, SpecialPoint, Mapping[str, Any]):
    """A special point of a branch: fold, pitchfork, period-doubling, hopf, ..."""

    _NAMES = ("type", "parameter", "value", "omega", "branch", "criticality", "born", "state")

    def __getitem__(self, name: str) -> Any:
        if name not in self._NAMES:
            raise KeyError(name)
        return getattr(self, name)

    def __iter__(self) -> Iterator[str]:
        return iter(self._NAMES)

    def __len__(self) -> int:
        return len(self._NAMES)

    def __init__(self, special: Any, parameter: str, owner: Any) -> None:
        self._struct = self._special = special
        self._owner = owner
        self.type = SPECIALS[special.type]
        self.parameter = parameter
        self.value = float(special.value)
        self.omega = float(special.omega)
        self.branch = int(special.branch)
        #: supercritical, subcritical, or None where it is undecided or meaningless
        self.criticality = {1: "supercritical", -1: "subcritical"}.get(int(special.criticality))
        #: The branch that leaves here, or None.
        self.born = int(special.born) if special.born >= 0 else None

    @property
    def state(self) -> Any:
        """X Y vX vY nX nY nZ WX WY WZ; of a bead in a world with Z and vZ."""
        at = self._special.at
        return state_of(at.levitation.state if any(at.levitation.state) else at.state)

    def __reduce__(self) -> Any:
        return _special_again, (image_of(self._special), self.parameter)

    def __repr__(self) -> str:
        return f"Special: {self.type} at {self.parameter} = {self.value:.9g}, branch {self.branch}"


def _special_again(image: Any, parameter: str) -> Special:
    return Special(struct_of(image), parameter, None)


class BranchEnd:
    """An end of a branch, and why it ends there."""

    def __init__(self, end: Any) -> None:
        self.branch = int(end.branch)
        self.type = ENDS[end.type]
        self.value = float(end.value)
        self.reason = text_of(end.reason)
        self.family = int(end.family) if end.family >= 0 else None
        self.image = int(end.image) if end.image >= 0 else None

    def __eq__(self, other: object) -> bool:
        return isinstance(other, BranchEnd) and self.__dict__ == other.__dict__

    def __hash__(self) -> int:
        return hash((self.branch, self.type, self.value))

    def __repr__(self) -> str:
        return f"BranchEnd: branch {self.branch} at {self.value:.9g}, {self.type}: {self.reason}"


class Branch(Shown, Told):
    """Families of orbits or of locked states over a parameter.

    `points` is an array over the library's memory, its fields those of fst_branch_point: value, omega, mean_r,
    stable, branch, ...; the fields are attributes too, and of places where a bead floats those of `levitation`:
    height_mm, tilt_deg, circle_mm, gap_mm, ...
    """

    def __init__(self, branch: Any, bead: Optional[Bead]) -> None:
        self._branch = branch
        #: The bead, None of a branch that was read from a file.
        self.bead = bead
        self.kind = KINDS[branch.kind]
        self.key = text_of(branch.key)
        self.second_key = text_of(branch.second_key) or None
        self.range = (float(getattr(branch, "from")), float(branch.to))
        self.complete = bool(branch.complete)
        self.points = owned_array(branch.points, branch.point_count, dtype_of("fst_branch_point"), branch)
        self.specials = [
            Special(branch.specials[i], self.key, branch) for i in range(branch.special_count)
        ]
        self.ends = [BranchEnd(branch.ends[i]) for i in range(branch.end_count)]
        self.count = int(branch.branches)

    def __getattr__(self, name: str) -> Any:
        points = self.__dict__.get("points")
        if points is not None and name in points.dtype.names:
            return points[name]
        if points is not None and self.kind == "levitating" and name in points["levitation"].dtype.names:
            return points["levitation"][name]
        raise AttributeError(name)

    def __dir__(self) -> List[str]:
        floats = self.points["levitation"].dtype.names if self.kind == "levitating" else ()
        return [*super().__dir__(), *self.points.dtype.names, *floats]

    def __reduce__(self) -> Any:
        return _branch_again, (image_of(self._branch), self.bead)

    def __len__(self) -> int:
        return len(self.points)

    def __iter__(self) -> Iterator[Any]:
        """The points of each branch, an array each."""
        for number in range(self.count):
            yield self.points[self.points["branch"] == number]

    @property
    def keyword(self) -> str:
        """The parameter as a keyword."""
        return keyword_of(self.key)

    @property
    def multipliers(self) -> Any:
        """Multipliers or eigenvalues of each point, NaN beyond their number; of places where a bead floats in 1/s."""
        if self.kind == "levitating":
            return lent(self.eigenvalue_re + 1j * self.eigenvalue_im)
        values = self.points["multiplier_re"] + 1j * self.points["multiplier_im"]
        values[np.arange(values.shape[1]) >= self.points["multipliers"][:, None]] = np.nan
        return lent(values)

    def _scales(self, units: Optional[str]) -> Scales:
        """Those of the bead, or of the file from which the branch was read, as far as it tells them."""
        if self.bead is not None or self._branch.scene:
            return Scales(self.bead._params if self.bead is not None else self._branch.scene, units or "scaled")
        scales = ffi.new("fst_scales *", [self._branch.half_length, 1.0 / self._branch.gamma, math.nan, math.nan])
        return Scales(scales[0], units or "scaled")

    def _table(self, units: Optional[str]) -> Table:
        values, floats = {}, self.kind == "levitating"
        for source in (self.points, self.points["levitation"]) if floats else (self.points,):
            for name in source.dtype.names:
                if name not in ("levitation", "state", "multipliers") and not name.endswith(("_re", "_im")):
                    values[name] = source[name]
        values["symmetry"] = np.array([name or "" for name in SYMMETRIES])[values["symmetry"]]
        values["stable"] = values["stable"].astype(bool)
        if self.second_key is None:
            del values["second"]
        at_rest = self.kind != "driven" and bool(np.all(self.points["multipliers"] == lib.FST_EIGENVALUE_COUNT))
        eigen = "1/s" if floats else "gamma" if at_rest else "1"
        values["multipliers" if eigen == "1" else "eigenvalues"] = self.multipliers
        in_three = np.any(self.points["levitation"]["state"])
        states = numbers_of(self.points["levitation"]["state"]) if in_three else numbers_of(self.points["state"], OF_PLATE)
        known = {**UNITS, **NUMBERS, "multipliers": "1", "eigenvalues": eigen}
        scales = self._scales(units)
        made = scaled_columns(("point",), {**values, **states}, known, scales)
        for name, key in (("value", self.key), ("second", self.second_key)):
            if name in made and key:
                shown, unit = scales.of_parameter(key, values[name])
                made[name] = Column(("point",), shown, unit, row_of(key)[2], key)
        point = Column(("point",), np.arange(len(self)), "", "number of the point")
        scene = "" if self.bead is None else self.bead.scene()
        return Table(("point",), {"point": point}, made, about(scene, kind=self.kind, parameter=self.key))

    def save(self, path: Path) -> None:
        """Write the branch as JSON, which the program and festoon.read() read.

        Parameters
        ----------
        path
            The file, .json.

        Raises
        ------
        InputOutput
            Where the file cannot be written.
        """
        bead = self.bead or Bead()
        call(lib.fst_branch_write, path_bytes(path), bead._params, self._branch)

    def to_dict(self) -> Dict[str, Any]:
        """What `festoon branch --json` prints.

        Returns
        -------
        dict
            Keys and numbers as the program prints them; None where a number is undefined.

        Raises
        ------
        OutOfMemory
            Where there is no memory for it.
        """
        bead = self.bead or Bead()
        text: Dict[str, Any] = json.loads(take_text(lib.fst_branch_json(bead._params, self._branch, units_of("scaled"))))
        return text

    def plot(self, y: str = "mean_r", **options: Any) -> Any:
        """Draw the branch with matplotlib; returns its Axes: see `festoon.plots.branch`.

        Parameters
        ----------
        y
            What is drawn.
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

        return plots.branch(self, y, **options)

    def figure(self, path: Path, observable: Optional[str] = None, **options: Any) -> None:
        """The program's figure as .svg, .pdf or .png.

        Parameters
        ----------
        path
            The picture.
        observable
            What is drawn; by default mean_r.
        **options
            units ("given", "lab", "scaled", "si") and dots, pairs of numbers that are drawn too.

        Raises
        ------
        BadInput
            Where the ending of the path, or an option, is wrong.
        Unavailable
            Where gnuplot or the ending's converter is missing.
        """
        from . import figures

        figures.branch(self, path, observable, **options)

    def __repr__(self) -> str:
        head = f"Branch: {self.kind} over {self.key}, {len(self)} points on {self.count} branches"
        head += "" if self.complete else " (interrupted)"
        return "\n".join([head, *(f"  {special!r}" for special in self.specials)])


def _branch_again(image: Any, bead: Optional[Bead]) -> Branch:
    return Branch(struct_of(image), bead)


def range_of(key: str, value: Any) -> Tuple[float, float]:
    """The range of a key, in the unit of its numbers."""
    place = lib.fst_param_find(key.encode())
    if place < 0:
        # The sentence names the nearest key.
        params = ffi.new("fst_params *", lib.fst_default_params())
        call(lib.fst_params_set, params, key.encode(), b"0")
    try:
        low, high = value
    except (TypeError, ValueError):
        raise BadInput("branch", f"{keyword_of(key)} must be a range (LO, HI)") from None
    unit = lib.fst_param_at(place).unit
    return quantity(low, unit, key), quantity(high, unit, key)


def _warn(bead: Bead, key: str, ends: Tuple[float, float]) -> None:
    """Warn if the bead of either end is of no material, as the program does."""
    sentence = ffi.new("char[]", 512)
    try:
        grid = grid_of(bead, [f"{key}={ends[0]!r},{ends[1]!r}"], 0)
    except FestoonError:
        return  # the branch itself says what is wrong
    if lib.fst_grid_contradiction(grid, sentence, 512):
        warn(text_of(sentence), MaterialWarning)


def branch(bead: Bead, kind: str, progress: Progress, keywords: Mapping[str, Any]) -> Branch:
    """See Bead.branch()."""
    options = options_of(lib.fst_default_branch_options())
    options.kind = _choose(kind, KINDS, "kind")
    ranges: List[Tuple[str, Tuple[float, float]]] = []
    for name, value in keywords.items():
        if name == "special":
            options.special = _choose(value, SPECIALS, "special")
        elif name == "follow":
            options.follow = whole_of(value, name, 1)
        elif name in ("tolerance", "step"):
            setattr(options, "longest_step" if name == "step" else name, number_of(value, name))
        else:
            ranges.append((known_key(name), range_of(known_key(name), value)))
    if not 1 <= len(ranges) <= 2:
        raise BadInput("branch", "give the range of one parameter, as in omega=(0.15, 0.6), or of two")
    _warn(bead, *ranges[0])
    words, kept = strings([key for key, _ in ranges])
    options.key = words[0]
    setattr(options, "from", ranges[0][1][0])
    options.to = ranges[0][1][1]
    if len(ranges) == 2:
        options.second_key = words[1]
        options.second_from, options.second_to = ranges[1][1]
    found = ffi.gc(ffi.new("fst_branch *"), lib.fst_branch_free)
    with Watch(progress, lambda: Branch(found, bead), "branch") as watch:
        options.progress = watch.told
        watch.call(lib.fst_branch_follow, bead._params, options, found)
    del kept
    return Branch(found, bead)


def read_branch(path: Path) -> Branch:
    """Read a branch from JSON."""
    found = ffi.new("fst_branch *")
    call(lib.fst_branch_read, path_bytes(path), found)
    return Branch(ffi.gc(found, lib.fst_branch_free), None)
