"""Ranks: what they tell one another beside what they must, how long the busiest takes, and where more stop paying."""
from .. import rank_model, runfile, words
from ..figure import Axis, Figure, Line, Panel, Series
from ..section import Prose, Section
from ..style import COLOURS, MARKERS, Look
from ..table import Cell, Table

AIM = 2  # times the blocks that truly touch another part
SHOWN = (2, 16, 64, 256, 1024, 4096)  # rows of the table of counts
TOLD = (1e6, 1e9)  # spheres for which the model is told


def build(report):
    section = Section("ranks", "Ranks: one chain, many memories")
    for run in report.having("ranks"):
        found = run.catena["ranks"]
        chains = [dict(chain, scene=runfile.scene_of(_case(chain))) for chain in found["chains"]]
        models = {scene: rank_model.model(mine) for scene, mine in _by_scene(chains).items()}
        section.blocks += report.heading(run) + [
            _told(found),
            _exchange(report, run, chains),
            _times(report, run, chains, models),
            _model_table(report, run, chains, models),
            _sending_table(report, run, chains, models),
            _counts(report, run, chains),
        ]
    section.blocks = [block for block in section.blocks if block]
    return section if section.blocks else None


def _case(chain):
    return f"{chain['input'].partition(':')[0]}/n:{chain['n']}"


def _by_scene(chains):
    found = {}
    for chain in chains:
        found.setdefault(chain["scene"], []).append(chain)
    return found


def _told(found):
    return Prose(
        "Under <code>mpirun</code> each process, a rank, searches a part of the chain by itself and asks other ranks for the"
        " blocks of eight spheres that may touch its own. Here ranks are threads of one process, and a time is what a rank's"
        f" own thread computed, {found['searched_by']} within its part: waiting, and a network, are not in it."
    )


def _look(chains, chain):
    scenes = list(_by_scene(chains))
    mine = [other["n"] for other in chains if other["scene"] == chain["scene"]]
    at = scenes.index(chain["scene"])
    return Look(COLOURS[at % len(COLOURS)], MARKERS[at % len(MARKERS)], "solid" if chain["n"] == max(mine) else "dot")


def density(chain):
    """Pairs a sphere, by a search that was timed; None for none."""
    pairs = [p["pairs"] for p in chain["points"] if "pairs" in p]
    return pairs[0] / chain["n"] if pairs else None


def _density_cell(chains):
    """Of the last of a scene's chains of which it is known."""
    known = [value for value in map(density, chains) if value is not None]
    return Cell(words.significant(known[-1], 3), known[-1]) if known else ""


def _name(chain):
    return f"{chain['scene']}, {words.count(chain['n'])}"


def _exchange(report, run, chains):
    over = Panel("over ranks", Axis("ranks", log=True), Axis("blocks asked for / blocks that touch"))
    for chain in chains:
        seen = [(p["ranks"], rank_model.excess(p)) for p in chain["points"] if rank_model.excess(p)]
        if seen:
            over.series.append(
                Series(_name(chain), [x for x, _ in seen], [y for _, y in seen], _look(chains, chain), chains=None)
            )
    longest = [max(mine, key=lambda chain: chain["n"]) for mine in _by_scene(chains).values()]
    most = max((density(chain) or 0 for chain in longest), default=0)
    dense = Panel(
        "over contact density",
        Axis("colliding pairs a sphere", range=(-0.1 * most, 1.2 * most) if most else None),
        Axis("blocks asked for / blocks that touch"),
    )
    for at, ranks in enumerate((4, 16, 64)):
        seen = sorted(
            (density(chain), rank_model.excess(p), chain["scene"])
            for chain in longest
            for p in chain["points"]
            if p["ranks"] == ranks and density(chain) is not None and rank_model.excess(p)
        )
        if seen:
            dense.series.append(
                Series(
                    f"{ranks} ranks",
                    [x for x, _, _ in seen],
                    [y for _, y, _ in seen],
                    Look("muted" if at else "ink", MARKERS[4 + at], ("solid", "dash", "dot")[at]),
                    labels=[scene for *_, scene in seen] if at == 2 else None,
                )
            )
    if not over.series:
        return None
    over.lines.append(Line(AIM, across=True, label="aim"))
    dense.lines.append(Line(AIM, across=True, label="aim"))
    return Figure(f"ranks-exchange{report.key(run)}", _exchange_verdict(chains), (
        "A block is asked for when the capsule around its eight spheres (in runs of before 29 November 2026 a box) touches a"
        " sphere of another rank. The lower"
        " bound are the blocks of which a sphere truly touches one of another rank, neighbours along the chain too: no"
        " exchange by blocks can do with fewer. Counted, not timed, and the same in every run; dotted: the shorter chain of"
        " a scene. Where a rank holds few spheres, most of them are at its surface, and the capsules are coarse beside it."
    ), [over, dense] if dense.series else [over])


def _exchange_verdict(chains):
    seen = [(p["ranks"], rank_model.excess(p), chain, p) for chain in chains for p in chain["points"] if rank_model.excess(p)]
    beyond = [(p["blocks"] / ranks, chain) for ranks, ratio, chain, p in seen if ratio > AIM]
    worst = max(ratio for _, ratio, _, _ in seen)
    if not beyond:
        return f"Ranks ask for at most {words.significant(worst, 3)} times the blocks that truly touch another part"
    held, _ = max(beyond, key=lambda pair: pair[0])
    return (
        f"Ranks ask for less than twice the blocks that truly touch while each holds more than {words.count(8 * held)}"
        f" spheres; at worst for {words.significant(worst, 3)} times as many"
    )


def _times(report, run, chains, models):
    panels = []
    for scene, mine in _by_scene(chains).items():
        panel = Panel(scene, Axis("ranks", log=True), Axis("ms of the busiest rank", log=True), height=280)
        for chain in sorted(mine, key=lambda chain: chain["n"]):
            seen = [(p["ranks"], rank_model.busiest_ms(p)) for p in chain["points"] if rank_model.busiest_ms(p)]
            if not seen:
                continue
            look = _look(chains, chain)
            panel.series.append(
                Series(_name(chain), [x for x, _ in seen], [y for _, y in seen], look, line=False)
            )
            if model := models[scene]:
                ranks = [2**k for k in range(0, 14)]
                panel.series.append(
                    Series(
                        "model",
                        ranks,
                        [model.ms(chain["n"], r) for r in ranks],
                        Look("muted"),
                        markers=False,
                        legend=chain is mine[0] and not panels,
                    )
                )
            panel.series.append(
                Series(
                    "one rank's time shared out",
                    [1, seen[-1][0]],
                    [seen[0][1], seen[0][1] / seen[-1][0]],
                    Look("muted", dash="dot"),
                    markers=False,
                    legend=chain is mine[0] and not panels,
                )
            )
        if panel.series:
            panels.append(panel)
    if not panels:
        return None
    return Figure(f"ranks-times{report.key(run)}", _times_verdict(chains, models), (
        "Points: processor time of a search, in each phase that of the rank which takes longest. Line: the model below,"
        f" fitted to up to {rank_model.FITTED} ranks. Dotted: what would be if nothing had to be shared. Where the line turns"
        " up, more ranks are slower, as all tell all where they are."
    ), panels)


def _times_verdict(chains, models):
    n = max(chain["n"] for chain in chains)
    best = {scene: model.best(n) for scene, model in models.items() if model}
    if not best:
        return "How long the busiest rank takes"
    told = words.listed(f"{words.count(ranks)} ({scene})" for scene, ranks in best.items())
    return f"By the model {words.count(n)} spheres are searched soonest by so many ranks: {told}; more are slower"


def _model_table(report, run, chains, models):
    rows = []
    for scene, mine in _by_scene(chains).items():
        model = models[scene]
        if not model:
            continue
        off = [max(law / counted, counted / law) for _, _, law, counted in rank_model.checked(mine, model.law)]
        rows.append(
            [
                scene,
                _density_cell(mine),
                *[
                    Cell(words.significant(value, 3), value)
                    for value in (model.law.factor, model.law.thickness, model.sphere_ns, model.asked_ns, model.rank_ns, model.fixed_ns, model.error)
                ],
                Cell(words.significant(max(off), 3), max(off)) if off else "",
                *[Cell(words.count(model.half(n)), model.half(n)) for n in TOLD],
                *[Cell(words.count(model.best(n)), model.best(n)) for n in TOLD],
            ]
        )
    if not rows:
        return None
    return Table(f"ranks-model{report.key(run)}", "What ranks cost, as a model of n, the ranks R and the contacts", (
        "A rank holds h = n / 8 R blocks, a cube of them, and asks for a shell around it: a ="
        " c ((h^(1/3) + w)^3 - h) (1 - R^(-1/3)) blocks, the last factor being the share of its sides that others are behind."
        " The busiest computes for s n / R + b a + r R + f nanoseconds: s for each of its spheres, b for each block that it"
        " asks for, r for each rank that there is, f once; one rank alone for s n. Off: the median factor between the times"
        " and the model; and the largest between the blocks asked for by the law and as counted on more than"
        f" {rank_model.FITTED} ranks. Half: the most ranks of which no more than half is lost, with a million and with a"
        " billion spheres; best: those with the least time, beyond which more are slower. Scenes that stay in chain order"
        " have no shell, and are left out."
    ), ["scene", "pairs a sphere", "c", "w, blocks", "s, ns", "b, ns", "r, ns", "f, ns", "times off", "counts off"]
      + [f"{what}, n = {words.count(n)}" for what in ("half", "best") for n in TOLD], rows)


def _sending_table(report, run, chains, models):
    rows = []
    for scene, mine in _by_scene(chains).items():
        sending = models[scene] and rank_model.sending(mine, models[scene])
        if not sending:
            continue
        off = rank_model.sending_off(mine, sending)
        rounds = max(p["most_rounds"] for chain in mine for p in chain["points"])
        best = [rank_model.best_in(rank_model.CLUSTER, sending, n) for n in TOLD]
        rows.append(
            [
                scene,
                _density_cell(mine),
                *[
                    Cell(words.significant(value, 3), value)
                    for value in (sending.sphere_bytes, sending.asked_bytes, sending.rank_bytes, sending.bytes_error)
                ],
                Cell(words.significant(off[0], 3), off[0]) if off else "",
                *[
                    Cell(words.significant(value, 3), value)
                    for value in (sending.each, sending.neighbours, sending.messages_error)
                ],
                Cell(words.significant(off[1], 3), off[1]) if off else "",
                Cell(words.count(rounds), rounds),
                *[Cell(words.count(ranks), ranks) for ranks in best],
            ]
        )
    if not rows:
        return None
    network = rank_model.CLUSTER
    return Table(f"ranks-sending{report.key(run)}", "What ranks send, as a model of n, the ranks R and the contacts", (
        "The rank that sends most sends S (n / R) (1 - 1 / R) + A a + K R bytes: S for each sphere of its share that another"
        " rank shall hold, A for each block that is asked for (a as above), K for each rank that there is; in"
        " m (R - 1) / (1 + (R - 1) / N) messages, m to each of few, and of many to N, its neighbours; and asks in so many"
        " rounds. Off: the median factor between counts and model, and the"
        f" largest on more than {rank_model.FITTED} ranks, to which it was not fitted. Best: the ranks with the least time, as"
        f" above and with a network in which a message takes {words.significant(1e6 * network.seconds_a_message, 2)} µs and a rank"
        f" sends {words.significant(1e-9 * network.bytes_per_second, 2)} GB a second, which is assumed, not measured."
    ), ["scene", "pairs a sphere", "S", "A", "K", "bytes off", "beyond", "m", "N", "messages off", "beyond", "rounds"]
      + [f"best, n = {words.count(n)}" for n in TOLD], rows)


def _counts(report, run, chains):
    rows = []
    for chain in chains:
        seen = {}
        for p in chain["points"]:
            if p["ranks"] in SHOWN:
                seen.setdefault(p["ranks"], p)
        for ranks, p in sorted(seen.items()):
            ratio, ms = rank_model.excess(p), rank_model.busiest_ms(p)
            rows.append(
                [
                    _name(chain),
                    Cell(words.count(ranks), ranks),
                    p["order"],
                    *[
                        Cell(words.count(p[key]), p[key])
                        for key in ("most_spheres", "most_blocks_asked", "most_bytes", "most_messages", "most_rounds")
                    ],
                    Cell(words.significant(ratio, 3), ratio) if ratio else "",
                    Cell(words.ms(ms), ms) if ms else "",
                ]
            )
    return Table(f"ranks-counts{report.key(run)}", "What ranks tell one another", (
        "Of the rank that has or does most: spheres of its part, blocks that it asks for, bytes and messages that it sends"
        " (the sharing out by space, the blocks and the answers), rounds of questions. Then blocks asked for over those that"
        " truly touch, of all ranks together, and the processor time of the busiest."
    ), ["chain", "ranks", "order", "spheres", "blocks asked", "bytes", "messages", "rounds", "over the bound", "ms"], rows)
