"""Which variant to use: by what a caller waits for, over the number of spheres and the density of contacts."""
from .. import choice, runfile, spans, waits, words
from ..figure import Axis, Figure, Panel, Series
from ..section import Prose, Section
from ..style import Look
from ..table import Cell, Table

FLOOR = 1e-6  # where a chain without pairs is drawn on the logarithmic axis

# what is waited for -> (its samples, the title of its panel)
VIEWS = {
    "end to end": (waits.end_to_end, "end to end: a chain in the host's memory, seen once"),
    "on the device": (waits.resident, "device-resident: chain and answer stay there"),
    "moving": (waits.moving, "a chain that moves: update + find of a frame"),
}


def build(report):
    section = Section("advice", "Which variant should I use?")
    informed = {
        name: report.best_informed({run: cases_of(run) for run in report.runs}) for name, (cases_of, _) in VIEWS.items()
    }
    for run in report.runs:
        views = {name: cases for name, (cases_of, _) in VIEWS.items() if choice.choose(run, cases := cases_of(run))}
        if not views:
            continue
        panels = [_panel(report, run, cases, VIEWS[name][1]) for name, cases in views.items()]
        section.blocks += report.heading(run) + [
            Figure(
                f"advice{report.key(run)}",
                _message(run, *next(iter(views.items()))),
                (
                    _elsewhere(views, {name: informed[name][run] for name in views})
                    + "Each point is a chain that was timed: right is longer, up has more contacts (chains"
                    " without any lie at the bottom; chains that would coincide are set side by side). Its"
                    " colour and marker are the variant with the least median; a grey ring says that at least"
                    " one other variant is as good: it does not differ from it significantly (Mann-Whitney with Holm's"
                    " correction; overlapping ranges where the repetitions are too few for it, within a"
                    " factor of 2 below three), or the interval of the ratio holds 1: hover for which, and take either. Exact variants"
                    " of catena's own only."
                ),
                panels,
            ),
            _table(report, run, views),
        ]
    if section.blocks:
        section.blocks.insert(0, Prose(_views_explained(report)))
    return section if section.blocks else None


def _views_explained(report):
    timed = any(case[2] == "resident" for run in report.runs for case in run.samples)
    device = (
        "the search enqueued on the device as one piece"
        if timed
        else "construction and traversal by the device's clock"
    )
    return (
        "<strong>End to end</strong> is the wall time of one call, from a chain in the host's memory to its"
        " collisions there, with every move between memories: take this unless your chain lives on a device."
        f" <strong>On the device</strong> is what remains when chain and answer stay there ({device}, without"
        " any transfer): it is no answer to the first question."
    )


def _panel(report, run, cases, title):
    panel = Panel(
        title, Axis("spheres n", log=True), Axis("contact density, pairs a sphere", log=True), height=380
    )
    choices = choice.choose(run, cases)
    points, places = {}, _beside(run, choices)
    for input_, chosen in choices.items():
        points.setdefault(chosen.leader, []).append(input_)
    as_good = {input_: chosen.as_good(run) for input_, chosen in choices.items()}
    rings = [input_ for input_, others in as_good.items() if others]
    if rings:
        panel.series.append(
            Series(
                "others are as good",
                [places[input_] for input_ in rings],
                [_height(run, input_) for input_ in rings],
                Look("muted", hollow=True),
                line=False,
                size=2.6,
            )
        )
    for leader, several in sorted(points.items()):
        panel.series.append(
            Series(
                leader,
                [places[input_] for input_ in several],
                [_height(run, input_) for input_ in several],
                report.look(run, leader),
                line=False,
                size=1.4,
                hover=[
                    f"<b>{leader}</b><br>{input_}, {run.density(input_) or 0:.3g} pairs a sphere<br>"
                    f"{words.duration(choices[input_].time.value)}"
                    + (
                        f"<br>as good:<br>{'<br>'.join(as_good[input_])}"
                        if as_good[input_]
                        else ""
                    )
                    for input_ in several
                ],
                chains=[report.chain(run, input_, leader) for input_ in several],
            )
        )
    return panel


def _beside(run, cases):
    """input -> n as drawn: chains of one n and one density are set side by side."""
    taken, places = {}, {}
    for input_ in cases:
        spot = runfile.n_of(input_), round(_height(run, input_), 6)
        places[input_] = spot[0] * 1.06 ** taken.get(spot, 0)
        taken[spot] = taken.get(spot, 0) + 1
    return places


def _height(run, input_):
    return max(run.density(input_) or 0, FLOOR)


def _message(run, view, cases):
    """What this run alone says: another run of the page may have timed a variant that is quicker."""
    own = {variant for row in cases.values() for variant in row if run.info(variant).recommended}
    return f"Of the {len(own)} exact variants that this run timed, {view}: " + words.apart(
        (f"{advice.variant} for {spans.in_words(advice.inputs, cases)}" for advice in choice.advise(run, cases)), 3
    )


def _elsewhere(views, informed):
    """On which chains the first table rests on another run of the page instead."""
    better = [
        f"{view} on {words.plural(missing, 'chain')}"
        for view, cases in views.items()
        if (missing := len(cases.keys() - informed[view].keys()))
    ]
    if not better:
        return ""
    return f"Another run of this machine timed more variants: its advice stands {words.listed(better)}. "


def summary_table(report):
    """The advice of the page's first screen, or None: what to use end to end, how much faster that is, how sure,
    and on what it rests.
    """
    informed = report.best_informed({run: waits.end_to_end(run) for run in report.runs})
    rows = [
        _advised(report, run, informed, advice)
        for run, cases in informed.items()
        for advice in choice.advise(run, cases)
    ]
    if not rows:
        return None
    peers = any(advice.peer for run, cases in informed.items() for advice in choice.advise(run, cases))
    columns = [
        "use", "for chains of", "a call takes, ms", "as good", "the next takes", "auto takes", "the paper's takes",
        "a general library takes", "rests on",
    ]
    if not peers:  # said once, in the caption
        columns, rows = columns[:7] + columns[8:], [row[:7] + row[8:] for row in rows]
    return Table(
        "advice-short",
        "Which variant should I use?",
        (
            "Each row is chains alike: of the exact variants timed on them, the one named is the fastest or not"
            " significantly slower than it on each. “As good” are those that are not told from it, where they were timed on all the"
            " row's chains: no significant difference on any, or an interval that begins at 1 or below, each with its ratio. “Next” is"
            f" the nearest of the others; {choice.DEFAULT} is what a caller gets who names none; “the paper's” is"
            f" {choice.PAPERS}"
            + ("; a general library searches any set of spheres:" if peers else " (no general library was timed):")
            + " how many times as long each takes, geometric mean over the row's chains with its 95 % interval"
            " (below six repetitions the range). A call is end to end: from a chain in the host's memory to its"
            " collisions there, with every move between memories. A + B is a construction of a tree and a"
            " traversal that searches it; @host marks a device algorithm that the host ran; Dual searches the"
            " tree against itself; auto looks at the chain and takes one of the others for it."
        ),
        columns,
        rows,
        words=len(columns),
    )


def _advised(report, run, informed, advice):
    cases = informed[run]
    samples = sum(len(cases[input_][advice.variant]) for input_ in advice.inputs)
    low, high = min(advice.times), max(advice.times)
    where = "" if len(report.runs) == 1 else f" ({report.label(run)})"
    return [
        Cell(advice.variant, kind="pick"),
        spans.in_words(advice.inputs, report.timed_beside(run, informed)),
        Cell(words.ms(low) if len(advice.inputs) == 1 else f"{words.ms(low)} to {words.ms(high)}", low),
        _as_good(advice),
        _times(advice.next, _no_next(advice)),
        *[
            Cell("this is it") if advice.variant == name else _times(entry, "not timed", len(advice.inputs), False)
            for name, entry in ((choice.DEFAULT, advice.default), (choice.PAPERS, advice.papers))
        ],
        _times(advice.peer, "none was timed", len(advice.inputs)),
        f"{words.plural(len(advice.inputs), 'chain')}, {words.plural(samples, 'sample')}, against"
        f" {words.plural(advice.others, 'exact variant')}{where}",
    ]


def _as_good(advice):
    return words.listed((f"{name} {ratio.value:.2f}" for name, ratio, _ in advice.as_good), 3)


def _no_next(advice):
    everywhere = advice.others == len(advice.as_good)
    return "all are as good" if everywhere else f"no {'further' if advice.as_good else 'other'} was timed on all of them"


def _times(beside, otherwise, chains=None, named=True):
    """How many times as long, and on how many of the row's chains where not on all."""
    if not beside:
        return Cell(otherwise)
    name, ratio, timed = beside
    text = words.interval(ratio) if ratio.low < ratio.high else f"{ratio.value:.3g}"  # one sample has no interval
    some = f" on {timed} of {words.plural(chains, 'chain')}" if chains and timed < chains else ""
    return Cell(f"{text} times{some}" + (f" ({name})" if named else ""), ratio.value)


def _table(report, run, views):
    rows = []
    for view, cases in views.items():
        for input_, chosen in choice.choose(run, cases).items():
            as_good = chosen.as_good(run)
            slower = [
                (name, ratio) for name, ratio in chosen.slower.items()
                if name not in as_good and run.info(name).recommended
            ]
            nearest = min(slower, key=lambda entry: entry[1].value, default=None)
            papers = chosen.slower.get(choice.PAPERS)
            rows.append(
                [
                    input_,
                    view,
                    chosen.leader,
                    words.listed(as_good, 3),
                    Cell(nearest[0]) if nearest else "",
                    Cell(words.interval(nearest[1]), nearest[1].value) if nearest else "",
                    Cell(words.interval(papers), papers.value) if papers else "",
                    Cell(f"{run.density(input_) or 0:.3g}", run.density(input_)),
                    Cell(
                        f"{words.ms(chosen.time.value)} [{words.ms(chosen.time.low)}, {words.ms(chosen.time.high)}]",
                        chosen.time.value,
                    ),
                ]
            )
    return Table(
        f"choice{report.key(run)}",
        "The fastest variant for each chain, and how much faster it is",
        (
            "Ratios of medians with their 95 % interval: how many times as long the next variant takes that is not as"
            f" good, and how many times as long {choice.PAPERS}, the paper's on a processor."
        ),
        [
            "chain", "you wait for", "fastest", "as good", "next", "next / fastest",
            "the paper's / fastest", "pairs a sphere", "median, ms",
        ],
        rows,
        words=5,
    )
