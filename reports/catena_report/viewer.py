"""The 3-D viewer as one fragment of HTML with everything inside: data, style, program and three.js."""

import base64
import gzip
import json
from pathlib import Path

import numpy

ASSETS = Path(__file__).parent / "assets"
THREE = Path("/usr/share/javascript/three")
WIDTH = {"spheres": 4, "pairs": 2}  # numbers of a row
LIBRARIES = (THREE / "three.min.js", THREE / "examples/js/controls/OrbitControls.js")


def missing():
    """Why there can be no viewer, in one sentence; None where there can be one."""
    absent = [path for path in LIBRARIES if not path.is_file()]
    if not absent:
        return None
    return f"no 3-D viewer: {absent[0]} is not there; install Debian's libjs-three"


def render(views):
    """HTML of a viewer of `views` (run_file.md); "" where there are none, or no three.js."""
    if not views or missing():
        return ""
    different = {view["input"]: view for view in reversed(views)}  # several runs may hold the same chain: the first's
    shown = [view for view in views if view is different[view["input"]]]
    program = "\n".join(_text(path) for path in sorted((ASSETS / "viewer").glob("*.js")))
    return "\n".join((
        f"<style>\n{_text(ASSETS / 'viewer.css')}</style>",
        _text(ASSETS / "viewer.html"),
        f'<script type="text/plain" id="catena-views">{_packed(json.dumps([*map(_in_columns, shown)], separators=(",", ":")))}</script>',
        f'<script type="text/plain" id="catena-three">{_packed(_joined(LIBRARIES))}</script>',
        f"<script>\n(() => {{\n'use strict';\n{program}\nstartViewer();\n}})();\n</script>\n",
    ))


def _in_columns(view):
    """The view with its numbers as assets/viewer/data.js reads them, which pack in half the size."""
    of = lambda row: {key: columns(value, WIDTH[key]) if key in WIDTH else value for key, value in row.items()}  # noqa: E731
    return {key: [*map(of, value or [])] if key in ("frames", "levels") else value for key, value in view.items()}


def columns(text, width):
    """Of base64 of rows of so many numbers of 32 bits: base64 of the steps from row to row, modulo 2^32, column after
    column, of all steps first the lowest bytes.
    """
    rows = numpy.frombuffer(base64.b64decode(text), "<u4").reshape(-1, width)
    steps = numpy.diff(rows, axis=0, prepend=numpy.zeros((1, width), "<u4"))
    return base64.b64encode(steps.T.ravel().view(numpy.uint8).reshape(-1, 4).T.tobytes()).decode()


def _text(path):
    return path.read_text(encoding="utf-8")


def _joined(paths):
    return "\n;\n".join(_text(path) for path in paths)


def _packed(text):
    return base64.b64encode(gzip.compress(text.encode(), 9, mtime=0)).decode()
