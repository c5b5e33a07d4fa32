"""All runs of one page, and what the sections share: looks, chains behind points, medians."""
import collections
import functools
import math

from . import runfile, statistics
from .section import Heading
from .style import Looks


class Report:
    def __init__(self, runs):
        self.runs = runs
        described = {name: run.info(name) for run in runs for name in sorted(run.named())}
        self.looks = Looks(list(described.values()))
        self.labels = _labels(runs)

    def look(self, run, variant):
        """The look of the variant of that name."""
        return self.looks.variant(run.info(variant))

    def label(self, run):
        return self.labels[self.runs.index(run)]

    def key(self, run):
        """Ends the name of a figure or table that each run has: empty when there is one run."""
        return f"-{self.runs.index(run) + 1}" if len(self.runs) > 1 else ""

    def heading(self, run):
        """[the heading of a run] where the page has several, to begin what a section says of it."""
        return [Heading(self.label(run))] if len(self.runs) > 1 else []

    def having(self, key):
        """The runs whose `catena` object has something under `key`."""
        return [run for run in self.runs if run.catena.get(key)]

    def best_informed(self, views):
        """{run: {input: samples by variant}} of {run: the same}: of runs of one machine that timed the same chain,
        only the one that timed the most variants keeps it, so that no other advice contradicts it.
        """
        hashes, most = collections.defaultdict(set), {}
        for run, cases in views.items():
            for input_ in cases:
                hashes[_machine(run), input_].update(filter(None, [run.scene(input_).get("hash")]))

        def chain(run, input_):
            """Files of one name may hold several."""
            key = _machine(run), input_
            return *key, run.scene(input_).get("hash") if len(hashes[key]) > 1 else None

        for run, cases in views.items():
            for input_, row in cases.items():
                key = chain(run, input_)
                if key not in most or len(row) > len(views[most[key]][input_]):
                    most[key] = run
        return {
            run: {input_: row for input_, row in cases.items() if most[chain(run, input_)] is run}
            for run, cases in views.items()
        }

    def timed_beside(self, run, views):
        """The inputs of {run: {input: ...}} that were timed on the machine of `run`, by whichever run."""
        return {input_ for other, cases in views.items() if _machine(other) == _machine(run) for input_ in cases}

    @functools.lru_cache(maxsize=None)
    def median(self, run, input_, variant, stage):
        """The median with its interval, or None."""
        times = run.samples.get((input_, variant, stage))
        return None if times is None else statistics.median(times)

    def chain(self, run, input_, variant=None, command=None):
        """What a click on a point shows: the chain, its replay command, and the view of it, or of its scene."""
        frame = run.scene(input_).get("frame", 0)
        frame = frame if isinstance(frame, int) else 0  # "all": from the first on
        command = command or runfile.replay(run, input_, variant)
        return {"input": input_, "frame": frame, "command": command, "shown": self.view(input_)}

    @functools.lru_cache(maxsize=None)
    def view(self, input_):
        """The input of the view of this chain, else of its scene with the nearest n; None without."""
        scene, n = runfile.scene_and_n(input_)
        views = {
            view["input"]: runfile.scene_and_n(view["input"])
            for run in self.runs
            for view in run.list("viewer")
        }
        near = [
            (abs(math.log((n or other) / other)), name)
            for name, (its, other) in views.items()
            if its == scene and other
        ]
        return min(near)[1] if near else None

    def sizes(self, run):
        """scene -> its inputs by rising n."""
        found = collections.defaultdict(list)
        for name in run.inputs():
            found[runfile.scene_of(name)].append(name)
        return dict(found)


def _machine(run):
    return run.context.get("gpu"), run.host


def _labels(runs):
    """One word for each run: its device; where several share it the file too, or else the number by which figures name
    the run.
    """
    found = [run.device for run in runs]
    for device in set(found):
        mine = [at for at, run in enumerate(runs) if run.device == device]
        files = endings([runs[at].path.with_name(_stem(runs[at].path.name)) for at in mine])
        for at, file in zip(mine, files if len(mine) > 1 else []):
            found[at] = f"{device}, {file or f'run {at + 1}'}"
    return found


def _stem(name):
    return name.partition(".")[0] or name


def endings(paths):
    """Of each path the shortest end that no other has; None where another is the same."""
    parts = [path.absolute().parts for path in paths]
    found = []
    for at, mine in enumerate(parts):
        others = parts[:at] + parts[at + 1 :]
        ends = (size for size in range(1, len(mine) + 1) if all(other[-size:] != mine[-size:] for other in others))
        size = next(ends, None)
        found.append(size and "/".join(mine[-size:]))
    return found
