"""Rules that end somewhere, asked on both sides of where they do; and medians of what is not even."""
import contextlib
import io
import math
import tempfile
import types
import unittest
import unittest.mock

import made
import numpy
import pages
from catena_report import claims, compare, gate, paired, paper, profiles, rank_model, report, runfile, waits, work
from catena_report.sections import pivots, regret, roofline, steps, wants


def family(seen):
    return gate.Family("aCPU2+CPU2", "find", 4, 1.0, 0.99, 1.01, 1.0, seen, gate.SAME)


def case(load=(0.0, 0.0), input_="path1/n:100"):
    return paired.Case(
        input_, "aCPU2+CPU2", "find", "*+CPU2", paired.HOST, 9, 1.0, 1.0, 0.0, 1e-4, True, 0.0, load
    )


class Gate(unittest.TestCase):
    def closed(self, *seen):
        """The exit code of a comparison of families of which so small a ratio would have been seen."""
        decided = [family(least) for least in seen], []
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(io.StringIO()):
            path = made.write(folder, made.run(repetitions=1), "run.json")
            with unittest.mock.patch.object(gate, "decide", return_value=decided):
                return compare.main(path, path, gate.LEAST_RATIO)

    def test_a_gate_that_sees_in_one_family_is_one(self):
        self.assertEqual(self.closed(1.05, 9.0), 0)
        with self.assertRaises(runfile.BadRunFile):
            self.closed(9.0)

    def test_a_machine_is_loaded_beside_most_cases(self):
        run = pages.of(made.run(repetitions=1))

        def told(*loads):
            with contextlib.redirect_stdout(io.StringIO()) as out:
                compare._print_notes(run, run, [case((0.0, load)) for load in loads])
            return out.getvalue()

        self.assertNotIn("was loaded", told(0.0, 0.0, 2.0))
        self.assertIn("was loaded", told(0.0, 0.3, 2.0))

    def test_the_loads_of_both_runs_add_up(self):
        def width(load):
            cases = [case(load, f"path1/n:{n}") for n in range(1, 6)]
            (only,) = gate.decide(cases)[0]
            return math.log(only.high / only.low)

        self.assertGreater(width((0.4, 0.4)), 1.2 * width((0.0, 0.4)))

    def test_one_wrong_pair_less_is_a_trade(self):
        """However many were wrong: as much fewer tests would be nothing."""
        name = ("path1/n:100", "aCPU2+CPU2")
        before = {name: {"pair_tests": 100, "missing": 1000}}
        after = {name: {"pair_tests": 110, "missing": 999}}
        with (
            unittest.mock.patch.object(work, "counts", side_effect=[before, after]),
            unittest.mock.patch.object(paired, "changed_inputs", return_value=set()),
        ):
            found = work.compared(None, None)
        self.assertEqual([len(changes) for changes in (found.more, found.traded)], [0, 2])


class Times(unittest.TestCase):
    def test_stages_are_added_as_they_were_measured(self):
        samples = {("a", "b", "build"): numpy.array([1, 1]), ("a", "b", "find"): numpy.array([10, 20, 30])}
        self.assertEqual(waits._stages(types.SimpleNamespace(samples=samples), "a", "b").tolist(), [11, 21])

    def test_a_slowdown_is_beside_the_least_of_any(self):
        own = {"A": [2.0], "B": [4.0]}
        run = types.SimpleNamespace(info=lambda variant: types.SimpleNamespace(recommended=variant in own))
        chains = {input_: own | {"FCL": [1.0]} for input_ in ("a", "b", "c")}
        with unittest.mock.patch.object(waits, "end_to_end", return_value=chains):
            found = profiles.slowdowns(run)
        self.assertEqual({variant: slow.ratios["a"] for variant, slow in found.items()}, {"A": 2, "B": 4, "FCL": 1})

    def test_a_claim_of_both_paths_needs_an_interval_of_both(self):
        def judged(path1, path2):
            times = {"path1": path1, "path2": path2}
            timed = lambda run, path, n, algorithm: (numpy.full(times[path], 2000.0), algorithm)  # noqa: E731
            with unittest.mock.patch.object(paper, "samples", timed):
                return claims.brute(None).verdict

        self.assertEqual(judged(12, 12), claims.HOLDS)
        self.assertEqual(judged(12, 3), claims.UNTESTED)
        self.assertEqual(judged(3, 12), claims.UNTESTED)

    def test_a_want_is_shown_by_its_median(self):
        value = made.run()
        value["catena"]["wants"] = [{"input": "a", "variant": "aCPU2+CPU2", "want": "any", "ms": [1, 2, 90]}]
        ((row,),) = (table.rows for table in wants.build(report.Report([pages.of(value)])).blocks)
        self.assertEqual((row[2].text, row[2].raw), ("2.00", 2))


class Ranks(unittest.TestCase):
    def chains(self):
        made_of = made.run()["catena"]["ranks"]["chains"]
        return [chain for chain in made_of if chain["input"].startswith("yarn:")]

    def test_one_point_that_is_far_off_is_not_the_error(self):
        chains = self.chains()
        self.assertLess(rank_model.model(chains).error, 1.01)
        times = chains[1]["points"][4]["most_processor_ms"]
        times["within"] *= 2
        self.assertLess(rank_model.model(chains).error, 1.1)

    def test_blocks_are_the_mean_of_those_of_a_sphere(self):
        chains = self.chains()
        for point in chains[0]["points"]:
            point["blocks"] *= 2
        self.assertAlmostEqual(rank_model.model(chains).blocks, 0.1875)


class Verdicts(unittest.TestCase):
    def test_near_the_quickest_is_within_five_per_cent(self):
        self.assertEqual(regret._above([1.04, 1.06, 0.9]), 1)

    def test_a_copy_of_the_chain_is_half_of_two(self):
        self.assertIn("at most half the time of the one search", steps._verdict([2.0]))
        self.assertIn("less than twice", steps._verdict([1.99]))

    def test_pivots_that_cost_less_are_all_up_to_a_number(self):
        rows = [{"n": 100, "pivots": k, "times": times} for k, times in ((1, 2.0), (8, 0.5), (64, 1.5))]
        self.assertEqual(pivots._cheap(rows), "cost no less than a rebuild")

    def test_device_memory_is_told_in_megabytes(self):
        kernel = {
            "us": 10.0, "device_memory_bytes": 2.5e6, "l2_percent_of_peak": 1.0, "issue_slots_percent": 1.0,
            "warp_instructions": 1.0, "lanes_active": 1.0,
        }  # fmt: skip
        stored = {
            "ceilings": {"copy_bytes_per_second": 1e12},
            "runs": [{"input": "a", "variant": "b", "kernels": {"k": kernel}}],
        }
        (row,) = roofline._table(stored).rows
        self.assertEqual(row[6].text, "2.50")


if __name__ == "__main__":
    unittest.main()
