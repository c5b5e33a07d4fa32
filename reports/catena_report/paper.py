"""The paper's own measurements, and which variant and stage is each of its algorithms."""
import json
import pathlib

from .runfile import n_of, scene_of

PATH = pathlib.Path(__file__).parent / "paper_tables.json"

# The paper's algorithm -> the variant and stage it is measured in.
STAGES = {
    "aGPU2": ("aGPU2+GPU2", "build"),
    "aCPU2": ("aCPU2+CPU2", "build"),
    "bGPU2": ("bGPU2+GPU2", "build"),
    "GPU1": ("GPU1", "find"),
    "GPU2": ("aGPU2+GPU2", "find"),
    "GPUv2": ("aGPU2+GPUv2", "find"),
    "CPU2": ("aCPU2+CPU2", "find"),
    "CPU1": ("CPU1", "find"),
}
WITH_TRANSFERS = "aGPU2 + GPU2, wall time with transfers"  # not in the paper: what a caller waits for
STAGES[WITH_TRANSFERS] = ("aGPU2+GPU2", "whole")
TABLES = {"path1": "Table 3", "path2": "Table 4"}
CONSTRUCTIONS = ("aGPU2", "aCPU2", "bGPU2")
ON_HOST = ("aCPU2", "CPU2", "CPU1")
EVERY_KEYFRAME = ":frames=all"  # of a path that is timed as the paper did; without, it is the middle one


def tables():
    """{source, n: [...], path1: {algorithm: [ms]}, path2: {...}}"""
    return json.loads(PATH.read_text(encoding="utf-8"))


def samples(run, path, n, algorithm):
    """(milliseconds a frame, variant) of the paper's algorithm in a run, through every keyframe if it was
    timed so; (None, variant) if it was not timed.
    """
    variant, stage = STAGES[algorithm]
    every, one = (run.samples.get((f"{path}{frames}/n:{n}", variant, stage)) for frames in (EVERY_KEYFRAME, ""))
    return (one if every is None else every), variant


def path_of(input_):
    """The path that an input shows, all of it or a frame; None if it is another scene."""
    scene = scene_of(input_).removesuffix(EVERY_KEYFRAME)
    return scene if scene in TABLES else None


def sizes(run, path):
    """Every n at which some algorithm of the paper was measured on a path."""
    return sorted(
        {
            n_of(case[0])
            for case in run.samples
            if path_of(case[0]) == path and case[1:] in STAGES.values()
        }
    )
