"""Ranks: what they exchange is shown beside what they must, and the model says what the runs say."""
import unittest

import made
import pages
from catena_report import rank_model, words
from pages import recomputes


def chains(value):
    return {(c["input"].partition(":")[0], c["n"]): c["points"] for c in value["catena"]["ranks"]["chains"]}


class Ranks(unittest.TestCase):
    def setUp(self):
        self.value = made.run()
        self.shown = pages.Shown(pages.of(self.value))

    @recomputes("figure:ranks-exchange")
    def test_every_exchange_is_shown_beside_its_bound(self):
        over, dense = self.shown.figures["ranks-exchange"].panels
        drawn = {series.name: dict(zip(series.x, series.y)) for series in over.series}
        for (scene, n), points in chains(self.value).items():
            ratios = {p["ranks"]: p["blocks_asked"] / p["blocks_touching"] for p in points if p["blocks_touching"]}
            self.assertEqual(drawn[f"{scene}, {n:,}"], ratios)
        self.assertEqual(len(drawn), len(chains(self.value)))
        longest = {scene: max(n for its, n in chains(self.value) if its == scene) for scene, _ in chains(self.value)}
        solid = {series.name for series in over.series if series.look.dash == "solid"}
        self.assertEqual(solid, {f"{scene}, {n:,}" for scene, n in longest.items()})
        self.assertEqual([line.at for panel in (over, dense) for line in panel.lines], [2, 2])
        for series, ranks in zip(dense.series, (4, 16, 64)):
            self.assertEqual(series.name, f"{ranks} ranks")
            at = {4: "yarn", 1: "hair"}
            for x, y in zip(series.x, series.y):
                (point,) = (p for p in chains(self.value)[at[x], 512_000] if p["ranks"] == ranks)
                self.assertEqual(y, point["blocks_asked"] / point["blocks_touching"])
            # Named once, beside those of most ranks.
            self.assertEqual(series.labels, [at[x] for x in series.x] if ranks == 64 else None)

    def test_the_exchange_is_judged_by_its_worst(self):
        title = self.shown.figures["ranks-exchange"].title
        # Beyond twice the bound from 64 ranks on: of the longest chain each holds 512,000 / 64 spheres.
        self.assertIn("while each holds more than 8,000 spheres", title)
        worst = max(p["blocks_asked"] / p["blocks_touching"] for ps in chains(self.value).values() for p in ps if p["blocks_touching"])
        self.assertIn(f"{words.significant(worst, 3)} times", title)
        for chain in self.value["catena"]["ranks"]["chains"]:
            for p in chain["points"]:
                p["blocks_touching"] = p["blocks_asked"]
        self.assertIn("at most 1.00 times", pages.Shown(pages.of(self.value)).figures["ranks-exchange"].title)

    def test_twice_the_bound_itself_is_within_the_aim(self):
        for chain in self.value["catena"]["ranks"]["chains"]:
            for p in chain["points"]:
                p["blocks_touching"] = p["blocks_asked"] / 2
        title = pages.Shown(pages.of(self.value)).figures["ranks-exchange"].title
        self.assertEqual(title, "Ranks ask for at most 2.00 times the blocks that truly touch another part")

    @recomputes("figure:ranks-times")
    def test_every_time_is_shown_and_the_model_is_near(self):
        figure = self.shown.figures["ranks-times"]
        most = max(n for _, n in chains(self.value))
        self.assertTrue(figure.title.startswith(f"By the model {most:,} spheres are searched soonest"), figure.title)
        panels = {panel.title: panel for panel in figure.panels}
        for (scene, n), points in chains(self.value).items():
            series = panels[scene].series
            (drawn,) = (s for s in series if s.name == f"{scene}, {n:,}")
            times = {p["ranks"]: sum(p["most_processor_ms"].values()) for p in points if p["ranks"] <= 256}
            self.assertEqual(dict(zip(drawn.x, drawn.y)), times)
            model = series[series.index(drawn) + 1]
            for ranks, ms in zip(model.x, model.y):
                if ranks in times:
                    self.assertAlmostEqual(ms / times[ranks], 1, delta=0.02)
            shared = series[series.index(drawn) + 2]
            self.assertEqual((shared.x, shared.y), ([1, 256], [times[1], times[1] / 256]))

    @recomputes("table:ranks-model")
    def test_the_model_is_what_the_runs_were_made_by(self):
        rows = {row[0].text: row for row in self.shown.tables["ranks-model"].rows}
        for scene, contacts in (("yarn", 4), ("hair", 1)):
            row = rows[scene]
            self.assertEqual(row[1].raw, contacts)
            for cell, made_by in zip(row[2:8], (contacts, 2, 100, 5000, 2000, 30_000)):
                self.assertAlmostEqual(cell.raw / made_by, 1, delta=0.05)
            self.assertAlmostEqual(row[8].raw, 1, delta=0.01)
            self.assertAlmostEqual(row[9].raw, 1, delta=0.05)

            def ms(n, ranks):
                held = n / 8 / ranks
                shell = contacts * ((held ** (1 / 3) + 2) ** 3 - held) * (1 - ranks ** (-1 / 3))
                return 100 * n / ranks + (5000 * shell + 2000 * ranks + 30_000) * (ranks > 1)

            for at, n in enumerate((10**6, 10**9)):
                powers = [2**k for k in range(25)]
                best = min(powers, key=lambda ranks: ms(n, ranks))
                kept = [ranks for ranks in powers if ms(n, 1) / ranks / ms(n, ranks) >= 0.5]
                self.assertIn(row[10 + at].raw / max(kept), (0.5, 1, 2))
                self.assertIn(row[12 + at].raw / best, (0.5, 1, 2))

    def test_columns_are_named_as_they_are_filled(self):
        """In the order in which the other tests read them."""
        n = [f"n = {n:,}" for n in (10**6, 10**9)]
        tables = self.shown.tables
        self.assertEqual(tables["ranks-model"].columns[-4:], [f"{what}, {of}" for what in ("half", "best") for of in n])
        self.assertEqual(
            tables["ranks-model"].columns[1:-4],
            ["pairs a sphere", "c", "w, blocks", "s, ns", "b, ns", "r, ns", "f, ns", "times off", "counts off"],
        )
        self.assertEqual(
            tables["ranks-sending"].columns[1:],
            ["pairs a sphere", "S", "A", "K", "bytes off", "beyond", "m", "N", "messages off", "beyond", "rounds"]
            + [f"best, {of}" for of in n],
        )
        self.assertEqual(
            tables["ranks-counts"].columns,
            ["chain", "ranks", "order", "spheres", "blocks asked", "bytes", "messages", "rounds", "over the bound", "ms"],
        )

    @recomputes("table:ranks-sending")
    def test_what_ranks_send_is_what_the_runs_were_made_by(self):
        rows = {row[0].text: row for row in self.shown.tables["ranks-sending"].rows}
        self.assertEqual(set(rows), {"yarn", "hair"})
        caption = self.shown.tables["ranks-sending"].caption
        self.assertIn("a message takes 2.0 µs and a rank sends 10 GB a second, which is assumed", caption)
        for scene, contacts in (("yarn", 4), ("hair", 1)):
            row = rows[scene]
            self.assertEqual(row[1].raw, contacts)
            for cell, made_by in zip(row[2:5], (24, 150, 40)):
                self.assertAlmostEqual(cell.raw / made_by, 1, delta=0.06)
            for cell in (row[5], row[6], row[9], row[10]):
                self.assertAlmostEqual(cell.raw, 1, delta=0.06)
            self.assertAlmostEqual(row[7].raw / 5, 1, delta=0.05)
            self.assertAlmostEqual(row[8].raw / 64, 1, delta=0.1)
            self.assertEqual(row[11].raw, 2)

            def ms(n, ranks):
                held = n / 8 / ranks
                shell = contacts * ((held ** (1 / 3) + 2) ** 3 - held) * (1 - ranks ** (-1 / 3))
                sent = (24 * n / ranks * (1 - 1 / ranks) + 150 * shell + 40 * ranks) * (ranks > 1)
                messages = 5 * (ranks - 1) / (1 + (ranks - 1) / 64)
                computed = 100 * n / ranks + (5000 * shell + 2000 * ranks + 30_000) * (ranks > 1)
                return computed + 2000 * messages + sent / 10

            for cell, n in zip(row[12:], (10**6, 10**9)):
                self.assertIn(cell.raw / min((2**k for k in range(25)), key=lambda ranks: ms(n, ranks)), (0.5, 1, 2))

    def test_bytes_and_messages_are_checked_by_what_they_were_not_fitted_to(self):
        for key, column in (("most_bytes", 6), ("most_messages", 10)):
            for factor, off in ((3, 3), (1 / 9, 3), (3, 1)):  # and as it was, so that the other is told by itself
                for chain in self.value["catena"]["ranks"]["chains"]:
                    for p in chain["points"]:
                        if p["ranks"] > 256:
                            p[key] *= factor
                for row in pages.Shown(pages.of(self.value)).tables["ranks-sending"].rows:
                    self.assertAlmostEqual(row[column].raw / off, 1, delta=0.08)
                    self.assertEqual(row[column].text, words.significant(row[column].raw, 3))

    def test_of_rounds_the_most_of_any_chain_are_told(self):
        lengths = sorted({chain["n"] for chain in self.value["catena"]["ranks"]["chains"]})
        self.assertGreater(len(lengths), 1)
        for rounds, n in enumerate(lengths, 7):  # more than those set before
            for chain in self.value["catena"]["ranks"]["chains"]:
                if chain["n"] == n:
                    chain["points"][1]["most_rounds"] = rounds
            for row in pages.Shown(pages.of(self.value)).tables["ranks-sending"].rows:
                self.assertEqual(row[11].raw, rounds)

    def test_a_chain_in_its_order_has_no_model_of_what_is_sent(self):
        for chain in self.value["catena"]["ranks"]["chains"]:
            for p in chain["points"]:
                p["order"] = "chain"
        self.assertNotIn("ranks-sending", pages.Shown(pages.of(self.value)).tables)

    def test_a_scene_whose_longest_chain_was_only_counted_is_told_of_by_another(self):
        for chain in self.value["catena"]["ranks"]["chains"]:
            if chain["n"] == 512_000:
                for p in chain["points"]:
                    for key in ("pairs", "most_processor_ms"):
                        p.pop(key, None)
        shown = pages.Shown(pages.of(self.value))
        for table in ("ranks-model", "ranks-sending"):
            self.assertEqual([row[1].raw for row in shown.tables[table].rows], [4, 1])

    @recomputes("table:ranks-counts")
    def test_every_count_is_shown(self):
        rows = self.shown.tables["ranks-counts"].rows
        keys = ("most_spheres", "most_blocks_asked", "most_bytes", "most_messages", "most_rounds")
        told = [
            (f"{scene}, {n:,}", p)
            for (scene, n), points in chains(self.value).items()
            for p in points
            if p["ranks"] in (2, 16, 64, 256, 1024)
        ]
        self.assertEqual(len(rows), len(told))
        for row, (name, p) in zip(rows, told):
            self.assertEqual((row[0].text, row[1].raw, row[2].text), (name, p["ranks"], p["order"]))
            self.assertEqual([cell.raw for cell in row[3:8]], [p[key] for key in keys])
            self.assertEqual(row[8].raw, p["blocks_asked"] / p["blocks_touching"])
            self.assertEqual(row[9].raw, sum(p["most_processor_ms"].values()) if p["ranks"] <= 256 else "")
            if p["ranks"] <= 256:
                self.assertEqual(row[9].text, words.ms(row[9].raw))

    def test_it_says_by_what_a_rank_searches_its_part(self):
        self.value["catena"]["ranks"]["searched_by"] = "somebody"
        self.assertIn("computed, somebody within its part", pages.Shown(pages.of(self.value)).prose)

    def test_counts_beyond_what_was_fitted_check_the_law(self):
        for factor in (3, 1 / 9):
            for chain in self.value["catena"]["ranks"]["chains"]:
                for p in chain["points"]:
                    if p["ranks"] > 256:
                        p["most_blocks_asked"] *= factor
            rows = pages.Shown(pages.of(self.value)).tables["ranks-model"].rows
            for row in rows:
                self.assertAlmostEqual(row[9].raw, 3, delta=0.15)

    def test_of_several_counts_the_one_furthest_off_is_told(self):
        for chain_of, factors in (("yarn", (1.1, 3)), ("hair", (1 / 3, 1.1))):
            mine = [c for c in self.value["catena"]["ranks"]["chains"] if c["input"].startswith(chain_of)]
            law = rank_model.law([point for chain in mine for point in chain["points"]])
            for chain, factor in zip(mine, factors, strict=True):
                (point,) = (p for p in chain["points"] if p["ranks"] > 256)
                point["most_blocks_asked"] = factor * law.asked(point["blocks"] / point["ranks"], point["ranks"])
        for row in pages.Shown(pages.of(self.value)).tables["ranks-model"].rows:
            self.assertEqual(row[9].text, "3.00")
            self.assertAlmostEqual(row[9].raw, 3)

    def test_times_off_are_a_factor_whichever_way_they_are_off(self):
        mine = [c for c in self.value["catena"]["ranks"]["chains"] if c["input"].startswith("yarn")]
        timed = [point["most_processor_ms"] for chain in mine for point in chain["points"] if point["ranks"] <= 256]
        for at, times in enumerate(timed):
            for phase in times:
                times[phase] *= 1.2 if at % 2 else 1 / 1.2
        self.assertAlmostEqual(rank_model.model(mine).error, 1.2, delta=0.05)

    def test_a_law_is_checked_by_what_it_was_not_fitted_to(self):
        asked = {255: 3, 256: 4, 257: 5, 512: 0, 4096: 7}
        points = [{"ranks": ranks, "blocks": 1e6, "most_blocks_asked": blocks} for ranks, blocks in asked.items()]
        checked = rank_model.checked([{"n": 8e6, "points": points}], rank_model.Law(1, 1))
        self.assertEqual([(ranks, asked) for _, ranks, _, asked in checked], [(257, 5), (4096, 7)])

    def test_a_law_is_of_points_in_space_of_no_more_ranks_than_are_fitted(self):
        made_by = rank_model.Law(2, 1)
        points = [
            {"order": "space", "ranks": ranks, "blocks": 1e6, "most_blocks_asked": made_by.asked(1e6 / ranks, ranks)}
            for ranks in (2, 4, 16, 64, 256)
        ]
        wrong = {"order": "chain", "ranks": 8}, {"order": "space", "ranks": 512}
        far = [{**points[0], **other, "most_blocks_asked": 1e6} for other in wrong]
        found = rank_model.law(points + 3 * far)
        self.assertAlmostEqual(found.factor, 2)
        self.assertAlmostEqual(found.thickness, 1)
        self.assertIsNone(rank_model.law(points[:3] + 3 * far))

    def test_one_rank_asks_nobody_and_waits_for_none(self):
        model = rank_model.Model(rank_model.Law(2, 1), 1 / 8, 100, 5000, 2000, 30_000, 1)
        self.assertAlmostEqual(model.ms(1000, 1), 0.1)
        self.assertAlmostEqual(model.efficiency(1000, 1), 1)
        # Of 2 ranks and 125 blocks: half of the spheres, and what each asks, beside what there are of them.
        asked = 2 * ((62.5 ** (1 / 3) + 1) ** 3 - 62.5) * (1 - 2 ** (-1 / 3))
        self.assertAlmostEqual(model.ms(1000, 2), 0.05 + 1e-6 * (5000 * asked + 4000 + 30_000))

    def test_one_rank_sends_nothing(self):
        sending = rank_model.Sending(rank_model.Model(rank_model.Law(2, 1), 1 / 8, 100, 5000, 2000, 0, 1), 24, 150, 40, 1, 5, 64, 1)
        self.assertEqual((sending.bytes(1000, 1), sending.messages(1)), (0, 0))
        # Of two ranks each holds half of the spheres, and half of these came from the other.
        asked = 2 * ((62.5 ** (1 / 3) + 1) ** 3 - 62.5) * (1 - 2 ** (-1 / 3))
        self.assertAlmostEqual(sending.bytes(1000, 2), 24 * 250 + 150 * asked + 80)
        self.assertAlmostEqual(sending.messages(2), 5 / (1 + 1 / 64))
        network = rank_model.Network(seconds_a_message=1e-3, bytes_per_second=1e6)
        self.assertAlmostEqual(sending.ms(1000, 2, network), sending.messages(2) + sending.bytes(1000, 2) / 1000)

    def test_what_is_sent_is_checked_by_what_it_was_not_fitted_to_in_space(self):
        sending = rank_model.Sending(rank_model.Model(rank_model.Law(2, 1), 1 / 8, 100, 5000, 2000, 0, 1), 24, 150, 40, 1, 5, 64, 1)
        points = [
            {
                "ranks": ranks,
                "order": order,
                "most_bytes": bytes_off * sending.bytes(8e6, ranks),
                "most_messages": messages_off * sending.messages(ranks),
            }
            for ranks, order, bytes_off, messages_off in (
                (256, "space", 9, 9),
                (257, "space", 2, 1 / 3),
                (512, "chain", 9, 9),
            )
        ]
        in_bytes, in_messages = rank_model.sending_off([{"n": 8e6, "points": points}], sending)
        self.assertAlmostEqual(in_bytes, 2)
        self.assertAlmostEqual(in_messages, 3)
        self.assertIsNone(rank_model.sending_off([{"n": 8e6, "points": points[:1]}], sending))

    def test_too_few_points_have_no_model(self):
        for chain in self.value["catena"]["ranks"]["chains"]:
            chain["points"] = chain["points"][:2]
        shown = pages.Shown(pages.of(self.value))
        self.assertNotIn("ranks-model", set(shown.tables))
        self.assertIn("ranks-counts", set(shown.tables))
        self.assertIsNone(rank_model.law([]))

    def test_without_data_there_is_no_section(self):
        del self.value["catena"]["ranks"]
        self.assertNotIn("ranks-counts", set(pages.Shown(pages.of(self.value)).tables))


if __name__ == "__main__":
    unittest.main()
