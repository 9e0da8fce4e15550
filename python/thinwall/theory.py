"""How often a moving ball passes through a wall unseen, and how late it is seen otherwise: the formulas that the experiments are
held against, computed by the same code.

Arguments are numbers or arrays, of integers or floats, and broadcast as NumPy does; answers are float64. Lengths that have no unit
stated are in any one unit. An argument out of its range raises ``ValueError``, one of another type ``TypeError``; both name the argument.

Source: docs/tunneling_theory.md and docs/spinning_rod.md derive each formula and state its conditions.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _lab

Numbers = npt.ArrayLike
Answer = Any  # a float of numbers, a float64 array of arrays


class Lateness(NamedTuple):
    """[length] How far past first contact a ball is when it is seen, of those that are."""

    mean: Answer
    deviation: Answer  #: standard deviation
    largest: Answer


def tunneling_probability(
    *,
    speed: Numbers,
    radius: Numbers,
    thickness: Numbers,
    step: Numbers | None = None,
    fps: Numbers | None = None,
    angle_deg: Numbers = 0,
    poses: Numbers = 1,
) -> Answer:
    """The chance that a ball flies through a wall without end unseen, if only poses are tested: at the end of a step, or more.

    ``max(0, 1 - poses (thickness + 2 radius) / (speed step cos(angle)))``, at a phase that is uniform over a step.

    Parameters
    ----------
    speed : array_like
        [m/s] Relative to the wall; > 0 and <= 1e9.
    radius : array_like
        [m] Of the ball, 0 to 1000.
    thickness : array_like
        [m] Of the wall, 0 to 1000.
    step : array_like
        [s] > 0 and <= 1000; or
    fps : array_like
        [1/s] steps a second. One of the two.
    angle_deg : array_like, default 0
        [deg] Between the motion and the wall's normal, 0 to 89.9.
    poses : array_like, default 1
        Poses tested a step, evenly spaced and one at its end; whole, >= 1.

    Returns
    -------
    float, or float64 array of the broadcast shape
        [1] in [0, 1].

    Examples
    --------
    >>> tw.theory.tunneling_probability(speed=10, radius=0.02, thickness=0.01, fps=60)
    0.7
    >>> tw.theory.tunneling_probability(speed=300, radius=0.004, thickness=[0.002, 0.2, 20], fps=60)
    array([0.998 , 0.9584, 0.    ])
    """
    return _at_wall(_lab.tunneling_probability, step, fps, speed, radius=radius, thickness=thickness, angle_deg=angle_deg, poses=poses)


def through_probability(
    *,
    speed: Numbers,
    radius: Numbers,
    thickness: Numbers,
    step: Numbers | None = None,
    fps: Numbers | None = None,
    angle_deg: Numbers = 0,
    poses: Numbers = 1,
) -> Answer:
    """The chance that a ball gets through a wall without end, unseen or pushed out of it ahead, the shorter way.

    Parameters and answer are those of `tunneling_probability`. Of the path in contact only the first half turns the ball back.
    """
    return _at_wall(_lab.through_probability, step, fps, speed, radius=radius, thickness=thickness, angle_deg=angle_deg, poses=poses)


def miss_probability(chord: Numbers, spacing: Numbers) -> Answer:
    """The chance that poses `spacing` > 0 apart along a line, at a uniform phase, all miss a chord of it of length `chord` >= 0."""
    return _ask(_lab.miss_probability, chord=chord, spacing=spacing)


def slab_chord(thickness: Numbers, radius: Numbers, cosine: Numbers = 1) -> Answer:
    """[length] What a line cuts from a wall without end, thickened by the ball's radius.

    `cosine`: of the angle between the line and the wall's normal, > 0 and <= 1.
    """
    return _ask(_lab.slab_chord, thickness=thickness, radius=radius, cosine=cosine)


def volume(half_extents: Numbers, radius: Numbers) -> Answer:
    """[length^3] Of a box, `half_extents` (..., 3) >= 0, thickened by a ball's `radius` >= 0."""
    return _ask(_lab.volume, half_extents=half_extents, radius=radius)


def shadow(half_extents: Numbers, radius: Numbers, direction: Numbers) -> Answer:
    """[length^2] Of the same along `direction` (..., 3), of any length > 0."""
    return _ask(_lab.shadow, half_extents=half_extents, radius=radius, direction=direction)


def longest_chord(half_extents: Numbers, radius: Numbers, direction: Numbers) -> Answer:
    """[length] The longest that a line along `direction` (..., 3) cuts from the same."""
    return _ask(_lab.longest_chord, half_extents=half_extents, radius=radius, direction=direction)


def wall_miss_probability(half_extents: Numbers, radius: Numbers, direction: Numbers, spacing: Numbers) -> Answer:
    """The chance that poses `spacing` > 0 apart all miss a wall that ends, a box of `half_extents` (..., 3).

    Averaged over lines along `direction` (..., 3) that are uniform over the wall's shadow, rim included.

    Returns
    -------
    float, or float64 array of the broadcast shape
        NaN where ``spacing < longest_chord(...)``: there some lines cannot be missed, and the average is another.
    """
    return _ask(
        _lab.wall_miss_probability, half_extents=half_extents, radius=radius, direction=direction, spacing=spacing
    )


def center_ray_miss_probability(half_extents: Numbers, radius: Numbers, step: Numbers) -> Answer:
    """The chance that a wall that ends is missed by a ray from the ball's center, with an overlap test at the start of each step.

    The ball flies along x, `step` > 0 [length] a step; the box has `half_extents` (..., 3). NaN where a step is shorter than
    ``2 (half_extents[0] + radius)``.
    """
    return _ask(_lab.center_ray_miss_probability, half_extents=half_extents, radius=radius, step=step)


def pose_lateness(chord: Numbers, spacing: Numbers) -> Lateness:
    """How late poses `spacing` > 0 apart see a ball whose path is in contact over `chord` >= 0."""
    parts = _lab.pose_lateness_mean, _lab.pose_lateness_deviation, _lab.pose_lateness_largest
    return Lateness(*(_ask(part, chord=chord, spacing=spacing) for part in parts))


def center_ray_lateness(lead: Numbers, step: Numbers) -> Lateness:
    """How late a ray from the ball's center, cast over a step of length `step` > 0, sees it.

    `lead` >= 0 [length]: how far past first contact the ray meets the wall; ``radius / cosine`` at a wall without end.
    """
    parts = _lab.center_ray_lateness_mean, _lab.center_ray_lateness_deviation, _lab.center_ray_lateness_largest
    return Lateness(*(_ask(part, lead=lead, step=step) for part in parts))


def rod_miss_probability(clearance: Numbers, reach: Numbers, step: Numbers, spin: Numbers) -> Answer:
    """The chance that poses of a spinning rod, a step apart, all miss a wall without end that it flies at head-on.

    Parameters
    ----------
    clearance : array_like
        [length] > 0: the wall's thickness and twice the rod's radius.
    reach : array_like
        [length] >= 0: how far the ends of the rod's core reach towards the wall, half its length times the sine of the tilt.
    step : array_like
        [length] > 0: what its middle flies in a step.
    spin : array_like
        [rad] >= 0: what it turns in a step.

    Returns
    -------
    float, or float64 array of the broadcast shape
        Exactly 0 where ``step <= clearance + reach |sin(spin)|``.
    """
    return _ask(_lab.rod_miss_probability, clearance=clearance, reach=reach, step=step, spin=spin)


def long_step_miss_probability(clearance: Numbers, reach: Numbers, step: Numbers) -> Answer:
    """The same where the step is so long that the spin drops out: ``1 - (clearance + 4 reach / pi) / step``.

    So it is where ``step >= clearance + 2 reach``, whatever the spin; of a shorter step it may be another, and below 0.
    """
    return _ask(_lab.long_step_miss_probability, clearance=clearance, reach=reach, step=step)


def blade_miss_probability(window: Numbers, spin: Numbers) -> Answer:
    """The chance that poses `spin` > 0 [rad] apart all miss a post that a turning blade touches over `window` > 0 [rad]."""
    return _ask(_lab.blade_miss_probability, window=window, spin=spin)


def _at_wall(formula: Any, step: Numbers | None, fps: Numbers | None, speed: Numbers, **others: Numbers) -> Answer:
    if (step is None) == (fps is None):
        raise ValueError("step, fps: give one of them: how long a step is [s], or how many there are a second")
    if step is None:
        rate = _numbers("fps", fps)
        if not np.all((rate >= 1e-3) & (rate <= 1e12)):
            raise ValueError(f"fps: {fps!r} is not allowed; numbers >= 0.001 and <= 1e12 [1/s]")
        step = 1 / rate
    return _ask(formula, speed=speed, step=step, **others)


def _ask(formula: Any, **arguments: Any) -> Answer:
    """The formula of the arguments in their order, of a vector its three axes one after the other."""
    flat: list[npt.NDArray[np.float64]] = []
    shapes: dict[str, tuple[int, ...]] = {}
    for name, value in arguments.items():
        array = _numbers(name, value)
        shapes[name] = array.shape
        if name not in ("half_extents", "direction"):
            flat.append(array)
        elif array.ndim == 0 or array.shape[-1] != 3:
            raise ValueError(f"{name}: an array of shape {array.shape} is not allowed; (..., 3)")
        else:
            flat += [array[..., 0], array[..., 1], array[..., 2]]
    try:
        np.broadcast_shapes(*(array.shape for array in flat))
    except ValueError:
        raise ValueError(", ".join(f"{name} {shape}" for name, shape in shapes.items()) + ": do not broadcast") from None
    return formula(*flat)


def _numbers(argument: str, value: Any) -> npt.NDArray[np.float64]:
    if isinstance(value, np.ma.MaskedArray):
        raise TypeError(f"{argument}: a masked array is not allowed; one without a mask")
    array = np.asarray(value)
    if array.dtype.kind not in "iuf":
        raise TypeError(f"{argument}: {value!r} is not allowed; numbers, whole or floating")
    return array.astype(np.float64, copy=False)
