"""What the fast searches do for a sphere, step by step, beside the time that they take and that of copies of the chain
where it lies: in the caches, but for the longest.
"""
import numpy

from .. import runfile, statistics, words
from ..section import Section
from ..table import Cell, Table
from .memory import SPHERE, bandwidth

# A copy reads the chain and writes it: a search that takes as long as two spends at most half the time on reading the
# chain once, whatever else it does. Nearer to one a time decides nothing: reading alone may be quicker, a search may
# read blocks in place of spheres, and the copies were not measured in the same moment as the searches.
COPIES = 2


def build(report):
    section = Section("steps", "What bounds the fast searches")
    for run in report.having("steps"):
        section.blocks += report.heading(run) + [_table(report, run, run.list("steps"))]
    return section if section.blocks else None


def carried(run, n):
    """Bytes a nanosecond of a copy of as many bytes as a chain of n spheres has, read and written; None where none so
    long was measured. A chain at least as long as the array that no cache holds lies in memory as that does.
    """
    copied = run.catena.get("bandwidth", {})
    if 2 * SPHERE * n >= copied.get("copied_bytes", numpy.inf):
        return bandwidth(run)
    for size in copied.get("sizes", []):
        if size["copied_bytes"] == 2 * SPHERE * n and size["gb_s"]:
            return statistics.median(size["gb_s"])
    return None


def find_ms(run, row):
    """The median time of a row's search: as all were timed, or as the row says of a chain of this section alone."""
    times = run.samples.get((row["input"], row["variant"], "find"))
    if times is None:
        times = row.get("find_ms") or None
    return None if times is None else float(numpy.median(times))


def copies(run, row):
    """How many times the chain could be copied where it lies while its find runs; None where the one or the other was
    not measured.
    """
    carries, ms = carried(run, runfile.n_of(row["input"])), find_ms(run, row)
    if carries is None or ms is None:
        return None
    return ms * 1e6 * carries.value / (2 * SPHERE * runfile.n_of(row["input"]))


def _table(report, run, rows):
    steps = list(dict.fromkeys(step["step"] for row in rows for step in row["steps"]))
    rows = sorted(rows, key=lambda row: (runfile.scene_of(row["input"]), runfile.n_of(row["input"]), row["variant"]))
    fit = [copies(run, row) for row in rows]
    known = [times for times in fit if times is not None]
    body = []
    for row, times in zip(rows, fit):
        n, taken = runfile.n_of(row["input"]), {step["step"]: step["times"] for step in row["steps"]}
        ms = find_ms(run, row)
        body.append(
            [
                row["input"],
                row["variant"],
                _cell(None if ms is None else 1e6 * ms / n),
                *([_cell(times)] if known else []),
                _cell(row["pairs"] / n),
                *[_cell(taken[step] / n if step in taken else None) for step in steps],
            ]
        )
    return Table(
        f"steps{report.key(run)}",
        _verdict(known),
        (
            "A sphere's share of the time, the pairs and the steps. A step is named by what it tests at once, one thing"
            " and what it is held against: the capsule of a block of eight spheres against those of sixteen blocks, two"
            " blocks by their boxes in space, eight spheres against eight, one sphere against as many as a vector of"
            " the processor holds. Their numbers are the same in every repetition. " + _copied(run, rows)
        ),
        ["chain", "variant", "ns", *(["copies of the chain"] if known else []), "pairs", *steps],
        body,
        words=2,
    )


def _copied(run, rows):
    """What the copies are that the searches are held against, and of which chains there are none."""
    rates = {row["input"]: carried(run, runfile.n_of(row["input"])) for row in rows}
    lacking = [input_ for input_, rate in rates.items() if rate is None]
    measured = [rate.value for rate in rates.values() if rate is not None]
    if not measured:
        return "Copies of arrays as long as the chains were not measured in this run." + (
            " Those of a longer one, which no cache holds, say nothing of chains that lie in a cache." if bandwidth(run) else ""
        )
    return (
        "Copies: of an array as long as the chain, again and again, so that it lies where the chain does when it is"
        f" searched again and again; {_span(measured, 3)} GB/s, read and written, on one core. A search that memory"
        " bounds would have to carry about as many bytes as so many copies. It may take less than one: it writes no"
        " sphere, and may read blocks that the build made in place of spheres."
        + (f" No copy as long as {words.listed(lacking, 3)} was measured." if lacking else "")
    )


def _cell(value):
    return "" if value is None else Cell(words.significant(value, 3), value)


def _verdict(known):
    if not known:
        return "Steps of the fast searches, a sphere; whether memory bounds them is not known"
    sure = [times for times in known if times >= COPIES]
    if not sure:
        of = f"each of {len(known)} searches" if len(known) > 1 else "the one search"
        return (
            f"In the time of {of} the chain could be copied less than twice: what bounds"
            f" {'them' if len(known) > 1 else 'it'}, memory or steps, is not known"
        )
    if len(sure) < len(known):
        of = f"{len(sure)} of {len(known)} searches"
    else:
        of = f"all {len(known)} searches" if len(known) > 1 else "the one search"
    open_ = len(known) - len(sure)
    return (
        f"Reading the chain once takes at most half the time of {of}, in which it could be copied {_span(sure, 2)} times"
        + (f"; what bounds the other{f' {open_}' if open_ > 1 else ''}, memory or steps, is not known" if open_ else "")
    )


def _span(values, digits):
    least, most = (words.significant(end, digits) for end in (min(values), max(values)))
    return least if least == most else f"{least} to {most}"
