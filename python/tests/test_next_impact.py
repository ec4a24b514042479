"""The one-impact map over arrays."""

import array

import numpy as np
import pytest
import vibro_audit as va

PARAMETERS = {"g": 0.12201, "d": 0.26, "r_b": 0.6, "r_t": 0.3}


def test_it_is_the_map_that_simulate_follows():
    events = va.simulate({"motion": PARAMETERS, "start": {"phase": 6.18, "velocity": 0.5293}}, impacts=12)
    assert set(events["kind"]) == {"impact"}
    phases, velocities = np.asarray(events["phase"]), np.asarray(events["velocity"])
    found = va.next_impact(events["side"], phases, velocities, **PARAMETERS)
    assert found.sides[:-1] == events["side"][1:] and not found.faults
    assert np.allclose(np.asarray(found.phases)[:-1], phases[1:], atol=1e-12)
    assert np.allclose(np.asarray(found.velocities)[:-1], velocities[1:], atol=1e-12)
    assert np.allclose(np.asarray(found.times)[:-1], np.diff(events["time"]), atol=1e-12)


def test_the_jacobian_is_that_of_differences():
    step = 1e-6

    def after(phase, velocity):
        found = va.next_impact("bottom", phase, velocity, **PARAMETERS)
        return np.array([phase / np.pi + found.times[0], found.velocities[0]])

    phase, velocity = 6.18, 0.5293
    by_time = (after(phase + np.pi * step, velocity) - after(phase - np.pi * step, velocity)) / (2 * step)
    by_velocity = (after(phase, velocity + step) - after(phase, velocity - step)) / (2 * step)
    exact = np.asarray(va.next_impact("bottom", phase, velocity, jacobian=True, **PARAMETERS).jacobian)
    assert exact.shape == (1, 2, 2)
    assert np.allclose(exact[0], np.column_stack([by_time, by_velocity]), rtol=1e-6)


def test_numbers_and_arrays_of_any_kind_go_together():
    arguments = {**PARAMETERS, "jacobian": True}
    expected = va.next_impact("bottom", [6.18, 6.18], [0.5, 0.6], **arguments)
    for velocities in (np.array([0.5, 0.6]), array.array("d", [0.5, 0.6]), (0.5, 0.6), np.array([9, 0.5, 9, 0.6])[1::2]):
        assert va.next_impact(["bottom"] * 2, 6.18, velocities, **arguments) == expected
    single = np.array([0.5, 0.625], dtype=np.float32)
    assert va.next_impact("bottom", 6, single, **PARAMETERS).velocities[0] == pytest.approx(0.1, abs=1)
    assert np.asarray(va.next_impact("bottom", [], [], **PARAMETERS).jacobian).shape == (0, 2, 2)


def test_a_state_without_a_next_impact_says_why_and_the_others_go_on():
    found = va.next_impact("bottom", [1.0, 6.18], [0.0, 0.5], g=0.5, d=0.3, r_b=0.5, r_t=0.5, jacobian=True)
    assert found.sides[0] is None and np.isnan(found.times[0]) and "rest" in found.faults[0]
    assert found.sides[1] is not None and np.isfinite(np.asarray(found.jacobian)[1]).all()


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("middle", 1, 1), ["side", "'middle'"]),
        ((None, 1, 1), ["side", "None"]),
        ((["bottom", 3], 1, 1), ["side[1]", "3"]),
        (("bottom", None, 1), ["phase", "None"]),
        (("bottom", [1, None], 1), ["phase[1]", "None"]),
        (("bottom", "1", 1), ["phase", "'1'"]),
        (("bottom", ["1"], 1), ["phase[0]", "'1'"]),
        (("bottom", [1, float("nan")], 1), ["phase[1]", "nan"]),
        (("bottom", 1, float("inf")), ["velocity", "inf"]),
        (("bottom", [1, 2], [1, 2, 3]), ["phase has 2", "velocity has 3"]),
        (("bottom", np.ones((2, 2)), 1), ["phase", "(2, 2)"]),
        (("bottom", 1, [10**400]), ["velocity[0]"]),
        (("bottom", 1j, 1), ["phase"]),
    ],
)
def test_a_state_that_is_none_is_named(arguments, words):
    with pytest.raises(va.InputError) as raised:
        va.next_impact(*arguments, **PARAMETERS)
    assert all(word in str(raised.value) for word in words), raised.value


@pytest.mark.parametrize("change", [{"d": 0}, {"r_b": 1.5}, {"g": None}, {"g": float("nan")}, {"d": "0.3"}])
def test_a_parameter_that_is_none_is_named(change):
    with pytest.raises(va.InputError, match=next(iter(change))):
        va.next_impact("bottom", 1, 1, **{**PARAMETERS, **change})


@pytest.mark.parametrize(
    "phase", [np.array([1j]), {1: 2.0}, {1.0, 2.0}, np.ma.masked_array([1.0, 2.0], [0, 1]), np.array(["a"])]
)
def test_what_is_no_array_of_real_numbers_is_refused(phase):
    with pytest.raises(va.InputError, match="phase "):
        va.next_impact("bottom", phase, 0.5, g=0.1, d=0.3, r_b=0.5, r_t=0.5)


def test_many_states_are_computed_in_parts(monkeypatch):
    velocities = np.linspace(-0.1, 0.9, 11)
    arguments = {**PARAMETERS, "jacobian": True}
    whole = va.next_impact("bottom", 6.18, velocities, **arguments)
    monkeypatch.setattr(va, "_STATES_AT_ONCE", 3)
    parts = va.next_impact("bottom", 6.18, velocities, **arguments)
    assert whole.faults and whole.faults == parts.faults and whole.sides == parts.sides
    for one, other in zip(whole[1:5], parts[1:5]):
        assert np.array_equal(np.asarray(one), np.asarray(other), equal_nan=True) and one.shape == other.shape


def test_a_series_of_pandas_is_an_array():
    pd = pytest.importorskip("pandas")
    plain = va.next_impact("bottom", [1.0, 2.0], 0.5, **PARAMETERS)
    series = va.next_impact("bottom", pd.Series([1.0, 2.0]), 0.5, **PARAMETERS)
    assert list(series.times) == list(plain.times)


@pytest.mark.parametrize("velocity", [5e-324, 1e-300, 1e-141])
def test_velocities_too_small_for_f64_are_faults(velocity):
    found = va.next_impact("bottom", [1.0, 0.0, 6.0], velocity, g=0.05, d=0.35, r_b=0.6, r_t=0.45)
    assert found.sides == [None] * 3 and all("too small" in fault for fault in found.faults.values())
    assert not np.isfinite(np.asarray(found.times)).any()
