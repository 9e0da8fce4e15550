"""The formulas against the words of docs/tunneling_theory.md, written here a second time, and against trials drawn here."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given, strategies as st

import thinwall as tw

theory = tw.theory
lengths = st.floats(1e-3, 1e3)


def test_the_bullet_of_the_textbook() -> None:
    answer = theory.tunneling_probability(speed=10, radius=0.02, thickness=0.01, fps=60)
    assert isinstance(answer, float) and answer == pytest.approx(0.7, abs=1e-15)


@given(lengths, st.floats(1e-4, 1), lengths, lengths, st.floats(0, 89), st.integers(1, 100))
def test_an_infinite_wall(speed: float, step: float, radius: float, thickness: float, angle: float, poses: int) -> None:
    spacing = speed * step / poses
    chord = (thickness + 2 * radius) / math.cos(math.radians(angle))
    given = {"speed": speed, "step": step, "radius": radius, "thickness": thickness, "angle_deg": angle, "poses": poses}
    assert theory.tunneling_probability(**given) == pytest.approx(max(0, 1 - chord / spacing), rel=1e-12, abs=1e-12)
    assert theory.through_probability(**given) == pytest.approx(max(0, 1 - chord / 2 / spacing), rel=1e-12, abs=1e-12)
    assert theory.slab_chord(thickness, radius, math.cos(math.radians(angle))) == pytest.approx(chord, rel=1e-12)
    assert theory.miss_probability(chord, spacing) == pytest.approx(max(0, 1 - chord / spacing), rel=1e-12, abs=1e-12)


def test_broadcasts_as_numpy_does() -> None:
    speed, thickness = np.array([[10.0], [300.0]]), np.array([0.01, 0.1, 1], dtype=np.float32)
    whole = theory.tunneling_probability(speed=speed, radius=0.02, thickness=thickness, fps=60)
    assert whole.shape == (2, 3) and whole.dtype == np.float64
    for i, j in np.ndindex(2, 3):
        one = theory.tunneling_probability(speed=speed[i, 0], radius=0.02, thickness=thickness[j], fps=60)
        assert whole[i, j] == one
    strided = np.arange(1, 21, dtype=float)[::-2]
    np.testing.assert_array_equal(theory.miss_probability(1, strided), np.maximum(0, 1 - 1 / strided))
    assert theory.miss_probability(1, np.empty((0, 3))).shape == (0, 3)
    with pytest.raises(ValueError, match=r"^chord \(2,\), spacing \(3,\): do not broadcast"):
        theory.miss_probability(np.ones(2), np.ones(3))


def sample(half: np.ndarray[Any, Any], radius: float, count: int, rng: np.random.Generator) -> Any:
    """Points of a box around the thickened one, and which of them are in that."""
    corner = half + radius
    points = rng.uniform(-corner, corner, (count, 3))
    beyond = np.maximum(np.abs(points) - half, 0)
    return points, np.linalg.norm(beyond, axis=1) <= radius, 8 * corner.prod()


@pytest.mark.parametrize("half, radius", [((1, 2, 3), 0.5), ((0.01, 1, 1), 0.2), ((0, 0, 0), 1)])
def test_a_wall_that_ends(half: Any, radius: float) -> None:
    rng, half, direction = np.random.default_rng(1), np.array(half, float), np.array([2.0, 1, 0.5])
    unit = direction / np.linalg.norm(direction)
    points, inside, all_of_it = sample(half, radius, 400_000, rng)
    assert theory.volume(half, radius) == pytest.approx(inside.mean() * all_of_it, rel=0.02)
    # Its shadow: lines that hit, by the least gap along the line, of a plane that is wide enough.
    across = np.linalg.svd(unit[None])[2][1:]
    width = 2 * (np.linalg.norm(half) + radius)
    starts = rng.uniform(-width / 2, width / 2, (20_000, 2)) @ across
    along = np.linspace(-width, width, 801)
    gaps = np.linalg.norm(np.maximum(np.abs(starts[:, None] + along[:, None] * unit) - half, 0), axis=2)
    assert theory.shadow(half, radius, direction) == pytest.approx((gaps.min(1) <= radius).mean() * width**2, rel=0.03)
    chord = theory.longest_chord(half, radius, direction)
    chords = (gaps <= radius).sum(1) * (along[1] - along[0])
    assert chords.max() <= chord * 1.02 and chord <= chords.max() * 1.3
    miss = theory.wall_miss_probability(half, radius, direction, [chord * 0.9, chord * 1.1])
    assert math.isnan(miss[0])
    of_those = gaps.min(1) <= radius
    assert miss[1] == pytest.approx(1 - (chords[of_those] / (1.1 * chord)).mean(), abs=0.03)


def test_a_rows_axes() -> None:
    rows = theory.volume(np.array([[1, 1, 1], [1, 2, 3]]), 0)
    np.testing.assert_allclose(rows, [8, 48])
    with pytest.raises(ValueError, match=r"^half_extents: an array of shape \(2,\) is not allowed; \(..., 3\)"):
        theory.volume([1, 2], 0)


def test_a_ray_from_the_center() -> None:
    half, radius, step = np.array([0.05, 1, 1]), 0.1, 2.0
    rng = np.random.default_rng(2)
    shadow, seen = theory.shadow(half, radius, [1, 0, 0]), 4 * half[1] * half[2]
    miss = theory.center_ray_miss_probability(half, radius, step)
    assert 0 < miss < (shadow - seen) / shadow
    y, z = rng.uniform(-1.1, 1.1, (2, 400_000))
    beyond = np.hypot(np.maximum(np.abs(y) - 1, 0), np.maximum(np.abs(z) - 1, 0))
    hits, by_ray = beyond <= radius, beyond == 0
    chord = 2 * (half[0] + np.sqrt(np.maximum(radius**2 - beyond**2, 0)))
    missed = hits & ~by_ray & (rng.uniform(size=y.size) > chord / step)
    assert miss == pytest.approx(missed.sum() / hits.sum(), abs=0.005)
    assert math.isnan(theory.center_ray_miss_probability(half, radius, 0.2))


def test_lateness() -> None:
    rng = np.random.default_rng(3)
    for chord, spacing in [(1, 2), (2, 1), (1, 1)]:
        late = rng.uniform(0, spacing, 400_000)
        late = late[late <= chord]
        found = theory.pose_lateness(chord, spacing)
        assert found.mean == pytest.approx(late.mean(), rel=0.01)
        assert found.deviation == pytest.approx(late.std(), rel=0.01)
        assert found.largest == pytest.approx(late.max(), rel=0.001)
    for lead, step in [(0.5, 2), (3, 2)]:
        late = np.minimum(rng.uniform(0, step, 400_000), lead)
        found = theory.center_ray_lateness(lead, step)
        assert found.mean == pytest.approx(late.mean(), rel=0.01)
        assert found.deviation == pytest.approx(late.std(), rel=0.01)
        assert found.largest == pytest.approx(late.max(), rel=0.001)
    assert theory.pose_lateness([1, 2], 3).mean.shape == (2,)


def test_a_rod_that_spins() -> None:
    rng, clearance, reach, step = np.random.default_rng(4), 0.1, 0.5, 1.3
    for spin in (0.0, 0.4, 2.0):
        x = rng.uniform(0, step, 200_000)[:, None] + step * np.arange(-3, 3)
        angle = rng.uniform(0, math.tau, 200_000)[:, None] + spin * np.arange(-3, 3)
        seen = (np.abs(x) <= clearance / 2 + reach * np.abs(np.cos(angle))).any(1)
        assert theory.rod_miss_probability(clearance, reach, step, spin) == pytest.approx(1 - seen.mean(), abs=0.005)
    assert theory.rod_miss_probability(0.1, 0.5, 0.1 + 0.5 * math.sin(1), [1.0]) == 0
    assert theory.long_step_miss_probability(0.1, 0.5, 10) == pytest.approx(theory.rod_miss_probability(0.1, 0.5, 10, 0.7), rel=1e-9)
    assert theory.blade_miss_probability(0.1, [0.05, 0.4]).tolist() == [0, pytest.approx(0.75)]


@pytest.mark.parametrize(
    "call, error, said",
    [
        (lambda: theory.tunneling_probability(speed=0, radius=1, thickness=1, step=1), ValueError, "speed: 0 is not allowed; a number > 0"),
        (lambda: theory.tunneling_probability(speed=[1, math.nan], radius=1, thickness=1, step=1), ValueError, "speed: nan is not allowed"),
        (lambda: theory.tunneling_probability(speed=1, radius=-1, thickness=1, step=1), ValueError, "radius: -1 is not allowed"),
        (lambda: theory.tunneling_probability(speed=1, radius=1, thickness=math.inf, step=1), ValueError, "thickness: inf"),
        (lambda: theory.tunneling_probability(speed=1, radius=1, thickness=1, step=1, angle_deg=90), ValueError, "angle_deg: 90"),
        (lambda: theory.tunneling_probability(speed=1, radius=1, thickness=1, step=1, poses=1.5), ValueError, "poses: 1.5"),
        (lambda: theory.tunneling_probability(speed=1, radius=1, thickness=1, step=1, poses=0), ValueError, "poses: 0"),
        (lambda: theory.tunneling_probability(speed=1, radius=1, thickness=1), ValueError, "step, fps: give one"),
        (lambda: theory.tunneling_probability(speed=1, radius=1, thickness=1, step=1, fps=1), ValueError, "step, fps: give one"),
        (lambda: theory.tunneling_probability(speed=1, radius=1, thickness=1, fps=0), ValueError, "fps: 0 is not allowed"),
        (lambda: theory.tunneling_probability(speed="1", radius=1, thickness=1, step=1), TypeError, "speed: '1' is not allowed"),
        (lambda: theory.tunneling_probability(speed=1j, radius=1, thickness=1, step=1), TypeError, "speed: 1j"),
        (lambda: theory.tunneling_probability(speed=True, radius=1, thickness=1, step=1), TypeError, "speed: True"),
        (lambda: theory.miss_probability(np.ma.masked_less([-1.0, 1.0], 0), 2), TypeError, "chord: a masked array is not allowed"),
        (lambda: theory.tunneling_probability(speed=None, radius=1, thickness=1, step=1), TypeError, "speed: None"),
        (lambda: theory.tunneling_probability(speed=[[1], [1, 2]], radius=1, thickness=1, step=1), (TypeError, ValueError), "."),
        (lambda: theory.shadow([1, 1, 1], 0, [0, 0, 0]), ValueError, "direction: .0, 0, 0. is not allowed"),
        (lambda: theory.shadow([1, 1, -1], 0, [1, 0, 0]), ValueError, "half_extents: -1"),
        (lambda: theory.miss_probability(1, 0), ValueError, "spacing: 0 is not allowed"),
        (lambda: theory.slab_chord(1, 1, 0), ValueError, "cosine: 0 is not allowed"),
        (lambda: theory.blade_miss_probability(1, -1), ValueError, "spin: -1 is not allowed"),
    ],
)
def test_bad_input_is_named(call: Any, error: type[Exception], said: str) -> None:
    with pytest.raises(error, match=said):
        call()
