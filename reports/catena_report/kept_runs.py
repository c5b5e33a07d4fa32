"""The run.json that is already in the folder of a page: it may be the only copy of what was measured."""
import itertools
import pathlib

from . import runfile


def require(output, runs):
    """A BadRunFile when the run.json in the folder `output` holds a run that is none of these, which replace it."""
    path = output / "run.json"
    if not path.exists():
        return
    try:
        held = runfile.load_all(path)
    except runfile.BadRunFile:
        held = [None]  # whatever it is
    if all(one is not None and any(one.raw == run.raw for run in runs) for one in held):
        return
    free = next(name for k in itertools.count(2) if not (name := pathlib.Path(f"{output}-{k}")).exists())
    raise runfile.BadRunFile(
        f"{path} holds a run that is none of those given, and would be lost; give another --output, such as {free}"
    )
