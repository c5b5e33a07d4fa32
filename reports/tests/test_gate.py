"""The gate's promises on quick runs drawn from the stored one: silence where nothing changed, and what it
must see. 200 pairs with CATENA_LONG set (ctest -L long), a few otherwise.
"""
import dataclasses
import itertools
import math
import os
import unittest

import made
import numpy
import samples
import scipy.stats
from catena_report import gate, paired, runfile, work

PAIRS = 200 if os.environ.get("CATENA_LONG") else 4
PLANTS = 100 if os.environ.get("CATENA_LONG") else 5


def alarms(cases):
    families, common = gate.decide(cases)
    return [part for part in (*families, *common) if part.verdict == gate.SLOWER]


def named(case):
    """The families that it is in."""
    return {f"{case.variant}/{case.stage}", f"{case.algorithm}/{case.stage}"}


class Promises(unittest.TestCase):
    def test_no_alarm_where_nothing_changed(self):
        for seed in range(PAIRS):
            with self.subTest(seed=seed):
                self.assertEqual(alarms(samples.unchanged(samples.generator(seed))), [])

    def seen(self, factor, picked, where):
        """How often a change planted where `where(case, name)` says is seen, of names that `picked` gives."""
        hits = 0
        for seed in range(PLANTS):
            generator = samples.generator(10_000 + seed)
            cases = samples.unchanged(generator)
            name = generator.choice(sorted(picked(cases)))
            found = alarms(samples.slower(cases, factor, lambda case, name=name: where(case) == name))
            hits += any(getattr(part, "name", None) == name for part in found)
        return hits / PLANTS

    def test_an_algorithm_five_per_cent_slower_is_seen(self):
        where = lambda case: f"{case.algorithm}/{case.stage}"  # noqa: E731
        picked = lambda cases: {where(case) for case in cases if case.algorithm}  # noqa: E731
        self.assertGreaterEqual(self.seen(1.05, picked, where), 0.95)

    def test_a_stage_of_one_variant_five_per_cent_slower_is_seen(self):
        where = lambda case: f"{case.variant}/{case.stage}"  # noqa: E731

        def picked(cases):
            chains = [where(case) for case in cases]
            return {name for name in chains if chains.count(name) >= gate.FEW_CASES}

        self.assertGreaterEqual(self.seen(1.05, picked, where), 0.95 if PLANTS >= 100 else 0.6)

    def test_what_it_says_it_would_have_seen_it_sees(self):
        hits = []
        for seed in range(PLANTS):
            cases = samples.unchanged(samples.generator(20_000 + seed))
            families = {family.name: family for family in gate.decide(cases)[0]}
            for family in list(families.values())[:: len(families) // 5]:
                if family.variant in {case.variant for case in cases}:
                    slower = samples.slower(
                        cases,
                        family.seen,
                        lambda case, own=family: (case.variant, case.stage) == (own.variant, own.stage),
                    )
                    hits.append(family.name in {getattr(part, "name", None) for part in alarms(slower)})
        self.assertGreaterEqual(sum(hits) / len(hits), 0.9 if PLANTS >= 100 else 0.7)

    def test_no_alarm_between_runs_on_a_machine_that_compiled_meanwhile(self):
        """Two cores, one a thread of the other; two to thirteen processes wanted them."""
        runs = [runfile.load(path) for path in sorted((made.REPORTS / "results").glob("loaded_*.json.gz"))]
        self.assertEqual(len(runs), 4)
        for old, new in itertools.permutations(runs, 2):
            cases = paired.cases(old, new)
            with self.subTest(old=old.path.name, new=new.path.name):
                self.assertGreater(len(cases), 500)
                self.assertEqual(alarms(cases), [])
                self.assertTrue(alarms(samples.slower(cases, 1000, lambda case: True)))
                found = alarms(samples.slower(cases, 2.2, lambda case: case.algorithm == "*+CPU2"))
                self.assertIn("*+CPU2/find", {getattr(part, "name", "") for part in found})
                self.assertFalse(work.compared(old, new).more)

    def test_what_is_the_same_is_called_so(self):
        timed, kinds = samples.stored()
        families, common = gate.decide(paired.pairs(timed, timed, kinds))
        verdicts = [part.verdict for part in (*families, *common)]
        self.assertGreater(verdicts.count(gate.SAME), 0.8 * len(verdicts))
        self.assertLessEqual(set(verdicts), {gate.SAME, gate.UNDECIDED})

    def test_a_difference_too_small_to_matter_is_no_alarm(self):
        timed, kinds = samples.stored()
        unchanged = paired.pairs(timed, timed, kinds)
        surest = min(gate.decide(unchanged, 1.001)[0], key=lambda family: family.seen)
        self.assertLess(surest.seen, 1.019)
        cases = samples.slower(unchanged, 1.019, lambda case: surest.name in named(case))
        self.assertEqual(alarms(cases), [])
        found = {family.name: family.verdict for family in gate.decide(cases, 1.001)[0]}
        self.assertEqual(found[surest.name], gate.SLOWER)

    def test_twice_as_slow_with_six_repetitions_is_seen(self):
        cases = samples.unchanged(samples.generator(1), 6)
        found = alarms(samples.slower(cases, 2.2, lambda case: case.algorithm == "*+CPU2"))
        self.assertIn("*+CPU2/find", {part.name for part in found})

    def test_a_factor_on_everything_is_seen_past_what_a_machine_explains(self):
        cases = samples.unchanged(samples.generator(1))
        for factor, seen in ((1.3, False), (1.7, True), (1000, True)):  # without a kernel
            found = alarms(samples.slower(cases, factor, lambda case: True))
            self.assertEqual([part.place for part in found], [paired.DEVICE, paired.HOST, paired.THREADS] * seen)

    def test_what_the_kernel_took_longer_too_is_the_machines(self):
        cases = samples.unchanged(samples.generator(3))
        beside = lambda kernel: [  # noqa: E731
            dataclasses.replace(case, calibrated=True, kernel=math.log(kernel), change=case.change + math.log(1.5))
            for case in cases
        ]
        self.assertEqual(alarms(beside(1.45)), [])
        found = [part.place for part in alarms(beside(1.0))]
        self.assertEqual(found, [paired.DEVICE, paired.HOST, paired.THREADS])

    def test_a_kernel_that_was_quicker_makes_nothing_slower(self):
        cases = [
            dataclasses.replace(case, calibrated=True, kernel=-math.log(3))
            for case in samples.unchanged(samples.generator(3))
        ]
        _, common = gate.decide(cases)
        self.assertEqual([part.verdict for part in common], [gate.SAME] * 3)

    def test_a_change_of_few_families_does_not_hide_in_the_machine(self):
        cases = [case for case in samples.unchanged(samples.generator(2)) if case.variant == "aCPU2+CPU2"]
        self.assertEqual(alarms(cases), [])
        self.assertTrue(alarms(samples.slower(cases, 1.6, lambda case: case.stage == "find")))


class ByHand(unittest.TestCase):
    """What decide() says of few families, where the machine's part is 0, against its description."""

    def family(self, changes, variances):
        whole = paired.Case(
            "path1/n:1", "V", "find", "", paired.HOST, 12, 1.0, 1.0, 0.0, 1.0, False, 0.0, (0.0, 0.0)
        )
        cases = [
            dataclasses.replace(whole, input=f"path1/n:{at}", change=change, variance=variance)
            for at, (change, variance) in enumerate(zip(changes, variances))
        ]
        (family,), common = gate.decide(cases)
        self.assertEqual(common, [])
        return family

    def test_a_family_is_tested_by_students_t(self):
        generator = numpy.random.default_rng(8)
        for size in (1, 2, 3, 4, 5):
            changes = generator.normal(0.2, 0.05, size)
            variances = numpy.array([1e-6, 4e-3, 2e-3, 3e-3, 1e-3])[:size]
            family = self.family(changes, variances)
            weights = numpy.minimum(1 / variances, 4 * numpy.median(1 / variances))
            weights /= weights.sum()
            centre = weights @ changes
            scatter = ((changes - centre) ** 2 / variances).sum()
            prior = 25 if size >= 4 else 6
            freedom = prior + size - 1
            error = math.sqrt(weights**2 @ variances * (scatter + prior) / freedom)
            machine = gate.MACHINE[False]
            reach = math.hypot(scipy.stats.t.ppf(0.975, freedom) * error, 2 * machine)
            p = 2 * scipy.stats.t.sf(abs(centre) / math.hypot(error, machine), freedom)
            for got, expected in (
                (family.ratio, math.exp(centre)),
                (family.low, math.exp(centre - reach)),
                (family.high, math.exp(centre + reach)),
                (family.p, min(1, p)),
            ):
                self.assertAlmostEqual(got / expected, 1, msg=size)

    def test_same_is_what_lies_within_five_per_cent_and_only_that(self):
        seen = set()
        for repetitions in (3, 12):
            for family in gate.decide(samples.unchanged(samples.generator(7), repetitions))[0]:
                within = 1 / 1.05 < family.low and family.high < 1.05
                if family.verdict in (gate.SAME, gate.UNDECIDED):
                    self.assertEqual(family.verdict == gate.SAME, within, family)
                seen.add(family.verdict)
        self.assertLessEqual({gate.SAME, gate.UNDECIDED}, seen)


class Paired(unittest.TestCase):
    """What two runs say of one case, by the definitions."""

    def case(self, old, new, kernels=((1.0,), (1.0,))):
        name = ("path1/n:100", "aCPU2+CPU2", "find")
        timed = [
            {name: paired.Timed(numpy.array(ms, float), {"load_one_ms": numpy.resize(kernel, len(ms)).astype(float)})}
            for ms, kernel in zip((old, new), kernels)
        ]
        (case,) = paired.pairs(*timed, {name: ("*+CPU2", paired.HOST)})
        return case

    def test_a_time_is_the_mean_logarithm_of_the_quick_quarter(self):
        case = self.case([9, 1, 8, 4, 7, 6, 5, 16], [2, 9, 9, 9, 9, 9, 9, 8])
        self.assertAlmostEqual(case.old, 2)  # of 1 and 4
        self.assertAlmostEqual(case.new, 4)  # of 2 and 8
        self.assertAlmostEqual(case.change, math.log(2))

    def test_of_the_kernel_it_counts_how_much_slower_it_was_beside_new(self):
        for factor in (1.25, 0.8):
            case = self.case([1] * 8, [1] * 8, ((2.0,), (2.0 * factor,)))
            self.assertTrue(case.calibrated)
            self.assertAlmostEqual(case.kernel, math.log(factor))
            loads = [max(0.0, math.log(k / min(1, factor)) - paired.IDLE) for k in (1, factor)]
            for got, expected in zip(case.load, loads):
                self.assertAlmostEqual(got, expected)

    def test_one_disturbed_kernel_of_three_moves_nothing(self):
        ms = [4, 1, 9, 2, 9, 3, 9, 9]
        case = self.case(ms, ms, ((1,), (5, 1, 5, 1, 5, 10, 5, 5)))  # beside the three quickest: 1, 1, 10
        self.assertEqual(case.kernel, 0)

    def test_load_makes_a_verdict_less_sure(self):
        cases = samples.unchanged(samples.generator(5))
        seen = []
        for load in (0.0, 0.5):
            loaded = [dataclasses.replace(case, calibrated=True, load=(0.0, load)) for case in cases]
            seen.append({family.name: family.seen for family in gate.decide(loaded)[0]})
        self.assertTrue(all(seen[1][name] > seen[0][name] for name in seen[0]))


if __name__ == "__main__":
    unittest.main()
