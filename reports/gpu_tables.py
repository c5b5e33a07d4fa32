#!/usr/bin/env python3
"""gpu_tables.py RESULTS.json: the paper's Tables 3 and 4 beside a run of cuda/run_on_gpu.sh, as Markdown.

Every number comes from RESULTS.json (Google Benchmark's format, medians of its repetitions) or paper_tables.json.
Python's standard library only.
"""
import json
import pathlib
import statistics
import sys

# The paper's algorithm -> the variant and stage it was measured in.
STAGES = {
    "aCPU2": ("aCPU2+CPU2", "build"),
    "bGPU2": ("bGPU2+GPU2", "build"),
    "aGPU2": ("aGPU2+GPU2", "build"),
    "CPU2": ("aCPU2+CPU2", "find"),
    "GPU1": ("GPU1", "find"),
    "GPU2": ("aGPU2+GPU2", "find"),
    "GPUv2": ("aGPU2+GPUv2", "find"),
    "aGPU2 + GPU2, wall time with transfers": ("aGPU2+GPU2", "whole"),
}


def samples(run):
    """name -> milliseconds of every repetition."""
    found = {}
    for row in run["benchmarks"]:
        if row.get("run_type") == "iteration" and "error_occurred" not in row:
            found.setdefault(row["name"].removesuffix("/manual_time"), []).append(row["real_time"])
    return found


def main():
    run = json.load(open(sys.argv[1]))
    paper = json.load(open(pathlib.Path(__file__).parent / "paper_tables.json"))
    times = samples(run)

    def median(path, n, variant, stage):
        rows = times.get(f"{path}/n:{n}/{variant}/{stage}")
        return statistics.median(rows) if rows else None

    context = run["context"]
    print("# The paper's Tables 3 and 4 on a GPU of today\n")
    print("Milliseconds, median of the repetitions; host stages are wall time, device stages CUDA events, device cache "
          f"{context['device cache']}. Each answer was compared with the exact reference in the same run.\n")
    for key in ("gpu", "gpu driver", "gpu driver supports", "cuda toolkit", "cpu", "compiler", "flags", "commit", "date"):
        if key in context:
            print(f"- {key}: {context[key].strip()}")
    sizes = sorted({int(name.split("/")[1][2:]) for name in times})
    show = lambda ms: "" if ms is None else f"{ms:.3f}" if ms < 10 else f"{ms:.1f}"
    for path in ("path1", "path2"):
        print(f"\n## {path}\n\n| n | " + " | ".join(f"{n:,}" for n in sizes) + " |\n|---|" + "---:|" * len(sizes))
        for algorithm, (variant, stage) in STAGES.items():
            print(f"| {algorithm} | " + " | ".join(show(median(path, n, variant, stage)) for n in sizes) + " |")
            if algorithm in paper[path]:
                then = dict(zip(paper["n"], paper[path][algorithm]))
                print(f"| *{algorithm}, the paper* | " + " | ".join(show(then.get(n)) for n in sizes) + " |")

    print("\n## The paper's claims\n")
    for path in ("path1", "path2"):
        ratios = {n: median(path, n, "aGPU2+GPUv2", "find") / median(path, n, "aGPU2+GPU2", "find") for n in sizes
                  if median(path, n, "aGPU2+GPUv2", "find") and median(path, n, "aGPU2+GPU2", "find")}
        print(f"- {path}, GPUv2 takes half the time of GPU2: measured ratios "
              + ", ".join(f"{r:.2f} at n = {n:,}" for n, r in ratios.items()) + ".")
        faster = [n for n in sizes if median(path, n, "aCPU2+CPU2", "build") and median(path, n, "aGPU2+GPU2", "build")
                  and median(path, n, "aGPU2+GPU2", "build") < median(path, n, "aCPU2+CPU2", "build")]
        print(f"- {path}, aGPU2 is faster than aCPU2 from 20,000 spheres on: here (device-resident) at n = "
              + ", ".join(f"{n:,}" for n in faster) + ".")
        all_pairs = median(path, 150000, "GPU1", "find")
        if all_pairs:
            print(f"- {path}, GPU1 is the slowest traversal: {all_pairs:.1f} ms at n = 150,000, CPU2 "
                  f"{median(path, 150000, 'aCPU2+CPU2', 'find'):.1f} ms.")
    print("\n## Exact against literal, n = 150,000\n\n| | " + " | ".join(
        f"{path} {stage}" for path in ("path1", "path2") for stage in ("build", "find")) + " |\n|---|" + "---:|" * 4)
    for variant in ("GPU1", "aGPU2+GPU2", "aGPU2+GPUv2", "aCPU2+CPU2"):
        cells = []
        for path in ("path1", "path2"):
            for stage in ("build", "find"):
                exact, literal = median(path, 150000, variant, stage), median(path, 150000, variant + "/literal", stage)
                cells.append(f"{exact / literal:.2f}" if exact and literal else "")
        print(f"| {variant} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
