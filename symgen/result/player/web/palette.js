// Colours of the page and of the scene on it.

function rgba(colour, opacity) {
  const [r, g, b] = [1, 3, 5].map((i) => parseInt(colour.slice(i, i + 2), 16));
  return `rgba(${r},${g},${b},${opacity})`;
}

// The colours of the page now, from its style sheet.
const palette = {};
function readPalette() {
  const style = getComputedStyle(document.documentElement);
  for (const name of ["paper", "ink", "soft", "line", "track", "passed", "bad", "failed", "doubtful", "reaction", "push", "accent"]) {
    palette[name] = style.getPropertyValue(`--${name}`).trim();
  }
  palette.night = document.documentElement.dataset.theme === "dark";
}

const channels = (colour) => [1, 3, 5].map((i) => parseInt(colour.slice(i, i + 2), 16));

// A colour of the scene on this page: on dark paper greys change places with each other, and hues are a little lighter.
function shade(colour) {
  if (!palette.night) return colour;
  const c = channels(colour), high = Math.max(...c), low = Math.min(...c), grey = high - low < 32;
  const [ink, paper] = [palette.ink, palette.paper].map(channels), light = (high + low) / 510;
  return `#${c.map((x, i) => Math.round(grey ? ink[i] + light * (paper[i] - ink[i]) : x + 0.15 * (255 - x)).toString(16).padStart(2, "0")).join("")}`;
}
