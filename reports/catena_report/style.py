"""One look for every figure: a variant keeps its colour, marker and dash all through the page.

Colour: the traversal (of a stage shown alone: the algorithm). Marker: the construction. Dash: the
arithmetic. Hollow: a device algorithm run on the host. Grey: a peer, with a marker of its own. Colours are
names that the page resolves for light and dark and for print.
"""
import dataclasses

# Okabe and Ito's colour-blind safe palette, yellow and black (which vanish on paper or in the dark) replaced
# by wine and olive of Paul Tol's.
LIGHT = {
    "c0": "#0072b2",
    "c1": "#d55e00",
    "c2": "#009e73",
    "c3": "#cc79a7",
    "c4": "#e69f00",
    "c5": "#56b4e9",
    "c6": "#882255",
    "c7": "#999933",
    "c8": "#5b5ea6",
    "c9": "#7a6a5a",
    "ink": "#1d2129",
    "muted": "#6b7280",
    "grid": "#e4e6ea",
    "faint": "#c3c7ce",
    "paper": "#ffffff",
    "band": "#eef3f8",
    "good": "#cfe5f3",
    "fair": "#dde6c8",
    "warn": "#f3cf73",
    "bad": "#d0561f",
    "lost": "#7b2150",
    "none": "#eceef1",
}
DARK = {
    "c0": "#4da3dc",
    "c1": "#f0803c",
    "c2": "#2fc79a",
    "c3": "#e09bc2",
    "c4": "#f2b632",
    "c5": "#86cdf5",
    "c6": "#d0679b",
    "c7": "#bdbd55",
    "c8": "#9a9ce0",
    "c9": "#b5a48f",
    "ink": "#e8eaee",
    "muted": "#9aa2af",
    "grid": "#2c313a",
    "faint": "#4a515d",
    "paper": "#14171c",
    "band": "#1c2733",
    "good": "#21465e",
    "fair": "#47583a",
    "warn": "#a87f1e",
    "bad": "#d9632c",
    "lost": "#b04a83",
    "none": "#242830",
}
COLOURS = [f"c{i}" for i in range(10)]
MARKERS = ["circle", "square", "diamond", "triangle-up", "cross", "triangle-down", "star", "hexagon"]
SPARE = ["triangle-left", "triangle-right", "pentagon"]  # for those of one colour
DASHES = {"robust": "solid", "literal": "dot", "double": "dash"}
# In the palette's order, which begins anew after ten: who is most often drawn beside one another comes first.
PROMINENT = ["CPU2", "GPU1", "GPU2", "GPUv2", "CPU1", "auto", "Hybrid", "ChainTree", "DeviceHybrid", "DeviceGrid"]
PROMINENT += ["aCPU2", "aGPU2", "bGPU2"]


@dataclasses.dataclass(frozen=True)
class Look:
    colour: str = "ink"
    marker: str = "circle"
    dash: str = "solid"
    hollow: bool = False


def of_arithmetic(name):
    """The look of an arithmetic, whatever the variant."""
    at = list(DASHES).index(name) if name in DASHES else len(DASHES)
    return Look(COLOURS[at], MARKERS[at], DASHES.get(name, "solid"))


PEERS = ["cross", "star", "hexagon", "triangle-down", "diamond", "square"]  # markers of others' libraries


class Looks:
    """The looks of all variants (variant.Variant) of a page."""

    def __init__(self, variants):
        found = {stage.algorithm for variant in variants for stage in variant.stages if not variant.peer}
        known = [name for name in PROMINENT if name in found]
        self.order = known + sorted(found - set(known))
        constructions = sorted({v.construction.algorithm if v.composed else "" for v in variants if not v.peer})
        self.markers = {name: MARKERS[at % len(MARKERS)] for at, name in enumerate(constructions)}

        peers = sorted({variant.name for variant in variants if variant.peer})
        self.peers = {name: Look("muted", PEERS[at % len(PEERS)], "dashdot") for at, name in enumerate(peers)}
        self.own = self._of_those_complete_in_themselves([v for v in variants if not v.peer and not v.composed])

    def _of_those_complete_in_themselves(self, variants):
        """algorithm -> marker: the first of a colour has a circle, the next one that nobody else of it has."""
        found, taken = {}, {}
        for algorithm in sorted({variant.traversal.algorithm for variant in variants}, key=self.order.index):
            used = taken.setdefault(self._colour(algorithm), set(self.markers.values()) - {self.markers.get("")})
            free = [marker for marker in ["circle", *MARKERS, *SPARE] if marker not in used]
            found[algorithm] = free[0] if free else "circle"
            used.add(found[algorithm])
        return found

    def _colour(self, algorithm):
        return COLOURS[self.order.index(algorithm) % len(COLOURS)] if algorithm in self.order else "ink"

    def variant(self, variant):
        if variant.peer:
            return self.peers[variant.name]
        return Look(
            self._colour(variant.traversal.algorithm),
            self.markers[variant.construction.algorithm] if variant.composed else self.own[variant.traversal.algorithm],
            DASHES.get(variant.arithmetic, "solid"),
            any(stage.on_host for stage in variant.stages),
        )

    def construction(self, variant):
        """The look of a variant's construction shown alone; of one complete in itself, its own."""
        if not variant.composed:
            return self.variant(variant)
        stage = variant.construction
        return Look(
            self._colour(stage.algorithm),
            self.markers.get(stage.algorithm, "circle"),
            DASHES.get(variant.arithmetic, "solid"),
            stage.on_host,
        )
