"""Somebody else's library on the page: timed, marked, and never advised; and a search that stays on a device."""
import dataclasses
import statistics as plain
import unittest

import made
import pages
from catena_report import style, variant
from pages import recomputes


def with_peer_and_resident():
    """The made run with FCL, the fastest of all and wrong in places, and a search of a chain on the device."""
    value = made.run()
    value["catena"]["variants"]["FCL"] = made.described("FCL")
    added = []
    for row in value["benchmarks"]:
        if "/aGPU2+GPUv2/" in row["name"] and "/update" not in row["name"]:
            added.append({**row, "name": row["name"].replace("aGPU2+GPUv2", "FCL"), "real_time": row["real_time"] / 9})
        if "/aGPU2+GPU2/find" in row["name"]:
            added.append({**row, "name": row["name"].replace("/find", "/resident"), "real_time": row["real_time"] / 9})
    value["benchmarks"] += added
    for line in [line for line in value["catena"]["stability"] if line["variant"] == "GPU1"]:
        value["catena"]["stability"].append({**line, "variant": "FCL", "arithmetic": "binary64", "outcome": "wrong", "missing": 2})
    for point in [p for p in value["catena"]["work_precision"]["points"] if p["variant"] == "GPU1"]:
        value["catena"]["work_precision"]["points"].append({**point, "variant": "FCL", "front": True})
    return value


class Peer(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.value = with_peer_and_resident()
        cls.shown = pages.shown(cls.value)

    def names(self, figure):
        return {series.name for panel in self.shown.figures[figure].panels for series in panel.series}

    def test_it_is_timed_and_labelled(self):
        for figure in ("times-build", "times-find", "work-precision"):
            self.assertIn("FCL (peer)", self.names(figure))
        self.assertIn("FCL (peer) in 0.0 % of 3 cases", self.shown.prose)

    def test_each_peer_has_a_marker_of_its_own(self):
        fcl = variant.Variant.of("FCL", made.described("FCL"))
        several = [dataclasses.replace(fcl, name=name) for name in ("Bullet", "CGAL", "Embree", "FCL", "nanoflann")]
        looks = style.Looks(several)
        self.assertEqual(len({looks.variant(peer).marker for peer in several}), len(several))
        self.assertEqual({looks.variant(peer).colour for peer in several}, {"muted"})

    def test_it_is_never_recommended_but_stands_beside(self):
        self.assertTrue(all("FCL" not in " ".join(row) for row in self.shown.rows("choice")))
        for row in self.shown.rows("advice-short"):
            self.assertNotIn("FCL", row[0])
            self.assertIn("FCL", row[7])
        self.assertIn("FCL (peer)", self.names("slowdown"))
        for figure in self.shown.figures.values():
            self.assertNotIn("FCL is fastest", figure.title)

    def test_it_is_no_rounded_arithmetic_and_no_claim(self):
        alone = pages.shown(made.run())
        for key in ("exactness", "claims"):
            self.assertEqual(self.shown.rows(key), alone.rows(key), key)
        self.assertNotIn("binary64 arithmetic", str(self.shown.sections))

    @recomputes("figure:times-resident")
    def test_a_resident_search_has_its_own_figure(self):
        self.assertEqual(self.names("times-resident"), {"aGPU2+GPU2"})
        points = 0
        for panel in self.shown.figures["times-resident"].panels:
            scene, each, _ = panel.title.partition(", for each sphere")
            for n, y in zip(panel.series[0].x, panel.series[0].y):
                times = [
                    row["real_time"] / 1e6
                    for row in self.value["benchmarks"]
                    if row["name"].startswith(f"{scene}/n:{n}/aGPU2+GPU2/resident")
                ]
                self.assertAlmostEqual(y, plain.median(times) * (1e6 / n if each else 1))
                points += 1
        self.assertEqual(points, 2 * len(made.SCENES) * len(made.SIZES))


if __name__ == "__main__":
    unittest.main()
