"""What each scene could do without, and what that saved."""
import numpy

from .. import runfile, statistics, words
from ..figure import Axis, Figure, Line, Panel, Series
from ..section import Section
from ..style import Look
from ..table import Cell, Table


def build(report):
    section = Section("savings", "What could be left out, and what that saved")
    for run in report.having("savings"):
        scan = [row for row in run.list("savings") if _of_scan(row)]
        saved = [row for row in run.list("savings") if not _of_scan(row)]
        section.blocks += report.heading(run)
        section.blocks += [_figure(report, run, saved), _table(report, run, saved)] if saved else []
        section.blocks += [_crossover(report, run, scan), _scan(report, run, scan)] if scan else []
    return section if section.blocks else None


def _of_scan(row):
    """A tree against all pairs, over n: beyond where they cross, the hierarchy is what no plan leaves out."""
    return row["what"] == "hierarchy" and "--no-omit" not in row["reason"]


def _saved(row):
    return (
        statistics.ratio(row["with_ms"], row["without_ms"])
        if row.get("with_ms") and row.get("without_ms")
        else None
    )


MOST_BARS = 40  # more is no figure, and the table has all


def _figure(report, run, rows):
    rows = [(row, _saved(row)) for row in rows]
    rows = sorted(((row, ratio) for row, ratio in rows if ratio), key=lambda entry: -entry[1].value)
    shown = sorted(rows, key=lambda entry: -abs(numpy.log(entry[1].value)))[:MOST_BARS]
    return _bars(report, run, rows, sorted(shown, key=lambda entry: -entry[1].value))


def _bars(report, run, all_rows, rows):
    """Of all rows, what is said; of `rows`, bars."""
    names = [f"{row['input']}: {row['what']}" for row, _ in rows]
    clear = sum(ratio.low > 1 for _, ratio in all_rows)
    slower = [(row, ratio) for row, ratio in all_rows if ratio.high < 1]
    wrong = sum(not row.get("identical", True) for row, _ in all_rows)
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
        f"Leaving out what a scene does not need was faster in {clear} of {words.plural(len(all_rows), 'case')}"
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
            + (
                f" Shown are the {len(rows)} cases that make the most difference; the table has all {len(all_rows)}."
                if len(rows) < len(all_rows)
                else ""
            )
        ),
        [panel],
        columns=1,
    )


def _crossover(report, run, rows):
    rows = [row for row in rows if _saved(row)]
    pairs, tree = ([runfile.n_of(row["input"]) for row in rows if faster(_saved(row))]
                   for faster in (lambda ratio: ratio.low > 1, lambda ratio: ratio.high < 1))
    message = f"Comparing all pairs is faster than a hierarchy {_lengths(pairs)}, and slower {_lengths(tree)}"
    if pairs and tree and max(pairs) < min(tree):
        message = (
            f"Comparing all pairs is faster than a hierarchy up to {words.count(max(pairs))} spheres, and slower from"
            f" {words.count(min(tree))} on"
        )
    wrong = sum(not row.get("identical", True) for row in rows)
    panel = Panel("", Axis("spheres n", log=True), Axis("update and find, ms", log=True), height=320)
    for name, key, look in (("a hierarchy", "with_ms", Look("c0")), ("all pairs", "without_ms", Look("c1", "square"))):
        medians = [statistics.median(row[key]) for row in rows]
        panel.series.append(
            Series(
                name,
                [runfile.n_of(row["input"]) for row in rows],
                [median.value for median in medians],
                look,
                low=[median.low for median in medians],
                high=[median.high for median in medians],
                hover=[f"<b>{name}</b><br>{row['reason']}" for row in rows],
                chains=[report.chain(run, row["input"]) for row in rows],
            )
        )
    return Figure(
        f"crossover{report.key(run)}",
        message + (f"; another result in {wrong}" if wrong else ""),
        (
            "The quickest tree and the quickest comparison of all pairs, each on a frame of path1. Where they cross depends on"
            " the chain: a plan leaves the hierarchy out only where it expects all pairs to be faster."
        ),
        [panel],
        columns=1,
    )


def _lengths(found):
    return f"at {words.listed(map(words.count, found))} spheres" if found else "at no length"


def _measured(row):
    """The cells of both tables' last columns."""
    ratio, same = _saved(row), row.get("identical")
    return [
        Cell("identical" if same else "DIFFERENT" if same is False else "", kind="" if same else "bad"),
        *[
            Cell(words.ms(numpy.median(row[key])), float(numpy.median(row[key]))) if row.get(key) else ""
            for key in ("with_ms", "without_ms")
        ],
        Cell(words.interval(ratio), ratio.value) if ratio else "",
    ]


def _table(report, run, rows):
    return Table(
        f"savings{report.key(run)}",
        "What was left out, and why",
        "Medians; the result with and without must be identical.",
        ["scene", "left out", "because", "result", "with, ms", "without, ms", "ratio"],
        [[row["input"], row["what"], row["reason"], *_measured(row)] for row in rows],
        words=4,
    )


def _scan(report, run, rows):
    return Table(
        f"crossover{report.key(run)}",
        "A hierarchy against all pairs, by length",
        "Medians; a ratio above 1: all pairs are faster.",
        ["scene", "compared", "result", "a hierarchy, ms", "all pairs, ms", "ratio"],
        [[row["input"], row["reason"], *_measured(row)] for row in rows],
        words=3,
    )
