"""The queries, of all rows at once. What the answers promise, and for which pairs, is the C++ library's: docs/closed_forms.md, docs/pairs.md."""

import difflib
import enum
import math

import numpy as np

from . import _queries
from .shapes import Aabb, Capsule, Moving, Obb, Ray, Sphere, Triangle, Turning, _as_float, _InMotion, _Rows


class ToiStatus(enum.IntEnum):
    """What became of a row; `answer["status"] == ToiStatus.HIT` is a mask.

    APART : no contact.
    HIT : first contact at `time`; of a ray, at `t`.
    OVERLAPPING : in contact at the start already, touching included, whatever the motion.
    GAVE_UP : out of budget; `time` is the largest time proven free.
    INVALID : a NaN, an infinity, a negative size or axes that are not orthonormal; times and distances are NaN.
    """

    APART = 0
    HIT = 1
    OVERLAPPING = 2
    GAVE_UP = 3
    INVALID = 4


class DecidedBy(enum.IntEnum):
    """The stage that decided a certified answer: none (it was invalid), bounded rounding, a certificate, or exact integers."""

    GUARD = 0
    FILTER = 1
    CERTIFICATE = 2
    EXACT = 3


_STILL = (Sphere, Aabb, Obb, Triangle, Capsule)
_IN_MOTION = (Moving, Turning)


def _one_of(classes):
    names = [cls.__name__ for cls in classes]
    return ", ".join(names[:-1]) + f" or {names[-1]}" if len(names) > 1 else names[0]


def _near(name, known):
    return difflib.get_close_matches(str(name), known, n=1, cutoff=0.5)


def _nearest(name, known, what):
    near = _near(name, known)
    hint = f"; did you mean {near[0]!r}? Allowed" if near else "; allowed"
    return f"{what} is {name!r}{hint} is {', '.join(known)}"


def _check_shape(query, argument, shape, classes):
    if isinstance(shape, classes):
        return
    hint = ""
    if isinstance(shape, _InMotion):
        hint = "; ask about its .shape, or about when it touches by time_of_impact"
    elif isinstance(shape, _STILL) and classes == _IN_MOTION:
        hint = "; what stands still is at_rest(shape)"
    raise TypeError(f"{query}: {argument} is {type(shape).__name__}; allowed is {_one_of(classes)}{hint}")


def _check_threads(query, threads):
    if isinstance(threads, (bool, np.bool_)) or not isinstance(threads, (int, np.integer)):
        raise TypeError(f"{query}: threads is {type(threads).__name__} {threads!r:.60}; allowed is a whole number of at least 1")
    if threads < 1:
        raise ValueError(f"{query}: threads is {threads}; allowed is a whole number of at least 1")
    return int(min(threads, 1 << 20))


def _rows_of(query, a, b):
    lengths = [shape._rows for shape in (a, b) if shape._rows is not None]
    if not lengths:
        return None
    rows = max(lengths, key=lambda n: n != 1)
    if any(n not in (1, rows) for n in lengths):
        raise ValueError(f"{query}: b has {b._rows} rows; allowed is {a._rows}, as a has, or 1")
    return rows


def _inputs(*shapes):
    for shape in shapes:
        yield from shape._arrays
        if isinstance(shape, _InMotion):
            yield from shape.shape._arrays


def _room(query, out, rows, dtype, a, b):
    """Where the answers go: `out`, once it was found right, or a fresh array."""
    shape = () if rows is None else (rows,)
    if out is None:
        return np.empty(shape, dtype)
    if not isinstance(out, np.ndarray):
        raise TypeError(f"{query}: out is {type(out).__name__}; allowed is an array, as an earlier call returned it")
    if out.dtype != dtype:
        raise TypeError(f"{query}: out is an array of {out.dtype}; allowed is {dtype}")
    if out.shape != shape:
        raise ValueError(f"{query}: out has shape {out.shape}; allowed is {shape}")
    if not out.flags.writeable:
        raise ValueError(f"{query}: out is read-only; allowed is an array that can be written")
    if not out.flags.c_contiguous:
        raise ValueError(f"{query}: out has strides {out.strides}; allowed is an array without gaps")
    if any(np.may_share_memory(out, array) for array in _inputs(a, b)):
        raise ValueError(f"{query}: out shares memory with what is read; allowed is memory of its own")
    return out


def _ask(query, a, b, threads, out=None, kind=None, method="", options=None):
    threads = _check_threads(query, threads)
    if a.dtype != b.dtype:
        hint = "give one of them arrays of the other's; a shape of Python's own numbers alone holds float64"
        raise TypeError(f"{query}: b holds {b.dtype}; allowed is {a.dtype}, as a holds: {hint}")
    rows = _rows_of(query, a, b)
    kind = kind or query
    out = _room(query, out, rows, _queries.row_type(kind, a.dtype == np.float32), a, b)
    kind_a, arrays_a = a._side()
    kind_b, arrays_b = b._side()
    if not _queries.ask(kind, kind_a, arrays_a, kind_b, arrays_b, out, threads, method, options or _queries.Options()):
        by = f" by {method!r}" if method else ""
        raise ValueError(f"{query}: {kind_a} with {kind_b} is not served{by}; docs/pairs.md says which pairs are")
    return out[()] if rows is None else out


def overlaps(a, b, *, threads=1):
    """True where two shapes share a point; touching counts.

    Parameters
    ----------
    a, b : Sphere, Aabb, Obb, Triangle or Capsule
        Of N rows, or of one.
    threads : int, optional
        >= 1; more than the machine has are as many as it has.

    Returns
    -------
    array of bool, (N,)
        False for a row that is not `valid`. A bool where both are one shape without rows.

    Raises
    ------
    TypeError
        For what is no shape, or where one holds float32 and the other float64.
    ValueError
        For other numbers of rows, threads below 1, or a pair that is not served.

    Notes
    -----
    The bits are those of C++'s ``overlaps(a, b)``, which decides as if the gap were off by a few units of round-off. Source: docs/pairs.md.
    """
    for argument, shape in (("a", a), ("b", b)):
        _check_shape("overlaps", argument, shape, _STILL)
    return _ask("overlaps", a, b, threads)


def valid(shape, *, threads=1):
    """True where a shape, moving or not, or a ray is a question: finite numbers, no negative size, orthonormal axes.

    Parameters
    ----------
    shape : any shape, Ray, Moving or Turning
    threads : int, optional
        >= 1

    Returns
    -------
    array of bool, (N,)
    """
    _check_shape("valid", "shape", shape, (*_STILL, Ray, Moving, Turning))
    return _ask("valid", shape, shape, threads)


def contact(a, b, *, threads=1, out=None):
    """One point of contact of each row in which two shapes touch or overlap.

    Parameters
    ----------
    a, b : Sphere, Aabb, Obb, Triangle or Capsule
        Of N rows, or of one.
    threads : int, optional
        >= 1; more than the machine has are as many as it has.
    out : array, optional
        Where the answers go: an array that an earlier call returned, of as many rows.

    Returns
    -------
    structured array, (N,)
        ``status`` : ToiStatus: APART, OVERLAPPING or INVALID. The rest is zero unless OVERLAPPING.
        ``local_a``, ``local_b`` : (3,) [length] the deepest points, relative to each shape's center; an Aabb's is always zero.
        ``normal`` : (3,) unit, from a to b.
        ``penetration`` : [length] >= 0: moving b this far along the normal leaves the two touching.

    Raises
    ------
    TypeError, ValueError
        As `overlaps`; and for an `out` of another dtype or shape, read-only, with gaps, or of memory that is read.

    Notes
    -----
    The bits are those of C++'s ``contact(a, b)``. Degenerate: where the cores touch, the normal is the one of least penetration. Source:
    docs/pairs.md.
    """
    for argument, shape in (("a", a), ("b", b)):
        _check_shape("contact", argument, shape, _STILL)
    return _ask("contact", a, b, threads, out)


def separation(a, b, *, threads=1, out=None):
    """How far apart two shapes are, or how deep in each other.

    Parameters
    ----------
    a, b, threads, out
        As of `contact`.

    Returns
    -------
    structured array, (N,)
        ``status`` : ToiStatus: APART where the distance is more than 0, OVERLAPPING, or INVALID with NaN throughout.
        ``distance`` : [length] > 0 apart, 0 touching, < 0 the least penetration.
        ``normal`` : (3,) unit, from a to b.
        ``point_a``, ``point_b`` : (3,) [length] closest or deepest points; point_b - point_a = distance * normal.

    Raises
    ------
    TypeError, ValueError
        As `contact`.

    Notes
    -----
    The bits are those of C++'s ``separation(a, b)``. Source: docs/pairs.md.
    """
    for argument, shape in (("a", a), ("b", b)):
        _check_shape("separation", argument, shape, _STILL)
    return _ask("separation", a, b, threads, out)


def manifold(a, b, *, threads=1, out=None):
    """All points of contact of each row: up to four where a face meets a face or an edge.

    Parameters
    ----------
    a, b, threads, out
        As of `contact`.

    Returns
    -------
    structured array, (N,)
        ``status`` : ToiStatus: APART, OVERLAPPING or INVALID.
        ``count`` : 0 to 4, the points of contact.
        ``contacts`` : (4,) of the fields of `contact` but the status; the first `count` are points, the deepest first. Their
        ``local_a`` and ``local_b`` are points of the surfaces, of an Aabb too.

    Raises
    ------
    TypeError, ValueError
        As `contact`.

    Notes
    -----
    The bits are those of C++'s ``manifold(a, b)``. Source: docs/pairs.md.
    """
    for argument, shape in (("a", a), ("b", b)):
        _check_shape("manifold", argument, shape, _STILL)
    return _ask("manifold", a, b, threads, out)


def raycast(ray, shape, *, threads=1, out=None):
    """Where rays first meet shapes.

    Parameters
    ----------
    ray : Ray
        Of N rows, or one.
    shape : Sphere, Aabb, Obb, Triangle or Capsule
        Of N rows, or one.
    threads, out
        As of `contact`.

    Returns
    -------
    structured array, (N,)
        ``status`` : ToiStatus: HIT, APART (with t = max_t), OVERLAPPING (a start inside or touching, with t = 0) or INVALID.
        ``t`` : [1] in [0, max_t], in lengths of the ray's direction.
        ``normal`` : (3,) unit, outward; zero if the ray starts inside.
        ``point`` : (3,) [length] on the surface; the origin if the ray starts inside.

    Raises
    ------
    TypeError, ValueError
        As `contact`.

    Notes
    -----
    The bits are those of C++'s ``raycast(ray, shape)``; which Aabb a ray misses the vectors of thinwall::batch say. Error: a few u * kappa
    * t. Source: docs/closed_forms.md.
    """
    _check_shape("raycast", "ray", ray, (Ray,))
    _check_shape("raycast", "shape", shape, _STILL)
    return _ask("raycast", ray, shape, threads, out)


# What options of methods are, and which values they take: the type, the check, and how it is said.
_OPTIONS = {
    "tolerance": (float, lambda x, epsilon: epsilon <= x <= 1, "[1] a number from epsilon, {epsilon:.3g}, to 1"),
    "margin": (float, lambda x, epsilon: 0 <= x < math.inf, "[1] a finite number of at least 0"),
    "min_separation": (float, lambda x, epsilon: 0 <= x < math.inf, "[length] a finite number of at least 0"),
    "n": (int, lambda x, epsilon: 1 <= x < 2**31, "[1] a whole number of at least 1"),
    "max_evaluations": (int, lambda x, epsilon: 1 <= x < 2**31, "[1] a whole number of at least 1"),
}


def _options(query, method, known, options, dtype):
    chosen = _queries.Options()
    for name, value in options.items():
        if name not in known:
            near = _near(name.lower(), known)
            meant = f"; did you mean {near[0]!r}? It" if near else "; it"
            raise TypeError(f"{query}: {method!r} has no option {name!r}{meant} has {', '.join(known)}")
        kind, allows, words = _OPTIONS[name]
        epsilon = float(np.finfo(dtype).eps)
        words = words.format(epsilon=epsilon)
        kinds = (int, np.integer) if kind is int else (int, float, np.integer, np.floating)
        if not isinstance(value, kinds) or isinstance(value, bool):
            raise TypeError(f"{query}: {name} is {type(value).__name__} {value!r:.60}; allowed is {words}")
        value = int(value) if kind is int else _as_float(value)
        with np.errstate(over="ignore"):
            as_held = value if kind is int else float(dtype.type(value))
        if not allows(as_held, epsilon):
            raise ValueError(f"{query}: {name} is {value!r}; allowed is {words}")
        setattr(chosen, name, value)
    return chosen


def methods(*, turning=False):
    """The methods of finding a time of impact, and the names of their options.

    Parameters
    ----------
    turning : bool, optional
        Those for shapes that turn.

    Returns
    -------
    dict of str to list of str
    """
    return {name: list(options) for name, options in (_queries.turning_methods() if turning else _queries.methods())}


def time_of_impact(a, b, method=None, *, threads=1, vectors=True, out=None, **options):
    """When moving shapes first touch during the step.

    Parameters
    ----------
    a, b : Moving or Turning
        Of N rows, or of one. Where one turns, the other may, too.
    method : str, optional
        "closed_form", exact to rounding, if neither turns, else "conservative_advancement". `methods()` names them all, docs/methods.md says
        what each claims and where it fails.
    threads : int, optional
        >= 1; more than the machine has are as many as it has. The answers are the same bits for any number.
    vectors : bool, optional
        False leaves out the normal and the point, and is quicker by the closed form.
    out : array, optional
        Where the answers go: an array that an earlier call returned, of as many rows.
    **options
        Of the method, by name:

        tolerance : [1] from epsilon to 1: how late a hit may be, in steps (bisection); a gap this fraction of the relative displacement is a
            hit (conservative_advancement); how short an interval of the step is a hit (inclusion). 2^-26, of float32 2^-12, if left out.
        max_evaluations : [1] >= 1 separations (conservative_advancement: 64, inclusion: 1024); then the row is GAVE_UP.
        n : [1] >= 1 poses a step (substeps: 4).
        margin : [1] >= 0: how far to look, in relative displacements (speculative: 1).
        min_separation : [length] >= 0: a gap this small counts as contact (every method: 0).

    Returns
    -------
    structured array, (N,)
        ``status`` : ToiStatus.
        ``evaluations`` : of the pair's separation, overlap or closed form: the machine-independent cost. 1 in rows that a kernel of
            thinwall::batch found apart, which counts none.
        ``time`` : [1] fraction of the step in [0, 1]; 1 if APART, 0 if OVERLAPPING, NaN if INVALID.
        ``normal`` : (3,) unit, from a to b; zero if APART.
        ``point`` : (3,) [length] where they touch, in world space; zero if APART.

    Raises
    ------
    TypeError
        For what does not move, where one holds float32 and the other float64, or for an option that the method has not or of another type.
    ValueError
        For an unknown method, an option out of its range, other numbers of rows, threads below 1, an `out` that does not fit, or a pair
        that the method does not serve.

    Notes
    -----
    The bits are those of C++'s ``time_of_impact(method, a, b)``. Without vectors the closed form of the pairs of thinwall::batch (a sphere
    with a sphere, Aabb, Obb or Capsule; two Aabb) has the batch's times, within 4 u kappa t of those. Source: docs/closed_forms.md,
    docs/batches.md, docs/turning.md.
    """
    query = "time_of_impact"
    for argument, shape in (("a", a), ("b", b)):
        _check_shape(query, argument, shape, _IN_MOTION)
    turning = isinstance(a, Turning) or isinstance(b, Turning)
    known = methods(turning=turning)
    if method is None:
        method = "conservative_advancement" if turning else "closed_form"
    if not isinstance(method, str) or method not in known:
        what = "the method, where a shape turns," if turning else "the method"
        raise ValueError(f"{query}: " + _nearest(method, list(known), what))
    chosen = _options(query, method, known[method], options, a.dtype)
    if not isinstance(vectors, (bool, np.bool_)):
        raise TypeError(f"{query}: vectors is {type(vectors).__name__} {vectors!r:.60}; allowed is True or False")
    if vectors:
        return _ask(query, a, b, threads, out, None, method, chosen)
    return _ask(query, a, b, threads, out, "time", method, chosen)


def certified_time_of_impact(a, b, *, threads=1, out=None):
    """When moving shapes first touch, proven: which of hit, miss and overlap it is, and two numbers that enclose the first contact.

    Parameters
    ----------
    a, b : Moving or Turning
        Of float64. Of N rows, or of one.
    threads, out
        As of `time_of_impact`.

    Returns
    -------
    structured array, (N,)
        ``status`` : ToiStatus, proven. GAVE_UP only where a shape turns: the proof does not close, and the bracket holds.
        ``lower``, ``upper`` : [1] no contact before `lower`; contact by `upper` if HIT. Both 1 if APART, both 0 if OVERLAPPING.
        ``decided_by`` : DecidedBy, the stage that decided.

    Raises
    ------
    TypeError, ValueError
        As `time_of_impact`; and for shapes of float32, for which nothing is proven.

    Notes
    -----
    The bits are those of C++'s ``certified_time_of_impact(a, b)``. Source: docs/certified.md.
    """
    query = "certified_time_of_impact"
    for argument, shape in (("a", a), ("b", b)):
        _check_shape(query, argument, shape, _IN_MOTION)
        if shape.dtype != np.float64:
            raise TypeError(f"{query}: {argument} holds {shape.dtype}; allowed is float64, for whose numbers alone it is proven")
    return _ask(query, a, b, threads, out)


def _corners(argument, value):
    if not isinstance(value, np.ndarray):
        raise TypeError(f"find_pairs: {argument} is {type(value).__name__}; allowed is an array")
    if isinstance(value, np.ma.MaskedArray):
        raise TypeError(f"find_pairs: {argument} is a masked array; allowed is one without a mask")
    if value.dtype not in (np.float64, np.float32):
        raise TypeError(f"find_pairs: {argument} is an array of {value.dtype}; allowed is float64 or float32")
    if value.ndim != 2 or value.shape[1] != 3:
        raise ValueError(f"find_pairs: {argument} has shape {value.shape}; allowed is shape (N, 3)")
    return value


def _per_body(argument, value, rows, dtype):
    if value is None:
        return None
    masked = isinstance(value, np.ma.MaskedArray)
    if masked or not isinstance(value, np.ndarray) or value.dtype != dtype:
        got = "a masked array" if masked else f"an array of {value.dtype}" if isinstance(value, np.ndarray) else type(value).__name__
        raise TypeError(f"find_pairs: {argument} is {got}; allowed is an array of {np.dtype(dtype)}")
    if value.shape != (rows,):
        raise ValueError(f"find_pairs: {argument} has shape {value.shape}; allowed is shape ({rows},), a number a box")
    return value


def find_pairs(lower, upper, method="uniform_grid", *, group=None, mask=None, static=None, max_pairs=None):
    """The pairs of boxes that share a point, touching included: those that a narrow query need be asked about.

    Parameters
    ----------
    lower, upper : array, (N, 3)
        [length] least and greatest corners, float64 or float32; both may be infinite. Of what moves: of all that it sweeps.
    method : str, optional
        "uniform_grid", "sort_and_sweep", "r_tree", "all_pairs" or "all_ordered_pairs": all find the same pairs in the same order.
    group, mask : array of uint32, (N,), optional
        Bits a body belongs to (1 if left out) and may meet (all): a pair needs both directions.
    static : array of bool, (N,), optional
        Two static bodies are never a pair.
    max_pairs : int, optional
        More are an error, found with memory bounded by that number.

    Returns
    -------
    array of int64, (M, 2)
        Indices, first < second, sorted by (first, second): the library's order. ``a[pairs[:, 0]]`` and ``b[pairs[:, 1]]`` are what to ask
        next, and row k of the answer belongs to pairs[k].

    Raises
    ------
    TypeError
        For what is no array of such numbers, or is masked, and where one holds float32 and the other float64.
    ValueError
        For other shapes, an unknown method, or a box that is NaN or has lower > upper, by its index.
    RuntimeError
        For more than max_pairs pairs.

    Notes
    -----
    Source: docs/broad_phase.md.
    """
    lower, upper = _corners("lower", lower), _corners("upper", upper)
    if lower.dtype != upper.dtype:
        raise TypeError(f"find_pairs: upper is an array of {upper.dtype}; allowed is {lower.dtype}, as lower is")
    if lower.shape != upper.shape:
        raise ValueError(f"find_pairs: upper has {len(upper)} rows; allowed is {len(lower)}, as lower has")
    known = _queries.broad_phases()
    if method not in known:
        raise ValueError("find_pairs: " + _nearest(method, known, "the method"))
    if max_pairs is not None:
        if isinstance(max_pairs, bool) or not isinstance(max_pairs, (int, np.integer)) or not 0 <= max_pairs < 2**63:
            raise ValueError(f"find_pairs: max_pairs is {max_pairs!r}; allowed is None or a whole number of at least 0")
        max_pairs = int(max_pairs)
    rows = len(lower)
    group, mask = _per_body("group", group, rows, np.uint32), _per_body("mask", mask, rows, np.uint32)
    static = _per_body("static", static, rows, np.bool_)
    try:
        return _queries.find_pairs(method, lower, upper, group, mask, static, max_pairs)
    except ValueError as error:  # the row's fault, by its index
        fault = str(error).replace("proxy", "row")
        raise ValueError(f"find_pairs: lower and upper, {fault}; allowed is lower <= upper in every row") from None
