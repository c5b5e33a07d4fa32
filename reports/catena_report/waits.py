"""How long a caller waits, by what is asked: three views, each {input: {variant: milliseconds of every
repetition}} of the exact variants of catena and of the peers. A variant that failed on a chain by a fault of its own
is in none of them, whatever it took until then.
"""


def end_to_end(run):
    """From a chain in the host's memory to collisions there: the samples of `whole`. Of a variant on the host
    alone, between whose stages nothing moves, build and find where `whole` was not timed.
    """
    return _view(run, _whole)


def resident(run):
    """A chain that is on the device and stays there, as does the answer: `resident`, or the two stages by the
    device's clock. Only variants whose stages are all on the device.
    """
    return _view(run, _on_device)


def moving(run):
    """A chain that moves, from one frame to the next: update() of `coherence` by the wall clock, the find that
    follows, and on a device the way of the answer back, which that find's time leaves out.
    """
    updates = {(row["input"], row["variant"]): row["update_ms"] for row in run.list("coherence")}

    def time(run, input_, variant):
        update, find = updates.get((input_, variant)), run.samples.get((input_, variant, "find"))
        if not update or find is None:
            return None
        size = min(len(find), len(update))
        back = _median_moved(run, (input_, variant, "find")) - _median_moved(run, (input_, variant, "build"))
        return find[:size] + update[:size] + max(0.0, back)

    return _view(run, time)


def _view(run, time):
    found, failed = {}, {case[:2] for case in run.faults}
    for input_ in run.inputs():
        for variant in run.variants():
            info = run.info(variant)
            asked = (info.recommended or info.peer) and (input_, variant) not in failed
            times = time(run, input_, variant) if asked else None
            if times is not None:
                found.setdefault(input_, {})[variant] = times
    return found


def _whole(run, input_, variant):
    whole = run.samples.get((input_, variant, "whole"))
    return whole if whole is not None or not run.info(variant).host_only else _stages(run, input_, variant)


def _on_device(run, input_, variant):
    if not run.info(variant).device_only:
        return None
    resident = run.samples.get((input_, variant, "resident"))
    return _stages(run, input_, variant) if resident is None else resident


def _stages(run, input_, variant):
    build, find = (run.samples.get((input_, variant, stage)) for stage in ("build", "find"))
    if build is None or find is None:
        return None if run.info(variant).composed else find  # complete in itself: may have nothing to build
    size = min(len(build), len(find))
    return build[:size] + find[:size]


def _median_moved(run, case):
    moved = sorted(run.moved.get(case, [0.0]))
    return moved[len(moved) // 2]
