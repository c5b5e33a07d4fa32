"""The fragment that viewer.render makes."""
import base64
import gzip
import json
import pathlib
import re
import sys
import tempfile
import unittest
import unittest.mock

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))

import made  # noqa: E402
import shown_chains  # noqa: E402
from catena_report import report, runfile, viewer  # noqa: E402

NOWHERE = (pathlib.Path("/nowhere/three.min.js"),)


def script(fragment, name):
    held = re.search(rf'<script [^>]*id="{name}">(.*?)</script>', fragment, re.S).group(1)
    return gzip.decompress(base64.b64decode(held)).decode()


class WithoutThree(unittest.TestCase):
    def setUp(self):
        patch = unittest.mock.patch.object(viewer, "LIBRARIES", NOWHERE)
        patch.start()
        self.addCleanup(patch.stop)

    def test_the_reason_names_the_file_and_debians_package(self):
        self.assertIn(str(NOWHERE[0]), viewer.missing())
        self.assertIn("libjs-three", viewer.missing())

    def test_there_is_no_viewer(self):
        self.assertEqual("", viewer.render(shown_chains.views()))


@unittest.skipIf(viewer.missing(), viewer.missing())
class Fragment(unittest.TestCase):
    def test_of_a_chain_that_several_runs_hold_the_first_is_shown(self):
        views = shown_chains.views()
        later = [{**view, "command": "later"} for view in views]
        shown = shown_chains.unpacked(json.loads(script(viewer.render(views + later), "catena-views")))
        self.assertTrue(shown == views)

    def test_without_views_there_is_none(self):
        self.assertEqual("", viewer.render([]))

    def test_it_holds_the_views_unchanged(self):
        views = shown_chains.views()
        fragment = viewer.render(views)
        self.assertTrue(views == shown_chains.unpacked(json.loads(script(fragment, "catena-views"))))

    def test_a_chain_of_several_runs_is_held_once(self):
        views = shown_chains.views()
        fragment = viewer.render(views + shown_chains.views())
        self.assertTrue(views == shown_chains.unpacked(json.loads(script(fragment, "catena-views"))))

    def test_a_name_cannot_end_the_script_that_holds_it(self):
        views = shown_chains.views()[:1]
        views[0]["input"] = "</script><b>"
        fragment = viewer.render(views)
        self.assertNotIn("<b>", fragment)
        self.assertTrue(views == shown_chains.unpacked(json.loads(script(fragment, "catena-views"))))

    def test_it_holds_three_js_whole(self):
        held = script(viewer.render(shown_chains.views()), "catena-three")
        for library in viewer.LIBRARIES:
            self.assertIn(library.read_text(encoding="utf-8"), held)

    def test_it_fetches_nothing(self):
        fragment = viewer.render(shown_chains.views())
        self.assertEqual([], re.findall(r'<[^>]+\s(?:src|href)\s*=', fragment))
        self.assertEqual([], re.findall(r'url\(|@import|fetch\(|XMLHttpRequest|https?://', fragment))

    def test_no_script_element_ends_early(self):
        self.assertEqual(3, viewer.render(shown_chains.views()).count("</script>"))


class Views(unittest.TestCase):
    def test_a_chain_without_a_view_shows_the_nearest_of_its_scene(self):
        value = made.run()
        value["catena"]["viewer"] = [
            {**shown_chains.views()[0], "input": name} for name in ("path1/n:20", "path1/n:9000", "far:exponent=22/n:50")
        ]
        with tempfile.TemporaryDirectory() as folder:
            pages = report.Report([runfile.load(made.write(folder, value))])
        for asked, shown in (
            ("path1/n:20", "path1/n:20"),
            ("path1/n:10000", "path1/n:9000"),
            ("far:n=200,exponent=22", "far:exponent=22/n:50"),
            ("far:n=200,exponent=23", None),
            ("path2/n:20", None),
        ):
            self.assertEqual(pages.view(asked), shown, asked)

    def test_the_nearest_is_by_the_ratio(self):
        value = made.run()
        value["catena"]["viewer"] = [{**shown_chains.views()[0], "input": f"path1/n:{n}"} for n in (1000, 10000)]
        run = runfile.Run("run.json", value)
        for n, nearest in ((3000, 1000), (4000, 10000)):
            self.assertEqual(report.Report([run]).view(f"path1/n:{n}"), f"path1/n:{nearest}")


if __name__ == "__main__":
    unittest.main()
