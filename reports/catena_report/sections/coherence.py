"""What update() of a moved frame saves over a new chain."""
import numpy

from .. import statistics, words
from ..section import Section
from ..table import Cell, Table

LEAST_RATIO = 1.05  # a smaller one does not matter


def build(report):
    section = Section("coherence", "What moving saves over building anew")
    for run in report.having("coherence"):
        section.blocks += report.heading(run) + [_table(report, run)]
    return section if section.blocks else None


def _table(report, run):
    rows = []
    for row in run.list("coherence"):
        if not row.get("rebuild_ms") or not row.get("update_ms"):
            continue
        ratio = statistics.ratio(row["rebuild_ms"], row["update_ms"])
        p = statistics.mann_whitney(row["rebuild_ms"], row["update_ms"])
        verdict = "no significant difference"
        if p < 1 - statistics.CONFIDENCE:
            verdict = "rebuild is faster" if ratio.value < 1 else "update is faster"
            if 1 / LEAST_RATIO < ratio.value < LEAST_RATIO:
                verdict += f" by less than {100 * (LEAST_RATIO - 1):.0f} %"
        rows.append(
            [
                row["input"],
                row["variant"],
                verdict,
                *[
                    Cell(words.ms(numpy.median(row[key])), float(numpy.median(row[key])))
                    for key in ("rebuild_ms", "update_ms")
                ],
                Cell(words.interval(ratio), ratio.value),
            ]
        )
    return Table(
        f"coherence{report.key(run)}",
        "A new chain against update() of a moved frame",
        (
            "Median milliseconds; what is faster is significantly so by Mann-Whitney at 5 %."
        ),
        ["chain", "variant", "verdict", "rebuild, ms", "update, ms", "ratio"],
        rows,
        words=3,
    )
