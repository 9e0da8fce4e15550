"""Rows of shapes: small classes that hold arrays, and copy none of them.

An array is float64 or float32 and has the numbers of one row, or of N rows along its first axis; a shape of one row stands
against any number of rows, as NumPy broadcasts. Numbers of Python's own and lists of them have no type: they take that of the
arrays beside them, and are float64 where there is none. Whatever else is an error; nothing is cast in silence.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence
    from typing import NoReturn, Union

    from numpy.typing import NDArray
    from typing_extensions import Self, TypeAlias

    _Array: TypeAlias = NDArray[np.floating[Any]]
    _Number: TypeAlias = Union[float, np.floating[Any], Sequence[float], _Array]
    _Vector: TypeAlias = Union[Sequence[float], Sequence[Sequence[float]], _Array]
    _Matrix: TypeAlias = Union[Sequence[Sequence[float]], Sequence[Sequence[Sequence[float]]], _Array]
    _Rows_At: TypeAlias = Union[slice, Sequence[int], NDArray[np.integer[Any]], NDArray[np.bool_]]
    _Still: TypeAlias = Union["Sphere", "Aabb", "Obb", "Triangle", "Capsule"]

_AXES = {"scalar": (), "vector": (3,), "matrix": (3, 3)}
_FLOATS = (np.dtype(np.float64), np.dtype(np.float32))


def _is_literal(value: Any) -> bool:
    """True for a number of Python's own, and for lists and tuples of nothing else."""
    if isinstance(value, (list, tuple)):
        return all(map(_is_literal, value))
    return type(value) in (float, int)


def _as_float(value: Any) -> float:
    """`value` as a float. What is too large for one is infinite, and so refused where that is."""
    try:
        return float(value)
    except OverflowError:
        return float("inf") if value > 0 else float("-inf")


def _words(shape: tuple[Any, ...]) -> str:
    return "(" + ", ".join(map(str, shape)) + ("," if len(shape) == 1 else "") + ")"


class _Rows:
    """What all shapes share: arrays, one a field, of one row or of N."""

    __slots__ = ("_arrays", "_rows", "dtype")
    _fields: dict[str, str] = {}
    _kind: str
    _arrays: tuple[_Array, ...]
    _rows: int | None
    dtype: np.dtype[np.floating[Any]]

    def _set(self, values: Mapping[str, Any], dtype: Any = None) -> None:
        arrays: dict[str, Any] = {}
        for name, value in values.items():
            if isinstance(value, np.generic):  # a scalar of NumPy's
                value = np.asarray(value)
            if isinstance(value, np.ndarray):
                if isinstance(value, np.ma.MaskedArray):
                    self._refuse(name, "a masked array", "one without a mask: .filled(numpy.nan) makes INVALID rows of what it hides")
                if value.dtype not in _FLOATS:
                    self._refuse(name, f"an array of {value.dtype}", "float64 or float32: convert it, as by .astype(float)")
                if dtype is not None and value.dtype != dtype:
                    self._refuse(name, f"an array of {value.dtype}", f"{dtype}, as the arrays before it are: convert one, as by .astype({dtype})")
                dtype = value.dtype
            elif hasattr(value, "to_numpy"):  # of pandas
                self._refuse(name, f"a {type(value).__name__}", "an array: convert it by .to_numpy()")
            elif not _is_literal(value):
                allowed = "an array, a number or a list of numbers, those of Python's own"
                self._refuse(name, f"{type(value).__name__} {value!r:.60}", allowed)
            arrays[name] = value
        self.dtype = np.dtype(np.float64 if dtype is None else dtype)
        rows = None
        for name, value in arrays.items():
            if not isinstance(value, np.ndarray):
                value = self._literal(name, value)
            axes = _AXES[self._fields[name]]
            if value.shape != axes and value.shape[1:] != axes or value.ndim > len(axes) + 1:
                allowed = _words(axes) + " or " + _words(("N",) + axes)
                self._refuse(name, f"an array of shape {_words(value.shape)}", f"shape {allowed}")
            if value.ndim > len(axes):
                if rows not in (None, 1, len(value)) and len(value) != 1:
                    self._refuse(name, f"an array of {len(value)} rows", f"{rows}, as the arrays before it have, or 1")
                rows = len(value) if rows in (None, 1) else rows
            arrays[name] = value
        self._arrays = tuple(arrays.values())
        self._rows = rows

    def _literal(self, name: str, value: Any) -> _Array:
        try:
            return np.array(value, dtype=self.dtype)
        except (ValueError, OverflowError) as error:
            self._refuse(name, f"{value!r:.60}", f"numbers in rows of equal length ({error})", ValueError)

    def _refuse(self, name: str, got: str, allowed: str, error: type[Exception] | None = None) -> NoReturn:
        error = error or (ValueError if "shape" in got or "rows" in got else TypeError)
        raise error(f"{type(self).__name__}: {name} is {got}; allowed is {allowed}")

    def __len__(self) -> int:
        """The number of rows. A shape of one row without an axis of rows has no length, as a scalar of NumPy's."""
        if self._rows is None:
            raise TypeError(f"{type(self).__name__}: one shape, without rows, has no length")
        return self._rows

    @property
    def is_one(self) -> bool:
        """True if no array has an axis of rows."""
        return self._rows is None

    def __iter__(self) -> Iterator[Self]:
        for i in range(len(self)):
            yield self[i]

    def _at(self, key: Any, rows: int) -> list[Any]:
        """The arrays at those of `rows` rows: views for slices, copies for arrays of indices and masks, as of NumPy's arrays."""
        arrays = []
        for axes, array in zip(self._fields.values(), self._arrays):
            if array.ndim > len(_AXES[axes]):
                array = np.broadcast_to(array, (rows,) + array.shape[1:])[key]
            arrays.append(array)
        return arrays

    def _rows_at(self, key: Any, rows: int) -> Self:
        return type(self)(*self._at(key, rows))

    def __getitem__(self, key: int | np.integer[Any] | _Rows_At) -> Self:
        """Rows, by an index, a slice, an array of indices or a mask."""
        if self._rows is None:
            raise TypeError(f"{type(self).__name__}: one shape, without rows, cannot be indexed")
        if isinstance(key, tuple) or key is None or key is Ellipsis or np.ndim(key) > 1:  # type: ignore[arg-type]
            raise TypeError(f"{type(self).__name__}: rows are indexed by an index, a slice, an array (N,) or a mask, not by {key!r:.60}")
        return self._rows_at(key, self._rows)

    def __repr__(self) -> str:
        fields = ", ".join(self._fields)
        rows = "one" if self._rows is None else f"{self._rows} rows"
        return f"<{type(self).__name__}({fields}): {rows}, {self.dtype}>"

    def __eq__(self, other: object) -> bool:
        """True if all arrays are equal, row for row; NaN is unequal to itself."""
        if not isinstance(other, _Rows) or type(self) is not type(other):
            return NotImplemented
        return self.dtype == other.dtype and self._rows == other._rows and all(map(np.array_equal, self._arrays, other._arrays))

    __hash__ = None  # type: ignore[assignment]

    def __copy__(self) -> Self:
        return type(self)(*self._given())

    def __deepcopy__(self, memo: dict[int, Any]) -> Self:
        return type(self)(*(np.copy(a) if isinstance(a, np.ndarray) else a.__deepcopy__(memo) for a in self._given()))

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), self._given()

    def _given(self) -> tuple[Any, ...]:
        return self._arrays

    def _side(self) -> tuple[str, list[_Array]]:
        """The kind and the arrays, as _queries takes them."""
        return self._kind, list(self._arrays)


def _field(cls: type, index: int, name: str) -> None:
    def get(self: _Rows) -> _Array:
        return self._arrays[index]

    setattr(cls, name, property(get, doc=f"The {name}, as given."))


_Class = TypeVar("_Class", bound="type[_Rows]")


def _shape(cls: _Class) -> _Class:
    cls._kind = cls.__name__  # of classes made of it, too
    for index, name in enumerate(cls._fields):
        _field(cls, index, name)
    return cls


@_shape
class Sphere(_Rows):
    """All points within `radius` of `center`.

    Parameters
    ----------
    center : array, (3,) or (N, 3)
        [length]
    radius : array, () or (N,)
        [length] >= 0; 0 is a point.
    """

    __slots__ = ()
    center: _Array
    radius: _Array
    _fields = {"center": "vector", "radius": "scalar"}

    def __init__(self, center: _Vector, radius: _Number) -> None:
        self._set({"center": center, "radius": radius})


@_shape
class Aabb(_Rows):
    """A box along the axes.

    Parameters
    ----------
    center : array, (3,) or (N, 3)
        [length]
    half_extents : array, (3,) or (N, 3)
        [length] each >= 0; a 0 makes a plate, a rod or a point.
    """

    __slots__ = ()
    center: _Array
    half_extents: _Array
    _fields = {"center": "vector", "half_extents": "vector"}

    def __init__(self, center: _Vector, half_extents: _Vector) -> None:
        self._set({"center": center, "half_extents": half_extents})


@_shape
class Obb(_Rows):
    """An oriented box: all center + sum of x_i half_extents_i axes[:, i] with abs(x_i) <= 1.

    Parameters
    ----------
    center : array, (3,) or (N, 3)
        [length]
    half_extents : array, (3,) or (N, 3)
        [length] each >= 0; a 0 makes a plate, a rod or a point.
    axes : array, (3, 3) or (N, 3, 3)
        Its columns are the directions of the three extents: unit, at right angles to the rounding of their type. So a matrix
        that turns the box from the world's axes is what to pass.
    """

    __slots__ = ()
    center: _Array
    half_extents: _Array
    axes: _Array
    _fields = {"center": "vector", "half_extents": "vector", "axes": "matrix"}

    def __init__(self, center: _Vector, half_extents: _Vector, axes: _Matrix) -> None:
        self._set({"center": center, "half_extents": half_extents, "axes": axes})


@_shape
class Triangle(_Rows):
    """A triangle with its inside.

    Parameters
    ----------
    a, b, c : array, (3,) or (N, 3)
        [length] corners, in any order; on one line they make a segment, in one place a point.
    """

    __slots__ = ()
    a: _Array
    b: _Array
    c: _Array
    _fields = {"a": "vector", "b": "vector", "c": "vector"}

    def __init__(self, a: _Vector, b: _Vector, c: _Vector) -> None:
        self._set({"a": a, "b": b, "c": c})


@_shape
class Capsule(_Rows):
    """All points within `radius` of the segment from `a` to `b`.

    Parameters
    ----------
    a, b : array, (3,) or (N, 3)
        [length] ends of the core segment; a == b is a ball.
    radius : array, () or (N,)
        [length] >= 0; 0 is a segment.
    """

    __slots__ = ()
    a: _Array
    b: _Array
    radius: _Array
    _fields = {"a": "vector", "b": "vector", "radius": "scalar"}

    def __init__(self, a: _Vector, b: _Vector, radius: _Number) -> None:
        self._set({"a": a, "b": b, "radius": radius})


@_shape
class Ray(_Rows):
    """A half line, cut off at `max_t`.

    Parameters
    ----------
    origin : array, (3,) or (N, 3)
        [length]
    direction : array, (3,) or (N, 3)
        [length] of any length; t counts in lengths of it.
    max_t : array, () or (N,), optional
        [1] >= 0; infinite if left out.
    """

    __slots__ = ()
    origin: _Array
    direction: _Array
    max_t: _Array
    _fields = {"origin": "vector", "direction": "vector", "max_t": "scalar"}

    def __init__(self, origin: _Vector, direction: _Vector, max_t: _Number = float("inf")) -> None:
        self._set({"origin": origin, "direction": direction, "max_t": max_t})


class _InMotion(_Rows):
    """A shape and its motion over one step."""

    __slots__ = ("shape",)
    shape: _Still
    displacement: _Array
    _still: tuple[type, ...] = (Sphere, Aabb, Obb, Triangle, Capsule)

    def _set_motion(self, shape: _Still, motion: Mapping[str, Any]) -> None:
        if not isinstance(shape, self._still):
            allowed = ", ".join(cls.__name__ for cls in self._still[:-1]) + f" or {self._still[-1].__name__}"
            hint = "; a box along the axes that turns is an Obb" if isinstance(shape, Aabb) else ""
            self._refuse("shape", type(shape).__name__, allowed + hint)
        self.shape = shape
        self._set(motion, shape.dtype)
        if self._rows is None or shape._rows is None or shape._rows == 1:
            self._rows = shape._rows if self._rows is None else self._rows
        elif self._rows == 1:
            self._rows = shape._rows
        elif self._rows != shape._rows:
            self._refuse("displacement", f"an array of {self._rows} rows", f"{shape._rows}, as the shape has, or 1")

    def _given(self) -> tuple[Any, ...]:
        return (self.shape, *self._arrays)

    def _at(self, key: Any, rows: int) -> list[Any]:
        shape = self.shape if self.shape.is_one else self.shape._rows_at(key, rows)
        return [shape, *super()._at(key, rows)]

    def __eq__(self, other: object) -> bool:
        """True if the shapes and all arrays are equal, row for row; NaN is unequal to itself."""
        if not isinstance(other, _InMotion) or type(self) is not type(other):
            return NotImplemented
        return super().__eq__(other) and self.shape == other.shape

    __hash__ = None  # type: ignore[assignment]

    def _side(self) -> tuple[str, list[_Array]]:
        kind, arrays = self.shape._side()
        return kind, arrays + list(self._arrays)


@_shape
class Moving(_InMotion):
    """A shape that moves in a straight line over one step, without turning.

    Parameters
    ----------
    shape : Sphere, Aabb, Obb, Triangle or Capsule
        At time 0.
    displacement : array, (3,) or (N, 3)
        [length] how far it travels by time 1: velocity * dt.
    """

    __slots__ = ()
    _fields = {"displacement": "vector"}

    def __init__(self, shape: _Still, displacement: _Vector) -> None:
        self._set_motion(shape, {"displacement": displacement})


@_shape
class Turning(_InMotion):
    """A shape that flies straight and spins at a constant rate over one step.

    Parameters
    ----------
    shape : Sphere, Obb, Triangle or Capsule
        At time 0. A box along the axes that turns is an Obb.
    displacement : array, (3,) or (N, 3)
        [length] how far its center travels by time 1: velocity * dt.
    rotation : array, (3,) or (N, 3)
        [rad] axis times angle about its center, an end of a capsule's core being as far from it as the other and a triangle's the
        mean of its corners: angular velocity * dt. Any angle, many turns too.
    """

    __slots__ = ()
    rotation: _Array
    _fields = {"displacement": "vector", "rotation": "vector"}
    _still = (Sphere, Obb, Triangle, Capsule)

    def __init__(self, shape: Sphere | Obb | Triangle | Capsule, displacement: _Vector, rotation: _Vector) -> None:
        self._set_motion(shape, {"displacement": displacement, "rotation": rotation})


def at_rest(shape: _Still) -> Moving:
    """`shape` as one that moves nowhere: ``Moving(shape, [0, 0, 0])``."""
    return Moving(shape, [0.0, 0.0, 0.0])
