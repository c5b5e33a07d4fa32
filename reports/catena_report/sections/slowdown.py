"""All chains together: performance profiles, and the geometric mean of slowdowns."""
import dataclasses

from .. import choice, profiles, words
from ..figure import Axis, Figure, Panel, Series
from ..section import Prose, Section
from ..style import Look
from ..table import Cell, Table

SHOWN = 6  # curves drawn at first; the legend has the others
LISTED = 12  # rows of the right panel
FEWEST = 3  # chains, below which a t interval over them says nothing
FARTHEST = 100  # times the fastest, where the curves' axis ends


def build(report):
    section = Section("slowdown", "All chains together")
    for run in report.runs:
        found = profiles.slowdowns(run)
        if not found or next(iter(found.values())).chains < 2:
            continue
        test = profiles.rank_test(run, found)
        section.blocks += report.heading(run) + [_figure(report, run, found)]
        if test:
            said = profiles.in_words(test)
            section.blocks.append(Prose(said[0].upper() + said[1:] + "."))
        section.blocks.append(_table(report, run, found))
    return section if section.blocks else None


def headline(run):
    """(the variant of the least mean slowdown over all chains, its Slowdown, [others whose intervals begin
    below the end of its own]), or None.
    """
    found = {
        name: slow for name, slow in profiles.slowdowns(run).items()
        if run.info(name).recommended and slow.chains >= FEWEST and len(slow.ratios) == slow.chains
    }
    if not found:
        return None
    name, slow = next(iter(found.items()))
    near = [other for other, its in found.items() if other != name and its.mean.low <= slow.mean.high]
    return name, slow, near


def _figure(report, run, found):
    key = [name for name in found if run.info(name).peer or name == choice.PAPERS]
    first = list(dict.fromkeys(list(found)[:SHOWN] + key))
    farthest = min(FARTHEST, max(max(found[name].ratios.values()) for name in first) * 1.05)
    curves = Panel(
        "share of chains within a factor of the fastest",
        Axis("times the fastest of the chain", log=True, range=(0.97, farthest)),
        Axis("share of chains", range=(-0.02, 1.04)),
        height=380,
    )
    for name, slow in found.items():
        x, y = _steps(profiles.profile(slow), farthest)
        look = report.look(run, name)
        curves.series.append(
            Series(
                run.info(name).label,
                x,
                y,
                look,
                size=0.7,
                shown=name in first,
                hover=[f"<b>{run.info(name).label}</b><br>{words.percent(round(b * slow.chains), slow.chains, 0)} of chains within {a:.3g} times" for a, b in zip(x, y)],
            )
        )
    rows = list(dict.fromkeys(list(found)[:LISTED] + key))
    means = Panel(
        "geometric mean of the slowdowns",
        Axis("times the fastest, mean over chains", log=True),
        Axis("", categories=[run.info(name).label for name in rows]),
        height=max(380, 90 + 24 * len(rows)),
    )
    for at, name in enumerate(rows):
        slow = found[name]
        whole = len(slow.ratios) == slow.chains
        look = report.look(run, name)
        means.series.append(
            Series(
                run.info(name).label,
                [slow.mean.value],
                [at],
                look if whole else Look("faint", look.marker, look.dash, True),
                line=False,
                size=1.3,
                low=[max(1.0, slow.mean.low)] if len(slow.ratios) >= FEWEST else None,
                high=[slow.mean.high] if len(slow.ratios) >= FEWEST else None,
                across=True,
                legend=False,
                hover=[
                    f"<b>{run.info(name).label}</b><br>{mean_text(slow)} times the fastest,"
                    f" {len(slow.ratios)} of {slow.chains} chains"
                ],
            )
        )
    return Figure(
        f"slowdown{report.key(run)}",
        _message(run),
        (
            "Left, performance profiles (Dolan and More 2002): how many of the chains a variant solves within so"
            " many times the time of the fastest on each, end to end. Higher is better; at 1 it is the share of"
            " chains on which it is the fastest; a chain that it was not timed on is never reached. Right: the"
            " geometric mean of these factors with its 95 % t interval over the chains; grey and hollow where"
            " some chain is missing, whose mean is over the others only. The chains are those of this run: of"
            " other scenes the order may be another."
        ),
        [curves, means],
    )


def _steps(points, farthest):
    x, y, level = [1.0], [0.0], 0.0
    for tau, share in points:
        if tau > farthest:
            break
        x += [tau, tau]
        y += [level, share]
        level = share
    return x + [farthest], y + [level]


def mean_text(slow):
    """1.13 [1.00, 1.41]: no slowdown is below 1, so neither is the end of its interval."""
    if len(slow.ratios) < FEWEST:
        return f"{slow.mean.value:.2f}"
    mean = slow.mean
    return words.interval(dataclasses.replace(mean, low=max(1.0, mean.low)))


def _message(run):
    found = headline(run)
    if not found:
        return "Too few chains, or none that every variant was timed on: no order over all of them"
    name, slow, near = found
    return (
        f"Over {slow.chains} chains {name} takes {mean_text(slow)} times the fastest of each"
        + beside(run, name, near)
    )


def beside(run, name, near):
    """How what headline() found stands among those that it is compared with, exact variants of catena's timed on all
    chains, and which peers take less.
    """
    found = profiles.slowdowns(run)
    whole = lambda other: len(found[other].ratios) == found[other].chains  # noqa: E731
    text = f"; the intervals of {words.listed(near, 3)} overlap its own"
    if not near:
        partial = any(run.info(other).recommended and not whole(other) for other in found)
        text = ", less than any other exact variant of catena's that was timed" + (" on all" if partial else "")
    quicker = [
        f"{other} {mean_text(slow)}" for other, slow in found.items()
        if run.info(other).peer and whole(other) and slow.mean.value < found[name].mean.value
    ]
    return text + (f"; of the peers {words.listed(quicker, 3)}" if quicker else "")


def _table(report, run, found):
    return Table(
        f"slowdown{report.key(run)}",
        "Slowdown of every variant over all chains",
        (
            "End to end. Geometric mean of the time over the least time of each chain, with its 95 % t interval;"
            " the least and the greatest of these factors; the share of chains within 10 % of the fastest and"
            " within twice its time."
        ),
        ["variant", "chains timed", "mean slowdown", "least", "greatest", "within 10 %", "within twice"],
        [
            [
                run.info(name).label,
                Cell(f"{len(slow.ratios)} of {slow.chains}", len(slow.ratios)),
                Cell(mean_text(slow), slow.mean.value),
                Cell(f"{min(slow.ratios.values()):.2f}", min(slow.ratios.values())),
                Cell(words.significant(max(slow.ratios.values()), 3), max(slow.ratios.values())),
                *[_within(slow, factor) for factor in (1.1, 2)],
            ]
            for name, slow in found.items()
        ],
    )


def _within(slow, factor):
    within = sum(ratio <= factor for ratio in slow.ratios.values())
    return Cell(words.percent(within, slow.chains, 0), within / slow.chains)
