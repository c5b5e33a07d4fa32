"""The 3-D viewer as one fragment of HTML with everything inside: data, style, program and three.js."""

import base64
import gzip
import json
from pathlib import Path

ASSETS = Path(__file__).parent / "assets"
THREE = Path("/usr/share/javascript/three")
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
        f'<script type="text/plain" id="catena-views">{_packed(json.dumps(shown, separators=(",", ":")))}</script>',
        f'<script type="text/plain" id="catena-three">{_packed(_joined(LIBRARIES))}</script>',
        f"<script>\n(() => {{\n'use strict';\n{program}\nstartViewer();\n}})();\n</script>\n",
    ))


def _text(path):
    return path.read_text(encoding="utf-8")


def _joined(paths):
    return "\n;\n".join(_text(path) for path in paths)


def _packed(text):
    return base64.b64encode(gzip.compress(text.encode(), 9, mtime=0)).decode()
