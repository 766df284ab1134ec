// Comparison: one answer is pinned, and stays beside those that follow.

import { place } from "./numbers.js";
import { make } from "./shared.js";

export class Pins {
  // `act` is called when the pinned answer or the way to show it changes. A page that keeps pinned answers itself sets
  // `onpin(wanted)`: it pins the answer on the page, or ends the comparison, by `Face.compare`.
  constructor(act) {
    this.onpin = undefined;
    this.answer = undefined;
    this.ghost = true;
    this.act = act;
    this.button = make("button", { type: "button", onclick: () => this.toggle() });
    this.way = make("button", { type: "button", onclick: () => this.turn() });
    this.words = make("p");
    this.element = make("div", { class: "wbx-pins" }, this.button, this.way, this.words);
    this.tell();
  }

  // The answer on the page, which the button pins.
  now(answer) {
    this.current = answer;
    this.button.disabled = !answer.scene && !this.answer;
  }

  toggle() {
    if (this.onpin) this.onpin(!this.answer);
    else this.pin(this.answer ? undefined : this.current);
  }

  // Pin an answer, or none.
  pin(answer) {
    this.answer = answer;
    this.tell();
    this.act();
  }

  turn() {
    this.ghost = !this.ghost;
    this.tell();
    this.act();
  }

  tell() {
    this.button.textContent = this.answer ? "Remove the comparison" : "Pin this flight to compare";
    this.way.textContent = this.ghost ? "Show side by side" : "Show as a ghost";
    this.way.hidden = this.words.hidden = !this.answer;
    const where = this.ghost ? "shown pale" : "farther away in the side view";
    this.words.textContent = this.answer ? `Pinned, ${where}: ${title(this.answer)}.` : "";
  }

  // The scene of the answer on the page, with the pinned flight as the second.
  scene(answer) {
    if (!this.answer?.scene) return answer.scene;
    const [now, before] = [answer, this.answer].map((each) => ({ ...each.scene.flights[0], label: title(each) }));
    return { ...answer.scene, flights: [now, before] };
  }
}

export function title(answer) {
  return `${answer.title} ${place(answer)}, model: ${answer.model_title}`;
}
