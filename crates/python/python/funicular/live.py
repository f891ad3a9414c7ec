"""A system to change in a notebook: its file and its shape side by side."""

from __future__ import annotations

import json
from typing import Any

from . import _native
from .system import System

_SCRIPT = """
export default {
  render({ model, el }) {
    const frame = document.createElement("iframe");
    frame.sandbox = "allow-scripts allow-downloads allow-forms";
    frame.style = "width: 100%; border: 0; height: " + model.get("height") + "px";
    const asked = event => {
      if (event.source === frame.contentWindow && "funicular" in event.data) model.send(event.data);
    };
    const begun = () => { frame.srcdoc = model.get("page"); };
    const answered = message => frame.contentWindow && frame.contentWindow.postMessage(message, "*");
    addEventListener("message", asked);
    model.on("msg:custom", answered);
    model.on("change:page", begun);
    begun();
    el.append(frame);
    return () => {
      removeEventListener("message", asked);
      model.off("msg:custom", answered);
      model.off("change:page", begun);
    };
  },
};
"""


def live(text: str, *, height: int = 800) -> Any:
    """A widget for Jupyter and marimo in which a system file is changed and its shape follows, as in ``funicular serve``.

    Its trait ``text`` is the file as it stands there now: give it another to begin again, ``observe`` it to follow.
    ``widget.system`` is the :class:`System` of it. Needs ``anywidget``.

    >>> import funicular as fn
    >>> widget = fn.live('''
    ... joints = { A = { at_m = [0, 0, 0] }, P = { mass_kg = 2 } }
    ... bars = [{ from = "A", to = "P", length_m = 3, mass_kg = 0 }]
    ... ''')
    >>> widget.text = widget.text.replace("3", "4")
    >>> round(float(widget.system.solve().joints_m[1, 2]), 6)
    -4.0

    Parameters
    ----------
    text : a system file, TOML; files that it names are not read
    height : of the widget, pixels
    """
    import anywidget  # type: ignore[import-not-found,unused-ignore]
    import traitlets  # type: ignore[import-not-found,unused-ignore]

    class Live(anywidget.AnyWidget):  # type: ignore[misc,unused-ignore]
        _esm = _SCRIPT
        text = traitlets.Unicode("")
        page = traitlets.Unicode("").tag(sync=True)
        height = traitlets.Int(800).tag(sync=True)

        @property
        def system(self) -> System:
            return System.from_toml(self.text)

    widget = Live(text=text, page=_native.live_page(text), height=height)
    asking = False

    def answer(_: object, message: dict[str, Any], __: object) -> None:
        nonlocal asking
        number, path, question = message["funicular"], message["path"], message["question"]
        try:
            found = _native.live_answer(path, json.dumps(question))
        except ValueError as error:
            widget.send({"funicular": number, "error": str(error)})
            return
        widget.send({"funicular": number, "text": found})
        if path == "ask" and not question.get("quick"):
            asking = True
            widget.text = json.loads(found)["text"]
            asking = False

    def begin(change: dict[str, Any]) -> None:
        # What was typed in the page stands there already.
        if not asking:
            widget.page = _native.live_page(change["new"])

    widget.on_msg(answer)
    widget.observe(begin, "text")
    return widget
