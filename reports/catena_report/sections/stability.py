"""Which variant in which arithmetic stays exact on which stiff or extreme scene."""
import html

from .. import words
from ..figure import Axis, Figure, Heat, Line, Panel
from ..section import Prose, Section
from ..style import DASHES

CATEGORIES = [
    ("exact", "good"),
    ("exact pairs, bounds do not enclose", "warn"),
    ("wrong pairs or counts", "bad"),
    ("not finite", "lost"),
    ("refused, with a reason", "none"),
]
OUTCOMES = {"exact": 0, "unenclosed": 1, "wrong": 2, "not finite": 3, "refused": 4}


def build(report):
    section = Section("stability", "Stability on stiff and extreme scenes")
    for run in report.having("stability"):
        lines = run.list("stability")
        section.blocks += report.heading(run) + [_summary(run, lines), _figure(report, run, lines)]
    return section if section.blocks else None


def group(run, line):
    """What a cell is counted under: its arithmetic; of a peer, its own name."""
    info = run.info(line["variant"])
    return info.label if info.peer else f"{info.arithmetic} arithmetic"


def tally(run):
    """group -> outcome -> how often, the exact ones first"""
    found = {}
    for line in sorted(run.list("stability"), key=lambda line: _order(run.info(line["variant"]))):
        row = found.setdefault(group(run, line), {})
        row[line["outcome"]] = row.get(line["outcome"], 0) + 1
    return found


def _summary(run, lines):
    points = []
    for name, outcomes in tally(run).items():
        tried = sum(number for outcome, number in outcomes.items() if outcome != "refused")
        points.append(
            f"<strong>{html.escape(name)}</strong>: "
            + words.listed(
                f"{number} {html.escape(outcome)}"
                for outcome, number in sorted(outcomes.items(), key=lambda item: OUTCOMES.get(item[0], 9))
            )
            + (
                f"; exact in {100 * outcomes.get('exact', 0) / tried:.1f} % of what it did not refuse."
                if tried
                else "."
            )
        )
    return Prose(
        (
            f"{words.plural(len({line['scene'] for line in lines}), 'scene')}, each hard for a stated reason"
            " (tiny margins, huge offsets, mixed scales, coincident spheres), each variant held against the"
            " exact reference."
        ),
        points,
    )


def _figure(report, run, lines):
    cell = {(line["scene"], line["variant"]): line for line in lines}
    scenes = list(dict.fromkeys(line["scene"] for line in lines))
    groups, refusing = {}, {}
    infos = [run.info(name) for name in {line["variant"] for line in lines}]
    for info in sorted(infos, key=lambda info: (_order(info), info.traversal.text, info.name)):
        variant = info.name
        mine = [line for line in lines if line["variant"] == variant]
        if all(line["outcome"] == "refused" for line in mine):
            refusing.setdefault(mine[0].get("reason", "no reason given"), []).append(variant)
        else:
            groups.setdefault("peers" if info.peer else info.arithmetic, []).append(variant)
    columns, starts = [], []
    for name, variants in groups.items():
        columns += [None] if columns else []
        starts.append(Line(len(columns) - 0.5, label=name))
        columns += variants
    rows = [[cell.get((scene, variant)) for variant in columns] for scene in scenes]
    common, labels = _short(lines, scenes)
    panel = Panel(
        "",
        Axis("", categories=[run.info(variant).algorithms if variant else "" for variant in columns]),
        Axis(common, categories=labels),
        lines=starts,
        height=15 * len(scenes) + 190,
        least=13 * len(columns) + 240,
        heat=Heat(
            [[OUTCOMES.get(line["outcome"]) if line else None for line in row] for row in rows],
            CATEGORIES,
            [[_hover(line) if line else "" for line in row] for row in rows],
            [[_chain(report, run, line) if line else None for line in row] for row in rows],
        ),
    )
    wrong = [line for line in lines if line["outcome"] in ("wrong", "not finite")]
    exact = sum(run.info(line["variant"]).exact for line in wrong)
    left = "".join(
        f" Left out, since refused on every scene: {words.listed(names)} ({reason})."
        for reason, names in refusing.items()
    )
    return Figure(
        f"stability{report.key(run)}",
        (
            f"{words.plural(len(wrong), 'wrong or not finite answer')} in {words.count(len(lines))} cases,"
            f" {exact or 'none'} of them of an exact variant"
        ),
        (
            "One row for each scene, one column for each variant, grouped by arithmetic, peers last. Hover for"
            " what is wrong and by how much: the worst margin is the largest relative distance from touching, |q -"
            f" t| / t, of a pair that was missed or invented. Click for the command that replays it.{left}"
        ),
        [panel],
        columns=1,
    )


def _order(info):
    """Of groups: exact first, rounded next in the order of the paper, peers last."""
    known = list(DASHES)
    return info.peer, known.index(info.arithmetic) if info.arithmetic in known else len(known)


def _short(lines, scenes):
    """The axis' title and the scenes' labels, the n that all have in common in the title."""
    ns = {line["n"] for line in lines}
    if len(ns) != 1:
        return "", scenes
    n = next(iter(ns))
    return f"scene, n = {words.count(n)}", [
        scene.replace(f":n={n},", ":").replace(f":n={n}", "").replace(f",n={n}", "") for scene in scenes
    ]


def _hover(line):
    text = f"<b>{line['variant']}</b><br>{line['scene']}<br>{line['outcome']}" + (
        f": {line['reason']}" if line.get("reason") else ""
    )
    if line.get("missing") or line.get("invented"):
        text += (
            f"<br>{line.get('missing', 0)} missing, {line.get('invented', 0)} invented of"
            f" {line['exact_pairs']} pairs<br>worst margin"
            f" {words.number(line.get('worst_margin', 'unknown'))}"
        )
    return text


def _chain(report, run, line):
    command = f"catena verify '{line['scene']}' --variant '{line['variant']}'"
    return report.chain(run, line["scene"], command=command)
