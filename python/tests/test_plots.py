"""Plots: an Axes comes back, with the numbers of the result in the units that its labels name."""

import subprocess
import sys

import numpy as np
import pytest

import festoon as fs
from festoon import _plot_sweeps, _style, plots

pytest.importorskip("matplotlib")


@pytest.fixture(autouse=True)
def closed():
    yield
    import matplotlib.pyplot

    matplotlib.pyplot.close("all")


@pytest.fixture(scope="module")
def run():
    return fs.Bead(run__discard=40).run(periods=60, trajectory=True)


@pytest.fixture(scope="module")
def line():
    return fs.sweep(fs.Bead(run__periods=40), frequency=[8.0, 10.0, 12.0, 16.0])


def curve(ax, number=0):
    """The points of a line, without its gaps between runs of different regimes."""
    x, y = ax.lines[number].get_xydata().T
    return np.stack([x[np.isfinite(x)], y[np.isfinite(x)]])


def words(ax):
    key = ax.get_legend()
    return [] if key is None else [text.get_text() for text in key.get_texts()]


def colour_map(ax):
    """The scale of colours beside an Axes."""
    return ax.child_axes[0]


def test_path_in_millimetres(run):
    ax = run.trajectory.plot(end=45)
    assert ax.get_xlabel() == "x (mm)" and ax.get_aspect() == 1
    turns = run.trajectory.drive_turns
    shown = run.trajectory[(turns >= 40 - 1e-9) & (turns <= 45 + 1e-9)]
    drawn = ax.collections[-1].get_segments()
    assert np.allclose(drawn[0][0], 23 * np.array([shown.x[0], shown.y[0]]), rtol=1e-12)
    # Every sample is a corner of the smooth curve.
    corners = np.array([segment[0] for segment in drawn])
    pieces = len(corners) // (len(shown) - 1)
    assert np.allclose(corners[::pieces][: len(shown) - 1], 23 * np.stack([shown.x, shown.y], axis=1)[:-1], rtol=1e-12)
    assert words(ax)[0].startswith("outline of the magnet's lines")


@pytest.mark.parametrize("frame", ["lab", "magnet"])
def test_curves_between_samples_follow_the_motion(frame):
    """A path of half as many samples lies on that of all samples, to the fourth order in their distance."""
    short = fs.Bead(run__discard=0, run__samples=64).run(periods=2, trajectory=True).trajectory
    gaps = []
    for step in (2, 4):
        ax = short[::step].plot(frame=frame, begin=0, end=2, units="scaled")
        drawn = np.array([segment[0] for segment in ax.collections[-1].get_segments()])
        names = ("x", "y") if frame == "lab" else ("X", "Y")
        truth = np.stack([short._column(name) for name in names], axis=1)
        pieces = len(drawn) // (len(short[::step]) - 1)
        middle = drawn[pieces // 2 :: pieces]
        gaps.append(np.abs(middle - truth[step // 2 :: step][: len(middle)]).max())
    assert 0 < gaps[0] < 1e-4 and gaps[1] / gaps[0] > 8


def test_the_magnet_turns_with_the_path(run):
    """In the laboratory the magnet's long side points where the drive has turned it."""
    ax = run.trajectory.plot(begin=10.25, units="scaled")
    first = run.trajectory[np.searchsorted(run.trajectory.drive_turns, 10.25 - 1e-9)]
    corners = curve(ax)
    along = np.array([corners[0][1] - corners[0][0], corners[1][1] - corners[1][0]])
    angle = float(first["alpha"] - first["Phi"])
    assert np.allclose(along, [2 * np.cos(angle), 2 * np.sin(angle)], atol=1e-12)
    assert np.isclose(angle, 2 * np.pi * float(first["drive_turns"]), rtol=1e-12)


def test_a_column_over_another(run):
    ax = run.trajectory.plot("r", over="t", begin=40, end=50)
    shown = run.trajectory[(run.trajectory.drive_turns >= 40 - 1e-9) & (run.trajectory.drive_turns <= 50 + 1e-9)]
    assert np.allclose(curve(ax), [shown.si.t, 1000 * shown.si.r], rtol=1e-12)
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("time (s)", "r (mm)")


def test_into_axes_of_ones_own(run, line):
    import matplotlib.pyplot as plt

    figure, both = plt.subplots(1, 2)
    assert run.trajectory.plot(ax=both[0]) is both[0] and line.plot(ax=both[1]) is both[1]
    assert len(plt.get_fignums()) == 1


def test_sweep_of_one_parameter(line):
    ax = line.plot("mean_r")
    assert np.allclose(curve(ax), [[8, 10, 12, 16], 23 * line.mean_r], rtol=1e-12)
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("drive frequency (Hz)", "mean radius ⟨r⟩ (mm)")
    assert set(words(ax)) == set(line.regime)
    gaps = np.flatnonzero(np.isnan(ax.lines[0].get_xdata()))
    assert gaps.tolist() == [1] and line.regime.tolist() == ["librating"] + ["counter-rotating"] * 3, "lines join runs of one regime"
    states, far = np.array(["locked"] * 4 + ["undecided", "undecided", "ejected"]), np.array([1, 1.2, 1.1, 1, 50, 1.3, np.nan])
    assert np.isnan(_plot_sweeps._without_outliers(far, states)).tolist() == [False] * 4 + [True, False, True]
    assert _plot_sweeps._without_outliers(far[2:], states[2:])[2] == 50, "where few are motions all is drawn"
    ax = line.plot("mean_r", units="scaled")
    assert np.allclose(curve(ax), [line.omega, line.mean_r], rtol=1e-12) and "ℓ" in ax.get_ylabel()
    ax = line.plot("regime")
    assert [label.get_text() for label in ax.get_yticklabels()] == ["librating", "counter-rotating"]
    assert curve(ax)[1].tolist() == [0, 1, 1, 1]


def test_sweep_of_two_parameters():
    bead = fs.Bead(run__periods=30)
    s = fs.sweep(bead, frequency=[9.0, 10.0, 14.0, 18.0], kappa=[1.8, 1.2])
    ax = s.plot("std_r")
    assert words(ax) == ["1.8", "1.2", "undecided"] and (s.regime == "undecided").any()
    for i in range(2):
        assert np.allclose(curve(ax, i)[1], 23 * s.std_r[:, i], rtol=1e-12)
    ax = s.plot("std_r", kind="map")
    cells = ax.collections[0].get_array().reshape(2, 4)
    assert np.allclose(cells, 23 * s.std_r.T[::-1], rtol=1e-12), "the values of kappa rise upward"
    assert "deviation" in colour_map(ax).get_ylabel()
    ax = s.plot(kind="map", x="kappa")
    assert set(words(ax)) == set(s.regime.ravel()) and ax.get_xlabel() == "magnetic strength κ"
    # A part of a sweep over two parameters is one over one.
    assert np.allclose(curve(s[:, 1].plot("std_r")), [[9, 10, 14, 18], 23 * s.std_r[:, 1]], rtol=1e-12)
    # Lines go along a random axis, whatever was drawn first.
    s = fs.sweep(bead.replace(run__periods=4, run__discard=2), frequency="9:20:random:4", kappa=[1.8, 1.2], seed=3)
    f = s.axes[0].values
    assert (np.diff(f) < 0).any()
    for ax in (s.plot("mean_r"), s.plot("mean_r", x="frequency")):
        for i in range(2):
            assert np.allclose(curve(ax, i), [np.sort(f), 23 * s.mean_r[np.argsort(f), i]], rtol=1e-12)


def test_failed_runs_are_gaps_and_named():
    s = fs.sweep(fs.Bead(run__periods=20), start__r=[0.5, 0.0], frequency=[10.0, 11.0])
    assert s.failed.any() and not s.failed.all()
    assert "failed" in words(s.plot(kind="map"))
    # Signs at the lower edge of the curves, below every value: one line for each curve that lacks some.
    ax = s.plot("mean_r", x="frequency")
    signs = [line for line in ax.lines if line.get_linestyle() == "None"]
    assert [line.get_marker() for line in signs if line.get_color() != ax.lines[0].get_color()] == ["x"]
    assert "failed: 2 points" in words(ax) and signs[-1].get_xdata().tolist() == [10, 11]
    ax = s[:, 0].plot("mean_r", x="start__r")
    sign = ax.lines[-1]
    assert words(ax)[-1] == "failed: 1 point" and sign.get_xdata().tolist() == [0]
    low = ax.transAxes.inverted().transform(ax.transData.transform((0, np.nanmin(ax.lines[0].get_ydata()))))[1]
    assert 0 < sign.get_ydata()[0] < low - 0.02


def test_choices_have_their_names():
    s = fs.sweep(fs.Bead(run__periods=20), model__dynamics=["rigid", "farago2020"])
    ax = s.plot("mean_r")
    assert [label.get_text() for label in ax.get_xticklabels()] == ["rigid", "farago2020"]


def test_logarithmic_axes():
    s = fs.sweep(fs.Bead(run__periods=20), friction__gamma=np.geomspace(100, 1000, 5))
    assert s.plot("mean_r").get_xscale() == "log"
    assert fs.sweep(fs.Bead(run__periods=20), frequency=np.linspace(8, 20, 5)).plot().get_xscale() == "linear"


def test_branch():
    b = fs.Bead().branch(frequency=(8, 15))
    ax = b.plot()
    styles = {line.get_linestyle() for line in ax.lines}
    assert styles == {"-", "--"} and words(ax)[0] == "stable" and "pitchfork" in words(ax)
    pitchfork = next(s for s in b.specials if s.type == "pitchfork")
    ends = [line.get_xydata()[i] for line in ax.lines for i in (0, -1)]
    near = min(np.abs(end[0] - pitchfork.value) for end in ends)
    assert near < 1e-12, "the stable part ends at the special point"
    with pytest.raises(fs.BadInput, match="mean_nz"):
        b.plot("mean_mz")


def test_orbit_closes():
    ax = fs.Bead().orbit().plot()
    segments = ax.collections[-1].get_segments()
    assert np.allclose(segments[0][0], segments[-1][1], atol=1e-4)
    assert "Stable" in ax.get_title()


def test_field():
    bead = fs.Bead()
    ax = bead.plot_field(units="scaled")
    b, _ = bead.field(0.0, 0.0)
    drawn = ax.collections[0].get_array().reshape(145, 181)
    assert np.isclose(drawn[72, 90], np.linalg.norm(b), rtol=1e-12)
    assert "B₀" in colour_map(ax).get_ylabel()


def test_a_wrong_name_says_which_are_right(run, line):
    for call, name in (
        (lambda: run.trajectory.plot("n_zz"), "n_z"),
        (lambda: run.trajectory.plot(frame="labb"), "lab"),
        (lambda: run.trajectory.plot(over="tt"), "t"),
        (lambda: line.plot("mean_rr"), "mean_r"),
    ):
        with pytest.raises(fs.BadInput, match=f"did you mean {name}"):
            call()
    with pytest.raises(fs.BadInput, match="period 60"):
        run.trajectory.plot(begin=100)


def test_words_and_colours_are_the_programs():
    assert _style.look("regime", 3) == ("counter-rotating", "#009e73")
    assert _style.of_result("mean_r", "l", "lab", _style.scales_of(fs.Bead()._params)).label == "mean radius ⟨r⟩ (mm)"
    assert _style.palette("diverging")(0.0)[:3] == pytest.approx((0x12 / 255, 0x3F / 255, 0x8C / 255))
    assert set(plots.__all__) == {"branch", "field", "fit", "measurement", "orbit", "sweep", "trajectory"}


def test_without_matplotlib_the_package_is_named():
    """matplotlib is imported by plots alone, and its absence is a sentence."""
    program = (
        "import sys, festoon\n"
        "assert 'matplotlib' not in sys.modules\n"
        "sys.modules['matplotlib'] = None\n"
        "try:\n"
        "    festoon.Bead().plot_field()\n"
        "except festoon.Unavailable as error:\n"
        "    print(error)\n"
    )
    path = str(__import__("pathlib").Path(fs.__file__).parents[1])
    told = subprocess.run(
        [sys.executable, "-B", "-c", program], env={"PYTHONPATH": path}, check=True, capture_output=True, text=True
    ).stdout
    assert "sudo apt install python3-matplotlib" in told


def test_axes_come_back(bead):
    matplotlib = pytest.importorskip("matplotlib")
    import matplotlib.pyplot as plt

    tr = bead.run(periods=20, trajectory=True).trajectory
    axes = [tr.plot(colour="n_z"), fs.sweep(bead.replace(run__periods=5), frequency=[9, 10]).plot()]
    axes.append(bead.branch(omega=(0.24, 0.25)).plot())
    assert all(isinstance(ax, matplotlib.axes.Axes) and ax.get_xlabel() for ax in axes)
    plt.close("all")


def test_pictures_have_the_magnet():
    """Fields and paths show the poles of a magnet of parts, at the same places."""
    part = {"kind": "cylinder", "centre": (0.015, 0, 0), "size": (0.02, 0.008), "remanence": (0, 0, 1)}
    magnet = fs.Bead(magnet__shape="parts", magnet__parts=[part], run__discard=0)
    ax = magnet.plot_field(units="lab")
    rim = next(line.get_xydata() for line in ax.lines if "north poles" in str(line.get_label()))
    rim = rim[np.isfinite(rim).all(axis=1)]
    assert np.allclose(np.hypot(rim[:, 0] - 15, rim[:, 1]), 10, rtol=1e-3) and len(rim) > 90
    assert "mT" in colour_map(ax).get_ylabel()


def test_several_sweeps_or_branches_in_one_axes():
    """Each has a colour of the Axes' cycle and a name of its own; the limits hold all, and no sign hides a value."""
    import matplotlib.pyplot as plt

    bead = fs.Bead(run__periods=20)
    s = fs.sweep(bead, frequency=[8, 9, 10], kappa=[1.2, 1.5])
    far = fs.sweep(bead.replace(kappa=2.5), frequency=[20, 25, 30])
    ax = s[:, 0].plot()
    assert len(ax.collections) > 0
    for one, words in ((s[:, 1], {}), (far, {}), (far, {"label": "mine"})):
        one.plot(ax=ax, **words)
    cycle = plt.rcParams["axes.prop_cycle"].by_key()["color"]
    lines = [line for line in ax.lines if np.isfinite(line.get_xdata()).sum() == 3 and line.get_linestyle() == "-"]
    assert [line.get_color() for line in lines] == cycle[:4] and not ax.collections
    assert [line.get_label() for line in lines] == ["kappa 1.2", "kappa 1.5", "kappa 2.5", "mine"]
    assert {text.get_text() for text in ax.get_legend().get_texts()} >= {"kappa 1.2", "mine"}
    for (low, high), values in ((ax.get_xlim(), [8, 30]), (ax.get_ylim(), [*s.lab.mean_r.ravel(), *far.lab.mean_r])):
        assert low < min(values) and max(values) < high
    assert not [text for text in ax.texts if text.get_gid()]
    ax = s.plot("mean_r")
    s.plot("max_r", ax=ax)
    lines = [line for line in ax.lines if line.get_linestyle() == "-"]
    assert len({line.get_color() for line in lines}) == 4
    assert [line.get_label() for line in lines] == ["1.2, mean_r", "1.5, mean_r", "1.2, max_r", "1.5, max_r"]
    with pytest.raises(fs.BadInput, match="give each its own"):
        s[:, 0].plot("regime", ax=ax)
    ax.clear()
    far.plot(ax=ax)
    assert len(ax.collections) > 0 and ax.get_xlim()[0] > 15
    ax = bead.branch(frequency=(10.5, 11)).plot()
    bead.replace(kappa=1.8).branch(frequency=(12, 13)).plot(ax=ax)
    assert [(line.get_label(), line.get_color()) for line in ax.lines] == [("kappa 1.5", cycle[0]), ("kappa 1.8", cycle[1])]
    assert ax.get_xlim()[0] < 10.5 and ax.get_xlim()[1] > 13
    plt.close("all")
