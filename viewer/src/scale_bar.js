// A bar in the picture that says how long the arrow of a force is, as a map's scale does for a way.

import { make } from "./elements.js";
import { short } from "./writing.js";

const LONGEST = 110; // pixels

// The largest of 1, 2 and 5 times a power of ten that is at most `most`.
function roundBelow(most) {
  const power = 10 ** Math.floor(Math.log10(most));
  return [5, 2, 1].map((figure) => figure * power).find((figure) => figure <= most * (1 + 1e-9));
}

// Pixels of one metre across the line of sight, at the point that the camera turns about.
export function pixelsPerMetre(camera, target, height) {
  return height / (2 * Math.tan((camera.fov * Math.PI) / 360) * camera.position.distanceTo(target));
}

export class ScaleBar {
  constructor() {
    this.bar = make("div", { class: "wb-bar-line" });
    this.text = make("div", {});
    this.element = make("div", { class: "wb-force-bar", hidden: true }, this.bar, this.text);
  }

  // `perMetre`: pixels; `scale`: metres of an arrow for one newton; `weight` of the animal [N].
  show(perMetre, scale, weight) {
    const pixels = scale * perMetre;
    this.element.hidden = !(pixels > 0 && Number.isFinite(pixels));
    if (this.element.hidden) return;
    this.force = roundBelow(LONGEST / pixels);
    this.bar.style.width = `${this.force * pixels}px`;
    const share = short(this.force / weight, 2);
    this.text.textContent = `force ${short(this.force)} N (${share} × weight)`;
  }
}
