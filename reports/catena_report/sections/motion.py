"""The stiff rope: which step each variant survives, and what it costs (the lines of `catena motion
--json`).
"""
import html

from .. import statistics, words
from ..figure import Axis, Figure, Heat, Panel, Series
from ..section import Prose, Section
from ..style import of_arithmetic
from ..table import Cell, Table

CATEGORIES = [("holds", "good"), ("slips through itself", "bad"), ("diverges", "lost")]
OUTCOMES = {"holds": 0, "slipped": 1, "diverged": 2}


def build(report):
    section = Section("motion", "A stiff rope in motion")
    for run in report.having("motion"):
        lines = run.list("motion")
        section.blocks += report.heading(run) + [
            _verdicts(run, lines),
            *([_shares(report, run, lines)] if any(line.get("starts") for line in lines) else []),
            _outcomes(report, run, lines),
            *([_drift(report, run, lines)] if len({line["step"] for line in lines}) > 1 else []),
            _table(report, run, lines),
        ]
    return section if section.blocks else None


def failing(line):
    """The share of a motion's perturbed starts from which it slips or diverges, or None without starts."""
    starts = line.get("starts")
    if not starts:
        return None
    return statistics.share(sum(start["outcome"] != "holds" for start in starts), len(starts))


def faults(run, lines):
    """[(line of a rounded variant, the exact one of the same motion, whether its arithmetic is at fault)]: only
    where more of its starts fail and the intervals part.
    """
    motion = lambda line: tuple(line.get(key) for key in ("stiffness", "step", "offset", "n"))  # noqa: E731
    exact = {motion(line): line for line in lines if run.info(line["variant"]).exact and line.get("starts")}
    found = []
    for line in lines:
        twin = exact.get(motion(line))
        if twin and run.info(line["variant"]).rounded and line.get("starts"):
            found.append((line, twin, failing(line).low > failing(twin).high))
    return found


def _percent(share):
    return f"{100 * share.value:.0f} % [{100 * share.low:.0f}, {100 * share.high:.0f}]"


def _verdicts(run, lines):
    found = faults(run, lines)
    if not found:
        return Prose(
            "Near a knife edge a motion slips or holds by chance, whatever the arithmetic: this run has one start of"
            " each motion, so <strong>no arithmetic is called at fault</strong>. What can be told from one start is"
            " what a variant missed and invented on the chains it was given, in the table below."
        )
    count = lambda line, key: sum(start[key] for start in line["starts"])  # noqa: E731
    points = [
        f"<strong>{html.escape(line['variant'])}</strong>, {_rope(line)}, step {line['step']:g}: fails from"
        f" {_percent(failing(line))} of {len(line['starts'])} starts, {html.escape(twin['variant'])} from"
        f" {_percent(failing(twin))}; "
        + ("its arithmetic is at fault" if fault else "the intervals overlap: no verdict")
        + f". It missed {count(line, 'missed'):,} and invented {count(line, 'invented'):,} of"
        f" {count(line, 'contacts'):,} contacts."
        for line, twin, fault in found
    ]
    return Prose(
        "Each motion is begun from perturbed starts, for near a knife edge a single one slips or holds by chance. An"
        " arithmetic is at fault only where the 95 % interval of its share of failing starts lies above that of the"
        " exact variant.",
        points,
    )


def _shares(report, run, lines):
    mine = sorted(
        (line for line in lines if line.get("starts")),
        key=lambda line: (line["stiffness"], line.get("offset", 0), line["step"], not run.info(line["variant"]).exact),
    )
    names = [f"{_rope(line)}, step {line['step']:g}: {line['variant']}" for line in mine]
    panel = Panel(
        "",
        Axis("share of the starts that slip or diverge", range=(-0.02, 1.02)),
        Axis("", categories=names),
        height=110 + 24 * len(names),
        least=480,
    )
    for arithmetic in dict.fromkeys(run.info(line["variant"]).arithmetic for line in mine):
        rows = [at for at, line in enumerate(mine) if run.info(line["variant"]).arithmetic == arithmetic]
        shares = [failing(mine[at]) for at in rows]
        panel.series.append(
            Series(
                f"{arithmetic} arithmetic",
                [share.value for share in shares],
                rows,
                of_arithmetic(arithmetic),
                line=False,
                size=1.3,
                across=True,
                low=[share.low for share in shares],
                high=[share.high for share in shares],
                hover=[
                    f"<b>{names[at]}</b><br>{_percent(share)} of {len(mine[at]['starts'])} starts fail"
                    for at, share in zip(rows, shares)
                ],
            )
        )
    blamed = [line for line, _, fault in faults(run, lines) if fault]
    return Figure(
        f"motion-shares{report.key(run)}",
        (
            "The arithmetic is at fault in "
            + words.listed(
                (f"{run.info(line['variant']).arithmetic} at {_rope(line)}, step {line['step']:g}" for line in blamed), 3
            )
            if blamed
            else "No arithmetic fails from more starts than the exact one, beyond the intervals"
        ),
        (
            "Each row is one motion from several perturbed starts with one variant finding its contacts: the share of"
            " starts from which the rope slips through itself or a step has no solution, with Wilson's 95 % interval."
        ),
        [panel],
        columns=1,
    )


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
    of = "first starts of motions" if any(line.get("starts") for line in lines) else "motions"
    return Figure(
        f"motion-outcome{report.key(run)}",
        f"The rope holds in {len(held)} of {len(lines)} {of}",
        (
            "A knotted rope is pulled tight; each cell is one motion with one variant finding its contacts."
            " To the right the time step is smaller. It slips through itself where the knot has become"
            " another one; an exact variant can fail only because the step is too long, or by chance at a knife edge."
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
