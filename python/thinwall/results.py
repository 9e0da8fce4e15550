"""Result folders, read back: tables, answer, figures and citation of a run, by whom and whenever it was computed."""

from __future__ import annotations

import csv
import difflib
import hashlib
import io
import json
import os
import textwrap
from pathlib import Path, PurePosixPath
from typing import Any, Callable, Iterator

from .tables import Column, Rows, Value, as_array, as_frame

_JOURNAL, _MANIFEST, _PACKAGE, _SEAL = "journal.tsv", "manifest.json", "datapackage.json", "shard.json"
_NEEDED: dict[str, type | tuple[type, ...]] = {
    "experiment": str,
    "question": str,
    "answer": str,
    "self_test_passed": bool,
    "config": dict,
    "seed": int,
    "run_id": str,
    "files": dict,
}


def read(folder: str | os.PathLike[str]) -> Result:
    """Reads a result folder, as ``thinwall run`` and `thinwall.run` leave it.

    Files are read when they are asked for, and held against the SHA-256 that the manifest states.

    Parameters
    ----------
    folder : str or path
        The folder that holds ``manifest.json``.

    Returns
    -------
    Result

    Raises
    ------
    FileNotFoundError
        There is no such folder.
    ValueError
        It is not a folder, holds no result, an unfinished one, a shard of one, or a damaged one; the message says which, and names
        the file.

    Examples
    --------
    >>> result = tw.read("results/mine")                      # doctest: +SKIP
    >>> result["methods"][["method", "tunneled", "worst_residual"]]    # doctest: +SKIP
    """
    return Result(folder)


class Result:
    """What a run left: see `read`.

    ``result["cells"]`` is a table: a pandas ``DataFrame``, or a NumPy structured array where pandas is not installed. Its ``attrs``
    hold ``name``, ``description``, and by column ``units`` and ``descriptions``.

    Attributes
    ----------
    folder : pathlib.Path
    experiment, question, answer : str
        The answer stands in a sentence or two, with its numbers.
    self_test_passed : bool
        If not, do not trust the numbers.
    config : dict
        The whole configuration, defaults included.
    seed : int
    run_id : str
        A hash of experiment, configuration, seed and trials.
    tables : tuple of str
        What ``result[name]`` knows.
    figures : dict of str to pathlib.Path
        The SVG files.
    bibtex : str
        Entries that cite the software and this result.
    report : pathlib.Path
        One page of HTML with all of it.
    manifest : dict
        ``manifest.json``: where the result came from, and what belongs to it.
    """

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        self.folder = Path(folder)
        _require_finished(self.folder)
        self.manifest: dict[str, Any] = _manifest(self.folder / _MANIFEST)
        self._hashes: dict[str, str] = self.manifest["files"]
        self._times: list[str] = self.manifest.get("files_of_times", [])
        for name in (*self._hashes, *self._times):
            if not (self.folder / name).is_file():
                raise ValueError(f"{self.folder / name}: is missing, though {_MANIFEST} lists it; the result is damaged")
        self._tables = _package(self.folder / _PACKAGE, self._bytes(_PACKAGE))

    @property
    def experiment(self) -> str:
        return str(self.manifest["experiment"])

    @property
    def question(self) -> str:
        return str(self.manifest["question"])

    @property
    def answer(self) -> str:
        return str(self.manifest["answer"])

    @property
    def self_test_passed(self) -> bool:
        return bool(self.manifest["self_test_passed"])

    @property
    def config(self) -> dict[str, Any]:
        return dict(self.manifest["config"])

    @property
    def seed(self) -> int:
        return int(self.manifest["seed"])

    @property
    def run_id(self) -> str:
        return str(self.manifest["run_id"])

    @property
    def tables(self) -> tuple[str, ...]:
        return tuple(self._tables)

    @property
    def figures(self) -> dict[str, Path]:
        names = [PurePosixPath(name) for name in (*self._hashes, *self._times)]
        return {name.stem: self.folder / name for name in names if name.parent.name == "plots" and name.suffix == ".svg"}

    @property
    def bibtex(self) -> str:
        return self._bytes("cite.bib").decode()

    @property
    def report(self) -> Path:
        return self.folder / "report.html"

    def __getitem__(self, name: str) -> Any:
        """The table of this name, read anew: it is the caller's to change."""
        return as_frame(*self._table(name))

    def array(self, name: str) -> Rows:
        """The table of this name as a structured array, with pandas or without."""
        return as_array(*self._table(name))

    def __contains__(self, name: object) -> bool:
        return name in self._tables

    def __iter__(self) -> Iterator[str]:
        return iter(self._tables)

    def __len__(self) -> int:
        return len(self._tables)

    def __repr__(self) -> str:
        lines = [f"thinwall result {self.run_id} of {self.experiment}, in {self.folder}", self.question, self.answer]
        if not self.self_test_passed:
            lines.append("The self-test failed: do not trust these numbers.")
        lines += ["tables: " + ", ".join(self._tables), "figures: " + ", ".join(self.figures)]
        return "\n".join(textwrap.fill(line, 100, subsequent_indent="  ") for line in lines)

    def _table(self, name: str) -> tuple[str, str, list[Column], dict[str, list[Value]]]:
        if name not in self._tables:
            near = difflib.get_close_matches(str(name), self._tables, 1)
            hint = f"did you mean {near[0]!r}? " if near else ""
            raise KeyError(f"{name!r}: no such table; {hint}(there are: {', '.join(self._tables)})")
        table = self._tables[name]
        file = str(table["path"])
        columns = [
            Column(field["name"], field["type"], field.get("unit", ""), field.get("description", ""))
            for field in table["schema"]["fields"]
        ]
        values = _values(self.folder / file, self._bytes(file), columns)
        return name, table.get("description", ""), columns, values

    def _bytes(self, name: str) -> bytes:
        expected = self._hashes.get(name)
        if expected is None and name not in self._times:
            raise ValueError(f"{self.folder / name}: is not listed in {_MANIFEST}; the result is damaged")
        data = (self.folder / name).read_bytes()
        if expected is not None and hashlib.sha256(data).hexdigest() != expected:
            raise ValueError(f"{self.folder / name}: was changed since the run wrote it: its SHA-256 is not the manifest's")
        return data


def _require_finished(folder: Path) -> None:
    if not folder.exists():
        raise FileNotFoundError(f"{folder}: there is no such folder; name the folder of a result")
    if not folder.is_dir():
        raise ValueError(f"{folder}: is not a folder; name the folder of a result")
    if (folder / _MANIFEST).is_file():
        return
    if (folder / _SEAL).exists():
        raise ValueError(f"{folder}: is a shard of a run; thinwall merge makes a result of all of them")
    if (folder / _JOURNAL).exists():
        raise ValueError(f"{folder}: holds a run that is not finished: no {_MANIFEST} yet; the same run continues it")
    raise ValueError(f"{folder}: holds no {_MANIFEST}; name the folder of a result, as thinwall.run leaves it")


def _json(file: Path, data: bytes) -> dict[str, Any]:
    try:
        value = json.loads(data)
    except (ValueError, RecursionError) as error:
        raise ValueError(f"{file}: is not JSON ({error}); the result is damaged") from None
    if not isinstance(value, dict):
        raise ValueError(f"{file}: holds no JSON object; the result is damaged")
    return value


def _manifest(file: Path) -> dict[str, Any]:
    manifest = _json(file, file.read_bytes())
    if manifest.get("thinwall_manifest") != 1:
        found = manifest.get("thinwall_manifest")
        raise ValueError(f"{file}: key 'thinwall_manifest': {found!r} is not allowed; 1, of a manifest as thinwall writes it")
    for key, kind in _NEEDED.items():
        if not isinstance(manifest.get(key), kind):
            raise ValueError(f"{file}: key '{key}': missing, or of a wrong type; the result is damaged")
    times = manifest.get("files_of_times", [])
    names = [*manifest["files"], *(times if isinstance(times, list) else [None])]
    for name in names:
        if not isinstance(name, str) or not _stays_within(name):
            raise ValueError(f"{file}: names {name!r}, which is no path within the folder; the result is damaged")
    return manifest


def _stays_within(name: str) -> bool:
    path = PurePosixPath(name)
    return bool(path.parts) and not path.is_absolute() and ".." not in path.parts and "\0" not in name


def _package(file: Path, data: bytes) -> dict[str, dict[str, Any]]:
    try:
        found = {}
        for resource in _json(file, data)["resources"]:
            for field in resource["schema"]["fields"]:
                _READERS[field["type"]], field["name"] + ""
            resource["path"] + ""
            found[resource["name"] + ""] = resource
        return found
    except (KeyError, TypeError) as error:
        raise ValueError(f"{file}: describes no tables as thinwall does ({error!r}); the result is damaged") from None


def _text(text: str) -> str:
    return text[1:] if text.startswith("'") else text  # it keeps a spreadsheet from computing what follows


def _boolean(text: str) -> bool:
    return {"true": True, "false": False}[text]


def _integer(text: str) -> int:
    number = int(text)
    if not -(2**63) <= number < 2**63:
        raise ValueError(text)
    return number


_READERS: dict[str, Callable[[str], Value]] = {
    "string": _text,
    "integer": _integer,
    "number": float,
    "boolean": _boolean,
}


def _values(file: Path, data: bytes, columns: list[Column]) -> dict[str, list[Value]]:
    try:
        header, *rows = csv.reader(io.StringIO(data.decode(), newline=""), strict=True)
    except (ValueError, csv.Error) as error:
        raise ValueError(f"{file}: is no table ({error}); the result is damaged") from None
    names = [column.name for column in columns]
    if header != names:
        raise ValueError(f"{file}: has the columns {', '.join(header)}, not {', '.join(names)}; the result is damaged")
    values: dict[str, list[Value]] = {name: [] for name in names}
    for number, row in enumerate(rows, 1):
        if len(row) != len(columns):
            raise ValueError(f"{file}: row {number} has {len(row)} fields, not {len(columns)}; the result is damaged")
        for column, text in zip(columns, row):
            try:
                value = None if text == "" and column.type != "string" else _READERS[column.type](text)
            except (ValueError, KeyError):
                raise ValueError(
                    f"{file}: row {number}, column '{column.name}': {text!r} is not of the type {column.type}; the result is damaged"
                ) from None
            values[column.name].append(value)
    return values
