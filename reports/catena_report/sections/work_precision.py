"""Three errors apart, and what each costs: of the tube, of the arithmetic, of the answer."""
import html

from .. import statistics, words
from ..figure import Axis, Figure, Panel, Series
from ..section import Prose, Section
from ..style import Look, of_arithmetic
from ..table import Cell, Table
from . import arithmetic

def build(report):
    section = Section("work-precision", "Error against run time")
    for run in report.runs:
        bites = arithmetic.figure(report, run)
        points = [p for p in run.catena.get("work_precision", {}).get("points", []) if p.get("median_ms")]
        blocks = ([bites] if bites else []) + (
            [_figure(report, run, points), _table(report, run, points)] if points else []
        )
        out = run.catena.get("work_precision", {}).get("left_out", [])
        if blocks:
            section.blocks += report.heading(run) + blocks + ([_left_out(out)] if out else [])
    if section.blocks:
        section.blocks.insert(
            0,
            Prose(
                "Three errors, and none makes up for another. <strong>Of the tube</strong>: what a chain of"
                " spheres makes of a smooth tube; it depends on how many spheres there are and on no variant."
                " <strong>Of the arithmetic</strong>: how wrongly rounded numbers decide whether two spheres"
                " touch, and by how much bounds fall short; it starts far from the origin and for contacts near"
                " to touching. <strong>Of the answer</strong>: pairs missing and invented, and how deep the"
                " deepest of them is."
            ),
        )
    return section if section.blocks else None


def _left_out(lines):
    """Lines "variant: reason", by reason."""
    reasons = {}
    for line in lines:
        variant, _, reason = line.partition(": ")
        reasons.setdefault(reason, []).append(html.escape(variant))
    return Prose(
        f"{words.plural(len(lines), 'variant').capitalize()} left out, with the reason",
        [f"{html.escape(reason)}: {words.listed(variants)}" for reason, variants in reasons.items()],
        folded=True,
    )


def front(run, points):
    """Of the points of exact variants those that no other beats: less error of the tube and less time, beyond
    the quartiles. A rounded variant's answer may be wrong elsewhere, so it beats none.
    """
    exact = [p for p in points if run.info(p["variant"]).recommended]
    beats = lambda a, b: (  # noqa: E731
        a["tube_error"] <= b["tube_error"] and a["upper_quartile_ms"] < b["lower_quartile_ms"]
    )
    return [p for p in exact if not any(beats(other, p) for other in exact)]


def prices(run, points, wrong=False):
    """arithmetic -> [median of the exact variant over that of the same stages in it, geometric mean over the variants
    of one chain: what these share is no new evidence]. Only where the rounded one was right: one that loses pairs has
    less to do. With `wrong` only where it was not.
    """
    exact = {
        (_place(p), p["n"], run.info(p["variant"]).stages): p
        for p in points
        if run.info(p["variant"]).recommended
    }
    found = {}
    for p in points:
        info = run.info(p["variant"])
        twin = exact.get((_place(p), p["n"], info.stages))
        if info.rounded and twin and (p["answer_error"] > 0) == wrong:
            on_chain = found.setdefault(info.arithmetic, {}).setdefault((_place(p), p["n"]), [])
            on_chain.append(twin["median_ms"] / p["median_ms"])
    return {
        name: [statistics.mean_log(ratios).value for ratios in by_chain.values()] for name, by_chain in found.items()
    }


def _message(run, points):
    right, lossy = prices(run, points), prices(run, points, wrong=True)
    parts = [
        f"exact answers take {words.interval(statistics.mean_log(ratios))} times as long as {name} ones"
        + (" that are right" if name in lossy else "")
        for name, ratios in right.items()
        if len(ratios) > 1
    ]
    wrong = {}
    for p in points:
        info = run.info(p["variant"])
        if info.rounded and p["answer_error"] > 0:
            wrong[info.arithmetic] = max(wrong.get(info.arithmetic, 0), p["answer_error"])
    parts += [
        f"{name} ones get up to {100 * share:.3g} % of the pairs wrong"
        + (f", {statistics.mean_log(lossy[name]).value:.2f} times as quick where they do" if name in lossy else "")
        for name, share in wrong.items()
    ]
    if not wrong and parts:
        parts.append("no answer was wrong on these tubes")
    text = "; ".join(parts) or "Error against run time"
    return text[0].upper() + text[1:]


def _figure(report, run, points):
    best = front(run, points)
    panels = []
    for place in dict.fromkeys(_place(point) for point in points):
        mine = [point for point in points if _place(point) == place]
        on_front = sorted((p for p in best if _place(p) == place), key=lambda point: point["median_ms"])
        panels.append(_panel(report, run, mine, on_front, _tube_error, "error of the tube", f"{place}: of the tube"))
        wrong = [point for point in mine if point["answer_error"] > 0]
        if wrong:
            share = lambda p: p["answer_error"]  # noqa: E731
            panels.append(_panel(report, run, wrong, [], share, "pairs wrong, share", f"{place}: of the answer"))
        deep = [point for point in wrong if _number(point.get("depth_error"))]
        if deep:
            depth = lambda p: p["depth_error"]  # noqa: E731
            panels.append(
                _panel(report, run, deep, [], depth, "deepest wrong pair, tube radii", f"{place}: contact depth lost")
            )
    return Figure(
        f"work-precision{report.key(run)}",
        _message(run, points),
        (
            "Each point is one variant at one number of spheres; further left is faster, lower is more"
            " precise. The error of the tube falls with more spheres, the same for all variants: the line joins"
            " the points of exact variants that no other exact one beats in both. Points that are beaten, and those"
            " of rounded arithmetic, are grey: their answers are right only where no panel of the answer shows"
            " them. Far from the origin the error of the tube includes that of storing coordinates in binary32."
            " The title's ratios are of the same stages in both arithmetics, one for each chain (the geometric mean over"
            " its variants), with the 95 % t interval over the chains."
            " Bars are the quartiles of the time. A ring marks the fastest exact variant at the fewest spheres that a"
            " tolerance of the tube asks for: more of them buy what that tolerance does not need."
        ),
        panels,
        columns=min(2, len(panels)),
    )


def _number(value):
    return isinstance(value, (int, float)) and value > 0


def _tube_error(point):
    return point["tube_error"] + point.get("stored_error", 0)


def _place(point):
    return point["tube"] + (f", moved by {point['offset']:,.7g} radii" if point.get("offset") else "")


def _panel(report, run, points, on_front, error, what, title):
    panel = Panel(title, Axis("build + find, ms", log=True), Axis(f"{what}{', tube radii' if error is _tube_error else ''}", log=True), height=400)
    answer = error is not _tube_error
    plain = [
        p for p in points if not answer and p not in on_front and not run.info(p["variant"]).peer and error(p) > 0
    ]
    if plain:
        panel.series.append(
            _points(run, "beaten, or rounded", plain, error, Look("faint"), size=0.8)
        )
    for name, (look, rows) in _coloured(report, run, [p for p in points if p not in plain and error(p) > 0], answer).items():
        panel.series.append(_points(run, name, rows, error, look, size=1.25))
    for tolerance in [] if answer else sorted({p["tolerance"] for p in points if "tolerance" in p}):
        asked = [p for p in points if p.get("tolerance") == tolerance and run.info(p["variant"]).recommended]
        if asked:
            best = min(asked, key=lambda p: p["median_ms"])
            name = f"a tolerance of {tolerance:g} radii: {words.count(best['n'])} spheres"
            panel.series.append(_points(run, name, [best], error, Look("ink", "circle", hollow=True), size=2.2))
    if on_front:
        panel.series.insert(
            0,
            Series(
                "front of exact variants",
                [p["median_ms"] for p in on_front],
                [error(p) for p in on_front],
                Look("muted"),
                markers=False,
            ),
        )
    return panel


def _coloured(report, run, points, answer):
    """name -> (look, points): of the answer by arithmetic, which decides it, else by variant; peers by name."""
    found = {}
    for p in sorted(points, key=lambda p: (not run.info(p["variant"]).exact, p["variant"])):
        info = run.info(p["variant"])
        by_arithmetic = answer and not info.peer
        name = f"{info.arithmetic} arithmetic" if by_arithmetic else info.label
        look = of_arithmetic(info.arithmetic) if by_arithmetic else report.looks.variant(info)
        found.setdefault(name, (look, []))[1].append(p)
    return found


def _points(run, name, rows, error, look, size):
    return Series(
        name,
        [p["median_ms"] for p in rows],
        [error(p) for p in rows],
        look,
        line=False,
        low=[p["lower_quartile_ms"] for p in rows],
        high=[p["upper_quartile_ms"] for p in rows],
        across=True,
        hover=[_hover(run, p) for p in rows],
        size=size,
    )


def _hover(run, point):
    return (
        f"<b>{run.info(point['variant']).label}</b><br>{_place(point)}, n ="
        f" {words.count(point['n'])}<br>{words.duration(point['median_ms'])}, quartiles"
        f" {words.ms(point['lower_quartile_ms'])} to {words.ms(point['upper_quartile_ms'])} ms<br>error of"
        f" the tube {point['tube_error']:.2e}, of storing {point.get('stored_error', 0):.1e} radii<br>of the answer:"
        f" {_answer(point)}"
    )


def _answer(point):
    if "missing" not in point:
        return f"{100 * point['answer_error']:.3g} % of the pairs wrong"
    return f"{point['missing']} missing, {point['invented']} invented of {point['exact_pairs']} pairs"


def _table(report, run, points):
    """Of each place, size and arithmetic the worst of its variants; peers by their own names."""
    rows, groups = [], {}
    for p in points:
        info = run.info(p["variant"])
        groups.setdefault((_place(p), p["n"], info.label if info.peer else info.arithmetic), []).append(p)
    for (place, n, name), mine in groups.items():
        worst = max(mine, key=lambda p: p["answer_error"])
        fastest = min(mine, key=lambda p: p["median_ms"])
        rows.append(
            [
                place,
                name,
                Cell(words.count(n), n),
                *[
                    Cell("" if value is None else words.number(value), value)
                    for value in (worst["tube_error"], worst.get("stored_error"), worst.get("worst_margin"))
                ],
                Cell(f"{100 * worst['answer_error']:.3g} %", worst["answer_error"]),
                *[_cell(worst.get(key)) for key in ("exact_pairs", "missing", "invented", "depth_error")],
                Cell(words.ms(fastest["median_ms"]), fastest["median_ms"], hint=fastest["variant"]),
            ]
        )
    columns = [
        "tube", "arithmetic", "n", "of the tube", "of storing", "worst margin decided wrongly", "pairs wrong",
        "pairs", "missing", "invented", "deepest wrong pair", "fastest, ms",
    ]
    kept = [at for at in range(len(columns)) if any(row[at] if isinstance(row[at], str) else row[at].text for row in rows)]
    return Table(
        f"errors-apart{report.key(run)}",
        "The three errors apart, and the time",
        (
            "Of each arithmetic the variant with the most wrong pairs, and the least median time of any (its hint"
            " names whose). In tube radii: the gap between tube and spheres, the farthest a stored centre is from"
            " its place, and of the pairs missing the deepest, of those invented the one farthest apart. The margin"
            " is |q - t| / t of the worst wrong decision."
        ),
        [columns[at] for at in kept],
        [[row[at] for at in kept] for row in rows],
        words=2,
    )


def _cell(value):
    if value is None:
        return Cell("")
    return Cell(words.count(value) if isinstance(value, int) else words.number(value), value)
