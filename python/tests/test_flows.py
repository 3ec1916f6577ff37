"""The field and the equations of motion at many points, and trajectories that are advanced step by step."""

import math
import threading

import numpy as np
import pytest

import festoon as fs


def test_field_broadcasts(bead):
    x, y = np.linspace(-1, 1, 5)[:, None], np.linspace(0, 1, 3)
    b, grad = bead.field(x, y)
    assert b.shape == (5, 3, 3) and grad.shape == (5, 3, 3, 3)
    assert np.allclose(grad, np.swapaxes(grad, -1, -2)) and np.allclose(np.trace(grad, axis1=-2, axis2=-1), 0)
    step = 1e-5
    ahead, behind = bead.field(x + step, y)[0], bead.field(x - step, y)[0]
    assert np.allclose((ahead - behind) / (2 * step), grad[..., 0], atol=1e-7)
    assert np.array_equal(bead.field("10 mm", 0.0)[0], bead.field(10e-3 / 0.023, 0.0)[0])
    with pytest.raises(fs.BadInput, match="tesla"):
        bead.field(0, 0, units="si")
    many = np.linspace(-1, 1, 5001)  # more than one call takes
    assert np.array_equal(bead.field(many, 0.3)[1][::100], bead.field(many[::100], 0.3)[1])


def test_a_field_of_many_points_obeys_ctrl_c(bead, monkeypatch):
    """It is computed piece by piece, and the signal is seen between them."""
    from types import SimpleNamespace

    from festoon import fields

    sizes = []

    def piece(model, count, *arrays):
        sizes.append(count)
        if len(sizes) == 3:
            raise KeyboardInterrupt

    groups = fields.lib.fst_model_groups
    monkeypatch.setattr(fields, "lib", SimpleNamespace(pyf_field=piece, fst_model_groups=groups))
    with pytest.raises(fs.Interrupted):
        bead.field(np.zeros(10**5), 0.0)
    assert sizes == [fields.PIECE] * 3


def test_flow(bead):
    flow = bead.flow()
    t, y = flow.advance(until="section")
    assert flow.stop == "section" and t == flow.t > 0 and abs(y[0]) < 1e-14
    t, y = flow.advance(t=20.0)
    assert t == 20.0 and flow.stop == "time" and np.array_equal(y, flow.state)
    with pytest.raises(fs.BadInput, match="unknown event"):
        flow.advance(until="sektion")


def test_flow_of_a_contact():
    flow = fs.Bead(omega=0.215, friction__law="coulomb", mu=0.2).flow()
    for awaited in ("slip", "stick", "slip"):
        before = flow.t
        flow.advance(until=("slip", "stick", "leave", "touch"))
        if before == 0 and flow.stop == "stick":  # it may begin with a slip
            flow.advance(until=("slip", "stick", "leave", "touch"))
        assert flow.stop == awaited and flow.sticks == (awaited == "stick") and flow.t > before
        assert not flow.flies and not flow.rests


def test_a_flow_that_was_stopped_goes_on_with_the_same_bits(bead, monkeypatch):
    stopped, whole = bead.flow(), bead.flow()
    monkeypatch.setattr(stopped._watch, "tell", lambda fraction, what: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        stopped.advance(t=1e9)
    assert 0 < stopped.t < 1e9
    monkeypatch.undo()
    end = math.ceil(stopped.t) + 50.0
    assert np.array_equal(stopped.advance(t=end)[1], whole.advance(t=end)[1]) and stopped.rhs_calls == whole.rhs_calls


# ---------------------------------------------------------------------------------------- one thread to a flow


def test_two_threads_cannot_use_one_flow(bead):
    """While one thread advances it, another one neither advances nor reads it; the first goes on undisturbed."""
    refused, alone = [], bead.flow()

    def tell(fraction, what):
        if refused:
            return

        def intrude():
            for use in (lambda: flow.advance(t=1.0), lambda: flow.t, lambda: flow.state, lambda: flow.sticks):
                with pytest.raises(RuntimeError, match="one thread at a time"):
                    use()
                refused.append(use)
            refused.append(repr(flow))

        thread = threading.Thread(target=intrude)
        thread.start()
        thread.join()
        with pytest.raises(RuntimeError, match="one thread at a time"):
            flow.advance(t=1.0)  # nor does the function that is told of it
        assert flow.t >= 0

    flow = bead.flow(progress=tell)
    assert np.array_equal(flow.advance(t=4000.0)[1], alone.advance(t=4000.0)[1])
    assert len(refused) == 5 and refused[-1] == "Flow, which another thread advances"
    assert flow.rhs_calls == alone.rhs_calls and np.array_equal(flow.advance(t=4100.0)[1], alone.advance(t=4100.0)[1])


def test_eight_threads_advance_a_flow_one_after_the_other_or_are_refused(bead):
    """Whoever comes in between is refused; those who are not make the steps that one thread alone makes."""
    flow, alone, wrong = bead.flow(), bead.flow(), []

    def work():
        for _ in range(40):
            try:
                flow.advance(until="section")
            except RuntimeError:
                continue
            except BaseException as error:
                wrong.append(error)

    threads = [threading.Thread(target=work) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    while alone.t < flow.t:
        alone.advance(until="section")
    assert not wrong and flow.t > 0 and np.array_equal(flow.state, alone.state)


# ---------------------------------------------------------------------------------------- states


@pytest.fixture(scope="module")
def samples():
    return fs.Bead(omega=0.25, kappa=1.3, run__periods=20).run(trajectory=True).trajectory


def states_of(samples):
    return np.stack([samples[name] for name in ("X", "Y", "vX", "vY", "nX", "nY", "nZ", "WX", "WY", "WZ")], axis=-1)


@pytest.mark.parametrize("law", [{}, {"friction__law": "none"}, {"model__dynamics": "farago2020"}])
def test_the_jacobian_is_the_derivative_of_the_equations(samples, law):
    """By central differences, for an array of states at once; one state alone gives the same bits."""
    bead, states = samples.bead.replace(**law), states_of(samples)[::160].reshape(3, 3, 10)
    exact, step = bead.jacobian(states), 1e-6
    assert exact.shape == (3, 3, 10, 10) and bead.rhs(states).shape == states.shape
    for j in range(10):
        aside = step * np.eye(10)[j]
        slope = (bead.rhs(states + aside) - bead.rhs(states - aside)) / (2 * step)
        assert np.allclose(exact[..., j], slope, rtol=1e-7, atol=1e-7), j
    assert np.array_equal(bead.jacobian(states[1, 2]), exact[1, 2])
    assert np.array_equal(bead.rhs(states[1, 2].tolist()), bead.rhs(states)[1, 2])
    assert bead.rhs(np.empty((0, 10))).shape == (0, 10)


def test_the_equations_are_those_of_a_trajectory(samples):
    """Between two samples the state changes by the integral of its derivative, by Simpson's rule over three."""
    states, t = states_of(samples), samples.t
    slopes = samples.bead.rhs(states)
    rule = (t[2::2] - t[:-2:2])[:, None] / 6 * (slopes[:-2:2] + 4 * slopes[1::2] + slopes[2::2])
    gap = np.abs(states[2::2] - states[:-2:2] - rule).max()
    coarse = (t[4::4] - t[:-4:4])[:, None] / 6 * (slopes[:-4:4] + 4 * slopes[2:-2:4] + slopes[4::4])
    wide = np.abs(states[4::4] - states[:-4:4] - coarse).max()
    assert 0 < gap < 3e-3 and wide / gap > 8


def test_what_is_observed_of_states_is_what_a_trajectory_says(samples):
    seen = samples.bead.observe(states_of(samples))
    assert seen.shape == samples.shape
    pairs = {"r": "r", "b_norm": "B", "slip_norm": "slip", "spin": "spin", "load": "load",
             "energy": "energy", "friction_power": "friction_power", "friction": "friction"}
    for ours, theirs in pairs.items():
        assert np.allclose(seen[ours], samples[theirs], rtol=1e-12, atol=1e-12), ours
    assert np.allclose(np.degrees(seen.angle), samples.angle, rtol=1e-9, atol=1e-9)
    assert np.allclose(seen.n[:, 2], samples.n_z) and np.allclose(seen.b[:, 0], samples.B_r)
    assert np.array_equal(seen.r[7], samples.bead.observe(states_of(samples)[7]).r)


def test_what_is_no_state_is_refused(bead):
    for call in (bead.rhs, bead.jacobian, bead.observe):
        for wrong, words in ((np.zeros(9), "10 numbers"), (1.0, "10 numbers"), ([np.nan] * 10, "not finite")):
            with pytest.raises(fs.BadInput, match=words):
                call(wrong)
