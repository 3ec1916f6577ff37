"""Trajectories of several beads, and of one bead in a world."""

import math
from typing import Any, Dict, List, Optional

import numpy as np

from ._native import Watch, ffi, freed_array, lent, lib, owned_array, path_bytes, take_text, text_of
from ._pickled import Told
from ._progress import Progress
from ._quantities import Scales, units_of
from ._tabled import DOCS, NUMBERS, Column, Shown, Table, about, numbers_of, scaled_columns, scales_of
from .bead import Bead, Path
from .beads import Beads
from .films import Filmed


class BeadsTrajectory(Filmed, Shown, Told):
    """The samples of a run of several beads, or of one in a world, scaled (l, 1/gamma).

    >>> pair = Beads(beads=[{"start__phi": 3}, {"start__phi": 183}], frequency="30 Hz", run__periods=2, run__discard=1)
    >>> pair.run(trajectory=True).trajectory.states.shape
    (129, 2, 12)
    """

    #: The beads that ran; of one in a world, the bead.
    setup: Bead
    #: "turning", or "laboratory", of one in a world: on whose axes the states are.
    frame: str
    #: The time of each sample [1/gamma], and the turns of the magnet until then.
    t: Any
    drive_turns: Any
    #: Of the shape (samples, beads, 12): X Y Z vX vY vZ nX nY nZ WX WY WZ, on the axes of `frame`; Z is
    #: the height of the centre over the plate, without a plate over the magnet's reference plane.
    states: Any
    #: Of the shape (samples, beads): the force of each bead on the plate, per mass of the first one [l gamma^2]; NaN in the air.
    loads: Any

    def __init__(
        self, setup: Bead, t: Any, drive_turns: Any, states: Any, loads: Any, frame: str = "turning"
    ) -> None:
        self.setup, self.frame = setup, frame
        self.t, self.drive_turns, self.states, self.loads = (lent(array) for array in (t, drive_turns, states, loads))

    def _facts(self) -> Any:
        return [array.tobytes() for array in (self.t, self.states, self.loads)]

    def to_dict(self) -> Dict[str, Any]:
        """The arrays by their names.

        Returns
        -------
        dict
            t, drive_turns, states and loads.

        Raises
        ------
        OutOfMemory
            Where there is no memory for it.
        """
        return {"t": self.t, "drive_turns": self.drive_turns, "states": self.states, "loads": self.loads}

    def __getattr__(self, name: str) -> Any:
        """X, Y, ..., WZ of the states, of the shape (samples, beads)."""
        if name not in NUMBERS:
            raise AttributeError(name)
        return self.states[..., list(NUMBERS).index(name)]

    def __dir__(self) -> List[str]:
        return [*super().__dir__(), *NUMBERS]

    def __len__(self) -> int:
        return len(self.t)

    def _table(self, units: Optional[str]) -> Table:
        scales = scales_of(self.setup._params, units)
        docs = {**DOCS, "load": "force on the plate per mass of bead 0; not a number where the bead does not touch it"}
        times = scaled_columns(("t",), {"t": self.t, "drive_turns": self.drive_turns}, {"t": "1/gamma", "drive_turns": "turn"}, scales)
        numbers = {**numbers_of(self.states), "load": self.loads}
        columns = scaled_columns(("t", "bead"), numbers, {**NUMBERS, "load": "l gamma^2"}, scales, docs)
        beads = Column(("bead",), np.arange(self.states.shape[1]), "", "number of the bead")
        coords = {"t": times["t"], "bead": beads, "drive_turns": times["drive_turns"]}
        return Table(("t", "bead"), coords, columns, about(self.setup.scene(), frame=self.frame))

    def places(self, units: str = "scaled") -> Any:
        """Where the beads are in the laboratory, as a camera over the plate sees them.

        Parameters
        ----------
        units
            "scaled" (l), "lab" (mm) or "si" (m).

        Returns
        -------
        numpy.ndarray
            Of the shape (samples, beads, 3): x, y and the height of the centre over the plate.

        Raises
        ------
        BadInput
            Where units are unknown.
        """
        turns = self.drive_turns if self.frame == "turning" else 0 * self.drive_turns
        angle = 2 * math.pi * (turns % 1)[:, None]
        x, y, z = (self.states[..., i] for i in range(3))
        places = np.stack([x * np.cos(angle) - y * np.sin(angle), x * np.sin(angle) + y * np.cos(angle), z], axis=-1)
        return places * Scales(self.setup._params, units).factor("mean_r", "l")[0]

    def plot(self, units: str = "lab", begin: Optional[float] = None, end: Optional[float] = None, ax: Any = None) -> Any:
        """Draw the trails of the beads as a camera over the plate sees them, with the beads at the end.

        Parameters
        ----------
        units
            "lab" (mm), "scaled" (l) or "si" (m).
        begin, end
            The drive periods shown; all unless given.
        ax
            The Axes to draw into; without it a new figure is made.

        Returns
        -------
        matplotlib.axes.Axes
            The Axes with the picture, in which all can still be changed.

        Raises
        ------
        BadInput
            Where units are unknown.
        Unavailable
            Where matplotlib is missing.
        """
        from . import _style

        units_of(units)
        ax = _style.axes(ax, 5.4, 5.8)
        scene = self.setup._params  # where the magnet turns to and fro, periods are time by frequency
        periods = np.array([lib.fst_drive_periods(scene, t, turns) for t, turns in zip(self.t, self.drive_turns)])
        shown = (periods >= (-math.inf if begin is None else begin)) & (periods <= (math.inf if end is None else end))
        places, scales = self.places(units)[shown], Scales(self.setup._params, units)
        factor, unit = scales.factor("mean_r", "l")
        from matplotlib.patches import Circle

        for i in range(places.shape[1]):
            colour = text_of(lib.fst_colour_code(lib.fst_bead_colour(i)))
            ax.plot(places[:, i, 0], places[:, i, 1], color=colour, linewidth=1.2, label=f"bead {i}")
            if len(places):
                radius = factor * (self.setup.alone(i) if isinstance(self.setup, Beads) else self.setup).groups.eps
                ax.add_patch(Circle(places[-1, i, :2], radius, facecolor=colour, edgecolor="white", alpha=0.7, zorder=3))
        ax.set_aspect("equal")
        _style.dress(ax, f"Trails of {places.shape[1]} beads" if places.shape[1] > 1 else "Trail of the bead", "", f"x ({unit})", f"y ({unit})")
        _style.key_below(ax)
        return ax

    def movie(self, path: Path, *, progress: Progress = None, **options: Any) -> None:
        """A film of the beads with their poles and contacts, .mp4, .gif or a folder of PNG frames.

        Options: width, height, fps, begin, end (drive periods), seconds_per_turn, units.

        Parameters
        ----------
        path
            The film.
        progress
            True: a bar; or a function of (fraction, what).
        **options
            Those above.

        Raises
        ------
        BadInput
            Where an argument is wrong; the sentence says what was expected.
        Unavailable
            Where ffmpeg or cairo is missing.
        Interrupted
            After Ctrl-C.
        """
        from . import films

        films.movie(self, path, progress, **options)

    def _rows(self) -> Any:
        """The samples as the library has them, and what must stay alive with them.  Pairs touch without a gap."""
        rows, beads = self.states.shape[:2]
        alone = [self.setup.alone(i) if isinstance(self.setup, Beads) else self.setup for i in range(beads)]
        radii = np.array([bead.groups.eps for bead in alone])
        touching = [(self.loads[:, i] == self.loads[:, i], i, -1) for i in range(beads)]
        for i in range(beads):
            for j in range(i + 1, beads):
                apart = np.linalg.norm(self.states[:, i, :3] - self.states[:, j, :3], axis=-1)
                touching.append((apart < radii[i] + radii[j] + 1e-9, i, j))
        shown = np.array([row for row, *_ in touching]).T
        of_row, of_pair = np.nonzero(shown)
        touches = np.zeros(len(of_row) + 1, [("beads", "i4", 2), ("force", "f8")])
        touches["beads"][:-1] = np.array([pair for _, *pair in touching])[of_pair]
        first = np.concatenate([[0], np.cumsum(shown.sum(axis=1))]).astype(np.uintp)
        arrays = {"t": self.t, "drive_turns": self.drive_turns, "states": self.states, "radii": radii}
        kept = [np.array(array, "f8") for array in arrays.values()]
        table = ffi.new("fst_beads_table *", {"rows": rows, "count": beads, "scene": self.setup._params[0]})
        for name, array in zip(arrays, kept):
            setattr(table, name, ffi.cast("double *", array.ctypes.data))
        table.first = ffi.cast("size_t *", first.ctypes.data)
        table.touches = ffi.cast("fst_bead_touch *", touches.ctypes.data)
        table.complete, table.outcome = 1, lib.FST_BEADS_OUTCOME_COUNT
        table.frame = lib.FST_FRAME_LABORATORY if self.frame == "laboratory" else lib.FST_FRAME_TURNING
        return table, [kept, first, touches]

    def __reduce__(self) -> Any:
        arrays = (np.array(a) for a in (self.t, self.drive_turns, self.states, self.loads))
        return BeadsTrajectory, (self.setup, *arrays, self.frame)

    def __repr__(self) -> str:
        turns = f", drive periods {self.drive_turns[0]:.6g} to {self.drive_turns[-1]:.6g}" if len(self) else ""
        return f"BeadsTrajectory: {len(self)} samples of {self.states.shape[1]} beads{turns}"


def _frame(frame: int) -> str:
    return "laboratory" if frame == lib.FST_FRAME_LABORATORY else "turning"


def trajectory_of(setup: Bead, samples: Any) -> BeadsTrajectory:
    """The samples as arrays; they own their memory from here on."""
    beads = max(1, int(setup._params.bead_count))
    values, samples.values = samples.values, ffi.NULL
    rows = freed_array(values, samples.rows, np.dtype((np.float64, (2 + 13 * beads,)))).reshape(samples.rows, 2 + 13 * beads)
    states = rows[:, 2 : 2 + 12 * beads].reshape(len(rows), beads, 12)
    frame = _frame(lib.fst_frame_of_world(setup._params))
    return BeadsTrajectory(setup, rows[:, 0], rows[:, 1], states, rows[:, 2 + 12 * beads :], frame)


def read(path: Path) -> BeadsTrajectory:
    """Read a trajectory of several beads, or of one in a world, from .h5 or .csv."""
    table = ffi.gc(ffi.new("fst_beads_table *"), lib.fst_beads_table_free)
    with Watch(None) as watch:
        watch.call_apart(lib.fst_beads_trajectory_read, path_bytes(path), table)
    setup = (Beads if table.scene.bead_count else Bead)(take_text(lib.fst_scene_text(ffi.addressof(table, "scene"), False)) + "\n")
    rows, beads = int(table.rows), int(table.count)
    t, turns = (np.array(owned_array(pointer, rows, "f8", table)) for pointer in (table.t, table.drive_turns))
    states = np.array(owned_array(table.states, rows * beads * 12, "f8", table)).reshape(rows, beads, 12)
    loads = np.full((rows, beads), np.nan)
    ends = [int(table.first[i]) for i in range(rows + 1)]
    for row in range(rows):
        for touch in (table.touches[k] for k in range(ends[row], ends[row + 1])):
            if touch.beads[1] < 0:
                loads[row, touch.beads[0]] = touch.force
    return BeadsTrajectory(setup, t, turns, states, loads, _frame(table.frame))
