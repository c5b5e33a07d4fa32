"""The viewer as a reader meets it: a page from a file, offline, in headless Chromium with WebGL in software."""
import math
import pathlib
import sys
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))

import browser  # noqa: E402
import shown_chains  # noqa: E402
from viewer_page import REASON, SOFTWARE_WEBGL, WITHOUT_WEBGL, InBrowser, changed, page_of  # noqa: E402


class Viewer(InBrowser):
    def test_it_draws_by_webgl(self):
        self.assertIn("WebGL", self.driver.find_element("id", "catena-viewer").get_attribute("data-scene"))
        self.assertTrue(browser.painted(self.opened.part("stage")))

    def test_colliding_spheres_have_their_colour_and_only_they(self):
        self.assertGreater(self.opened.share("colliding"), 0.01)
        self.opened.show("hairpin/n:160", 0)
        self.assertEqual(0, self.opened.share("colliding"))
        self.assertTrue(browser.painted(self.opened.part("stage")))

    def test_play_shows_one_frame_after_another(self):
        before, number = self.opened.picture(), self.opened.part("frame-number")
        seen = set()
        self.opened.part("play").click()
        browser.wait(self.driver, lambda _: seen.add(number.text) or len(seen) == 3, 30)
        self.opened.part("play").click()
        self.assertEqual({"0 of 20", "10 of 20", "20 of 20"}, seen)
        self.opened.show("hairpin/n:160", 10)
        self.assertGreater(changed(before, self.opened.picture()), 0.01)

    def test_keys_step_and_play(self):
        self.opened.run("scene.canvas.focus()")
        keys = self.driver.switch_to.active_element
        keys.send_keys("\ue014")  # right: past the last comes the first
        self.assertEqual("0 of 20", self.opened.part("frame-number").text)
        keys.send_keys("\ue012")
        self.assertEqual("20 of 20", self.opened.part("frame-number").text)
        keys.send_keys(" ")
        self.assertEqual("Pause", self.opened.part("play").get_attribute("aria-label"))
        keys.send_keys(" ")
        self.assertEqual("Play", self.opened.part("play").get_attribute("aria-label"))

    def test_scrubbing_moves_to_a_frame(self):
        self.opened.part("frame").send_keys("\ue011")  # Home
        self.assertEqual("0 of 20", self.opened.part("frame-number").text)
        self.assertIn("0 pairs", self.opened.part("facts").text)

    def test_the_list_holds_the_pairs_and_flies_to_one(self):
        expected = [f"{i} – {j}" for i, j in shown_chains.pairs_of(shown_chains.hairpin(1.9))]
        self.assertEqual(str(len(expected)), self.opened.part("pair-count").text)
        rows = self.opened.part("pairs").find_elements("css selector", ".row .spheres")
        self.assertEqual(expected[:5], [row.text for row in rows[:5]])
        before, away = self.opened.picture(), self.opened.run("return scene.rig.distance / scene.rig.scale")
        rows[2].click()
        after = self.opened.picture()
        self.assertLess(self.opened.run("return scene.rig.distance / scene.rig.scale"), away / 3)
        self.assertGreater(changed(before, after), 0.1)
        i, j = expected[2].split(" – ")
        self.assertIn(f"{i} – {j}: overlap 0.1", self.opened.part("pair").text)
        self.assertEqual([i, j], [self.opened.part(f"label-{name}").text for name in "ij"])
        offset = self.opened.run("""const at = scene.project(viewer.selected.point), stage = viewer.part('stage');
            return Math.hypot(at.x - stage.clientWidth / 2, at.y - stage.clientHeight / 2);""")
        self.assertLess(offset, 1)
        self.opened.part("reset").click()
        self.assertLess(changed(before, self.opened.picture()), 0.001)

    def test_of_a_million_pairs_only_those_in_sight_are_rows(self):
        self.opened.run("""const pairs = new Uint32Array(2e6).map((_, k) => k % 160);
            viewer.pairList.set(pairs, new Uint8Array(1e6), viewer.frame.spheres);""")
        self.assertEqual("1,000,000", self.opened.part("pair-count").text)
        self.assertLess(len(self.opened.part("pairs").find_elements("css selector", ".row")), 60)

    def test_the_list_can_keep_the_pairs_of_one_sphere(self):
        sphere = int(shown_chains.pairs_of(shown_chains.hairpin(1.9))[7, 0])
        self.opened.part("pair-only").send_keys(str(sphere))
        rows = [row.text for row in self.opened.part("pairs").find_elements("css selector", ".row .spheres")]
        self.opened.part("pair-only").clear()
        self.assertTrue(rows)
        self.assertTrue(all(str(sphere) in row.split(" – ") for row in rows))

    def test_levels_of_the_tree_are_shown_one_by_one(self):
        self.opened.show("near/n:160")
        before, slider = self.opened.picture(), self.opened.part("level")
        slider.send_keys("\ue014" * 5)
        self.assertEqual("level 4: 10 spheres", self.opened.part("level-number").text)
        fourth = self.opened.picture()
        self.assertGreater(changed(before, fourth), 0.02)
        slider.send_keys("\ue010")  # End: the root
        self.assertEqual("level 8: 1 sphere", self.opened.part("level-number").text)
        self.assertGreater(changed(fourth, self.opened.picture()), 0.02)
        slider.send_keys("\ue011")
        self.assertEqual("off", self.opened.part("level-number").text)
        self.assertLess(changed(before, self.opened.picture()), 0.001)

    def test_a_level_of_another_frame_is_said_and_not_jumped_to(self):
        slider, frame = self.opened.part("level"), self.opened.part("frame-number")
        self.assertEqual("20 of 20", frame.text)
        slider.send_keys("\ue014" * 3)
        self.assertEqual("20 of 20", frame.text)
        self.assertEqual("stored for frame 0", self.opened.part("level-number").text)
        self.opened.part("level-go").click()
        self.assertEqual("0 of 20", frame.text)
        self.assertIn("level 2", self.opened.part("level-number").text)
        self.assertFalse(self.opened.part("level-go").is_displayed())

    def test_the_first_view_fills_the_stage(self):
        self.opened.settle()
        share = self.opened.run("""const row = viewer.frame.spheres, stage = viewer.part('stage');
            let low = [1e9, 1e9], high = [-1e9, -1e9];
            for (let k = 0; k < row.length; k += 4) {
              const p = scene.project([row[k], row[k + 1], row[k + 2]]);
              low = [Math.min(low[0], p.x), Math.min(low[1], p.y)], high = [Math.max(high[0], p.x), Math.max(high[1], p.y)];
            }
            return [(high[0] - low[0]) / stage.clientWidth, (high[1] - low[1]) / stage.clientHeight,
                    low[0] > 0 && low[1] > 0 && high[0] < stage.clientWidth && high[1] < stage.clientHeight];""")
        self.assertGreater(max(share[:2]), 0.8)
        self.assertTrue(share[2])

    def test_missing_and_invented_pairs_of_a_wrong_variant_are_marked(self):
        self.assertEqual([0, 0], [self.opened.share("missing"), self.opened.share("invented")])
        from selenium.webdriver.support.ui import Select
        Select(self.opened.part("variant")).select_by_visible_text("aCPU2+CPU2/literal: 3 missing, 2 invented")
        self.assertGreater(self.opened.share("missing"), 0.0005)
        self.assertGreater(self.opened.share("invented"), 0.0005)
        words = [word.text for word in self.opened.part("pairs").find_elements("css selector", ".row .word")]
        self.assertEqual((3, 2), (words.count("missing"), words.count("invented")))
        exact = len(shown_chains.pairs_of(shown_chains.hairpin(1.9)))
        self.assertEqual(str(exact + 2), self.opened.part("pair-count").text)  # a missing pair is one of the exact ones

    def test_far_from_the_origin_huge_or_tiny_the_picture_is_the_same(self):
        for wander in ("", "viewer.pairList.pick(3)"):
            pictures = []
            for name in ("near", "far", "huge", "tiny"):
                self.opened.show(f"{name}/n:160")
                self.opened.settle()
                self.opened.run(wander)
                pictures.append(self.opened.picture()[40:])  # not the line of the overlap, which tells its size
            for picture in pictures[1:]:
                self.assertLess(changed(pictures[0], picture), 0.001)

    def test_at_rest_nothing_is_drawn(self):
        self.opened.settle()
        before = self.opened.run("return scene.renders")
        time.sleep(1)
        self.assertEqual(before, self.opened.run("return scene.renders"))

    def test_dragging_turns_the_chain(self):
        from selenium.webdriver import ActionChains
        before = self.opened.picture()
        canvas = self.opened.part("stage").find_element("tag name", "canvas")
        ActionChains(self.driver).move_to_element(canvas).click_and_hold().move_by_offset(120, 40).release().perform()
        self.assertGreater(changed(before, self.opened.picture()), 0.01)

    def test_a_finger_turns_the_chain_and_two_come_nearer(self):
        before, away = self.opened.picture(), self.opened.run("return scene.rig.distance / scene.rig.scale")
        box = self.opened.part("stage").rect
        top = box["y"] - self.driver.execute_script("return scrollY")
        middle = (box["x"] + box["width"] / 2, top + box["height"] / 2)

        def touch(kind, *offsets):
            points = [{"x": middle[0] + dx, "y": middle[1] + dy, "id": k} for k, (dx, dy) in enumerate(offsets)]
            self.driver.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

        touch("touchStart", (0, 0)), touch("touchMove", (60, 20)), touch("touchMove", (120, 40)), touch("touchEnd")
        turned = self.opened.picture()
        self.assertGreater(changed(before, turned), 0.01)
        self.assertAlmostEqual(1, self.opened.run("return scene.rig.distance / scene.rig.scale") / away, 6)
        touch("touchStart", (-20, 0), (20, 0)), touch("touchMove", (-60, 0), (60, 0)), touch("touchMove", (-90, 0), (90, 0))
        touch("touchEnd")
        self.assertLess(self.opened.run("return scene.rig.distance / scene.rig.scale"), away / 2)

    def test_a_sphere_under_the_pointer_says_its_number(self):
        from selenium.webdriver import ActionChains
        self.opened.run("scene.flyTo(Array.from(viewer.frame.spheres.slice(0, 3)), 4)")
        self.opened.settle()
        at = self.opened.run("""const row = viewer.frame.spheres, p = scene.project([row[0], row[1], row[2]]);
            const stage = viewer.part('stage');
            return [p.x - stage.clientWidth / 2, p.y - stage.clientHeight / 2];""")
        stage = self.opened.part("stage")
        ActionChains(self.driver).move_to_element_with_offset(stage, int(at[0]), int(at[1])).perform()
        browser.wait(self.driver, lambda _: self.opened.part("tip").is_displayed())
        self.assertRegex(self.opened.part("tip").text, r"^sphere 0: \d+ collisions?, radius 1\.00$")

    def test_show_takes_the_nearest_frame_and_knows_what_it_lacks(self):
        self.assertTrue(self.opened.show("hairpin/n:160", 12))
        self.assertEqual("10 of 20", self.opened.part("frame-number").text)
        self.assertFalse(self.opened.show("nothing/n:1", 0))

    def test_the_replay_command_asks_for_the_frame_and_the_variant_that_are_shown(self):
        from selenium.webdriver.support.ui import Select
        self.assertEqual("catena detect hairpin:n=160 --frame 20 --variant CPU1 --pairs pairs.csv", self.opened.part("command").text)
        Select(self.opened.part("variant")).select_by_index(1)
        self.assertEqual("catena detect hairpin:n=160 --frame 20 --variant aCPU2+CPU2/literal --pairs pairs.csv",
                         self.opened.part("command").text)
        said = self.opened.run("return viewer.view.replay(3, 'aGPU2@host(subtree=256)+CPU2/literal')")
        self.assertIn(" --frame 3 --variant 'aGPU2@host(subtree=256)+CPU2/literal' --pairs", said)
        self.opened.part("frame").send_keys("\ue011")
        self.assertIn(" --frame 0 ", self.opened.part("command").text)

    def test_a_pair_across_a_face_of_the_box_overlaps_and_is_flown_to(self):
        for name, box in shown_chains.BOXES.items():
            depths = shown_chains.boxed(name, box)[1]
            self.opened.show(name)
            self.assertTrue(self.opened.part("legend-box").is_displayed())
            found = self.opened.run("""
                const list = viewer.pairList;
                list.order.value = 'deep';
                list.arrange();
                return list.items.map((item, place) => {
                  list.pick(place);
                  return [viewer.part('pair').textContent, list.depth(item), viewer.selected.rows];
                });""")
            order = sorted(depths, key=depths.get, reverse=True)
            self.assertEqual(len(order), len(found))
            for (i, j), (line, depth, (a, b)) in zip(order, found):
                self.assertTrue(line.startswith(f"{i} – {j}: overlap "), line)
                self.assertAlmostEqual(depth, depths[i, j])
                self.assertAlmostEqual(math.dist(a[:3], b[:3]), 2 - depth)
            across = sum("across the face of the box" in line for line, *_ in found)
            self.assertTrue(3 < across < len(order), (name, across, len(order)))

    def test_of_another_chain_the_pairs_of_all_spheres_are_shown(self):
        only = self.opened.part("pair-only")
        only.send_keys("-5")  # no sphere's number
        self.assertTrue(self.opened.part("pair-count").text.startswith("0 of "))
        self.opened.show("near/n:160")
        self.assertEqual(("", False), (only.get_attribute("value"), " of " in self.opened.part("pair-count").text))

    def test_the_page_can_choose_dark(self):
        light = self.opened.picture()
        self.driver.execute_script("document.documentElement.dataset.theme = 'dark'")
        browser.wait(self.driver, lambda _: self.opened.run("return viewer.palette.ground[0] < 64"))
        dark = self.opened.picture()
        self.driver.execute_script("delete document.documentElement.dataset.theme")
        browser.wait(self.driver, lambda _: self.opened.run("return viewer.palette.ground[0] > 192"))
        self.assertGreater(light.mean() - dark.mean(), 0.5)


class InTheDark(InBrowser):
    DARK = True

    def test_the_ground_is_dark_and_the_pairs_are_seen(self):
        import numpy
        self.assertLess(float(numpy.median(self.opened.picture())), 0.2)
        self.assertGreater(self.opened.share("colliding"), 0.01)


class WithoutWebGl(InBrowser):
    FLAGS = WITHOUT_WEBGL

    def test_it_says_so_and_draws_flat(self):
        self.assertIn("no WebGL", self.opened.part("notice").text)
        self.assertGreater(self.opened.share("colliding"), 0.01)

    def test_frames_and_pairs_work(self):
        before = self.opened.picture()
        self.opened.part("pairs").find_element("css selector", ".row").click()
        self.assertGreater(changed(before, self.opened.picture()), 0.05)
        self.opened.part("reset").click()
        self.opened.part("frame").send_keys("\ue011")
        self.assertGreater(changed(before, self.opened.picture()), 0.01)
        self.assertEqual(0, self.opened.share("colliding"))

    def test_the_box_and_the_image_across_its_face_are_drawn(self):
        self.assertEqual(0, self.opened.share("bound"))
        self.opened.show("plain/n:60")
        self.assertGreater(self.opened.share("bound"), 0.0003)  # thin lines
        whole = self.opened.picture()
        self.opened.run("viewer.part('pair-order').value = 'deep'; viewer.pairList.arrange(); viewer.pairList.pick(0)")
        self.assertGreater(changed(whole, self.opened.picture()), 0.05)


class Damaged(unittest.TestCase):
    @unittest.skipIf(REASON, REASON)
    def test_what_cannot_be_shown_is_said(self):
        with page_of([{"input": "x/n:3", "frames": []}]) as page:
            with browser.opened(page, flags=SOFTWARE_WEBGL) as driver:
                root = driver.find_element("id", "catena-viewer")
                browser.wait(driver, lambda _: root.get_attribute("data-ready"))
                self.assertTrue(root.text.startswith("The viewer cannot be shown ("), root.text)
                self.assertFalse(driver.execute_async_script("catenaViewer.show('x/n:3').then(arguments[0])"))
                self.assertEqual([], browser.errors(driver))
            with browser.opened(page, flags=("--blink-settings=scriptEnabled=false",)) as driver:
                self.assertEqual("The viewer needs JavaScript.", driver.find_element("id", "catena-viewer").text)


if __name__ == "__main__":
    unittest.main()
