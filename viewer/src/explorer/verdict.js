// What one reads first: the sentence, the two lights, and the warnings beside them.

import { make } from "./shared.js";

const NAMES = { closes: ["Closes", "Does not close"], plausible: ["Plausible", "Not plausible"] };
const NUMBERS = /(?<![\w.])(\d[\d.,]*(?:e[+-]?\d+)?(?: m\/s| W| times a second| times)?)/;

export class Verdict {
  constructor() {
    this.sentence = make("h1", { class: "wbx-sentence" });
    this.lights = make("ul", { class: "wbx-lights", "aria-label": "Verdict" });
    this.summary = make("summary");
    this.list = make("ul", { tabindex: "0", "aria-label": "Warnings" });
    this.warnings = make("details", { class: "wbx-warnings" }, this.summary, this.list);
    this.warnings.open = window.matchMedia("(min-width: 900px)").matches;
    this.warnings.hidden = true; // until there is an answer
    this.element = make("div", { class: "wbx-verdict" }, this.lights, this.warnings);
    this.spoken = make("p", { class: "wbx-unseen", role: "status" });
  }

  show(answer) {
    // Numbers stand out, so that one sees what changes while one drags.
    const parts = answer.sentence.split(NUMBERS);
    this.sentence.replaceChildren(...parts.map((part, nth) => (nth % 2 ? make("b", {}, part) : part)));
    this.speak(answer.sentence);
    this.lights.replaceChildren(...answer.lights.map((light) => this.light(light)));
    const { warnings } = answer;
    this.warnings.hidden = false;
    this.warnings.classList.toggle("wbx-narrow", !warnings.length);
    if (answer.status !== "converged") this.warnings.open = true; // it says why, and what would fly
    const count = warnings.length === 1 ? "1 warning" : `${warnings.length} warnings`;
    this.summary.replaceChildren(make("span", { class: "wbx-narrow" }, "Reasons, "), count);
    // Where the page is narrow, there is no room beside the lights.
    const reasons = answer.lights.map(({ text }) => make("li", { class: "wbx-narrow" }, text));
    this.list.replaceChildren(...reasons, ...warnings.map((text) => make("li", {}, text)));
  }

  // A screen reader hears the sentence once the reader rests, not at every step of a drag.
  speak(text) {
    clearTimeout(this.later);
    this.later = setTimeout(() => (this.spoken.textContent = text), 700);
  }

  // Sign, word and colour say the same.
  light({ name, good, known, text }) {
    const state = good ? "good" : known === false ? "open" : "bad";
    const word = state === "open" ? "Plausible? Not known" : NAMES[name][good ? 0 : 1];
    const sign = make("span", { class: "wbx-sign", "aria-hidden": "true" }, { good: "✓", bad: "!", open: "?" }[state]);
    const words = make("span", {}, make("strong", {}, word), " ", make("span", { class: "wbx-why" }, text));
    return make("li", { class: `wbx-light wbx-${state}`, "data-light": name }, sign, words);
  }
}
