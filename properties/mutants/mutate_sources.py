#!/usr/bin/env python3
"""Mutates catena's own sources, one small change at a time, and asks whether the fast property tests notice.

A scratch copy of the tree is configured once; each mutant changes one place of one file, rebuilds only what depends on it
and runs the tests. Killed: it no longer compiles, a test fails, or it runs too long. The score and every survivor with
its line are printed, for somebody to explain or to write the missing test. Python's standard library only.

    mutate_sources.py --source . --work build/mutated --budget 1800 --seed 1 --paths variants core/policies
"""
import argparse
import random
import re
import shutil
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
TESTS = "Mutants.WithoutABugTheirBasePasses:Mutants.AllDie:Sizes*:Extremes*:TreeShape*:Flood*:Certificate*:Robust*:Level*:PairCollector*"


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--source", type=Path, default=Path(__file__).resolve().parents[2])
    parser.add_argument("--work", type=Path, required=True, help="scratch folder; emptied first")
    parser.add_argument("--budget", type=float, default=1800, help="seconds in all, the first build included")
    parser.add_argument("--seed", type=int, default=1, help="which mutants come first")
    parser.add_argument("--paths", nargs="+", default=["variants", "core/policies", "core/arithmetic"])
    parser.add_argument("--tests", default=TESTS, help="GoogleTest filter of the fast tests")
    parser.add_argument("--list", action="store_true", help="print the mutants and stop")
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


class Scratch:
    """A copy of the tree with a build of its own."""

    def __init__(self, source, work, tests):
        shutil.rmtree(work, ignore_errors=True)
        self.tree, self.build, self.tests = work / "tree", work / "build", tests
        shutil.copytree(source, self.tree, ignore=shutil.ignore_patterns("build", ".git", "reports"))
        self.run(["cmake", "-S", self.tree, "-B", self.build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                  "-DCATENA_CUDA=OFF", "-DCATENA_FCL=OFF", "-DCATENA_TESTS=ON"], None)

    @staticmethod
    def run(command, timeout):
        try:
            return subprocess.run([str(c) for c in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                  timeout=timeout)
        except subprocess.TimeoutExpired:
            return None

    def verdict(self, timeout):
        """How the tree as it is dies, or None when the tests notice nothing."""
        built = self.run(["cmake", "--build", self.build, "--target", "catena_tests"], None)
        if built.returncode != 0:
            return "does not compile"
        begin = time.monotonic()
        tested = self.run([self.build / "catena_tests", "--gtest_brief=1", "--gtest_fail_fast", f"--gtest_filter={self.tests}"],
                          timeout)
        self.test_seconds = time.monotonic() - begin
        if tested is None:
            return "runs too long"
        if tested.returncode == 0:
            return None
        failed = re.search(r"\[  FAILED  \] (\S+)", tested.stdout)
        return failed.group(1) if failed else f"ends with {tested.returncode}"


def main():
    options = arguments()
    end = time.monotonic() + options.budget
    mutants = mutants_of(options.source, options.paths)
    random.Random(options.seed).shuffle(mutants)
    if options.list:
        for file, number, old, new in sorted(mutants):
            print(f"{file}:{number}: {old.strip()}  ->  {new.strip()}")
        return 0

    scratch = Scratch(options.source, options.work, options.tests)
    wrong = scratch.verdict(None)
    if wrong:
        print(f"the tree fails as it is: {wrong}")
        return 2
    timeout = 5 + 3 * scratch.test_seconds

    killed, survivors, uncompiled = {}, [], 0
    for file, number, old, new in mutants:
        if time.monotonic() > end:
            break
        target = scratch.tree / file
        original = target.read_text()
        lines = original.splitlines(keepends=True)
        lines[number - 1] = new + "\n"
        target.write_text("".join(lines))
        by = scratch.verdict(timeout)
        target.write_text(original)
        if by == "does not compile":
            uncompiled += 1
        elif by:
            killed[by] = killed.get(by, 0) + 1
        else:
            survivors.append((file, number, old.strip(), new.strip()))
        print(f"{by or 'SURVIVES':40} {file}:{number}: {old.strip()}  ->  {new.strip()}", flush=True)

    total = sum(killed.values()) + len(survivors)
    print(f"\n{len(mutants)} possible, {total + uncompiled} tried in {options.budget:g} s, {uncompiled} do not compile")
    if total:
        print(f"score: {total - len(survivors)} of {total} killed, {100 * (total - len(survivors)) / total:.1f} %")
    for by, number in sorted(killed.items(), key=lambda item: -item[1]):
        print(f"  {number:5} by {by}")
    for file, number, old, new in survivors:
        print(f"survives: {file}:{number}: {old}  ->  {new}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
