#!/usr/bin/env python3
"""Mutates catena's own sources, one small change at a time, and asks whether the fast property tests notice.

A scratch copy of the tree is configured once; each mutant changes one place of one file, rebuilds only what depends on it
and runs the tests. Killed: a test fails, or it runs too long; what does not compile is not counted. The score and every
survivor with its line are printed. A survivor must be explained in equivalent_mutants.tsv beside this file (file, line as
it is, line as mutated, why nobody can tell them apart): one that is not fails the run, and so does an explanation of a
mutant that dies, or of a line that is no more. Python's standard library only.

    mutate_sources.py --source . --work build/mutated --budget 1800 --seed 1 --paths variants core/policies
"""
import argparse
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

# What to look for, what to put there. Comments, #-lines, strings and templates' angle brackets are left alone.
OPERATORS = [
    (r"(?<= )<(?= )", "<="), (r"(?<= )<=(?= )", "<"), (r"(?<= )>(?= )", ">="), (r"(?<= )>=(?= )", ">"),
    (r"==", "!="), (r"!=", "=="), (r"&&", "||"), (r"\|\|", "&&"),
    (r"(?<= )\+(?= )", "-"), (r"(?<= )-(?= )", "+"), (r"(?<= )\*(?= )", "+"),
    (r"\btrue\b", "false"), (r"\bfalse\b", "true"), (r"(?<=[(=&| ])!(?=\w)", ""),
    (r"\.left\b", ".right"), (r"\.right\b", ".left"), (r"(?<![\w.])1(?![\w.])", "2"), (r"(?<![\w.])0(?![\w.])", "1"),
    (r"(?<![\w.])2(?![\w.])", "3"), (r"\+\+(?=\w)", "--"), (r"\bcontinue;", ";"),
]
LEFT_ALONE = re.compile(r"^\s*(//|#|\*|template|using|namespace|static_assert)|summary|\.name =|= default|throw ")
# Labels of ctest, in this order: seconds kill most mutants, and only the others meet the tests that take a minute.
TESTS = ["kills-in-seconds", "kills-in-a-minute"]


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--source", type=Path, default=Path(__file__).resolve().parents[2])
    parser.add_argument("--work", type=Path, required=True, help="scratch folder; emptied first")
    parser.add_argument("--budget", type=float, default=1800, help="seconds in all, the first build included")
    parser.add_argument("--seed", type=int, default=1, help="which mutants come first")
    parser.add_argument("--paths", nargs="+", default=["variants", "core/policies", "core/cells", "core/arithmetic"])
    parser.add_argument("--tests", nargs="+", default=TESTS, help="labels of the tests, in order")
    parser.add_argument("--list", action="store_true", help="print the mutants and stop")
    parser.add_argument("--sample", type=int, help="try only so many")
    parser.add_argument("--shard", default="0/1", help="K/N: of N runs with the same seed this is number K, from 0")
    parser.add_argument("--reuse", action="store_true", help="take WORK/tree and WORK/build as they are")
    return parser.parse_args()


def mutants_of(source, paths):
    """Every (file, line number, old line, new line), each a single change."""
    found = []
    for path in paths:
        for file in sorted((source / path).glob("*")):
            if file.suffix not in (".h", ".cpp") or file.stem.endswith("_test"):
                continue
            for number, line in enumerate(file.read_text().splitlines(), 1):
                code = re.sub(r"(?<!:)//.*", "", line)
                if LEFT_ALONE.search(line):
                    continue
                for pattern, replacement in OPERATORS:
                    for match in re.finditer(pattern, code):
                        if code[:match.start()].count('"') % 2:
                            continue
                        new = line[:match.start()] + replacement + line[match.end():]
                        found.append((file.relative_to(source), number, line, new))
    return found


def explained(source):
    """(file, old line, new line) of every mutant that is known to change nothing, with the reason."""
    reasons = {}
    for line in (source / "properties/mutants/equivalent_mutants.tsv").read_text().splitlines():
        if line and not line.startswith("#"):
            file, old, new, why = line.split("\t")
            reasons[file, old, new] = why
    return reasons


class Scratch:
    """A copy of the tree with a build of its own."""

    def __init__(self, source, work, tests, reuse):
        self.tree, self.build, self.tests, self.limits = work / "tree", work / "build", tests, {}
        if reuse:
            return
        shutil.rmtree(work, ignore_errors=True)
        shutil.copytree(source, self.tree, ignore=shutil.ignore_patterns("build", ".git"))
        self.run(["cmake", "-S", self.tree, "-B", self.build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                  "-DCMAKE_CXX_FLAGS_RELEASE=-O1", "-DCATENA_CUDA=OFF", "-DCATENA_TESTS=ON",
                  *(f"-DCATENA_{peer}=OFF" for peer in ("FCL", "EMBREE", "NANOFLANN", "BULLET"))], None)

    @staticmethod
    def run(command, timeout):
        """None when the time is up; what the command started ends with it: a mutant may loop in a child of the tests."""
        with subprocess.Popen([str(c) for c in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              start_new_session=True) as process:
            try:
                output, _ = process.communicate(timeout=timeout)
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
                return None
        return subprocess.CompletedProcess(command, process.returncode, output)

    def verdict(self):
        """How the tree as it is dies, or None when the tests notice nothing."""
        built = self.run(["cmake", "--build", self.build, "--target", "catena_tests"], None)
        if built.returncode != 0:
            return "does not compile"
        for label in self.tests:
            begin = time.monotonic()
            tested = self.run(["ctest", "--test-dir", self.build, "--label-regex", f"^{label}$", "--stop-on-failure",
                               "--no-tests=error"], self.limits.get(label))
            if tested is None:
                return "runs too long"
            if tested.returncode != 0:
                failed = re.search(r"^\s*\d+ - (.+) \(\S+\)$", tested.stdout, re.MULTILINE)
                return failed.group(1) if failed else f"ends with {tested.returncode}"
            self.limits.setdefault(label, 5 + 3 * (time.monotonic() - begin))  # first by the tree without a mutant
        return None


def main():
    options = arguments()
    end = time.monotonic() + options.budget
    mutants = mutants_of(options.source, options.paths)
    reasons = explained(options.source)
    known = {(str(file), old.strip(), new.strip()) for file, _, old, new in mutants}
    wrong = [f"an explanation of what is no more: {file}: {old}  ->  {new}" for file, old, new in reasons
             if Path(file).parts[0] in {Path(p).parts[0] for p in options.paths} and (file, old, new) not in known]
    random.Random(options.seed).shuffle(mutants)
    shard, shards = map(int, options.shard.split("/"))
    mutants = mutants[:options.sample][shard::shards]
    if options.list:
        for file, number, old, new in sorted(mutants):
            print(f"{file}:{number}: {old.strip()}  ->  {new.strip()}")
        return 0

    scratch = Scratch(options.source, options.work, options.tests, options.reuse)
    broken = scratch.verdict()
    if broken:
        print(f"the tree fails as it is: {broken}")
        return 2

    killed, survivors, uncompiled = {}, [], 0
    for file, number, old, new in mutants:
        if time.monotonic() > end:
            break
        target = scratch.tree / file
        original = target.read_text()
        lines = original.splitlines(keepends=True)
        lines[number - 1] = new + "\n"
        target.write_text("".join(lines))
        by = scratch.verdict()
        target.write_text(original)
        reason = reasons.get((str(file), old.strip(), new.strip()))
        if reason and by and by != "does not compile":
            wrong.append(f"explained, but killed by {by}: {file}:{number}: {old.strip()}  ->  {new.strip()}")
        if by == "does not compile":
            uncompiled += 1
        elif by:
            killed[by] = killed.get(by, 0) + 1
        else:
            survivors.append((file, number, old.strip(), new.strip(), reason))
            if not reason:
                wrong.append(f"survives, unexplained: {file}:{number}: {old.strip()}  ->  {new.strip()}")
        print(f"{by or 'SURVIVES':40} {file}:{number}: {old.strip()}  ->  {new.strip()}", flush=True)

    total = sum(killed.values()) + len(survivors)
    print(f"\n{len(mutants)} possible, {total + uncompiled} tried in {options.budget:g} s, {uncompiled} do not compile")
    if total:
        print(f"score: {total - len(survivors)} of {total} killed, {100 * (total - len(survivors)) / total:.1f} %")
    for by, number in sorted(killed.items(), key=lambda item: -item[1]):
        print(f"  {number:5} by {by}")
    for file, number, old, new, reason in survivors:
        if reason:
            print(f"survives as it must: {file}:{number}: {old}  ->  {new}: {reason}")
    print("\n".join(wrong))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
