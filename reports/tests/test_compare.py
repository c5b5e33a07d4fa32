"""Two runs compared: every verdict on samples whose law is known, and the exit codes a CI rests on."""
import contextlib
import io
import tempfile
import unittest

import made
from catena_report import __main__ as command
from catena_report import compare, runfile


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
    return {
        case.name: case.verdict for case in compare.compared(runfile.Run("old", old), runfile.Run("new", new))
    }


class Compare(unittest.TestCase):
    def test_a_slower_variant_is_caught_and_nothing_else(self):
        old, new = made.run(repetitions=12, seed=1), made.run(
            repetitions=12, seed=2, slower={("aCPU2+Dual", "find"): 1.3}
        )
        found = verdicts(old, new)
        slower = {name for name, verdict in found.items() if verdict == compare.SLOWER}
        self.assertEqual(
            slower, {f"{scene}/n:{n}/aCPU2+Dual/find" for scene in made.SCENES for n in made.SIZES}
        )
        self.assertNotIn(compare.FASTER, found.values())
        self.assertEqual(compared(old, new)[0], 1)

    def test_the_other_way_round_is_faster(self):
        old, new = made.run(repetitions=12, seed=1, slower={("aCPU2+Dual", "find"): 1.3}), made.run(
            repetitions=12, seed=2
        )
        self.assertIn(compare.FASTER, verdicts(old, new).values())
        self.assertEqual(compared(old, new)[0], 0)

    def test_the_same_run_is_the_same(self):
        run = made.run(repetitions=30)
        self.assertEqual(set(verdicts(run, run).values()), {compare.SAME})
        self.assertEqual(compared(run, run)[0], 0)

    def test_a_difference_too_small_to_matter_is_no_regression(self):
        old, new = made.run(repetitions=30, noise=0.002, seed=1), made.run(
            repetitions=30, noise=0.002, seed=2, slower={("GPU1", "find"): 1.02}
        )
        self.assertEqual(set(verdicts(old, new).values()), {compare.SAME})
        self.assertEqual(compared(old, new, "--least-ratio", "1.01")[0], 1)

    def test_noise_is_undecided_not_slower(self):
        found = set(verdicts(made.run(noise=0.3, seed=1), made.run(noise=0.3, seed=2)).values())
        self.assertIn(compare.UNDECIDED, found)
        self.assertNotIn(compare.SLOWER, found)

    def test_too_few_repetitions_are_no_pass(self):
        code, _, err = compared(
            made.run(repetitions=3, seed=1), made.run(repetitions=3, seed=2, slower={("GPU1", "find"): 5})
        )
        self.assertEqual(code, 2)
        self.assertIn("too few repetitions", err)

    def test_a_case_no_longer_answered_is_a_regression(self):
        old, new = made.run(repetitions=12, seed=1), made.run(repetitions=12, seed=2)
        for row in new["benchmarks"]:
            if row["name"].startswith("path2/n:1000/GPU1/find"):
                row |= {"error_occurred": True, "error_message": "3 pairs missing"}
        code, out, _ = compared(old, new)
        self.assertEqual(code, 1)
        self.assertIn("no longer answered: 3 pairs missing", out)

    def test_each_rule_of_the_verdict_matters(self):
        interval = lambda value, low, high: compare.statistics.Interval(value, low, high)  # noqa: E731
        for ratio, p, expected in (
            (interval(1.3, 1.2, 1.4), 0.01, compare.SLOWER),
            (interval(1.3, 1.2, 1.4), 0.2, compare.UNDECIDED),
            (interval(0.7, 0.6, 0.8), 0.01, compare.FASTER),
            (interval(1.02, 1.01, 1.03), 0.001, compare.SAME),
            (interval(1.0, 0.9, 1.1), 0.9, compare.UNDECIDED),
            (interval(1.06, 1.0, 1.1), 0.2, compare.UNDECIDED),
        ):
            self.assertEqual(compare.verdict(ratio, p, 1.05), expected, (ratio, p))


class BadInput(unittest.TestCase):
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
            ):
                path = made.pathlib.Path(folder) / name
                path.write_text(text)
                self.assertIn(says, self.line("--compare", good, str(path)))
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
            self.assertIn("folder that can be written", self.line("--output", good, good))


if __name__ == "__main__":
    unittest.main()
