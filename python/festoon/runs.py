"""One run, and what it says."""

import json
import math
import os
from typing import Any, Dict, List, Optional, Union

from ._errors import BadInput, FestoonError
from ._given import whole_of
from ._native import Watch, call, dtype_of, ffi, freed_array, lent, lib, options_of, path_bytes, state_of, take_text, text_of
from ._pickled import Told, image_of, struct_of
from ._progress import Progress
from ._quantities import Scales, quantity
from ._tabled import Column, Table, Tabled, about, scaled_columns, scales_of
from ._tables import RESULTS, RunNumbers
from .bead import Bead

REGIMES = [text_of(lib.fst_regime_name(i)) for i in range(lib.FST_REGIME_COUNT)]
SYMMETRIES: List[Optional[str]] = [
    text_of(lib.fst_symmetry_name(i)) or None for i in range(lib.FST_SYMMETRY_COUNT)
]


#: What is said of a run in a few lines.
HEADLINES = ("frequency_hz", "mean_r", "std_r", "mean_alpha_dot", "festoons", "periods")


class RunIn(RunNumbers):
    """The numbers of a run in other units."""

    def __init__(self, run: "Run", units: str) -> None:
        self._run, self._units = run, units
        self._scales = Scales(run.bead._params, units)

    def _number(self, name: str) -> float:
        return self._run._number(name) * float(self._scales.factor(name, RESULTS[name][0])[0])

    def unit(self, name: str) -> str:
        """The unit of a number here."""
        return self._scales.factor(name, RESULTS[name][0])[1]

    def __reduce__(self) -> Any:
        return RunIn, (self._run, self._units)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, RunIn) and self._units == other._units and self._run == other._run

    def __hash__(self) -> int:
        return hash((self._run, self._units))

    def __repr__(self) -> str:
        return _listing(self, {name: self.unit(name) for name in RESULTS})


def _listing(numbers: RunNumbers, units: Dict[str, str]) -> str:
    lines = []
    for name in RESULTS:
        value = getattr(numbers, name)
        if not math.isnan(value):
            lines.append(f"  {name} = {value:.9g}" + (f" {units[name]}" if units[name] != "1" else ""))
    return "\n".join(lines)


class Run(Tabled, Told, RunNumbers):
    """The result of a run.  Numbers are scaled (l, 1/gamma, B0); `si` and `lab` have them in other units."""

    #: The bead that ran.
    bead: Bead
    #: The samples, a `Trajectory`; None where none was asked for.
    trajectory: Any
    #: The means of each piece of a ramp, an array with names; None: no ramp.
    ramp: Any
    #: False: the run was interrupted.
    complete: bool
    #: "done"; of a run of a sweep also "missing", or in what way it failed: then its numbers are NaN.
    status: str = "done"
    #: Why a run of a sweep failed, an exception; None: it did not.
    error: Optional[FestoonError] = None

    def __init__(
        self, bead: Bead, result: Any, trajectory: Any = None, ramp: Any = None, complete: bool = True
    ) -> None:
        self.bead = bead
        self._result = result
        self.trajectory = trajectory
        self.ramp = ramp
        self.complete = complete

    def _number(self, name: str) -> float:
        return float(getattr(self._result, name))

    def __reduce__(self) -> Any:
        samples = self.trajectory, self.ramp
        return _again, (self.bead, image_of(self._result), *samples, self.complete, self.status, self.error)

    def _facts(self) -> Any:
        samples = None if self.trajectory is None else self.trajectory.tobytes()
        return [self.to_dict(), self.complete, samples]

    @property
    def regime(self) -> str:
        """counter-rotating, corotating, locked, librating, chaotic, ejected, lifted or undecided; "" without a result."""
        return REGIMES[int(self._result.regime)] if self.status == "done" else ""

    @property
    def symmetry(self) -> Optional[str]:
        """S1, S2 or None."""
        return SYMMETRIES[int(self._result.symmetry)]

    @property
    def reason(self) -> str:
        """Why this regime: the criterion and its numbers; or why there is no result."""
        return self.error.sentence if self.error else text_of(self._result.reason)

    @property
    def never_slips(self) -> Optional[bool]:
        """Dry friction: whether the contact stuck all the time of the means; None: other laws."""
        return None if self._result.never_slips < 0 else bool(self._result.never_slips)

    @property
    def rhs_calls(self) -> int:
        """Evaluations of the equations of motion."""
        return int(self._result.rhs_calls)

    @property
    def steps(self) -> int:
        """Accepted steps."""
        return int(self._result.accepted)

    @property
    def returns(self) -> int:
        """Half turns of Phi in the window of the means."""
        return int(self._result.returns)

    @property
    def final_state(self) -> Any:
        """The state at the end: X Y vX vY nX nY nZ WX WY WZ."""
        return state_of(self._result.final_state)

    @property
    def si(self) -> RunIn:
        """The same numbers in SI units."""
        return RunIn(self, "si")

    @property
    def lab(self) -> RunIn:
        """The same numbers in the units of a laboratory: Hz, mm, s, mT."""
        return RunIn(self, "lab")

    def in_units(self, units: str) -> RunIn:
        """The same numbers in given, lab, scaled or si units.

        Parameters
        ----------
        units
            "given", "lab", "scaled" or "si".

        Returns
        -------
        RunIn
            The numbers as attributes; `unit(name)` names the unit of one.

        Raises
        ------
        BadInput
            Where the units are unknown.
        """
        return RunIn(self, units)

    def _table(self, units: Optional[str]) -> Table:
        """One row."""
        values = {name: self._number(name) for name in RESULTS}
        known = {name: unit for name, (unit, _) in RESULTS.items()}
        docs = {name: doc for name, (_, doc) in RESULTS.items()}
        columns = scaled_columns((), values, known, scales_of(self.bead._params, units), docs)
        words = {name: Column((), getattr(self, name) or "") for name in ("regime", "symmetry")}
        return Table((), {}, {**words, **columns}, about(self.bead.scene()))

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
        count = 0 if self.ramp is None else len(self.ramp)
        points = ffi.from_buffer("fst_ramp_point[]", self.ramp) if count else ffi.NULL
        text: Dict[str, Any] = json.loads(
            take_text(lib.fst_run_json(self.bead._params, self._result, points, count))
        )
        if self.status != "done":
            text.update(status=self.status, regime=None, symmetry=None, reason=self.reason)
        return text

    def __repr__(self) -> str:
        if self.status != "done":
            return f"Run: {self.status}: {self.reason}"
        head = f"Run: {self.regime}" + (f", {self.symmetry}" if self.symmetry else "")
        lines = [head + ("" if self.complete else " (interrupted)")]
        for name in HEADLINES:
            value, error = (getattr(self, key, None) for key in (name, f"{name}_error"))
            if value is not None and not math.isnan(value):
                unit = "" if RESULTS[name][0] == "1" else f" {RESULTS[name][0]}"
                spread = "" if error is None or math.isnan(error) else f" +- {error:.2g}"
                lines.append(f"  {name} = {value:.9g}{spread}{unit}")
        return "\n".join([*lines, "  all its numbers: to_dict(); in mm and Hz: lab; in SI: si"])

    def _repr_html_(self) -> str:
        from . import _cards

        return _cards.run_card(self)


def _again(bead: Bead, image: Any, trajectory: Any, ramp: Any, complete: bool, status: str, error: Any) -> Run:
    """A run from another process, which must have the same build."""
    run = Run(bead, struct_of(image), trajectory, None if ramp is None else lent(ramp), complete)
    run.status, run.error = status, error
    return run


def _ramp_ends(bead: Bead, ramp: Any, options: Any) -> None:
    factor = 2 * math.pi / bead.gamma
    try:
        ends = [quantity(end, lib.FST_UNIT_FREQUENCY, "ramp") * factor for end in ramp]
    except TypeError:
        ends = []
    if len(ends) != 2:
        raise BadInput("ramp", "it must be (FROM, TO), as in (7, 20) or ('420 rpm', '1200 rpm')")
    for end, name in zip(ends, ("ramp_from", "ramp_to")):
        bead.replace(omega=end)  # refuses what is out of range
        setattr(options, name, end)


def _file(trajectory: Any, bead: Bead, samples: Any) -> None:
    made = ffi.new("fst_trajectory **")
    call(lib.fst_trajectory_create, path_bytes(trajectory), bead._params, made)
    samples.file = made[0]


def _close(samples: Any, result: Any, complete: bool) -> None:
    file, samples.file = samples.file, ffi.NULL
    if file:
        call(lib.fst_trajectory_close, file, result, complete)


def _finished(bead: Bead, result: Any, samples: Any, options: Any, wanted: bool, complete: bool) -> Run:
    """The result, with the arrays that the run has filled; they own their memory from here on."""
    from .trajectories import DTYPE, Trajectory

    _close(samples, result, complete)
    values, samples.values = samples.values, ffi.NULL
    trajectory = ramp = None
    if wanted:
        trajectory = Trajectory._of(freed_array(values, samples.rows, DTYPE), bead, complete)
    points, samples.ramp = samples.ramp, ffi.NULL
    if not math.isnan(options.ramp_from):
        ramp = freed_array(points, samples.ramp_count, dtype_of("fst_ramp_point"))
    return Run(bead, result, trajectory, ramp, complete)


def run(
    bead: Bead,
    *,
    trajectory: Union[bool, str, "os.PathLike[str]"],
    fps: Optional[float],
    sample_from: float,
    start: Any,
    ramp: Any,
    ramp_points: Optional[int],
    ramp_wait: Optional[float],
    ramp_disturbance: Optional[float],
    progress: Progress,
) -> Run:
    """See Bead.run()."""
    result = ffi.new("fst_run_result *")
    samples = ffi.new("pyf_samples *")
    options = options_of(lib.fst_default_run_options())
    options.sink.user = samples
    options.sink.ramp_point = ffi.addressof(lib, "pyf_take_ramp_point")
    if trajectory is not False:
        options.sink.sample = ffi.addressof(lib, "pyf_take_sample")
    if not sample_from >= 0:
        raise BadInput("sample_from", f"{sample_from} is not a number of drive periods before the first sample")
    options.sample_from = sample_from
    if fps is not None:
        rate = quantity(fps, lib.FST_UNIT_FREQUENCY, "fps")
        if not 0 < rate < math.inf:
            raise BadInput("fps", f"{fps} is not a number of samples a second")
        options.sample_spacing = bead.gamma / rate
    if start is not None:
        state = ffi.new("double[]", [float(x) for x in start])
        if len(state) != lib.FST_STATE_SIZE:
            raise BadInput("start", f"a state has {lib.FST_STATE_SIZE} numbers, not {len(state)}")
        options.start = state
    if ramp is not None:
        _ramp_ends(bead, ramp, options)
    for name, value in (
        ("ramp_points", ramp_points),
        ("ramp_wait", ramp_wait),
        ("ramp_disturbance", ramp_disturbance),
    ):
        if value is not None:
            setattr(options, name, whole_of(value, name) if name == "ramp_points" else value)
    in_memory = trajectory is True
    if not isinstance(trajectory, bool):
        _file(trajectory, bead, samples)
    try:
        with Watch(
            progress, lambda: _finished(bead, result, samples, options, in_memory, False), "run"
        ) as watch:
            options.progress = watch.told
            watch.call(lib.fst_run, bead._params, options, result)
            return _finished(bead, result, samples, options, in_memory, True)
    finally:
        if samples.file:
            lib.fst_trajectory_discard(samples.file)
        lib.pyf_free(samples.values)
        lib.pyf_free(samples.ramp)
