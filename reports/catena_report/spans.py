"""Chains in words that say nothing of any other chain that was timed."""
import itertools

from . import runfile, words


def in_words(inputs, timed):
    """1,000 to 3,000 spheres (path1 and yarn) and 1,000 (melt): scene by scene, from one length to another only where
    all that was timed between them is among `inputs`.
    """
    scenes = {}
    for scene in sorted({runfile.scene_of(input_) for input_ in inputs}):
        scenes.setdefault(_spans(scene, inputs, timed), []).append(scene)
    texts = [f"{words.listed(map(_text, spans))} spheres ({words.listed(scenes[spans], 4)})" for spans in sorted(scenes)]
    return words.listed(texts[:1] + [text.replace(" spheres (", " (", 1) for text in texts[1:]])


def _spans(scene, inputs, timed):
    """((least n, greatest n), ...)."""
    of = lambda names: {runfile.n_of(name) for name in names if runfile.scene_of(name) == scene}  # noqa: E731
    mine = of(inputs)
    groups = [(among, list(ns)) for among, ns in itertools.groupby(sorted(mine | of(timed)), mine.__contains__)]
    return tuple((ns[0], ns[-1]) for among, ns in groups if among)


def _text(span):
    low, high = map(words.count, span)
    return low if low == high else f"{low} to {high}"
