"""The program and the module, asked the same from outside, answer the same: tables, branches, exponents, sentences."""

import csv
import json
import math
import subprocess

import numpy as np
import pytest

import festoon as fs


def ask(program, *words, cwd=None):
    done = subprocess.run([program, *words], capture_output=True, text=True, check=False, cwd=cwd)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_rows_of_the_exported_table(program, tmp_path):
    """The CSV that other programs read has every number of the arrays, to its last digit."""
    ask(program, "sweep", "--set", "run.periods=40", "--over", "drive.frequency=9Hz:18Hz:4", "--over",
        "friction.gamma=250,312.5", "-o", tmp_path / "s.db")
    ask(program, "export", tmp_path / "s.db", "--csv", "-o", tmp_path / "s.csv")
    lines = [line for line in (tmp_path / "s.csv").read_text().splitlines() if not line.startswith("#")]
    rows = list(csv.DictReader(lines))
    s = fs.sweep(fs.Bead(run__periods=40), frequency=np.linspace(9, 18, 4), gamma=[250, 312.5])
    assert s.shape == (4, 2) and len(rows) == s.size
    names = {name.split(" ")[0]: name for name in rows[0]}
    compared = 0
    for row in rows:
        at = (s.parameter("frequency") == float(row[names["drive.frequency"]]))
        at &= s.parameter("gamma") == float(row[names["friction.gamma"]])
        assert at.sum() == 1
        for name in fs._tables.RESULTS:
            if name in names and row[names[name]] not in ("", "nan"):
                assert getattr(s, name)[at][0] == float(row[names[name]]), name
                compared += 1
        assert s.regime[at][0] == row[names["regime"]]
    assert compared > 20 * s.size


def test_branch(program):
    theirs = json.loads(ask(program, "branch", "--json", "--kind", "counter", "--over", "drive.frequency=9Hz:15Hz"))
    ours = fs.Bead().branch(frequency=("9 Hz", "15 Hz"))
    assert ours.to_dict() == theirs
    assert [point["mean_r"] for point in theirs["points"]] == ours.mean_r.tolist()


def test_locked_branch_and_exponents(program):
    words = ["--set", "model.dynamics=farago2020"]
    bead = fs.Bead(model__dynamics="farago2020")
    theirs = json.loads(ask(program, "branch", "--json", "--kind", "locked", "--over", "drive.omega=0.02:0.08", *words))
    assert bead.branch(kind="locked", omega=(0.02, 0.08)).to_dict() == theirs
    assert bead.lyapunov().to_dict() == json.loads(ask(program, "lyapunov", "--json", *words))


def test_ramp(program):
    theirs = json.loads(ask(program, "run", "--json", "--set", "run.periods=120", "--ramp", "10:12"))
    ours = fs.Bead(run__periods=120).run(ramp=(10, 12))
    assert ours.to_dict() == theirs
    assert [point["mean_r"] for point in theirs["ramp"]] == ours.ramp["mean_r"].tolist()


@pytest.mark.parametrize(
    "key, value",
    [
        ("friction.gama", "3"),
        ("drive.frequency", "3 kg"),
        ("model.kappa", "-1"),
        ("friction.law", "viscos"),
        ("magnet.depth", "deep"),
        ("run.periods", "nan"),
    ],
)
def test_sentences_are_the_programs(program, key, value):
    """What is wrong is said in the same words, and with status 2 by the program."""
    with pytest.raises(fs.BadInput) as caught:
        fs.Bead(**{key.replace(".", "__"): value})
    done = subprocess.run([program, "check", "--set", f"{key}={value}"], capture_output=True, text=True, check=False)
    assert done.returncode == 2
    told = " ".join(done.stderr.split())
    # Before its brackets a sentence is the same for callers in C and for people at a terminal.
    assert caught.value.sentence.split(" (")[0] in told, told


def test_scenes_cross_over(program, tmp_path):
    """A scene of Python runs in the program, and the other way round, with the same bits."""
    bead = fs.Bead(frequency="12.3 Hz", kappa=1.37, friction__law="coulomb", mu=0.15, run__periods=20)
    bead.save(tmp_path / "ours.yaml")
    theirs = json.loads(ask(program, "run", tmp_path / "ours.yaml", "--json"))
    assert bead.run().to_dict() == theirs
    ask(program, "init", tmp_path / "theirs.yaml", "--set", "bead.radius=2 mm", "--set", "run.periods=20")
    read = fs.Bead.load(tmp_path / "theirs.yaml")
    assert read == fs.Bead(bead__radius="2 mm", run__periods=20, run__discard=10)
    with pytest.warns(fs.MaterialWarning):
        ours = read.run().to_dict()
    assert ours == json.loads(ask(program, "run", tmp_path / "theirs.yaml", "--json"))


def test_threads_share_a_bead():
    """Runs in threads of Python give the bits of runs one after the other; the GIL is free meanwhile."""
    import threading

    bead = fs.Bead(run__periods=60)
    beads = [bead.replace(kappa=kappa) for kappa in (1.2, 1.4, 1.6, 1.8)] + [bead] * 4
    one_by_one = [each.run().mean_r for each in beads]
    together = [math.nan] * len(beads)

    def work(i):
        together[i] = beads[i].run().mean_r

    threads = [threading.Thread(target=work, args=(i,)) for i in range(len(beads))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert together == one_by_one
