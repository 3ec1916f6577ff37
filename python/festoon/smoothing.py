"""Noisy maps of a field, smoothed by charges that fit them."""

import math
from typing import Any, Optional, Tuple, Union

import numpy as np

from . import fields
from ._errors import BadInput, Interrupted
from ._native import Watch, call, ffi, lent, lib, path_bytes, text_of
from ._progress import Progress
from ._quantities import quantity
from ._tabled import Column, Table, Tabled, about
from .bead import Bead, Path

#: Factors of B and of its gradient, with their units, from T and T/m.
SHOWN = {"si": (1.0, "m", 1.0, "T", "T/m"), "lab": (1e3, "mm", 1e3, "mT", "mT/mm")}


class SmoothedMap(Tabled):
    """The field of charges that fit the noisy map of a bead's magnet, at one height, with standard errors.

    Its table has the field at the places of the map's samples.  `save` writes a map, which a bead can run over:
    ``bead.replace(magnet__file="smooth.csv")``.
    """

    #: The bead whose magnet's map was smoothed, and the height over the reference plane [m] that was asked for.
    bead: Bead
    height: float

    #: Of a drawn field, which has no errors; None: the likeliest field.
    seed: Optional[int]

    def __init__(self, bead: Bead, how: Tuple[float, bool, float], field_map: Any, fit_of: Any = None, seed: Optional[int] = None) -> None:
        self.bead, self._how, self._map, self.seed = bead, how, field_map, seed
        self.height = how[2]
        params = ffi.new("fst_params *", bead._params[0])
        params.magnet_map = field_map
        model = ffi.new("fst_model **")
        call(lib.fst_field_model_new, params, self.height / params.magnet_half_length, model)
        self._model = ffi.gc(model[0], lib.fst_model_free)
        groups = lib.fst_model_groups(self._model)
        self._length, self._tesla = float(groups.length_unit), float(groups.field_unit)
        self._facts = lib.fst_field_map_describe(fit_of or field_map)  # `fit` lies in it
        self._fit = self._facts.fit

    @property
    def charges(self) -> int:
        """How many charges fit the map."""
        return int(self._fit.charges)

    @property
    def depth(self) -> float:
        """Of the uppermost charges below the map [m]."""
        return float(self._fit.depth)

    @property
    def rms(self) -> float:
        """Of what is left of a component of a sample [T]."""
        return float(self._fit.rms)

    @property
    def noise(self) -> float:
        """Of a component, as the fit estimates it, or as told [T]; errors are those of this noise."""
        return float(self._fit.noise)

    @property
    def rough_noise(self) -> float:
        """The noise by differences of neighbouring samples alone [T]."""
        return float(self._fit.rough)

    @property
    def degrees_of_freedom(self) -> float:
        """That are left [1]: the samples' numbers less the trace of the matrix that makes the fitted ones of them."""
        return float(self._fit.free)

    @property
    def chi2(self) -> float:
        """Per degree of freedom [1], against the noise told, or against `rough_noise` where none was."""
        return float(self._fit.chi2)

    @property
    def chi2_bound(self) -> Any:
        """Between which at least 95 % of `chi2` are, if the noise told is the map's; NaN where none was told."""
        return self._vector("bound")

    @property
    def verdict(self) -> str:
        """On the noise told: not told, agrees, too small, too large; or misfit: more is left than noise."""
        return text_of(lib.fst_noise_verdict_name(self._fit.verdict))

    @property
    def sentence(self) -> str:
        """The same in a line, with numbers; "" where there is nothing to say."""
        text = ffi.new("char[]", 256)
        lib.fst_map_fit_sentence(ffi.addressof(self._facts, "fit"), text, 256)
        return text_of(text)

    @property
    def noise_seen(self) -> Any:
        """The noise that what is left shows, and between which two numbers it is with 95 % [T]."""
        return self._vector("seen")

    def _vector(self, name: str) -> Any:
        return lent(np.array(list(getattr(self._fit, name))))

    @property
    def turned(self) -> Any:
        """How the probe's axes are turned: a rotation vector [rad]; zeros where they were not free."""
        return self._vector("turned")

    @property
    def turned_error(self) -> Any:
        """Its standard error [rad]."""
        return self._vector("turned_error")

    @property
    def offset(self) -> Any:
        """What the probe's axes show in no field [T]; zeros where that was not free."""
        return self._vector("offset")

    @property
    def offset_error(self) -> Any:
        """Its standard error [T]."""
        return self._vector("offset_error")

    def field(self, x: Any, y: Any, units: str = "scaled") -> Tuple[Any, Any]:
        """The field and its gradient: (B, G), as `Bead.field` tells them; NaN beyond the map.

        Parameters
        ----------
        x, y
            Places in the frame of the magnet, which broadcast, in l or m, or texts with a unit.
        units
            "scaled" or "si".

        Returns
        -------
        tuple of numpy.ndarray
            B of the shape (..., 3) and G of the shape (..., 3, 3), in B0 and B0/l, or T and T/m.

        Raises
        ------
        BadInput
            Where units are unknown.
        Interrupted
            After Ctrl-C.
        """
        return fields.field(self, x, y, None, units)

    def errors(self, x: Any, y: Any, units: str = "scaled") -> Tuple[Any, Any, Any]:
        """Standard errors of the field, of its gradient, and of the force on a bead whose moment is along B.

        Parameters
        ----------
        x, y
            Places in the frame of the magnet, which broadcast, in l or m, or texts with a unit.
        units
            "scaled" or "si".

        Returns
        -------
        tuple of numpy.ndarray
            Of the shapes (..., 3), (..., 3, 3) and (..., 3), in B0, B0/l and l gamma^2 (per mass), or in T, T/m and N;
            NaN beyond the map.

        Raises
        ------
        BadInput
            Where units are unknown.
        Interrupted
            After Ctrl-C.
        """
        xs, ys, shape = fields.places(x, y, units, self._length)
        made = np.full((xs.size, 15), np.nan)
        b, grad, force = ffi.new("double[3]"), ffi.new("double[3][3]"), ffi.new("double[3]")
        try:
            for row, one, other in zip(made, xs, ys):
                if lib.fst_field_error(self._model, one, other, b, grad, force):
                    row[:] = [*b, *(number for line in grad for number in line), *force]
        except KeyboardInterrupt:
            raise Interrupted() from None
        if units == "si":
            groups = lib.fst_model_groups(self._model)
            newton = groups.mass * self._length / groups.time_unit**2
            made *= np.repeat([self._tesla, self._tesla / self._length, newton], [3, 9, 3])
        made = made.reshape(*shape, 15)
        return made[..., :3], made[..., 3:12].reshape(*shape, 3, 3), made[..., 12:]

    def draw(self, seed: int, *, progress: Progress = None) -> "SmoothedMap":
        """A field drawn from all that the noise allows, each as often as it is likely.

        Runs over several, each saved as a map, show what the map's noise does to a motion.

        Parameters
        ----------
        seed
            Gives the same field again; the program's `--draws N` has the seeds 1 to N.
        progress
            True: a bar; or a function of (fraction, what).

        Returns
        -------
        SmoothedMap
            The drawn field, whose errors are NaN.

        Raises
        ------
        BadInput
            Of a drawn field, from which none is drawn.
        Interrupted
            After Ctrl-C.
        """
        drawn = ffi.new("fst_field_map **")
        with Watch(progress, title="draw") as watch:
            watch.call(lib.fst_field_map_draw, self._map, seed, watch.told, drawn)
        return SmoothedMap(self.bead, self._how, ffi.gc(drawn[0], lib.fst_field_map_free), self._map, seed)

    def save(self, path: Path, radius: Any = None, spacing: Any = "1 mm", *, progress: Progress = None) -> None:
        """Write the field as a map, which `magnet__file` reads, with columns of errors.

        Parameters
        ----------
        path
            The file, .csv.
        radius
            How far from the axis it goes along X and Y, m or a text with a unit; by default as far as the map.
        spacing
            From one sample to the next, m or a text with a unit.
        progress
            True: a bar; or a function of (fraction, what).

        Raises
        ------
        BadInput
            Where it would go further than the map, or has too many or too few steps.
        InputOutput
            Where the file cannot be written.
        Interrupted
            After Ctrl-C; nothing is written.
        """
        most = self._facts.radius if radius is None else quantity(radius, lib.FST_UNIT_LENGTH, "radius")
        step = quantity(spacing, lib.FST_UNIT_LENGTH, "spacing")
        with Watch(progress, title="map") as watch:
            watch.call(lib.fst_field_map_write, path_bytes(path), self._model, most, step, watch.told)

    def _table(self, units: Optional[str]) -> Table:
        """The field at the places of the map's samples, in SI unless units say otherwise."""
        if (units or "si") not in SHOWN:
            raise BadInput("units", f'unknown units "{units}" of a map; there are {", ".join(SHOWN)}')
        length, metre, tesla, field, slope = SHOWN[units or "si"]
        facts = lib.fst_field_map_describe(self.bead._params.magnet_map)
        x, y = (facts.first[i] + facts.spacing[i] * np.arange(facts.count[i]) for i in (0, 1))
        places = (x[None, :], y[:, None], "si")
        (b, grad), (eb, egrad, _) = self.field(*places), self.errors(*places)
        columns = {}
        for before, vector, matrix, doc in (("", b, grad, ""), ("e", eb, egrad, "standard error of ")):
            for i, name in enumerate(("Bx", "By", "Bz")):
                columns[before + name] = Column(("y", "x"), tesla * vector[..., i], field, f"{doc}a component of the field")
                for k, axis in enumerate("xyz"):
                    values = tesla / length * matrix[..., i, k]
                    columns[f"{before}d{name}_d{axis}"] = Column(("y", "x"), values, slope, f"{doc}a component of its gradient")
        coords = {name: Column((name,), length * values, metre) for name, values in (("y", y), ("x", x))}
        return Table(("y", "x"), coords, columns, about(self.bead.scene(), height=length * self.height))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, SmoothedMap) and self.bead == other.bead and self._identity() == other._identity()

    def _identity(self) -> str:
        return repr((self._how, self.seed))

    def __hash__(self) -> int:
        return hash((self.bead, self._identity()))

    def __reduce__(self) -> Any:
        return _again, (self.bead, self._how, self.seed)  # the fit is done again, and has the same bits

    def __repr__(self) -> str:
        text = f"SmoothedMap: {self.charges} charges from {1e3 * self.depth:.4g} mm below the map on, noise {1e3 * self.noise:.4g} mT"
        text += f", chi^2 of {self.degrees_of_freedom:.0f} degrees of freedom: {self.chi2:.4g} each"
        drawn = "" if self.seed is None else f"\n  a field drawn with the seed {self.seed}"
        return text + (f"\n  {self.sentence}" if self.sentence else "") + drawn


def _again(bead: Bead, how: Tuple[float, bool, float], seed: Optional[int]) -> SmoothedMap:
    made = _fit(bead, how, None)
    return made if seed is None else made.draw(seed)


def _fit(bead: Bead, given: Tuple[float, bool, float], progress: Progress) -> SmoothedMap:
    noise, probe, height = given
    usual = bead._params.magnet_depth + bead._params.bead_radius
    how = ffi.new("fst_smoothing *", {"noise": noise, "probe": probe, "height": height, "lies": usual})
    found = ffi.new("fst_field_map **")
    with Watch(progress, title="smooth") as watch:
        watch.call(lib.fst_field_map_smooth, bead._params.magnet_map, how, watch.told, found)
    return SmoothedMap(bead, given, ffi.gc(found[0], lib.fst_field_map_free))


def smooth(bead: Bead, noise: Union[None, float, str], probe: bool, height: Any, progress: Progress) -> SmoothedMap:
    """See Bead.smooth()."""
    if not bead._params.magnet_map:
        raise BadInput("smooth", "the bead's magnet has no map: it is for magnet__file")
    usual = bead._params.magnet_depth + bead._params.bead_radius
    wanted = usual if height is None else quantity(height, lib.FST_UNIT_LENGTH, "height")
    told = math.nan if noise is None else quantity(noise, lib.FST_UNIT_FIELD, "noise")
    return _fit(bead, (told, bool(probe), wanted), progress)
