"""How much the variant auto took beside the quickest single one, chain by chain."""
import numpy

from .. import runfile, statistics, words
from ..section import Section
from ..table import Cell, Table

NEAR = 1.05  # times the quickest


def build(report):
    section = Section("regret", "What the choice of auto costs")
    for run in report.having("regret"):
        rows = ratios(run)
        section.blocks += report.heading(run) + [_sizes(report, run, rows), _table(report, run, rows)]
    return section if section.blocks else None


def ratios(run):
    """(row, auto / best) of every row that has times, by scene and size."""
    rows = [row for row in run.list("regret") if row.get("auto_ms") and row.get("best_ms")]
    rows.sort(key=lambda row: (runfile.scene_of(row["input"]), runfile.n_of(row["input"])))
    return [(row, statistics.ratio(row["auto_ms"], row["best_ms"])) for row in rows]


def _sizes(report, run, rows):
    by_size = {}
    for row, ratio in rows:
        by_size.setdefault(runfile.n_of(row["input"]), []).append(ratio.value)
    return Table(
        f"regret-sizes{report.key(run)}",
        _verdict([ratio.value for _, ratio in rows]),
        "By the number of spheres. Which variant is the quickest is not known beforehand: auto chose before it"
        " searched, by what is known of a chain without reading it again.",
        ["spheres", "chains", "auto / quickest, geometric mean", "the most", "more than 5 % above"],
        [
            [
                Cell(words.count(n), n),
                Cell(str(len(values)), len(values)),
                *[Cell(words.significant(value, 3), value) for value in (_mean(values), max(values))],
                Cell(str(_above(values)), _above(values)),
            ]
            for n, values in sorted(by_size.items())
        ],
    )


def _table(report, run, rows):
    return Table(
        f"regret{report.key(run)}",
        "What auto took, chain by chain",
        (
            "Build and find together, medians; the two ran in random turns. Of the processor, so that what else the"
            " machine did is not in it; by the wall clock where auto took several threads, or a device."
        ),
        ["chain", "auto took", "quickest single variant", "clock", "auto, ms", "quickest, ms", "ratio"],
        [
            [
                row["input"],
                row["chosen"],
                row["best"],
                row.get("clock", "wall"),
                *[
                    Cell(words.ms(numpy.median(row[key])), float(numpy.median(row[key])))
                    for key in ("auto_ms", "best_ms")
                ],
                Cell(words.interval(ratio), ratio.value),
            ]
            for row, ratio in rows
        ],
        words=4,
    )


def _mean(values):
    return float(numpy.exp(numpy.mean(numpy.log(values))))


def _above(values):
    return sum(value > NEAR for value in values)


def _verdict(values):
    if not values:
        return "No chain was measured"
    return (
        f"auto took at most 5 % more than the quickest variant on {len(values) - _above(values)} of"
        f" {words.plural(len(values), 'chain')}; {words.significant(_mean(values), 3)} times as much on the"
        " geometric mean"
    )
