"""A page with nothing but the viewer, opened in headless Chromium, and what tests ask of it."""
import contextlib
import pathlib
import tempfile
import time
import unittest

import browser
import shown_chains
from catena_report import viewer

SOFTWARE_WEBGL = ("--use-angle=swiftshader", "--enable-unsafe-swiftshader")
WITHOUT_WEBGL = ("--disable-3d-apis",)
REASON = browser.missing() or viewer.missing()
PAGE = """<!doctype html><html lang="en"><meta charset="utf-8"><title>viewer</title><link rel="icon" href="data:,">
<meta name="viewport" content="width=device-width"><body>{}</body></html>"""


@contextlib.contextmanager
def page_of(views):
    """The path of a page that shows these, and that is there while this lasts."""
    with tempfile.TemporaryDirectory() as folder:
        page = pathlib.Path(folder) / "page.html"
        page.write_text(PAGE.format(viewer.render(views)), encoding="utf-8")
        yield page


class Opened:
    """A page with the viewer, and what a test asks of it."""

    def __init__(self, driver):
        self.driver = driver
        browser.wait(driver, lambda d: d.execute_script("return document.getElementById('catena-viewer').dataset.ready"), 60)

    def part(self, name):
        return self.driver.find_element("css selector", f'#catena-viewer [data-part="{name}"]')

    def run(self, script, *arguments):
        return self.driver.execute_script(f"const viewer = window.catenaViewer.viewer, scene = viewer.scene; {script}", *arguments)

    def show(self, name, frame=None):
        return self.driver.execute_async_script(
            "const done = arguments[2]; catenaViewer.show(arguments[0], arguments[1] ?? undefined).then(done);", name, frame)

    def settle(self):
        """Until nothing was drawn in some of the browser's frames, and nothing is waiting to be: a flight has landed."""
        end, renders = time.monotonic() + 60, []
        while time.monotonic() < end:
            browser.next_frame(self.driver)
            renders.append(self.run("return scene.requested ? null : scene.renders"))
            if renders[-1] and renders[-4:] == 4 * renders[-1:]:
                return
            time.sleep(0.05)
        raise AssertionError("the viewer never comes to rest")

    def picture(self):
        self.settle()
        return browser.pixels(self.part("stage"))[50:-60, 6:-90]  # without buttons, legend, axes, focus

    def share(self, name):
        """Share of the picture in a colour of the palette, lit or in shade."""
        import numpy
        colour = numpy.array(self.run("return viewer.palette[arguments[0]]", name), float)
        picture = self.picture().astype(float)
        light = numpy.linalg.norm(picture, axis=2)
        cosine = picture @ (colour / numpy.linalg.norm(colour)) / numpy.maximum(light, 1e-9)
        return float(((cosine > 0.99) & (light > 0.35)).mean())


def changed(before, after):
    """Share of pixels that differ visibly."""
    return float((abs(before - after).max(axis=2) > 0.1).mean())


class InBrowser(unittest.TestCase):
    FLAGS = SOFTWARE_WEBGL
    DARK = False

    @classmethod
    def setUpClass(cls):
        if REASON:
            raise unittest.SkipTest(REASON)
        open_until_the_end = contextlib.ExitStack()
        cls.addClassCleanup(open_until_the_end.close)
        page = open_until_the_end.enter_context(page_of(shown_chains.views()))
        cls.driver = open_until_the_end.enter_context(
            browser.opened(page, width=1000, height=850, dark=cls.DARK, flags=cls.FLAGS))
        cls.opened = Opened(cls.driver)

    def setUp(self):
        self.assertTrue(self.opened.show("hairpin/n:160", 20))

    def tearDown(self):
        self.assertEqual([], browser.errors(self.driver))
