"""Scenes of bodies: compared under every way to step them, or stepped by hand."""

from __future__ import annotations

import difflib
import math
import os
from pathlib import Path
from typing import Any, Mapping, Sequence, Union

import numpy as np
import numpy.typing as npt

from . import _lab, experiments
from .results import Result
from .shapes import _as_float

SceneLike = Union[str, "os.PathLike[str]", Mapping[str, Any]]
BodyLike = Union[int, "np.integer[Any]", str]  # an id, as of World.ids, or a name

_EVENT = [("kind", "U5"), ("first", "u4"), ("second", "u4"), ("step", "i8"), ("time", "f8"), ("removed", "?")]
_HIT = [("first", "u4"), ("second", "u4"), ("time", "f8"), ("at_start", "?"), ("normal", "f8", 3), ("point", "f8", 3)]


def compare(
    scene: SceneLike,
    /,
    *,
    seed: int = 0,
    threads: int | None = None,
    out: str | os.PathLike[str] | None = None,
    progress: experiments.Progress | None = None,
) -> Result:
    """Steps a scene under every time policy and step that its ``[compare]`` names, and holds each against an exact run.

    The same as ``thinwall compare``.

    Parameters
    ----------
    scene : str, path or dict
        A TOML file, TOML text (a str of more than one line), or a dict of what the file would hold. A dict needs no name.
    seed, threads, out, progress
        As for `thinwall.run`.

    Returns
    -------
    Result
        ``result["compare"]`` has a row for each policy and step: pairs that tunneled, met and did not meet, and the error of the times
        at which they met; ``result["timings"]`` what it cost.

    Raises
    ------
    TypeError, ValueError, RuntimeError
        As `thinwall.run` does.
    """
    target, text, is_own = _source(scene)
    return experiments._run(target, text, is_own, True, seed, None, threads, out, progress)


def world(scene: SceneLike, /, *, seed: int = 0, threads: int = 1) -> World:
    """A world of the scene's bodies, to be stepped by hand.

    Parameters
    ----------
    scene : str, path or dict
        As for `compare`. What the scene says of its steps, trace and comparison is left to the caller; what it pushes is pushed.
    seed : int, default 0
        Of the random places of copies; 0 to 2**64 - 1.
    threads : int, default 1
        >= 1. Of no effect on any result.

    Returns
    -------
    World

    Raises
    ------
    ValueError
        An unknown key, with the nearest spelling; a value out of range; a body that no world can hold.
    TypeError
        A value that no setting can be.

    Examples
    --------
    >>> world = tw.world({"body": [{"shape": "sphere", "radius": 0.1, "velocity": [1, 0, 0]}]})
    >>> world.step(0.5)["kind"]
    array([], dtype='<U5')
    >>> world.positions
    array([[0.5, 0. , 0. ]])
    """
    return World(scene, seed=seed, threads=threads)


def _source(scene: SceneLike) -> tuple[str, str | None, bool]:
    return experiments.source("scene", {"scene": "scene", **scene} if isinstance(scene, Mapping) else scene)


class World:
    """Bodies that move, meet and bounce: see `world`.

    What concerns bodies are arrays with a row for each, in the order of their ids. Arrays are the caller's own: the world neither sees
    what is written into them nor changes them.

    Attributes
    ----------
    name : str
    dt : float
        [s] The scene's own step.
    policy : {"discrete", "substeps", "clamp", "event_driven"}
    time : float
        [s] Since the world began.
    energy : float
        [J] Kinetic, and of height, over bodies of finite mass.
    state_hash : int
        Of every body's id, place and velocity, to the bit.
    ids : (N,) uint32
    names, shapes : (N,) str
        A shape is ``"sphere"``, ``"box"``, ``"turned_box"``, ``"capsule"`` or ``"none"``.
    sizes : (N, 3) float64
        [m] From face to face along each axis.
    masses, restitutions : (N,) float64
        [kg], [1]. A driven body has mass inf.
    is_static : (N,) bool
    positions, velocities : (N, 3) float64
        [m] of the centers, [m/s]. A body without a shape has no place: zeros.
    events : (M,) structured
        Of the last `step`: ``kind`` ("begin", "stay" or "end"), ``first`` and ``second`` (ids, first < second), ``step`` (from 1),
        ``time`` [s], ``removed`` (an end because one of them was).
    hits : (M,) structured
        Contacts of the last `step`, in the order they were processed: ``first``, ``second``, ``time`` [s], ``at_start`` (in contact
        at the start of the step already), ``normal`` (3, unit, from first to second), ``point`` (3, [m]).
    """

    def __init__(self, scene: SceneLike, /, *, seed: int = 0, threads: int = 1) -> None:
        target, text, is_own = _source(scene)
        if text is None:
            try:
                text = Path(target).read_text(encoding="utf-8")
            except (OSError, UnicodeDecodeError) as error:
                raise ValueError(f"{target}: cannot be read: {error}") from None
        number = experiments.whole("seed", seed, 0, 2**64 - 1)
        width = experiments.whole("threads", threads, 1, 4096)
        try:
            self._world = _lab.SteppedScene(text=text, file=target, seed=number, threads=width)
        except ValueError as error:
            raise ValueError(experiments.said(error, target if is_own else None)) from None
        self.name: str = self._world.name
        self.dt: float = self._world.dt
        self.policy: str = self._world.policy

    def step(self, dt: float | None = None, steps: int = 1) -> npt.NDArray[Any]:
        """Steps the world. Ctrl-C ends it between two steps.

        A signal handler runs between two steps and finds the world whole: it may read it, change it, or step it, and what was under way
        goes on from there. Other threads that wait for the world may come in at the same moments, a few times a second.

        Parameters
        ----------
        dt : float, optional
            [s] > 0; the scene's own if not given.
        steps : int, default 1
            How many, >= 1.

        Returns
        -------
        (M,) structured
            `events`, of all these steps and of no others.

        Raises
        ------
        TypeError, ValueError
            A wrong `dt` or `steps`.
        RuntimeError
            A body left the representable world, or more pairs may touch than ``max_pairs``; the step that failed has changed nothing.
        """
        length = self.dt if dt is None else _seconds("dt", dt)
        return _events(self._world.step(length, experiments.whole("steps", steps, 1, 2**63 - 1)))

    def set_velocity(self, body: BodyLike, velocity: npt.ArrayLike) -> None:
        """Gives a body, by its id or name, another velocity, (3,) [m/s]."""
        self._world.set_velocity(self._id(body), _vector("velocity", velocity))

    def move(self, body: BodyLike, by: npt.ArrayLike) -> None:
        """Moves a body, by its id or name, by (3,) [m]."""
        self._world.move(self._id(body), _vector("by", by))

    def remove(self, body: BodyLike) -> None:
        """Removes a body, by its id or name; its contacts end with the next step."""
        self._world.remove(self._id(body))

    @property
    def time(self) -> float:
        return self._world.time

    @property
    def energy(self) -> float:
        return self._world.energy

    @property
    def state_hash(self) -> int:
        return self._world.state_hash

    @property
    def ids(self) -> npt.NDArray[np.uint32]:
        return self._column("id")

    @property
    def names(self) -> npt.NDArray[np.str_]:
        return self._text("name")

    @property
    def shapes(self) -> npt.NDArray[np.str_]:
        return self._text("shape")

    @property
    def sizes(self) -> npt.NDArray[np.float64]:
        return self._column("size")

    @property
    def masses(self) -> npt.NDArray[np.float64]:
        return self._column("mass")

    @property
    def restitutions(self) -> npt.NDArray[np.float64]:
        return self._column("restitution")

    @property
    def is_static(self) -> npt.NDArray[np.bool_]:
        return self._column("is_static")

    @property
    def positions(self) -> npt.NDArray[np.float64]:
        return self._world.positions

    @property
    def velocities(self) -> npt.NDArray[np.float64]:
        return self._world.velocities

    @property
    def events(self) -> npt.NDArray[Any]:
        return _events(self._world.events)

    @property
    def hits(self) -> npt.NDArray[Any]:
        return _rows(_HIT, self._world.hits)

    def __len__(self) -> int:
        return len(self.ids)

    def __repr__(self) -> str:
        return f"thinwall world of the scene {self.name!r}: {len(self)} bodies at {self.time:g} s, {self.policy}"

    def _column(self, name: str) -> npt.NDArray[Any]:
        column: npt.NDArray[Any] = self._world.bodies[name]
        return column

    def _text(self, name: str) -> npt.NDArray[np.str_]:
        texts = self._world.bodies[name]
        return np.array(texts, dtype=np.str_) if texts else np.empty(0, "U1")

    def _id(self, body: BodyLike) -> int:
        if not isinstance(body, str):
            return experiments.whole("body", body, 0, 2**32 - 1)
        found = np.flatnonzero(self.names == body)
        if len(found) == 1:
            return int(self.ids[found[0]])
        if len(found) > 1:
            raise ValueError(f"body: {len(found)} bodies are called {body!r}; name one by its id")
        near = difflib.get_close_matches(body, self.names.tolist(), 1)
        raise ValueError(f"body: none is called {body!r}" + (f"; did you mean {near[0]!r}?" if near else ""))


def _seconds(argument: str, value: float) -> float:
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (int, float, np.integer, np.floating)):
        raise TypeError(f"{argument}: {value!r} is not allowed; a number")
    number = _as_float(value)
    if not 0 < number < math.inf:
        raise ValueError(f"{argument}: {number} is not allowed; a number > 0 and finite [s]")
    return number


def _vector(argument: str, value: npt.ArrayLike) -> Sequence[float]:
    if isinstance(value, np.ma.MaskedArray):
        raise TypeError(f"{argument}: a masked array is not allowed; one without a mask")
    array = np.asarray(value)
    if array.shape != (3,) or array.dtype.kind not in "iuf":
        raise ValueError(f"{argument}: an array of shape {array.shape} and type {array.dtype} is not allowed; three numbers")
    numbers: Sequence[float] = array.astype(np.float64).tolist()
    return numbers


def _events(columns: Mapping[str, Any]) -> npt.NDArray[Any]:
    return _rows(_EVENT, {**columns, "kind": np.array(["begin", "stay", "end"])[columns["kind"]]})


def _rows(fields: list[Any], columns: Mapping[str, Any]) -> npt.NDArray[Any]:
    rows = np.empty(len(columns["first"]), dtype=fields)
    for name, column in columns.items():
        rows[name] = column
    return rows
