"""Real magnets: parts, and maps of a measured field."""

import gc
import pathlib
import pickle

import numpy as np
import pytest

import festoon as fs

SOURCE = pathlib.Path(__file__).resolve().parents[2]
BALL = {"kind": "sphere", "centre": [0, 0, "-5 mm"], "size": "20 mm", "remanence": [1.2, 0, 0]}


def test_parts_of_a_magnet(tmp_path):
    bead = fs.Bead(magnet__parts=[BALL, {**BALL, "kind": "sphere", "rotation": [30, 0, 0, 1]}], magnet__depth="40 mm")
    assert bead.magnet__shape == "parts" and len(bead.magnet__parts) == 2
    assert bead.magnet__parts[0] == {
        "kind": "sphere", "centre": [0, 0, -0.005], "size": [0.02], "remanence": [1.2, 0, 0]
    }
    assert bead.magnet__parts[1]["rotation"] == [30, 0, 0, 1]
    bead.save(tmp_path / "magnet.yaml")
    assert fs.Bead.load(tmp_path / "magnet.yaml") == bead == eval(repr(bead), {"Bead": fs.Bead})
    assert bead.replace(kappa=1.2).magnet__parts == bead.magnet__parts
    assert "magnet.parts[1]" in bead._repr_html_()
    one = bead.replace(magnet__parts=[BALL])
    assert len(one.magnet__parts) == 1 and one != bead
    with pytest.raises(fs.BadInput, match="kind"):
        fs.Bead(magnet__parts=[{"size": 1}])
    with pytest.raises(fs.BadInput, match="remanence"):
        fs.Bead(magnet__parts=[{**BALL, "remanenz": [1, 0, 0]}])


def test_a_sphere_s_field_is_a_dipole_s():
    """Outside, a magnetised ball is a dipole of moment V J/mu_0 at its centre: B on its axis is 2 J R^3/(3 d^3)."""
    bead = fs.Bead(magnet__parts=[{**BALL, "centre": [0, 0, 0], "remanence": [0, 0, 1.2]}], magnet__depth="40 mm")
    b, _ = bead.field(0, 0, height="45 mm", units="si")
    assert b == pytest.approx([0, 0, 2 * 1.2 * 0.01**3 / (3 * 0.045**3)], rel=1e-12)


def test_field_of_a_world():
    """Of all that makes one: in the middle of a coil mu_0 N I/(2 R), less on its axis."""
    scenes = pathlib.Path(__file__).resolve().parents[2] / "examples/worlds"
    world = fs.World(str(scenes / "coils.yaml"))
    middle = 4e-7 * np.pi * 200 * 2 / (2 * 0.1)
    b, grad = world.field(np.array([0, 0.05]), 0, units="si")
    assert b[0] == pytest.approx([middle, 0, 0], abs=1e-12)
    assert b[1, 0] == pytest.approx(middle * (1 + 0.25) ** -1.5, rel=1e-9) and grad[1, 0, 0] < 0
    for height in (0, -1):
        with pytest.raises(fs.BadInput, match="height"):
            fs.World(str(scenes / "compass.yaml")).field(0, 0, height=height)


def test_sweep_over_a_part():
    bead = fs.Bead(magnet__parts=[BALL], magnet__depth="40 mm", run__periods=2)
    s = fs.sweep(bead, **{"magnet.parts[0].centre[2]": ["-6 mm", -0.005]})
    assert s.shape == (2,) and s.bead(0).magnet__parts[0]["centre"][2] == -0.006
    assert s.parameter("magnet.parts[0].centre[2]").tolist() == [-0.006, -0.005]


@pytest.fixture
def mapped(tmp_path, monkeypatch):
    """A bead over a measured map, whose path begins at the folder of the work."""
    monkeypatch.chdir(tmp_path)
    for name in ("measured-map.csv", "measured-map.yaml"):
        (tmp_path / name).write_bytes((SOURCE / "examples/magnets" / name).read_bytes())
    return fs.Bead("measured-map.yaml", run__periods=3, run__discard=1)


def test_a_scene_in_another_folder_finds_its_map(mapped, tmp_path):
    (tmp_path / "deeper").mkdir()
    mapped.save("deeper/bead.yaml")
    mapped.save("beside.yaml")
    for path in ("deeper/bead.yaml", "beside.yaml", tmp_path / "measured-map.yaml"):
        again = fs.Bead(path, run__periods=3, run__discard=1)
        assert again == mapped and hash(again) == hash(mapped)
        assert np.array_equal(again.field(0.3, 0.1)[1], mapped.field(0.3, 0.1)[1])
    assert mapped.replace(kappa=1.2) != mapped


def test_a_bead_keeps_its_map(mapped, tmp_path, monkeypatch):
    """What follows from a bead uses the map that was read, wherever one works and whatever became of the file."""
    run, rows = mapped.run(trajectory="run.h5"), fs.sweep(mapped, frequency=[14, 15])
    data = pickle.dumps(mapped)
    (tmp_path / "deeper").mkdir()
    monkeypatch.chdir(tmp_path / "deeper")
    assert pickle.loads(data) == mapped
    (tmp_path / "measured-map.csv").unlink()
    b = mapped.field(0.3, 0.1)[0]
    assert mapped.run().mean_r == run.mean_r and np.array_equal(fs.Bead(mapped).field(0.3, 0.1)[0], b)
    del mapped
    gc.collect()
    assert rows[0].mean_r == rows.mean_r[0] and np.array_equal(rows.bead(0).field(0.3, 0.1)[0], b)
    with pytest.raises(fs.BadInput, match="measured-map"):
        rows.bead(0).replace(magnet__checksum="0123456789abcdef")
    read = fs.read(tmp_path / "run.h5")
    assert len(read) > 100 and read.lab.unit("x") == "mm" and read.bead.magnet__shape == "grid"
    with pytest.raises(fs.BadInput, match="measured-map"):
        read.bead.field(0, 0)
