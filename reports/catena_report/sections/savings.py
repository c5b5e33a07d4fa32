"""What each scene could do without, and what that saved."""
import numpy

from .. import statistics, words
from ..figure import Axis, Figure, Line, Panel, Series
from ..section import Section
from ..style import Look
from ..table import Cell, Table


def build(report):
    section = Section("savings", "What could be left out, and what that saved")
    for run in report.having("savings"):
        section.blocks += report.heading(run) + [_figure(report, run), _table(report, run)]
    return section if section.blocks else None


def _saved(row):
    return (
        statistics.ratio(row["with_ms"], row["without_ms"])
        if row.get("with_ms") and row.get("without_ms")
        else None
    )


def _figure(report, run):
    rows = [(row, _saved(row)) for row in run.list("savings")]
    rows = sorted(((row, ratio) for row, ratio in rows if ratio), key=lambda entry: -entry[1].value)
    names = [f"{row['input']}: {row['what']}" for row, _ in rows]
    clear = sum(ratio.low > 1 for _, ratio in rows)
    slower = [(row, ratio) for row, ratio in rows if ratio.high < 1]
    wrong = sum(not row.get("identical", True) for row, _ in rows)
    series = Series(
        "saved",
        [ratio.value for _, ratio in rows],
        list(range(len(rows))),
        Look("c0"),
        line=False,
        across=True,
        low=[ratio.low for _, ratio in rows],
        high=[ratio.high for _, ratio in rows],
        legend=False,
        hover=[
            f"<b>{row['what']}</b><br>{row['input']}<br>{row['reason']}<br>{words.interval(ratio)} times"
            " faster without"
            for row, ratio in rows
        ],
        chains=[report.chain(run, row["input"]) for row, _ in rows],
    )
    panel = Panel(
        "",
        Axis("time with it / time without it", log=True),
        Axis("", categories=names),
        [series],
        lines=[Line(1)],
        height=110 + 24 * len(rows),
    )
    message = (
        f"Leaving out what a scene does not need was faster in {clear} of {words.plural(len(rows), 'case')}"
    )
    if slower:
        row, ratio = min(slower, key=lambda entry: entry[1].value)
        message += f", slower in {len(slower)}: up to {1 / ratio.value:.3g} times ({row['what']}, {row['input']})"
    if wrong:
        message += f", and gave another result in {wrong}"
    return Figure(
        f"savings{report.key(run)}",
        message,
        (
            "Right of the dashed line: faster without. Bars are the 95 % interval of the ratio of medians;"
            " one that crosses the line shows no difference."
        ),
        [panel],
        columns=1,
    )


def _table(report, run):
    rows = []
    for row in run.list("savings"):
        ratio = _saved(row)
        same = row.get("identical")
        rows.append(
            [
                row["input"],
                row["what"],
                row["reason"],
                Cell(
                    "identical" if same else "DIFFERENT" if same is False else "", kind="" if same else "bad"
                ),
                *[
                    (
                        Cell(words.ms(numpy.median(row[key])), float(numpy.median(row[key])))
                        if row.get(key)
                        else ""
                    )
                    for key in ("with_ms", "without_ms")
                ],
                Cell(words.interval(ratio), ratio.value) if ratio else "",
            ]
        )
    return Table(
        f"savings{report.key(run)}",
        "What was left out, and why",
        "Medians; the result with and without must be identical.",
        ["scene", "left out", "because", "result", "with, ms", "without, ms", "ratio"],
        rows,
        words=4,
    )
