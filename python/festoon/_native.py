"""The library behind the module: errors as exceptions, calls that obey Ctrl-C, arrays over C memory."""

import _thread
import os
import threading
from typing import TYPE_CHECKING, Any, Callable, Dict, Iterator, List, Optional, Tuple, Type

import numpy as np

from ._errors import Interrupted, OutOfMemory, exception_of
from ._festoon import ffi, lib
from ._progress import Progress, bar_for

if TYPE_CHECKING:
    from types import TracebackType

__all__ = [
    "Watch",
    "call",
    "dtype_of",
    "error_of",
    "exception_of",
    "ffi",
    "lent",
    "lib",
    "new_error",
    "options_of",
    "owned_array",
    "rows_of",
    "state_of",
    "take_text",
    "text_of",
]


def text_of(pointer: Any) -> str:
    """A C string as str; "" for NULL."""
    return str(ffi.string(pointer).decode("utf-8", "replace")) if pointer else ""


def places_of(names: Any) -> Dict[str, int]:
    """The names of a list "one|two|..." and their places, which are the numbers of an enum."""
    return {name: place for place, name in enumerate(text_of(names).split("|"))}


def take_text(pointer: Any) -> str:
    """A C string that the caller must free."""
    if not pointer:
        raise OutOfMemory("", "no memory for a text")
    try:
        return text_of(pointer)
    finally:
        lib.free(pointer)


def path_bytes(path: Any) -> bytes:
    """A path as C wants it."""
    found = os.fsencode(path)
    if b"\0" in found:
        raise ValueError(f"{path!r}: a path has no null character")
    return found


# ---------------------------------------------------------------------------------------- errors


def new_error() -> Any:
    return ffi.new("fst_error *")


def error_of(error: Any) -> BaseException:
    """The exception of a filled-in fst_error, with its words, but for names of C."""
    return exception_of(int(error.code), text_of(error.where), text_of(error.sentence))


def call(function: Callable[..., int], *arguments: Any) -> None:
    """Call a function whose last argument is an fst_error, and raise what it says."""
    error = new_error()
    if function(*arguments, error) != lib.FST_OK:
        raise error_of(error)


# ---------------------------------------------------------------------------------------- progress and Ctrl-C


class Watch:
    """A call that may last: it shows its progress, and Ctrl-C ends it within a tenth of a second.

    `with Watch(progress, partial) as watch: watch.call(function, ..., watch.told, ...)`.  Python runs signal
    handlers while the library asks whether to go on; an exception raised there ends the call and is raised
    again here, KeyboardInterrupt as Interrupted with what partial() returns.
    """

    def __init__(self, progress: Progress, partial: Callable[[], Any] = lambda: None, title: str = "") -> None:
        self.raised: Optional[BaseException] = None
        #: Of a call apart: what it told last, and whether it is to end.
        self._told: Optional[Tuple[float, str]] = None
        self._apart = self._given_up = False
        self._partial = partial
        self._bar = bar_for(progress, title)
        self._handle = ffi.new_handle(self)
        self._watch = ffi.new("pyf_watch *", {"handle": self._handle})
        self.told = ffi.new(
            "fst_progress *", {"user": self._watch, "tell": ffi.addressof(lib, "pyf_tell")}
        )

    def tell(self, fraction: float, what: str) -> None:
        if not self._apart:
            self._bar.tell(fraction, what)
        elif self._given_up:
            raise Interrupted()
        else:
            self._told = fraction, what

    def call(self, function: Callable[..., int], *arguments: Any) -> None:
        error = new_error()
        status = function(*arguments, error)
        if status == lib.FST_INTERRUPTED and self.raised is not None:
            raise self.raised
        if status != lib.FST_OK:
            raise error_of(error)

    def call_apart(self, function: Callable[..., int], *arguments: Any, keeping: Any = ()) -> None:
        """A call that asks too seldom whether to go on, done in a thread of its own.

        Ctrl-C leaves that thread to itself: what it still works on is its own, or stays as it is, and it keeps
        `keeping` and the arguments alive.  An object of the user's that the call changes must be a copy.
        """
        if threading.current_thread() is not threading.main_thread():  # Python has no Ctrl-C here
            self.call(function, *arguments)
            return
        error, status, ended = new_error(), [lib.FST_OK], threading.Event()
        raised: List[BaseException] = []

        def work(*kept: Any) -> None:
            try:
                status[0] = function(*arguments, error)
            except BaseException as exception:  # such as a MemoryError before the call
                raised.append(exception)
            finally:
                ended.set()

        self._apart = True
        try:
            # Not by threading.Thread, whose start() waits for ever for a thread that gets no memory.
            try:
                _thread.start_new_thread(work, (self, arguments, keeping))
            except RuntimeError as said:  # so Python says that there is no memory for one
                raise OutOfMemory("", str(said)) from None
            while not ended.wait(0.03):
                told, self._told = self._told, None
                if told is not None:
                    self._bar.tell(*told)
        except BaseException:
            self._given_up = True
            raise
        self._apart = False
        if raised:
            raise raised[0]
        if status[0] != lib.FST_OK:
            raise error_of(error)

    def __enter__(self) -> "Watch":
        self.raised = None
        return self

    def __exit__(
        self,
        kind: Optional[Type[BaseException]],
        exception: Optional[BaseException],
        traceback: "Optional[TracebackType]",
    ) -> None:
        self._bar.end(exception is None)
        if isinstance(exception, KeyboardInterrupt) and not isinstance(exception, Interrupted):
            raise Interrupted(self._partial()) from None


def _keep(kind: Any, exception: BaseException, traceback: Any) -> None:
    """An exception out of tell(): kept for the call that it ends."""
    ffi.from_handle(traceback.tb_frame.f_locals["handle"]).raised = exception


@ffi.def_extern(error=lib.FST_INTERRUPTED, onerror=_keep)  # type: ignore[misc]
def pyf_tell_python(handle: Any, fraction: float, what: Any, error: Any) -> int:
    ffi.from_handle(handle).tell(fraction, text_of(what))
    return int(lib.FST_OK)


# ---------------------------------------------------------------------------------------- arrays over C memory


def dtype_of(ctype: Any) -> Any:
    """The numpy dtype of a C type, with the offsets that the compiler gave it.  Pointers are numbers."""
    if isinstance(ctype, str):
        ctype = ffi.typeof(ctype)
    size = ffi.sizeof(ctype)
    if ctype.kind == "struct":
        fields = [(name, field) for name, field in ctype.fields]
        return np.dtype(
            {
                "names": [name for name, _ in fields],
                "formats": [dtype_of(field.type) for _, field in fields],
                "offsets": [field.offset for _, field in fields],
                "itemsize": size,
            }
        )
    if ctype.kind == "array":
        if ctype.item.cname == "char":
            return np.dtype(f"S{ctype.length}")
        return np.dtype((dtype_of(ctype.item), (ctype.length,)))
    if ctype.kind == "primitive" and ctype.cname in ("double", "float"):
        return np.dtype(f"f{size}")
    if ctype.kind == "pointer":
        return np.dtype(f"u{size}")
    unsigned = ctype.kind == "primitive" and ctype.cname.startswith(("u", "size_t"))
    return np.dtype(f"{'u' if unsigned else 'i'}{size}")


def lent(array: Any) -> Any:
    """An array of a result, which nobody changes by mistake: it can be read alone."""
    array.flags.writeable = False
    return array


def state_of(numbers: Any) -> Any:
    """Numbers of the library as an array that can be read."""
    return lent(np.array(list(numbers)))


def owned_array(pointer: Any, count: int, dtype: Any, owner: Any, writable: bool = False) -> Any:
    """An array over C memory, no copy; it keeps `owner`, whose end frees the memory, alive."""
    dtype = np.dtype(dtype)
    if not count:
        return lent(np.zeros(0, dtype))
    anchor = ffi.gc(pointer, lambda _, owner=owner: None)
    made = np.frombuffer(ffi.buffer(anchor, count * dtype.itemsize), dtype)
    return made if writable else lent(made)


def freed_array(pointer: Any, count: int, dtype: Any) -> Any:
    """An array over memory from malloc(), no copy; the memory is freed with the last view of it."""
    dtype = np.dtype(dtype)
    if not count:
        lib.pyf_free(pointer)
        return lent(np.zeros(0, dtype))
    owned = ffi.gc(pointer, lib.pyf_free, count * dtype.itemsize)
    return lent(np.frombuffer(ffi.buffer(owned, count * dtype.itemsize), dtype))


def rows_of(what: str) -> Iterator[Any]:
    """The rows of a table of the library: fst_WHAT_count() times fst_WHAT_at(i)."""
    at = getattr(lib, f"fst_{what}_at")
    for i in range(getattr(lib, f"fst_{what}_count")()):
        yield at(i)


def options_of(default: Any) -> Any:
    """A pointer to options that a fst_default_*_options() returned."""
    return ffi.new(f"{ffi.typeof(default).cname} *", default)


def strings(words: List[str]) -> Tuple[Any, List[Any]]:
    """An array of C strings, and what must stay alive with it."""
    for word in words:
        if not isinstance(word, str):
            raise TypeError(f"{word!r} is not a text")
    kept = [ffi.new("char[]", word.encode()) for word in words]
    return ffi.new("const char *[]", kept), kept
