"""Advice as data: the numbers of the theory, the words of the program."""

from __future__ import annotations

import copy
import math
import pickle
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import thinwall as tw

BULLET: dict[str, Any] = {"speed": 300, "radius": 0.004, "thickness": 0.002, "fps": 60}


def test_says_what_theory_says() -> None:
    advice = tw.advise(**BULLET)
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


def test_none_will_do() -> None:
    hopeless = tw.advise(speed=10, radius=0, thickness=0, step=1)
    assert hopeless.method is None or math.isfinite(hopeless.conditions["step_m"])
    lenient = tw.advise(**BULLET, miss=1)
    assert set(lenient.table["meets"][lenient.table["chance"] <= 1]) == {True}


def test_the_toml_puts_it_to_the_test(tmp_path: Path) -> None:
    advice = tw.advise(**BULLET)
    result = tw.run(advice.toml, out=tmp_path / "check", trials=100)
    assert 300 in set(result["cells"]["speed"])
    with pytest.raises(ValueError, match="the experiment cannot fire this"):
        tw.advise(speed=1, radius=0, thickness=0, step=1).toml


def test_without_pandas_and_copies(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "pandas", None)
    advice = tw.advise(**BULLET)
    assert isinstance(advice.table, np.ndarray) and advice.table.attrs["units"]["clear_ns"] == "ns"
    assert pickle.loads(pickle.dumps(advice)).text == copy.deepcopy(advice).text == advice.text


@pytest.mark.parametrize(
    "change, error, said",
    [
        ({"speed": 0}, ValueError, "^speed: '0.*' is not allowed; a number > 0"),
        ({"speed": math.nan}, ValueError, "^speed: 'nan'"),
        ({"radius": -1}, ValueError, "^radius: "),
        ({"angle_deg": 90}, ValueError, "^angle_deg: "),
        ({"miss": 2}, ValueError, "^miss: "),
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
