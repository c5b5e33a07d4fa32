"""Construction and traversal times over n, with their spread and the fitted exponent."""
import numpy

from .. import runfile, statistics, words
from ..figure import Axis, Figure, Panel, Series
from ..section import Section
from ..table import Cell, Table

STAGES = {
    "build": "construction",
    "update": "update of a moved frame",
    "find": "traversal",
    "whole": "whole call",
    "resident": "search of a chain that stays on the device",
}
OF_CONSTRUCTIONS = ("build", "update")  # what a construction does, whatever the traversal
EACH = ", for each sphere"  # ends the title of a panel of times a sphere
SHOWN = 12  # series drawn at first; the legend has the others


def build(report):
    section = Section("times", "Times")
    for run in report.runs:
        sizes = report.sizes(run)
        scenes = {scene: inputs for scene, inputs in sizes.items() if len(inputs) > 1}
        if not sizes:
            continue
        section.blocks += report.heading(run)
        if scenes:
            section.title = "Times over the number of spheres"
        for stage in STAGES:
            figure = _figure(report, run, scenes, stage)
            if figure:
                section.blocks.append(figure)
        for table in (exponents(report, run, scenes), _of_one_length(report, run, sizes)):
            if table.rows:
                section.blocks.append(table)
    return section if section.blocks else None


def curves(run, inputs, stage):
    """label -> [(input, one of its variants, samples)]: constructions are pooled over the traversals that
    they were measured with.
    """
    found = {}
    for input_ in inputs:
        pooled = {}
        for (name, variant, measured), times in run.samples.items():
            if name == input_ and measured == stage:
                info = run.info(variant)
                label = info.construction_label() if stage in OF_CONSTRUCTIONS else info.label
                pooled.setdefault(label, []).append((variant, times))
        for name, several in pooled.items():
            found.setdefault(name, []).append(
                (input_, several[0][0], numpy.concatenate([times for _, times in several]))
            )
    return found


def _look(report, info, stage):
    return report.looks.construction(info) if stage in OF_CONSTRUCTIONS else report.looks.variant(info)


def _figure(report, run, scenes, stage):
    panels, order, infos = [], {}, {}
    drawn = {scene: curves(run, inputs, stage) for scene, inputs in scenes.items()}
    drawn = {scene: found for scene, found in drawn.items() if found}  # not every scene is updated
    for found in drawn.values():
        for name, points in found.items():
            order.setdefault(name, []).append(float(numpy.median(points[-1][2])))
            infos[name] = run.info(points[0][1])
    if not order:
        return None
    ranked = sorted(
        order,
        key=lambda name: (
            not infos[name].peer,  # a general library first: without one, fastest is no conclusion
            not infos[name].exact,
            -sum(len(found.get(name, ())) for found in drawn.values()),
            min(order[name]),
        ),
    )
    shown = set(ranked[:SHOWN])
    if stage not in OF_CONSTRUCTIONS:
        shown = {name for name in shown if infos[name].exact} or shown
    shown |= {name for name in ranked if infos[name].peer}
    for scene, found in drawn.items():
        for title, unit, each in ((scene, "ms", False), (f"{scene}{EACH}", "ns a sphere", True)):
            panel = Panel(title, Axis("spheres n", log=True), Axis(f"{STAGES[stage]}, {unit}", log=True))
            for name in ranked:
                if name in found:
                    panel.series.append(_series(report, run, name, found[name], stage, name in shown, each))
            panels.append(panel)
    return Figure(
        f"times-{stage}{report.key(run)}",
        _message(run, drawn, stage),
        (
            "Left milliseconds, right nanoseconds a sphere, where a level line is linear time. Both axes are"
            " logarithmic: a straight line is a power of n, a parallel shift a constant factor."
            " Points are medians, bars their 95 % interval by order statistics (the range below six"
            " repetitions). "
            + (
                "One line for each construction, pooled over the traversals it was measured with. "
                if stage in OF_CONSTRUCTIONS
                else ""
            )
            + "Hollow markers are device algorithms run on the host; a peer is somebody else's library."
        ),
        panels,
    )


def _series(report, run, name, points, stage, shown, each):
    """The medians of a curve; with `each` in nanoseconds a sphere."""
    estimates = [statistics.median(times) for _, _, times in points]
    scales = [1e6 / runfile.n_of(input_) if each else 1.0 for input_, _, _ in points]
    return Series(
        name,
        [runfile.n_of(input_) for input_, _, _ in points],
        [e.value * scale for e, scale in zip(estimates, scales)],
        _look(report, run.info(points[0][1]), stage),
        low=None if each else [e.low for e in estimates],
        high=None if each else [e.high for e in estimates],
        shown=shown,
        hover=[
            f"<b>{name}</b><br>{input_}<br>{words.duration_interval(e)}"
            f", {words.plural(len(times), 'repetition')}"
            f"<br>{words.significant(1e6 * e.value / runfile.n_of(input_), 3)} ns a sphere"
            for (input_, _, times), e in zip(points, estimates)
        ],
        chains=[report.chain(run, input_, variant) for input_, variant, _ in points],
    )


def _message(run, drawn, stage):
    """Who is fastest at the largest n of each scene, where the samples can tell, and there was someone to beat."""
    wins, open_ = {}, []
    for scene, found in drawn.items():
        timed = {}
        for name, points in found.items():
            for input_, variant, samples in points:
                if run.info(variant).recommended:
                    timed.setdefault(runfile.n_of(input_), {})[name] = samples
        rivals = [n for n, those in timed.items() if len(those) > 1]
        if rivals:
            last = timed[max(rivals)]
            leader, alike = statistics.best(last)
            (open_ if alike else wins.setdefault(leader, [])).append(scene)
    parts = [
        f"{name} is fastest on {words.listed(scenes, 3)}"
        for name, scenes in sorted(wins.items(), key=lambda item: -len(item[1]))
    ]
    parts += [f"no single fastest on {words.listed(open_, 3)}"] if open_ else []
    return (
        f"{STAGES[stage].capitalize()} at the largest n: " + words.listed(parts, 4)
        if parts
        else f"{STAGES[stage].capitalize()} times"
    )


def _of_one_length(report, run, sizes):
    """Chains of whose scene no other length was timed, such as a file: no figure has them."""
    timed = {}  # (input, variant) -> stage -> its median
    for input_, variant, stage in run.samples:
        if len(sizes[runfile.scene_of(input_)]) == 1:
            timed.setdefault((input_, variant), {})[stage] = report.median(run, input_, variant, stage)
    stages = [stage for stage in STAGES if any(stage in found for found in timed.values())]
    slowest = lambda found: max(estimate.value for estimate in found.values())  # noqa: E731
    rows = [
        [
            *case,
            *[
                Cell(f"{words.ms(e.value)} [{words.ms(e.low)}, {words.ms(e.high)}]", e.value)
                if (e := found.get(stage)) else ""
                for stage in stages
            ],
        ]
        for case, found in sorted(timed.items(), key=lambda item: (item[0][0], slowest(item[1]), item[0][1]))
    ]
    return Table(
        f"times{report.key(run)}",
        "Times of chains of which one length was timed",
        (
            "Median milliseconds with their 95 % interval by order statistics (the range below six repetitions),"
            " the quickest of each chain first, by the longest that is shown. Peers and rounded arithmetic are among"
            " them; of a variant that was refused there is none."
        ),
        ["chain", "variant", *[f"{STAGES[stage]}, ms" for stage in stages]],
        rows,
        words=2,
    )


def exponents(report, run, scenes):
    """time = a n^b for every curve with statistics.FEWEST_SIZES or more."""
    rows = []
    names = list(scenes)
    for stage in STAGES:
        drawn = {scene: curves(run, inputs, stage) for scene, inputs in scenes.items()}
        for name in sorted({name for found in drawn.values() for name in found}):
            fits = [
                statistics.exponent(
                    [runfile.n_of(p[0]) for p in drawn[scene].get(name, [])],
                    [numpy.median(p[2]) for p in drawn[scene].get(name, [])],
                )
                for scene in names
            ]
            if any(fits):
                rows.append([Cell(STAGES[stage]), Cell(name)] + [_fit(fit) for fit in fits])
    return Table(
        f"exponents{report.key(run)}",
        "Fitted exponents: time grows as n to the power of",
        (
            "Least squares on the logarithms of the medians over all sizes, with the 95 % t interval. 1 is"
            " linear, 2 quadratic; an exponent far below 1 says that fixed costs still dominate at these"
            " sizes, and a power law whose interval is wider than 1 is marked as open."
        ),
        ["stage", "algorithm", *names],
        rows,
        words=2,
    )


def _fit(fit):
    if not fit:
        return Cell("")
    if fit.high - fit.low > 1:
        return Cell(f"{fit.value:.2f}, open", fit.value, "open", words.interval(fit))
    return Cell(words.interval(fit), fit.value)
