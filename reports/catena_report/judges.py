"""The judges of the paper's claims: each sees one run and answers from its samples."""
import dataclasses

import numpy

from . import paper, statistics, words

HOLDS, FAILS, UNTESTED = "holds", "does not hold", "not testable here"
PATHS = tuple(paper.TABLES)
TOLERANCE = 0.1  # of an exponent: what caches and clocks add to a law over a decade or two of n


@dataclasses.dataclass(frozen=True)
class Verdict:
    verdict: str
    evidence: str


def untested(reason):
    return Verdict(UNTESTED, reason)


def _curve(run, path, algorithm, least=0):
    """[(n, samples)] of the paper's algorithm on a path."""
    points = [(n, paper.samples(run, path, n, algorithm)[0]) for n in paper.sizes(run, path) if n >= least]
    return [(n, times) for n, times in points if times is not None]


def growth(algorithm, law, name):
    """time = O(law(n)): the quotient time / law must not grow with n."""

    def judge(run):
        found = {}
        for path in PATHS:
            points = _curve(run, path, algorithm)
            fit = statistics.exponent([n for n, _ in points], [numpy.median(t) / law(n) for n, t in points])
            if fit:
                found[path] = (
                    fit,
                    statistics.exponent([n for n, _ in points], [numpy.median(t) for _, t in points]),
                    points,
                )
        if not found:
            return untested(f"{algorithm} was not timed at four sizes or more of path1 or path2")
        spans = [
            f"{path}, {words.count(points[0][0])} to {words.count(points[-1][0])} spheres: time grows as n to"
            f" the {words.interval(plain)}; time / ({name}) as n to the {words.interval(fit)}"
            for path, (fit, plain, points) in found.items()
        ]
        if all(fit.high <= TOLERANCE for fit, _, _ in found.values()):
            return Verdict(HOLDS, "; ".join(spans))
        if any(fit.low > TOLERANCE for fit, _, _ in found.values()):
            return Verdict(FAILS, "; ".join(spans))
        return untested("the interval of the exponent leaves it open: " + "; ".join(spans))

    return judge


def half(run):
    ratios, shown = [], []
    for path in PATHS:
        for n in paper.sizes(run, path):
            new, old = (paper.samples(run, path, n, a)[0] for a in ("GPUv2", "GPU2"))
            if new is not None and old is not None:
                ratios.append(float(numpy.median(new) / numpy.median(old)))
                shown.append(f"{ratios[-1]:.2f} at {words.count(n)} ({path})")
    if len(ratios) < 2:
        return untested("GPU2 and GPUv2 were not both timed on a device, at two sizes or more")
    mean = statistics.mean_log(ratios)
    evidence = (
        f"GPUv2 takes {words.interval(mean)} of the time of GPU2 (geometric mean over {len(ratios)} cases),"
        f" between {min(ratios):.2f} and {max(ratios):.2f}"
    )
    return Verdict(HOLDS if mean.high <= 0.55 else FAILS if mean.low > 0.55 else UNTESTED, evidence)


def faster(quick, slow, least, stage):
    """quick beats slow at every n from `least` on."""

    def judge(run):
        wins, losses, open_, begin = [], [], [], {}
        for path in PATHS:
            for n in paper.sizes(run, path):
                a, b = (paper.samples(run, path, n, name)[0] for name in (quick, slow))
                if a is None or b is None:
                    continue
                ratio = statistics.ratio(a, b)
                if ratio.high < 1:
                    begin.setdefault(path, n)
                if n >= least:
                    (wins if ratio.high < 1 else losses if ratio.low > 1 else open_).append(
                        f"{words.count(n)} ({path})"
                    )
        if not wins and not losses and not open_:
            return untested(f"{quick} and {slow} were not both timed at {words.count(least)} spheres or more")
        evidence = (
            f"{quick} is faster at {len(wins)} of {len(wins) + len(losses) + len(open_)} sizes from"
            f" {words.count(least)} on"
        )
        if begin:
            evidence += "; first at " + words.listed(
                f"{words.count(n)} ({path})" for path, n in begin.items()
            )
        if losses:
            evidence += "; slower at " + words.listed(losses, 4)
        if open_:
            evidence += "; no difference that the samples show at " + words.listed(open_, 4)
        return Verdict(FAILS if losses else UNTESTED if open_ else HOLDS, evidence)

    return judge


def slowest(run):
    """GPU1 against every traversal that uses the hierarchy, where all were timed."""
    cases, broken = 0, []
    for path in PATHS:
        for n in paper.sizes(run, path):
            times = {name: paper.samples(run, path, n, name)[0] for name in ("GPU1", "CPU2", "GPU2", "GPUv2")}
            if any(value is None for value in times.values()):
                continue
            cases += 1
            for name in ("CPU2", "GPU2", "GPUv2"):
                if statistics.ratio(times["GPU1"], times[name]).low <= 1:
                    ratio = numpy.median(times["GPU1"]) / numpy.median(times[name])
                    broken.append(
                        f"{words.significant(ratio, 2)} of the time of {name} at {words.count(n)} ({path})"
                    )
    if not cases:
        return untested("GPU1, GPU2, GPUv2 and CPU2 were not all timed at one size; it needs a GPU")
    if broken:
        return Verdict(FAILS, f"GPU1 takes {words.listed(broken, 4)}; {words.plural(cases, 'case')} in all")
    return Verdict(HOLDS, f"GPU1 is the slowest in all {words.plural(cases, 'case')}")


def _keyframes(run):
    """path -> [the pairs of every keyframe] of each n that was counted; of a run without `keyframes` the frames of
    an animation that was timed in full.
    """
    found = {}
    for row in run.list("keyframes"):
        found.setdefault(paper.path_of(row["input"]), []).append(row["pairs"])
    if not found:
        for row in run.list("animation"):
            frames = [frame["pairs"] for frame in row["frames"]]
            if paper.path_of(row["input"]) and len(frames) == run.scene(row["input"]).get("frames"):
                found.setdefault(paper.path_of(row["input"]), []).append(frames)
    return {path: counts for path, counts in found.items() if path}


def pairs(run):
    """The largest number of pairs over all keyframes; one frame alone can only refute."""
    counted = _keyframes(run)
    seen = {path: max(max(frames) for frames in several) for path, several in counted.items()}
    for input_ in run.inputs():
        path = paper.path_of(input_)
        if path and run.pairs(input_) is not None:
            seen[path] = max(seen.get(path, 0), run.pairs(input_))
            if run.scene(input_).get("frame") == "all":
                counted.setdefault(path, [[run.pairs(input_)] * run.scene(input_)["frames"]])
    if not seen:
        return untested("neither path1 nor path2 was run")
    evidence = "; ".join(
        f"{path}: at most {words.plural(most, 'pair')} in "
        + (f"all {len(counted[path][0])} keyframes" if path in counted else "the one frame that was timed")
        for path, most in sorted(seen.items())
    )
    if any(most > 45 for most in seen.values()):
        return Verdict(FAILS, evidence)
    if set(counted) != set(PATHS):
        return untested(f"not every keyframe of both paths was run; {evidence}")
    return Verdict(HOLDS if all(most == 45 for most in seen.values()) else FAILS, evidence)


def limit(run):
    """aGPU2 takes at most 589,824 spheres."""
    timed = [n for path in PATHS for n, _ in _curve(run, path, "aGPU2")]
    if not timed:
        return untested("aGPU2 was not run on a device")
    if max(timed) > 589824:
        return Verdict(
            FAILS,
            f"aGPU2 built a chain of {words.count(max(timed))} spheres: its roots are handled by aGPU2 again",
        )
    return untested(f"the largest chain it built has {words.count(max(timed))} spheres")


def brute(run):
    times = [(path, paper.samples(run, path, 10000, "CPU1")[0]) for path in PATHS]
    times = [(path, t) for path, t in times if t is not None]
    if not times:
        return untested("CPU1 was not timed at 10,000 spheres")
    if any(statistics.rank_of_bound(len(t)) < 1 for _, t in times):
        return untested("CPU1 was timed at 10,000 spheres too few times for an interval of its median")
    times = [(path, statistics.median(t)) for path, t in times]
    evidence = "; ".join(
        f"{path}: {words.duration_interval(e)}" for path, e in times
    )
    return Verdict(HOLDS if all(e.low >= 1500 for _, e in times) else FAILS, evidence)


def encloses(run):
    rows = [row for row in run.list("examine") if row.get("arithmetic") == "literal"]
    if not rows:
        return untested("the run has no lines of catena examine")
    bad = [row for row in rows if row["failing"]]
    if not bad:
        return Verdict(HOLDS, f"every parent encloses its children in {words.plural(len(rows), 'chain')}")
    worst = max(bad, key=lambda row: row["failing"] / row["parents"])
    lost = sum(row["missing"] for row in rows)
    return Verdict(
        FAILS,
        (
            f"in binary32, {words.percent(worst['failing'], worst['parents'], 0)} of the parents of"
            f" {worst['input']} do not enclose a child; {words.plural(len(bad), 'chain')} of {len(rows)} have"
            f" such parents, and {words.plural(lost, 'pair')} in all are missed"
        ),
    )
