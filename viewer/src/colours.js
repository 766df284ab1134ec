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

export const ARROWS = { lift: "#0072B2", drag: "#E69F00", force: "#009E73" };

// The colour of a value from -range to range, red, green and blue from 0 to 1.
export function diverging(value, range) {
  const place = (Math.min(Math.max(value / range, -1), 1) + 1) * 0.5 * (SCALE.length - 1);
  const low = Math.min(Math.floor(place), SCALE.length - 2);
  const share = place - low;
  return SCALE[low].map((part, i) => part + share * (SCALE[low + 1][i] - part));
}

export function gradient() {
  const stops = SCALE.map((rgb) => `rgb(${rgb.map((part) => Math.round(255 * part)).join(" ")})`);
  return `linear-gradient(to right, ${stops.join(", ")})`;
}

// A number that a person would choose, at least `least`: one of these figures times a power of ten.
export function round(least, figures = [1, 2, 5, 10]) {
  const power = 10 ** Math.floor(Math.log10(least));
  return figures.map((figure) => figure * power).find((figure) => figure >= least * (1 - 1e-9));
}

export function written(value) {
  return Number(value.toPrecision(3)).toString();
}
