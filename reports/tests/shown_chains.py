"""views[] of a run file (run_file.md) made for tests of the viewer: small chains whose pairs are found here by brute force."""
import base64
import itertools

import numpy

COUNT = 160
RADIUS = 1.0
# In which space repeats: plain, tilted by more than half an edge, and not along every edge.
BOXES = {"plain/n:60": [12, 9, 10, 0, 0, 0], "tilted/n:60": [12, 9, 10, 8, -7, 6], "slab/n:60": [12, 9, 0, 3, 0, 0]}


def packed(array):
    return base64.b64encode(numpy.ascontiguousarray(array).tobytes()).decode()


def unpacked(views):
    """The views of what viewer.render packed them as."""
    return [
        {key: [*map(_in_rows, value)] if key in ("frames", "levels") else value for key, value in view.items()} for view in views
    ]


def _in_rows(entry):
    return {key: _rows(value, {"spheres": 4, "pairs": 2}[key]) if key in ("spheres", "pairs") else value for key, value in entry.items()}


def _rows(text, width):
    byte = numpy.frombuffer(base64.b64decode(text), numpy.uint8).reshape(4, width, -1).astype(numpy.uint32)
    steps = sum(byte[k] << numpy.uint32(8 * k) for k in range(4))
    return packed(numpy.cumsum(steps, axis=1, dtype=numpy.uint32).T)


def hairpin(gap):
    """Out along x, round, and back at `gap` radii: touches itself when gap <= 2."""
    step, half = 1.6 * RADIUS, COUNT // 2
    out = numpy.arange(half) * step
    bow = 3 * numpy.exp(-((out - out[-1]) / (4 * step)) ** 2)  # the turn is wider than the tube
    rows = numpy.zeros((COUNT, 4))
    rows[:, 0] = numpy.concatenate([out, out[::-1]])
    rows[:, 1] = numpy.concatenate([-gap / 2 - bow, (gap / 2 + bow)[::-1]])
    rows[:, 2] = 4 * numpy.sin(rows[:, 0] / 20)
    rows[:, 3] = RADIUS
    return rows


def pairs_of(rows):
    rows = rows.astype(numpy.float32).astype(float)
    apart = numpy.linalg.norm(rows[:, None, :3] - rows[None, :, :3], axis=2)
    touching = apart <= rows[:, None, 3] + rows[None, :, 3]
    i, j = numpy.nonzero(numpy.triu(touching, 2))
    return numpy.stack([i, j], 1).astype(numpy.uint32)


def depths_in(rows, box):
    """{(i, j): how deep} of what collides in a space that a box (as run_file.md has it) repeats: by all images near."""
    rows = rows.astype(numpy.float32).astype(float)
    edges = numpy.array([[box[0], 0, 0], [box[3], box[1], 0], [box[4], box[5], box[2]]])
    reach = [range(-2, 3) if length else (0,) for length in box[:3]]
    shifts = numpy.array([numpy.array(steps) @ edges for steps in itertools.product(*reach)])
    ways = rows[:, None, None, :3] - rows[None, :, None, :3] - shifts
    depth = rows[:, None, 3] + rows[None, :, 3] - numpy.linalg.norm(ways, axis=3).min(2)
    return {(int(i), int(j)): depth[i, j] for i, j in zip(*numpy.nonzero(numpy.triu(depth >= 0, 2)))}


def boxed(name, box):
    """A walk through a box that repeats, wrapped into it as simulations write it."""
    generator = numpy.random.default_rng(7)
    rows = numpy.ones((60, 4))
    steps = generator.normal(size=(60, 3))
    rows[:, :3] = numpy.cumsum(2.2 * steps / numpy.linalg.norm(steps, axis=1)[:, None], axis=0)
    for axis, length in enumerate(box[:3]):
        if length:
            rows[:, axis] %= length
    found = depths_in(rows, box)
    pairs = numpy.array(list(found), numpy.uint32)
    frame = {"frame": 0, "spheres": packed(rows.astype(numpy.float32)), "pairs": packed(pairs), "box": box}
    return {"input": name, "command": "", "frames": [frame], "strands": [0], "closed": [False]}, found


def levels_of(rows):
    """Boxes' circumscribed spheres of 1, 2, 4, ... neighbours in chain order: enough to be seen."""
    levels, width = [], 1
    while width < 2 * len(rows):
        bounds = []
        for first in range(0, len(rows), width):
            part = rows[first:first + width]
            centre = (part[:, :3].max(0) + part[:, :3].min(0)) / 2
            bounds.append([*centre, (numpy.linalg.norm(part[:, :3] - centre, axis=1) + part[:, 3]).max()])
        levels.append({"level": len(levels), "spheres": packed(numpy.array(bounds, numpy.float32))})
        width *= 2
    return levels


def view(name, frames, wrong=(), offset=0.0, scale=1.0):
    """frames: {number: rows}; offset and scale change no pair."""
    shown = []
    for number, rows in frames.items():
        moved = (rows + numpy.array([offset, offset, -offset, 0])) * scale
        shown.append({"frame": number, "spheres": packed(moved.astype(numpy.float32)), "pairs": packed(pairs_of(rows))})
    first = (next(iter(frames.values())) + numpy.array([offset, offset, -offset, 0])) * scale
    return {"input": name, "command": f"catena detect {name.replace('/n:', ':n=')} --frame all --variant CPU1 --pairs pairs.csv",
            "frames": shown, "strands": [0], "closed": [False], "levels": levels_of(first), "wrong": list(wrong)}


def on_grid(rows):
    """Coordinates that stay the same binary32 numbers when 2^18 is added."""
    rows = rows.copy()
    rows[:, :3] = numpy.round(rows[:, :3] * 16) / 16
    return rows


def views():
    near = hairpin(1.9)
    found = pairs_of(near).tolist()
    # Frames 0, 10 and 20; only the last one touches.
    hair = view("hairpin/n:160", {0: hairpin(6), 10: hairpin(4), 20: near},
                [{"variant": "aCPU2+CPU2/literal", "frame": 20, "missing": found[:3], "invented": [[10, 40], [20, 50]]}])
    grid = on_grid(near)
    return [hair, view("near/n:160", {0: grid}), view("far/n:160", {0: grid}, offset=2.0 ** 18),
            view("huge/n:160", {0: grid}, scale=2.0 ** 115), view("tiny/n:160", {0: grid}, scale=2.0 ** -115),
            *(boxed(name, box)[0] for name, box in BOXES.items())]
