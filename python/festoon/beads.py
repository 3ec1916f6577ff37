"""Several beads on one plate, and one bead in a world: their runs, and their trajectories."""

import json
import math
import os
from typing import TYPE_CHECKING, Any, Callable, Dict, Iterable, List, Mapping, Optional, Sequence, Union

import numpy as np

from ._errors import BadInput
from ._native import Watch, call, ffi, freed_array, lent, lib, options_of, owned_array, path_bytes, take_text, text_of
from ._pickled import Told
from ._progress import Progress
from ._quantities import Scales, quantity, units_of, value_text
from .bead import Bead, Path, key_of, keyword_of

if TYPE_CHECKING:
    from .beads_orbits import BeadsBranch, BeadsLocked, BeadsOrbit

#: The twelve numbers of a bead, in their order.
NUMBERS = ("X", "Y", "Z", "vX", "vY", "vZ", "nX", "nY", "nZ", "WX", "WY", "WZ")
#: A setup that lists a bead, whose rows are those of any.
_LISTED = ffi.new("fst_params *", lib.fst_default_params())
_LISTED.bead_count = 1
#: Units of what is not named by its own: of the keys of a run, scaled.
UNITS = {"mean_r": "l", "mean_alpha_dot": "gamma", "ejected_at": "1/gamma", "centre_rate": "gamma", "axis_rate": "gamma",
         "force": "l gamma^2", "time": "1/gamma", "speed": "l gamma"}
#: Parameters that say nothing of a bead alone.
OF_LISTS = ("contact.pair_rate", "contact.pair_mu", "model.chi", "run.method", "run.step")
FRAMES = ("beads", "groups", "contacts", "events", "powers")


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
        for i, bead in enumerate(beads):
            if not isinstance(bead, Mapping):
                raise BadInput(f"beads[{i}]", f"{bead!r} is no dictionary of a bead's parameters")
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
        call(lib.fst_params_of_bead, self._params, number, params)
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
        scene = self.replace(run__periods=periods, run__discard=discard)._asked()
        return _run(scene, trajectory, fps, start, progress)  # type: ignore[no-any-return]

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

        return beads_orbits.branch(self._asked(), progress, ranges)  # type: ignore[arg-type]

    def __repr__(self) -> str:
        rest = super().__repr__()[len("Bead(") :]
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


for _name in ("sweep", "lyapunov", "flow", "start_state", "rhs", "jacobian", "observe", "movie", "lab"):
    setattr(Beads, _name, _of_one(_name))


def _number(value: Any) -> Any:
    return math.nan if value is None else value


class BeadsRun(Told):
    """What several beads do.  Numbers are scaled (l, 1/gamma), those that `festoon run --json` prints."""

    #: The beads that ran.
    setup: Beads
    #: The samples, a `BeadsTrajectory`; None where none was asked for.
    trajectory: Any

    def __init__(self, setup: Beads, told: Dict[str, Any], trajectory: Any = None) -> None:
        self.setup, self._told, self.trajectory = setup, told, trajectory

    def _facts(self) -> Any:
        return [self._told, None if self.trajectory is None else self.trajectory.states.tobytes()]

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
        """Of each bead regime, mean_r [l], mean_alpha_dot [gamma], mean_load_weights [1], ejected_at [1/gamma], and the
        twelve numbers of its final_state."""
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

    def to_dict(self) -> Dict[str, Any]:
        """What `festoon run --json` prints.

        Returns
        -------
        dict
            Keys and numbers as the program prints them; None where a number is undefined.

        Raises
        ------
        OutOfMemory
            Where there is no memory for it.
        """
        return dict(self._told)

    def to_pandas(self, what: str = "beads", units: str = "scaled") -> Any:
        """A data frame of the beads, the groups, the contacts, the events or the powers.

        Parameters
        ----------
        what
            "beads", "groups", "contacts", "events" or "powers".
        units
            "scaled", "lab" or "si"; forces and powers stay scaled.

        Returns
        -------
        pandas.DataFrame
            Units, scene and version are in its `attrs`.

        Raises
        ------
        BadInput
            Where there is no such table, or units are unknown.
        """
        import pandas

        if what not in FRAMES:
            raise BadInput("to_pandas", f'unknown table "{what}"; there are {", ".join(FRAMES)}')
        rows: Any = [self.powers] if what == "powers" else getattr(self, what)
        frame, scales = pandas.DataFrame(rows), Scales(self.setup._params, units)
        told = {}
        for name, unit in UNITS.items():
            if name in frame and what != "contacts":
                factor, told[name] = scales.factor("mean_alpha_dot" if unit == "gamma" else name, unit)
                frame[name] = frame[name] * factor
        frame.attrs.update(units=told, scene=self.setup.scene(), version=self._told["version"])
        return frame

    def __reduce__(self) -> Any:
        return BeadsRun, (self.setup, self._told, self.trajectory)

    def __repr__(self) -> str:
        lines = [f"BeadsRun: {self.outcome}", f"  {self.sentence}", f"  {self.reason}"]
        lines += ["  " + ", ".join(f"{name} {value:.6g}" for name, value in self.powers.items()) + " l^2 gamma^3"]
        return "\n".join([*lines, "  all its numbers: to_dict(); as tables: to_pandas('events')"])


class WorldRun(Told):
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

    def _facts(self) -> Any:
        return [self._told, None if self.trajectory is None else self.trajectory.states.tobytes()]

    def __getattr__(self, name: str) -> Any:
        told = self.__dict__.get("_told", {})
        if name not in told:
            raise AttributeError(name)
        value = told[name]
        return lent(np.array(value, float)) if isinstance(value, list) else _number(value)

    def __dir__(self) -> List[str]:
        return [*super().__dir__(), *self._told]

    def to_dict(self) -> Dict[str, Any]:
        """What `festoon run --json` prints.

        Returns
        -------
        dict
            Keys and numbers as the program prints them; None where a number is undefined.

        Raises
        ------
        OutOfMemory
            Where there is no memory for it.
        """
        return dict(self._told)

    def __reduce__(self) -> Any:
        return WorldRun, (self.bead, self._told, self.trajectory)

    def __repr__(self) -> str:
        return f"WorldRun: {self._told['regime']}, in the frame of the {self._told['frame']}\n  {self._told['reason']}"


class BeadsTrajectory(Told):
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

    def __len__(self) -> int:
        return len(self.t)

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
        shown = (self.drive_turns >= (-math.inf if begin is None else begin)) & (self.drive_turns <= (math.inf if end is None else end))
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
        _style.dress(ax, f"Trails of {places.shape[1]} beads", "", f"x ({unit})", f"y ({unit})")
        _style.key_below(ax)
        return ax

    def __reduce__(self) -> Any:
        arrays = (np.array(a) for a in (self.t, self.drive_turns, self.states, self.loads))
        return BeadsTrajectory, (self.setup, *arrays, self.frame)

    def __repr__(self) -> str:
        turns = f", drive periods {self.drive_turns[0]:.6g} to {self.drive_turns[-1]:.6g}" if len(self) else ""
        return f"BeadsTrajectory: {len(self)} samples of {self.states.shape[1]} beads{turns}"


def _frame(frame: int) -> str:
    return "laboratory" if frame == lib.FST_FRAME_LABORATORY else "turning"


def _trajectory_of(setup: Bead, samples: Any) -> BeadsTrajectory:
    """The samples as arrays; they own their memory from here on."""
    beads = max(1, int(setup._params.bead_count))
    values, samples.values = samples.values, ffi.NULL
    rows = freed_array(values, samples.rows, np.dtype((np.float64, (2 + 13 * beads,)))).reshape(samples.rows, 2 + 13 * beads)
    states = rows[:, 2 : 2 + 12 * beads].reshape(len(rows), beads, 12)
    frame = _frame(lib.fst_frame_of_world(setup._params))
    return BeadsTrajectory(setup, rows[:, 0], rows[:, 1], states, rows[:, 2 + 12 * beads :], frame)


def _start(start: Any, beads: int, options: Any) -> Any:
    """The states at the start, which must stay alive."""
    states = np.ascontiguousarray(start, float)
    if states.shape != (beads, lib.FST_BEAD_NUMBERS):
        raise BadInput("start", f"states of {beads} beads have the shape ({beads}, {lib.FST_BEAD_NUMBERS}), not {states.shape}")
    options.state = ffi.cast("double *", ffi.from_buffer(states))
    return states


def _run(
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
            raise BadInput("fps", f"{fps} is no number of samples a second")
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
        return _trajectory_of(setup, samples) if trajectory is True else None

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
