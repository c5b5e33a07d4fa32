"""What exact answers cost: the exact variant against the same stages in rounded arithmetic, on one chain."""
from .. import statistics, words
from ..section import Section
from ..table import Cell, Table

STAGES = {"build": "construction", "find": "traversal"}


def build(report):
    section = Section("exactness", "What exactness costs")
    for run in report.runs:
        table = _table(report, run)
        if table.rows:
            section.blocks += report.heading(run) + [table]
    return section if section.blocks else None


def _table(report, run):
    infos = [run.info(variant) for variant in run.variants()]
    exact_of = {info.stages: info.name for info in infos if info.recommended}
    ratios, left_out = {}, set()
    for (input_, variant, stage), times in run.samples.items():
        info = run.info(variant)
        exact = run.samples.get((input_, exact_of.get(info.stages), stage))
        if info.rounded and exact is not None and stage in STAGES:
            if _wrong(run, input_, variant):
                left_out.add((input_, variant))
                continue
            ratios.setdefault((variant, stage), []).append(statistics.ratio(exact, times).value)
    rows = [
        [variant, *[_cell(ratios.get((variant, stage))) for stage in STAGES]]
        for variant in sorted({key[0] for key in ratios})
    ]
    message = ""
    if ratios:
        every = [ratio for several in ratios.values() for ratio in several]
        message = (
            f"Exact answers take {words.significant(statistics.mean_log(every).value, 3)} times as long as"
            f" the inexact ones, in the geometric mean of {len(every)} cases"
        )
    return Table(
        f"exactness{report.key(run)}",
        message,
        (
            "Median time of the exact variant over that of the same algorithm in the arithmetic named at the"
            " left: the geometric mean over all chains, with its 95 % t interval. Above 1 the exact one is"
            " slower. Only where the inexact one found the same pairs: one that loses pairs has less to do"
            + (f"; {words.plural(len(left_out), 'pair')} of chain and variant left out." if left_out else ".")
        ),
        ["instead of", *STAGES.values()],
        rows,
    )


def _wrong(run, input_, variant):
    """By any stage: of build alone the answer is known, too."""
    of = (counters for (chain, name, _), counters in run.counters.items() if (chain, name) == (input_, variant))
    return any(counters.get(key) for counters in of for key in ("missing", "invented"))


def _cell(ratios):
    if not ratios:
        return Cell("")
    mean = statistics.mean_log(ratios)
    text = words.interval(mean) if len(ratios) > 1 else f"{mean.value:.2f}"
    return Cell(
        text, mean.value, hint=f"{words.plural(len(ratios), 'chain')}, {min(ratios):.2f} to {max(ratios):.2f}"
    )
