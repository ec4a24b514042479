"""What commands find reaches Python whole."""

import copy
import decimal
import pickle

import numpy as np
import pandas as pd
import pytest
import vibro_audit as va

SCENE = {"motion": {"g": 0.122, "d": 0.4, "r_b": 0.5, "r_t": 0.5}}
SHEET = {
    "equation": [
        {"label": "a", "role": "premise", "tex": r"T = T_1 + T_2"},
        {"label": "b", "role": "claim", "tex": r"T^2 - T_1^2 = T_2 (T + T_1)", "follows_from": ["a"]},
        {"label": "c", "role": "claim", "tex": r"\frac{T}{2} = T_1", "follows_from": ["a"]},
    ]
}


def test_orbits_are_those_of_a_dict_its_text_and_its_file(tmp_path):
    text = va.to_toml(SCENE)
    path = tmp_path / "scene.toml"
    path.write_text(text)
    one, *others = (va.orbits(scene) for scene in (SCENE, text, path, str(path)))
    assert one.rows == 2 and all(one["complete"]) and max(one["error_bound"]) < 1e-12
    assert all(other == one for other in others)
    # the paper prints 0.83272 for this motion of Fig. 2
    stable = next(row for row in va.orbits("fig02", set={"motion.d": 0.4}).each() if row["stable"])
    assert stable["velocities"][0] == pytest.approx(0.83272, abs=1e-5)


def test_more_digits_than_f64_has_are_decimals():
    found = va.orbits(SCENE, digits=30)
    velocity = found["velocities"][0][0]
    assert isinstance(velocity, decimal.Decimal) and len(velocity.as_tuple().digits) >= 30
    assert abs(velocity - decimal.Decimal(va.orbits(SCENE)["velocities"][0][0])) < decimal.Decimal("1e-14")


def test_numbers_are_taken_without_copying_and_can_be_written():
    column = va.sweep("fig03", set={"sweep.points": 3})["velocity"]
    one, other = np.asarray(column), np.asarray(column)
    assert np.shares_memory(one, other) and np.shares_memory(one, np.asarray(column.view))
    assert one.dtype == np.float64 and one.flags.c_contiguous and one.flags.writeable
    assert np.shares_memory(pd.Series(column, copy=False).to_numpy(), one)
    assert column.tolist() == one.tolist() == list(column) and column[-1] == one[-1]


def test_the_type_of_a_column_does_not_depend_on_its_rows():
    for points in (2, 6):
        frame = va.sweep("fig03", summary=True, set={"sweep.points": points, "sweep.impacts": 80}).to_pandas()
        assert (frame["periods"].dtype, frame["digits"].dtype) == (np.float64, np.float64)
        assert len(frame) == points
    assert np.asarray(va.simulate("fig03", impacts=3)["event"]).dtype == np.int64


def test_a_table_is_a_frame_is_copied_and_is_pickled():
    table = va.orbits(SCENE)
    assert list(pd.DataFrame(table).columns) == list(table) == list(table.to_pandas().columns)
    for other in (pickle.loads(pickle.dumps(table)), copy.deepcopy(table)):
        assert other == table and (other.rows, other.notes) == (table.rows, table.notes)


def test_an_audit_has_verdicts_counterexamples_and_a_page():
    found = va.audit(SHEET)
    assert found["verdict"] == ["proved", "refuted"] and not found.as_expected
    values = found["counterexample_values"]
    assert values[0] is None and values[1]["left"] != values[1]["right"]
    page = found._repr_html_()
    assert page.startswith("<iframe") and "<script" not in page and "proved" in page
    assert "(c) refuted" in va.explain(SHEET, "c")


def test_a_document_brings_its_numbers(tmp_path):
    (tmp_path / "paper.tex").write_text(
        r"""
        The velocity is 0.83272. % audit: value orbits.velocities[0], scene fig02, motion.d=0.4
        \begin{equation}
        T + T = 2 T \label{a} % audit: claim
        \end{equation}
        """
    )
    found = va.audit(tmp_path / "paper.tex")
    assert found["verdict"] == ["proved"] and found["place"] == ["4:9"]
    assert found.numbers is not None and found.numbers["verdict"] == ["reproduced"]


def test_golden_values_of_a_directory_are_checked(tmp_path):
    header = "id,place,scene,set,quantity,printed,unit,expected,rests_on,note\n"
    rows = ["good,p. 1,fig02,motion.d=0.4;row.stable=true,orbits.velocities[0],0.83272,,reproduced,,"]
    rows += ["bad,p. 1,fig02,motion.d=0.4;row.stable=true,orbits.velocities[0],0.84272,,reproduced,,"]
    (tmp_path / "printed.csv").write_text(header + "\n".join(rows) + "\n")
    found = va.check(tmp_path)
    assert found["verdict"] == ["reproduced", "wrong"] and not found.as_expected and "<html" in found.html


def test_a_branch_has_its_bifurcations():
    found = va.branch("fig02", set={"sweep.points": 5})
    doubling = next(row for row in found.each() if row["kind"] == "period-doubling" and row["admissible"])
    assert doubling["error_bound"] < 1e-12 and len(doubling["phases"]) == 2


def test_a_map_has_the_rows_of_sweeps():
    along = {"over": "d", "from": 0.1, "to": 0.5, "points": 3}
    few = {"map": {"impacts": 80, "x": along, "y": {"over": "r_b", "from": 0.3, "to": 0.9, "points": 2}}}
    found = va.map("fig03", set=few)
    alike = {"motion.r_b": 0.9, "sweep.points": 3, "sweep.impacts": 80, "sweep.keep": 1}
    swept = va.sweep("fig03", summary=True, set=alike)
    assert list(found["y"]) == [0.3] * 3 + [0.9] * 3
    for name in ("word", "voltage_rate", "digits"):
        assert list(found[name])[3:] == list(swept[name])


def test_basins_number_the_attractors_of_a_table():
    grid = {"from": 0, "to": 6, "points": 4}
    few = {"basins": {"impacts": 400, "phase": grid, "velocity": {"from": 0, "to": 1, "points": 3}}, "motion.d": 0.45}
    starts = va.basins("fig03", set=few)
    attractors = va.basins("fig03", set=few, attractors=True)
    assert list(starts["phase"])[:5] == [0, 2, 4, 6, 0]
    assert set(starts["attractor"]) == set(attractors["attractor"])
    assert attractors["word"][0] == "BT" and len(attractors["phases"][0]) == 2
    assert sum(attractors["fraction"]) == 1 and attractors["error_bound"][0] < 1e-12


def test_a_figure_is_an_svg(tmp_path):
    figure = va.plot("fig03", set={"want": ["sweep"], "sweep.points": 5})
    assert figure._repr_svg_().startswith("<svg") or "<svg" in figure.svg[:200]
    figure.save(tmp_path / "figure.svg")
    assert (tmp_path / "figure.svg").stat().st_size == len(figure.svg.encode())


def test_answers_of_a_solver_are_scored():
    asked = va.problems(kind="impact", level="easy", answers=False)
    assert "answer" not in asked and isinstance(asked["d"][0], decimal.Decimal)
    certified = va.problems(kind="impact", level="easy")
    answers = {name: certified[name] for name in ("problem", "quantity", "answer")}
    assert min(va.score(answers, kind="impact", level="easy")["digits"]) >= 29
    rough = pd.DataFrame({**answers, "answer": [float(answer) * (1 + 1e-6) for answer in certified["answer"]]})
    assert 5 < np.median(va.score(rough, kind="impact", level="easy")["digits"]) < 7


def test_notes_are_heard_and_not_printed(capfd):
    assert va.orbits({**SCENE, "words": ["B"]}).notes
    assert capfd.readouterr() == ("", "")


def test_the_best_device_of_a_box_is_a_row_and_its_parameters():
    box = {"d": [0.1, 0.5], "r_b": [0.3, 0.7], "r_t": [0.3, 0.7]}
    found = va.optimise("fig03", set={"box": box}, gap=1e-3)
    assert list(found["quantity"]) == ["voltage_rate", "d", "incline", "r_b", "r_t"]
    assert found["low"][0] <= found["value"][0] <= found["high"][0] <= found["low"][0] * 1.001
    assert found["complete"][0] and found["attained"][0]
    assert len(va.optimise("fig03", set={"box.d": [0.21, 0.23]})["quantity"]) == 0
