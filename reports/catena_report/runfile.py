"""A run file, read and checked: what reports/run_file.md describes, as Python values."""
import gzip
import json
import pathlib
import re
import shlex
import zlib

import numpy

from . import checks
from .checks import BadRunFile
from .variant import Variant

STAGES = ("build", "update", "find", "whole", "resident")
NAME = re.compile(rf"(?P<input>[^/]+/n:\d+)/(?P<variant>.+)/(?P<stage>{'|'.join(STAGES)})(/[a-z_]+)*")
TO_MS = {"ns": 1e-6, "us": 1e-3, "ms": 1.0, "s": 1e3}


class Run:
    """One run file.

    samples  (input, variant, stage) -> milliseconds of every repetition, in the order in which they ran
    refused  (input, variant, stage) -> why a variant was refused or found wrong
    faults   those of them that are the variant's fault: it threw, or an exact one was wrong
    counters (input, variant, stage) -> {pairs, missing, invented, transfer_ms, ...} of its last repetition
    moved    (input, variant, stage) -> milliseconds between memories of every repetition, 0 where none is told
    """

    def __init__(self, path, raw, where=None):
        self.path, self.raw = pathlib.Path(path), raw
        self.where = where or self.path  # as messages name it
        self.context = raw["context"]
        self.catena = raw.get("catena", {})
        self._described = self._read_variants()
        self.samples, self.refused, self.faults, self.counters, self.moved = {}, {}, {}, {}, {}
        for at, row in enumerate(raw["benchmarks"]):
            if row.get("run_type", "iteration") == "iteration":
                self._read(at, row)
        self.samples = {case: numpy.array(times) for case, times in self.samples.items()}

    def _read(self, at, row):
        where = f"{self.where}: benchmarks[{at}]"
        name = NAME.fullmatch(str(row.get("name", "")))
        if not name:
            return  # of another program; Google Benchmark's files may be joined
        case = name["input"], name["variant"], name["stage"]
        if row.get("error_occurred"):
            self.refused[case] = row.get("error_message", "refused, no reason given")
            if row.get("at_fault"):
                self.faults[case] = self.refused[case]
            return
        try:
            if isinstance(row["real_time"], bool):
                raise TypeError
            time = float(row["real_time"]) * TO_MS[row.get("time_unit", "ns")]
        except (KeyError, TypeError, ValueError):
            raise BadRunFile(
                f"{where} has no real_time in ns, us, ms or s; measure again with catena report"
            ) from None
        if not 0 <= time < float("inf"):
            raise BadRunFile(f"{where} has the time {row['real_time']}; measure again with catena report")
        checks.sample(where, row)
        self.samples.setdefault(case, []).append(time)
        self.moved.setdefault(case, []).append(float(row.get("transfer_ms", 0)))
        self.counters[case] = {
            key: row[key] for key in ("pairs", "missing", "invented", "transfer_ms") if key in row
        }

    def _read_variants(self):
        try:
            described = self.catena.get("variants") or {}
            return {name: Variant.of(name, value) for name, value in described.items()}
        except (AttributeError, KeyError, TypeError) as error:
            raise BadRunFile(
                f"{self.where}: catena.variants is not as in reports/run_file.md ({error}); measure again with"
                " catena report"
            ) from None

    def info(self, variant):
        """What the run says of the variant of that name. A BadRunFile where it says nothing."""
        if not self._described:
            raise BadRunFile(
                f"{self.where}: no catena.variants, which says what each variant is; measure again with this"
                " catena report"
            )
        if variant not in self._described:
            raise BadRunFile(
                f"{self.where}: catena.variants does not have {variant}; measure again with this catena report"
            )
        return self._described[variant]

    @property
    def device(self):
        """What it ran on, in a few words."""
        return (
            self.context.get("gpu")
            or self.context.get("cpu")
            or self.context.get("host_name", "unknown machine")
        )

    @property
    def host(self):
        """The processor that ran host stages."""
        return re.sub(r"\((R|TM)\)", "", self.context.get("cpu") or self.device)

    def list(self, key):
        """An array of `catena`, empty when the run has none."""
        return self.catena.get(key) or []

    def scene(self, input_):
        """The scene's row of `catena.scenes`, or {}."""
        return next((row for row in self.list("scenes") if row.get("input") == input_), {})

    def inputs(self):
        """Every input that was timed, by scene, then n."""
        return sorted({case[0] for case in self.samples}, key=lambda name: (scene_of(name), n_of(name)))

    def variants(self):
        """The names of those that were timed."""
        return sorted({case[1] for case in self.samples})

    def recommended(self):
        """Of those, the exact ones of catena itself."""
        return [name for name in self.variants() if self.info(name).recommended]

    def named(self):
        """The names of all that occur anywhere in the run."""
        return {case[1] for case in [*self.samples, *self.refused]} | set(_named(self.catena))

    def pairs(self, input_):
        """The number of pairs of an input, or None."""
        if "pairs" in self.scene(input_):
            return self.scene(input_)["pairs"]
        return next(
            (int(c["pairs"]) for case, c in self.counters.items() if case[0] == input_ and "pairs" in c), None
        )

    def density(self, input_):
        """Pairs a sphere, or None."""
        row = self.scene(input_)
        pairs = self.pairs(input_)
        return row.get("density", None if pairs is None else pairs / n_of(input_))


def _named(value):
    """What stands under a key "variant", at any depth."""
    if isinstance(value, dict) and isinstance(value.get("variant"), str):
        yield value["variant"]
    if isinstance(value, (dict, list)):
        for inner in value.values() if isinstance(value, dict) else value:
            yield from _named(inner)


def scene_of(input_):
    return input_.rpartition("/n:")[0]


def n_of(input_):
    return int(input_.rpartition("/n:")[2])


def scene_and_n(input_):
    """(scene, n) of an input written "SCENE/n:N" or, as `catena detect` takes it, "SCENE:n=N,..."; n is None without."""
    if "/n:" in input_:
        return scene_of(input_), n_of(input_)
    name, _, options = input_.partition(":")
    kept = [option for option in options.split(",") if option and not option.startswith("n=")]
    given = re.search(r"(?:^|,)n=(\d+)", options)
    return name + (":" + ",".join(kept) if kept else ""), int(given[1]) if given else None


def replay(run, input_, variant=None):
    """The command that shows this chain again."""
    view = next(
        (view for view in run.list("viewer") if view.get("input") == input_ and view.get("command")), None
    )
    if view and not variant:
        return view["command"]
    if "/n:" not in input_:
        chain, row = input_, {}  # already as `catena detect` takes it
    else:
        scene, row = scene_of(input_), run.scene(input_)
        chain = row.get("spec") or f"{scene}{',' if ':' in scene else ':'}n={n_of(input_)}"
    frame = f" --frame {row['frame']}" if row.get("frames", 1) > 1 and "frame" in row else ""
    of_variant = f" --variant {shlex.quote(variant)}" if variant else ""
    return f"catena detect {shlex.quote(chain)}{row.get('options', '')}{frame}{of_variant}"


def load(path):
    """The run in the file `path`; a BadRunFile says in one line what is wrong."""
    runs = load_all(path)
    if len(runs) != 1:
        raise BadRunFile(f"{path}: holds {len(runs)} runs, and one is wanted; give a file of one of them")
    return runs[0]


def load_all(path):
    """The runs in the file `path`: one, or the list that a page of several runs has beside it."""
    constants = []
    try:
        with (gzip.open if str(path).endswith(".gz") else open)(path, "rt", encoding="utf-8") as file:
            raw = json.load(file, parse_constant=lambda name: constants.append(name) or checks.CONSTANTS[name])
    except (OSError, EOFError, zlib.error) as error:
        raise BadRunFile(f"{path}: {getattr(error, 'strerror', None) or error}; give a file that catena report wrote") from None
    except (ValueError, RecursionError) as error:  # not JSON, or not UTF-8
        raise BadRunFile(f"{path}: not JSON ({error}); give a file that catena report wrote") from None
    several = isinstance(raw, list) and raw
    runs = [(f"{path}: run {at}", one) for at, one in enumerate(raw, 1)] if several else [(path, raw)]
    for where, one in runs:
        checks.whole(where, one)
        if constants:
            checks.finite(where, one)
    return [Run(path, one, where) for where, one in runs]
