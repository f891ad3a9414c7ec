"""The pages of the guide and the README: what they show is run, and what they print comes out."""

import doctest
import math
import pkgutil
import re
from importlib import import_module
from pathlib import Path

import funicular
import pytest

TOP = Path(__file__).resolve().parents[1]
PAGES = [*sorted((TOP / "guide").glob("*.md")), TOP / "README.md"]
MODULES = ["funicular"] + [
    f"funicular.{m.name}" for m in pkgutil.iter_modules(funicular.__path__) if m.name != "_native"
]

FLAGS = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE | doctest.IGNORE_EXCEPTION_DETAIL


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_pages(page, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    code = "\n".join(re.findall(r"^```python\n(.*?)^```", page.read_text(), re.MULTILINE | re.DOTALL))
    test = doctest.DocTestParser().get_doctest(code, {}, page.name, str(page), 0)
    assert test.examples, "the page shows nothing"
    found = doctest.DocTestRunner(optionflags=FLAGS).run(test)
    assert found.failed == 0
    assert math.isfinite(found.attempted)


def test_three_lines_of_the_readme(capsys):
    """The README of the project shows the same lamp in TOML, in Rust and in Python."""
    code = re.findall(r"^```python\n(.*?)^```", (TOP.parents[1] / "README.md").read_text(), re.MULTILINE | re.DOTALL)
    assert len(code) == 1 and len(code[0].splitlines()) == 3
    names = {}
    exec(code[0], names)
    answer = names["a"]
    assert "optimal" in capsys.readouterr().out
    # As the README has them of the program.
    assert abs(answer.energy_j + 26.5889945211324) < 1e-12
    assert abs(answer.reactions_n[0] - (-8.09867, 0, 25.6669)).max() < 1e-4


@pytest.mark.parametrize("name", MODULES)
def test_docstrings(name):
    found = doctest.testmod(import_module(name), optionflags=FLAGS)
    assert found.failed == 0


def test_everything_public_is_documented():
    for name in funicular.__all__:
        thing = getattr(funicular, name)
        if callable(thing):
            assert thing.__doc__, name
            for attribute, member in vars(thing).items() if isinstance(thing, type) else ():
                if not attribute.startswith("_") and (callable(member) or isinstance(member, property)):
                    assert getattr(member, "__doc__", None), f"{name}.{attribute}"
