"""Continuous collision detection and tunneling research: queries on arrays, and experiments as data frames. See docs/python.md.

>>> import numpy as np, thinwall as tw
>>> bullets = tw.Moving(tw.Sphere(np.zeros((3, 3)), 0.01), np.array([[1.0, 0, 0], [5.0, 0, 0], [20.0, 0, 0]]))
>>> wall = tw.at_rest(tw.Aabb([10.0, 0, 0], [0.05, 5, 5]))
>>> tw.time_of_impact(bullets, wall)["status"] == tw.ToiStatus.HIT
array([False, False,  True])
"""

from typing import TYPE_CHECKING

from ._version import __version__
from .queries import (
    DecidedBy,
    ToiStatus,
    certified_time_of_impact,
    contact,
    find_pairs,
    manifold,
    methods,
    overlaps,
    raycast,
    separation,
    time_of_impact,
    valid,
)
from .shapes import Aabb, Capsule, Moving, Obb, Ray, Sphere, Triangle, Turning, at_rest

if TYPE_CHECKING:
    from . import theory as theory
    from .advice import advise as advise
    from .experiments import defaults as defaults
    from .experiments import run as run
    from .results import Result as Result
    from .results import read as read
    from .scenes import compare as compare
    from .scenes import world as world

# Experiments are loaded when they are first asked for: whoever asks queries waits for none of it.
_LAZY = {
    "run": "experiments",
    "read": "results",
    "Result": "results",
    "defaults": "experiments",
    "advise": "advice",
    "theory": None,
    "compare": "scenes",
    "world": "scenes",
}

__all__ = [
    "Aabb",
    "Capsule",
    "DecidedBy",
    "Moving",
    "Obb",
    "Ray",
    "Sphere",
    "ToiStatus",
    "Triangle",
    "Turning",
    "__version__",
    "at_rest",
    "certified_time_of_impact",
    "contact",
    "find_pairs",
    "manifold",
    "methods",
    "overlaps",
    "raycast",
    "separation",
    "time_of_impact",
    "valid",
    *_LAZY,
]


if not TYPE_CHECKING:  # to which what is not above does not exist

    def __getattr__(name):
        if name not in _LAZY:
            raise AttributeError(f"module 'thinwall' has no attribute {name!r}")
        import importlib

        module = importlib.import_module("." + (_LAZY[name] or name), __name__)
        value = module if _LAZY[name] is None else getattr(module, name)
        globals()[name] = value
        return value


def __dir__() -> list[str]:
    return sorted(set(globals()) | set(__all__))
