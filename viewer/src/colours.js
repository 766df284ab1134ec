// Colours that colour-blind readers tell apart: a diverging scale for strips, the Okabe-Ito set for lines and arrows.

const SCALE = [
  [0.0, 0.07, 0.38],
  [0.02, 0.33, 0.59],
  [0.43, 0.66, 0.8],
  [0.93, 0.91, 0.89],
  [0.85, 0.6, 0.45],
  [0.7, 0.28, 0.07],
  [0.35, 0.0, 0.03],
];

// A sequential scale from little to much, of shades that stand out from light and dark ground.
const AMOUNT = [
  [0.42, 0.35, 0.8],
  [0.65, 0.27, 0.73],
  [0.85, 0.3, 0.55],
  [0.95, 0.45, 0.32],
  [0.98, 0.66, 0.15],
];

export const ARROWS = { lift: "#0072B2", drag: "#E69F00", force: "#009E73" };

// The colour at a share from 0 to 1 of the way through a scale.
function between(scale, share) {
  const place = share * (scale.length - 1);
  const low = Math.min(Math.floor(place), scale.length - 2);
  return scale[low].map((part, i) => part + (place - low) * (scale[low + 1][i] - part));
}

// The colour of a value from -range to range, red, green and blue from 0 to 1.
export function diverging(value, range) {
  return between(SCALE, (Math.min(Math.max(value / range, -1), 1) + 1) * 0.5);
}

// The colour of a share from 0 to 1 of the largest amount.
export function sequential(share) {
  return between(AMOUNT, Math.min(Math.max(share, 0), 1));
}

function asGradient(scale) {
  const stops = scale.map((rgb) => `rgb(${rgb.map((part) => Math.round(255 * part)).join(" ")})`);
  return `linear-gradient(to right, ${stops.join(", ")})`;
}

export const gradient = () => asGradient(SCALE);
export const amounts = () => asGradient(AMOUNT);

// Light or dark, from the colour of the text.
export function themeOf(ink) {
  const [r, g, b] = ink.match(/[\d.]+/g).map(Number);
  return 0.3 * r + 0.6 * g + 0.1 * b > 127 ? "dark" : "light";
}
