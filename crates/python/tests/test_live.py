"""The widget in which a system is changed: what its page asks, and what becomes of the file."""

import json

import funicular as fn
import pytest

LAMP = """gravity_m_s2 = 10
joints = { A = { at_m = [-3, 0, 0] }, B = { at_m = [3, 0, 0] }, P = { mass_kg = 10 } }
bars = [{ from = "A", to = "P", length_m = 5, mass_kg = 0 }, { from = "B", to = "P", length_m = 5, mass_kg = 0 }]
"""


@pytest.fixture
def asked(monkeypatch):
    pytest.importorskip("anywidget")
    widget = fn.live(LAMP)
    sent = []
    monkeypatch.setattr(widget, "send", sent.append)

    def ask(path, **question):
        widget._handle_custom_msg({"funicular": 7, "path": path, "question": question}, [])
        (answer,) = sent
        sent.clear()
        assert answer["funicular"] == 7
        return answer

    return widget, ask


def test_the_page_is_answered(asked):
    widget, ask = asked
    assert '"embedded":true' in widget.page and 'id="file"' in widget.page
    begun = widget.page
    answer = json.loads(ask("ask", text=LAMP, change={"joint": {"name": "P", "mass_kg": 20}})["text"])
    # 3-4-5: 5/8 of 200 N.
    assert answer["data"]["shapes"][0]["axial"] == pytest.approx([125, 125])
    # The file follows the page, and the page is not begun again.
    assert "mass_kg = 20" in widget.text and widget.page == begun
    assert widget.system.solve().axial_n == pytest.approx([125, 125])
    # A hand that moves leaves the file alone.
    moved = json.loads(ask("ask", text=LAMP, quick=True, change={"joint": {"name": "A", "at_m": [-1, 0, 0]}})["text"])
    assert "-1.0" in moved["text"] and "-1.0" not in widget.text
    assert ask("page", text=LAMP)["text"].startswith("<!DOCTYPE html>")


def test_another_file_begins_again(asked):
    widget, _ = asked
    widget.text = LAMP.replace("10 }", "30 }")
    assert "mass_kg = 30" in widget.page


def test_what_is_wrong_is_answered(asked):
    _, ask = asked
    assert "TOML" in json.loads(ask("ask", text="x =", change={"joint": {"name": "A"}})["text"])["error"]
    assert "unknown field" in ask("ask", text=LAMP, file="/etc/passwd")["error"]
    assert "no page" in ask("elsewhere", text=LAMP)["error"]
    with pytest.raises(ValueError):
        fn._native.live_answer("ask", "{")
