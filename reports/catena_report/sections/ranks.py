"""The critical-difference diagram: Friedman's test over all chains, with Nemenyi's critical difference."""
import numpy

from .. import statistics, words
from ..figure import Axis, Figure, Line, Panel, Series
from ..section import Section
from ..style import Look


def build(report):
    section = Section("ranks", "Ranks over all chains")
    for run in report.runs:
        figure = _figure(report, run)
        if figure:
            section.blocks += report.heading(run) + [figure]
    return section if section.blocks else None


def ranks(run):
    """Friedman's ranks of the variants by their median build + find, and the chains compared; None when too
    few.
    """
    table = {}
    for input_ in run.inputs():
        row = {variant: run.total(input_, variant) for variant in run.recommended()}
        row = {variant: float(numpy.median(times)) for variant, times in row.items() if times is not None}
        if len(row) > 1:
            table[input_] = row
    scores, cases = statistics.complete_block(table) if table else ({}, [])
    found = statistics.friedman(scores) if cases else None
    return (found, cases) if found else None


def _figure(report, run):
    found = ranks(run)
    if not found:
        return None
    result, cases = found
    names = sorted(result.mean, key=result.mean.get)
    panel = Panel(
        "",
        Axis("mean rank (1 is fastest)"),
        Axis("", categories=names),
        height=130 + 26 * len(names),
        lines=[Line(result.mean[names[0]], to=result.mean[names[0]] + result.difference)],
    )
    for at, group in enumerate(result.alike()):
        rows = [names.index(name) for name in group]
        x = result.mean[group[-1]] + 0.12
        panel.series.append(
            Series(
                "not distinguishable",
                [x, x],
                [rows[0] - 0.2, rows[-1] + 0.2],
                Look("muted"),
                markers=False,
                width=2.2,
                legend=at == 0,
            )
        )
    for at, name in enumerate(names):
        panel.series.append(
            Series(
                name,
                [result.mean[name]],
                [at],
                report.look(run, name),
                line=False,
                size=1.4,
                legend=False,
                hover=[f"<b>{name}</b><br>mean rank {result.mean[name]:.2f} over {result.cases} chains"],
            )
        )
    best = [name for name in names if result.mean[name] - result.mean[names[0]] <= result.difference]
    message = f"{names[0]} has the best mean rank, " + (
        f"not distinguishable from {words.listed(best[1:], 3)}"
        if len(best) > 1
        else "and no other comes within the critical difference"
    )
    p = f"p = {result.p:.2g}" if result.p >= 1e-300 else "p < 1e-300"
    return Figure(
        f"ranks{report.key(run)}",
        message,
        (
            f"On each of {words.plural(result.cases, 'chain')} the variants that were timed on all of them"
            " are ranked by their median build + find; further left is faster. Friedman's test that all are"
            f" alike: {p}. Nemenyi's critical difference at 5 % is {result.difference:.2f}: bars join groups"
            " whose ranks lie within it, the shaded band holds those not distinguishable from the best."
        ),
        [panel],
        columns=1,
    )
