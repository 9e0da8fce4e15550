"""The example and the page do what they say."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

from lab_support import SOURCE

pytest.importorskip("matplotlib")
pytest.importorskip("pandas")


def test_how_often_does_it_tunnel(tmp_path: Path) -> None:
    script = SOURCE / "python/examples/how_often_does_it_tunnel.py"
    done = subprocess.run(
        [sys.executable, script, "--shots", "2000", "--out", tmp_path],
        capture_output=True, text=True, timeout=240,
    )
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    assert (tmp_path / "tunneling.png").read_bytes().startswith(b"\x89PNG")
    # By hand: 1 - 0.01 m / 5 m of the thinnest wall, and none through what is thicker than a step.
    assert "0.998" in done.stdout and re.search(r"closed_form.*\b0\b", done.stdout)


def blocks() -> list[str]:
    page = (SOURCE / "docs/python.md").read_text()
    page = re.sub(r"^## Queries on arrays\n.*?(?=^## )", "", page, flags=re.DOTALL | re.MULTILINE)  # test_page.py runs those
    return re.findall(r"^```python\n(.*?)^```", page, re.DOTALL | re.MULTILINE)


def test_the_page(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Every other Python block of docs/python.md, one after the other, as a reader would paste them."""
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {"__name__": "__main__"}
    assert len(blocks()) >= 7
    for block in blocks():
        exec(compile(block, "docs/python.md: " + block.splitlines()[0], "exec"), names)
    assert (tmp_path / "walls.png").is_file()
