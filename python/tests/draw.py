"""Random rows of every kind of shape: numbers in general position, and those that go wrong."""

import numpy as np

import thinwall as tw

KINDS = ("Sphere", "Aabb", "Obb", "Triangle", "Capsule")
POSTPONED = {frozenset(p) for p in (("Aabb", "Triangle"), ("Obb", "Triangle"), ("Triangle",))}
PAIRS = [(a, b) for a in KINDS for b in KINDS if frozenset((a, b)) not in POSTPONED]


def _vectors(rng, rows, size):
    """Of four kinds: anywhere, on a grid (so that shapes touch exactly), very large, and with a NaN or an infinity."""
    kind = rng.choice(4, size=(rows, 1), p=[0.7, 0.27, 0.02, 0.01])
    anywhere = rng.uniform(-size, size, (rows, 3))
    wrong = np.where(rng.random((rows, 3)) < 0.5, rng.choice([np.nan, np.inf], (rows, 3)), anywhere)
    return np.select([kind == 0, kind == 1, kind == 2], [anywhere, np.round(anywhere), anywhere * 1e25], wrong)


def _sizes(rng, shape):
    kind = rng.choice(4, size=shape, p=[0.8, 0.15, 0.04, 0.01])
    anywhere = rng.uniform(0, 1, shape)
    return np.select([kind == 0, kind == 1, kind == 2], [anywhere, np.round(2 * anywhere) / 2, 0 * anywhere], -anywhere)


def rotations(rng, rows):
    """Turned any way; a quarter along the axes."""
    turned = np.linalg.qr(rng.normal(size=(rows, 3, 3)))[0]
    turned[rng.random(rows) < 0.25] = np.eye(3)
    return turned


def shape(kind, rng, rows, dtype=np.float64):
    v = lambda: _vectors(rng, rows, 2.0).astype(dtype)
    s = lambda *axes: _sizes(rng, (rows, *axes)).astype(dtype)
    if kind == "Sphere":
        return tw.Sphere(v(), s())
    if kind == "Aabb":
        return tw.Aabb(v(), s(3))
    if kind == "Obb":
        return tw.Obb(v(), s(3), rotations(rng, rows).astype(dtype))
    if kind == "Triangle":
        return tw.Triangle(v(), v(), v())
    return tw.Capsule(v(), v(), s())


def moving(kind, rng, rows, dtype=np.float64):
    displacement = _vectors(rng, rows, 4.0).astype(dtype)
    displacement[rng.random(rows) < 0.05] = 0
    return tw.Moving(shape(kind, rng, rows, dtype), displacement)


def turning(kind, rng, rows, dtype=np.float64):
    m = moving(kind, rng, rows, dtype)
    return tw.Turning(m.shape, m.displacement, rng.uniform(-3, 3, (rows, 3)).astype(dtype))


def ray(rng, rows, dtype=np.float64):
    max_t = np.where(rng.random(rows) < 0.5, np.inf, rng.uniform(-0.01, 2, rows))
    return tw.Ray(_vectors(rng, rows, 3.0).astype(dtype), _vectors(rng, rows, 3.0).astype(dtype), max_t.astype(dtype))
