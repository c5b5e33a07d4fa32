"""Rules of the gate and of what is counted, each just on either side of its limit, on cases made by hand."""
import contextlib
import dataclasses
import io
import math
import tempfile
import unittest
import unittest.mock

import made
import numpy
import pages
import samples
import scipy.stats
from catena_report import __main__ as command
from catena_report import certainty, compare, gate, paired, rank_model, work
from test_compare import compared


def told(function, *arguments):
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        function(*arguments)
    return out.getvalue()


def case(variant="A", stage="find", at=0, change=0.0, kernel=0.0, calibrated=True):
    return paired.Case(
        f"s{at}/n:1000", variant, stage, "", paired.HOST, 12, 1.0, math.exp(change), change, 1e-6, calibrated, kernel,
        (0.0, 0.0),
    )  # fmt: skip


FAMILY = gate.Family("A", "find", 4, 1.0, 0.99, 1.01, 1.0, 1.03, gate.SAME)


class Told(unittest.TestCase):
    def test_what_all_cases_share_is_told_from_five_per_cent_on(self):
        for ratio, said in ((1.04, ""), (0.96, ""), (1.06, "taken for the machine's"), (0.94, "taken for the machine's")):
            common = gate.Common(paired.HOST, ratio, 1.0, 1.1, gate.SAME)
            text = told(compare._print_times, [FAMILY], [common])
            self.assertEqual("note: new/old of everything on the host" in text, bool(said), ratio)
            self.assertIn(said, text)

    def test_how_many_families_would_have_been_seen_at_five_per_cent(self):
        families = [dataclasses.replace(FAMILY, seen=seen) for seen in (1.01, 1.05, 1.06, 1.5, 12.0)]
        text = told(compare._print_seen, families)
        self.assertIn("1.010 in the surest family, 1.060 in the middle one, >10 in the least sure; 1.05 or less in 2 of 5", text)

    def test_cases_of_one_run_alone_are_told_whichever_it_is(self):
        old, new = made.run(repetitions=6), made.run(repetitions=6)
        gone = lambda run: {**run, "benchmarks": [  # noqa: E731
            row for row in run["benchmarks"] if not row["name"].startswith("path1/n:1000/GPU1/find")
        ]}
        for pair, said in (
            ((old, gone(new)), "1 case only in OLD, 0 cases only in NEW"),
            ((gone(old), new), "0 cases only in OLD, 1 case only in NEW"),
            ((old, new), None),
        ):
            out = compared(*pair)[1]
            self.assertIn(said, out) if said else self.assertNotIn("only in", out)

    def test_all_of_a_place_slower_fails_without_a_family_that_is(self):
        run = made.run(repetitions=6)
        common = gate.Common(paired.HOST, 1.4, 1.0, 1.1, gate.SLOWER)
        for parts, code in (([common], 1), ([dataclasses.replace(common, verdict=gate.SAME)], 0)):
            with unittest.mock.patch.object(gate, "decide", return_value=([FAMILY], parts)):
                self.assertEqual(compared(run, run)[0], code)


class Counted(unittest.TestCase):
    def changes(self, factor):
        old, new = made.run(repetitions=1), made.run(repetitions=1)
        for run, times in ((old, 1), (new, factor)):
            run["catena"]["counts"][0]["pair_tests"] = round(100_000 * times)
        found = work.compared(pages.of(old), pages.of(new))
        return [name for name in ("more", "fewer", "traded", "small") if getattr(found, name)]

    def test_half_a_per_cent_is_the_least_that_counts(self):
        for factor, where in ((1.004, "small"), (1.006, "more"), (0.996, "small"), (0.994, "fewer"), (1.0, None)):
            self.assertEqual(self.changes(factor), [where] if where else [], factor)


    def test_half_a_per_cent_itself_counts(self):
        for old, new, where in ((200_000, 201_000, "more"), (201_000, 200_000, "fewer")):
            runs = made.run(repetitions=1), made.run(repetitions=1)
            for run, tests in zip(runs, (old, new)):
                run["catena"]["counts"][0]["pair_tests"] = tests
            self.assertEqual(len(getattr(work.compared(*map(pages.of, runs)), where)), 1, where)


class Gate(unittest.TestCase):
    def test_the_same_is_all_of_its_interval_within_five_per_cent(self):
        """Without a scatter but one that is told; the machine's part of few families is uncertain by itself."""
        seen = set()
        for spread in (0.001, 0.02, 0.04, 0.06, 0.1):
            cases = [case(at=at, change=spread * (-1) ** at) for at in range(4)]
            (family,) = gate.decide(cases)[0]
            within = max(abs(math.log(family.low)), abs(math.log(family.high))) < math.log(1.05)
            self.assertEqual(family.verdict == gate.SAME, within)
            seen.add(within)
        cases = [case(variant=f"V{k}", at=at) for k in range(gate.FEW) for at in range(4)]
        self.assertEqual({family.verdict for family in gate.decide(cases)[0]}, {gate.SAME})

    def test_half_of_what_the_kernel_was_slower_by_is_uncertain(self):
        """Of few families at a place, whose common change cannot be told from the machine's."""
        for kernel in (0.0, 0.2, -0.4):
            for calibrated in (True, False):
                cases = [case(at=at, change=kernel, kernel=kernel, calibrated=calibrated) for at in range(4)]
                left, uncertain, common = gate._without_machine(cases)
                numpy.testing.assert_allclose(left, 0, atol=1e-12)
                numpy.testing.assert_allclose(uncertain, math.hypot(gate.MACHINE[calibrated], kernel / 2))
                self.assertEqual(common, [])

    def test_the_kernel_beside_the_three_quickest_samples_is_heeded(self):
        timed = paired.Timed(
            numpy.array([5.0, 1.0, 9.0, 2.0, 3.0, 0.1]), {"load_one_ms": numpy.array([9.0, 8.0, 9.0, 2.0, 4.0, 1.0])}
        )
        kernel, load = paired._beside(timed, paired.HOST, 5, {"load_one_ms": 1.0})  # the sixth is past the size
        self.assertAlmostEqual(kernel, math.log(4.0))  # beside 1, 2 and 3
        self.assertAlmostEqual(load, math.log(2.0) - paired.IDLE)

    def test_an_input_of_another_chain_has_no_case(self):
        old, new = made.run(repetitions=3), made.run(repetitions=3)
        new["catena"]["scenes"][0]["hash"] = "0bad"
        inputs = {case.input for case in paired.cases(pages.of(old), pages.of(new))}
        self.assertEqual(inputs, {f"{scene}/n:{n}" for scene in made.SCENES for n in made.SIZES} - {"path1/n:1000"})


class Decided(unittest.TestCase):
    def test_a_loaded_machine_is_told(self):
        run = pages.of(made.run(repetitions=1))
        for load, said in ((0.05, False), (0.2, True)):
            cases = [dataclasses.replace(case(at=at), load=(load, 0.0)) for at in range(3)]
            self.assertEqual("the machine was loaded" in told(compare._print_notes, run, run, cases), said)

    def test_how_loaded_a_machine_was_is_a_factor(self):
        run = pages.of(made.run(repetitions=1))
        cases = [dataclasses.replace(case(at=at), load=(0.0, math.log(times))) for at, times in enumerate((2, 3, 9))]
        self.assertIn("the calibration kernel took 3.0 times its best;", told(compare._print_notes, run, run, cases))

    def test_another_processor_or_device_is_told(self):
        old = made.run(repetitions=1)
        for changed, said in (({}, False), ({"cpu": "another"}, True), ({"gpu": "another"}, True)):
            runs = [pages.of({**old, "context": {**old["context"], **more}}) for more in ({}, changed)]
            self.assertEqual("note: different machines" in told(compare._print_notes, *runs, [case()]), said, changed)

    def test_a_change_that_the_clock_does_not_show_is_no_verdict(self):
        """All of it is the kernel's, which was quicker beside NEW; two families of five chains."""
        for change, verdict in ((0.4, gate.SLOWER), (0.9, gate.SLOWER)):
            cases = [case(at=at, change=change, kernel=-0.5) for at in range(5)]
            self.assertEqual([family.verdict for family in gate.decide(cases)[0]], [verdict])

    def test_a_place_is_slower_past_what_kernel_and_load_explain(self):
        own = [dataclasses.replace(case(at=at), load=(0.03 * at, 0.04 * at)) for at in range(5)]  # 0.1 in the median
        for kernel, calibrated in ((0.0, True), (0.3, True), (-0.3, True), (0.0, False)):
            ratio = gate.COMMON_RATIO if calibrated else gate.UNCALIBRATED_RATIO
            least = math.log(ratio) + abs(kernel) / 2 + 3 * gate.LOADED_ALL * 0.1
            for shift, verdict in ((least + max(0.0, kernel) - 1e-6, gate.SAME), (least + max(0.0, kernel) + 1e-6, gate.SLOWER)):
                common = gate._common(paired.HOST, numpy.full(5, shift), kernel, calibrated, own)
                self.assertEqual((common.verdict, round(math.log(common.least), 9)), (verdict, round(least, 9)))

    def test_a_family_is_held_against_students_t_with_the_scatter_of_all(self):
        """Of scatter per degree of freedom 2, moderated by 0.5 of all; half of the machine's part is uncertain."""
        t = scipy.stats.t
        for degrees in (2, 3, 20):
            freedom = degrees + gate.PRIOR_DEGREES[degrees + 1 >= gate.FEW_CASES]
            spread = (2 * degrees + 0.5 * (freedom - degrees)) / freedom
            for load, machine, tests in ((0.0, 0.0, 1), (0.03, 0.0, 7), (0.0, 0.02, 7)):
                family = gate._family("A", "find", (0.05, 0.05, 1e-4, 2 * degrees, degrees, load, machine), 0.5, tests, 1.3)
                error = math.hypot(0.01 * math.sqrt(spread), load)
                reach = math.hypot(t.ppf(0.975, freedom) * error, 2 * machine)
                self.assertAlmostEqual(math.log(family.low), 0.05 - reach)
                self.assertAlmostEqual(math.log(family.high), 0.05 + reach)
                self.assertAlmostEqual(family.p, min(1, 2 * tests * t.sf(0.05 / math.hypot(error, machine), freedom)))
                for least in (1.0, 1.3):
                    seen = gate._family("A", "find", (0.05, 0.05, 1e-4, 2 * degrees, degrees, load, machine), 0.5, tests, least).seen
                    alarm = math.hypot(t.ppf(1 - gate.ALARMS / tests, freedom) * error, 3 * machine)
                    self.assertAlmostEqual(math.log(seen), max(alarm, math.log(least)) + t.ppf(gate.SEEN, freedom) * error)

    def test_the_machines_part_is_a_factor_the_kernel_and_how_long_a_case_takes(self):
        generator = samples.generator(3)
        cases = []
        for k in range(40):
            ms, kernel = 10 ** generator.uniform(-2, 2), generator.normal(0, 0.1)
            machine = 0.1 + 0.7 * kernel + 0.03 * math.log(max(ms, 0.3)) - 0.05 * math.log(max(ms, 3))
            own = 0.4 if k % 5 == 0 else 0.0  # of a fifth of all the code changed, too
            cases.append(dataclasses.replace(case(variant=f"V{k}", change=machine + own, kernel=kernel), old=ms))
        left, _, _ = gate._without_machine(cases)
        for k, change in enumerate(left):
            self.assertAlmostEqual(change, 0.4 if k % 5 == 0 else 0.0, delta=1e-3)

    def test_a_place_is_calibrated_where_every_case_is(self):
        _, uncertain, _ = gate._without_machine([case(), case(at=1, calibrated=False)])
        self.assertEqual(uncertain.tolist(), [gate.MACHINE[False]] * 2)

    def test_no_chain_decides_alone(self):
        """Six that stayed and one, of next to no variance, that is twice as slow."""
        cases = [case(at=at) for at in range(7)]
        cases = [dataclasses.replace(c, variance=1e-4) for c in cases]
        cases[3] = dataclasses.replace(cases[3], variance=1e-6, change=math.log(2))
        (family,) = gate.decide(cases)[0]
        self.assertAlmostEqual(math.log(family.ratio), math.log(2) * 4 / 10)

    def test_an_algorithm_is_that_of_the_stage_that_is_timed(self):
        run = pages.of(made.run(repetitions=1))
        for stage, name in (("build", "aCPU2+*"), ("update", "aCPU2+*"), ("find", "*+CPU2"), ("whole", "")):
            self.assertEqual(paired.algorithm(run, ("path1/n:1000", "aCPU2+CPU2", stage)), name)

    def test_the_common_change_of_few_families_is_not_fitted(self):
        for families, fitted in ((gate.FEW - 1, 0), (gate.FEW, 1)):
            cases = [case(variant=f"V{k}", at=at) for k in range(families) for at in range(2)]
            self.assertEqual(len(gate.decide(cases)[1]), fitted)

    def test_what_is_answered_in_both_runs_is_not_broken(self):
        """A repetition that failed beside others that did not."""
        old, new = made.run(repetitions=6), made.run(repetitions=6)
        row = next(row for row in new["benchmarks"] if row["name"].startswith("path1/n:1000/GPU1/find"))
        row |= {"error_occurred": True, "error_message": "once"}
        with tempfile.TemporaryDirectory() as folder:
            paths = [str(made.write(folder, value, name)) for value, name in ((old, "old.json"), (new, "new.json"))]
            self.assertNotIn("no longer answered", told(compare.main, *paths, 1.02))


class Certain(unittest.TestCase):
    def test_the_critical_rank_sum_is_the_least_that_rejects(self):
        for size in range(4, 13):
            u = certainty.critical(size)
            self.assertLess(certainty._p_of(u, size), certainty.LEVEL)
            self.assertGreaterEqual(certainty._p_of(u - 1, size), certainty.LEVEL)

    def test_a_slowdown_is_seen_from_the_critical_rank_sum_on(self):
        """Of one draw, which comes as often as any: so many pairs of which the slower one is the greater."""
        old, new = numpy.array([1.0, 2.1, 3.3, 4.7, 5.9, 7.3]), numpy.array([1.1, 1.9, 3.7, 4.1, 6.7, 7.9])
        drawn = unittest.mock.Mock()
        drawn.choice.return_value = numpy.stack([numpy.tile(of, (certainty.DRAWS, 1)) for of in (old, new)])
        least = certainty.smallest_slowdown(old, drawn)
        slower = lambda factor: (new[:, None] * factor >= old).sum()  # noqa: E731
        self.assertGreaterEqual(slower(least * (1 + 1e-12)), certainty.critical(6))
        self.assertLess(slower(least * (1 - 1e-12)), certainty.critical(6))

    def test_a_slowdown_is_seen_in_95_of_100(self):
        """The quantile of what each pair of draws needs."""
        times = samples.generator(5).lognormal(0, 0.1, 12)
        least = certainty.smallest_slowdown(times, samples.generator(7))
        old, new = samples.generator(7).choice(times, (2, certainty.DRAWS, len(times)))
        test = lambda a, b: certainty.statistics.mann_whitney(a, b) < certainty.LEVEL  # noqa: E731
        for factor, low, high in ((least * 1.001, 0.93, 1.0), (least * 0.9, 0.0, 0.93)):
            share = numpy.mean([test(a, b * factor) and numpy.median(b) * factor > numpy.median(a) for a, b in zip(old, new)])
            self.assertTrue(low <= share <= high, (factor, share))

    def test_nine_in_ten_are_more_than_half(self):
        run = pages.of(made.run(repetitions=8))
        with unittest.mock.patch.object(certainty, "smallest_slowdown", side_effect=(1 + k % 11 / 10 for k in range(10_000))):
            half, most = certainty.certainty(run).smallest
        sizes = sorted(1 + k % 11 / 10 for k in range(len(run.samples)))
        self.assertEqual((half, most), tuple(numpy.quantile(sizes, (0.5, 0.9))))


class Ranks(unittest.TestCase):
    def test_the_law_is_the_median_of_the_factors(self):
        chain = next(c for c in made.run(repetitions=1)["catena"]["ranks"]["chains"] if c["input"].startswith("yarn"))
        points = [p for p in chain["points"] if p["order"] == "space" and p["ranks"] <= rank_model.FITTED]
        points[0]["most_blocks_asked"] *= 2  # of one more
        law = rank_model.law(points)
        factors = [
            p["most_blocks_asked"] / rank_model.shell(p["blocks"] / p["ranks"], p["ranks"], law.thickness) for p in points
        ]
        self.assertAlmostEqual(math.log(law.factor), numpy.median(numpy.log(factors)))

    def test_one_rank_asks_nobody(self):
        model = rank_model.Model(rank_model.Law(2.0, 1.0), 0.125, 100.0, 5000.0, 2000.0, 30_000.0, 1.0)
        self.assertAlmostEqual(model.ms(1000, 1), 0.1)
        self.assertAlmostEqual(model.efficiency(1000, 1), 1.0)

    def test_a_model_is_fitted_to_more_than_four_points_of_few_ranks(self):
        chains = [chain for chain in made.run(repetitions=1)["catena"]["ranks"]["chains"] if chain["input"].startswith("yarn")]
        whole = rank_model.model(chains)
        for chain in chains:
            for point in chain["points"]:
                if point["ranks"] > rank_model.FITTED:
                    point["most_processor_ms"] = {"within": 1e9}
        self.assertEqual(rank_model.model(chains), whole)
        for chain in chains:
            for point in chain["points"][2:]:
                point.pop("most_processor_ms", None)
        self.assertIsNone(rank_model.model(chains))  # two chains of two


class Arguments(unittest.TestCase):
    def test_what_is_missing_or_too_much_is_one_line(self):
        for arguments, said in (
            (["--compare", "a", "b", "--output", "c"], "--compare takes two run files and no --output"),
            (["--compare", "a", "b", "c"], "--compare takes two run files and no --output"),
            (["a"], "give --output DIR and at least one run file"),
            (["--output", "c"], "give --output DIR and at least one run file"),
            ([], "give --output DIR and at least one run file"),
        ):
            err = io.StringIO()
            with contextlib.redirect_stderr(err), self.assertRaises(SystemExit) as ended:
                command.main(arguments)
            self.assertEqual((ended.exception.code, err.getvalue().count("\n")), (2, 1), arguments)
            self.assertIn(said, err.getvalue())


if __name__ == "__main__":
    unittest.main()
