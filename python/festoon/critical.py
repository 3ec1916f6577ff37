"""The critical speed: from which drive on does the bead circle against the magnet?"""

import json
from typing import Any, Dict, NamedTuple, Optional, Tuple

import numpy as np

from ._given import word_of
from ._native import Watch, ffi, lib, take_text
from ._pickled import Told
from ._progress import Progress
from ._quantities import units_of
from ._tabled import Column, Shown, Table, about, scales_of
from .bead import Bead


class Stretch(NamedTuple):
    """Neighbouring runs with one outcome: the drive of the first and of the last, the regime, the number of runs."""

    begin: float
    end: float
    regime: str
    runs: int


class Critical(Shown, Told):
    """The critical speed and the runs that enclose it; see docs/orbits.md, "The critical speed"."""

    def __init__(self, bead: Bead, told: Dict[str, Any]) -> None:
        self.bead, self._told = bead, told
        #: "drive.frequency" (values in Hz) or "drive.omega" (in gamma).
        self.key: str = told["key"]
        #: Why there is no critical speed in the range; None where there is one.
        self.reason = told["reason"]
        #: The critical speed and its error; None where there is none in the range.
        self.value, self.error = told["value"], told["error"]
        #: The type of the branch's special point that it is, as "origin-crossing"; None where runs enclose it.
        self.special = told["special"]
        #: The regimes on either side.
        self.below, self.above = told["below"], told["above"]
        #: The last run that circles against the magnet before one that does otherwise or is undecided; None: none is found.
        self.until = told["until"]
        #: Up to here the bead goes with the magnet in all runs, and the error; None: in none, or in all.
        self.parting, self.parting_error = told["parting"], told["parting_error"]
        #: All runs, in order of the drive.
        self.stretches: Tuple[Stretch, ...] = tuple(
            Stretch(row["from"], row["to"], row["regime"], row["runs"]) for row in told["stretches"]
        )

    def _table(self, units: Optional[str]) -> Table:
        """Its stretches."""
        columns, scales = {}, scales_of(self.bead._params, units)
        for name in Stretch._fields:
            values, unit = np.array([getattr(one, name) for one in self.stretches]), ""
            if name in ("begin", "end"):
                values, unit = scales.of_parameter(self.key, values)
            columns[name] = Column(("stretch",), values, unit)
        stretch = Column(("stretch",), np.arange(len(self.stretches)))
        return Table(("stretch",), {"stretch": stretch}, columns, about(self.bead.scene(), parameter=self.key))

    def to_dict(self) -> Dict[str, Any]:
        """What `festoon critical --json` prints.

        Returns
        -------
        dict
            Keys and numbers as the program prints them; None where a number is undefined.

        Raises
        ------
        Nothing.
        """
        return dict(self._told)

    def __repr__(self) -> str:
        if self.value is None:
            return f"Critical: none from {self.stretches[0].begin:g} to {self.stretches[-1].end:g}: {self.reason}"
        return f"Critical: {self.key} = {self.value:.10g} +- {self.error:.2g}, {self.below} below"


def critical(bead: Bead, over: str, tolerance: float, progress: Progress) -> Critical:
    """See Bead.critical()."""
    found = ffi.gc(ffi.new("fst_critical *"), lib.fst_critical_free)
    axis = ffi.new("char[]", word_of(over, "over"))
    options = ffi.new("fst_critical_options *", lib.fst_default_critical_options())
    options.over, options.tolerance = axis, tolerance
    with Watch(progress, title="critical") as watch:
        options.progress = watch.told
        watch.call(lib.fst_critical_find, bead._params, options, found)
    return Critical(bead, json.loads(take_text(lib.fst_critical_json(bead._params, found, units_of("scaled")))))
