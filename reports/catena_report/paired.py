"""What two runs measured of the same cases, as the gate (gate.py) needs it: how much slower on a logarithm,
how sure, and how loaded the machine was meanwhile.
"""
import dataclasses
import math
import statistics

import numpy

from . import runfile

LEAST_TIME = 1e-7  # ms; below the tick of any clock, so that a ratio to a time of 0 is a number
RESAMPLES = 64
UNKNOWN = 1.0  # the standard error of one or two samples, which do not say it
FLOOR = 0.005  # of the logarithm of a time: what the layout of memory makes of a case from run to run
IDLE = 0.1  # a kernel slower than its best by less than this (on a logarithm) ran on an idle machine
HOST, THREADS, DEVICE = "host", "threads", "device"
KERNELS = {HOST: "load_one_ms", THREADS: "load_all_ms"}  # a device's clock does not see the load of the host


@dataclasses.dataclass(frozen=True)
class Case:
    input: str
    variant: str
    stage: str
    algorithm: str  # that finds or builds, in any variant: "*+CPU2", "aCPU2+*"; empty of what is one piece
    place: str  # where the stage runs
    repetitions: int  # of each run that are compared: the first so many
    old: float  # ms, of the quick quarter
    new: float
    change: float  # log(new / old)
    variance: float  # of `change`, as far as the samples of the two runs say
    calibrated: bool  # both runs timed a kernel beside the samples
    kernel: float  # log of how much slower the calibration kernel was beside NEW's quick samples; 0 without
    load: tuple  # of OLD and NEW: log of how much slower than its best the kernel was at the quietest sample

    @property
    def name(self):
        return "/".join((self.input, self.variant, self.stage))


@dataclasses.dataclass(frozen=True)
class Timed:
    """The samples of one case in the order in which they ran. ms: the quickest pass of each where the run
    says it, else the mean; kernels: name -> milliseconds beside each sample, absent in older runs.
    """

    ms: numpy.ndarray
    kernels: dict


def timed(run):
    """{(input, variant, stage): Timed} of a run."""
    found = {}
    for row in run.raw["benchmarks"]:
        name = runfile.NAME.fullmatch(str(row.get("name", "")))
        if name and row.get("run_type", "iteration") == "iteration" and not row.get("error_occurred"):
            found.setdefault((name["input"], name["variant"], name["stage"]), []).append(row)
    return {
        case: Timed(
            _column(rows, "least_ms") if all("least_ms" in row for row in rows) else run.samples[case],
            {key: _column(rows, key) for key in KERNELS.values() if all(key in row for row in rows)},
        )
        for case, rows in found.items()
    }


def _column(rows, key):
    return numpy.array([float(row[key]) for row in rows])


def place(run, case):
    """Where the stage of this case runs; of a run that does not describe its variants, the host."""
    parts = _parts(run, case)
    if any(part["place"] == DEVICE for part in parts):
        return DEVICE
    return THREADS if any(part["on_host"] for part in parts) else HOST


def algorithm(run, case):
    """The algorithm that the stage of this case shares with other variants: "aCPU2+*" builds,
    "*+CPU2/literal" finds; empty of what is complete in itself, and of a whole.
    """
    described = (run.catena.get("variants") or {}).get(case[1])
    if not described or len(described["stages"]) < 2 or len(_parts(run, case)) != 1:
        return ""
    text = _parts(run, case)[0]["text"]
    rounded = "" if described["exact"] else f"/{described['arithmetic']}"
    return (f"*+{text}" if case[2] == "find" else f"{text}+*") + rounded


def _parts(run, case):
    """What catena.variants says of the stages that this case times."""
    _, name, stage = case
    stages = (run.catena.get("variants") or {}).get(name, {}).get("stages", [])
    return {"build": stages[:1], "update": stages[:1], "find": stages[-1:]}.get(stage, stages)


def cases(old, new):
    """[Case] of what both runs timed on the same chains."""
    others = changed_inputs(old, new)
    before, after = (
        {case: of for case, of in timed(run).items() if case[0] not in others} for run in (old, new)
    )
    return pairs(before, after, {case: (algorithm(new, case), place(new, case)) for case in after})


def pairs(before, after, kinds):
    """[Case] of {(input, variant, stage): Timed} of two runs and {(input, variant, stage): (algorithm,
    place)}, by input, variant and stage.
    """
    shared = sorted(
        set(before) & set(after),
        key=lambda case: (runfile.scene_of(case[0]), runfile.n_of(case[0]), case[1:]),
    )
    best = {}
    for run in (before, after):
        for case in shared:
            for key, ms in run[case].kernels.items():
                best[key] = min(best.get(key, math.inf), float(ms.min()))
    sizes = [min(len(before[case].ms), len(after[case].ms)) for case in shared]
    quick = [
        _quick_quarters([run[case].ms[:size] for case, size in zip(shared, sizes)]) for run in (before, after)
    ]
    found = []
    for case, size, *ends in zip(shared, sizes, *quick):
        beside = [_beside(run[case], kinds[case][1], size, best) for run in (before, after)]
        found.append(_case(case, kinds[case], size, *ends, beside))
    return found


def changed_inputs(old, new):
    """The inputs whose chains are others in NEW: nothing measured on them can be compared."""
    hashes = [{row["input"]: row.get("hash") for row in run.list("scenes")} for run in (old, new)]
    return {name for name in set(hashes[0]) & set(hashes[1]) if hashes[0][name] != hashes[1][name]}


def _case(case, kind, size, old, new, beside):
    """Of what _quick_quarters and _beside say of both runs."""
    return Case(
        *case, *kind, size, math.exp(old[0]), math.exp(new[0]), new[0] - old[0],
        old[1] ** 2 + new[1] ** 2 + FLOOR**2, None not in beside, *_machine(beside),
    )  # fmt: skip


def _machine(beside):
    """(kernel, load) of a Case."""
    if None in beside:
        return 0.0, (0.0, 0.0)
    return beside[1][0] - beside[0][0], (beside[0][1], beside[1][1])


def _quick_quarters(lists):
    """[(the mean logarithm of the quick quarter, its standard error by the bootstrap)] of lists of
    milliseconds, those of one length at once.
    """
    found = [None] * len(lists)
    for size in set(map(len, lists)):
        at = [k for k, ms in enumerate(lists) if len(ms) == size]
        logs = numpy.log(numpy.maximum([lists[k] for k in at], LEAST_TIME))
        draws = numpy.random.default_rng(size).integers(size, size=(RESAMPLES, size))
        quarter = max(1, size // 4)
        ends = numpy.sort(logs)[:, :quarter].mean(axis=1)
        errors = numpy.sort(logs[:, draws])[:, :, :quarter].mean(axis=2).std(axis=1)
        for k, end, error in zip(at, ends.tolist(), errors.tolist()):
            found[k] = (end, error if size >= 3 else UNKNOWN)
    return found


def _beside(run, where, size, best):
    """(log of how much slower than its best the kernel was beside the three quickest samples, the same beside
    the quietest past what is IDLE); None without a kernel. Plain lists: of a dozen numbers numpy takes ten
    times as long.
    """
    key = KERNELS.get(where)
    if key not in run.kernels:
        return None
    loads = [math.log(ms / best[key]) for ms in run.kernels[key][:size].tolist()]
    ms = run.ms[:size].tolist()
    quickest = sorted(range(size), key=ms.__getitem__)[:3]
    return statistics.median(loads[k] for k in quickest), max(0.0, min(loads) - IDLE)
