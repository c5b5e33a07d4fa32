"""A headless Chromium that opens a report as a reader would: offline, from a file, in an empty profile.

    with browser.opened(page, width=900, dark=True) as driver:
        assert browser.painted(driver.find_element(By.ID, "times"))
        assert browser.errors(driver) == []
"""
import contextlib
import io
import pathlib
import shutil
import tempfile

FLAGS = ("--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
         "--disable-background-networking", "--disable-component-update", "--disable-sync", "--hide-scrollbars",
         "--disable-dev-shm-usage", "--host-resolver-rules=MAP * ~NOTFOUND")  # no name resolves: offline for certain


def missing():
    """Why no browser can be driven here, or None."""
    try:
        import selenium  # noqa: F401
    except ImportError:
        return "python3-selenium is not installed"
    for program, package in (("chromium", "chromium"), ("chromedriver", "chromium-driver")):
        if not shutil.which(program):
            return f"{package} is not installed"
    return None


@contextlib.contextmanager
def opened(page, width=1400, height=900, dark=False, flags=()):
    """A WebDriver at the file `page`, `width` x `height` CSS pixels; `flags` are Chromium's own. Closed on leaving."""
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service

    profile = tempfile.mkdtemp(prefix="catena-browser-")
    options = webdriver.ChromeOptions()
    options.binary_location = shutil.which("chromium")
    for flag in (*FLAGS, f"--user-data-dir={profile}", f"--window-size={width},{height}", *flags):
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    driver = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)
    try:
        resize(driver, width, height)
        if dark:
            driver.execute_cdp_cmd("Emulation.setEmulatedMedia",
                                   {"features": [{"name": "prefers-color-scheme", "value": "dark"}]})
        driver.get(pathlib.Path(page).resolve().as_uri())
        yield driver
    finally:
        driver.quit()
        shutil.rmtree(profile, ignore_errors=True)


def resize(driver, width, height):
    """A window of `width` x `height` CSS pixels."""
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                           {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False})


def errors(driver):
    """What the console said of severity SEVERE since the last call (missing files and refused addresses too)."""
    return [entry["message"] for entry in driver.get_log("browser") if entry["level"] == "SEVERE"]


def wait(driver, condition, seconds=30):
    """The first true value of condition(driver); a TimeoutException after `seconds`."""
    from selenium.webdriver.support.ui import WebDriverWait
    return WebDriverWait(driver, seconds, poll_frequency=0.05).until(condition)


def settled(driver, element):
    """The element's pixels once they stay: what is drawn when it comes into sight may take a while."""
    seen = [pixels(element)]

    def stays(_):
        next_frame(driver)
        seen.append(pixels(element))
        return (seen[-1] == seen[-2]).all()

    wait(driver, stays)
    return seen[-1]


def point_nowhere(driver):
    """The pointer goes to the margin: what it would be over when the page scrolls may show more for it."""
    from selenium.webdriver import ActionChains
    actions = ActionChains(driver)
    actions.w3c_actions.pointer_action.move_to_location(0, 0)
    actions.perform()


def next_frame(driver):
    """Waits until what was drawn up to now is on the screen."""
    driver.execute_async_script("requestAnimationFrame(() => requestAnimationFrame(arguments[0]))")


def pixels(element):
    """What is on the screen where `element` is: height x width x 3 (0 to 1). The element is scrolled into view; one
    that is larger than the window costs a second, as the page is laid out anew for it.
    """
    driver = element.parent
    driver.execute_script("arguments[0].scrollIntoView({behavior: 'instant', block: 'nearest'})", element)
    return pictures([element])[0]


def in_window(elements):
    """Of each whether all of it can be seen, as the page is scrolled."""
    return elements[0].parent.execute_script("""
        return arguments[0].map(e => e.getBoundingClientRect()).map(
            b => b.x >= 0 && b.y >= 0 && b.right <= innerWidth && b.bottom <= innerHeight)""", elements)


def pictures(elements):
    """What is on the screen where each is, as it is scrolled: by one shot where all are in the window."""
    driver = elements[0].parent
    boxes, right, down = driver.execute_script("""
        const boxes = arguments[0].map(e => e.getBoundingClientRect());
        return [boxes.map(b => [b.x, b.y, b.width, b.height]), scrollX, scrollY]""", elements)
    if not all(in_window(elements)):
        return [_shot(driver, x + right, y + down, width, height) for x, y, width, height in boxes]
    window = _shot(driver)
    return [window[round(y):round(y + height), round(x):round(x + width)] for x, y, width, height in boxes]


def _shot(driver, *area):
    import base64

    import matplotlib.image
    clip = {"captureBeyondViewport": True, "clip": {**dict(zip(("x", "y", "width", "height"), area)), "scale": 1}}
    shot = driver.execute_cdp_cmd(
        "Page.captureScreenshot", {"format": "png", "optimizeForSpeed": True, **(clip if area else {})})
    return matplotlib.image.imread(io.BytesIO(base64.b64decode(shot["data"])), format="png")[..., :3]


def painted(element, least=0.002):
    """Whether the element is drawn, not only there."""
    return coloured(pixels(element), least)


def coloured(picture, least=0.002):
    """Whether at least this share of its pixels differs from the commonest colour."""
    import numpy
    colours = (picture * 255).round().astype(numpy.uint32)
    packed = colours[..., 0] << 16 | colours[..., 1] << 8 | colours[..., 2]
    _, counts = numpy.unique(packed, return_counts=True)
    return 1 - counts.max() / packed.size >= least


def screenshot(driver, path, whole=False):
    """A PNG of the window, or of the whole page."""
    import base64
    area = {}
    if whole:
        size = driver.execute_cdp_cmd("Page.getLayoutMetrics", {})["cssContentSize"]
        area = {"captureBeyondViewport": True, "clip": {"x": 0, "y": 0, "width": size["width"],
                                                        "height": min(size["height"], 16000), "scale": 1}}
    shot = driver.execute_cdp_cmd("Page.captureScreenshot", {"format": "png", **area})
    pathlib.Path(path).write_bytes(base64.b64decode(shot["data"]))
