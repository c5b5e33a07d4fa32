"""What bounds the kernels of the device's searches: the committed run of cuda/roofline.py, where it is at hand.

It is data of the card that it names, and no claim about the machine of this page's runs.
"""
import html
import json
import pathlib

from .. import words
from ..section import Prose, Section
from ..table import Cell, Table

PATH = pathlib.Path(__file__).parents[2] / "results" / "h200_roofline.json"
SHOWN = 0.05  # of a search's time, for a kernel to have a row


def build(report):
    if not PATH.exists():  # installed without the results
        return None
    stored = json.loads(PATH.read_text(encoding="utf-8"))
    return Section("roofline", "What bounds the GPU's searches", [_prose(stored), _table(stored)])


def bound(kernel, copy):
    """("memory", "L2", "instructions" or "latency", its share of what the card does): what a kernel is nearest to, of bytes
    through device memory against a copy, bytes through L2 and instructions issued against their peaks; latency where
    all are below 40 %.
    """
    share = {
        "memory": kernel["device_memory_bytes"] / (kernel["us"] * 1e-6) / copy,
        "L2": kernel["l2_percent_of_peak"] / 100,
        "instructions": kernel["issue_slots_percent"] / 100,
    }
    nearest = max(share, key=share.get)
    return (nearest, share[nearest]) if share[nearest] >= 0.4 else ("latency", share[nearest])


def rows(stored):
    """(input, variant, kernel, its numbers, its share of the search's time) of the kernels that matter."""
    found = []
    for run in stored["runs"]:
        whole = sum(kernel["us"] for kernel in run["kernels"].values())
        for name, kernel in sorted(run["kernels"].items(), key=lambda item: -item[1]["us"]):
            if kernel["us"] >= SHOWN * whole:
                found.append((run["input"], run["variant"], name, kernel, kernel["us"] / whole))
    return found


def _prose(stored):
    return Prose(
        f"Measured under <code>ncu</code> on {html.escape(stored['gpu'])}, driver {html.escape(stored['driver'])}, on"
        f" {html.escape(stored['date'])}, and committed; no claim about other machines on this page. A copy from device to"
        f" device moved {words.significant(stored['ceilings']['copy_bytes_per_second'] / 1e12, 3)} TB/s there. Laid-out"
        " chains are bound by reading the spheres once (<code>enclose_blocks</code>); tangles by the search of single"
        " spheres, whose threads find different numbers of neighbours and wait for them, and by sorting, whose counters"
        " fill L2 and whose scattered writes wait. Under <code>ncu</code> kernels run one after the other, each with its"
        " start: short ones take longer than they do in a graph."
    )


def _table(stored):
    copy = stored["ceilings"]["copy_bytes_per_second"]
    body = []
    for input_, variant, name, kernel, share in rows(stored):
        what, of_peak = bound(kernel, copy)
        megabytes = kernel["device_memory_bytes"] / 1e6
        body.append(
            [
                input_,
                variant,
                name,
                f"{what}, {100 * of_peak:.0f} %",
                Cell(words.significant(kernel["us"], 3), kernel["us"]),
                Cell(f"{100 * share:.0f} %", share),
                Cell(words.significant(megabytes, 3), megabytes),
                Cell(words.significant(kernel["warp_instructions"] / 1e6, 3), kernel["warp_instructions"]),
                Cell(words.significant(kernel["lanes_active"], 3), kernel["lanes_active"]),
            ]
        )
    return Table(
        "roofline",
        "Kernels of the device's searches, and what each is nearest to",
        "The last launch of each kernel that takes at least 5 % of its search.",
        ["chain", "variant", "kernel", "nearest to", "µs", "of the search", "MB", "million warp instructions", "lanes active"],
        body,
        words=4,
    )
