"""The rules behind the advice, on views made by hand or drawn: what is waited for, which variants are alike, which chains
one variant serves, and what all chains say together. Each is computed a second time by its definition.
"""
import copy
import itertools
import math
import statistics as plain
import unittest

import made
import numpy
import pages
from catena_report import choice, profiles, runfile, statistics, waits

EXACT = ("aCPU2+CPU2", "aCPU2+Dual", "aGPU2+GPU2", "aGPU2+GPUv2")
ALL = (*EXACT, "aCPU2+CPU2/literal", "FCL")


def run_of(densities):
    """A run that describes ALL, and of each input its density; it timed nothing."""
    value = {
        "context": {},
        "benchmarks": [],
        "catena": {
            "variants": {name: made.described(name) for name in ALL},
            "scenes": [{"input": input_, "density": density} for input_, density in densities.items()],
        },
    }
    return runfile.Run("run.json", value)


def drawn(generator):
    """({input: {variant: samples}}, its run): few levels, so that some variants are alike and some are not."""
    inputs = [f"{scene}/n:{n}" for n in (1000, 5000, 20000) for scene in ("a", "b", "c")]
    view = {
        input_: {
            name: generator.choice([1.0, 1.0, 1.5, 2.0]) * generator.normal(1, 0.01, 8)
            for name in ALL
            if generator.random() < 0.9 or name == EXACT[0]
        }
        for input_ in inputs
    }
    return view, run_of(dict(zip(inputs, generator.permutation(len(inputs)) / 10)))


def surely_slower(row, named):
    """The exact variants whose median is greater, and whose p, times the number of those not below it, is 5 % at most."""
    p = {name: statistics.mann_whitney(row[name], row[named]) for name in EXACT if name in row and name != named}
    of = lambda name: max(other * sum(third >= other for third in p.values()) for other in p.values() if other <= p[name])  # noqa: E731
    return {name for name in p if of(name) <= 0.05 and plain.median(row[name]) > plain.median(row[named])}


def mean_ratio(view, inputs, name, other):
    return plain.geometric_mean(
        plain.median(view[i][name]) / plain.median(view[i][other]) for i in inputs if name in view[i]
    )


class Advised(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.each = [
            (view, run, choice.choose(run, view), choice.advise(run, view))
            for view, run in (drawn(numpy.random.default_rng(seed)) for seed in range(16))
        ]

    def test_a_choice_is_among_the_exact_and_says_how_much_slower_all_others_are(self):
        for view, _, choices, _ in self.each:
            for input_, row in view.items():
                own = {name: plain.median(times) for name, times in row.items() if name in EXACT}
                if len(own) < 2:
                    self.assertNotIn(input_, choices)
                    continue
                chosen = choices[input_]
                self.assertEqual(own[chosen.leader], min(own.values()))
                self.assertLessEqual(chosen.candidates, set(own))
                self.assertEqual(set(chosen.slower), set(row) - {chosen.leader})
                for name, ratio in chosen.slower.items():
                    self.assertAlmostEqual(ratio.value, plain.median(row[name]) / own[chosen.leader])

    def test_rows_are_as_few_as_can_be_and_each_has_a_variant_for_all_its_chains(self):
        joined = alike = 0
        for _, run, choices, advices in self.each:
            order = sorted(choices, key=lambda name: (runfile.n_of(name), run.density(name)))
            self.assertEqual([input_ for advice in advices for input_ in advice.inputs], order)
            shared = [set.intersection(*(choices[i].candidates for i in advice.inputs)) for advice in advices]
            for advice, candidates in zip(advices, shared):
                self.assertIn(advice.variant, candidates)
                joined += len(advice.inputs) > 1
            for advice, candidates in zip(advices[1:], shared):  # the row before could not have taken it too
                self.assertFalse(candidates & choices[advice.inputs[0]].candidates)
            alike += sum(len(chosen.alike) > 0 for chosen in choices.values())
        self.assertGreater(min(joined, alike), 20)

    def test_of_several_the_least_is_named_and_who_is_nearer_than_the_next_is_as_good(self):
        named = 0
        for view, _, choices, advices in self.each:
            for advice in advices:
                shared = set.intersection(*(choices[i].candidates for i in advice.inputs))
                least = {name: sum(math.log(plain.median(view[i][name])) for i in advice.inputs) for name in shared}
                self.assertEqual(least[advice.variant], min(least.values()))
                seen = set().union(*(view[i] for i in advice.inputs)) & set(EXACT)
                self.assertEqual(advice.others, len(seen - {advice.variant}))
                slower = set().union(*(surely_slower(view[i], advice.variant) for i in advice.inputs))
                slower = {name for name in slower if self.interval(view, advice, name).low > 1}
                everywhere = set.intersection(*(set(view[i]) for i in advice.inputs)) & seen - {advice.variant}
                self.assertEqual({entry.name for entry in advice.as_good}, everywhere - slower)
                order = [entry.ratio.value for entry in advice.as_good]
                self.assertEqual(order, sorted(order))
                if advice.next:
                    nearer = {
                        name for name in everywhere
                        if mean_ratio(view, advice.inputs, name, advice.variant) < advice.next.ratio.value * (1 - 1e-9)
                    }
                    self.assertLessEqual(nearer, {entry.name for entry in advice.as_good})
                    self.assertGreater(advice.next.ratio.low, 1)
                for told, names in (
                    (advice.next, everywhere & slower),
                    (advice.papers, {choice.PAPERS} - {advice.variant}),
                    (advice.peer, {"FCL"}),
                ):
                    timed = [name for name in names if any(name in view[i] for i in advice.inputs)]
                    self.assertEqual(told is not None, bool(timed))
                    if told:
                        ratios = {name: mean_ratio(view, advice.inputs, name, advice.variant) for name in timed}
                        self.assertAlmostEqual(told.ratio.value, min(ratios.values()))
                        self.assertAlmostEqual(ratios[told.name], told.ratio.value)
                        self.assertEqual(told.chains, sum(told.name in view[i] for i in advice.inputs))
                        named += len(ratios) > 1
        self.assertGreater(named, 20)

    @staticmethod
    def interval(view, advice, name):
        return choice.over_chains([statistics.ratio(view[i][name], view[i][advice.variant]) for i in advice.inputs if name in view[i]])

    def test_the_next_is_slower_than_the_variant_that_is_named_where_another_leads(self):
        """The named one is of great scatter on the first chain, and there slower than what is slower than the leader."""
        quick, slow = 1 + numpy.arange(8) / 100, 1.1 + numpy.arange(8) / 100
        wide = numpy.array([0.9, 0.95, 1.0, 1.03, 1.8, 1.9, 2.0, 2.1])
        view = {
            "a/n:1000": dict(zip(EXACT, (quick, wide, slow))),
            "a/n:2000": dict(zip(EXACT, (quick + 0.5, quick, slow))),
        }
        (advice,) = choice.advise(run_of({"a/n:1000": 1, "a/n:2000": 1}), view)
        self.assertEqual((advice.variant, advice.next), (EXACT[1], None))
        self.assertEqual({entry.name for entry in advice.as_good}, {EXACT[0], EXACT[2]})
        view["a/n:1000"][EXACT[2]] = slow + 2
        (advice,) = choice.advise(run_of({"a/n:1000": 1, "a/n:2000": 1}), view)
        self.assertEqual(advice.next[0], EXACT[2])

    def test_who_differs_by_the_test_and_not_by_its_interval_is_as_good(self):
        """Eight against eight that interleave at one end: told by ranks, and the ratio's interval, of ranges, holds 1."""
        quick = numpy.array([1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.3])
        slow = numpy.array([1.0, 1.1, 1.1, 1.1, 1.1, 1.1, 1.1, 1.1])
        view = {"a/n:1000": dict(zip(EXACT, (quick, slow, 4 * quick)))}
        self.assertEqual(statistics.differing(view["a/n:1000"], EXACT[0]), set(EXACT[1:3]))
        run = run_of({"a/n:1000": 1})
        (advice,) = choice.advise(run, view)
        self.assertEqual([entry.name for entry in advice.as_good], [EXACT[1]])
        self.assertEqual(advice.next.name, EXACT[2])
        chosen = choice.choose(run, view)["a/n:1000"]
        self.assertEqual((chosen.alike, chosen.as_good(run)), ([], [EXACT[1]]))

    def test_four_chains_measured_alike_leave_half_of_what_one_leaves_open(self):
        one = statistics.Interval(2.0, 1.5, 3.0)
        four = choice.over_chains([one] * 4)
        self.assertAlmostEqual(four.value, 2)
        self.assertAlmostEqual(four.low / 2, (1.5 / 2) ** 0.5)
        self.assertAlmostEqual(four.high / 2, (3 / 2) ** 0.5)
        self.assertAlmostEqual(choice.over_chains([one]).low, one.low)


class Alike(unittest.TestCase):
    def test_one_or_two_samples_differ_past_a_factor_of_two(self):
        self.assertEqual(statistics.best({"a": [1.0], "b": [1.9], "c": [2.1]}), ("a", ["b"]))
        self.assertEqual(statistics.best({"a": [1.0, 1.0, 1.0], "b": [1.1, 1.2, 1.3]}), ("a", []))

    def test_ranges_decide_where_the_test_cannot_for_all_others_at_once(self):
        """Four against four reach 2 / 70: enough for one other, and by Holm's correction too little for two."""
        a, b, c = [1, 2, 3, 4], [5, 6, 7, 8], [6, 7, 8, 9]
        self.assertLess(statistics.least_p(4, 4), 0.05)
        self.assertGreater(2 * statistics.least_p(4, 4), 0.05)
        self.assertEqual(statistics.best({"a": a, "b": b, "c": c}), ("a", []))
        self.assertEqual(statistics.best({"a": a, "b": [3.5, *b[1:]], "c": c}), ("a", ["b"]))

    def test_the_ends_of_a_ratio_come_from_opposite_ends(self):
        """Six samples, whose intervals are their ranges: three factors of 2 and one of 8, so that no two may be taken for
        one another.
        """
        for power in itertools.permutations((1, 1, 1, 3)):
            new_low, new_high, old_low, old_high = (2.0**p for p in power)
            new = [4 / new_low, 4, 4, 4, 4, 4 * new_high]
            old = [2 / old_low, 2, 2, 2, 2, 2 * old_high]
            found = statistics.ratio(new, old)
            self.assertAlmostEqual(found.low, 2 / math.exp(math.hypot(math.log(new_low), math.log(old_high))))
            self.assertAlmostEqual(found.high, 2 * math.exp(math.hypot(math.log(new_high), math.log(old_low))))

    def test_a_law_takes_four_sizes_and_not_four_points(self):
        self.assertIsNone(statistics.exponent([10, 10, 20, 20, 30], [1, 1, 2, 2, 3]))


class Waits(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.value = made.run(repetitions=2)

    def of(self, keep, *more):
        value = {**self.value, "benchmarks": [row for row in self.value["benchmarks"] if keep(row["name"])]}
        value["catena"] = {**value["catena"], "variants": {**value["catena"]["variants"]}}
        for variant in more:
            value["catena"]["variants"][variant] = made.described(variant)
        return value

    def test_a_variant_of_two_stages_is_no_call_by_one_of_them(self):
        value = self.of(lambda name: "/whole" not in name and not ("/aCPU2+Dual/build" in name))
        run = pages.of(value)
        found = waits.end_to_end(run)["path1/n:1000"]
        self.assertEqual(set(found), {"aCPU2+CPU2"})
        build, find = (run.samples[("path1/n:1000", "aCPU2+CPU2", stage)] for stage in ("build", "find"))
        numpy.testing.assert_allclose(found["aCPU2+CPU2"], build + find)

    def test_only_what_is_all_on_the_device_can_stay_there(self):
        value = self.of(lambda name: True, "aCPU2+GPU2")
        rows = [row for row in value["benchmarks"] if "/aCPU2+CPU2/" in row["name"] and "literal" not in row["name"]]
        value["benchmarks"] += [{**row, "name": row["name"].replace("aCPU2+CPU2", "aCPU2+GPU2")} for row in rows]
        run = pages.of(value)
        self.assertIn("aCPU2+GPU2", waits.end_to_end(run)["path1/n:1000"])
        self.assertEqual(set(waits.resident(run)["path1/n:1000"]), {"aGPU2+GPU2", "aGPU2+GPUv2", "GPU1"})

    def test_what_failed_on_a_chain_is_no_advice_for_it(self):
        """It has good samples: a later one threw."""
        fault = {"error_occurred": True, "error_message": "bad_alloc", "at_fault": True}
        value = self.of(lambda name: True)
        value["benchmarks"].append({"name": "path1/n:1000/aGPU2+GPU2/find", **fault})
        run = pages.of(value)
        for view, others in ((waits.end_to_end, 5), (waits.resident, 3), (waits.moving, 5)):
            of_each = view(run)
            self.assertNotIn("aGPU2+GPU2", of_each["path1/n:1000"])
            self.assertEqual((len(of_each["path1/n:1000"]), len(of_each["path1/n:3000"])), (others - 1, others))

    def test_a_search_that_stays_on_the_device_is_what_was_timed_as_such(self):
        value = self.of(lambda name: True)
        value["benchmarks"] += [
            {**row, "name": row["name"].replace("/find/", "/resident/"), "real_time": 7e6}
            for row in value["benchmarks"]
            if "/n:1000/aGPU2+GPU2/find" in row["name"]
        ]
        found = waits.resident(pages.of(value))["path1/n:1000"]
        self.assertEqual(set(found["aGPU2+GPU2"]), {7.0})
        self.assertNotIn(7.0, found["aGPU2+GPUv2"])

    def test_a_way_up_that_update_has_already_is_not_taken_off(self):
        value = copy.deepcopy(self.of(lambda name: "/n:1000/aGPU2" in name))
        case, run = ("path1/n:1000", "aGPU2+GPU2"), pages.of(value)
        still = waits.moving(run)[case[0]][case[1]]
        (update,) = (row["update_ms"] for row in run.list("coherence") if (row["input"], row["variant"]) == case)
        numpy.testing.assert_allclose(still, run.samples[*case, "find"][: len(still)] + update[: len(still)])
        for row in value["benchmarks"]:
            row["transfer_ms"] = {"build": 8.0, "find": 1.0}.get(row["name"].split("/")[-2], 0.0)
        numpy.testing.assert_allclose(waits.moving(pages.of(value))["path1/n:1000"]["aGPU2+GPU2"], still)
        for row in value["benchmarks"]:  # the way back is what the find moves beside the way up
            row["transfer_ms"] = {"build": 1.0, "find": 4.0}.get(row["name"].split("/")[-2], 0.0)
        numpy.testing.assert_allclose(waits.moving(pages.of(value))["path1/n:1000"]["aGPU2+GPU2"], still + 3)


class Together(unittest.TestCase):
    """All chains: some variant was not timed on some."""

    @classmethod
    def setUpClass(cls):
        value = made.run(repetitions=3)
        missing = ("path1/n:1000/aGPU2+GPUv2/", "path2/n:1000/aGPU2+GPUv2/", "path1/n:1000/GPU1/")
        value["benchmarks"] = [row for row in value["benchmarks"] if not row["name"].startswith(missing)]
        for row in value["benchmarks"]:  # quick, so that only its missing chains keep it from being the first
            row["real_time"] = row.get("real_time", 0) * (0.1 if "/aGPU2+GPUv2/" in row["name"] else 1)
        cls.run_ = pages.of(value)
        cls.found = profiles.slowdowns(cls.run_)

    def test_those_timed_on_every_chain_come_first_each_by_its_mean(self):
        order = [(-len(slow.ratios), slow.mean.value) for slow in self.found.values()]
        self.assertEqual(order, sorted(order))
        self.assertEqual([len(slow.ratios) for slow in self.found.values()], [8, 8, 8, 7, 6])
        self.assertEqual({slow.chains for slow in self.found.values()}, {8})

    def test_a_chain_that_was_not_timed_is_never_reached(self):
        for slow in self.found.values():
            curve = profiles.profile(slow)
            self.assertEqual([tau for tau, _ in curve], sorted(slow.ratios.values()))
            for tau, share in dict(curve).items():  # of equal ones the last
                self.assertAlmostEqual(share, sum(ratio <= tau for ratio in slow.ratios.values()) / 8)
            self.assertAlmostEqual(curve[-1][1], len(slow.ratios) / 8)

    def test_the_rank_test_is_of_those_timed_on_every_chain_at_the_level_of_its_smallest_p(self):
        test = profiles.rank_test(self.run_, self.found)
        self.assertEqual((test.first, test.chains, test.others), ("aGPU2+GPU2", 8, 2))
        self.assertEqual(test.power, profiles.signed_rank_power(8, 0.05 / 2))
        self.assertNotEqual(test.power, profiles.signed_rank_power(8, 0.05))


if __name__ == "__main__":
    unittest.main()
