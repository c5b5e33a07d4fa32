"""How much the variant auto took beside the quickest single one, chain by chain."""
import numpy

from .. import runfile, statistics, words
from ..section import Section
from ..table import Cell, Table


def build(report):
    section = Section("regret", "What the choice of auto costs")
    for run in report.having("regret"):
        section.blocks += report.heading(run) + [_table(report, run)]
    return section if section.blocks else None


def ratios(run):
    """(row, auto / best) of every row that has times, by scene and size."""
    rows = [row for row in run.list("regret") if row.get("auto_ms") and row.get("best_ms")]
    rows.sort(key=lambda row: (runfile.scene_of(row["input"]), runfile.n_of(row["input"])))
    return [(row, statistics.ratio(row["auto_ms"], row["best_ms"])) for row in rows]


def _table(report, run):
    rows = ratios(run)
    return Table(
        f"regret{report.key(run)}",
        _verdict([ratio.value for _, ratio in rows]),
        (
            "Build and find together, medians; the two ran in random turns. Which variant is the quickest is not known"
            " beforehand: auto chose before it searched, by what is known of a chain without reading it again."
        ),
        ["chain", "auto took", "quickest single variant", "auto, ms", "quickest, ms", "ratio"],
        [
            [
                row["input"],
                row["chosen"],
                row["best"],
                *[
                    Cell(words.ms(numpy.median(row[key])), float(numpy.median(row[key])))
                    for key in ("auto_ms", "best_ms")
                ],
                Cell(words.interval(ratio), ratio.value),
            ]
            for row, ratio in rows
        ],
        words=3,
    )


def _verdict(values):
    if not values:
        return "No chain was measured"
    near = sum(value <= 1.05 for value in values)
    mean = float(numpy.exp(numpy.mean(numpy.log(values))))
    return (
        f"auto took at most 5 % more than the quickest variant on {near} of {words.plural(len(values), 'chain')};"
        f" {words.significant(mean, 3)} times as much on the geometric mean"
    )
