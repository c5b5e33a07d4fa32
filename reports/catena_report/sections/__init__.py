"""The sections of the page, in order. Each module has build(report): a section.Section, or None without
content.
"""
from . import (
    advice,
    animation,
    claims,
    coherence,
    counts,
    environment,
    exactness,
    gpu_peers,
    judged,
    memory,
    motion,
    paper_tables,
    pivots,
    ranks,
    regret,
    reproduce,
    roofline,
    savings,
    slowdown,
    stability,
    steps,
    summary,
    times,
    tube_errors,
    viewer,
    wants,
    work_precision,
)
from .. import checks
from ..section import without_dead_links

ORDER = (
    summary,
    viewer,
    paper_tables,
    claims,
    times,
    advice,
    slowdown,
    work_precision,
    tube_errors,
    stability,
    judged,
    pivots,
    exactness,
    savings,
    regret,
    wants,
    counts,
    steps,
    gpu_peers,
    roofline,
    memory,
    animation,
    coherence,
    ranks,
    motion,
    environment,
    reproduce,
)


def build(report):
    """Every section that has content."""
    return without_dead_links([section for section in (_built(module, report) for module in ORDER) if section])


def _built(module, report):
    try:
        return module.build(report)
    except checks.UNEXPECTED as error:
        files = ", ".join(dict.fromkeys(str(run.path) for run in report.runs))
        name = module.__name__.rpartition(".")[2]
        raise checks.unusable(files, f"the section {name} cannot be made", error) from error
