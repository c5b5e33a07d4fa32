"""The exact command of every run, and how to make this page again."""
import shlex

from ..section import Code, Section


def build(report):
    section = Section("reproduce", "How to reproduce")
    for run in report.runs:
        commit = str(run.context.get("commit", "")).rstrip("+").removesuffix("-dirty")
        lines = [f"git checkout {commit}"] if commit else []
        lines += ["cmake --preset release && cmake --build --preset release"]
        lines += [run.catena.get("command") or run.context.get("executable", "catena_bench")]
        section.blocks.append(Code("\n".join(lines), report.label(run)))
    files = " ".join(shlex.quote(run.path.name) for run in report.runs)
    section.blocks.append(
        Code(
            f"catena report --output report --from {files}",
            "This page from its run files; run.json beside it (and within it) holds every sample.",
        )
    )
    return section
