"""What to use for a speed, a wall and a step: the advice of ``thinwall advise``, as data."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from . import _lab, experiments, tables
from .shapes import _as_float

_COLUMNS = [
    tables.Column("method", "string", "", "As the experiment thin_wall calls it."),
    tables.Column("meets", "boolean", "1", "It meets the wish at this step."),
    tables.Column("chance", "number", "1", "That a shot tunnels; missing where there is no formula."),
    tables.Column("chance_formula", "string", "", "In the letters of docs/tunneling_theory.md."),
    tables.Column("latest_m", "number", "m", "How far past first contact a ball is when it is seen, at most."),
    tables.Column("latest_steps", "number", "1", "The same in steps."),
    tables.Column("latest_formula", "string", "", "In the letters of docs/tunneling_theory.md."),
    tables.Column("longest_step_s", "number", "s", "The longest step at which it meets the wish; missing if it does at none."),
    tables.Column("clear_ns", "number", "ns", "Measured here: a step that ends before the wall, the median."),
    tables.Column("clear_ns_lower", "number", "ns", "Lower end of its 95 % interval."),
    tables.Column("clear_ns_upper", "number", "ns", "Upper end."),
    tables.Column("contact_ns", "number", "ns", "Measured here: the next step, in which the ball touches the wall, the median."),
    tables.Column("contact_ns_lower", "number", "ns", "Lower end of its 95 % interval."),
    tables.Column("contact_ns_upper", "number", "ns", "Upper end."),
    tables.Column("false_hits", "boolean", "1", "Of a rod: it also hits where nothing touches by the end of the step."),
    tables.Column("in_experiment", "boolean", "1", "The experiment thin_wall can fire it."),
]


@dataclass(frozen=True, repr=False)
class Advice:
    """What `advise` says.

    Attributes
    ----------
    method : str or None
        The advised one; None if none meets the wish.
    sentence : str
        The advice itself.
    text : str
        All of it, as ``thinwall advise`` prints it.
    table : DataFrame, or structured array without pandas
        A row for each method, those that meet the wish first, the advised one before them, then by cost. ``table.attrs`` has units and
        descriptions of the columns.
    conditions : dict
        What was asked, with the step and the contact in meters: ``speed_m_s``, ``step_m``, ``contact_m``, ...
    """

    method: str | None
    sentence: str
    text: str
    table: Any
    conditions: dict[str, float | None]
    _words: dict[str, str | None] = field(default_factory=dict)

    @property
    def toml(self) -> str:
        """The configuration of ``thin_wall`` that puts the advice to the test: ``thinwall.run(advice.toml)``.

        Raises
        ------
        ValueError
            The experiment cannot fire this.
        """
        try:
            return _lab.advice_toml(self._words)
        except ValueError as error:
            raise ValueError(_said(error)) from None

    def __repr__(self) -> str:
        return self.text


def advise(
    *,
    speed: float,
    radius: float,
    thickness: float,
    step: float | None = None,
    fps: float | None = None,
    angle_deg: float = 0,
    length: float | None = None,
    spin_deg: float | None = None,
    miss: float = 0,
    late: float | None = None,
) -> Advice:
    """Names the cheapest method that is good enough for a speed, a wall and a step.

    Chances and lateness are computed by formula, for one infinite wall and straight flight, of a ball or of a rod that tumbles about its
    middle; costs are measured on this machine, in about a second. The same as ``thinwall advise``; docs/advise.md says how it chooses.

    Parameters
    ----------
    speed : float
        [m/s] How fast the ball flies, seen from the wall; > 0 and <= 1e9.
    radius : float
        [m] Of the ball, 0 to 1000; 0 is a point.
    thickness : float
        [m] Of the wall, 0 to 1000; 0 is a sheet.
    step : float
        [s] How long a step is, > 0 and <= 1000; or
    fps : float
        [1/s] how many there are a second. One of the two.
    angle_deg : float, default 0
        [deg] Between the flight and the wall's normal, 0 to 89.9.
    length : float, optional
        [m] Of a rod in place of the ball, end to end: more than twice the radius, and <= 1000.
    spin_deg : float, optional
        [deg/s] Of the rod, >= 0, at most 100 turns a step; 0 if not given.
    miss : float, default 0
        [1] The largest acceptable chance that a shot tunnels, 0 to 1.
    late : float, optional
        [m] How far past first contact a ball may be when it is seen, >= 0; any distance if not given.

    Returns
    -------
    Advice

    Raises
    ------
    ValueError
        Out of range; both or neither of `step` and `fps`.
    TypeError
        Not a number.

    Examples
    --------
    >>> tw.advise(speed=300, radius=0.004, thickness=0.002, fps=60).method    # doctest: +SKIP
    'closed_form'
    """
    given = {"speed": speed, "radius": radius, "thickness": thickness, "step": step, "fps": fps}
    given |= {"angle": angle_deg, "miss": miss, "late": late, "length": length, "spin": spin_deg}
    words = {name: None if value is None else _word(name, value) for name, value in given.items()}
    try:
        data, text = _lab.advice(words)
    except ValueError as error:
        raise ValueError(_said(error)) from None
    advice = json.loads(data)
    methods = [_flat(row) for row in advice.pop("methods")]
    values = {column.name: [row[column.name] for row in methods] for column in _COLUMNS}
    return Advice(
        method=advice.pop("method"),
        sentence=advice.pop("advice"),
        text=text,
        table=tables.as_frame("methods", "What each method does under these conditions.", _COLUMNS, values),
        conditions=advice,
        _words=words,
    )


_IN_DEGREES = ("angle", "spin")  # named so here


def _said(error: ValueError) -> str:
    text = experiments.said(error, None)
    name = text.split(":")[0].split(" ")[0]
    return name + "_deg" + text[len(name) :] if name in _IN_DEGREES else text


def _word(name: str, value: Any) -> str:
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (int, float, np.integer, np.floating)):
        raise TypeError(f"{name + '_deg' if name in _IN_DEGREES else name}: {value!r} is not allowed; a number")
    return repr(_as_float(value))


def _flat(row: dict[str, Any]) -> dict[str, Any]:
    """A time with its interval as three values."""
    flat: dict[str, Any] = {}
    for name, value in row.items():
        if isinstance(value, dict):
            flat |= {name: value["median"], f"{name}_lower": value["lower"], f"{name}_upper": value["upper"]}
        else:
            flat[name] = value
    return flat
