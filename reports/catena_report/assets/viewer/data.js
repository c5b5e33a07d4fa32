// What the run file holds of a view, decoded when it is asked for.

const decodedFramesKept = 24;

function bytesOf(base64) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(base64);
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let k = 0; k < text.length; ++k) bytes[k] = text.charCodeAt(k);
  return bytes;
}

// Rows of so many numbers, as viewer.py packs them: the steps from row to row, column after column, by bytes.
function rowsOf(base64, width) {
  const bytes = bytesOf(base64), words = new Uint32Array(bytes.length / 4), all = words.length;
  for (let column = 0, at = 0; column < width; ++column)
    for (let word = column, last = 0; word < all; word += width, ++at) {
      last += bytes[at] | bytes[at + all] << 8 | bytes[at + 2 * all] << 16 | bytes[at + 3 * all] << 24;
      words[word] = last = last | 0;
    }
  return words;
}

const floatsOf = (base64) => new Float32Array(rowsOf(base64, 4).buffer);
const indicesOf = (base64) => rowsOf(base64, 2);

// One entry of views[]: frames and levels by their position in the file, pairs as flat i, j, i, j, ...
class View {
  constructor(entry) {
    this.input = entry.input;
    this.command = entry.command || '';
    this.frames = entry.frames || [];
    this.levels = entry.levels || [];
    // The frame that the levels are of; files before it was told have those of the first.
    this.treeFrame = entry.tree_frame ?? this.frames[0]?.frame;
    this.wrong = entry.wrong || [];
    this.strands = entry.strands && entry.strands.length ? entry.strands : [0];
    this.decoded = new Map();
  }

  get variants() { return [...new Set(this.wrong.map((entry) => entry.variant))]; }

  // The position of a frame, or of the one nearest to it where only some are held.
  nearest(frameNumber) {
    const away = this.frames.map((frame) => Math.abs(frame.frame - frameNumber));
    return away.indexOf(Math.min(...away));
  }

  frame(position) {
    if (!this.decoded.has(position)) {
      if (this.decoded.size >= decodedFramesKept) this.decoded.delete(this.decoded.keys().next().value);
      const stored = this.frames[position];
      const spheres = floatsOf(stored.spheres), box = stored.box || null;
      this.decoded.set(position, {
        number: stored.frame, spheres, pairs: indicesOf(stored.pairs || ''), box, corners: cornersOf(spheres, box),
      });
    }
    return this.decoded.get(position);
  }

  bounds(level) { return floatsOf(this.levels[level].spheres); }

  // Asks for what is shown: that frame, by the variant chosen.
  replay(frameNumber, variant) {
    const word = /^[\w@+/=.,:-]+$/.test(variant) ? variant : `'${variant}'`;
    const named = this.command.replace(/^(.*) --frame \S+/s, (_, before) => `${before} --frame ${frameNumber}`);
    return variant ? named.replace(/^(.*) --variant \S+/s, (_, before) => `${before} --variant ${word}`) : named;
  }

  // What a wrong variant missed and invented in a frame; null where nothing was recorded.
  wrongIn(variant, frameNumber) {
    return this.wrong.find((entry) => entry.variant === variant && entry.frame === frameNumber) || null;
  }

  // Where along its strand each sphere lies, from 0 to 1.
  along(count) {
    const result = new Float32Array(count);
    this.strands.forEach((first, s) => {
      const end = s + 1 < this.strands.length ? this.strands[s + 1] : count;
      for (let i = first; i < end; ++i) result[i] = end - first > 1 ? (i - first) / (end - first - 1) : 0;
    });
    return result;
  }
}

// Rows of a sphere and of the image of another that is nearest to it.
function rowsOfPair(spheres, i, j, box) {
  const a = Array.from(spheres.subarray(4 * i, 4 * i + 4)), b = Array.from(spheres.subarray(4 * j, 4 * j + 4));
  const {point, across} = nearestImage(a.slice(0, 3), b.slice(0, 3), box);
  return {rows: [a, [...point, b[3]]], across};
}

const distanceOf = ([a, b]) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);

// How deep two spheres reach into each other, in the input's unit; below 0 they are apart. In binary64, for the eye:
// the verdict was exact and is not made here.
function overlapDepth(spheres, i, j, box) {
  const {rows} = rowsOfPair(spheres, i, j, box);
  return rows[0][3] + rows[1][3] - distanceOf(rows);
}
