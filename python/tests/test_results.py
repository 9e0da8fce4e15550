"""Reading a result folder: against its own CSV, and damaged in every way that a folder can be."""

from __future__ import annotations

import copy
import csv
import hashlib
import json
import math
import pickle
import shutil
import sys
from pathlib import Path
from typing import Any, Callable

import numpy as np
import pytest

import thinwall as tw
from thinwall import tables
from lab_support import small


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return small(tmp_path_factory.mktemp("results") / "small").folder


@pytest.fixture
def copied(folder: Path, tmp_path: Path) -> Path:
    return Path(shutil.copytree(folder, tmp_path / "copy"))


def test_says_what_the_manifest_says(folder: Path) -> None:
    result, manifest = tw.read(folder), json.loads((folder / "manifest.json").read_bytes())
    assert result.answer == manifest["answer"] and result.question == manifest["question"]
    assert result.experiment == "thin_wall" and result.seed == 1 and result.self_test_passed is True
    assert result.config["speed"] == [10, 40]
    assert result.manifest == manifest
    assert manifest["program"]["version"] == tw.__version__
    assert result.bibtex == (folder / "cite.bib").read_text() and "@misc{thinwall_thin_wall_" in result.bibtex
    assert {path.name for path in result.figures.values()} == {path.name for path in (folder / "plots").glob("*.svg")}
    assert all(path.is_file() for path in (*result.figures.values(), result.report))
    assert set(result.tables) == {path.stem for path in (folder / "data").glob("*.csv")} == set(result)


def test_every_table_is_its_csv(folder: Path) -> None:
    result = tw.read(folder)
    package = json.loads((folder / "datapackage.json").read_bytes())
    for resource in package["resources"]:
        with (folder / resource["path"]).open(newline="") as file:
            rows = list(csv.DictReader(file))
        frame, array = result[resource["name"]], result.array(resource["name"])
        assert len(frame) == len(array) == len(rows) == len(array[array.dtype.names[0]])
        for field in resource["schema"]["fields"]:
            name = field["name"]
            assert frame.attrs["units"][name] == array.attrs["units"][name] == field.get("unit", "")
            assert frame.attrs["descriptions"][name] == field["description"]
            for row, of_frame, of_array in zip(rows, frame[name], array[name]):
                text = row[name]
                if text == "":
                    assert of_array == "" or math.isnan(of_array)
                elif field["type"] in ("number", "integer"):
                    assert float(text) == of_frame == of_array
                else:
                    assert text.lstrip("'") == (of_frame if field["type"] == "string" else str(of_frame).lower())


def test_types_and_attributes(folder: Path) -> None:
    pandas = pytest.importorskip("pandas")
    cells = tw.read(folder)["cells"]
    assert isinstance(cells, pandas.DataFrame)
    assert cells["speed"].dtype == np.float64 and cells["tunneled"].dtype == np.int64
    assert cells.attrs["units"]["speed"] == "m/s" and cells.attrs["name"] == "cells"
    cells["speed"] = 0  # the caller's own
    assert tw.read(folder)["cells"]["speed"].min() > 0


def test_without_pandas(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pandas", None)
    cells = tw.read(folder)["cells"]
    assert isinstance(cells, tables.Rows) and cells.dtype["speed"] == np.float64
    assert cells["tunneled"].dtype == np.int64 and set(cells["method"]) == {"end_of_step", "closed_form"}
    for same in (copy.deepcopy(cells), pickle.loads(pickle.dumps(cells)), cells[:]):
        assert same.attrs == cells.attrs and same.attrs["units"]["speed"] == "m/s"
        assert repr(same.tolist()) == repr(cells.tolist())


def test_missing_values() -> None:
    columns = [tables.Column(kind, kind, "1", "") for kind in ("integer", "number", "boolean", "string")]
    values = {"integer": [1, None], "number": [None, 0.5], "boolean": [None, True], "string": ["a", None]}
    array = tables.as_array("t", "", columns, values)
    assert array["integer"][0] == 1 and np.isnan(array["integer"][1]) and np.isnan(array["number"][0])
    assert array["boolean"].tolist() == [None, True] and array["string"].tolist() == ["a", ""]
    pandas = pytest.importorskip("pandas")
    frame = tables.as_frame("t", "", columns, values)
    assert frame["integer"].tolist() == [1, pandas.NA] and frame["boolean"].tolist() == [pandas.NA, True]
    empty = tables.as_array("t", "", columns, {kind: [] for kind in values})
    assert len(empty) == 0 and empty.dtype.names == tuple(values)


def test_repr_reads_well(folder: Path) -> None:
    text = repr(tw.read(folder))
    assert "thin_wall" in text and "cells" in text and "probability" in text and tw.read(folder).question[:20] in text
    assert max(map(len, text.splitlines())) <= 100


def test_unknown_table_names_the_nearest(folder: Path) -> None:
    with pytest.raises(KeyError, match="did you mean 'cells'.*methods"):
        tw.read(folder)["cels"]


def edit(file: Path, change: Callable[[Any], None]) -> None:
    data = json.loads(file.read_bytes())
    change(data)
    file.write_text(json.dumps(data))


def rehashed(folder: Path, name: str, text: str) -> None:
    """As somebody would who changes a file and its hash."""
    (folder / name).write_text(text)
    edit(folder / "manifest.json", lambda m: m["files"].update({name: hashlib.sha256(text.encode()).hexdigest()}))


def test_there_is_no_result(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match="nowhere: there is no such folder"):
        tw.read(tmp_path / "nowhere")
    with pytest.raises(ValueError, match="holds no manifest.json"):
        tw.read(tmp_path)
    (tmp_path / "file").write_text("")
    with pytest.raises(ValueError, match="file: is not a folder"):
        tw.read(tmp_path / "file")
    (tmp_path / "journal.tsv").write_text("")
    with pytest.raises(ValueError, match="not finished"):
        tw.read(tmp_path)
    (tmp_path / "shard.json").write_text("{}")
    with pytest.raises(ValueError, match="is a shard"):
        tw.read(tmp_path)


@pytest.mark.parametrize(
    "text",
    ["", "{", "[]", "{}", '{"thinwall_manifest": 2}', '{"thinwall_manifest": 1}', "\0\xff", pytest.param("[" * 100_000, id="deep")],
)
def test_a_manifest_that_is_none(copied: Path, text: str) -> None:
    (copied / "manifest.json").write_bytes(text.encode("latin-1"))
    with pytest.raises(ValueError, match="manifest.json: "):
        tw.read(copied)


@pytest.mark.parametrize("name", ["../outside", "/etc/passwd", "", "data/../../x"])
def test_a_manifest_that_leads_out(copied: Path, name: str) -> None:
    edit(copied / "manifest.json", lambda m: m["files"].update({name: "00"}))
    with pytest.raises(ValueError, match="no path within the folder"):
        tw.read(copied)


def test_a_file_that_is_missing_or_changed(copied: Path) -> None:
    cells = copied / "data/cells.csv"
    cells.write_text(cells.read_text().replace("10,", "11,"))
    result = tw.read(copied)
    with pytest.raises(ValueError, match="cells.csv: was changed since"):
        result["cells"]
    (copied / "cite.bib").write_text("")
    with pytest.raises(ValueError, match="cite.bib: was changed since"):
        result.bibtex
    cells.unlink()
    with pytest.raises(ValueError, match="cells.csv: is missing"):
        tw.read(copied)


@pytest.mark.parametrize(
    "change, said",
    [
        (lambda t: t.replace("speed", "sped", 1), "has the columns"),
        (lambda t: t + "1,2\n", "row .* has 2 fields"),
        (lambda t: t.replace("double", '"double', 1), "is no table"),
        (lambda t: "", "is no table"),
        (lambda t: t.replace(",200,", ",2oo,", 1), "'2oo' is not of the type integer"),
        (lambda t: t.replace(",200,", f",{2**63},", 1), "is not of the type integer"),
    ],
)
def test_a_table_that_is_damaged(copied: Path, change: Callable[[str], str], said: str) -> None:
    before = (copied / "data/cells.csv").read_text()
    assert change(before) != before
    rehashed(copied, "data/cells.csv", change(before))
    with pytest.raises(ValueError, match=f"cells.csv: .*{said}.*the result is damaged"):
        tw.read(copied)["cells"]


@pytest.mark.parametrize("text", ["{}", '{"resources": [{}]}', '{"resources": 1}', '{"resources": [{"name": 1, "path": "a", "schema": {"fields": []}}]}'])
def test_a_package_that_is_damaged(copied: Path, text: str) -> None:
    rehashed(copied, "datapackage.json", text)
    with pytest.raises(ValueError, match="datapackage.json: .*damaged"):
        tw.read(copied)


def test_a_text_that_a_spreadsheet_would_compute(copied: Path) -> None:
    text = (copied / "data/cells.csv").read_text().replace("end_of_step", "'=end")
    rehashed(copied, "data/cells.csv", text)
    assert "=end" in tw.read(copied).array("cells")["method"]
