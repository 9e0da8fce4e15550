"""Advice as data: the numbers of the theory, the words of the program."""

from __future__ import annotations

import copy
import math
import pickle
import re
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import thinwall as tw

BULLET: dict[str, Any] = {"speed": 300, "radius": 0.004, "thickness": 0.002, "fps": 60}


@pytest.fixture(scope="module")
def advice() -> Any:
    return tw.advise(**BULLET)  # measures for a second


def test_says_what_theory_says(advice: Any) -> None:
    table = advice.table
    names = list(table["method"])
    end = names.index("end_of_step")
    assert table["chance"][end] == tw.theory.tunneling_probability(**BULLET) == pytest.approx(0.998)
    assert not table["meets"][end] and table["latest_m"][end] == pytest.approx(0.01)
    assert advice.method == names[0] and table["meets"][0] and table["chance"][0] == 0
    assert sorted(table["meets"], reverse=True) == list(table["meets"])
    for kind in ("clear_ns", "contact_ns"):
        assert (0 < table[kind + "_lower"]).all() and (table[kind + "_lower"] <= table[kind + "_upper"]).all()
    assert table.attrs["units"]["latest_m"] == "m" and set(table.attrs["descriptions"]) == set(table.columns)
    assert advice.conditions["step_m"] == 5 and advice.conditions["contact_m"] == pytest.approx(0.01)
    assert advice.sentence.startswith(f"Use {advice.method}:")
    assert repr(advice) == advice.text and re.sub(r"\s+", " ", advice.sentence) in re.sub(r"\s+", " ", advice.text)


def test_a_rod() -> None:
    """A spin shields on short steps: a quarter of a turn in 1/60 s."""
    rod = tw.advise(speed=20, radius=0.02, length=0.6, spin_deg=5400, thickness=0.01, fps=60)
    assert rod.conditions["length_m"] == 0.6 and rod.conditions["spin_deg_s"] == 5400
    table = rod.table
    assert rod.method == table["method"][0] and "linear_sweep" in list(table["method"])
    assert not table["in_experiment"].any()
    still = tw.advise(speed=20, radius=0.02, length=0.6, thickness=0.01, fps=60).table
    chance = [t["chance"][list(t["method"]).index("end_of_step")] for t in (table, still)]
    assert 0 <= chance[0] < chance[1] < 1
    with pytest.raises(ValueError, match="rods are fired by"):
        rod.toml


def test_none_will_do(monkeypatch: pytest.MonkeyPatch) -> None:
    """A point at a sheet: without a chord to be in, and without pandas to say it."""
    monkeypatch.setitem(sys.modules, "pandas", None)
    point = tw.advise(speed=1, radius=0, thickness=0, step=1, miss=0.5)
    rows = point.table
    assert isinstance(rows, np.ndarray) and rows.attrs["units"]["clear_ns"] == "ns"
    assert not rows["meets"][rows["method"] == "end_of_step"].any() and (rows["chance"][rows["method"] == "end_of_step"] == 1).all()
    with pytest.raises(ValueError, match="the experiment cannot fire this"):
        point.toml


def test_the_toml_puts_it_to_the_test(advice: Any, tmp_path: Path) -> None:
    result = tw.run(advice.toml, out=tmp_path / "check", trials=100)
    assert 300 in set(result["cells"]["speed"])


def test_copies(advice: Any) -> None:
    assert pickle.loads(pickle.dumps(advice)).text == copy.deepcopy(advice).text == advice.text


@pytest.mark.parametrize(
    "change, error, said",
    [
        ({"speed": 0}, ValueError, "^speed: '0.*' is not allowed; a number > 0"),
        ({"speed": 10**400}, ValueError, "^speed: 'inf' is not allowed"),
        ({"speed": math.nan}, ValueError, "^speed: 'nan'"),
        ({"radius": -1}, ValueError, "^radius: "),
        ({"angle_deg": 90}, ValueError, "^angle_deg: "),
        ({"miss": 2}, ValueError, "^miss: "),
        ({"spin_deg": 10}, ValueError, "^spin_deg: a ball"),
        ({"length": 0.001}, ValueError, "^length: a rod"),
        ({"length": 1, "spin_deg": 1e9}, ValueError, "^spin_deg 1e9|^spin_deg 1000000000"),
        ({"late": -1}, ValueError, "^late: "),
        ({"step": 1}, ValueError, "^step and fps say the same thing twice"),
        ({"fps": None}, ValueError, r"^step \[s\] or fps"),
        ({"speed": "fast"}, TypeError, "^speed: 'fast' is not allowed; a number"),
        ({"angle_deg": [1]}, TypeError, "^angle_deg: "),
        ({"speed": np.array([1.0])}, TypeError, "^speed: "),
        ({"speed": True}, TypeError, "^speed: "),
        ({"sped": 1}, TypeError, "sped"),
    ],
)
def test_bad_input_is_named(change: dict[str, Any], error: type[Exception], said: str) -> None:
    with pytest.raises(error, match=said):
        tw.advise(**{**BULLET, **change})
