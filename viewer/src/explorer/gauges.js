// Gauges: each number on a bar with its plausible band. The scale is set by the band, so that it rests while one drags.

import { withUnit } from "./numbers.js";
import { make } from "./shared.js";

// A number above twice its band's upper end is drawn at the end of the bar.
const ROOM = 2;

export class Gauges {
  constructor() {
    this.rows = new Map();
    this.element = make("ul", { class: "wbx-gauges", "aria-label": "Numbers and their plausible ranges" });
  }

  show(gauges, pinned) {
    const before = new Map((pinned ?? []).map((gauge) => [gauge.name, gauge]));
    for (const gauge of gauges) {
      if (!this.rows.has(gauge.name)) this.rows.set(gauge.name, new Row());
      this.rows.get(gauge.name).show(gauge, before.get(gauge.name));
    }
    const rows = gauges.map(({ name }) => this.rows.get(name).element);
    const stays = rows.length === this.element.children.length && rows.every((row, nth) => row === this.element.children[nth]);
    if (!stays) this.element.replaceChildren(...rows);
  }
}

class Row {
  constructor() {
    this.label = make("span", { class: "wbx-label" });
    // No <output>: browsers take a click on it for one on a control, and would not unfold the source.
    this.value = make("span", { class: "wbx-value" });
    this.word = make("span", { class: "wbx-word" });
    this.band = make("span", { class: "wbx-band" });
    this.mark = make("span", { class: "wbx-mark" });
    this.pinned = make("span", { class: "wbx-mark wbx-was" });
    this.bar = make("span", { class: "wbx-bar", "aria-hidden": "true" }, this.band, this.pinned, this.mark);
    this.range = make("p");
    this.source = make("p");
    const head = make("summary", {}, this.label, this.value, this.word, this.bar);
    this.element = make("li", {}, make("details", {}, head, this.range, this.source));
  }

  show(gauge, before) {
    const { label, value, unit, low, high, source } = gauge;
    const known = low !== null || high !== null;
    this.element.dataset.gauge = gauge.name;
    this.label.textContent = label;
    this.value.textContent = value === null ? "–" : withUnit(value, unit);
    this.value.dataset.exact = value;
    this.word.textContent = word(gauge);
    this.element.className = { true: "wbx-inside", false: "wbx-outside" }[gauge.inside] ?? "";
    const given = gauge.given ? "Given, not predicted. " : "";
    this.range.textContent = given + (known ? `Plausible: ${range(gauge)}` : "No plausible range is known.");
    this.source.textContent = known ? `Source: ${source}` : "";
    const most = high !== null ? ROOM * high : 2.5 * low;
    const least = low !== null && low < 0 ? ROOM * low : 0;
    const place = (number) => `${100 * Math.min(Math.max((number - least) / (most - least), 0), 1)}%`;
    this.bar.hidden = !known;
    if (!known) return;
    this.band.style.left = place(low ?? least);
    this.band.style.right = `calc(100% - ${place(high ?? most)})`;
    this.put(this.mark, value, least, most, place);
    this.put(this.pinned, before?.value ?? null, least, most, place);
  }

  put(mark, value, least, most, place) {
    mark.hidden = value === null;
    if (value === null) return;
    mark.style.left = place(value);
    mark.classList.toggle("wbx-beyond", value > most || value < least);
  }
}

export function word({ value, low, high, inside, limited, given }) {
  if (value === null) return "not defined";
  if (low === null && high === null) return given ? "given" : "no range known";
  if (inside) return given ? "given" : limited ? "set by a limit" : "inside";
  return high !== null && value > high ? "above" : "below";
}

function range({ low, high, unit }) {
  if (low === null) return `at most ${withUnit(high, unit)}`;
  if (high === null) return `at least ${withUnit(low, unit)}`;
  return `${withUnit(low, "")} to ${withUnit(high, unit)}`;
}
