"""The exact command of every run, and how to make this page again."""
import shlex

from ..report import endings
from ..section import Code, Section


def build(report):
    section = Section("reproduce", "How to reproduce")
    for run in report.runs:
        commit = str(run.context.get("commit", "")).rstrip("+").removesuffix("-dirty")
        lines = [f"git checkout {commit}"] if commit else []
        lines += ["cmake --preset release && cmake --build --preset release"]
        lines += [run.catena.get("command") or _without_options(run)]
        section.blocks.append(Code("\n".join(lines), report.label(run)))
    files = " ".join(map(shlex.quote, endings(list(dict.fromkeys(run.path for run in report.runs)))))
    section.blocks.append(
        Code(
            f"catena report --output report --from {files}",
            "This page from its run files; run.json beside it (and within it) holds every sample.",
        )
    )
    return section


def _without_options(run):
    """Google Benchmark's file names the program alone."""
    program = run.context.get("executable", "catena_bench")
    return f"{program} --benchmark_out=run.json  # and the options of then, which the run file does not tell"
