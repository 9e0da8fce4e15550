"""Experiments, run in this process: their settings are keyword arguments, their result folder comes back as a `Result`."""

from __future__ import annotations

import json
import logging
import operator
import os
import re
import sys
import warnings
from pathlib import Path
from typing import Any, Callable, Mapping, SupportsIndex

import numpy as np

from . import _lab
from .results import Result, read

Progress = Callable[[int, int], object]

_log = logging.getLogger("thinwall")


def run(
    experiment: str | os.PathLike[str] | Mapping[str, Any],
    /,
    *,
    seed: int = 0,
    trials: int | None = None,
    threads: int | None = None,
    out: str | os.PathLike[str] | None = None,
    progress: Progress | None = None,
    **settings: Any,
) -> Result:
    """Runs an experiment, or a scene, and reads its result folder.

    The same as ``thinwall run``: the same checks of the settings, the same bytes for any number of threads, the same folder. Ctrl-C
    raises ``KeyboardInterrupt`` within a second and keeps what is finished; the same call then goes on. A unit that is too long to
    wait for ends in the background, and the call that goes on waits for it.

    Parameters
    ----------
    experiment : str, path or dict
        The name of an experiment (``thinwall list``), a TOML file, TOML text (a str of more than one line), or a dict of what a TOML
        file would hold.
    seed : int, default 0
        Chooses the random numbers; 0 to 2**64 - 1.
    trials : int, optional
        Overrides the number of trials in the settings, > 0; of a scene, its steps.
    threads : int, optional
        >= 1; every core if not given. Of no effect on the result.
    out : str or path, optional
        The result folder. Without it ``results/NAME-ID``, where ID is a hash of experiment, settings, seed and trials: the same call
        finds its result there and computes nothing. A folder that holds another run is refused.
    progress : callable, optional
        ``progress(done, total)``, in trials, called on this thread a few times a second while it computes. What it raises ends the
        run as Ctrl-C does.
    **settings
        What differs from the defaults of the experiment named: numbers, texts, booleans, lists of them, NumPy arrays of one dimension.
        ``thinwall.defaults(name)`` has every key, with its unit and range.

    Returns
    -------
    Result

    Raises
    ------
    ValueError
        An unknown experiment or key, with the nearest spelling; a value out of range; a folder that cannot be used. Nothing was
        written.
    TypeError
        A value that no setting can be.
    RuntimeError
        A unit failed, or the system did, as a full disk; what was finished is kept.

    Warns
    -----
    RuntimeWarning
        The self-test failed: do not trust the numbers.

    Examples
    --------
    >>> result = tw.run("thin_wall", speed=[10, 40], method=["end_of_step", "closed_form"], seed=1)    # doctest: +SKIP
    >>> result["methods"]                                                                              # doctest: +SKIP
    """
    target, text, is_own = _source(experiment, settings)
    return _run(target, text, is_own, False, seed, trials, threads, out, progress)


def defaults(experiment: str, /) -> str:
    """The default settings of an experiment: commented TOML, every key with its unit and range.

    Raises
    ------
    ValueError
        There is no such experiment.
    """
    _require_experiment(experiment)
    return _lab.default_toml(experiment)


def catalog() -> dict[str, str]:
    """Every experiment by name, with the question that it answers."""
    return dict(_lab.experiments())


def _run(
    target: str,
    text: str | None,
    is_own: bool,
    compare: bool,
    seed: int,
    trials: int | None,
    threads: int | None,
    out: str | os.PathLike[str] | None,
    progress: Progress | None,
) -> Result:
    if progress is not None and not callable(progress):
        raise TypeError(f"progress: {progress!r} is not allowed; a function of (done, total)")
    try:
        made, notes = _lab.run(
            target=target,
            text=text,
            compare=compare,
            seed=whole("seed", seed, 0, 2**64 - 1),
            trials=None if trials is None else whole("trials", trials, 1, 2**63 - 1),
            threads=None if threads is None else whole("threads", threads, 1, 4096),
            out="" if out is None else _folder(out),
            argv=[sys.executable, *sys.argv],
            progress=progress,
        )
    except ValueError as error:
        raise ValueError(said(error, target if is_own else None)) from None
    for note in notes.splitlines():
        _log.info("%s", note)
    result = read(made)
    if not result.self_test_passed:
        warnings.warn(f"{made}: the self-test failed: do not trust these numbers; the report says more", RuntimeWarning, stacklevel=3)
    return result


def _folder(out: str | os.PathLike[str]) -> str:
    folder = os.fspath(out) if isinstance(out, (str, os.PathLike)) else out
    if not isinstance(folder, str):
        raise TypeError(f"out: {out!r} is not allowed; a folder, as a str or a path")
    if not folder or "\0" in folder or any("\ud800" <= c <= "\udfff" for c in folder):
        raise ValueError(f"out: {folder!r} is not allowed; a folder, named by text that UTF-8 can hold and without a null")
    return folder


def _require_experiment(name: str) -> None:
    known = catalog()
    if name not in known:
        raise ValueError(f"experiment: {name!r} is unknown; {_lab.spelling_hint(name, list(known))}; or name a TOML file")


def _source(experiment: str | os.PathLike[str] | Mapping[str, Any], settings: Mapping[str, Any]) -> tuple[str, str | None, bool]:
    if isinstance(experiment, str) and not _is_text(experiment) and not _is_file(experiment):
        _require_experiment(experiment)
        return experiment, toml({"experiment": experiment, **settings}), True
    if settings:
        raise ValueError(f"{next(iter(settings))}: settings go with an experiment's name; a file, TOML text or a dict has its own")
    return source("experiment", experiment)


def source(argument: str, given: str | os.PathLike[str] | Mapping[str, Any]) -> tuple[str, str | None, bool]:
    """What the user named: a name for complaints, its TOML text unless that is a file's name, and whether we wrote the text."""
    if isinstance(given, Mapping):
        return argument, toml(given), True
    if isinstance(given, str) and _is_text(given):
        return argument, given, False
    if isinstance(given, (str, os.PathLike)):
        return str(os.fspath(given)), None, False
    raise TypeError(f"{argument}: a {type(given).__name__} is not allowed; a file, TOML text or a dict")


def _is_text(word: str) -> bool:
    return "\n" in word


def _is_file(word: str) -> bool:
    return word.endswith(".toml") or "/" in word or os.sep in word or Path(word).is_file()


def whole(argument: str, value: SupportsIndex, lower: int, upper: int) -> int:
    """`value` as an int in the range, or an error that names the argument."""
    allowed = f"a whole number from {lower} to {upper}"
    if isinstance(value, (bool, np.bool_)):
        raise TypeError(f"{argument}: {value!r} is not allowed; {allowed}")
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{argument}: {value!r} is not allowed; {allowed}") from None
    if not lower <= number <= upper:
        raise ValueError(f"{argument}: {number} is not allowed; {allowed}")
    return number


def said(error: ValueError, own: str | None) -> str:
    """The program's complaint in the words of Python: `out`, not `--out`; a key, not its line in a text that we wrote."""
    text = str(error)
    if own is not None:
        text = re.sub(rf"^{re.escape(own)}:\d+: key '([^']*)'", r"\1", text)
    return re.sub(r"(?<![\w-])--(\w+)", r"\1", text)


def toml(settings: Mapping[str, Any]) -> str:
    """TOML text of a dict. Raises TypeError or ValueError, naming the key, for what TOML cannot hold."""
    return "".join(f"{_key(key)} = {_value(_shown(key), value)}\n" for key, value in settings.items())


def _key(key: Any) -> str:
    if not isinstance(key, str):
        raise TypeError(f"{key!r}: is not allowed as a key; a str")
    return _string(_shown(key), key)


def _shown(key: Any) -> str:
    """A key in a complaint, which is one line."""
    return key if isinstance(key, str) and key.isprintable() and key else repr(key)


def _string(key: str, text: str) -> str:
    try:
        text.encode()
    except UnicodeEncodeError:
        raise ValueError(f"{key}: {text!r} is not allowed; text that UTF-8 can hold") from None
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def _value(key: str, value: Any) -> str:
    if isinstance(value, (np.generic, np.ndarray)) and value.dtype.kind in "biufU" and value.ndim <= 1:
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        if not -(2**63) <= value < 2**63:
            raise ValueError(f"{key}: {value} is not allowed; a whole number of 64 bits")
        return str(value)
    if isinstance(value, float):
        return repr(value)
    if isinstance(value, str):
        return _string(key, value)
    if isinstance(value, (list, tuple, range)):
        return "[" + ", ".join(_value(key, item) for item in value) + "]"
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{_key(inner)} = {_value(f'{key}.{_shown(inner)}', item)}" for inner, item in value.items()) + "}"
    what = f"an array of shape {value.shape} and type {value.dtype}" if isinstance(value, np.ndarray) else f"a {type(value).__name__}"
    raise TypeError(f"{key}: {what} is not allowed; a number, a text, a bool, a dict, or a list or array of them in one dimension")
