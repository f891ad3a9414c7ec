"""Execute the notebooks of this folder headless, all or those named, and optionally keep the cleaned outputs."""

import sys
import tempfile
from pathlib import Path

import nbformat
from nbclient import NotebookClient

HERE = Path(__file__).resolve().parent
TIMEOUT_S = 300  # per cell; the slowest takes a few seconds


def clean(notebook, here):
    """Drop what differs from run to run or names this machine; refuse what cannot be dropped."""
    notebook.metadata = {
        "kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"},
        "language_info": {"name": "python"},
    }
    for cell in notebook.cells:
        cell.metadata = {}
        for output in cell.get("outputs", []):
            output.pop("metadata", None)
            if output.output_type in ("display_data", "execute_result"):
                output["metadata"] = {}
    text = nbformat.writes(notebook)
    for path in (str(here.parent), str(Path.home()), tempfile.gettempdir()):
        if path in text:
            raise SystemExit(f"an output names a path of this machine: {path}")
    return text + ("" if text.endswith("\n") else "\n")


def main():
    write = "--write" in sys.argv[1:]
    names = [name for name in sys.argv[1:] if name != "--write"]
    notebooks = [HERE / Path(name).name for name in names] or sorted(HERE.glob("*.ipynb"))
    if not notebooks:
        raise SystemExit("there is no notebook to execute")
    for path in notebooks:
        notebook = nbformat.read(path, as_version=4)
        if not write and not any(c.get("outputs") for c in notebook.cells):
            raise SystemExit(f"{path.name} is committed without outputs: run notebooks/run --write")
        client = NotebookClient(
            notebook, timeout=TIMEOUT_S, kernel_name="python3", resources={"metadata": {"path": str(HERE)}}
        )
        client.execute()
        text = clean(notebook, HERE)
        if write:
            path.write_text(text)
        print(f"{path.name}: {sum(c.cell_type == 'code' for c in notebook.cells)} cells executed")


if __name__ == "__main__":
    main()
