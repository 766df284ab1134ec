// "Push it": the reader chooses a gust, with or without feedback, and sees the flight that Python computed.

import { make } from "./elements.js";

const nameOf = ({ direction, size, feedback }) => [direction, size, ...(feedback ? ["feedback"] : [])].join("*");
// Where a gust comes from, in plain words.
const FROM = { upward: "from below", downward: "from above", head: "from ahead", tail: "from behind" };

const unique = (values) => [...new Set(values)];

export class Pushes {
  // `show(scene, once)`: show the flight of a push, or the scene without one.
  constructor(id, show) {
    this.id = id;
    this.show = show;
    this.pushes = [];
    this.shown = undefined; // the push whose flight is shown
    this.onchange = () => {};
    this.element = make("fieldset", { class: "wb-bar wb-push", hidden: true });
  }

  // Offer the pushes of a scene; without any, nothing is shown.
  offer(scene) {
    this.scene = scene;
    this.pushes = scene.pushes ?? [];
    this.mark(undefined);
    this.element.hidden = this.pushes.length === 0;
    if (this.element.hidden) return;
    this.direction = this.choice("Gust", unique(this.pushes.map((push) => push.direction)));
    this.size = this.choice("Size [m/s]", unique(this.pushes.map((push) => push.size)));
    this.feedback = make("input", { type: "checkbox" });
    const loop = make("label", { class: "wb-toggle" }, this.feedback, "feedback");
    loop.hidden = !this.pushes.some((push) => push.feedback);
    this.back = make("button", { type: "button", hidden: true, onclick: () => this.reset() }, "Back to the orbit");
    this.outcome = make("output", { class: "wb-outcome", "aria-live": "polite" });
    this.element.replaceChildren(
      make("legend", {}, "Push it"),
      this.direction.element,
      this.size.element,
      loop,
      make("button", { type: "button", onclick: () => this.push() }, "Push"),
      this.back,
      this.outcome,
    );
  }

  choice(label, values) {
    const id = `${this.id}-push-${label.replace(/\W/g, "")}`;
    const select = make("select", { id });
    for (const value of values) select.append(make("option", { value }, FROM[value] ?? String(value)));
    return { select, element: make("span", { class: "wb-choice" }, make("label", { for: id }, label), select) };
  }

  get chosen() {
    return this.pushes.find(
      (push) =>
        push.direction === this.direction.select.value &&
        String(push.size) === this.size.select.value &&
        push.feedback === this.feedback.checked,
    );
  }

  // Choose one of the pushes, and show its flight.
  choose({ direction, size, feedback }) {
    this.direction.select.value = direction;
    this.size.select.value = size;
    this.feedback.checked = feedback;
    this.push();
  }

  push() {
    const { chosen } = this;
    this.outcome.textContent = chosen.outcome;
    this.back.hidden = false;
    this.show(chosen.scene, true);
    this.mark(chosen);
  }

  reset() {
    if (!this.back || this.back.hidden) return;
    this.outcome.textContent = "";
    this.back.hidden = true;
    this.show(this.scene, false);
    this.mark(undefined);
  }

  mark(push) {
    const changed = push !== this.shown;
    this.shown = push;
    if (changed) this.onchange();
  }

  // The push that is shown, as a text for a link; empty if none is.
  get name() {
    return this.shown ? nameOf(this.shown) : "";
  }

  // Show the push of such a text; without one, or with one that the scene lacks, the orbit.
  open(name) {
    const found = this.pushes.find((push) => nameOf(push) === name);
    if (found) this.choose(found);
    else this.reset();
  }
}
