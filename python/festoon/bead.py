"""The bead on its stirrer: a setup, and everything that can be asked of it."""

import itertools
import math
import os
from typing import TYPE_CHECKING, Any, Dict, FrozenSet, Iterable, List, Mapping, Optional, Tuple, Union

import numpy as np

from ._errors import BadInput, MaterialWarning, SceneWarning, warn
from ._given import rows_in
from ._keys import key_of, keyword_of, known_key
from ._native import Watch, call, ffi, lib, path_bytes, rows_of, take_text, text_of
from ._progress import Progress
from ._quantities import UNSET, value_text
from ._tables import PARAMETERS, SHORT, Parameters
from .groups import Groups

if TYPE_CHECKING:
    from .branches import Branch
    from .critical import Critical
    from .flows import Flow
    from .lab import Lab
    from .orbits import LockedStates, Lyapunov, Orbit
    from .runs import Run
    from .smoothing import SmoothedMap
    from .sweeps import Sweep

Path = Union[str, "os.PathLike[str]"]


def _fitting(file: bytes) -> bytes:
    """A path that fits into magnet.file."""
    size = ffi.sizeof(dict(ffi.typeof("fst_params").fields)["magnet_file"].type)
    if len(file) >= size:
        raise BadInput("magnet.file", f"the path of the map has more than {size - 1} bytes: move the file")
    return file


class Bead(Parameters):
    """A bead on a magnetic stirrer, by default the paper's at 10.7 Hz.  A Bead never changes.

    Parameters are keywords: the short ones ``frequency``, ``omega``, ``kappa``, ``gamma`` and ``mu``, all others
    as ``group__name`` (``friction__law="coulomb"``).  A number is in SI or scaled, as in scenes; a text may
    carry a unit.  A `scene` (a path, or the YAML text itself) comes first, keywords override it.

    >>> bead = Bead(frequency="642 rpm", kappa=1.8)
    >>> round(bead.frequency, 3), bead.kappa
    (10.7, 1.8)
    """

    _params: Any
    _map: Any = None
    _made: Any = None
    #: Keys that keywords gave, and keys whose values a call has found.
    _said: FrozenSet[str] = frozenset()
    _follows: FrozenSet[str] = frozenset()

    # Type checkers take the signatures with all keywords from Parameters.
    if not TYPE_CHECKING:

        def __init__(self, scene: Any = None, **keywords: Any) -> None:
            self._params = ffi.new("fst_params *", lib.fst_default_params())
            if isinstance(scene, Bead):
                self._params[0], self._map = scene._params[0], scene._map
                self._said = scene._said
            elif isinstance(scene, str) and "\n" in scene:
                data = scene.encode()
                call(lib.fst_scene_parse, data, len(data), b"scene", self._params)
            elif scene is not None:
                if not isinstance(scene, (str, bytes, os.PathLike)):
                    raise TypeError(f"{scene!r} is not a scene: parameters are keywords, as in Bead(frequency=10.7)")
                call(lib.fst_scene_read, path_bytes(scene), self._params)
            self._set(keywords)
            if scene is not None and not isinstance(scene, Bead):
                self._warn_of_parts()

    def _warn_of_parts(self) -> None:
        sentence = ffi.new("char[]", 512)
        if lib.fst_parts_contradiction(self._params, sentence, 512):
            warn(text_of(sentence), SceneWarning)

    def _set(self, keywords: Mapping[str, Any]) -> None:
        given = {known_key(keyword): value for keyword, value in keywords.items() if value is not None}
        if len(given) < sum(value is not None for value in keywords.values()):
            raise BadInput("Bead", "a parameter is given twice, by its short keyword and by its long one")
        self._unset([key for key, value in given.items() if value is UNSET])
        self._said -= given.keys()
        given = {key: value for key, value in given.items() if value is not UNSET}
        self._said |= given.keys()
        for key, shape in (("magnet.parts", "parts"), ("magnet.file", "grid")):
            if key in given:
                given.setdefault("magnet.shape", shape)
        # As in a scene: the magnet's kind says what takes the place of what, and kappa clears a B0 before it.
        for key in sorted(given, key=lambda key: (key != "magnet.shape", key != "model.kappa")):
            if key == "magnet.parts":
                self._set_parts(given[key])
            elif key == "coils":
                self._set_list(key, rows_in(given[key], key, "one a coil: [{'radius': 0.05, 'current': 1}, ...]"))
            elif key not in PARAMETERS and isinstance(given[key], (list, tuple, np.ndarray)):
                self._set_list(key, given[key])
            elif key not in PARAMETERS and lib.fst_param_find(f"{key}[0]".encode()) >= 0:
                raise BadInput(key, f"it must be a list of numbers, as [0, 0, 1], not {given[key]!r}")
            else:
                call(lib.fst_params_set, self._params, key.encode(), value_text(given[key], key).encode())
        for one, two in itertools.combinations(given, 2):
            if lib.fst_params_clash(self._params, one.encode(), two.encode()):
                raise BadInput("Bead", f"{one} and {two} are two forms of one quantity: give one")
        self._make()
        if "magnet.parts" in given:
            self._warn_of_parts()

    def _unset(self, keys: Iterable[str]) -> None:
        """Take parameters back to what they are where nothing was said of them."""
        for key in keys:
            if key == "magnet.parts":
                self._params.magnet_part_count = 0
            else:
                call(lib.fst_params_unset, self._params, key.encode())

    def _make(self) -> None:
        """Make the model; a map of the field is read once, and shared by the beads that follow from this one."""
        if not self._params.magnet_map:
            field_map = ffi.new("fst_field_map **")
            with Watch(None) as watch:
                watch.call(lib.fst_params_read_map, self._params, watch.told, field_map)
            self._map = ffi.gc(field_map[0], lib.fst_field_map_free) if field_map[0] else None
        model = ffi.new("fst_model **")
        call(lib.fst_field_model_new, self._params, math.nan, model)
        if self._params.bead_count and type(self) is Bead:
            raise BadInput("beads", "this scene lists several beads: festoon.Beads(scene) takes them")
        self._made = ffi.gc(model[0], lib.fst_model_free)

    @property
    def _model(self) -> Any:
        """The model; a bead out of a file whose map was not found fails here, for most uses need none."""
        if self._made is None:
            self._make()
        return self._made

    @property
    def _flat_model(self) -> Any:
        """The same for what is known of a bead on a flat plate in air alone: of one in a world it is refused."""
        if lib.fst_key_of_world(self._params):
            call(lib.fst_model_new, self._params, ffi.new("fst_model **"))
        return self._model

    def __setattr__(self, name: str, value: Any) -> None:
        if not name.startswith("_"):
            raise AttributeError(f"a Bead never changes: bead.replace({name}=...) is another one")
        super().__setattr__(name, value)

    def _set_parts(self, parts: Iterable[Mapping[str, Any]]) -> None:
        """The parts of a real magnet, each a dictionary as in a scene: kind, centre, size, remanence, ..."""
        self._params.magnet_part_count = 0
        for i, part in enumerate(rows_in(parts, "magnet.parts", "one a part: [{'kind': 'cuboid', ...}, ...]")):
            if "kind" not in part:
                raise BadInput(f"magnet.parts[{i}]", "a part needs its kind: cuboid, cylinder, sphere or dipole")
            for name in sorted(part, key=lambda name: name != "kind"):
                value, key = part[name], f"magnet.parts[{i}].{name}"
                if name in ("kind", "motion"):
                    call(lib.fst_params_set, self._params, key.encode(), str(value).encode())
                    continue
                single = isinstance(value, str) or np.ndim(value) == 0
                for k, number in enumerate([value] if single else value):
                    call(lib.fst_params_set, self._params, f"{key}[{k}]".encode(), value_text(number, key).encode())

    def _set_list(self, key: str, values: Any) -> None:
        """A vector, as field__uniform=[0, 0, "50 uT"], or coils=[{"radius": 0.05, "current": 1}, ...]."""
        if key == "coils":
            self._params.coil_count = 0
        for i, value in enumerate(values):
            if isinstance(value, Mapping):
                for name, number in value.items():
                    many = isinstance(number, (list, tuple, np.ndarray))
                    for k, one in enumerate(number if many else [number]):
                        row = f"{key}[{i}].{name}" + (f"[{k}]" if many else "")
                        call(lib.fst_params_set, self._params, row.encode(), value_text(one, row).encode())
            elif value is not None:
                call(lib.fst_params_set, self._params, f"{key}[{i}]".encode(), value_text(value, key).encode())

    def _vectors(self) -> Dict[str, List[Optional[float]]]:
        """The vectors of which a component is given, in SI; None for one that is not."""
        found: Dict[str, List[Optional[float]]] = {}
        text = ffi.new("char[]", 64)
        for i in range(lib.fst_param_count(), lib.fst_params_row_count(self._params)):
            if lib.fst_param_part(i) < 0 and lib.fst_param_bead(i) < 0 and lib.fst_param_coil(i) < 0:
                lib.fst_params_get(self._params, i, text, 64)
                key = text_of(lib.fst_param_at(i).key).split("[")[0]
                found.setdefault(key, []).append(float(text_of(text)) if text[0] != b"\0" else None)
        return {key: vector for key, vector in found.items() if any(value is not None for value in vector)}

    @property
    def magnet__parts(self) -> List[Dict[str, Any]]:
        """The parts of a real magnet, in SI units; numbers that a part does not need are left out."""
        parts: List[Dict[str, Any]] = []
        for i in range(lib.fst_param_count(), lib.fst_params_row_count(self._params)):
            row, text = lib.fst_param_at(i), ffi.new("char[]", 64)
            number = lib.fst_param_part(i)
            if not 0 <= number < self._params.magnet_part_count:
                continue
            name = text_of(row.key).split("].", 1)[1]
            lib.fst_params_get(self._params, i, text, 64)
            if name == "kind":
                parts.append({"kind": text_of(text)})
            elif name == "motion":
                if text_of(text) != "turning":
                    parts[number]["motion"] = text_of(text)
            elif text[0] != b"\0":
                parts[number].setdefault(name.split("[")[0], []).append(float(text_of(text)))
        for part in parts:
            if not any(part.get("rotation", ())):
                part.pop("rotation", None)
        return parts

    @classmethod
    def _of(cls, params: Any, field_map: Any = None) -> "Bead":
        """The bead of parameters in C, which are copied; they may use `field_map`, and no other map."""
        made = cls._unmade(params, field_map)
        made._make()
        return made

    @classmethod
    def _out_of_file(cls, params: Any, field_map: Any) -> "Bead":
        """The same of a file that was read; where its map was not found, what needs it says so."""
        if field_map is not None or params.magnet_file[0] == b"\0":
            return cls._of(params, field_map)
        return cls._unmade(params)

    @classmethod
    def _unmade(cls, params: Any, field_map: Any = None) -> "Bead":
        """A bead of which nothing is asked yet: without a model, and without the map of its magnet unless it is given."""
        made = cls.__new__(cls)
        made._params = ffi.new("fst_params *", params)
        made._map = field_map
        made._params.magnet_map = field_map or ffi.NULL
        return made

    @classmethod
    def _unmade_of(cls, scene: str) -> "Bead":
        made = cls._unmade(lib.fst_default_params())
        data = scene.encode()
        call(lib.fst_scene_parse, data, len(data), b"scene", made._params)
        return made

    @classmethod
    def load(cls, path: Path) -> "Bead":
        """Read a YAML scene.

        Parameters
        ----------
        path
            A scene.

        Returns
        -------
        Bead
            The bead of the scene.

        Raises
        ------
        MissingFile
            Where the file is not there.
        BadInput
            Where it is damaged, or something else.
        """
        return cls(os.fspath(path).replace("\n", "?"))

    def save(self, path: Path, comments: bool = True, overwrite: bool = True) -> None:
        """Write the bead as a YAML scene, with docs and units as comments.

        Parameters
        ----------
        path
            The file, which is made anew.
        comments
            Whether docs and units stand beside the values.
        overwrite
            False: a file that is there is left, with an error.

        Raises
        ------
        InputOutput
            Where the file cannot be written.
        """
        folder = os.path.dirname(os.fsdecode(path))
        params, file = ffi.new("fst_params *", self._params[0]), ffi.string(self._params.magnet_file)
        if folder and file and not os.path.isabs(file):  # a path in a scene begins at the scene's folder
            params.magnet_file = _fitting(os.path.relpath(file, os.fsencode(folder)))
        call(lib.fst_scene_write, path_bytes(path), params, bool(comments), bool(overwrite))

    def scene(self, comments: bool = False) -> str:
        """The bead as YAML text; Bead(text) is the same bead, bit by bit.

        Parameters
        ----------
        comments
            Whether docs and units stand beside the values.

        Returns
        -------
        str
            The scene; values have units.

        Raises
        ------
        OutOfMemory
            Where there is no memory for it.
        """
        return take_text(lib.fst_scene_text(self._params, bool(comments)))

    if not TYPE_CHECKING:

        def replace(self, **keywords: Any) -> "Bead":
            """The same bead with other values; `UNSET` is for a parameter that is to be as if it had never been given.

            Parameters
            ----------
            **keywords
                Parameters as those of :class:`Bead`.

            Returns
            -------
            Bead
                Another bead; this one stays.

            Raises
            ------
            BadInput
                Where a keyword is unknown or a value is out of range.

            Examples
            --------
            >>> scaled = Bead(frequency=8, gamma=300).replace(omega=0.2)
            >>> scaled.replace(omega=UNSET, gamma=UNSET) == Bead()
            True
            """
            made = type(self).__new__(type(self))
            made._params, made._map = ffi.new("fst_params *", self._params[0]), self._map
            made._said = self._said
            made._set(keywords)
            return made

    # ------------------------------------------------------------------ what it is

    def _parameter(self, key: str) -> Any:
        kind, unit, _ = PARAMETERS[key]
        if key == "run.discard":
            return float(lib.fst_run_discard(self._params))  # what holds, where nothing was said too
        value = getattr(self._params, key.replace(".", "_"))
        if kind == "str" and not unit:
            return text_of(value) or None
        if kind == "str":
            return unit.split(", ")[value]
        if kind == "int":
            return int(value)
        return None if math.isnan(value) else float(value)

    @property
    def parameters(self) -> Dict[str, Any]:
        """All parameters by their keys, in SI; None where one was not given."""
        return {key: self._parameter(key) for key in PARAMETERS}

    @property
    def groups(self) -> Groups:
        """The scaled groups on which the motion depends."""
        return Groups(lib.fst_model_groups(self._model))

    @property
    def omega(self) -> float:
        """The drive, omega_0/gamma [gamma]."""
        return float(lib.fst_model_groups(self._model).omega)

    @property
    def frequency(self) -> float:
        """The drive [Hz]."""
        if math.isnan(self._params.drive_omega):
            return float(self._params.drive_frequency)
        return self.omega * self.gamma / (2 * math.pi)

    @property
    def kappa(self) -> float:
        """Magnetic strength mu B0/(m R^2 gamma^2) [1]."""
        return float(lib.fst_model_groups(self._model).kappa)

    @property
    def gamma(self) -> float:
        """The friction rate, and the inverse unit of time [1/s]."""
        return float(self._params.friction_gamma)

    @property
    def mu(self) -> float:
        """Coefficient of dry friction [1]."""
        return float(self._params.friction_mu)

    def start_state(self) -> Any:
        """The state at the start: X Y vX vY nX nY nZ WX WY WZ.

        Returns
        -------
        numpy.ndarray
            Ten numbers, scaled (l, 1/gamma).

        Raises
        ------
        BadInput
            Where the start does not exist, as one that rolls on the axis.
        """
        state = ffi.new("double[]", lib.FST_STATE_SIZE)
        call(lib.fst_start_state, self._params, self._flat_model, state)
        return np.array(list(state))

    def _text(self, key: str) -> str:
        """A parameter as a scene would say it; "" where it is not given."""
        text = ffi.new("char[]", 4096)
        lib.fst_params_get(self._params, lib.fst_param_find(key.encode()), text, 4096)
        return text_of(text)

    def _given(self) -> Dict[str, str]:
        """The parameters that differ from the default bead's, as text."""
        default = ffi.new("fst_params *", lib.fst_default_params())
        texts: Dict[str, str] = {}
        size = 4096
        ours, theirs = ffi.new("char[]", size), ffi.new("char[]", size)
        for i, row in enumerate(rows_of("param")):
            lib.fst_params_get(self._params, i, ours, size)
            lib.fst_params_get(default, i, theirs, size)
            if ffi.string(ours) != ffi.string(theirs) and ours[0] != b"\0":
                texts[text_of(row.key)] = text_of(ours)
        return texts

    def _scene_with(self, file: bytes) -> str:
        params = ffi.new("fst_params *", self._params[0])
        params.magnet_file = file
        return take_text(lib.fst_scene_text(params, False))

    def _identity(self) -> str:
        """What equal beads have in common: the scene; of a map its content, and not where it lies."""
        return self.scene() if self._params.magnet_checksum[0] == b"\0" else self._scene_with(b"")

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Bead) and self._identity() == other._identity()

    def __hash__(self) -> int:
        return hash(self._identity())

    def _portable_scene(self) -> str:
        """Another process may work in another folder, where a path to a map leads nowhere."""
        file = ffi.string(self._params.magnet_file)
        return (self._scene_with(_fitting(os.path.abspath(file))) if file else self.scene()) + "\n"

    def __reduce__(self) -> Tuple[Any, ...]:
        again = type(self) if self._made is not None else type(self)._unmade_of
        return again, (self._portable_scene(),), {"_said": self._said, "_follows": self._follows}

    def __copy__(self) -> "Bead":
        return self

    def __deepcopy__(self, memo: Any) -> "Bead":
        return self

    def __repr__(self) -> str:
        words = []
        given = self._given()
        for key, (kind, _, _) in PARAMETERS.items():
            text = given.get(key, self._text(key) if key in self._said else "")
            if text and key not in self._follows:
                words.append(f"{keyword_of(key)}={text!r}" if kind == "str" else f"{keyword_of(key)}={text}")
        if self._params.magnet_part_count:
            words.append(f"magnet__parts={self.magnet__parts!r}")
        words += [f"{keyword_of(key)}={vector}" for key, vector in self._vectors().items()]
        return f"{type(self).__name__}({', '.join(words)})"

    def _repr_html_(self) -> str:
        from . import _cards

        return _cards.bead_card(self)

    # ------------------------------------------------------------------ what can be asked of it

    def _asked(self, varied: Optional[Iterable[str]] = None) -> "Bead":
        """The bead of which something is asked: refuse values without effect, say where mass and radius
        contradict any material, but of the many beads of a sweep or branch over the keys `varied`, and take for
        run.discard what a run leaves out, so that what is told is done, where one number says it for all runs: as the
        program does."""
        keys = frozenset(varied or ())
        params = ffi.new("fst_params *", self._params[0])
        if "friction.mu_static" in keys and math.isnan(params.friction_mu_static):
            params.friction_mu_static = params.friction_mu  # what is varied is given
        call(lib.fst_params_check_effects, params)
        sentence = ffi.new("char[]", 512)
        if varied is None and lib.fst_bead_contradiction(self._params, sentence, 512):
            warn(text_of(sentence), MaterialWarning)
        discard = lib.fst_run_discard(self._params)
        one_length = math.isnan(self._params.run_duration) and keys.isdisjoint(("run.periods", "run.duration"))
        if discard == self._params.run_discard or not one_length:
            return self
        made = self.replace()
        made._params.run_discard = discard
        made._follows = frozenset(["run.discard"])
        return made

    def run(
        self,
        *,
        periods: Optional[float] = None,
        discard: Optional[float] = None,
        trajectory: Union[bool, Path] = False,
        fps: Optional[float] = None,
        sample_from: float = 0.0,
        start: Any = None,
        ramp: Any = None,
        ramp_points: Optional[int] = None,
        ramp_wait: Optional[float] = None,
        ramp_disturbance: Optional[float] = None,
        progress: Progress = None,
    ) -> "Run":
        """Simulate the bead and describe its motion: a :class:`Run`.

        Parameters
        ----------
        periods, discard
            Length in drive periods, and how many of them are left out of the means.
        trajectory
            True: the result has a `trajectory`; a path (.h5 or .csv): the samples go into that file.
        fps
            Samples a second, as a camera takes them, instead of run.samples in a drive period.
        sample_from
            Drive periods before the first sample.
        start
            A state of ten numbers instead of start.*.
        ramp
            (FROM, TO): a slow ramp of the drive after the discard, in Hz or with units; the result has `ramp`.
        ramp_points, ramp_wait, ramp_disturbance
            Its points; drive periods that the bead is given at each before its means; the disturbance there.
        progress
            True: a bar; or a function of (fraction, what).

        Returns
        -------
        Run
            Its numbers are scaled; `si` and `lab` have them in other units.  Of a bead in a world (a bowl, a fluid, no
            plate, fields of the laboratory) a `WorldRun`; `start` then has twelve numbers.

        Raises
        ------
        BadInput
            Where an argument is wrong; the sentence says what was expected.
        StepUnderflow, NotFinite
            Where the integration fails; the sentence says when and where.
        Interrupted
            After Ctrl-C; `partial` is what was done by then.

        Examples
        --------
        >>> run = Bead().run(periods=60)
        >>> run.regime, run.symmetry
        ('counter-rotating', 'S1')
        """
        from . import beads_runs, runs

        asked = self.replace(run__periods=periods, run__discard=discard)._asked()
        world = lib.fst_key_of_world(asked._params)
        if world and ramp is None:
            if sample_from:
                raise BadInput("sample_from", f"it is not for a bead in a world ({text_of(world)})")
            return beads_runs.run(asked, trajectory, fps, None if start is None else [start], progress)  # type: ignore[no-any-return]
        return runs.run(
            asked,
            trajectory=trajectory,
            fps=fps,
            sample_from=sample_from,
            start=start,
            ramp=ramp,
            ramp_points=ramp_points,
            ramp_wait=ramp_wait,
            ramp_disturbance=ramp_disturbance,
            progress=progress,
        )

    def sweep(self, **keywords: Any) -> "Sweep":
        """Runs over a grid of parameters: :func:`festoon.sweep` with this bead.

        Parameters
        ----------
        **keywords
            Those of :func:`festoon.sweep`.

        Returns
        -------
        Sweep
            A result for each point of the grid.

        Raises
        ------
        BadInput
            Where an argument is wrong; the sentence says what was expected.
        Interrupted
            After Ctrl-C; `partial` is what was done by then.
        """
        from .sweeping import sweep

        return sweep(self, **keywords)

    def orbit(self, *, festoons: Optional[float] = None, progress: Progress = None) -> "Orbit":
        """The stable periodic orbit to which the start leads, or the one with so many festoons: an `Orbit`.

        Parameters
        ----------
        festoons
            Look for the drive at which the pattern closes with so many; without it the orbit at the bead's drive.
        progress
            True: a bar; or a function of (fraction, what).

        Returns
        -------
        Orbit
            Its numbers are those of a run over one period, scaled.  Of a bead in a world a `BeadsOrbit` of one bead or, in
            fields of the laboratory or under an unsteady magnet, a `WorldOrbit`.

        Raises
        ------
        NoConvergence
            Where there is no stable orbit; the sentence says what became of the search.
        BadInput
            Where an argument is wrong; the sentence says what was expected.
        Interrupted
            After Ctrl-C.
        """
        from . import beads_orbits, orbits

        asked = self._asked()
        world = text_of(lib.fst_key_of_world(asked._params))
        if world and festoons is not None:
            raise BadInput("festoons", f"they are counted on a flat plate in air under a magnet that turns steadily, not with {world}")
        if world:
            steady = not lib.fst_key_of_surroundings(asked._params)
            return (beads_orbits.orbit if steady else beads_orbits.world_orbit)(asked, progress)  # type: ignore[return-value]
        return orbits.orbit(asked, festoons, progress)

    def locked(self, *, progress: Progress = None) -> "LockedStates":
        """Every locked state at this drive: a `LockedStates`.

        Parameters
        ----------
        progress
            True: a bar; or a function of (fraction, what).

        Returns
        -------
        LockedStates
            All of them, stable ones first.  Of a bead in a world the one to which the start leads, a `BeadsLocked`; without
            a plate the places where it floats, `FloatingStates`.

        Raises
        ------
        BadInput
            Where an argument is wrong; the sentence says what was expected.
        Interrupted
            After Ctrl-C.
        """
        from . import beads_orbits, orbits

        asked = self._asked()
        if self.plate__shape == "none":
            return beads_orbits.floating(asked, progress)  # type: ignore[return-value]
        if lib.fst_key_of_world(asked._params):
            return beads_orbits.locked(asked, progress)  # type: ignore[return-value]
        return orbits.locked(asked, progress)

    def branch(self, *, kind: str = "counter", progress: Progress = None, **keywords: Any) -> "Branch":
        """Follow a family of solutions over a parameter, `omega=(0.15, 0.6)`: a `Branch`.

        Parameters
        ----------
        kind
            counter (the counter-rotating family), locked (all families of equilibria), all, levitating (places where a bead
            floats without a plate), or driven (the motion that repeats itself with the drive).  Of a bead in a world it
            is locked, levitating or driven.
        progress
            True: a bar; or a function of (fraction, what).
        **keywords
            The ranges of one parameter or of two, and the options below.
        tolerance, step, follow
            Of the integration (1e-12); longest step along the curve (0.5); switch branches where they cross.
        special
            With a second parameter, `kappa=(1, 2)`: the type of special point that is followed over both.

        Returns
        -------
        Branch
            Its points, special points and ends; of kind locked in a world a `BeadsBranch`.

        Raises
        ------
        BadInput
            Where an argument is wrong; the sentence says what was expected.
        Interrupted
            After Ctrl-C; `partial` is what was done by then.
        """
        from . import beads_orbits, branches

        asked = self._asked(map(key_of, keywords))
        world = text_of(lib.fst_key_of_world(asked._params))
        if world and kind == "locked":
            return beads_orbits.branch(asked, progress, keywords)  # type: ignore[return-value]
        if world and kind in ("counter", "all"):
            raise BadInput("kind", f"with {world} a branch is of kind locked, levitating or driven")
        return branches.branch(asked, kind, progress, keywords)

    def lyapunov(self, *, progress: Progress = None) -> "Lyapunov":
        """The spectrum of Lyapunov exponents: a `Lyapunov`.

        Parameters
        ----------
        progress
            True: a bar; or a function of (fraction, what).

        Returns
        -------
        Lyapunov
            Exponents in gamma, each with an error.

        Raises
        ------
        BadInput
            Where an argument is wrong; the sentence says what was expected.
        Interrupted
            After Ctrl-C.
        """
        from . import orbits

        return orbits.lyapunov(self._asked(), progress)

    def critical(
        self, *, over: str = "drive.frequency=2Hz:30Hz:113", tolerance: float = 1e-4, progress: Progress = None
    ) -> "Critical":
        """The critical speed, from which on the bead circles against the magnet: a `Critical`.

        Parameters
        ----------
        over
            The speeds of the first runs, each from the bead's start: "drive.frequency=LO:HI:COUNT", or drive.omega.
        tolerance
            The width to which a border is enclosed by more runs, over the speed.
        progress
            True: a bar; or a function of (fraction, what).

        Returns
        -------
        Critical
            The speed in Hz (or in gamma) with its error, the outcomes on either side, and those of all runs.

        Raises
        ------
        BadInput
            Where an argument is wrong; the sentence says what was expected.
        Interrupted
            After Ctrl-C.
        """
        from . import critical

        return critical.critical(self._asked(), over, tolerance, progress)

    def field(self, x: Any, y: Any, *, height: Any = None, units: str = "scaled") -> Tuple[Any, Any]:
        """The field and its gradient in the magnet's frame: (B, G), G[..., i, j] = dB_i/dx_j.

        In a world it is that of all that makes one, at the time 0 on the laboratory's axes.

        `x` and `y` broadcast; they are in l and B in B0, or in m and T with ``units="si"``.  A text may carry a
        unit ("10 mm").  `height` is another one over the magnet's mid-plane than that of the bead's centre.

        Parameters
        ----------
        x, y
            Places in the frame of the magnet, which broadcast.
        height
            Over the mid-plane, in l or m, or a text with a unit.
        units
            "scaled" or "si".

        Returns
        -------
        tuple of numpy.ndarray
            B of the shape (..., 3) and G of the shape (..., 3, 3), in B0 and B0/l, or T and T/m; NaN in a part of the magnet.

        Raises
        ------
        BadInput
            Where units are unknown, or SI units do not follow from the parameters.
        Interrupted
            After Ctrl-C.

        Examples
        --------
        >>> B, G = Bead().field([0.0, 0.5], 0.0)
        >>> B.shape, G.shape
        ((2, 3), (2, 3, 3))
        """
        from . import fields

        return fields.field(self, x, y, height, units)

    def smooth(
        self, *, noise: Union[None, float, str] = None, probe: bool = False, height: Any = None, progress: Progress = None
    ) -> "SmoothedMap":
        """Fit charges below the noisy map of the magnet (`magnet__file`): a `SmoothedMap`, as `festoon field --smooth`.

        Parameters
        ----------
        noise
            Of a component of a sample, T or a text with a unit; estimated unless given.
        probe
            Whether the probe's axes may be turned and have offsets, which are fitted too.
        height
            Of the plane that is wanted over the magnet's reference plane, m or a text with a unit; by default that
            of the bead's centre.
        progress
            True: a bar; or a function of (fraction, what).

        Returns
        -------
        SmoothedMap
            With the field, its errors, and how well charges fit.

        Raises
        ------
        BadInput
            Where there is no map, or charges cannot fit it; the sentence says why.
        Interrupted
            After Ctrl-C.
        """
        from . import smoothing

        return smoothing.smooth(self, noise, probe, height, progress)

    def rhs(self, states: Any) -> Any:
        """The equations of motion: the derivatives of states by time, in the turning frame at the bead's drive.

        Parameters
        ----------
        states
            An array of the shape (..., 10), scaled: X Y vX vY nX nY nZ WX WY WZ.

        Returns
        -------
        numpy.ndarray
            The derivatives, of the same shape, scaled (times in 1/gamma).

        Raises
        ------
        BadInput
            Where the shape is another one, or a number is not finite.
        """
        from . import fields

        return fields.of_states(self, states, "rhs", (lib.FST_STATE_SIZE,))

    def jacobian(self, states: Any) -> Any:
        """The exact derivatives of :meth:`rhs` by the state.

        Parameters
        ----------
        states
            An array of the shape (..., 10), scaled: X Y vX vY nX nY nZ WX WY WZ.

        Returns
        -------
        numpy.ndarray
            Of the shape (..., 10, 10): J[..., i, j] is the derivative of the i-th component of rhs by the j-th of the state.

        Raises
        ------
        BadInput
            Where the shape is another one, or a number is not finite.
        """
        from . import fields

        return fields.of_states(self, states, "jacobian", (lib.FST_STATE_SIZE, lib.FST_STATE_SIZE))

    def observe(self, states: Any) -> Any:
        """What can be said of states: distance, moment and field in local components, slip, load, energy, powers.

        Parameters
        ----------
        states
            An array of the shape (..., 10), scaled: X Y vX vY nX nY nZ WX WY WZ.

        Returns
        -------
        numpy.recarray
            Of the shape (...), scaled: r, n and b in (r, alpha, z), b_norm, angle (rad), slip, slip_norm, spin, load, energy,
            friction_power, friction, friction_use, sticks, drive_power, ...

        Raises
        ------
        BadInput
            Where the shape is another one, or a number is not finite.
        """
        from . import fields

        return fields.observe(self, states)

    def flow(self, state: Any = None, **options: Any) -> "Flow":
        """A trajectory that is advanced step by step: a `Flow`.

        Parameters
        ----------
        state
            Ten numbers, scaled; by default that of start.*.
        **options
            Those of :class:`Flow`.

        Returns
        -------
        Flow
            At t = 0.

        Raises
        ------
        BadInput
            Where an argument is wrong; the sentence says what was expected.
        """
        from .flows import Flow

        return Flow(self, state, **options)

    # ------------------------------------------------------------------ pictures

    def movie(self, path: Path, *, periods: float = 20.0, progress: Progress = None, **options: Any) -> None:
        """Run the bead and make a film of the first periods after run.discard: see `Trajectory.movie`.

        Parameters
        ----------
        path
            .mp4, .gif or a folder of PNG frames.
        periods
            How many drive periods are shown.
        progress
            True: a bar; or a function of (fraction, what).
        **options
            Those of :meth:`Trajectory.movie`.

        Raises
        ------
        BadInput
            Where an argument is wrong; the sentence says what was expected.
        Unavailable
            Where ffmpeg or cairo is missing.
        Interrupted
            After Ctrl-C.
        """
        begin = float(lib.fst_run_discard(self._params))
        bead = self.replace(run__periods=begin + periods)
        made = bead.run(trajectory=True, sample_from=begin, progress=progress)
        made.trajectory.movie(path, progress=progress, **options)

    def plot_field(self, **options: Any) -> Any:
        """Draw the map of the magnet's field with matplotlib; returns its Axes: see `festoon.plots.field`.

        Parameters
        ----------
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

        return plots.field(self, **options)

    def figure(self, path: Path, units: str = "given") -> None:
        """The program's figure of the magnet's field on the plane of the bead's centre: .svg, .pdf or .png.

        Parameters
        ----------
        path
            The picture.
        units
            "given", "lab", "scaled" or "si".

        Raises
        ------
        BadInput
            Where the ending of the path, or an option, is wrong.
        Unavailable
            Where gnuplot or the ending's converter is missing.
        """
        from . import figures

        figures.field(self, path, units)

    def lab(self, height: int = 720) -> "Lab":
        """The browser page with this bead, shown in a notebook.

        Parameters
        ----------
        height
            Of the frame in the notebook, pixels.

        Returns
        -------
        Lab
            Shows itself in a notebook; `open()` opens a browser.

        Raises
        ------
        Unavailable
            Where the page was not built.
        """
        from .lab import Lab

        return Lab(self, height)


def _sign(cls: Any) -> None:
    """Editors and help() show the keywords."""
    import inspect

    names = [*SHORT, *(key.replace(".", "__") for key in PARAMETERS), "magnet__parts"]
    keywords = [inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=None) for name in names]
    first = [inspect.Parameter("self", inspect.Parameter.POSITIONAL_OR_KEYWORD)]
    scene = inspect.Parameter("scene", inspect.Parameter.POSITIONAL_OR_KEYWORD, default=None)
    cls.__init__.__signature__ = inspect.Signature([*first, scene, *keywords])
    cls.replace.__signature__ = inspect.Signature([*first, *keywords])


_sign(Bead)
