// Plots beside the picture: the reader chooses what they show; all those along the beat show the same part of it. They
// are drawn while they are awake: folded plots cost nothing.

import { Card, PHASE } from "./card.js";
import { make } from "./elements.js";
import { offered } from "./series.js";

const MOST = 8;

export class Plots {
  // `scene`: its series and the curves that it starts with; `seek(phase)`: what a click in a plot asks for.
  constructor(scene, flights, last, seek) {
    Object.assign(this, { flights, last, seek, phase: 0, range: [0, last], cards: [], own: [], awake: false });
    this.about = Plots.about(scene, flights);
    this.series = offered(scene.series, flights);
    this.named = (name) => this.series.find((one) => one.name === name);
    this.first = scene.panels.map((ys) => ({ ys, x: PHASE }));
    this.list = make("div", { class: "wb-plots" });
    this.more = make(
      "button",
      { type: "button", onclick: () => this.add({ ys: [this.series[0].name], x: PHASE }) },
      "Add a plot",
    );
    this.told = make("output", { class: "wb-note" });
    const lines = ["The downstroke is shaded; in a plot of one series against another its line is thick."];
    if (flights.length > 1) lines.push(`Solid and first value: ${flights[0].label}. Dashed: ${flights[1].label}.`);
    this.element = make(
      "div",
      { class: "wb-board" },
      this.list,
      make("div", { class: "wb-bar" }, this.more, this.told),
      ...lines.map((line) => make("p", { class: "wb-note" }, line)),
    );
    this.kept = this.first;
  }

  // What menus and words are made from: plots can show another scene and its flights if this is the same.
  static about({ series, panels }, flights) {
    const names = offered(series, flights).map(({ name }) => name);
    return JSON.stringify([series, panels, names, flights.map(({ label }) => label)]);
  }

  // What is shown, as names: for a link, and to keep it when the flight changes.
  get choices() {
    return this.awake ? this.cards.map((card) => card.choice) : this.kept;
  }

  wake() {
    if (this.awake) return;
    this.awake = true;
    this.choose(this.kept);
  }

  sleep() {
    this.kept = this.choices;
    this.awake = false;
    this.cards = [];
    this.arrange();
  }

  // Show other flights with the same series.
  renew(flights, last) {
    this.range = last === this.last ? this.range : [0, last];
    [this.flights, this.last] = [flights, last];
    for (const card of this.cards) card.plot();
  }

  // Show these, as far as the flight has the series; nothing that can be shown leaves the plots as they are.
  choose(choices) {
    const known = choices.filter(({ ys, x }) => this.fit(ys) && (x === PHASE || this.named(x))).slice(0, MOST);
    if (!known.length) return;
    if (!this.awake) {
      this.kept = known.map(({ ys, x }) => ({ ys: x === PHASE ? ys : ys.slice(0, 1), x }));
      return;
    }
    this.cards = [];
    for (const [nth, choice] of known.entries()) this.cards.push(new Card(nth, choice, this));
    this.arrange();
  }

  fit(ys) {
    const [first, second] = ys.map(this.named);
    return first && ys.length <= 2 && (ys.length === 1 || second?.unit === first.unit);
  }

  // Draw curves of the reader's own over those of the same name, where the plots have them; returns the names of these.
  overlay(curves) {
    this.own = curves.filter(({ name }) => this.named(name) && !this.named(name).per);
    this.zoom(this.range);
    return this.own.map(({ name }) => name);
  }

  // Show each of these series in at least one plot along the beat.
  include(names) {
    const isShown = (name) => this.choices.some(({ x, ys }) => x === PHASE && ys.includes(name));
    const missing = names.filter((name) => !isShown(name)).map((name) => ({ ys: [name], x: PHASE }));
    if (missing.length) this.choose([...missing, ...this.choices]);
  }

  add(choice) {
    this.cards.push(new Card(this.cards.length, choice, this));
    this.arrange();
    this.cards.at(-1).rows.querySelector("select").focus();
  }

  remove(card) {
    this.choose(this.choices.filter((_, nth) => nth !== card.nth));
    this.more.focus();
  }

  arrange() {
    this.list.replaceChildren(...this.cards.map((card) => card.element));
    this.more.disabled = this.cards.length >= MOST;
  }

  tell(text) {
    this.told.textContent = text;
  }

  // Show a part of the beat in every plot along it.
  zoom(range) {
    this.range = range;
    for (const card of this.cards) if (card.choice.x === PHASE) card.axes.draw(range);
    this.show(this.phase);
  }

  // Move that part by a share of its length.
  shift(share) {
    const [from, to] = this.range;
    const by = Math.min(Math.max(share * (to - from), -from), this.last - to);
    this.zoom([from + by, to + by]);
  }

  show(phase) {
    this.phase = phase;
    for (const card of this.cards) card.show(phase);
  }
}
