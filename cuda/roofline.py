#!/usr/bin/env python3
"""roofline.py CATENA OUT.json [VARIANT INPUT ...]: what bounds each kernel of a device variant.

Runs `CATENA detect INPUT --variant VARIANT` under ncu, and writes for the last launch of each kernel its time, the bytes
it moved through device memory and L2 and the warp instructions it issued, beside what the device was measured to do:
a copy from device to device (by CuPy), and of instructions one a cycle for each scheduler. The clocks are left alone.
"""
import csv
import datetime
import io
import json
import subprocess
import sys

INPUTS = ["path1:n=150000", "path1:n=1e7", "path2:n=1e7", "yarn:n=150000", "yarn:n=1e7", "mixed_radii:n=1e7,decades=3"]
VARIANTS = ["DeviceHybrid", "DeviceTree", "DeviceCapsules", "DeviceGrid", "DeviceLBVH"]
ENDLESS = {("DeviceTree", "yarn:n=1e7")}  # a tangle, of which the chain's order says nothing
METRICS = {
    "us": ("gpu__time_duration.sum", 1e-3),
    "device_memory_bytes": ("dram__bytes.sum", 1),
    "device_memory_percent_of_peak": ("dram__throughput.avg.pct_of_peak_sustained_elapsed", 1),
    "l2_bytes": ("lts__t_bytes.sum", 1),
    "l2_percent_of_peak": ("lts__throughput.avg.pct_of_peak_sustained_elapsed", 1),
    "warp_instructions": ("smsp__inst_executed.sum", 1),
    "issue_slots_percent": ("smsp__issue_active.avg.pct_of_peak_sustained_active", 1),
    "lanes_active": ("smsp__thread_inst_executed_per_inst_executed.ratio", 1),
    "warps_resident_percent": ("sm__warps_active.avg.pct_of_peak_sustained_active", 1),
    "registers": ("launch__registers_per_thread", 1),
}


def run(*command):
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout


def copy_bytes_per_second():
    """Read and written, the best of ten copies of 2 GiB."""
    import cupy

    source = cupy.ones(2**31, dtype=cupy.uint8)
    target = cupy.empty_like(source)
    begin, end = cupy.cuda.Event(), cupy.cuda.Event()
    best_ms = float("inf")
    for _ in range(10):
        begin.record()
        cupy.copyto(target, source)
        end.record()
        end.synchronize()
        best_ms = min(best_ms, cupy.cuda.get_elapsed_time(begin, end))
    return 2 * source.nbytes / (best_ms * 1e-3)


def profile(catena, variant, chain):
    log = run("ncu", "--clock-control", "none", "--csv", "--page", "raw", "--print-units", "base",
              "--print-kernel-base", "function", "--metrics", ",".join(name for name, _ in METRICS.values()),
              catena, "detect", chain, "--variant", variant, "--pair-limit", "4000000000")  # with the pairs
    rows = list(csv.reader(io.StringIO(log[log.index('"ID"'):])))
    column = {name: k for k, name in enumerate(rows[0])}
    kernels = {}
    for row in rows[2:]:  # after the units
        if len(row) < len(rows[0]):
            continue
        number = lambda metric: float(row[column[metric]].replace(",", "") or 0)
        kernels[row[column["Kernel Name"]]] = {
            key: round(number(metric) * factor, 3) for key, (metric, factor) in METRICS.items()}
    kernels.pop("probe", None)
    return kernels


def main(catena, out, *cases):
    pairs = list(zip(cases[::2], cases[1::2])) or [(v, i) for i in INPUTS for v in VARIANTS if (v, i) not in ENDLESS]
    gpu, driver = run("nvidia-smi", "--query-gpu=name,driver_version", "--format=csv,noheader").splitlines()[0].split(", ")
    result = {
        "what": "kernels under ncu; of a variant's kernel of that name the last launch",
        "gpu": gpu, "driver": driver, "date": datetime.date.today().isoformat(),
        "catena": run(catena, "--version").strip(),
        "ceilings": {"copy_bytes_per_second": round(copy_bytes_per_second())},
        "runs": [],
    }
    for variant, chain in pairs:
        kernels = profile(catena, variant, chain)
        result["runs"].append({"variant": variant, "input": chain, "kernels": kernels})
    with open(out, "w", encoding="utf-8") as file:
        json.dump(result, file, indent=1)
        file.write("\n")


if __name__ == "__main__":
    if len(sys.argv) < 3 or len(sys.argv) % 2 == 0:  # a variant without its input measures nothing that was asked
        print(__doc__, file=sys.stderr)
        sys.exit(2)
    main(*sys.argv[1:])
