// One plot with its menus: which curves, against what, their values at the phase, and copies for elsewhere.

import { copyPicture, copyTable } from "./copy.js";
import { make } from "./elements.js";
import { Panel } from "./panel.js";
import { Portrait } from "./portrait.js";
import { byUnit, inUnit } from "./series.js";

export const PHASE = "phase";

// A value with the digits that the eye can follow.
function shown(value) {
  return Number.isFinite(value) ? String(Math.abs(value) < 1e-9 ? 0 : value.toPrecision(3)) : "no value";
}

export class Card {
  // `choice`: names of one or two curves in `ys`, and in `x` phase or a series. `plots`: the list that the card is in.
  constructor(nth, choice, plots) {
    [this.nth, this.plots] = [nth, plots];
    this.rows = make("div", { class: "wb-rows" });
    this.foot = make("div", { class: "wb-card-foot" });
    this.place = make("div", {
      class: "wb-plot",
      tabindex: "0",
      role: "group",
      onkeydown: (event) => this.key(event),
    });
    this.element = make("div", { class: "wb-card" }, this.rows, this.place, this.foot);
    this.choose(choice);
  }

  choose({ ys, x }) {
    this.choice = { ys: x === PHASE ? ys : ys.slice(0, 1), x };
    this.place.setAttribute("aria-label", `Plot ${this.nth + 1}; plus and minus zoom, brackets move, 0 shows all`);
    this.fillRows(this.choice.ys.map(this.plots.named));
    this.fillFoot();
    this.plot();
  }

  // Draw the curves of the flights; the menus stay.
  plot() {
    const { flights, last, range, seek, named } = this.plots;
    const { ys, x } = this.choice;
    const curves = ys.map(named);
    const hooks = { seek, zoom: (to) => this.plots.zoom(to), own: () => this.plots.own };
    this.axes =
      x === PHASE ? new Panel(curves, flights, last, range, hooks) : new Portrait(named(x), curves[0], flights, hooks);
    this.place.replaceChildren(this.axes.svg);
    this.show(this.plots.phase);
  }

  fillRows(curves) {
    const { series } = this.plots;
    this.values = curves.map(() => make("span", { class: "wb-value" }));
    const rows = curves.map((curve, nth) => {
      const offered = nth ? byUnit(series).get(curves[0].unit) : series;
      const menu = this.menu(
        `Curve ${nth + 1} of plot ${this.nth + 1}`,
        offered,
        curve.name,
        (name) => this.setCurve(nth, name),
        nth,
      );
      return make(
        "div",
        { class: "wb-row" },
        make("span", { class: `wb-key wb-key-${nth}` }),
        menu,
        this.values[nth],
      );
    });
    const partners = byUnit(series).get(curves[0].unit);
    if (curves.length === 1 && this.choice.x === PHASE && partners.length > 1) {
      const label = `Second curve of plot ${this.nth + 1}`;
      const menu = this.menu(label, partners, "", (name) => this.setCurve(1, name), 1);
      rows.push(make("div", { class: "wb-row" }, make("span", { class: "wb-key" }), menu));
    }
    this.rows.replaceChildren(...rows);
  }

  // Series in groups of one unit; with `none`, the reader can also have no curve.
  menu(label, series, chosen, act, none = 0) {
    const select = make("select", {
      "aria-label": label,
      onchange: () => act(select.value),
      class: chosen ? false : "wb-faint",
    });
    if (none)
      select.append(
        make("option", { value: "", selected: chosen === "" }, chosen ? "no second curve" : "add a curve"),
      );
    for (const [unit, members] of byUnit(series)) {
      const options = members.map(({ name, label: text }) =>
        make("option", { value: name, selected: name === chosen }, text),
      );
      select.append(make("optgroup", { label: inUnit(unit) }, ...options));
    }
    return select;
  }

  setCurve(nth, name) {
    const { named } = this.plots;
    const ys = nth ? [this.choice.ys[0], name] : [name, this.choice.ys[1]];
    const kept = ys.filter((one, at) => one && ys.indexOf(one) === at && named(one).unit === named(ys[0]).unit);
    this.change({ ys: kept, x: this.choice.x }, this.rows, nth);
  }

  // Choose anew, and give the focus back to the menu that was used.
  change(choice, place, nth) {
    this.choose(choice);
    place.querySelectorAll("select")[nth]?.focus();
  }

  fillFoot() {
    const { series } = this.plots;
    const label = `Plot ${this.nth + 1} against`;
    const against = make("select", {
      "aria-label": label,
      onchange: () => this.change({ ...this.choice, x: against.value }, this.foot, 0),
    });
    against.append(make("option", { value: PHASE, selected: this.choice.x === PHASE }, "phase"));
    for (const [unit, members] of byUnit(series)) {
      const options = members.map(({ name, label: text }) =>
        make("option", { value: name, selected: name === this.choice.x }, text),
      );
      against.append(make("optgroup", { label: inUnit(unit) }, ...options));
    }
    const button = (text, what, act) =>
      make("button", { type: "button", "aria-label": what, title: what, onclick: act }, text);
    this.across = make("span", { class: "wb-value" });
    this.foot.replaceChildren(
      make(
        "div",
        { class: "wb-row wb-across" },
        make("span", { class: "wb-against" }, "against"),
        against,
        this.across,
      ),
      button("CSV", `Copy plot ${this.nth + 1} as CSV`, () => copyTable(this)),
      button("PNG", `Copy plot ${this.nth + 1} as PNG picture`, () => copyPicture(this)),
      button("×", `Remove plot ${this.nth + 1}`, () => this.plots.remove(this)),
    );
  }

  key(event) {
    if (event.target !== this.place || event.ctrlKey || event.metaKey || event.altKey) return;
    const { axes, plots } = this;
    const about = axes instanceof Panel ? [plots.phase] : axes.values.map((each) => each[0]);
    const shift = (share) => plots.shift(share);
    const acts = {
      "+": () => axes.zoomBy(0.7, ...about),
      "=": () => axes.zoomBy(0.7, ...about),
      "-": () => axes.zoomBy(1 / 0.7, ...about),
      "[": () => shift(-0.2),
      "]": () => shift(0.2),
      0: () => axes.reset(),
    };
    if (!acts[event.key]) return;
    acts[event.key]();
    event.preventDefault();
    event.stopPropagation();
  }

  show(phase) {
    const found = this.axes.show(phase);
    const { named } = this.plots;
    const rows = this.axes instanceof Panel ? found : [found[1]];
    rows.forEach((values, nth) => this.write(this.values[nth], values, this.choice.ys[nth]));
    if (this.axes instanceof Portrait) this.write(this.across, found[0], this.choice.x);
  }

  write(place, values, name) {
    const { unit } = this.plots.named(name);
    place.textContent = `${values.map(shown).join(" | ")}${unit ? ` ${unit}` : ""}`;
  }
}
