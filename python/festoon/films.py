"""Films of a trajectory, and the track of a bead in a film."""

import base64
import os
import tempfile
from typing import Any, Dict, Optional, Union

from ._given import whole_of
from ._native import Watch, ffi, lib, options_of, path_bytes, text_of
from ._progress import Progress
from .figures import set_options

Path = Union[str, "os.PathLike[str]"]


def movie(samples: Any, path: Path, progress: Progress, **given: Any) -> None:
    """See Trajectory.movie() and BeadsTrajectory.movie()."""
    options = options_of(lib.fst_default_film_options())
    kept = set_options(options, given, "movie")
    table, arrays = samples._rows()
    with Watch(progress, title="film") as watch:
        options.progress = watch.told
        of_beads = ffi.typeof(table) is ffi.typeof("fst_beads_table *")
        watch.call(lib.fst_film_beads if of_beads else lib.fst_film, table, path_bytes(path), options)
    del arrays, kept


class Animation:
    """A film (mp4) that lies in the notebook itself; save() writes it as a file."""

    def __init__(self, film: bytes, width: int) -> None:
        self.film, self.width = film, width

    def save(self, path: Path) -> None:
        """Write the film."""
        with open(path, "wb") as file:
            file.write(self.film)

    def __repr__(self) -> str:
        return f"Animation: {len(self.film)} bytes of mp4"

    def _repr_html_(self) -> str:
        source = base64.b64encode(self.film).decode("ascii")
        return f'<video controls loop width="{self.width}" src="data:video/mp4;base64,{source}"></video>'


class Filmed:
    """What trajectories of one bead and of several have in common: a film in a notebook."""

    def animate(self, *, progress: Progress = None, **options: Any) -> Animation:
        """The film of movie() in a notebook, 480 pixels wide unless told: an HTML5 video.

        Parameters
        ----------
        progress
            True: a bar; or a function of (fraction, what).
        **options
            Those of movie().

        Returns
        -------
        Animation
            A notebook shows it; save(path) writes it.

        Raises
        ------
        BadInput
            Where an argument is wrong; the sentence says what was expected.
        Unavailable
            Where ffmpeg or cairo is missing.
        Interrupted
            After Ctrl-C.
        """
        given = {"width": 480, "height": 480, **options}
        with tempfile.TemporaryDirectory(prefix="festoon-film-") as folder:
            path = os.path.join(folder, "film.mp4")
            movie(self, path, progress, **given)
            with open(path, "rb") as file:
                return Animation(file.read(), int(given["width"]))


def _facts(struct: Any) -> Dict[str, Any]:
    """The fields of a struct as Python objects."""
    found: Dict[str, Any] = {}
    for name, field in ffi.typeof(struct).item.fields:
        value = getattr(struct, name)
        if field.type.kind == "array" and field.type.item.kind == "struct":
            value = [_facts(ffi.addressof(value, i)) for i in range(len(value))]
        elif field.type.kind == "array":
            is_text = field.type.item.cname == "char"
            value = text_of(value) if is_text else ffi.unpack(value, len(value))
            if not is_text and field.type.item.kind == "array":
                value = [list(row) for row in value]
        found[name] = value
    return found


def camera(samples: Any, path: Path, truth: Optional[Path], progress: Progress, **given: Any) -> Dict[str, Any]:
    """See Trajectory.film()."""
    options = options_of(lib.fst_default_camera_options())
    kept = set_options(options, given, "film")
    table, arrays = samples._rows()
    facts = ffi.new("fst_camera_facts *")
    truth_path = ffi.NULL if truth is None else path_bytes(truth)
    with Watch(progress, title="film") as watch:
        options.progress = watch.told
        watch.call(lib.fst_camera_film, table, path_bytes(path), truth_path, options, facts)
    del arrays, kept
    return _facts(facts)


def track(film: Path, *, beads: int = 1, progress: Progress = None, **given: Any) -> Any:
    """Find the bead in every frame of a film: a `Track`, whose `report` says what is known of the film.

    Options: fps, scale ("bead 5 mm", "plate 460 mm", "X1,Y1:X2,Y2=50mm", or several with ; between them), distance, and
    the files csv, overlay, picture.

    Parameters
    ----------
    film
        The file.
    beads
        How many beads of one size are followed, 1 to 4.
    progress
        True: a bar; or a function of (fraction, what).
    **given
        The options above.

    Returns
    -------
    Track
        Its lengths are in mm where there is a scale.  Of several beads it is a list, of which `report["doubts"]` says from
        which frames on names may be exchanged.

    Raises
    ------
    MissingFile
        Where the file is not there.
    BadInput
        Where it is damaged, or something else.
    Unavailable
        Where ffmpeg is missing.
    Interrupted
        After Ctrl-C.
    """
    from .measuring import Track

    options = options_of(lib.fst_default_film_track_options())
    kept = set_options(options, given, "track")
    options.beads = whole_of(beads, "beads")
    found = ffi.new("fst_track[]", lib.FST_TRACKED_BEADS)
    report = ffi.new("fst_film_track_report *")
    with Watch(progress, title="track") as watch:
        options.progress = watch.told
        watch.call(lib.fst_film_track, path_bytes(film), options, found, report)
    del kept
    facts = _facts(report)
    facts["edges"] = facts["edges"][: report.edge_count]
    facts["scales"] = facts["scales"][: report.scale_count]
    facts["doubts"] = facts["doubts"][: report.doubt_count]
    made = []
    for i in range(beads):
        made.append(Track._of(ffi.gc(ffi.new("fst_track *", found[i]), lib.fst_track_free)))
        made[-1].report = facts
    return made if beads > 1 else made[0]
