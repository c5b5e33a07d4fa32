// Colours come from the style sheet's custom properties, so that light and dark are decided in one place.

const chainColourNames = ['ground', 'ink', 'start', 'middle', 'end', 'colliding', 'missing', 'invented', 'bound'];

function readPalette(element) {
  element.dataset.dark = isDark() ? 'yes' : 'no';
  const style = getComputedStyle(element);
  const palette = {};
  for (const name of chainColourNames) {
    const hex = parseInt(style.getPropertyValue(`--viewer-${name}`).trim().slice(1), 16);
    palette[name] = [hex >> 16 & 255, hex >> 8 & 255, hex & 255];
  }
  return palette;
}

const cssColour = (rgb, alpha = 1) => `rgba(${rgb[0]},${rgb[1]},${rgb[2]},${alpha})`;

// The page's own choice of light or dark, else the system's.
function isDark() {
  const chosen = document.documentElement.dataset.theme;
  return chosen === 'dark' || (chosen !== 'light' && matchMedia('(prefers-color-scheme: dark)').matches);
}

// Four bytes a sphere: its colour, and 255 where it must be seen even from afar.
function chainColours(palette, along, marked) {
  const colours = new Uint8Array(4 * along.length);
  for (let i = 0; i < along.length; ++i) {
    const [from, to, t] = along[i] < 0.5 ? [palette.start, palette.middle, 2 * along[i]]
                                         : [palette.middle, palette.end, 2 * along[i] - 1];
    for (let channel = 0; channel < 3; ++channel)
      colours[4 * i + channel] = from[channel] + (to[channel] - from[channel]) * t;
  }
  for (const [name, pairs] of marked)
    for (let k = 0; k < pairs.length; ++k) {
      colours.set(palette[name], 4 * pairs[k]);
      colours[4 * pairs[k] + 3] = 255;
    }
  return colours;
}
