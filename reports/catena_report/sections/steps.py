"""What the fast searches do for a sphere, step by step, beside the time that they take and what memory would allow."""
import numpy

from .. import runfile, words
from ..section import Section
from ..table import Cell, Table
from .memory import SPHERE, bandwidth


def build(report):
    section = Section("steps", "What bounds the fast searches")
    for run in report.having("steps"):
        section.blocks += report.heading(run) + [_table(report, run, run.list("steps"))]
    return section if section.blocks else None


def times_reading(run, rows):
    """For each row, how many times the chain could be copied at the measured bandwidth while its find runs; None
    where the one or the other was not measured.
    """
    carries = bandwidth(run)
    found = []
    for row in rows:
        times = run.samples.get((row["input"], row["variant"], "find"))
        if carries is None or times is None:
            found.append(None)
        else:
            bytes_moved = 2 * SPHERE * runfile.n_of(row["input"])
            found.append(float(numpy.median(times)) * 1e6 * carries.value / bytes_moved)
    return found


def _table(report, run, rows):
    steps = list(dict.fromkeys(step["step"] for row in rows for step in row["steps"]))
    rows = sorted(rows, key=lambda row: (runfile.scene_of(row["input"]), runfile.n_of(row["input"]), row["variant"]))
    reading = times_reading(run, rows)
    body = []
    for row, times in zip(rows, reading):
        n, taken = runfile.n_of(row["input"]), {step["step"]: step["times"] for step in row["steps"]}
        measured = run.samples.get((row["input"], row["variant"], "find"))
        ns = None if measured is None else 1e6 * float(numpy.median(measured)) / n
        body.append(
            [
                row["input"],
                row["variant"],
                _cell(ns),
                _cell(times),
                _cell(row["pairs"] / n),
                *[_cell(taken[step] / n if step in taken else None) for step in steps],
            ]
        )
    return Table(
        f"steps{report.key(run)}",
        _verdict(reading),
        (
            "A sphere's share of the time, the pairs and the steps. A step is named by what it tests at once, one thing"
            " and what it is held against: the capsule of a block of eight spheres against those of sixteen blocks, two"
            " blocks by their boxes in space, eight spheres against eight, one sphere against as many as a vector of"
            " the processor holds. Their numbers are the same in every repetition. The search moves the chain through"
            " memory once at least: how often a copy of the chain would fit into its time says whether memory bounds it"
            " (about once) or its steps do."
        ),
        ["chain", "variant", "ns", "copies of the chain", "pairs", *steps],
        body,
        words=2,
    )


def _cell(value):
    return "" if value is None else Cell(words.significant(value, 3), value)


def _verdict(reading):
    known = [times for times in reading if times is not None]
    if not known:
        return "Steps of the fast searches, a sphere"
    slower = [times for times in known if times >= 2]
    if not slower:
        return f"Memory bounds all {len(known)} searches"
    bound = len(known) - len(slower)
    return (
        f"Memory bounds {bound or 'none'} of {len(known)} searches: in the time of {'the others' if bound else 'each'} the"
        f" chain could be copied {words.significant(min(slower), 2)} to {words.significant(max(slower), 2)} times"
    )
