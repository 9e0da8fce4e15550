"""What docs/python.md and README.md show of the queries runs, and so does the example."""

import os
import pathlib
import re
import subprocess
import sys

import pytest

SOURCE = pathlib.Path(os.environ["THINWALL_SOURCE"])


def blocks(page, section):
    text = (SOURCE / page).read_text()
    part = re.search(rf"^## {section}\n(.*?)(?=^## |\Z)", text, re.M | re.S).group(1)
    return re.findall(r"^```python\n(.*?)^```", part, re.M | re.S)


@pytest.mark.parametrize("page, section, count", [("docs/python.md", "Queries on arrays", 2), ("README.md", "From Python", 1)])
def test_blocks_run_one_after_the_other(page, section, count, capsys):
    names = {}
    found = blocks(page, section)
    assert len(found) >= count
    for block in found:
        exec(compile(block, page, "exec"), names)
    assert 0 < float(capsys.readouterr().out.split()[0]) < 1  # the share that hits


def test_the_docstring_of_the_package():
    command = "import doctest, sys, thinwall; sys.exit(doctest.testmod(thinwall).failed or not doctest.testmod(thinwall).attempted)"
    subprocess.run([sys.executable, "-c", command], check=True)


def test_benchmark_my_arrays(tmp_path):
    pytest.importorskip("matplotlib", reason="matplotlib is not installed (Debian: python3-matplotlib)")
    picture = tmp_path / "picture.png"
    command = [sys.executable, SOURCE / "python/examples/benchmark_my_arrays.py", "--rows", "20000", "--out", picture]
    text = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    missed = {line[:26].strip(): float(re.search(r"misses +([\d.]+) %", line).group(1)) for line in text.splitlines() if "misses" in line}
    assert missed["swept, closed form"] == 0 and missed["conservative advancement"] == 0
    assert missed["discrete, at the end"] > missed["discrete, 4 substeps"] > missed["discrete, 32 substeps"] > 5
    assert picture.read_bytes().startswith(b"\x89PNG")
