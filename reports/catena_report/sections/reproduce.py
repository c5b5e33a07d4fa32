"""The exact command of every run, and how to make this page again."""
import shlex

from ..report import endings
from ..section import Code, Section


BUILT = "build/release/"  # where the preset puts the program


def build(report):
    section = Section("reproduce", "How to reproduce")
    for run in report.runs:
        commit = str(run.context.get("commit") or "")
        clean = commit.rstrip("+").removesuffix("-dirty")
        changed = "  # it was built with changes that no commit has" if clean != commit else ""
        lines = [f"git checkout {clean}{changed}"] if clean else []
        lines += ["cmake --preset release && cmake --build --preset release"]
        lines += [BUILT + run.catena["command"] if run.catena.get("command") else _without_options(run)]
        section.blocks.append(Code("\n".join(lines), report.label(run)))
    files = " ".join(map(shlex.quote, endings(list(dict.fromkeys(run.path for run in report.runs)))))
    section.blocks.append(
        Code(
            f"{BUILT}catena report --output report --from {files}",
            "This page from its run files; run.json beside it (and within it) holds every sample.",
        )
    )
    return section


def _without_options(run):
    """Google Benchmark's file names the program alone."""
    program = run.context.get("executable", "catena_bench")
    return f"{program} --benchmark_out=run.json  # and the options of then, which the run file does not tell"
