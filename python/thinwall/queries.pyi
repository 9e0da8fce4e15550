import enum
from typing import Any, Literal, Optional, Union

import numpy as np
from numpy.typing import NDArray
from typing_extensions import TypeAlias

from .shapes import Aabb, Capsule, Moving, Obb, Ray, Sphere, Triangle, Turning

_Still: TypeAlias = Union[Sphere, Aabb, Obb, Triangle, Capsule]
_InMotion: TypeAlias = Union[Moving, Turning]
_Answers: TypeAlias = NDArray[np.void]  # structured: the docstrings name their fields
_Method: TypeAlias = Literal[
    "end_of_step",
    "substeps",
    "centre_ray",
    "swept_volume_ray",
    "sweep_then_confirm",
    "speculative",
    "conservative_advancement",
    "bisection",
    "inclusion",
    "closed_form",
    "linear_sweep",
]
_BroadPhase: TypeAlias = Literal["all_pairs", "all_ordered_pairs", "sort_and_sweep", "uniform_grid", "r_tree"]

class ToiStatus(enum.IntEnum):
    APART = 0
    HIT = 1
    OVERLAPPING = 2
    GAVE_UP = 3
    INVALID = 4

class DecidedBy(enum.IntEnum):
    GUARD = 0
    FILTER = 1
    CERTIFICATE = 2
    EXACT = 3

def overlaps(a: _Still, b: _Still, *, threads: int = ...) -> NDArray[np.bool_]: ...
def valid(shape: Union[_Still, Ray, _InMotion], *, threads: int = ...) -> NDArray[np.bool_]: ...
def contact(a: _Still, b: _Still, *, threads: int = ..., out: Optional[_Answers] = ...) -> _Answers: ...
def separation(a: _Still, b: _Still, *, threads: int = ..., out: Optional[_Answers] = ...) -> _Answers: ...
def manifold(a: _Still, b: _Still, *, threads: int = ..., out: Optional[_Answers] = ...) -> _Answers: ...
def raycast(ray: Ray, shape: _Still, *, threads: int = ..., out: Optional[_Answers] = ...) -> _Answers: ...
def methods(*, turning: bool = ...) -> dict[str, list[str]]: ...
def time_of_impact(
    a: _InMotion,
    b: _InMotion,
    method: Optional[_Method] = ...,
    *,
    threads: int = ...,
    vectors: bool = ...,
    out: Optional[_Answers] = ...,
    tolerance: float = ...,
    max_evaluations: int = ...,
    n: int = ...,
    margin: float = ...,
    min_separation: float = ...,
) -> _Answers: ...
def certified_time_of_impact(a: _InMotion, b: _InMotion, *, threads: int = ..., out: Optional[_Answers] = ...) -> _Answers: ...
def find_pairs(
    lower: NDArray[np.floating[Any]],
    upper: NDArray[np.floating[Any]],
    method: _BroadPhase = ...,
    *,
    group: Optional[NDArray[np.uint32]] = ...,
    mask: Optional[NDArray[np.uint32]] = ...,
    static: Optional[NDArray[np.bool_]] = ...,
    max_pairs: Optional[int] = ...,
) -> NDArray[np.int64]: ...
