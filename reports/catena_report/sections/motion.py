"""The stiff rope: which step each variant survives, and what it costs (the lines of `catena motion
--json`).
"""
from .. import words
from ..figure import Axis, Figure, Heat, Panel, Series
from ..section import Section
from ..table import Cell, Table

CATEGORIES = [("holds", "good"), ("slips through itself", "bad"), ("diverges", "lost")]
OUTCOMES = {"holds": 0, "slipped": 1, "diverged": 2}


def build(report):
    section = Section("motion", "A stiff rope in motion")
    for run in report.having("motion"):
        lines = run.list("motion")
        section.blocks += report.heading(run) + [
            _outcomes(report, run, lines),
            _drift(report, run, lines),
            _table(report, run, lines),
        ]
    return section if section.blocks else None


def _rope(line):
    """What is moved, apart from the variant and the step."""
    return f"stiffness {line['stiffness']:g}" + (f", offset {line['offset']:g}" if line.get("offset") else "")


def _outcomes(report, run, lines):
    steps = sorted({line["step"] for line in lines}, reverse=True)
    rows = list(
        dict.fromkeys(
            (_rope(line), line["variant"])
            for line in sorted(lines, key=lambda l: (l["stiffness"], l.get("offset", 0)))
        )
    )
    cell = {(_rope(line), line["variant"], line["step"]): line for line in lines}
    grid = [[cell.get((*row, step)) for step in steps] for row in rows]
    panel = Panel(
        "",
        Axis("time step", categories=[f"{step:g}" for step in steps]),
        Axis("", categories=[": ".join(row) for row in rows]),
        height=130 + 20 * len(rows),
        least=420,
        heat=Heat(
            [[OUTCOMES.get(line["outcome"]) if line else None for line in row] for row in grid],
            CATEGORIES,
            [[_hover(line) if line else "not run" for line in row] for row in grid],
        ),
    )
    held = [line for line in lines if line["outcome"] == "holds"]
    return Figure(
        f"motion-outcome{report.key(run)}",
        f"The rope holds in {len(held)} of {words.plural(len(lines), 'motion')}",
        (
            "A knotted rope is pulled tight; each cell is one motion with one variant finding its contacts."
            " To the right the time step is smaller. It slips through itself where the knot has become"
            " another one; an exact variant can fail only because the step is too long."
        ),
        [panel],
        columns=1,
    )


def _hover(line):
    failed = f" at time {line['failed_at']:.3g}" if line.get("failed_at") is not None else ""
    return (
        f"<b>{line['variant']}</b><br>{_rope(line)}, step"
        f" {line['step']:g}<br>{line['outcome']}{failed}<br>energy drift"
        f" {words.number(line['energy_drift'])}, penetration"
        f" {words.number(line['deepest_penetration'])}<br>{line['contacts']} contacts,"
        f" {line['missed_by_variant']} missed and {line['invented_by_variant']} invented by the"
        f" variant<br>{words.duration(line['ms_median'])}"
    )


def _drift(report, run, lines):
    panels = []
    for rope in dict.fromkeys(
        _rope(line) for line in sorted(lines, key=lambda l: (l.get("offset", 0), l["stiffness"]))
    ):
        panel = Panel(rope, Axis("time step", log=True), Axis("energy drift", log=True), height=250)
        for variant in sorted(
            {line["variant"] for line in lines}, key=lambda v: (not run.info(v).exact, v)
        ):
            mine = sorted(
                (
                    line
                    for line in lines
                    if line["variant"] == variant
                    and _rope(line) == rope
                    and isinstance(line["energy_drift"], (int, float))
                    and line["energy_drift"] > 0
                ),
                key=lambda line: line["step"],
            )
            if mine:
                panel.series.append(
                    Series(
                        variant,
                        [line["step"] for line in mine],
                        [line["energy_drift"] for line in mine],
                        report.look(run, variant),
                        hover=[_hover(line) for line in mine],
                    )
                )
        if panel.series:
            panels.append(panel)
    return Figure(
        f"motion-drift{report.key(run)}",
        "What a smaller step keeps of the energy",
        (
            "Greatest drift of the energy as a share of that at the start, on logarithmic axes; a motion that"
            " keeps its energy lies low. Where the lines of all variants coincide, the step decides and not"
            " the arithmetic."
        ),
        panels,
        columns=4 if len(panels) > 4 else 2,
    )


def _table(report, run, lines):
    rows = []
    for line in lines:
        failed = f" at {line['failed_at']:.3g}" if line.get("failed_at") is not None else ""
        rows.append(
            [
                _rope(line),
                line["variant"],
                line["outcome"] + failed,
                *[
                    _number(line.get(key))
                    for key in (
                        "step",
                        "energy_drift",
                        "deepest_penetration",
                        "contacts",
                        "missed_by_variant",
                        "invented_by_variant",
                        "missed_against_fine_step",
                        "ms_median",
                    )
                ],
            ]
        )
    return Table(
        f"motion{report.key(run)}",
        "Every motion",
        (
            "Missed and invented by the variant: against the exact reference in the same frames. Missed"
            " against the fine motion: contacts of the motion with step"
            f" {lines[0].get('reference_step', 0):g} that this one does not have."
        ),
        [
            "rope",
            "variant",
            "outcome",
            "step",
            "energy drift",
            "deepest penetration",
            "contacts",
            "missed",
            "invented",
            "missed against the fine motion",
            "ms",
        ],
        rows,
        words=3,
    )


def _number(value):
    return Cell(
        "" if value is None else words.count(value) if isinstance(value, int) else words.number(value), value
    )
