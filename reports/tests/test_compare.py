"""Two runs compared: every verdict on samples whose law is known, and the exit codes a CI rests on."""
import contextlib
import io
import json
import tempfile
import unittest
import unittest.mock

import made
from catena_report import __main__ as command
from catena_report import gate, paired, runfile, work


def compared(old, new, *options):
    """(exit code, stdout, stderr) of --compare."""
    with tempfile.TemporaryDirectory() as folder:
        paths = [
            str(made.write(folder, value, name)) for value, name in ((old, "old.json"), (new, "new.json"))
        ]
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code = command.main(["--compare", *paths, *options])
    return code, out.getvalue(), err.getvalue()


def verdicts(old, new):
    """{variant/stage: verdict}."""
    old, new = runfile.Run("old", old), runfile.Run("new", new)
    return {family.name: family.verdict for family in gate.decide(paired.cases(old, new))[0]}


def multiplied(run, factor, where=lambda name: True):
    """The run with its times multiplied, as a slower program would have them."""
    rows = [
        row | {"real_time": row["real_time"] * factor} if "real_time" in row and where(row["name"]) else row
        for row in run["benchmarks"]
    ]
    return run | {"benchmarks": rows}


class Compare(unittest.TestCase):
    def test_a_slower_variant_is_caught_and_nothing_else(self):
        old, new = made.run(repetitions=12, seed=1), made.run(
            repetitions=12, seed=2, slower={("aCPU2+Dual", "find"): 1.3}
        )
        found = verdicts(old, new)
        slower = {name for name, verdict in found.items() if verdict == gate.SLOWER}
        self.assertEqual(slower - {"aCPU2+Dual/whole"}, {"aCPU2+Dual/find"})
        self.assertNotIn(gate.FASTER, found.values())
        self.assertEqual(compared(old, new)[0], 1)

    def test_a_gate_that_sees_a_doubled_time_in_any_family_stands(self):
        families = [gate.Family("V", str(seen), 4, 1, 1, 1, 1, seen, gate.SAME) for seen in (1.5, 3)]
        with unittest.mock.patch.object(gate, "decide", return_value=(families, [])):
            self.assertEqual(compared(made.run(), made.run(seed=2))[0], 0)

    def test_what_stayed_is_not_slower_when_most_became_faster(self):
        old = made.run(repetitions=12, seed=1)
        faster = {(variant, "find"): 0.9 for variant in made.COSTS} | {(variant, "build"): 0.9 for variant in made.COSTS}
        stayed = [key for key in faster if key[0] == "aCPU2+CPU2"]
        new = made.run(repetitions=12, seed=2, slower={k: v for k, v in faster.items() if k not in stayed})
        self.assertNotIn(gate.SLOWER, verdicts(old, new).values())
        self.assertEqual(compared(old, new)[0], 0)

    def test_the_other_way_round_is_faster(self):
        old, new = made.run(repetitions=12, seed=1, slower={("aCPU2+Dual", "find"): 1.3}), made.run(
            repetitions=12, seed=2
        )
        self.assertEqual(verdicts(old, new)["aCPU2+Dual/find"], gate.FASTER)
        self.assertEqual(compared(old, new)[0], 0)

    def test_the_same_run_is_the_same(self):
        run = made.run(repetitions=30)
        found = verdicts(run, run)
        self.assertLessEqual(set(found.values()), {gate.SAME, gate.UNDECIDED})
        code, out, _ = compared(run, run)
        self.assertEqual(code, 0)
        self.assertRegex(out, r"what would have been seen in 95 %: 1\.0\d+ in the surest family")
        self.assertIn("the counts of all", out)

    def test_noise_is_undecided_not_slower(self):
        found = set(verdicts(made.run(noise=0.2, seed=1), made.run(noise=0.2, seed=2)).values())
        self.assertIn(gate.UNDECIDED, found)
        self.assertNotIn(gate.SLOWER, found)

    def test_a_run_multiplied_by_a_thousand_is_seen(self):
        run = made.run(repetitions=6)
        code, out, _ = compared(run, multiplied(run, 1000))
        self.assertEqual(code, 1)
        self.assertIn("slower", out)

    def test_a_slower_algorithm_is_seen_where_variants_share_it(self):
        old = made.run(repetitions=6, seed=1)
        new = multiplied(made.run(repetitions=6, seed=2), 2.2, lambda name: "/aGPU2+" in name and "/build" in name)
        found = verdicts(old, new)
        self.assertEqual({found[name] for name in ("aGPU2+*/build", "aGPU2+GPU2/build")}, {gate.SLOWER})
        self.assertNotIn("*+CPU2/find", found)  # only one variant has it
        self.assertEqual(compared(old, new)[0], 1)

    def test_one_repetition_is_no_gate(self):
        code, _, err = compared(made.run(repetitions=1, seed=1), made.run(repetitions=1, seed=2, noise=0.1))
        self.assertEqual(code, 2)
        self.assertIn("more --repetitions", err)

    def test_a_case_no_longer_answered_is_a_regression(self):
        old, new = made.run(repetitions=12, seed=1), made.run(repetitions=12, seed=2)
        for row in new["benchmarks"]:
            if row["name"].startswith("path2/n:1000/GPU1/find"):
                row |= {"error_occurred": True, "error_message": "3 pairs missing"}
        code, out, _ = compared(old, new)
        self.assertEqual(code, 1)
        self.assertIn("no longer answered: 3 pairs missing", out)

    def test_a_fault_after_good_samples_is_a_regression(self):
        """What catena_bench writes when a sample throws in a later round; and of a case that OLD did not have."""
        old, thrown = made.run(repetitions=2), {"error_occurred": True, "error_message": "Hybrid: bad_alloc"}
        old["benchmarks"] = [row for row in old["benchmarks"] if row["name"].startswith("path2/n:1000/GPU1/")]
        for name in ("path2/n:1000/GPU1/find", "path2/n:9/GPU1/find"):
            faulty = {"name": name, "run_type": "iteration", **thrown}
            new = old | {"benchmarks": [*old["benchmarks"], faulty | {"at_fault": True}]}
            code, out, _ = compared(old, new)
            told = "no longer answered" if name.startswith("path2/n:1000/") else "failed"
            self.assertEqual((code, out.count("bad_alloc")), (1, 1), name)
            self.assertIn(f"{name}: {told}: Hybrid: bad_alloc", out)
            self.assertNotIn("bad_alloc", compared(new, new)[1])  # it failed before
        code, out, _ = compared(old, old | {"benchmarks": [faulty | {"at_fault": True}]})
        self.assertEqual((code, out.count("failed: Hybrid: bad_alloc")), (1, 1))

    def test_a_peer_that_got_worse_is_told_and_fails_nothing(self):
        old, new = made.run(repetitions=12, seed=1), made.run(
            repetitions=12, seed=2, slower={("aCPU2+Dual", "find"): 1.3}
        )
        for row in new["benchmarks"]:
            if row["name"].startswith("path2/n:1000/aCPU2+Dual/whole"):
                row |= {"error_occurred": True, "error_message": "its library has not been found"}
        for row in new["catena"]["counts"]:
            row["bytes"] *= 2 if row["variant"] == "aCPU2+Dual" else 1
        self.assertEqual(compared(old, new)[0], 1)
        for run in (old, new):
            run["catena"]["variants"]["aCPU2+Dual"]["peer"] = True
        code, out, _ = compared(old, new)
        self.assertEqual(code, 0, out)
        self.assertIn("as these are peers: aCPU2+Dual", out)

    def peer_that_broke(self):
        """(OLD, NEW) of one case of a peer: timed, and thrown in NEW."""
        described = {"FCL": made.described("FCL")}
        name = "path1/n:1000/FCL/find"
        timed = [{"name": name, "run_type": "iteration", "real_time": 1e6 + k, "time_unit": "ns"} for k in range(12)]
        thrown = [{"name": name, "run_type": "iteration", "error_occurred": True, "error_message": "bad_alloc", "at_fault": True}]
        return [{"context": {}, "benchmarks": rows, "catena": {"schema": 1, "variants": described}} for rows in (timed, thrown)]

    def test_a_peer_that_broke_fails_nothing_where_nothing_else_was_timed(self):
        code, out, err = compared(*self.peer_that_broke())
        self.assertEqual((code, err), (0, ""))
        self.assertEqual(
            out,
            "path1/n:1000/FCL/find: no longer answered: bad_alloc\n"
            "note: 1 case only in OLD, 0 cases only in NEW\n"
            "note: no regression of catena's, as these are peers: FCL\n"
            "note: no time was compared, as no case was timed in both\n",
        )
        for run in (broken := self.peer_that_broke()):
            run["catena"]["variants"]["FCL"]["peer"] = False
        self.assertEqual(compared(*broken)[0], 1)

    def test_a_peer_is_one_where_either_run_says_so(self):
        for silent in (0, 1):
            runs = self.peer_that_broke()
            del runs[silent]["catena"]["variants"]
            code, out, err = compared(*runs)
            self.assertEqual((code, err), (0, ""), silent)
            self.assertIn("as these are peers: FCL", out)

    def test_an_input_whose_chain_is_another_is_not_compared(self):
        old, new = made.run(seed=1), multiplied(made.run(seed=2), 3, lambda name: name.startswith("path1/n:1000/"))
        new["catena"]["scenes"][0]["hash"] = "0bad"
        new["catena"]["counts"][0]["bytes"] *= 2
        code, out, _ = compared(old, new)
        self.assertEqual(code, 0, out)
        self.assertIn("the chain is another: path1/n:1000", out)


class Counts(unittest.TestCase):
    def changed(self, **factors):
        """(exit code, stdout) where NEW counts so many times as much in one case."""
        new = made.run()
        row = new["catena"]["counts"][3]
        for key, factor in factors.items():
            row[key] = round(row[key] * factor)
        return compared(made.run(), new)[:2]

    def test_two_per_cent_more_is_a_regression_without_a_test(self):
        for key in ("pair_tests", "node_visits", "bytes"):
            code, out = self.changed(**{key: 1.02})
            self.assertEqual(code, 1, key)
            self.assertIn(f"more work, by count: path1/n:1000/aGPU2+GPUv2: {key}", out)

    def test_less_is_told_and_no_regression(self):
        code, out = self.changed(pair_tests=0.5)
        self.assertEqual(code, 0)
        self.assertIn("less work, by count", out)

    def test_a_trade_is_left_to_the_times(self):
        code, out = self.changed(pair_tests=0.5, node_visits=1.3)
        self.assertEqual(code, 0)
        for key in ("pair_tests", "node_visits"):
            self.assertIn(f"work traded (times decide): path1/n:1000/aGPU2+GPUv2: {key}", out)

    def test_of_a_thousand_missed_pairs_one_more_or_less_is_told(self):
        old, fewer, more = (made.run() for _ in range(3))
        for run, missing in ((old, 1000.0), (fewer, 999.0), (more, 1001.0)):
            for row in run["benchmarks"]:
                if row["name"].startswith("path2/n:1000/aCPU2+CPU2/literal/find"):
                    row["missing"] = missing
        for new, code, title in ((fewer, 0, "fewer"), (more, 1, "more")):
            told = compared(old, new)
            self.assertEqual(told[0], code)
            self.assertIn(f"{title} wrong pairs: path2/n:1000/aCPU2+CPU2/literal: missing 1,000 ->", told[1])

    def test_a_pair_more_that_is_missed_is_a_regression(self):
        new = made.run()
        for row in new["benchmarks"]:
            if row["name"].startswith("path2/n:1000/aCPU2+CPU2/literal/find"):
                row["missing"] = 1.0
        code, out, _ = compared(made.run(), new)
        self.assertEqual(code, 1)
        self.assertIn("more wrong pairs: path2/n:1000/aCPU2+CPU2/literal: missing 0 -> 1\n", out)  # no ratio to 0
        self.assertNotIn("more work", out)
        old = made.run()
        for run, times in ((old, 1.0), (new, 0.5)):  # no saving of work pays for it
            run["catena"]["counts"].append(
                {"input": "path2/n:1000", "variant": "aCPU2+CPU2/literal", "pair_tests": 10_000 * times}
            )
        code, out, _ = compared(old, new)
        self.assertEqual(code, 1)
        self.assertIn("aCPU2+CPU2/literal: missing 0 -> 1", out)


class BadInput(unittest.TestCase):
    def test_a_ratio_that_is_none_is_refused(self):
        for ratio in ("1", "0.9", "-2", "nan"):
            err = io.StringIO()
            with contextlib.redirect_stderr(err), self.assertRaises(SystemExit) as ended:
                command.main(["--compare", "a", "b", "--least-ratio=" + ratio])
            self.assertEqual(ended.exception.code, 2)
            self.assertIn("give a ratio above 1", err.getvalue())

    def line(self, *arguments):
        err = io.StringIO()
        with contextlib.redirect_stderr(err), contextlib.redirect_stdout(io.StringIO()):
            code = command.main(list(arguments))
        self.assertEqual(code, 2)
        self.assertEqual(err.getvalue().count("\n"), 1, err.getvalue())
        return err.getvalue()

    def test_one_clear_line(self):
        with tempfile.TemporaryDirectory() as folder:
            good = str(made.write(folder, made.run()))
            for name, text, says in (
                ("a.json", "{", "not JSON"),
                ("b.json", "[]", "no context and benchmarks"),
                (
                    "c.json",
                    '{"context":{},"benchmarks":[{"name":"a/n:1/V/find","real_time":"x"}]}',
                    "benchmarks[0]",
                ),
                ("d.json", '{"context":{},"benchmarks":[],"catena":{"schema":9}}', "schema 9"),
                ("f.json", '{"context":{},"benchmarks":[],"catena":{"counts":[1]}}', "catena.counts"),
                ("e.json", '{"context":{},"benchmarks":[],"catena":{"viewer":{}}}', "catena.viewer"),
                ("g.json", "[" * 100_000 + "]" * 100_000, "not JSON"),
                ("h.json", '{"context":{"load":[1,NaN]},"benchmarks":[]}', "context.load[1] is nan, which is no number"),
                ("h.json", '{"context":{},"benchmarks":[{},{"a":-Infinity}]}', "benchmarks[1].a is -inf, which is no number"),
                ("i.json", '{"context":{"gpu":[1]},"benchmarks":[]}', "context.gpu is not a text"),
                ("j.json", '{"context":{},"benchmarks":[],"catena":{"schema":"1"}}', 'schema "1", this report reads 1'),
                ("k.json", '{"context":{},"benchmarks":[],"catena":{"counts":[{"variant":"V"}]}}', "catena.counts[0] has no input"),
                (
                    "l.json",
                    '{"context":{},"benchmarks":[],"catena":{"counts":[{"input":"a/n:1","variant":"V","bytes":"x"}]}}',
                    "catena.counts[0].bytes is not a number",
                ),
                *(
                    (
                        "m.json",
                        json.dumps({"context": {}, "benchmarks": [{"name": "a/n:1/V/find", "real_time": 1, key: value}]}),
                        f"benchmarks[0] has {key} {json.dumps(value)}",
                    )
                    for key, value in (("transfer_ms", "abc"), ("transfer_ms", None), ("least_ms", "1"), ("missing", -1),
                                       ("load_one_ms", 0), ("load_all_ms", None))
                ),
            ):
                path = made.pathlib.Path(folder) / name
                path.write_text(text)
                self.assertIn(says, self.line("--compare", str(path), good))
                self.assertIn(says, self.line("--output", folder + "/page", str(path)))
            self.assertIn("No such file", self.line("--compare", good, folder + "/none.json"))
            other = made.run()
            other["benchmarks"] = [
                row | {"name": row["name"].replace("path", "trail")} for row in other["benchmarks"]
            ]
            self.assertIn(
                "no case in common",
                self.line("--compare", good, str(made.write(folder, other, "other.json"))),
            )
            empty = made.write(folder, {"context": {}, "benchmarks": [{"name": "a/n:0/V/find", "real_time": 1}]}, "empty.json")
            self.assertIn("a/n:0 is a chain without spheres", self.line("--output", folder + "/page", str(empty)))
            self.assertFalse((made.pathlib.Path(folder) / "page").exists())
            self.assertIn("folder that can be written", self.line("--output", good, good))

    def test_data_of_another_kind_is_told_and_not_taken_for_a_slowdown(self):
        """An exception would end with exit code 1."""
        whole = {"context": {}, "benchmarks": [{"name": "a/n:1/GPU1/find", "real_time": 1}],
                 "catena": {"variants": {"GPU1": made.described("GPU1")}}}
        with tempfile.TemporaryDirectory() as folder:
            path = str(made.write(folder, whole))
            for error in (ZeroDivisionError("by zero"), KeyError("n"), TypeError("two\nlines")):
                with unittest.mock.patch("catena_report.gate.decide", side_effect=error):
                    said = self.line("--compare", path, path)
                with unittest.mock.patch("catena_report.page._files", side_effect=error):
                    both = said, self.line("--output", folder + "/page", path)
                with unittest.mock.patch("catena_report.sections.summary.build", side_effect=error):
                    both += (self.line("--output", folder + "/page", path),)
                for line in both:
                    self.assertIn(f"{path}", line)
                    self.assertIn(f"({type(error).__name__}: ", line)


if __name__ == "__main__":
    unittest.main()
