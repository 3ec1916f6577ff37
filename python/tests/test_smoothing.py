"""Noisy maps, smoothed: the program's numbers, and maps that beads can run over."""

import pickle
import subprocess

import numpy as np
import pytest

import festoon as fs
from conftest import ask


def test_smooth(program, noisy, tmp_path):
    """The program's numbers, to the last digit; and a map that a bead can run over."""
    noisy.save(tmp_path / "scene.yaml")
    words = ["field", str(tmp_path / "scene.yaml"), "--at", "0.3,-0.2", "--smooth", "--json", "--units", "si"]
    theirs, made = ask(program, *words), noisy.smooth()
    (B, G), (eB, eG, eF) = made.field(0.3, -0.2), made.errors(0.3, -0.2)
    assert B.tolist() == theirs["b"] and G.tolist() == theirs["grad"] and eB.tolist() == theirs["b_error"]
    assert eG.tolist() == theirs["grad_error"] and eF.tolist() == theirs["force_error"]
    assert np.allclose(made.errors("6.9 mm", "-4.6 mm", "si")[2], theirs["force_error_newtons"], rtol=1e-9)
    fit = theirs["fit"]
    assert [made.charges, made.depth, made.rms, made.noise] == [fit[k] for k in ("charges", "depth_m", "rms_tesla", "noise_tesla")]
    assert [made.rough_noise, made.degrees_of_freedom, made.chi2] == [fit[k] for k in ("rough_noise_tesla", "degrees_of_freedom", "chi2_per_degree")]
    assert abs(made.noise - 2e-5) < 3e-6 and not made.turned.any() and f"{made.charges} charges" in repr(made)
    exact, _ = fs.Bead(magnet__b0="10 mT").field([0.3, 0.1], [-0.2, 0.5])
    found, errors = made.field([0.3, 0.1], [-0.2, 0.5])[0], made.errors([0.3, 0.1], [-0.2, 0.5])[0]
    assert (np.abs(found - exact) < 4 * errors).all() and np.isnan(made.errors(9, 0)[0]).all()
    made.save(tmp_path / "smooth.csv", spacing="3 mm")
    smooth = noisy.replace(magnet__file=str(tmp_path / "smooth.csv"), run__periods=4)
    there = "6 mm", "-3 mm"
    assert np.allclose(smooth.field(*there)[0], made.field(*there)[0], rtol=1e-9) and smooth.run().mean_r > 0
    frame, grid = made.to_pandas(), made.to_xarray("lab")
    B, eG = made.field([frame.x[3] / 0.023], [frame.y[3] / 0.023])[0], made.errors([frame.x[3]], [frame.y[3]], "si")[1]
    assert np.allclose(0.01 * B[0], frame.loc[3, ["Bx", "By", "Bz"]].tolist(), rtol=1e-12) and len(frame) == 14 * 12
    names = [[f"edB{i}_d{k}" for k in "xyz"] for i in "xyz"]
    assert np.allclose(eG[0], [frame.loc[3, row].tolist() for row in names], rtol=1e-12)
    assert grid.sizes == {"y": 12, "x": 14} and grid.Bz.attrs["units"] == "mT" and grid.x.values[0] == -39
    assert pickle.loads(pickle.dumps(made)) == made != noisy.smooth(height="20 mm")


def test_a_noise_told_wrong(noisy):
    for told, verdict in (("0.01 mT", "too small"), ("0.04 mT", "too large")):
        made = noisy.smooth(noise=told)
        assert made.verdict == verdict and "it is probably" in made.sentence and made.noise_seen[1] < 2e-5 < made.noise_seen[2]
    assert noisy.smooth().verdict == "not told" and noisy.smooth().sentence == "" and np.isnan(noisy.smooth().chi2_bound).all()


def test_drawn_fields(program, noisy, tmp_path):
    """Many spread as the errors say; the program writes the same; a drawn field has no errors and is drawn no further."""
    made = noisy.smooth()
    x, y = [0.3, -0.7], [-0.2, 0.4]
    B, G = (np.array(parts) for parts in zip(*[made.draw(seed).field(x, y) for seed in range(1, 61)]))
    for drawn, middle, error in ((B, made.field(x, y)[0], made.errors(x, y)[0]), (G, made.field(x, y)[1], made.errors(x, y)[1])):
        z = (drawn - middle) / error  # its numbers are neighbours, and alike
        assert 0.85 < np.sqrt((z**2).mean()) < 1.15 and np.abs(z.mean(axis=0)).max() < 0.6
    noisy.save(tmp_path / "scene.yaml")
    words = [program, "field", str(tmp_path / "scene.yaml"), "--smooth", "--spacing", "6mm", "--csv", str(tmp_path / "s.csv"), "--draws", "2"]
    subprocess.run(words, check=True, capture_output=True)
    one = made.draw(2)
    one.save(tmp_path / "2.csv", spacing="6 mm")
    assert (tmp_path / "2.csv").read_bytes() == (tmp_path / "s-2.csv").read_bytes() != (tmp_path / "s-1.csv").read_bytes()
    assert np.isnan(one.errors(0, 0)[0]).all() and one.seed == 2 and one != made and "drawn" in repr(one)
    assert pickle.loads(pickle.dumps(one)) == one and noisy.replace(magnet__file=str(tmp_path / "2.csv"), run__periods=2).run().mean_r > 0
    with pytest.raises(fs.BadInput, match="smoothed map"):
        one.draw(1)


def test_smooth_with_a_probe(noisy):
    made = noisy.smooth(probe=True, noise="0.02 mT", height="20 mm")
    assert (np.abs(made.turned) < 4 * made.turned_error).all() and (made.offset_error > 0).all() and made.noise >= 2e-5
    assert made.height == 0.02 and made.to_xarray().attrs["height"] == 0.02
    assert made.verdict == "agrees" and "noise told" in made.sentence and made.sentence in repr(made)
    assert made.chi2_bound[0] < 1 < made.chi2_bound[1] and made.noise_seen[1] < 2e-5 < made.noise_seen[2]
    told = []
    noisy.smooth(progress=lambda fraction, what: told.append(fraction))
    assert told == sorted(told) and told[-1] > 0.9
    for call, words in ((lambda: fs.Bead().smooth(), "no map"), (lambda: noisy.smooth(noise="9 T"), "a positive field"),
                        (lambda: noisy.smooth(height="1 mm"), "too near"), (lambda: made.field(0, 0, "lab"), "unknown units"),
                        (lambda: made.to_pandas("scaled"), "unknown units")):
        with pytest.raises(fs.BadInput, match=words):
            call()
