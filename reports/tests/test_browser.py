"""The page in a browser, offline: plots drawn by pixels, a variant toggled, a chain picked, quick to open, silent console."""
import json
import pathlib
import tempfile
import time
import unittest
import unittest.mock

import browser
import made
import pages
from catena_report import page, report, runfile
from catena_report.drawn import interactive

REASON = browser.missing()
LONG = 6000  # a window in which many figures are seen at once: a shot takes as long for one as for all
DRAWN = "return [...document.querySelectorAll('figure[data-figure]')].filter(f => f.dataset.drawn).length"


@unittest.skipIf(REASON, REASON)
class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        runs = [runfile.load(made.write(cls.folder.name, made.run()))]
        with unittest.mock.patch("catena_report.drawn.static.pdf", lambda canvas: b""):  # half of the time, and no browser shows them
            cls.path = page.write(report.Report(runs), pathlib.Path(cls.folder.name) / "page")
        cls.window = cls.enterClassContext(browser.opened(cls.path))

    def usual(self):
        """The page in the usual window, which the tests share: plotly takes seconds to load. From its top, on a screen."""
        browser.resize(self.window, 1400, 900)
        self.window.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "screen"})
        self.window.execute_script("scrollTo({top: 0, behavior: 'instant'})")
        return self.window

    def figure(self, driver, key):
        """The figure, once plotly has drawn it."""
        figure = driver.find_element("id", "figure-" + key)
        driver.execute_script("arguments[0].scrollIntoView({behavior: 'instant'})", figure)
        browser.wait(driver, lambda _: figure.get_attribute("data-drawn"))
        browser.next_frame(driver)
        return figure

    def pictures(self, driver, elements):
        """Of each of them, from as few shots as the window allows."""
        left = list(elements)
        while left:
            driver.execute_script("arguments[0].scrollIntoView({behavior: 'instant'})", left[0])
            browser.next_frame(driver)
            seen = [*browser.in_window(left), False]
            together = left[: max(1, seen.index(False))]
            yield from browser.pictures(together)
            left = left[len(together):]

    @unittest.skipUnless(interactive.library(), "python3-plotly is not installed")
    def test_every_plot_is_painted_and_the_console_silent(self):
        for width, dark in ((1400, False), (400, True)):
            with self.subTest(width=width, dark=dark), browser.opened(
                self.path, width=width, height=LONG, dark=dark
            ) as driver:
                ready = "return document.documentElement.dataset.ready"
                browser.wait(driver, lambda d: d.execute_script(ready) == "interactive")
                figures = driver.find_elements("css selector", "figure[data-figure]")
                keys = [figure.get_attribute("data-figure") for figure in figures]
                self.assertGreater(len(keys), 8)
                plots, of = [], []
                for key in keys:
                    own = self.figure(driver, key).find_elements("class name", "js-plotly-plot")
                    self.assertTrue(own, key)
                    plots += own
                    of += [key] * len(own)
                for key, picture in zip(of, self.pictures(driver, plots), strict=True):
                    self.assertTrue(browser.coloured(picture), key)
                self.assertEqual(
                    driver.execute_script("return document.documentElement.scrollWidth"),
                    width,
                    "wider than the window",
                )
                self.assertEqual(browser.errors(driver), [])

    @unittest.skipUnless(interactive.library(), "python3-plotly is not installed")
    def test_a_legend_entry_takes_its_variant_away_and_brings_it_back(self):
        driver = self.usual()
        figure = self.figure(driver, "times-find")
        plot = figure.find_element("class name", "js-plotly-plot")
        button = figure.find_element("css selector", '.legend button[data-name="GPU1"]')
        browser.point_nowhere(driver)  # over a point more is shown
        before = browser.settled(driver, plot)
        button.click()
        browser.wait(driver, lambda _: button.get_attribute("aria-pressed") == "false")
        # What is drawn again differs by up to 0.08 where edges are smoothed.
        changed = lambda: (abs(before - browser.pixels(plot)) > 0.1).any(axis=2).mean()  # noqa: E731
        browser.wait(driver, lambda _: changed() > 0.002)
        states = driver.execute_script(
            "return arguments[0].data.filter(t => t.name == 'GPU1').map(t => t.visible)", plot
        )
        self.assertEqual(states, ["legendonly"])
        time.sleep(0.6)  # sooner it would be a double click, which leaves this variant alone
        button.click()
        browser.point_nowhere(driver)
        browser.wait(driver, lambda _: changed() < 0.001)

    @unittest.skipUnless(interactive.library(), "python3-plotly is not installed")
    def test_a_click_on_a_point_shows_its_replay_command(self):
        driver = self.usual()
        plot = self.figure(driver, "times-find").find_element("class name", "js-plotly-plot")
        place = driver.execute_script(
            """const p = arguments[0], t = p.data[0], a = p._fullLayout.xaxis, b = p._fullLayout.yaxis;
            const box = p.getBoundingClientRect();
            return [a._offset + a.d2p(t.x[1]) - box.width / 2, b._offset + b.d2p(t.y[1]) - box.height / 2, t.customdata[1]]""",
            plot,
        )
        from selenium.webdriver import ActionChains

        ActionChains(driver).move_to_element_with_offset(plot, *map(round, place[:2])).perform()
        browser.wait(driver, lambda d: d.execute_script("return Boolean(arguments[0]._hoverdata)", plot))
        ActionChains(driver).click().perform()
        box = driver.find_element("id", "picked")
        browser.wait(driver, lambda _: box.is_displayed())
        self.assertEqual(box.find_element("class name", "command").text, place[2]["command"])
        self.assertIn(place[2]["input"].split("/")[0], place[2]["command"])

    def test_the_csv_of_a_table_is_its_file(self):
        driver = self.usual()
        saved = driver.execute_async_script("""
            const done = arguments[0], make = URL.createObjectURL;
            URL.createObjectURL = blob => {
              if (blob.type !== 'text/csv') return make(blob);
              blob.text().then(done);
              URL.createObjectURL = make;
              return 'javascript:void 0';
            };
            document.querySelector('#table-choice [data-save="csv"]').click();""")
        with open(self.path.parent / "tables" / "choice.csv", newline="", encoding="utf-8") as file:
            self.assertEqual(saved, file.read())

    def test_the_run_that_it_saves_is_the_run(self):
        driver = self.usual()
        saved = driver.execute_async_script("""
            const done = arguments[0], make = URL.createObjectURL;
            URL.createObjectURL = blob => {
              if (blob.type !== 'application/json') return make(blob);
              blob.text().then(done);
              URL.createObjectURL = make;
              return 'javascript:void 0';
            };
            document.querySelector('#download').click();""")
        self.assertTrue(json.loads(saved) == page.data(report.Report([pages.of(made.run())])))

    def test_without_javascript_there_is_nothing_to_press(self):
        with browser.opened(self.path, flags=("--blink-settings=scriptEnabled=false",)) as driver:
            buttons = driver.find_elements("css selector", "button")
            self.assertGreater(len(buttons), 10)
            self.assertFalse(any(button.is_displayed() for button in buttons))
            self.assertTrue(driver.find_element("css selector", "#table-choice").is_displayed())

    def test_no_table_hides_a_column(self):
        """At 1,400 px every table fits; narrower, tables in words are cards; on a phone every number is in sight."""
        wider = """return [...document.querySelectorAll('.table details')].map(d => d.open = true) &&
                [...document.querySelectorAll('.scroll')].filter(e => e.scrollWidth > e.clientWidth + 1)
                .map(e => e.closest('.table').id)"""
        driver = self.usual()
        self.assertEqual(driver.execute_script(wider), [])
        browser.resize(driver, 768, 900)
        hidden = driver.execute_script(wider)
        self.assertEqual({"table-claims", "table-advice-short"} & set(hidden), set())
        browser.resize(driver, 390, 900)
        self.assertNotIn("table-exponents", driver.execute_script(wider))
        cell = driver.find_element("css selector", "#table-exponents td.number")
        driver.execute_script("arguments[0].scrollIntoView({behavior: 'instant', block: 'center'})", cell)
        left, right, label = driver.execute_script(
            "const b = arguments[0].getBoundingClientRect(); return [b.left, b.right, arguments[0].dataset.label]", cell
        )
        self.assertTrue(0 <= left < right <= 390)
        self.assertTrue(label)

    def test_the_navigation_marks_where_the_reader_is(self):
        here = "return [...document.querySelectorAll('nav a.here')].map(a => a.hash)"
        driver = self.usual()
        browser.wait(driver, lambda d: d.execute_script(here) == ["#summary"])
        driver.execute_script("document.querySelector('#motion').scrollIntoView({behavior: 'instant'})")
        browser.wait(driver, lambda d: d.execute_script(here) == ["#motion"])
        driver.execute_script("scrollTo({top: 0, behavior: 'instant'})")
        browser.wait(driver, lambda d: d.execute_script(here) == ["#summary"])
        driver.execute_script("scrollTo({top: 1e7, behavior: 'instant'})")
        browser.wait(driver, lambda d: d.execute_script(here) == ["#reproduce"])

    def test_every_figure_has_its_text(self):
        driver = self.usual()
        for figure in driver.find_elements("css selector", "figure[data-figure]"):
            named = figure.find_element("css selector", ".static").get_attribute("aria-describedby")
            text = driver.find_element("id", named)
            self.assertGreater(len(text.get_attribute("textContent")), 40, named)
        live = self.figure(driver, "times-find").find_element("css selector", ".live .panels")
        self.assertEqual(live.get_attribute("aria-describedby"), "alternative-times-find")

    def test_opens_in_under_two_seconds(self):
        driver = self.usual()
        loads = []
        for _ in range(3):
            driver.get(self.path.resolve().as_uri())
            loads.append(
                driver.execute_script("return performance.getEntriesByType('navigation')[0].loadEventEnd")
            )
        self.assertLess(min(loads), 2000)

    def test_without_decompression_the_static_figures_stay(self):
        """A browser without DecompressionStream: the SVGs of the page, painted, and their colours resolved."""
        text = self.path.read_text().replace(
            "<body>", "<body><script>delete window.DecompressionStream</script>", 1
        )
        path = self.path.with_name("old.html")
        path.write_text(text)
        with browser.opened(path, height=LONG) as driver:
            browser.wait(
                driver,
                lambda d: d.execute_script("return document.documentElement.dataset.ready") == "static",
            )
            drawings = driver.find_elements("css selector", "figure[data-figure] .static svg")
            self.assertGreater(len(drawings), 8)
            for k, picture in enumerate(self.pictures(driver, drawings)):
                self.assertTrue(browser.coloured(picture), k)
            self.assertEqual(driver.execute_script(DRAWN), 0)
            self.assertEqual(browser.errors(driver), [])

    def test_print_has_static_figures(self):
        driver = self.usual()
        driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
        svg = driver.find_element("css selector", "#figure-times-find .static svg")
        self.assertTrue(svg.is_displayed())
        self.assertTrue(browser.painted(svg))
        self.assertFalse(driver.find_element("css selector", "#figure-times-find .live").is_displayed())

    def test_long_tables_are_not_printed(self):
        """A page of counts is read on the screen or from its file, not on five sheets."""
        value = made.run()
        value["catena"]["counts"] *= 4
        with tempfile.TemporaryDirectory() as folder:
            with pages.without_figures():
                path = page.write(report.Report([runfile.load(made.write(folder, value))]), pathlib.Path(folder) / "page")
            with browser.opened(path, width=680) as driver:  # a sheet of A4
                driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
                head = driver.find_element("css selector", "#table-exponents thead")
                self.assertTrue(head.is_displayed(), "cards are for narrow windows, not for paper")
                table = driver.find_element("css selector", "#table-counts")
                self.assertLess(table.rect["height"], 200)
                self.assertIn("rows", table.find_element("css selector", "summary").text)


if __name__ == "__main__":
    unittest.main()
