"""What a bead is made of: keywords, units, scenes, the tables behind them, and what is refused."""

import inspect
import math
import pathlib
import pickle
import xml.etree.ElementTree

import numpy as np
import pytest

import festoon as fs
from conftest import ask

SOURCE = pathlib.Path(__file__).resolve().parents[2]


def test_keywords_take_units_and_both_forms():
    bead = fs.Bead(frequency="642 rpm", friction__gamma="300 1/s", mu=0.3, start__phi="0.1 rad")
    assert bead.frequency == 642 / 60 and bead.gamma == 300.0 and bead.mu == 0.3
    assert bead.omega == pytest.approx(2 * math.pi * 10.7 / 300)
    assert bead.start__phi == pytest.approx(math.degrees(0.1))
    scaled = bead.replace(omega=0.25)
    assert scaled.omega == 0.25 and scaled.frequency == pytest.approx(0.25 * 300 / (2 * math.pi))
    assert scaled.replace(frequency=8).omega == pytest.approx(2 * math.pi * 8 / 300)
    assert fs.Bead(kappa=np.float64(1.2)).kappa == 1.2 and fs.Bead(magnet__lines=np.int64(3)).magnet__lines == 3


def test_a_quantity_given_twice_is_refused():
    with pytest.raises(fs.BadInput, match="two forms"):
        fs.Bead(frequency=8, omega=0.2)
    with pytest.raises(fs.BadInput, match="twice"):
        fs.Bead(frequency=8, drive__frequency=9)


def test_each_form_takes_the_place_of_the_other():
    from festoon._native import ffi, lib

    pairs = {}
    for key in fs._tables.PARAMETERS:
        other = lib.fst_param_other_form(key.encode())
        if other:
            pairs[key] = ffi.string(other).decode()
    assert len(pairs) == 18
    value_of = {key: max(0.5, 2 * lib.fst_param_at(lib.fst_param_find(key.encode())).least) for key in pairs}
    for one, two in pairs.items():
        if "magnet.b0" in (one, two):
            continue  # with lines and without a moment B0 is only the scale beside kappa
        first, second = ({key.replace(".", "__"): value_of[key]} for key in (one, two))
        base = fs.Bead(magnet__b0=0.01)
        bead = base.replace(**first).replace(**second)
        assert bead == base.replace(**second) and bead.groups == base.replace(**second).groups
        assert bead.replace(**dict.fromkeys(second, fs.UNSET)) == base
        with pytest.raises(fs.BadInput, match="two forms"):
            base.replace(**first, **second)
    assert fs.Bead(magnet__b0=0.01, kappa=2) == fs.Bead(kappa=2).replace(magnet__b0=0.01)
    with pytest.raises(fs.BadInput, match="two forms"):
        fs.Bead(magnet__b0=0.01, kappa=2, bead__moment=0.1)


def test_errors_carry_the_library_s_words():
    with pytest.raises(fs.BadInput) as caught:
        fs.Bead(friction__gama=3)
    assert caught.value.where == "friction.gama" and "the nearest is friction.gamma" in caught.value.sentence
    assert isinstance(caught.value, ValueError) and isinstance(caught.value, fs.FestoonError)
    again = pickle.loads(pickle.dumps(caught.value))
    assert (type(again), again.where, again.sentence) == (fs.BadInput, caught.value.where, caught.value.sentence)
    with pytest.raises(fs.BadInput, match="effect"):
        fs.Bead(bead__a=1.0).run()
    with pytest.raises(fs.NoConvergence):
        fs.Bead(frequency=2).orbit()


def test_scenes(tmp_path):
    bead = fs.Bead(frequency="9.3 Hz", kappa=1.7, friction__law="coulomb", bead__radius="2 mm")
    bead.save(tmp_path / "bead.yaml")
    assert fs.Bead.load(tmp_path / "bead.yaml") == bead == fs.Bead(tmp_path / "bead.yaml")
    assert fs.Bead(tmp_path / "bead.yaml", kappa=1.1) == bead.replace(kappa=1.1) != bead
    assert fs.Bead(bead.scene(comments=True)) == bead and hash(fs.Bead(bead.scene())) == hash(bead)
    assert pickle.loads(pickle.dumps(bead)) == bead
    assert eval(repr(bead), {"Bead": fs.Bead}) == bead
    (tmp_path / "bad.yaml").write_text("drive:\n  frequenzy: 3\n")
    with pytest.raises(fs.BadInput) as caught:
        fs.Bead.load(tmp_path / "bad.yaml")
    assert caught.value.where.endswith("bad.yaml:2") and "frequency" in caught.value.sentence


def test_every_parameter_is_a_keyword():
    """The tables of Python are those of the headers: rows of params.def and run.def by their macros."""
    import re

    text = (SOURCE / "include/festoon/params.def").read_text()
    keys = [".".join(pair) for pair in re.findall(r"^FST_(?:REAL|INT|CHOICE)\((\w+), (\w+),", text, re.M)]
    assert len(keys) > 30 and set(keys) <= set(fs._tables.PARAMETERS)
    names = re.findall(r"^FST_RESULT\((\w+),", (SOURCE / "include/festoon/run.def").read_text(), re.M)
    assert names == list(fs._tables.RESULTS)
    signature = inspect.signature(fs.Bead)
    for key in keys:
        assert key.replace(".", "__") in signature.parameters
        assert getattr(fs.Bead, key.replace(".", "__")).__doc__
    assert {"frequency", "omega", "kappa", "gamma", "mu"} <= set(signature.parameters)
    columns = re.findall(r"^FST_COLUMN\((\w+),", (SOURCE / "src/io/columns.def").read_text(), re.M)
    assert columns == list(fs._tables.COLUMNS)


def test_schema(program):
    assert fs.schema() == ask(program, "schema", "--json")


def test_card():
    bead = fs.Bead(friction__law="coulomb")
    page = bead._repr_html_()
    xml.etree.ElementTree.fromstring(f"<div>{page}</div>")
    assert "<svg" in page and "friction.law" in page and "coulomb" in page and "kappa" in page and len(page) < 60000
    points = page.split("points='")[1].split("'")[0].split()
    places = np.array([[float(number) for number in point.split(",")] for point in points])
    assert len(points) > 500 and places.min() >= 0 and places.max() <= 220 and np.ptp(places[:, 0]) > 100
    run = bead.run(periods=20)
    xml.etree.ElementTree.fromstring(f"<div>{run._repr_html_()}</div>")


def test_a_bead_never_changes():
    bead = fs.Bead()
    for name in ("kappa", "frequncy"):
        with pytest.raises(AttributeError, match="never changes"):
            setattr(bead, name, 1.2)


@pytest.mark.parametrize("value", [[1, 2], np.array([1.0, 2.0]), 1j, True, b"1", {}, "1\0", float("nan")])
def test_what_is_no_number_is_bad_input(value):
    with pytest.raises(fs.BadInput) as caught:
        fs.Bead(kappa=value)
    assert caught.value.where == "model.kappa"


def test_a_path_is_not_cut_off(tmp_path):
    with pytest.raises(ValueError, match="null"):
        fs.Bead().save(str(tmp_path / "bead\0.yaml"))
    assert not list(tmp_path.iterdir())


def test_the_page_or_a_sentence(tmp_path, monkeypatch):
    from festoon import lab

    monkeypatch.setattr(lab, "places", lambda: [tmp_path / lab.PAGE])
    with pytest.raises(fs.Unavailable, match="was not built"):
        fs.Bead().lab()
    (tmp_path / lab.PAGE).write_text("<html><head><title>t</title></head><body>\"&</body></html>")
    shown = fs.Bead(kappa=1.2, friction__law="coulomb").lab()
    assert shown.fragment == "v=1&friction.law=coulomb&model.kappa=1.2&drive.frequency=10.7"
    assert shown.url.startswith("file://") and shown.url.endswith(shown.fragment)
    page = shown._repr_html_()
    assert page.startswith("<iframe srcdoc=") and "v=1&amp;friction.law" in page


# ---------------------------------------------------------------------------------------- in a few words


def test_a_bead_says_what_was_given(tmp_path):
    """In any unit, the default's value too; what followed from it is not said, and what it no longer has."""
    for bead, words in (
        (fs.Bead(), "Bead()"),
        (fs.Bead(frequency="642 rpm", kappa=1.5), "Bead(frequency=10.7, kappa=1.5)"),
        (fs.Bead(frequency=8).replace(omega=0.2), "Bead(omega=0.2)"),
        (fs.Bead(kappa=1.5).replace(kappa=fs.UNSET), "Bead()"),
        (fs.Bead(fs.Bead(mu=0.2), friction__law="viscous"), "Bead(friction__law='viscous', mu=0.2)"),
        (fs.Bead(run__periods=20).run().bead, "Bead(run__periods=20)"),
        (fs.Bead(run__periods=20).run().bead.replace(kappa=1.2), "Bead(kappa=1.2, run__periods=20, run__discard=10)"),
    ):
        assert repr(bead) == repr(pickle.loads(pickle.dumps(bead))) == words
    assert eval(repr(fs.Bead(frequency="642 rpm", kappa=1.5)), {"Bead": fs.Bead}) == fs.Bead(frequency="642 rpm")


def test_results_are_told_in_a_few_lines(bead):
    run = bead.run(trajectory=True)
    assert 4 <= len(repr(run).splitlines()) <= 8 and "mean_r" in repr(run) and "+-" in repr(run)
    card = repr(run.trajectory)
    assert len(card.splitlines()) <= 8 and "3841 samples" in card and "n_z" in card and "mm" in card
    page = run.trajectory._repr_html_()
    xml.etree.ElementTree.fromstring(f"<div>{page}</div>")
    assert "<svg" in page and "3841 samples" in page and len(page) < 100_000
    assert "0 samples" in repr(run.trajectory[:0]) and "samples" not in repr(run.trajectory["r"][:3])


def test_only_public_names_are_completed():
    from types import ModuleType

    assert set(dir(fs)) == {*fs.__all__, "__version__"}
    assert {name for name in dir(fs) if isinstance(getattr(fs, name), ModuleType)} == {"figures", "plots"}
