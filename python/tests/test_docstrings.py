"""Every public name says what it takes, what it gives back, in which unit, and what it raises, in numpydoc's form."""

import inspect
import re

import numpy as np
import pytest

import festoon as fs

KEYWORDS = {*fs._tables.SHORT, *(key.replace(".", "__") for key in fs._tables.PARAMETERS), "magnet__parts"}


def own(kind, name):
    """Whether a member is the module's, and not numpy's, a mapping's or a table's."""
    if not name.startswith("_") and any(name in base.__dict__ for base in kind.__mro__ if base.__module__.startswith("festoon.")):
        found = next(base.__dict__[name] for base in kind.__mro__ if name in base.__dict__)
        return found.__func__ if isinstance(found, (classmethod, staticmethod)) else found
    return None


def public():
    """Names and objects: functions, classes, and their members."""
    for name in fs.__all__:
        thing = getattr(fs, name)
        if inspect.ismodule(thing):
            for inner, function in vars(thing).items():
                defined = inspect.isfunction(function) and function.__module__.startswith("festoon.")
                if defined and inner in getattr(thing, "__all__", ()):
                    yield f"{name}.{inner}", function
        elif inspect.isclass(thing):
            yield name, thing
            for member in dir(thing):
                found = own(thing, member)
                if inspect.isfunction(found) or isinstance(found, property):
                    yield f"{name}.{member}", found
        elif callable(thing):
            yield name, thing


PUBLIC = dict(public())


def section(text, title):
    """The lines of a section, or None."""
    found = re.search(rf"^{title}\n-+\n(.*?)(?=^\w+\n-+\n|\Z)", text, re.M | re.S)
    return found and found.group(1)


def test_all_are_looked_at():
    assert len(PUBLIC) > 250 and {"figures.points", "plots.sweep", "Bead.rhs", "Run.mean_r"} <= set(PUBLIC)


@pytest.mark.parametrize("name", [name for name, thing in PUBLIC.items() if inspect.isfunction(thing)])
def test_a_function_says_what_it_takes_gives_and_raises(name):
    function, text = PUBLIC[name], inspect.getdoc(PUBLIC[name]) or ""
    signature = inspect.signature(function)
    described = section(text, "Parameters") or ""
    heads = {word.strip(" *") for line in re.findall(r"^(\S.*)$", described, re.M) for word in line.split(",")}
    wanted = {parameter for parameter in signature.parameters if parameter not in ("self", "cls")} - KEYWORDS
    assert wanted <= heads, f"{wanted - heads} not described"
    if function.__annotations__.get("return") is not None:
        assert section(text, "Returns")
    assert section(text, "Raises")
    titles = re.findall(r"^(\w+)\n-{4,}$", text, re.M)
    order = ["Parameters", "Returns", "Raises", "Notes", "Examples"]
    assert titles == [title for title in order if title in titles]
    assert ">>>" not in text or "Examples" in titles


@pytest.mark.parametrize("name", [name for name, thing in PUBLIC.items() if isinstance(thing, property)])
def test_a_property_says_its_unit(name):
    text = inspect.getdoc(PUBLIC[name])
    assert text
    if PUBLIC[name].fget.__annotations__.get("return") in (float, "float"):
        assert re.search(r"\[[^]]+\]", text), "a number has a unit, or [1]"


@pytest.mark.parametrize("name", [name for name, thing in PUBLIC.items() if inspect.isclass(thing)])
def test_a_class_says_what_it_is(name):
    kind = PUBLIC[name]
    assert inspect.getdoc(kind) and kind.__doc__ != np.ndarray.__doc__
    if name in ("Flow", "Track"):  # a user makes these; a Bead has the keywords of the tables
        wanted = set(inspect.signature(kind).parameters)
        described = section(inspect.getdoc(kind), "Parameters") or ""
        assert wanted <= {word.strip(" *") for line in described.splitlines() for word in line.split(",")}
        assert section(inspect.getdoc(kind), "Raises")
