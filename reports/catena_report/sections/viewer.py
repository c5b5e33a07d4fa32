"""The chains in three dimensions, where the viewer and a run with views are there."""
from ..section import Raw, Section


def available():
    """The viewer's module, or None while there is none."""
    try:
        from .. import viewer
    except ImportError:
        return None
    return viewer


def missing(report):
    """Why chains are not shown, or None."""
    if not report.having("viewer"):
        return None
    return available().missing() if available() else "reports/catena_report/viewer.py is not there"


def build(report):
    views = [view for run in report.having("viewer") for view in run.list("viewer")]
    if not views or not available():
        return None
    fragment = available().render(views)
    return Section("viewer", "The chains in three dimensions", [Raw(fragment)]) if fragment else None
