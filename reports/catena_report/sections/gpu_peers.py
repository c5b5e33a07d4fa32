"""GPU libraries that cannot be shipped: what was measured of them elsewhere, committed, beside catena's committed times.

It is data of the card that it names, and no claim about the machine of this page's runs: no other section reads it.
"""
import functools
import html
import json
import pathlib

from .. import runfile, statistics, words
from ..section import Prose, Section
from ..table import Cell, Table

RESULTS = pathlib.Path(__file__).parents[2] / "results"
PATH, OWN = RESULTS / "h200_peers.json", RESULTS / "h200_tables.json"


def build(report):
    if not (PATH.exists() and OWN.exists()):  # installed without the results
        return None
    stored = json.loads(PATH.read_text(encoding="utf-8"))
    return Section("gpu-peers", "GPU libraries, measured elsewhere", [_prose(stored), _table(stored)])


@functools.lru_cache(maxsize=None)
def own():
    """input -> (variant, its median) of the committed run: the exact variant of catena that is fastest with a chain that
    stays on the device.
    """
    run, found = runfile.load(OWN), {}
    for (input_, variant, stage), times in run.samples.items():
        if stage == "resident" and run.info(variant).recommended:
            found.setdefault(input_, []).append((statistics.median(times).value, variant))
    return run, {input_: min(timed)[::-1] for input_, timed in found.items()}


def _prose(stored):
    run, _ = own()
    lost = [
        f"{html.escape(row['peer'])} lost {words.listed(map(words.count, row['lost']))} of {row['pairs'] / 1e6:.0f} million"
        f" pairs of {_chain(row['input'])}"
        + (f", in {len(row['lost'])} runs" if len(row["lost"]) > 1 else "")
        for row in stored["lost"]
    ]
    return Prose(
        f"<strong>Not measured in this run.</strong> These libraries cannot be shipped with catena, so that nothing else on"
        f" this page was timed beside them. Their figures are of {html.escape(stored['gpu'])}, driver"
        f" {html.escape(stored['driver'])}, CUDA {html.escape(stored['cuda'])}: {html.escape(stored['method'])}. Source:"
        f" {html.escape(stored['source'])} ({html.escape(stored['date'])}). Beside them stand catena's resident times of"
        f" the run on such a card that is committed as <code>{OWN.name}</code> ({run.context['date'][:10]}, commit"
        f" <code>{html.escape(run.context['commit'])}</code>). No claim or advice on this page rests on these libraries'"
        f" figures. Not all answers were right: {'; '.join(lost)}."
    )


def _chain(input_):
    return f"{runfile.scene_of(input_)}, n = {words.count(runfile.n_of(input_))}"


def _table(stored):
    wrong = {(row["peer"], row["input"]) for row in stored["lost"]}
    inputs = {input_ for times in stored["peers"].values() for input_ in times}
    _, ours = own()
    body = []
    for input_ in sorted(inputs, key=lambda name: (runfile.n_of(name), runfile.scene_of(name))):
        variant, time = ours.get(input_, ("", None))
        row = [_chain(input_), variant, Cell(words.ms(time), time) if variant else Cell("")]
        for peer, times in stored["peers"].items():
            said = words.ms(times[input_]) + (", pairs lost" if (peer, input_) in wrong else "") if input_ in times else ""
            row.append(Cell(said, times.get(input_), "committed"))
        body.append(row)
    return Table(
        "gpu-peers",
        "GPU libraries, measured elsewhere, beside catena's committed run",
        "Build and search of a chain that lies on the device, milliseconds; empty where it was not measured.",
        ["chain", "catena's fastest, committed run", "its time", *stored["peers"]],
        body,
        words=2,
    )
