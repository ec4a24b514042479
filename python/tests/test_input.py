"""Input that cannot be used is an InputError that says what and where; nothing aborts."""

import os

import numpy as np
import pytest
import vibro_audit as va

SCENE = {"motion": {"g": 0.122, "d": 0.4, "r_b": 0.5, "r_t": 0.5}}


def refused(call, *arguments, **named):
    with pytest.raises(va.InputError) as raised:
        call(*arguments, **named)
    return raised.value


@pytest.mark.parametrize(
    ("value", "words"),
    [
        (None, "None"),
        (float("nan"), "nan"),
        (float("inf"), "inf"),
        ("wide", '"wide"'),
        (-1, "-1"),
        (10**400, "motion.d"),
        ([0.4], "[0.4]"),
        ({}, "motion.d"),
        (1j, "1j"),
        (np.zeros((2, 2)), "motion.d"),
        ("\x00\x7f\u202e", "motion.d"),
    ],
)
def test_a_value_of_a_scene_is_named(value, words):
    error = refused(va.orbits, {"motion": {**SCENE["motion"], "d": value}})
    assert words in str(error).replace("['motion']['d']", " motion.d "), error


def test_the_place_is_there_for_programs():
    error = refused(va.orbits, "[motion]\nd = 0.4\nzeta = 1\n")
    assert (error.path, error.line, error.column) == ("scene", 3, 1)
    error = refused(va.audit, {"equation": [{"label": "a", "tex": "x", "role": "claims"}]})
    assert error.path == "sheet" and error.line is not None


def test_a_path_that_is_none_is_named(tmp_path):
    missing = tmp_path / "missing.toml"
    for call in (va.orbits, va.audit, va.score):
        assert refused(call, missing).path == str(missing)
        error = refused(call, tmp_path)
        assert error.path == str(tmp_path) and "directory" in str(error)
    assert refused(va.check, missing).path is not None
    (tmp_path / "binary.toml").write_bytes(b"\xff\xfe\x00")
    assert "UTF-8" in str(refused(va.audit, tmp_path / "binary.toml"))
    refused(va.orbits, "\x00")
    assert "did you mean fig02" in str(refused(va.orbits, "fig022"))
    assert "no such file" in str(refused(va.orbits, "-"))


@pytest.mark.parametrize("given", [None, 3, b"fig022", [SCENE], object(), SCENE.keys()])
def test_what_is_no_scene_is_refused(given):
    refused(va.orbits, given)


@pytest.mark.parametrize(
    "named",
    [
        {"digits": 0},
        {"digits": "many"},
        {"digits": 10**30},
        {"digits": float("nan")},
        {"digits": 5000},
        {"set": {"motion.d": None}},
        {"set": {"motion.d": float("nan")}},
        {"set": {"motion": 1}},
        {"set": {None: 1}},
        {"set": "motion.d=1"},
    ],
)
def test_an_option_that_is_none_is_refused(named):
    refused(va.orbits, SCENE, **named)


def test_a_huge_size_is_refused():
    refused(va.sweep, "fig03", set={"sweep.points": 10**12})
    refused(va.plot, "fig03", set={"sweep.points": 10**8})
    refused(va.orbits, "#" * (3 << 20) + "\n")


def test_answers_that_are_none_are_named():
    assert "None" in str(refused(va.score, None))
    assert "lengths" in str(refused(va.score, {"problem": ["a"], "quantity": []}))
    assert "quantity" in str(refused(va.score, {"problem": ["impact-fast"]}, kind="impact", level="easy"))
    refused(va.score, 3)
    refused(va.problems, kind="impacts")
    refused(va.problems, kind=3)


def test_a_formula_that_cannot_be_read_is_a_row():
    found = va.audit({"equation": [{"label": "a", "role": "claim", "tex": r"\frac{1"}]})
    assert found["verdict"] == ["unread"] and not found.as_expected and found.notes


def test_a_dict_that_contains_itself_is_refused():
    scene = dict(SCENE)
    scene["motion"] = {"d": scene}
    scene["motion"]["d"] = scene["motion"]
    deep = []
    for _ in range(10_000):
        deep = [deep]
    for given in (scene, {"a": deep}):
        for call in (va.orbits, va.audit, va.plan, va.to_toml):
            assert "contains itself" in str(refused(call, given))
    assert "contains itself" in str(refused(va.orbits, SCENE, set={"motion": scene["motion"]}))


def test_text_of_any_kind_comes_through_toml():
    for text in ["a\\b'c\"d", "new\nline", "tab\t", "\x7f", "\u202e", "ж", r"\dot{Z}_{k+1}"]:
        found = va.audit({"title": text, "equation": [{"label": "a", "role": "claim", "tex": "1 = 1"}]})
        assert found["verdict"] == ["proved"]


def test_sources_are_left_as_they_are(tmp_path):
    path = tmp_path / "scene.toml"
    path.write_text(va.to_toml(SCENE))
    before = os.stat(path).st_mtime_ns
    va.orbits(path)
    assert os.listdir(tmp_path) == ["scene.toml"] and os.stat(path).st_mtime_ns == before


@pytest.mark.parametrize("option", ["digits", "impacts", "last"])
@pytest.mark.parametrize("value", [5.0, True, "5", [5]])
def test_counts_that_are_none_are_named(option, value):
    with pytest.raises(va.InputError, match=f"{option} is .*; a whole number is needed"):
        va.simulate("fig03", **{option: value})


def test_a_label_that_is_no_text_is_named():
    with pytest.raises(va.InputError, match="label is None"):
        va.explain(None, None)
