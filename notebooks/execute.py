"""Execute the notebooks of this folder headless, all or those named, and optionally keep the cleaned outputs."""

import itertools
import math
import re
import sys
import tempfile
from pathlib import Path

import nbformat
from jupyter_client.manager import AsyncKernelManager
from jupyter_core.utils import run_sync
from nbclient import NotebookClient

HERE = Path(__file__).resolve().parent
TIMEOUT_S = 300  # per cell; the slowest takes a few seconds
TIMED = "solve_s"  # a cell that reads this measures times
NUMBER = re.compile(r"(-?\d+(?:\.\d+)?(?:e[-+]?\d+)?)")


def clean(notebook, here):
    """Drop what differs from run to run or names this machine; refuse what cannot be dropped."""
    join_streams(notebook)
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


def join_streams(notebook):
    """Make one output of what a cell writes to one stream: where the kernel cuts it is a matter of time alone."""
    for cell in notebook.cells:
        joined = []
        for output in cell.get("outputs", []):
            last = joined[-1] if joined else None
            if last and output.output_type == "stream" == last.output_type and output.name == last.name:
                last.text += output.text
            else:
                joined.append(output)
        if "outputs" in cell:
            cell.outputs = joined


def told(notebook):
    """What the cells print, line by line, without those that measure times."""
    for cell in notebook.cells:
        if cell.cell_type != "code" or TIMED in cell.source:
            continue
        text = "".join(output.get("text", "") for output in cell.get("outputs", []))
        yield from text.splitlines()


def alike(kept, found):
    """Whether two lines tell the same: word by word, numbers to what rounding leaves of them."""
    kept, found = NUMBER.split(kept), NUMBER.split(found)
    if kept[::2] != found[::2] or len(kept) != len(found):
        return False
    pairs = zip(map(float, kept[1::2]), map(float, found[1::2]))
    return all(math.isclose(a, b, rel_tol=1e-6, abs_tol=1e-9) for a, b in pairs)


def compare(path, kept, found):
    """Refuse outputs that are committed and do not come out any more."""
    for k, (old, new) in enumerate(itertools.zip_longest(kept, found, fillvalue=""), 1):
        if not alike(old, new):
            raise SystemExit(
                f"{path.name}: line {k} of what the cells print is committed as\n  {old}\nand comes out as\n  {new}\n"
                "run notebooks/run --write, and read the difference"
            )


def execute(notebook):
    """Run all cells in a kernel of their own, reached through sockets that nobody else of this machine may read."""
    with tempfile.TemporaryDirectory(prefix="kernel-") as folder:
        kernel = AsyncKernelManager(kernel_name="python3", transport="ipc", ip=str(Path(folder) / "socket"))
        resources = {"metadata": {"path": str(HERE)}}
        try:
            NotebookClient(notebook, timeout=TIMEOUT_S, km=kernel, resources=resources).execute()
        finally:
            run_sync(kernel.shutdown_kernel)(now=True)


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
        kept = list(told(notebook))
        execute(notebook)
        text = clean(notebook, HERE)
        if write:
            path.write_text(text)
        else:
            compare(path, kept, list(told(notebook)))
        print(f"{path.name}: {sum(c.cell_type == 'code' for c in notebook.cells)} cells executed")


if __name__ == "__main__":
    main()
