"""Which variant in which arithmetic stays exact on which stiff or extreme scene."""
import shlex

from .. import words
from ..figure import Axis, Figure, Heat, Line, Panel
from ..section import Prose, Section
from ..style import DASHES
from ..table import Cell, Table

ROUNDING = 1e-12  # of the parent: a bound short by less encloses but for the last bits of binary64
LARGE = 1e-6  # short by more than the last bits of binary32
# how a case is drawn, from best to worst: pairs lead, then counts, then enclosure by how much it is missed
CATEGORIES = [
    ("exact, every bound encloses", "good"),
    (f"right; a bound short by < {ROUNDING:g}", "fair"),
    ("right; a bound short by more", "warn"),
    ("right; a bound is not a number", "c4"),
    ("right pairs, wrong counts", "c5"),
    ("wrong pairs", "bad"),
    ("refused or undecided, with a reason", "none"),
]
ENCLOSURE = (
    "all bounds enclose",
    f"short by < {ROUNDING:g}",
    f"short by < {LARGE:g}",
    "short by more",
    "not a number",
)
LABEL = 24  # characters of a scene's name beside its row
NOT_ANSWERED = ("refused", "unavailable", "undecided")


def wrong_pairs(line):
    return bool(line.get("missing", 0) or line.get("invented", 0))


def wrong_counts(line):
    return bool(line.get("wrong_counts", 0))


def enclosure(line):
    """The index in ENCLOSURE: by how much of the parent the worst bound misses what it should enclose."""
    short = line.get("worst_shortfall", 0)
    if line.get("not_finite_nodes", 0) or not isinstance(short, (int, float)):
        return 4
    return 0 if not line.get("unenclosed", 0) else 1 if short < ROUNDING else 2 if short < LARGE else 3


def category(line):
    """The index in CATEGORIES."""
    if line["outcome"] in NOT_ANSWERED:
        return 6
    if wrong_pairs(line) or wrong_counts(line):
        return 5 if wrong_pairs(line) else 4
    return (0, 1, 2, 2, 3)[enclosure(line)]


def build(report):
    section = Section("stability", "Stability on stiff and extreme scenes")
    for run in report.having("stability"):
        lines = run.list("stability")
        section.blocks += report.heading(run) + [_intro(lines), _table(report, run), _figure(report, run, lines)]
    return section if section.blocks else None


def group(run, line):
    """What a cell is counted under: its arithmetic; of a peer, its own name."""
    info = run.info(line["variant"])
    return info.label if info.peer else f"{info.arithmetic} arithmetic"


def answers(run):
    """group -> the lines that it did not refuse, the exact ones first."""
    found = {}
    for line in sorted(run.list("stability"), key=lambda line: _order(run.info(line["variant"]))):
        mine = found.setdefault(group(run, line), [])
        if line["outcome"] not in NOT_ANSWERED:
            mine.append(line)
    return found


def right(lines):
    """How many of the lines have the right pairs."""
    return sum(not wrong_pairs(line) for line in lines)


def _intro(lines):
    return Prose(
        f"{words.plural(len({line['scene'] for line in lines}), 'scene')}, each hard for a stated reason"
        " (tiny margins, huge offsets, mixed scales, coincident spheres), each variant held against the"
        " exact reference: are the pairs right; the counts; does each bound of its tree enclose what is below"
        " it, and by how much of the bound does it fall short? Pairs may be right by luck where bounds fall"
        " short."
    )


def _table(report, run):
    rows = []
    for name, lines in answers(run).items():
        if not lines:
            continue
        trees = [line for line in lines if line.get("bounds", 0) or line.get("not_finite_nodes", 0)]
        sizes = [sum(enclosure(line) == size for line in trees) for size in range(len(ENCLOSURE))]
        rows.append(
            [
                name,
                Cell(words.count(len(lines)), len(lines)),
                _share(right(lines), len(lines)),
                _share(sum(not wrong_counts(line) for line in lines), len(lines)),
                Cell(words.count(sum(line.get("missing", 0) for line in lines))),
                Cell(words.count(sum(line.get("invented", 0) for line in lines))),
                Cell(words.count(len(trees)), len(trees)),
                *[_share(size, len(trees)) for size in sizes],
            ]
        )
    return Table(
        f"stability-shares{report.key(run)}",
        "Right pairs, right counts, and how far bounds fall short",
        (
            "Shares of the cases that were answered. Of the cases with a tree: the worst bound, by how much of"
            " its own radius it falls short of what it should enclose."
        ),
        [
            "arithmetic", "cases", "right pairs", "right counts", "pairs missing", "pairs invented",
            "cases with a tree", *ENCLOSURE,
        ],
        rows,
    )


def _share(number, of):
    return Cell(words.percent(number, of) if of else "", number / of if of else None)


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
        common,
        Axis("", categories=[run.info(variant).algorithms if variant else "" for variant in columns]),
        Axis("", categories=_narrow(labels)),
        lines=starts,
        height=15 * len(scenes) + 190,
        least=10 * len(columns) + 240,
        heat=Heat(
            [[category(line) if line else None for line in row] for row in rows],
            CATEGORIES,
            [[_hover(line) if line else "" for line in row] for row in rows],
            [[_chain(report, run, line) if line else None for line in row] for row in rows],
        ),
    )
    wrong = [line for line in lines if wrong_pairs(line)]
    exact = sum(run.info(line["variant"]).exact for line in wrong)
    left = "".join(
        f" Left out, since refused on every scene: {words.listed(names)} ({reason})."
        for reason, names in refusing.items()
    )
    return Figure(
        f"stability{report.key(run)}",
        (
            f"Wrong pairs in {len(wrong):,} of {words.count(len(lines))} cases,"
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
    """The title and the scenes' labels, the n that all have in common in the title."""
    ns = {line["n"] for line in lines}
    if len(ns) != 1:
        return "", scenes
    n = next(iter(ns))
    return f"scenes of {words.count(n)} spheres", [
        scene.replace(f":n={n},", ":").replace(f":n={n}", "").replace(f",n={n}", "") for scene in scenes
    ]


def _narrow(labels):
    """Cut where they stay apart, so that on a phone cells are in sight; hovering tells the whole."""
    cut = [label if len(label) <= LABEL else label[: LABEL - 1] + "…" for label in labels]
    return [short if cut.count(short) == 1 else label for short, label in zip(cut, labels)]


def _hover(line):
    text = f"<b>{line['variant']}</b><br>{line['scene']}<br>{line['outcome']}" + (
        f": {line['reason']}" if line.get("reason") else ""
    )
    if wrong_pairs(line):
        text += (
            f"<br>{line.get('missing', 0)} missing, {line.get('invented', 0)} invented of"
            f" {line['exact_pairs']} pairs<br>worst margin"
            f" {words.number(line.get('worst_margin', 'unknown'))}"
        )
    return text


def _chain(report, run, line):
    command = f"catena verify {shlex.quote(line['scene'])} --variant {shlex.quote(line['variant'])}"
    return report.chain(run, line["scene"], command=command)
