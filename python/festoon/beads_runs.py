"""Runs of several beads, and of one bead in a world."""

import json
import math
import os
from typing import TYPE_CHECKING, Any, Dict, List, Optional, Sequence, Union

import numpy as np

from ._errors import BadInput
from ._native import Watch, call, ffi, lent, lib, options_of, path_bytes, take_text
from ._pickled import Printed
from ._progress import Progress
from ._quantities import quantity, units_of
from ._tabled import NUMBERS, Column, Shown, Table, about, data_of, frame_of, numbers_of, scaled_columns, scales_of
from ._tables import RESULTS
from .bead import Bead
from .beads_trajectories import trajectory_of

if TYPE_CHECKING:
    from .beads import Beads

#: Units of what is not named by its own: of the keys of a run, scaled.
UNITS = {"mean_r": "l", "mean_alpha_dot": "gamma", "ejected_at": "1/gamma", "centre_rate": "gamma", "axis_rate": "gamma",
         "force": "l gamma^2", "time": "1/gamma", "speed": "l gamma", "mean_load_weights": "m g", "mean_height": "l",
         **{f"final_{name}": unit for name, unit in NUMBERS.items()}}
FRAMES = ("beads", "groups", "contacts", "events", "powers")


def _number(value: Any) -> Any:
    return math.nan if value is None else value


class _Ran(Printed):
    """A run, with its samples where they were asked for."""

    trajectory: Any

    def _facts(self) -> Any:
        return [self._told, None if self.trajectory is None else self.trajectory.states.tobytes()]


class BeadsRun(Shown, _Ran):
    """The run of several beads: what `festoon run --json` prints, in scaled units (l, 1/gamma)."""

    #: The beads that ran.
    setup: "Beads"
    #: The samples, a `BeadsTrajectory`; None where none was asked for.
    trajectory: Any

    def __init__(self, setup: "Beads", told: Dict[str, Any], trajectory: Any = None) -> None:
        self.setup, self._told, self.trajectory = setup, told, trajectory

    @property
    def outcome(self) -> str:
        """apart, walker, bar, ring, cluster, ejected or undecided."""
        return str(self._told["outcome"])

    @property
    def reason(self) -> str:
        """Why this outcome."""
        return str(self._told["reason"])

    @property
    def sentence(self) -> str:
        """What the beads do, in one line."""
        return str(self._told["sentence"])

    @property
    def beads(self) -> List[Dict[str, Any]]:
        """Of each bead regime, mean_r [l], mean_alpha_dot [gamma], mean_load_weights [1], mean_height [l], ejected_at [1/gamma],
        and the twelve numbers of its final_state."""
        return [{**bead, "final_state": lent(np.array(bead["final_state"]))} for bead in self._filled("beads")]

    @property
    def groups(self) -> List[Dict[str, Any]]:
        """Beads that touch each other: kind (single, pair, chain, ring, cluster), members (numbers from 0), mean_r [l] of
        the centre, and the rates of the centre and of the axis [gamma]."""
        return self._filled("groups")

    @property
    def contacts(self) -> List[Dict[str, Any]]:
        """Contacts at the end: a and b (numbers from 0, b is None for the plate) and force [l gamma^2]."""
        return self._filled("contacts", ("b",))

    @property
    def events(self) -> List[Dict[str, Any]]:
        """The first events: time [1/gamma], kind (lift, land, touch, part, graze, press, ...), beads and speed [l gamma]."""
        return self._filled("events")

    @property
    def counts(self) -> Dict[str, int]:
        """How many events there were of each kind."""
        return dict(self._told["counts"])

    @property
    def powers(self) -> Dict[str, float]:
        """Means per mass of the first bead [l^2 gamma^3]: of the drive, and lost at the plate, in pairs and in impacts."""
        return {name: float(_number(value)) for name, value in self._told["powers"].items()}

    @property
    def energy_residual(self) -> float:
        """What the balance of energy leaves, over the whole run [l^2 gamma^2]."""
        return float(_number(self._told["energy_residual"]))

    @property
    def restitution(self) -> float:
        """Of impacts, as used [1]."""
        return float(_number(self._told["restitution"]))

    def _filled(self, what: str, kept: Sequence[str] = ()) -> List[Dict[str, Any]]:
        return [{name: value if name in kept else _number(value) for name, value in row.items()} for row in self._told[what]]

    def to_pandas(self, what: str = "beads", units: Optional[str] = None) -> Any:  # type: ignore[override]
        """A data frame of the beads, the groups, the contacts, the events or the powers.

        Parameters
        ----------
        what
            "beads", "groups", "contacts", "events" or "powers".
        units
            "scaled", "lab" or "si"; by default scaled.

        Returns
        -------
        pandas.DataFrame
            Units, scene and version are in its `attrs`.

        Raises
        ------
        BadInput
            Where there is no such table, or units are unknown.
        """
        return frame_of(self._rows_of(what, units))

    def to_xarray(self, what: str = "beads", units: Optional[str] = None) -> Any:  # type: ignore[override]
        """A data set of the beads, the groups, the contacts, the events or the powers.

        Parameters
        ----------
        what
            "beads", "groups", "contacts", "events" or "powers".
        units
            "scaled", "lab" or "si"; by default scaled.

        Returns
        -------
        xarray.Dataset
            Units are in the `attrs` of the variables.

        Raises
        ------
        BadInput
            Where there is no such table, or units are unknown.
        """
        return data_of(self._rows_of(what, units))

    def _table(self, units: Optional[str]) -> Table:
        return self._rows_of("beads", units)

    def _rows_of(self, what: str, units: Optional[str]) -> Table:
        if what in ("scaled", "lab", "si"):  # as of every other result
            what, units = "beads", what
        if what not in FRAMES:
            raise BadInput("to_pandas", f'unknown table "{what}"; there are {", ".join(FRAMES)}')
        one = what.removesuffix("s")
        rows: Any = [self.powers] if what == "powers" else getattr(self, what)
        values = {name: [row[name] for row in rows] for name in (rows[0] if rows else {})}
        if what == "beads":
            values.update(numbers_of(np.array(values.pop("final_state")), before="final_"))
        arrays: Dict[str, Any] = {}
        for name, column in values.items():
            words = isinstance(column[0], (list, str)) or None in column  # members of a group, a name, or the plate
            arrays[name] = np.array([", ".join(map(str, v)) if isinstance(v, list) else v for v in column], object) if words else np.array(column)
        known = about(self.setup.scene(), outcome=self.outcome)
        units_known = {**UNITS, **({name: "l^2 gamma^3" for name in arrays} if what == "powers" else {})}
        columns = scaled_columns((one,), arrays, units_known, scales_of(self.setup._params, units), {})
        if what == "powers":  # of all beads together
            return Table((), {}, {name: column._replace(dims=(), values=column.values[0]) for name, column in columns.items()}, known)
        return Table((one,), {one: Column((one,), np.arange(len(rows)))}, columns, known)

    def __reduce__(self) -> Any:
        return BeadsRun, (self.setup, self._told, self.trajectory)

    def __repr__(self) -> str:
        lines = [f"BeadsRun: {self.outcome}", f"  {self.sentence}", f"  {self.reason}"]
        lines += ["  " + ", ".join(f"{name} {value:.6g}" for name, value in self.powers.items()) + " l^2 gamma^3"]
        return "\n".join([*lines, "  all its numbers: to_dict(); as tables: to_pandas('events')"])


class WorldRun(Shown, _Ran):
    """What one bead in a world does: in a bowl, a fluid, fields of the laboratory, or without a plate.

    Its attributes are the keys of `festoon run --json`, scaled (l, 1/gamma) unless they name a unit: regime, reason,
    frame, mean_r, mean_height, energy_residual, final_time, final_lab, final_lab_si, ...; NaN where undefined.
    """

    #: The bead that ran.
    bead: Bead
    #: The samples, a `BeadsTrajectory` of one bead; None where none was asked for.
    trajectory: Any

    def __init__(self, bead: Bead, told: Dict[str, Any], trajectory: Any = None) -> None:
        self.bead, self._told, self.trajectory = bead, told, trajectory

    def _table(self, units: Optional[str]) -> Table:
        """One row."""
        told = {name: _number(value) for name, value in self._told.items() if not isinstance(value, (list, dict))}
        told["symmetry"] = self._told["symmetry"] or ""
        values = {**told, **numbers_of(np.array(self._told["final_state"]), before="final_")}
        known = {name: RESULTS[name][0] if name in RESULTS else "1" for name in told if not isinstance(told[name], str)}
        known.update(UNITS, mean_medium_power="l^2 gamma^3", final_time="1/gamma", end_time="1/gamma", mean_velocity="l gamma", mean_velocity_error="l gamma")
        return Table((), {}, scaled_columns((), values, known, scales_of(self.bead._params, units)), about(self.bead.scene()))

    def __getattr__(self, name: str) -> Any:
        told = self.__dict__.get("_told", {})
        if name not in told:
            raise AttributeError(name)
        value = told[name]
        if name == "symmetry":
            return value
        return lent(np.array(value, float)) if isinstance(value, list) else _number(value)

    def __dir__(self) -> List[str]:
        return [*super().__dir__(), *self._told]

    def __reduce__(self) -> Any:
        return WorldRun, (self.bead, self._told, self.trajectory)

    def __repr__(self) -> str:
        frame = {"laboratory": "laboratory's"}.get(self._told["frame"], self._told["frame"])
        return f"WorldRun: {self._told['regime']}, in the {frame} frame\n  {self._told['reason']}"


def _start(start: Any, beads: int, options: Any) -> Any:
    """The states at the start, which must stay alive."""
    states = np.ascontiguousarray(start, float)
    if states.shape != (beads, lib.FST_BEAD_NUMBERS):
        raise BadInput("start", f"states of {beads} beads have the shape ({beads}, {lib.FST_BEAD_NUMBERS}), not {states.shape}")
    options.state = ffi.cast("double *", ffi.from_buffer(states))
    return states


def run(
    setup: Bead, trajectory: Union[bool, str, "os.PathLike[str]"], fps: Any, start: Any, progress: Progress
) -> Any:
    """See Beads.run(); of one bead in a world, Bead.run()."""
    beads = int(setup._params.bead_count)
    result = ffi.gc(ffi.new("fst_beads_result *"), lib.fst_beads_free) if beads else ffi.new("fst_world_result *")
    samples, options = ffi.new("pyf_bead_samples *"), options_of(lib.fst_default_beads_options())
    kept = None if start is None else _start(start, max(1, beads), options)
    if fps is not None:
        rate = quantity(fps, lib.FST_UNIT_FREQUENCY, "fps")
        if not 0 < rate < math.inf:
            raise BadInput("fps", f"{fps} is not a number of samples a second")
        options.sample_spacing = setup.gamma / rate
    if trajectory is not False:
        options.user, options.sample = samples, ffi.addressof(lib, "pyf_take_beads_sample")
    if not isinstance(trajectory, bool):
        made = ffi.new("fst_beads_trajectory **")
        call(lib.fst_beads_trajectory_create, path_bytes(trajectory), setup._params, units_of("scaled"), made)
        samples.file = made[0]

    def closed(complete: bool) -> Any:
        file, samples.file = samples.file, ffi.NULL
        if file:
            close = lib.fst_beads_trajectory_close if beads else lib.fst_world_trajectory_close
            call(close, file, result if complete else ffi.NULL, complete)
        return trajectory_of(setup, samples) if trajectory is True else None

    try:
        with Watch(progress, lambda: closed(False), "run") as watch:
            options.progress = watch.told
            watch.call(lib.fst_beads_run_scene if beads else lib.fst_world_run, setup._params, options, result)
            text = (lib.fst_beads_json if beads else lib.fst_world_json)(setup._params, result, units_of("scaled"))
            kind: Any = BeadsRun if beads else WorldRun
            return kind(setup, json.loads(take_text(text)), closed(True))
    finally:
        del kept
        if samples.file:
            lib.fst_beads_trajectory_discard(samples.file)
        lib.pyf_free(samples.values)
