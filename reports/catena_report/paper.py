"""The paper's own measurements, and which variant and stage is each of its algorithms."""
import json
import pathlib

PATH = pathlib.Path(__file__).parent.parent / "paper_tables.json"

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


def tables():
    """{source, n: [...], path1: {algorithm: [ms]}, path2: {...}}"""
    return json.loads(PATH.read_text(encoding="utf-8"))


def samples(run, path, n, algorithm):
    """(milliseconds, variant) of the paper's algorithm in a run; (None, None) if it was not measured."""
    variant, stage = STAGES[algorithm]
    return run.samples.get((f"{path}/n:{n}", variant, stage)), variant


def sizes(run, path):
    """Every n at which some algorithm of the paper was measured on a path."""
    return sorted(
        {
            int(case[0].rpartition("/n:")[2])
            for case in run.samples
            if case[0].startswith(path + "/n:") and case[1:] in STAGES.values()
        }
    )
