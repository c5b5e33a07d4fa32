"""The paper's Tables 3 and 4, with every run's medians below each of its rows."""
from .. import paper, statistics, words
from ..section import Prose, Section
from ..table import Cell, Table


def build(report):
    printed = paper.tables()
    section = Section("paper-tables", "The paper's Tables 3 and 4 beside ours")
    for path, name in paper.TABLES.items():
        table = _table(report, printed, path, name)
        if table:
            section.blocks.append(table)
    if not section.blocks:
        return None
    section.blocks.insert(
        0,
        Prose(
            "Runtimes in milliseconds. Rows in italics are the paper's"
            f" ({words.listed(printed['source'].split('; ')[-1:])}); below each is the median measured here"
            " for the same algorithm, a frame on average where every keyframe was timed (--paper) and else of the"
            " middle one. The paper's zeros are the resolution of its clock."
        ),
    )
    return section


def _table(report, printed, path, name):
    ns = sorted(set(printed["n"]).union(*(paper.sizes(run, path) for run in report.runs)))
    rows, measured = [], False
    for algorithm in paper.STAGES:
        then = dict(zip(printed["n"], printed[path].get(algorithm, [])))
        stage = (
            "construction"
            if algorithm in paper.CONSTRUCTIONS
            else "whole call" if algorithm == paper.WITH_TRANSFERS else "traversal"
        )
        ours = []
        for run in report.runs:
            cells = [_cell(paper.samples(run, path, n, algorithm)[0], then.get(n)) for n in ns]
            if any(cell.text for cell in cells):
                ours.append(
                    [
                        Cell(algorithm.partition(",")[0]),
                        Cell(stage),
                        Cell(run.host if algorithm in paper.ON_HOST else report.label(run)),
                    ]
                    + cells
                )
        if then:
            rows.append(
                [Cell(algorithm, kind="paper"), Cell(stage, kind="paper"), Cell("the paper", kind="paper")]
                + [Cell(f"{then[n]:.2f}", then[n], "paper") if n in then else Cell("") for n in ns]
            )
        measured |= bool(ours)
        rows += ours
    if not measured:
        return None
    return Table(
        path,
        f"{name} of the paper and of this report: {path}",
        (
            "Host stages are wall time, device stages CUDA events; a cell's hint gives the 95 % interval of"
            " the median, the number of repetitions and the ratio to the paper."
        ),
        ["algorithm", "stage", "measured on", *[words.count(n) for n in ns]],
        rows,
        words=3,
    )


def _cell(times, then):
    if times is None:
        return Cell("")
    estimate = statistics.median(times)
    hint = (
        f"[{words.ms(estimate.low)}, {words.ms(estimate.high)}] ms, {words.plural(len(times), 'repetition')}"
    )
    if then and estimate.value:
        hint += f"; {words.significant(then / estimate.value, 3)} times faster than the paper's {then:g} ms"
    return Cell(words.ms(estimate.value), estimate.value, hint=hint)
