"""What the tests of experiments and results share: one small run, and the program that is the same in C++."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import thinwall as tw

SOURCE = Path(os.environ["THINWALL_SOURCE"])
PROGRAM = Path(tw.__file__).parents[2] / "thinwall"

SMALL: dict[str, Any] = {
    "speed": [10, 40],
    "step": [1 / 60],
    "angle_deg": [0],
    "radius": [0.02],
    "thickness": [0.01],
    "method": ["end_of_step", "closed_form"],
    "scalar": ["double"],
    "shots": 200,
}


def small(out: Path, **more: Any) -> tw.Result:
    return tw.run("thin_wall", out=out, seed=1, **{**SMALL, **more})
