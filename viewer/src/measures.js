// What the air in the picture measures: the scale of the arrows, the colours of the trails, the squares of the ground.

import { amounts } from "./colours.js";
import { make } from "./elements.js";
import { outerForce, outerStrips } from "./paths.js";
import { ScaleBar } from "./scale_bar.js";
import { short } from "./writing.js";

export class Measures {
  constructor() {
    this.bar = new ScaleBar();
    this.trails = make("div", {});
    this.ground = make("div", {});
    this.wake = make("div", {}, "wake: a sketch, not computed");
    this.element = make("div", { class: "wb-measures" }, this.bar.element, this.trails, this.wake, this.ground);
  }

  // The largest force on the outer strips of any of the flights [N], the end of the trails' scale.
  static tipForce(flights) {
    return Math.max(...flights.flatMap((flight) => outerForce(flight)));
  }

  // The legends that belong to what is switched on.
  show(look, flight, cell) {
    this.trails.hidden = !look.trails;
    this.wake.hidden = !look.wake;
    this.ground.hidden = !look.ground;
    const count = outerStrips(flight);
    this.trails.replaceChildren(
      make("div", { class: "wb-gradient", style: `background:${amounts()}` }),
      make("div", { class: "wb-ends" }, make("span", {}, "0"), make("span", {}, short(look.tipForce))),
      make("div", {}, `trails: force on ${count > 1 ? `${count} outer strips` : "the outer strip"} [N]`),
    );
    this.ground.textContent = `squares of ${short(cell)} m`;
  }

  // The bar follows the camera: it is drawn anew with every picture.
  follow(stage, look, flight) {
    this.bar.show(stage.perMetre, look.arrows.size ? look.scale : 0, flight.weight);
  }
}
